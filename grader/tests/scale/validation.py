"""The model's predictions against real runs on this machine."""

from __future__ import annotations

import random
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from durations import Duration
from model import Overheads, simulate
from overheads import cluster_of
from workers import Grader, Module, Sleeper

from raybook_grader.course import load_course
from raybook_grader.grading.job import Worker
from raybook_grader.jobs.cluster import run_on_cluster
from raybook_grader.jobs.pool import Died
from raybook_grader.museum import reference_of

_LONGEST = 10.0
_SLEEPS, _SHRUNK = 240, 20.0


@dataclass(frozen=True)
class Comparison:
    """``slowdown``: what a job took on the clock for each second of its processor time, because
    other programs ran on this machine; the prediction takes it into account."""

    what: str
    workers: int
    predicted_seconds: float
    measured_seconds: float
    slowdown: float

    @property
    def ratio(self) -> float:
        return self.measured_seconds / self.predicted_seconds


def real_jobs(
    root: Path, measured: Sequence[Duration], over: Overheads, workers: int
) -> Comparison:
    """Grade the reference of each assignment that takes seconds."""
    seconds = {d.name: d.cpu_seconds for d in measured if d.cpu_seconds < _LONGEST}
    references = [reference_of(root, a) for a in load_course(root).assignments if a.sources]
    jobs = [Module(e.name, e.assignment, e.files) for e in references if e.name in seconds]
    taken, wall = _run(Grader(Worker(root, root / "build" / "kit")), jobs, workers)
    slowdown = sum(taken.values()) / sum(seconds[job.name] for job in jobs)
    durations = [seconds[job.name] * slowdown for job in jobs]
    predicted = simulate(durations, workers, replace(over, store=0.0)).seconds
    return Comparison(f"grading {len(jobs)} modules", workers, predicted, wall, slowdown)


def sleeping_jobs(durations: Sequence[float], over: Overheads, workers: int) -> Comparison:
    """Jobs that sleep need no processor: more workers than this machine has cores."""
    shrunk = [d / _SHRUNK for d in random.Random(2).sample(durations, _SLEEPS)]
    _, wall = _run(Sleeper(0), list(enumerate(shrunk)), workers)
    predicted = simulate(shrunk, workers, replace(over, store=0.0)).seconds
    return Comparison(f"{_SLEEPS} sleeping jobs", workers, predicted, wall, 1.0)


def _run(
    make: Callable[[], Callable[[Any], Any]], jobs: Sequence[Any], workers: int
) -> tuple[dict[str, float], float]:
    """What each job took in its worker, and all of them here, once the workers are ready."""
    taken = {}
    with (
        tempfile.TemporaryDirectory(prefix="raybook-") as scratch,
        cluster_of(Path(scratch), workers) as cluster,
    ):
        warm = [(i, 0.5) for i in range(2 * workers)]
        list(run_on_cluster(warm, Sleeper(0), cluster.address, _quiet))
        begun = time.monotonic()
        for job, result in run_on_cluster(jobs, make, cluster.address, _quiet):
            assert not isinstance(result, Died), result
            taken[getattr(job, "name", str(job))] = result
        return taken, time.monotonic() - begun


def _quiet(line: str) -> None:
    pass
