"""Judging exhibits with all checks, each once: what is known is kept under `build/calibration/`."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from rich.console import Console

from ..checks.program import Workshop
from ..checks.reference import References
from ..course import Assignment, ImageCheck, load_course
from ..files import write_text
from ..grading.key import Keys
from ..grading.module import ModuleGrader
from ..grading.result import ModuleResult
from ..jobs.pool import Died, run_jobs
from ..jobs.progress import progress
from ..kit import Kit, load_kit
from ..museum import Exhibit
from ..sandbox import Box
from ..submissions import SubmittedFile

REPEAT_STEP = 100_000
"""Between the seeds of one verdict on a picture and those of the next."""


@dataclass(frozen=True)
class Compiler:
    """What the students' modules are compiled with; None: as the kit was."""

    cc: str | None = None
    optimisation: str | None = None

    @property
    def name(self) -> str:
        """Of the folder for its table: "", "clang", "-O0", "clang-O0"; "" is the kit's."""
        return Path(self.cc or "").name + (self.optimisation or "")

    def apply(self, kit: Kit) -> Kit:
        """The kit for modules; the reference's objects stay what they are."""
        level = self.optimisation
        flags = [f for f in kit.cflags if level is None or not f.startswith("-O")]
        cflags = tuple(flags if level is None else [*flags, level])
        return replace(kit, cc=self.cc or kit.cc, cflags=cflags)


@dataclass(frozen=True)
class Task:
    """An exhibit to judge; ``look`` counts the verdicts on its pictures, each on other seeds."""

    exhibit: Exhibit
    look: int = 0

    @property
    def name(self) -> str:
        return f"{self.exhibit.name} #{self.look}"


@dataclass(frozen=True)
class Bench:
    """What a worker process is made from; calling it gives the function that judges."""

    root: Path
    kit: Path
    compiler: Compiler

    def __call__(self) -> Callable[[Task], ModuleResult]:
        course, kit = load_course(self.root), load_kit(self.kit)
        references = References(Workshop(course, kit, Box()))
        workshop = Workshop(course, self.compiler.apply(kit), Box())
        grader = ModuleGrader(workshop, references)
        keys = Keys(course, kit)
        return lambda task: self._judge(grader, keys, task)

    def _judge(self, grader: ModuleGrader, keys: Keys, task: Task) -> ModuleResult:
        exhibit = task.exhibit
        assignment = grader.workshop.course.assignment(exhibit.assignment)
        files = {path: SubmittedFile(content) for path, content in exhibit.files.items()}
        made_from = (keys.judged(assignment, files), self.compiler, task.look)
        name = hashlib.sha256(repr(made_from).encode()).hexdigest()[:32]
        file = self.root / "build" / "calibration" / "judged" / f"{name}.json"
        if file.is_file():
            return ModuleResult.from_json(json.loads(file.read_text(encoding="utf-8")))
        result = grader.grade(moved(assignment, task.look), files).without_pictures()
        if not result.traceback:
            file.parent.mkdir(parents=True, exist_ok=True)
            write_text(file, json.dumps(result.to_json()))
        return result


def moved(assignment: Assignment, look: int) -> Assignment:
    """The assignment with its pictures judged on other seeds; after the first look on them only."""
    if look == 0:
        return assignment
    first = 1 + REPEAT_STEP * look
    pictures = [check for check in assignment.checks if isinstance(check, ImageCheck)]
    return replace(assignment, checks=tuple(replace(c, first_seed=first) for c in pictures))


def judge_all(
    bench: Bench, tasks: Sequence[Task], jobs: int, console: Console
) -> dict[str, ModuleResult]:
    """The results by the task's name."""
    return dict(_judged(bench, tasks, jobs, console))


def _judged(
    bench: Bench, tasks: Iterable[Task], jobs: int, console: Console
) -> Iterator[tuple[str, ModuleResult]]:
    waiting = list(tasks)
    with progress(console, "judging the museum", len(waiting)) as bar:
        for task, outcome in run_jobs(waiting, bench, jobs):
            if isinstance(outcome, Died):
                raise RuntimeError(f"{task.name}: {outcome.message}")
            bar.advance()
            yield task.name, outcome
