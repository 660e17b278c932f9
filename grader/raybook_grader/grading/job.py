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
from .result import ModuleResult, internal_error

_REPLACED = (
    "the reference was built anew while this was graded with it; this is not your doing. "
    "The same command grades it again"
)


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
        # Its files are looked at once; what is graded with another kit than this is thrown away.
        box = make_box(self.unsafe, [kit.include, kit.folder / "objects"])
        return Workshop(load_course(self.root), kit, box)

    def __call__(self) -> Callable[[Job], ModuleResult]:
        seen = _seen(self.kit)
        workshop = self.workshop()
        keys = Keys(workshop.course, workshop.kit, self.unsafe)
        known = cache(lambda assignment: load_known(keys.known_file(assignment)))
        grader = ModuleGrader(workshop, References(workshop), known)

        def grade(job: Job) -> ModuleResult:
            assignment = workshop.course.assignment(job.assignment)
            result = grader.grade(assignment, job.files)
            # A program linked while the kit's files go away may miss some: that says nothing
            # about a student. The key of work that is done again goes on after this one.
            meant = job.key.startswith(keys.key(assignment, job.files))
            if _seen(self.kit) != seen or not meant:
                return internal_error(_REPLACED, f"{self.kit} is not what it was")
            return replace(result, unsafe=self.unsafe)

        return grade


def _seen(kit: Path) -> tuple[int, int] | None:
    """What tells this kit from the next that `make kit` puts in its place."""
    try:
        found = (kit / "kit.json").stat()
    except FileNotFoundError:
        return None
    return found.st_ino, found.st_ctime_ns
