"""Reading and writing `grades.sqlite`."""

from __future__ import annotations

import json
import sqlite3
import zlib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from ..course import Assignment
from ..errors import BadInput
from ..grading.result import ModuleResult

VERSION = 1
NAME = "grades.sqlite"
_SCHEMA = Path(__file__).with_name("schema.sql")


@dataclass(frozen=True)
class Module:
    """What an assignment is called and worth, as it was when it was graded."""

    number: str
    module: str
    title: str
    points: float
    optional: bool


@dataclass(frozen=True)
class Student:
    """One submission with its results; None for a module that is not graded yet."""

    id: str
    problem: str | None
    results: Mapping[str, ModuleResult | None]


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
            self._prepare(course)
        except sqlite3.DatabaseError as error:
            raise BadInput(f"{file}: {error}, expected this grader's database") from error

    def _prepare(self, course: str | None) -> None:
        with self._transaction():
            if not self._db.execute("SELECT 1 FROM sqlite_master").fetchone():
                for statement in _SCHEMA.read_text(encoding="utf-8").split(";\n"):
                    self._db.execute(statement)
                self._db.execute("INSERT INTO about VALUES (?, ?)", (VERSION, course or ""))
            found = self._db.execute("SELECT version FROM about").fetchone()
        if found != (VERSION,):
            raise BadInput(f"{NAME} is of version {found[0]}, expected {VERSION}: use a new folder")

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        self._db.execute("BEGIN IMMEDIATE")
        try:
            yield
        except BaseException:
            self._db.execute("ROLLBACK")
            raise
        self._db.execute("COMMIT")

    def close(self) -> None:
        self._db.close()

    def plan(
        self,
        assignments: Iterable[Assignment],
        submissions: Mapping[str, str | None],
        keys: Mapping[tuple[str, str], str],
    ) -> None:
        """Say what the class consists of now: its submissions with their problems, and the keys
        by (submission, assignment). Submissions that are gone lose their grades, not their work;
        grades of other assignments stay.
        """
        with self._transaction():
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
            self._db.executemany(
                "INSERT OR REPLACE INTO grade VALUES (?, ?, ?)",
                ((submission, number, key) for (submission, number), key in keys.items()),
            )

    def forget(self, keys: Iterable[str] | None = None) -> None:
        """Drop finished work, all of it by default, so that it is done again."""
        with self._transaction():
            if keys is None:
                self._db.execute("DELETE FROM work")
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
            self._db.execute(
                "INSERT INTO work VALUES (?, ?, ?, datetime('now'))", (key, final, text)
            )
            self._db.executemany("INSERT INTO picture VALUES (?, ?, ?)", pictures)

    def course(self) -> str:
        (name,) = self._db.execute("SELECT course FROM about").fetchone()
        return str(name)

    def modules(self) -> list[Module]:
        """The assignments that were ever graded, by number."""
        rows = self._db.execute("SELECT * FROM assignment ORDER BY number")
        return [Module(n, m, t, points, bool(optional)) for n, m, t, points, optional in rows]

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
        found = self._db.execute("SELECT problem FROM submission WHERE id = ?", (name,)).fetchone()
        if found is None:
            raise KeyError(name)
        grades = self._db.execute(
            "SELECT assignment, grade.key, result FROM grade LEFT JOIN work USING (key)"
            " WHERE submission = ? ORDER BY assignment",
            (name,),
        ).fetchall()
        results = {n: self._result(key, text, pictures) for n, key, text in grades}
        return Student(name, found[0], results)

    def _result(self, key: str, text: str | None, pictures: bool) -> ModuleResult | None:
        if text is None:
            return None
        result = ModuleResult.from_json(json.loads(text))
        if not pictures:
            return result
        rows = self._db.execute("SELECT place, html FROM picture WHERE key = ?", (key,))
        return result.with_pictures({i: zlib.decompress(html).decode() for i, html in rows})
