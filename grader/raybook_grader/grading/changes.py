"""What a run changed in grades that were there before."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from ..database import Database
from ..scoring import Verdict


@dataclass(frozen=True)
class Grade:
    """A module's verdict and score, to compare."""

    verdict: Verdict
    score: float | None

    def __str__(self) -> str:
        return f"{self.verdict} {'?' if self.score is None else format(self.score, 'g')}"


Snapshot = Mapping[tuple[str, str], Grade]


def snapshot(database: Database) -> Snapshot:
    """All grades by (submission, assignment)."""
    return {
        (student.id, number): Grade(result.verdict, result.score)
        for student in database.students()
        for number, result in student.results.items()
        if result is not None
    }


def changes(before: Snapshot, after: Snapshot) -> Iterator[str]:
    """A line for each grade that is another one now."""
    for place in sorted(before.keys() & after.keys()):
        if before[place] != after[place]:
            name, number = place
            yield f"changed: {name} {number}: {before[place]} -> {after[place]}"
