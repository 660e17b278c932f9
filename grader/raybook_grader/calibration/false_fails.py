"""How often a right module's picture fails by chance: never, one hopes, in thousands of gradings.

Each scene gets a pool of pictures of right modules, one a seed: half by the reference, the rest
shared out among the alternatives. Gradings on disjoint seeds of the pool are independent; the
others draw their seeds from it at random and are not, but there are more of them.
"""

from __future__ import annotations

import hashlib
import json
import math
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from rich.console import Console

from ..checks.program import Workshop
from ..checks.reference import References
from ..checks.rendering import PICTURE, Picture, picture_of
from ..course import Assignment, ImageCheck, load_course
from ..files import write_text
from ..grading.key import Keys
from ..jobs.pool import Died, run_jobs
from ..jobs.progress import progress
from ..judge.exr import decode_exr
from ..judge.pixels import Image
from ..judge.sequential import sequential_verdict
from ..judge.thresholds import ALL_TILES, THRESHOLDS
from ..kit import load_kit
from ..museum import Exhibit
from ..sandbox import Box
from ..submissions import SubmittedFile

POOL = 400
"""Pictures of right modules for each check at least, the alternatives' and the reference's."""
DRAWN = 130
"""Gradings for each check whose seeds are drawn from the pool."""
_POOL_SEED = 5_000_000
"""Far from every seed that anything else uses."""

Pictures = Mapping[int, NDArray[np.float32]]


@dataclass(frozen=True)
class Trial:
    """An image check with the right modules to try it on, the reference first."""

    assignment: str
    check: ImageCheck
    right: tuple[Exhibit, ...]

    @property
    def name(self) -> str:
        return f"{self.assignment} {self.check.name}"


@dataclass(frozen=True)
class Count:
    """Gradings of right pictures and how many of them failed."""

    disjoint: int
    disjoint_failed: int
    drawn: int
    drawn_failed: int
    pool: int

    @property
    def gradings(self) -> int:
        return self.disjoint + self.drawn

    @property
    def failed(self) -> int:
        return self.disjoint_failed + self.drawn_failed


def trials_of(
    assignments: Sequence[Assignment], exhibits: Mapping[str, Sequence[Exhibit]]
) -> list[Trial]:
    """One for each image check."""
    return [
        Trial(a.number, check, tuple(e for e in exhibits[a.number] if e.is_right))
        for a in assignments
        for check in a.checks
        if isinstance(check, ImageCheck)
    ]


def count_false_fails(
    root: Path, kit: Path, trials: Sequence[Trial], jobs: int, console: Console
) -> dict[str, Count]:
    """The counts by the trial's name; a trial that was counted before is not counted again."""
    counts: dict[str, Count] = {}
    with progress(console, "grading right pictures", len(trials)) as bar:
        for trial, outcome in run_jobs(trials, Counter(root, kit), jobs):
            if isinstance(outcome, Died):
                raise RuntimeError(f"{trial.name}: {outcome.message}")
            counts[trial.name] = outcome
            bar.advance()
    return counts


@dataclass(frozen=True)
class Counter:
    """What a worker process is made from; calling it gives the function that counts."""

    root: Path
    kit: Path

    def __call__(self) -> Callable[[Trial], Count]:
        workshop = Workshop(load_course(self.root), load_kit(self.kit), Box())
        return lambda trial: _kept(workshop, References(workshop), trial)


def _kept(workshop: Workshop, references: References, trial: Trial) -> Count:
    assignment = workshop.course.assignment(trial.assignment)
    keys = Keys(workshop.course, workshop.kit)
    made_from = [
        keys.judged(assignment, {p: SubmittedFile(c) for p, c in e.files.items()})
        for e in trial.right
    ]
    text = repr((made_from, trial.check, POOL, DRAWN, _POOL_SEED))
    name = hashlib.sha256(text.encode()).hexdigest()[:32]
    file = workshop.course.root / "build" / "calibration" / "chance" / f"{name}.json"
    if file.is_file():
        return Count(**json.loads(file.read_text(encoding="utf-8")))
    count = _count(workshop, references, trial)
    file.parent.mkdir(parents=True, exist_ok=True)
    write_text(file, json.dumps(asdict(count)))
    return count


def _count(workshop: Workshop, references: References, trial: Trial) -> Count:
    picture = picture_of(trial.check)
    size = 2 * trial.check.seeds
    disjoint = drawn = disjoint_failed = drawn_failed = 0
    rng = np.random.default_rng(1)
    shares = shares_of(len(trial.right), size)
    first = _POOL_SEED
    for exhibit, share in zip(trial.right, shares, strict=True):
        seeds = range(first, first + share)
        first += share
        pool = dict(zip(seeds, _render(workshop, trial, exhibit, picture, seeds), strict=True))
        # The reference is no twin of itself: paired with it, nothing could ever fail.
        twins = None if exhibit is trial.right[0] else _reference(workshop, trial, picture, seeds)
        for at in disjoint_gradings(seeds, size):
            disjoint += 1
            disjoint_failed += _fails(references, trial, picture, pool, twins, at)
        for _ in range(math.ceil(DRAWN * share / POOL)):
            at = rng.choice(np.asarray(seeds), size, replace=False).tolist()
            drawn += 1
            drawn_failed += _fails(references, trial, picture, pool, twins, at)
    return Count(disjoint, disjoint_failed, drawn, drawn_failed, first - _POOL_SEED)


def shares_of(count: int, size: int) -> list[int]:
    """How many seeds each of ``count`` right modules gets, in whole gradings of ``size`` seeds;
    the reference, the first, gets half. Together at least `POOL`."""
    if count == 1:
        return [_whole(POOL, size)]
    half = _whole(POOL / 2, size)
    return [half, *[_whole((POOL - half) / (count - 1), size)] * (count - 1)]


def _whole(seeds: float, size: int) -> int:
    return math.ceil(seeds / size) * size


def disjoint_gradings(seeds: range, size: int) -> Iterator[list[int]]:
    for start in range(0, len(seeds) - size + 1, size):
        yield list(seeds[start : start + size])


def _fails(
    references: References,
    trial: Trial,
    picture: Picture,
    pool: Pictures,
    twins: Pictures | None,
    seeds: Sequence[int],
) -> bool:
    """One grading as the check does it: a second look where the first one fails."""
    n = trial.check.seeds
    said = sequential_verdict(
        lambda at: [pool[seed] for seed in at],
        references.statistics(picture),
        trial.check.spp,
        tile_sizes=ALL_TILES,
        thresholds=THRESHOLDS,
        seeds=seeds[:n],
        fresh_seeds=seeds[n:],
        reference_renders=None if twins is None else lambda at: [twins[seed] for seed in at],
    )
    return said.status == "fail"


def _reference(
    workshop: Workshop, trial: Trial, picture: Picture, seeds: range
) -> dict[int, NDArray[np.float32]]:
    images = _render(workshop, trial, trial.right[0], picture, seeds)
    return dict(zip(seeds, images, strict=True))


def _render(
    workshop: Workshop, trial: Trial, exhibit: Exhibit, picture: Picture, seeds: range
) -> list[Image]:
    """The module's own pictures. It is the course's own and right: so without the box, which
    would take longer than a small picture does."""
    course = workshop.course
    module = workshop.compile_module(course.assignment(trial.assignment), exhibit.files)
    images = []
    with tempfile.TemporaryDirectory(prefix="calibration") as scratch:
        program = Path(scratch, "program")
        program.write_bytes(workshop.renderer(module))
        program.chmod(0o755)
        for seed in seeds:
            arguments = picture.arguments(seed, scene=course.root / picture.scene)
            subprocess.run([program, *arguments], cwd=scratch, check=True, capture_output=True)
            images.append(decode_exr(Path(scratch, PICTURE).read_bytes()).pixels)
    return images
