"""What the workers of the measurements do; found by name in their processes."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from raybook_grader.checks.reference import References
from raybook_grader.grading.job import Worker
from raybook_grader.grading.module import ModuleGrader
from raybook_grader.submissions import SubmittedFile


@dataclass(frozen=True)
class Sleeper:
    """Sleeps as long as it is told, and answers with so many bytes."""

    size: int

    def __call__(self) -> Callable[[tuple[int, float]], bytes]:
        def work(job: tuple[int, float]) -> bytes:
            time.sleep(job[1])
            return bytes(self.size)

        return work


@dataclass(frozen=True)
class Module:
    """A module to grade."""

    name: str
    assignment: str
    files: Mapping[str, bytes]


@dataclass(frozen=True)
class Grader:
    """Grades modules without a diagnosis; answers with the seconds that each took."""

    worker: Worker

    def __call__(self) -> Callable[[Module], float]:
        workshop = self.worker.workshop()
        grader = ModuleGrader(workshop, References(workshop))

        def work(job: Module) -> float:
            files = {path: SubmittedFile(content) for path, content in job.files.items()}
            begun = time.monotonic()
            grader.grade(workshop.course.assignment(job.assignment), files)
            return time.monotonic() - begun

        return work
