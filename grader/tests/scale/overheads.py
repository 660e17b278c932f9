"""What a job costs besides its grading: measured with a real scheduler and a real database.

Processor time of the processes that do it, so that other work on this machine does not count.
"""

from __future__ import annotations

import os
import resource
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cluster"))
from local_cluster import LocalCluster
from model import Overheads
from workers import Sleeper

from raybook_grader.checks.reference import References
from raybook_grader.course import load_course
from raybook_grader.database import Database
from raybook_grader.grading.job import Worker
from raybook_grader.grading.module import ModuleGrader
from raybook_grader.grading.result import ModuleResult
from raybook_grader.jobs.cluster import run_on_cluster
from raybook_grader.museum import exhibits_of
from raybook_grader.submissions import SubmittedFile

HERE = Path(__file__).parent
_JOBS = 600
_STORED = 200
_TYPICAL = "07"


@dataclass(frozen=True)
class Measured:
    """Seconds a job, by the size of its result, and what a stored result takes on the disk."""

    overheads: Overheads
    result_bytes: int
    stored_bytes: int
    trivial_scheduler: float
    trivial_take: float
    trivial_rate: float


def measure(root: Path) -> Measured:
    """Measure on this machine, for about a minute."""
    size = _size(result := typical_result(root))
    with tempfile.TemporaryDirectory(prefix="raybook-") as scratch:
        store, stored = _store(result, Path(scratch, "database"))
        with cluster_of(Path(scratch), 2) as cluster:
            list(run_on_cluster(_jobs(20), Sleeper(0), cluster.address, _quiet))
            scheduler0, take0, wall0 = _trivial(cluster, 0)
            scheduler, take, _ = _trivial(cluster, size)
    latency = max(wall0 * 2 - scheduler0 - take0, 0.0) / 2
    over = Overheads(scheduler, take, store, latency)
    return Measured(over, size, stored, scheduler0, take0, 1 / wall0)


def cluster_of(folder: Path, workers: int) -> LocalCluster:
    """A local cluster that knows this folder's modules."""
    cluster = LocalCluster(folder / f"cluster-{workers}", {"PYTHONPATH": str(HERE)})
    for _ in range(workers):
        cluster.add_worker()
    return cluster


def typical_result(root: Path) -> ModuleResult:
    """A result with its pictures."""
    assignment = load_course(root).assignment(_TYPICAL)
    files = {p: SubmittedFile(c) for p, c in exhibits_of(root, assignment)[0].files.items()}
    workshop = Worker(root, root / "build" / "kit").workshop()
    return ModuleGrader(workshop, References(workshop)).grade(assignment, files)


def _size(result: ModuleResult) -> int:
    return sum(len(check.picture.encode()) for check in result.checks)


def _store(result: ModuleResult, folder: Path) -> tuple[float, int]:
    """Seconds and bytes of a result in the database."""
    folder.mkdir()
    database = Database(folder, "course")
    begun = time.process_time()
    for i in range(_STORED):
        database.store(f"{i:064x}", result, final=True)
    seconds = (time.process_time() - begun) / _STORED
    database.close()
    return seconds, sum(p.stat().st_size for p in folder.iterdir()) // _STORED


def _trivial(cluster: LocalCluster, size: int) -> tuple[float, float, float]:
    """Jobs that take no time: seconds a job of the scheduler, of the client, and on the clock."""
    scheduler, client, begun = _cpu(cluster.scheduler_pid), _own(), time.monotonic()
    for _ in run_on_cluster(_jobs(_JOBS), Sleeper(size), cluster.address, _quiet):
        pass
    return (
        (_cpu(cluster.scheduler_pid) - scheduler) / _JOBS,
        (_own() - client) / _JOBS,
        (time.monotonic() - begun) / _JOBS,
    )


def _jobs(count: int) -> list[tuple[int, float]]:
    return [(i, 0.0) for i in range(count)]


def _own() -> float:
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def _cpu(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _quiet(line: str) -> None:
    pass
