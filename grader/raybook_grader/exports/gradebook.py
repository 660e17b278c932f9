"""The grades of a class as exports see them: what `grades.json` says, as plain values.

An unknown score is None, all the way through: no export may turn it into a zero.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..database import Database, Module
from ..errors import BadInput
from ..grading.export import grades
from ..scoring import total


@dataclass(frozen=True)
class Mark:
    """One module of one submission. ``checks`` are as in `grades.json`.

    ``unsafe`` says that the program ran without a sandbox.
    """

    score: float | None
    max_score: float
    verdict: str
    message: str
    checks: Sequence[Mapping[str, Any]]
    unsafe: bool


@dataclass(frozen=True)
class Row:
    """One submission. ``marks`` is keyed by assignment; what was never graded is not in it.

    ``score`` and ``max_score`` are those of the whole row: see `read_gradebook`.
    """

    id: str
    problem: str | None
    score: float | None
    max_score: float
    marks: Mapping[str, Mark]


@dataclass(frozen=True)
class Gradebook:
    """The class, with the modules that are exported."""

    course: str
    modules: tuple[Module, ...]
    rows: tuple[Row, ...]

    @property
    def unknown(self) -> list[str]:
        """The modules without a score, as "s042: 03 bvh"; rows that are not graded to the end."""
        found = []
        for row in self.rows:
            unknown = [m for m in self.modules if _is_unknown(row.marks.get(m.number))]
            found += [f"{row.id}: {m.number} {m.module}" for m in unknown]
            if row.score is None and not unknown:
                found.append(f"{row.id}: not graded to the end")
        return found

    @property
    def unsafe(self) -> int:
        """How many modules were graded without a sandbox."""
        return sum(mark.unsafe for row in self.rows for mark in row.marks.values())


def read_gradebook(database: Database, numbers: Collection[str] | None = None) -> Gradebook:
    """All modules, or those named.

    A row's score is the submission's own (the required modules) by default, and the sum of the
    named modules otherwise: naming an optional one makes it count.
    """
    modules = database.modules()
    for number in numbers or ():
        if number not in (module.number for module in modules):
            known = ", ".join(module.number for module in modules) or "none"
            raise BadInput(f"assignment {number!r} was never graded here, expected some of {known}")
    chosen = tuple(m for m in modules if numbers is None or m.number in numbers)
    values = grades(database)
    rows = tuple(_row(s, chosen, numbers is None) for s in values["submissions"])
    return Gradebook(values["course"], chosen, rows)


def _row(submission: Mapping[str, Any], modules: Sequence[Module], whole: bool) -> Row:
    chosen = {module.number for module in modules}
    marks = {m["assignment"]: _mark(m) for m in submission["modules"] if m["assignment"] in chosen}
    if whole:
        score, max_score = submission["score"], submission["max_score"]
    else:
        absent = [module for module in modules if module.number not in marks]
        score = None if absent else total(mark.score for mark in marks.values())
        max_score = round(sum(module.points for module in modules), 2)
    return Row(submission["id"], submission["problem"], score, max_score, marks)


def _mark(module: Mapping[str, Any]) -> Mark:
    return Mark(
        score=module["score"],
        max_score=module["max_score"],
        verdict=module["verdict"],
        message=module["message"],
        checks=module["checks"],
        unsafe=module.get("unsafe", False),
    )


def _is_unknown(mark: Mark | None) -> bool:
    return mark is not None and mark.score is None
