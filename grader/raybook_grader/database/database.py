"""Reading and writing `grades.sqlite`."""

from __future__ import annotations

import json
import sqlite3
import zlib
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path

from ..course import Assignment
from ..errors import BadInput
from ..grading.result import ModuleResult
from ..policy import Policy
from . import decisions, draft, reading
from .decisions import Decision
from .migrate import prepare
from .values import Module, Student, Version

NAME = "grades.sqlite"


class Database:
    """The results under one output folder. One process writes; each method is one transaction."""

    def __init__(self, folder: Path, course: str | None = None) -> None:
        """Open the database in ``folder``; make it if a course's name is given."""
        file = folder / NAME
        if course is None and not file.is_file():
            raise BadInput(f"{file}: does not exist, expected a folder that `grade` has written")
        try:
            # Autocommit: `_transaction` says where transactions begin and end.
            self._db = sqlite3.connect(file, isolation_level=None)
            self._db.execute("PRAGMA journal_mode = WAL")
            self._db.execute("PRAGMA foreign_keys = ON")
            self._db.execute("PRAGMA temp_store = MEMORY")
            with self._transaction():
                prepare(self._db, str(file), course or "")
        except sqlite3.DatabaseError as error:
            if error.sqlite_errorcode != sqlite3.SQLITE_NOTADB:
                raise
            raise BadInput(f"{file}: {error}, expected this grader's database") from error

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        self._db.execute("BEGIN IMMEDIATE")
        try:
            yield
            self._db.execute("COMMIT")
        except BaseException:
            # A full disk has ended the transaction already.
            if self._db.in_transaction:
                self._db.execute("ROLLBACK")
            raise

    def close(self) -> None:
        self._db.close()

    def plan(
        self,
        assignments: Iterable[Assignment],
        submissions: Mapping[str, str | None],
        keys: Mapping[tuple[str, str], str | Sequence[Version]],
        course: str | None = None,
        policy: str = "",
    ) -> None:
        """Say what the class consists of now: its submissions with their problems, and the
        versions by (submission, assignment), a mere key for one without a time. Submissions that
        are gone lose their grades, not their work; grades of other assignments stay.
        """
        with self._transaction():
            self._db.execute("UPDATE rules SET course = ifnull(?, course)", (course,))
            self._db.execute("UPDATE rules SET policy = ?", (policy,))
            for a in assignments:
                self._db.execute(
                    "INSERT INTO assignment VALUES (?, ?, ?, ?, ?) ON CONFLICT (number) DO UPDATE"
                    " SET module = excluded.module, title = excluded.title,"
                    " points = excluded.points, optional = excluded.optional",
                    (a.number, a.module, a.title, a.points, a.optional),
                )
            for (name,) in self._db.execute("SELECT id FROM submission").fetchall():
                if name not in submissions:
                    self._db.execute("DELETE FROM submission WHERE id = ?", (name,))
            self._db.executemany(
                "INSERT INTO submission VALUES (?, ?) ON CONFLICT (id) DO UPDATE"
                " SET problem = excluded.problem",
                submissions.items(),
            )
            self._db.executemany("DELETE FROM grade WHERE (submission, assignment) = (?, ?)", keys)
            self._db.executemany("INSERT INTO grade VALUES (?, ?, ?, ?, ?, ?)", _rows(keys))

    def published(self) -> bool:
        """Whether grades were ever complete; then a run must show what it would change."""
        (found,) = self._db.execute("SELECT published FROM about").fetchone()
        return bool(found)

    def begin_draft(self) -> None:
        """From now on `plan` and all that reads mean a draft, which begins as what is there."""
        with self._transaction():
            draft.begin(self._db)

    def publish(self) -> None:
        """What is there is what counts; a draft takes the place of what was published."""
        with self._transaction():
            draft.publish(self._db)

    def drop_draft(self, shown: Iterable[str] = ()) -> None:
        """Back to what is published. ``shown``: the keys of what was redone and seen."""
        with self._transaction():
            draft.mark_shown(self._db, shown)
            draft.drop(self._db)

    def redo(self, keys: Collection[str], keep_shown: bool) -> dict[str, str]:
        """Have finished work done again beside the old; the keys to plan by the old ones.

        What was begun goes on. What has been done again and shown is begun once more, or kept if
        ``keep_shown``, to be published.
        """
        with self._transaction():
            draft.redo(self._db, keys, keep_shown)
        return {key: key + draft.AGAIN for key in keys}

    def forget(self, keys: Iterable[str] | None = None) -> None:
        """Drop finished work so that it is done again; by default all of it, and nothing counts as
        published any more. What people decided stays.
        """
        with self._transaction():
            if keys is None:
                self._db.execute("DELETE FROM work")
                self._db.execute("DELETE FROM redo")
                self._db.execute("UPDATE about SET published = 0")
            else:
                self._db.executemany("DELETE FROM work WHERE key = ?", ((key,) for key in keys))

    def done(self) -> set[str]:
        """The keys of all work that need not be done again."""
        return {key for (key,) in self._db.execute("SELECT key FROM work WHERE final")}

    def store(self, key: str, result: ModuleResult, final: bool) -> None:
        """Store a piece of work with its pictures; it replaces an earlier one."""
        text = json.dumps(result.without_pictures().to_json())
        pictures = [
            (key, i, zlib.compress(check.picture.encode()))
            for i, check in enumerate(result.checks)
            if check.picture
        ]
        with self._transaction():
            self._db.execute("DELETE FROM work WHERE key = ?", (key,))
            self._db.execute("INSERT INTO work VALUES (?, ?, ?, ?)", (key, final, text, _now()))
            self._db.executemany("INSERT INTO picture VALUES (?, ?, ?)", pictures)

    def course(self) -> str:
        (name,) = self._db.execute("SELECT course FROM rules").fetchone()
        return str(name)

    def policy(self) -> Policy:
        """The rules of the class, as they were when it was graded last."""
        return reading.policy(self._db)

    def modules(self) -> list[Module]:
        """The assignments that were ever graded, by number."""
        return reading.modules(self._db)

    def waiting(self) -> dict[str, set[str]]:
        """The keys of the work that is not done, by submission."""
        rows = self._db.execute(
            "SELECT submission, grade.key FROM grade LEFT JOIN work USING (key)"
            " WHERE final IS NOT TRUE"
        )
        found: dict[str, set[str]] = {}
        for name, key in rows:
            found.setdefault(name, set()).add(key)
        return found

    def students(self, pictures: bool = False) -> Iterator[Student]:
        """Every submission by id, one at a time; with the judge's pictures if asked for."""
        for (name,) in self._db.execute("SELECT id FROM submission ORDER BY id").fetchall():
            yield self.student(name, pictures)

    def student(self, name: str, pictures: bool = False) -> Student:
        """One submission; KeyError when there is none of that id."""
        return reading.student(self._db, name, pictures)

    def versions(self, name: str) -> dict[str, list[Version]]:
        """What a student handed in, by assignment and in order."""
        return reading.versions(self._db, name)

    def decide(
        self, student: str, assignment: str, points: float, reason: str, by: str
    ) -> Decision:
        """Write down, for ever, what a module's points are whatever the grader finds."""
        with self._transaction():
            number = decisions.add(self._db, student, assignment, points, None, reason, by, _now())
        return self.decision(number)

    def withdraw(self, number: int, reason: str, by: str) -> Decision:
        """Write down that a decision no longer holds; the one before it does again."""
        old = self.decision(number)
        with self._transaction():
            new = decisions.add(
                self._db, old.student, old.assignment, None, number, reason, by, _now()
            )
        return self.decision(new)

    def decisions(self) -> list[Decision]:
        """All that people decided, in that order."""
        return decisions.all_of(self._db)

    def decision(self, number: int) -> Decision:
        """One of them; KeyError when there is none of that number."""
        for decision in self.decisions():
            if decision.number == number:
                return decision
        raise KeyError(number)


def _rows(
    keys: Mapping[tuple[str, str], str | Sequence[Version]],
) -> Iterator[tuple[str, str, int, str, str | None, str | None]]:
    for (submission, number), given in keys.items():
        versions = [Version(given)] if isinstance(given, str) else given
        for place, version in enumerate(versions):
            time = version.time.isoformat() if version.time else None
            yield submission, number, place, version.key, version.files, time


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")
