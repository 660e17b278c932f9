"""The students of a made-up class: who hands in which version of each module, and how."""

from __future__ import annotations

import random
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from first_pictures import first_pictures
from packing import send, send_broken
from versions import Version, versions_of

from raybook_grader.course import Assignment, Course

DISTINCT = 1 / 3
"""Of all modules that are handed in, so many differ from all others."""

_STUBS = 0.35
"""Of those that are like another, so many are stubs; of the rest half are copies of the reference,
and the others go round among friends."""

_EVERY_BROKEN = 67
"""One in so many archives is cut in half."""


@dataclass(frozen=True)
class Student:
    """``modules`` are by the assignment's number; nothing of a broken archive can be read."""

    name: str
    modules: Mapping[str, Version]
    broken: bool

    def score(self, number: str, judged: Mapping[str, float | None]) -> float | None:
        """What the mix predicts; ``judged`` are the exhibits' scores by their names."""
        version = self.modules[number]
        if self.broken:
            return 0.0
        return version.score if version.exhibit is None else judged[version.exhibit.name]


def make_students(
    course: Course, assignments: Iterable[Assignment], count: int, seed: int
) -> list[Student]:
    """A class; the same seed gives the same one."""
    columns: dict[str, list[Version]] = {}
    for assignment in assignments:
        rng = random.Random(f"{seed} {assignment.number}")
        columns[assignment.number] = _column(course, assignment, count, rng)
    return [
        Student(
            f"student-{i + 1:03}",
            {number: column[i] for number, column in columns.items()},
            i % _EVERY_BROKEN == _EVERY_BROKEN - 1,
        )
        for i in range(count)
    ]


def write_students(students: Sequence[Student], out: Path, seed: int) -> dict[str, int]:
    """Write the submissions into the empty folder ``out``; how many are of each form."""
    out.mkdir(parents=True)
    rng = random.Random(f"{seed} forms")
    forms: dict[str, int] = {}
    for student in students:
        files = {
            p: text for version in student.modules.values() for p, text in version.files.items()
        }
        if student.broken:
            form = send_broken(out, student.name, files)
        else:
            form = send(out, student.name, files, rng)
        forms[form] = forms.get(form, 0) + 1
    return forms


def _column(
    course: Course, assignment: Assignment, count: int, rng: random.Random
) -> list[Version]:
    """What each student hands in for one assignment."""
    different = max(1, round(DISTINCT * count))
    if assignment.sources:
        pool = versions_of(course.root, assignment, different, rng)
    else:
        pool = first_pictures(assignment, course.sources, different, rng)
    column = pool + [_copied(pool, rng) for _ in range(count - len(pool))]
    rng.shuffle(column)
    return column


def _copied(pool: Sequence[Version], rng: random.Random) -> Version:
    if len(pool) > 1 and rng.random() < _STUBS:
        return pool[1]
    return pool[0] if rng.random() < 0.5 else rng.choice(pool)
