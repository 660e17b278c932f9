"""Judging exhibits with the grader's own checks, and comparing what fails with what should."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from rich.console import Console

from ..checks.program import Workshop
from ..checks.reference import References
from ..checks.result import NO_FAULT, CheckResult, Status
from ..course import Assignment, Course, ImageCheck, UnitCheck, load_course
from ..grading.module import ModuleGrader
from ..grading.result import ModuleResult
from ..jobs.pool import Died, run_jobs
from ..jobs.progress import progress
from ..kit import load_kit
from ..sandbox import make_box
from ..submissions import SubmittedFile
from .exhibits import Exhibit


@dataclass(frozen=True)
class Visit:
    """What the checks said of one exhibit. ``announced`` and ``failed`` are names of checks."""

    exhibit: Exhibit
    result: ModuleResult
    announced: frozenset[str]
    failed: frozenset[str]
    public: frozenset[str]
    """Those of ``failed`` that students have, too."""

    @property
    def as_announced(self) -> bool:
        return self.announced == self.failed and self.result.verdict != "internal-error"


def with_museum(course: Course) -> list[Assignment]:
    """The graded assignments that have exhibits."""
    return [a for a in course.assignments if a.is_graded and (a.folder / "mistakes").is_dir()]


def without_images(assignment: Assignment) -> Assignment:
    """The assignment with the checks that take milliseconds, not minutes."""
    kept = tuple(check for check in assignment.checks if not isinstance(check, ImageCheck))
    return replace(assignment, checks=kept)


@dataclass(frozen=True)
class Visitor:
    """What a worker process is made from; calling it gives the function that visits."""

    root: Path
    kit: Path
    images: bool
    unsafe: bool = False

    def __call__(self) -> Callable[[Exhibit], Visit]:
        course = load_course(self.root)
        workshop = Workshop(course, load_kit(self.kit), make_box(self.unsafe))
        grader = ModuleGrader(workshop, References(workshop))
        assignments = {
            a.number: a if self.images else without_images(a) for a in with_museum(course)
        }
        return lambda exhibit: visit(grader, assignments[exhibit.assignment], exhibit)


def visit(grader: ModuleGrader, assignment: Assignment, exhibit: Exhibit) -> Visit:
    """Judge one exhibit by the checks of ``assignment``."""
    files = {path: SubmittedFile(content) for path, content in exhibit.files.items()}
    result = grader.grade(assignment, files)
    names = {check.name for check in assignment.checks}
    announced = exhibit.label.expect if exhibit.label else ()
    public = {check.name for check in assignment.checks if isinstance(check, UnitCheck)}
    failed = frozenset(faults(exhibit, result.checks))
    return Visit(exhibit, result, frozenset(announced) & names, failed, failed & public)


def faults(exhibit: Exhibit, checks: Iterable[CheckResult]) -> Iterator[str]:
    """The names of the checks that found something wrong.

    A picture that is only noisier, and right code that is only slow, lose points but are not wrong.
    """
    for check in checks:
        tolerant = check.kind == "image" or (exhibit.is_right and check.kind == "cost")
        tolerated = tolerant and check.status is Status.PARTIAL
        if check.status not in NO_FAULT and not tolerated:
            yield check.name


def visit_all(
    visitor: Visitor, exhibits: list[Exhibit], jobs: int, console: Console
) -> dict[str, Visit]:
    """The visits by the exhibit's name."""
    visits: dict[str, Visit] = {}
    with progress(console, "museum", len(exhibits)) as bar:
        for exhibit, outcome in run_jobs(exhibits, visitor, jobs):
            if isinstance(outcome, Died):
                raise RuntimeError(f"{exhibit.name}: {outcome.message}")
            visits[exhibit.name] = outcome
            bar.advance()
    return visits
