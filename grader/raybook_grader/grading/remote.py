"""A worker process on another machine: its own checkout, kit and box, which must be as ours are."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection
from dataclasses import dataclass
from pathlib import Path

from ..checks.reference import References
from ..checks.shipping import pictures_of
from ..course import Assignment, load_course
from ..errors import BadInput
from ..kit import load_kit
from ..sandbox import require
from .job import Job, Worker
from .key import Keys, grader_version
from .result import ModuleResult
from .stamp import Stamp, stamp

COURSE = "RAYBOOK_COURSE"
"""Where a worker's checkout is, if not at our path or around its own program."""
_OWN_CHECKOUT = Path(__file__).resolve().parents[3]
_AT_START = grader_version()
"""What this process runs, whatever is written over its files later."""


@dataclass(frozen=True)
class RemoteWorker:
    """As `Worker`, for a process that may be anywhere: calling it there gives the function that
    does a job, or raises what stands against it."""

    worker: Worker
    stamp: Stamp

    @classmethod
    def of(cls, worker: Worker, numbers: Collection[str]) -> RemoteWorker:
        """For jobs of these assignments; everything that they need must have been made ready."""
        if worker.unsafe:
            raise BadInput("--unsafe is for this machine alone, expected no --scheduler with it")
        course, kit = load_course(worker.root), load_kit(worker.kit)
        keys = Keys(course, kit)
        return cls(worker, stamp(keys, kit, [a for a in course.assignments if a.number in numbers]))

    def __call__(self) -> Callable[[Job], ModuleResult]:
        require()
        here = self._here()
        course, kit = load_course(here.root), load_kit(here.kit)
        numbers = {number for number, _ in self.stamp.assignments}
        assignments = [a for a in course.assignments if a.number in numbers]
        keys = Keys(course, kit)
        if keys.grader != _AT_START:
            raise BadInput("the grader was changed since this worker was started; start it again")
        difference = self.stamp.difference(stamp(keys, kit, assignments))
        if difference:
            raise BadInput(f"{here.root} is not what is graded with: {difference}")
        _require_ready(here, keys, assignments)
        return here()

    def _here(self) -> Worker:
        """The places on this machine."""
        named = os.environ.get(COURSE)
        if named:
            return Worker(Path(named), Path(named, "build", "kit"))
        if self.worker.root.is_dir() and self.worker.kit.is_dir():
            return Worker(self.worker.root, self.worker.kit)
        return Worker(_OWN_CHECKOUT, _OWN_CHECKOUT / "build" / "kit")


def _require_ready(here: Worker, keys: Keys, assignments: Collection[Assignment]) -> None:
    """Every worker could make these, but all of them at once would take long."""
    references = References(here.workshop())
    missing = [p.scene for p in pictures_of(assignments) if not references.is_ready(p)]
    files = [keys.known_file(a) for a in assignments]
    missing += [str(file.relative_to(here.root)) for file in files if not file.is_file()]
    if missing:
        raise BadInput(
            f"{here.root / 'build'} lacks what the run has made ready ({', '.join(missing)}): "
            "copy build/reference and build/diagnosis again"
        )
