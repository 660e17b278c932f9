"""The unit of work: pure, so that it may run anywhere, and twice."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from ..checks.program import Workshop
from ..checks.reference import References
from ..course import load_course
from ..diagnosis import load_known
from ..kit import load_kit
from ..sandbox import make_box
from ..submissions import SubmittedFile
from .key import Keys
from .module import ModuleGrader
from .result import ModuleResult


@dataclass(frozen=True)
class Job:
    """One module to grade; ``key`` names what comes of it."""

    key: str
    assignment: str
    files: Mapping[str, SubmittedFile]


@dataclass(frozen=True)
class Worker:
    """What a worker process is made from: calling it gives the function that does a job."""

    root: Path
    kit: Path
    unsafe: bool = False
    """Whether students' code runs without walls, because this machine cannot make them."""

    def workshop(self) -> Workshop:
        kit = load_kit(self.kit)
        # Nobody makes the kit anew in the middle of a run: its files are looked at once.
        box = make_box(self.unsafe, [kit.include, kit.folder / "objects"])
        return Workshop(load_course(self.root), kit, box)

    def __call__(self) -> Callable[[Job], ModuleResult]:
        workshop = self.workshop()
        keys = Keys(workshop.course, workshop.kit, self.unsafe)
        known = cache(lambda assignment: load_known(keys.known_file(assignment)))
        grader = ModuleGrader(workshop, References(workshop), known)

        def grade(job: Job) -> ModuleResult:
            result = grader.grade(workshop.course.assignment(job.assignment), job.files)
            return replace(result, unsafe=self.unsafe)

        return grade
