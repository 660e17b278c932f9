"""What a run has to do: which assignments, whose modules, and which of them are not done yet."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from ..course import Assignment, Course
from ..database import Database
from ..errors import BadInput
from ..kit import load_kit
from ..submissions import Submission
from .job import Job, Worker
from .key import Keys


@dataclass(frozen=True)
class Order:
    """What `raybook-grader grade` was asked for. ``assignments`` is None for all."""

    submissions: Path
    out: Path
    assignments: Collection[str] | None
    workers: int
    fresh: bool
    regrade: Collection[str]
    scheduler: str | None = None


def choose_assignments(
    course: Course, numbers: Collection[str] | None, console: Console
) -> list[Assignment]:
    """The assignments to grade, in order; says which are left out."""
    known = {assignment.number: assignment for assignment in course.assignments}
    for number in numbers or ():
        if number not in known:
            raise BadInput(f"no assignment {number!r}, expected one of {', '.join(known)}")
    chosen = [a for a in course.assignments if numbers is None or a.number in numbers]
    for assignment in chosen:
        if not assignment.is_graded:
            console.print(f"{assignment.number} {assignment.module}: not graded yet, left out")
    graded = [assignment for assignment in chosen if assignment.is_graded]
    if not graded:
        raise BadInput("no assignment to grade, expected one with [[check]] tables")
    return graded


def refuse_unknown(regrade: Collection[str], submissions: Sequence[Submission]) -> None:
    """Fault of ids that are not in the class."""
    known = {submission.id for submission in submissions}
    for name in regrade:
        if name not in known:
            raise BadInput(f"--regrade {name!r}: no such submission, expected ids of this class")


def plan(
    course: Course,
    worker: Worker,
    order: Order,
    assignments: Sequence[Assignment],
    submissions: Sequence[Submission],
    database: Database,
) -> list[Job]:
    """Write down what the class consists of; the jobs that are left to do."""
    keys = Keys(course, load_kit(worker.kit), worker.unsafe)
    jobs: dict[str, Job] = {}
    planned: dict[tuple[str, str], str] = {}
    for submission in submissions:
        for assignment in assignments:
            files = {p: f for p, f in submission.files.items() if p in assignment.owned}
            key = keys.key(assignment, files)
            planned[submission.id, assignment.number] = key
            jobs[key] = Job(key, assignment.number, files)
    database.plan(assignments, {s.id: s.problem for s in submissions}, planned)
    if order.fresh:
        database.forget()
    elif order.regrade:
        database.forget(key for (name, _), key in planned.items() if name in order.regrade)
    done = database.done()
    return [job for key, job in jobs.items() if key not in done]
