"""Grading a class: plan, do what is not done yet, export and report."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path

from rich.console import Console

from ..checks.program import HarnessFault
from ..checks.reference import References
from ..checks.shipping import pictures_of
from ..course import Course
from ..database import Database, Module, Student
from ..files import sweep
from ..jobs.pool import Died
from ..jobs.progress import Progressing, progress
from ..policy import Policy
from ..reports import INDEX, STUDENTS, write_reports
from ..scoring import Verdict
from ..submissions import Submission, find_submissions
from .agree import agree
from .changes import changes, internal_errors, snapshot
from .export import NAME as GRADES
from .export import write_grades
from .job import Job, Worker
from .learn import learn
from .lock import alone_in
from .notes import policy_lines
from .place import run_where_ordered
from .plan import Order, choose_assignments, plan, refuse_unknown
from .result import ModuleResult, internal_error
from .totals import totals
from .waiting import Waiting


@dataclass(frozen=True)
class Outcome:
    """How a run ended: how many modules the harness failed in, and where the results are.

    ``is_held``: they are still the earlier ones, for nobody has agreed to the changes.
    """

    internal_errors: int
    grades: Path
    report: Path
    is_held: bool = False


def grade_class(course: Course, worker: Worker, order: Order, console: Console) -> Outcome:
    """Grade a class. A KeyboardInterrupt passes through; what is done by then is kept."""
    assignments = choose_assignments(course, order.assignments, console)
    owned = [path for assignment in assignments for path in assignment.owned]
    rules = order.rules(course)
    submissions, ignored = find_submissions(order.submissions, owned, rules.zone)
    refuse_unknown(order.regrade, submissions)
    with alone_in(order.out), closing(Database(order.out, course.name)) as database:
        _sweep(order.out)
        before = snapshot(database)
        planned = plan(course, worker, order, assignments, submissions, database)
        jobs = planned.jobs
        _introduce(console, order, rules, submissions, ignored, jobs, database)
        if jobs:
            _prepare(worker, {job.assignment for job in jobs}, console)
            learn(worker, {job.assignment for job in jobs}, order.workers, console)
        _do(jobs, worker, order, database, console)
        after = snapshot(database)
        outcome = Outcome(internal_errors(after), order.out / GRADES, order.out / INDEX)
        agreed = agree(list(changes(before, after)), order, database.published(), console)
        if not agreed:
            database.drop_draft(shown=planned.redone)
            return replace(outcome, is_held=True)
        database.publish()
        write_grades(database, order.out)
        write_reports(database, order.out)
    return outcome


def _sweep(out: Path) -> None:
    """Remove what a killed run was writing: next to the grades, the students' pages, and the pages
    of each student's modules."""
    students = out / STUDENTS
    folders = [path for path in students.glob("*") if path.is_dir() and not path.is_symlink()]
    for folder in (out, students, *folders):
        sweep(folder)


def _introduce(
    console: Console,
    order: Order,
    rules: Policy,
    submissions: Sequence[Submission],
    ignored: Sequence[str],
    jobs: Sequence[Job],
    database: Database,
) -> None:
    """Say what there is and what is left to do."""
    say = progress(console, "", 0).say
    if ignored:
        say(f"{order.submissions}: passed over, neither folder nor archive: {', '.join(ignored)}")
    for submission in submissions:
        if submission.problem:
            say(f"{submission.id}: {submission.problem}")
    for line in policy_lines(order.policy, rules, submissions):
        say(line)
    waiting = database.waiting()
    modules = sum(len(numbers) for numbers in waiting.values())
    same = f", {len(jobs)} of them different" if len(jobs) < modules else ""
    say(f"{len(submissions)} submissions; {modules} modules to grade{same}")


def _prepare(worker: Worker, numbers: Collection[str], console: Console) -> None:
    """Render the references that are not there yet, on all cores, before the workers need them."""
    workshop = worker.workshop()
    references = References(workshop)
    needed = [a for a in workshop.course.assignments if a.number in numbers]
    for picture in pictures_of(needed):
        if references.is_ready(picture):
            continue
        say = progress(console, "", 0).say
        say(f"rendering the reference of {picture.scene}, once")
        try:
            references.statistics(picture)
        except HarnessFault as fault:
            say(f"{fault}\nmodules that need it will be told as internal errors")


def _do(
    jobs: Sequence[Job], worker: Worker, order: Order, database: Database, console: Console
) -> None:
    waiting = Waiting(database.waiting())
    with (
        progress(console, "grading", len(jobs)) as bar,
        closing(run_where_ordered(jobs, worker, order, bar.say)) as done,
    ):
        for job, outcome in done:
            result = _result(outcome)
            database.store(job.key, result, final=result.verdict is not Verdict.INTERNAL_ERROR)
            bar.advance()
            for name in waiting.finish(job.key):
                _tell(database.student(name), database.modules(), bar)


def _result(outcome: ModuleResult | Died) -> ModuleResult:
    if isinstance(outcome, ModuleResult):
        return outcome
    return internal_error("the grader failed here; this is not your doing", outcome.message)


def _tell(student: Student, modules: Sequence[Module], bar: Progressing) -> None:
    """One line for a submission that is finished."""
    sums = totals(student, modules)
    points = "no total" if sums.score is None else f"{sums.score:g} of {sums.max_score:g}"
    verdicts = {m: student.results.get(m.number) for m in modules}
    words = [f"{m.number} {m.module}: {r.verdict}" for m, r in verdicts.items() if r is not None]
    bar.say(f"{student.id}  {points}  ({', '.join(words)})")
