"""What people decided about points: rows that are added and never changed."""

from __future__ import annotations

import sqlite3
from dataclasses import dataclass

from ..policy import Override


@dataclass(frozen=True)
class Decision:
    """One row: points for a student's assignment, or (``points`` is None) the withdrawal of one.

    ``holds`` says whether it is what counts now.
    """

    number: int
    student: str
    assignment: str
    points: float | None
    withdraws: int | None
    reason: str
    by: str
    at: str
    holds: bool

    def override(self) -> Override | None:
        """What it does to the points, if it counts."""
        if not self.holds or self.points is None:
            return None
        return Override(self.points, self.reason, self.by, self.at)


def add(
    database: sqlite3.Connection,
    student: str,
    assignment: str,
    points: float | None,
    withdraws: int | None,
    reason: str,
    who: str,
    at: str,
) -> int:
    """Add a row; its number."""
    row = database.execute(
        "INSERT INTO decision (student, assignment, points, withdraws, reason, who, at)"
        " VALUES (?, ?, ?, ?, ?, ?, ?) RETURNING number",
        (student, assignment, points, withdraws, reason, who, at),
    ).fetchone()
    return int(row[0])


def all_of(database: sqlite3.Connection, student: str | None = None) -> list[Decision]:
    """Every row in the order in which they were made, of one student or of all.

    The last one that was not withdrawn holds; so a withdrawal brings back the one before.
    """
    rows = database.execute(
        "SELECT number, student, assignment, points, withdraws, reason, who, at FROM decision"
        " WHERE ?1 IS NULL OR student = ?1 ORDER BY number",
        (student,),
    ).fetchall()
    withdrawn = {row[4] for row in rows if row[4] is not None}
    last = {
        (row[1], row[2]): row[0] for row in rows if row[3] is not None and row[0] not in withdrawn
    }
    holding = set(last.values())
    return [
        Decision(number, name, assignment, points, withdraws, reason, who, at, number in holding)
        for number, name, assignment, points, withdraws, reason, who, at in rows
    ]
