"""Bringing a database of an earlier version up to date, in one transaction."""

from __future__ import annotations

import sqlite3
from pathlib import Path

from ..errors import BadInput

VERSION = 2
_SCHEMA = Path(__file__).with_name("schema.sql")


def prepare(database: sqlite3.Connection, name: str, course: str) -> None:
    """Make the tables, or move them up from version 1. To be called in a transaction."""
    tables = {row[0] for row in database.execute("SELECT name FROM sqlite_master")}
    if not tables:
        make(database, course)
    if tables and "about" not in tables:
        raise BadInput(f"{name}: is another program's database, expected this grader's")
    (version,) = database.execute("SELECT version FROM about").fetchone()
    if version == 1:
        _from_1(database)
    elif version != VERSION:
        raise BadInput(f"{name} is of version {version}, expected {VERSION}: use a new folder")


def make(database: sqlite3.Connection, course: str) -> None:
    for statement in _SCHEMA.read_text(encoding="utf-8").split(";\n\n"):
        database.execute(statement)
    database.execute("INSERT INTO about VALUES (?, 0)", (VERSION,))
    database.execute("INSERT INTO rules VALUES (?, '')", (course,))


def _from_1(database: sqlite3.Connection) -> None:
    """Version 1 knew one submission a student, and no policy, draft or decision."""
    kept = {
        "assignment": "number, module, title, points, optional",
        "submission": "id, problem",
        "work": "key, final, result, finished",
        "picture": "key, place, html",
        "grade": "submission, assignment, 0, key, NULL, NULL",
    }
    (course,) = database.execute("SELECT course FROM about").fetchone()
    # The new tables refer to each other by name, which a renamed one would take along.
    for table in kept:
        database.execute(f"CREATE TEMP TABLE old_{table} AS SELECT * FROM main.{table}")
    for table in ("grade", "picture", "work", "submission", "assignment", "about"):
        database.execute(f"DROP TABLE main.{table}")
    make(database, course)
    for table, columns in kept.items():
        database.execute(f"INSERT INTO main.{table} SELECT {columns} FROM temp.old_{table}")
        database.execute(f"DROP TABLE temp.old_{table}")
    database.execute(
        "UPDATE about SET published = EXISTS (SELECT 1 FROM grade) AND NOT EXISTS"
        " (SELECT 1 FROM grade LEFT JOIN work USING (key) WHERE work.key IS NULL)"
    )
