"""What a run has to do: which assignments, whose modules, and which of them are not done yet."""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from pathlib import Path

from rich.console import Console

from ..course import Assignment, Course
from ..database import Database, Version
from ..errors import BadInput
from ..kit import load_kit
from ..policy import Counts, Policy, parse_policy
from ..submissions import Submission, SubmittedFile
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
    apply: bool = False
    policy: tuple[Path, str] | None = None
    """The class's course.toml and its text, if it has one."""

    def rules(self, course: Course) -> Policy:
        """What the class's course.toml says; without one nothing is ever late."""
        if self.policy is None:
            return Policy()
        file, text = self.policy
        return parse_policy(text, file, [a.number for a in course.assignments])


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


ALL = "all"


@dataclass(frozen=True)
class Plan:
    """The jobs that are left to do, and the keys of the work that is done once more."""

    jobs: Sequence[Job]
    redone: Collection[str]


def refuse_unknown(regrade: Collection[str], submissions: Sequence[Submission]) -> None:
    """Fault of ids that are not in the class."""
    known = {submission.id for submission in submissions} | {ALL}
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
) -> Plan:
    """Write down what the class consists of, in a draft if there are published grades."""
    rules = order.rules(course)
    keys = Keys(course, load_kit(worker.kit), worker.unsafe)
    jobs: dict[str, Job] = {}
    planned: dict[tuple[str, str], list[Version]] = {}
    problems: dict[str, str | None] = {}
    for student, group in groupby(submissions, key=lambda submission: submission.id):
        handed_in = list(group)
        problems[student] = _problems(handed_in)
        for assignment in assignments:
            versions = planned[student, assignment.number] = []
            for submission, files in versions_of(assignment, handed_in, rules.counts):
                key = keys.key(assignment, files)
                versions.append(Version(key, _hash(files), submission.time))
                jobs[key] = Job(key, assignment.number, files)
    if order.fresh:
        database.forget()
    again: dict[str, str] = {}
    named = {
        version.key
        for (student, _), versions in planned.items()
        if student in order.regrade or ALL in order.regrade
        for version in versions
    }
    if database.published():
        again = database.redo(named & database.done(), keep_shown=order.apply)
        database.begin_draft()
    elif not order.fresh:
        database.forget(named)
    database.plan(
        assignments,
        problems,
        {place: [_again(version, again) for version in own] for place, own in planned.items()},
        rules.course or course.name,
        order.policy[1] if order.policy else "",
    )
    done = database.done()
    jobs = {again.get(key, key): _renamed(job, again) for key, job in jobs.items()}
    return Plan([job for key, job in jobs.items() if key not in done], list(again))


def versions_of(
    assignment: Assignment, submissions: Sequence[Submission], counts: Counts
) -> list[tuple[Submission, Mapping[str, SubmittedFile]]]:
    """What a student handed in of one assignment, and with which submission: each time that the
    files are others than the time before. Only the last one if only that can count.

    A submission without any of the files says nothing about the assignment, unless all are so.
    """
    found: list[tuple[Submission, Mapping[str, SubmittedFile]]] = []
    for submission in submissions:
        files = {p: f for p, f in submission.files.items() if p in assignment.owned}
        if files and (not found or files != found[-1][1]):
            found.append((submission, files))
    if not found:
        return [(submissions[-1], {})]
    return found if counts is Counts.BEST else found[-1:]


def _problems(submissions: Sequence[Submission]) -> str | None:
    """What is wrong with a student's submissions as a whole."""
    several = len(submissions) > 1
    told = [
        f"{submission.time:%Y-%m-%d %H:%M:%S} UTC: {submission.problem}"
        if several and submission.time
        else submission.problem
        for submission in submissions
        if submission.problem
    ]
    return "; ".join(told) or None


def _hash(files: Mapping[str, SubmittedFile]) -> str:
    """What a student handed in, whatever it is judged by."""
    parts = [
        f"{path} {file.refusal or ''} {hashlib.sha256(file.content).hexdigest()}"
        for path, file in sorted(files.items())
    ]
    return hashlib.sha256("\n".join(parts).encode("utf-8", "surrogatepass")).hexdigest()


def _again(version: Version, again: Mapping[str, str]) -> Version:
    return replace(version, key=again.get(version.key, version.key))


def _renamed(job: Job, again: Mapping[str, str]) -> Job:
    return replace(job, key=again.get(job.key, job.key))
