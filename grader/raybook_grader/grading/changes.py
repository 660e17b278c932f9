"""What a run changes in grades that were there before, for whom, and whose doing it is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ..database import Database, Student, Version
from ..policy import Policy, Settled
from ..scoring import Verdict
from .result import ModuleResult


@dataclass(frozen=True)
class Snapshot:
    """All that the grades are at one time."""

    policy: Policy
    modules: Mapping[str, str]
    students: Mapping[str, Student]
    versions: Mapping[str, Mapping[str, Sequence[Version]]]


@dataclass(frozen=True)
class Change:
    """A grade that is another one now; ``after`` is None where there is none any more.

    ``lines`` say what changed, the first one the points. ``is_theirs``: the student handed
    something else in; everything else is the doing of whoever grades.
    """

    student: str
    assignment: str
    lines: tuple[str, ...]
    is_theirs: bool
    is_lost: bool
    """There were points, and now the grader fails."""


def snapshot(database: Database) -> Snapshot:
    """The grades as they are now, without pictures."""
    students = {student.id: student for student in database.students()}
    return Snapshot(
        policy=database.policy(),
        modules={module.number: module.module for module in database.modules()},
        students=students,
        versions={name: database.versions(name) for name in students},
    )


def internal_errors(now: Snapshot) -> int:
    """How many modules have no score because the grader failed in them."""
    results = [result for s in now.students.values() for result in s.results.values()]
    return sum(
        result is not None and result.verdict is Verdict.INTERNAL_ERROR and result.score is None
        for result in results
    )


def changes(before: Snapshot, after: Snapshot) -> Iterator[Change]:
    """Every known grade that is another one, by student and assignment.

    What had no score before is no change: a new submission, or one that the grader failed in.
    """
    for name, student in sorted(before.students.items()):
        for number, old in sorted(student.results.items()):
            if old is None or old.score is None:
                continue
            later = after.students.get(name)
            new = later.results.get(number) if later else None
            first = f"{name} {number} {before.modules[number]}"
            if later is None or new is None:
                gone = f"{first}: {_grade(old)} -> no submission"
                yield Change(name, number, (gone,), is_theirs=False, is_lost=False)
                continue
            lines = [
                *_check_lines(old, new),
                *_why_lines(student.settled[number], later.settled[number]),
            ]
            if _grade(old) != _grade(new) or lines:
                yield Change(
                    name,
                    number,
                    (f"{first}: {_grade(old)} -> {_grade(new)}", *lines),
                    is_theirs=_is_theirs(before, after, name, number),
                    is_lost=new.score is None,
                )


def _grade(result: ModuleResult) -> str:
    return f"{result.verdict} {_points(result.score)}"


def _points(score: float | None) -> str:
    return "?" if score is None else format(score, "g")


def _check_lines(old: ModuleResult, new: ModuleResult) -> Iterator[str]:
    was = {check.name: f"{check.status} {_points(check.score)}" for check in old.checks}
    now = {check.name: f"{check.status} {_points(check.score)}" for check in new.checks}
    for name in {**was, **now}:
        if was.get(name) != now.get(name):
            yield f"{name}: {was.get(name, 'no such check')} -> {now.get(name, 'no such check')}"


def _why_lines(old: Settled, new: Settled) -> Iterator[str]:
    if _late(old) != _late(new):
        yield f"{_late(old)} -> {_late(new)}"


def _late(settled: Settled) -> str:
    penalty = settled.penalty
    if penalty is None:
        return "not late"
    plural = "s" if penalty.days_late > 1 else ""
    free = f", {penalty.late_days} of them free" if penalty.late_days else ""
    return f"{penalty.days_late} day{plural} late{free}: -{penalty.percent:g} %"


def _is_theirs(before: Snapshot, after: Snapshot, name: str, number: str) -> bool:
    """Whether the student's own doing explains a change."""
    if before.policy.counts != after.policy.counts:
        return False
    was, now = before.versions[name], after.versions[name]
    if not _same_work(was[number], now[number]):
        return True
    # Late days that were spent on another module are missing here.
    elsewhere = any(not _same_work(was.get(n, ()), now[n]) for n in now)
    same_judge = [v.key for v in was[number]] == [v.key for v in now[number]]
    return elsewhere and same_judge and before.policy == after.policy


def _same_work(was: Sequence[Version], now: Sequence[Version]) -> bool:
    """Whether the same was handed in at the same time; a database of version 1 does not say."""
    if any(version.files is None for version in was):
        return True
    return [(v.files, v.time) for v in was] == [(v.files, v.time) for v in now]
