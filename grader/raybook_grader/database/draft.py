"""A draft of the class beside the published one, until somebody has agreed to what it changes.

The draft is in temporary tables of the same names. SQLite looks for a name among the temporary
tables first, so that whatever reads or plans meets the draft, and the published tables stay as
they are. A kill takes the draft along; the work that was done for it is in `work` and stays.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable

AGAIN = "#again"
"""At the end of the key of work that is done once more."""

_TABLES = ("rules", "assignment", "submission", "grade")


def is_open(database: sqlite3.Connection) -> bool:
    found = database.execute("SELECT 1 FROM temp.sqlite_master WHERE name = 'grade'")
    return found.fetchone() is not None


def begin(database: sqlite3.Connection) -> None:
    """Copy what is published; from now on everything reads and writes the copy."""
    for table in _TABLES:
        (text,) = database.execute(
            "SELECT sql FROM main.sqlite_master WHERE name = ?", (table,)
        ).fetchone()
        database.execute(text.replace("CREATE TABLE", "CREATE TEMP TABLE", 1))
        database.execute(f"INSERT INTO temp.{table} SELECT * FROM main.{table}")


def drop(database: sqlite3.Connection) -> None:
    """Forget the draft; the published tables are met again."""
    for table in reversed(_TABLES):
        database.execute(f"DROP TABLE IF EXISTS temp.{table}")


def publish(database: sqlite3.Connection) -> None:
    """Put the draft, if there is one, in the place of what was published."""
    if is_open(database):
        for table in reversed(_TABLES):
            database.execute(f"DELETE FROM main.{table}")
        for table in _TABLES:
            database.execute(f"INSERT INTO main.{table} SELECT * FROM temp.{table}")
        drop(database)
        _replace_redone(database)
    database.execute("UPDATE about SET published = 1")


def _replace_redone(database: sqlite3.Connection) -> None:
    """Put the new results in the place of those that were done again."""
    rows = database.execute("SELECT DISTINCT key FROM grade WHERE key LIKE ?", (f"%{AGAIN}",))
    for (new,) in rows.fetchall():
        old = new.removesuffix(AGAIN)
        database.execute("DELETE FROM work WHERE key = ?", (old,))
        database.execute(
            "INSERT INTO work SELECT ?, final, result, finished FROM work WHERE key = ?", (old, new)
        )
        database.execute("UPDATE picture SET key = ? WHERE key = ?", (old, new))
        database.execute("DELETE FROM work WHERE key = ?", (new,))
        database.execute("UPDATE grade SET key = ? WHERE key = ?", (old, new))
        database.execute("DELETE FROM redo WHERE key = ?", (old,))


def redo(database: sqlite3.Connection, keys: Iterable[str], keep_shown: bool) -> None:
    """Have work done again. What was begun before goes on; what was done and shown is begun anew
    unless ``keep_shown``.
    """
    for key in keys:
        if not keep_shown:
            found = database.execute("DELETE FROM redo WHERE key = ? AND shown", (key,))
            if found.rowcount:
                database.execute("DELETE FROM work WHERE key = ?", (key + AGAIN,))
        database.execute("INSERT OR IGNORE INTO redo VALUES (?, 0)", (key,))


def mark_shown(database: sqlite3.Connection, keys: Iterable[str]) -> None:
    database.executemany("UPDATE redo SET shown = 1 WHERE key = ?", ((key,) for key in keys))
