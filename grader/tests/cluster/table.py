"""The Dask table: the same class graded here, by two workers, with one killed, with one late.

    build/venv/bin/python grader/tests/cluster/table.py

grades a small class by the real command and a real scheduler on this machine, each time into a new
folder, and compares `grades.json` byte for byte with the local pool's. Exit code 1 if one differs,
if a job was graded twice into the results, or if a kill was not noticed.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from local_cluster import LocalCluster
from rich.console import Console
from rich.table import Table

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "grade"))
from make_class import make_class
from small_course import command, done, small_course

_LOST = re.compile(r"cluster: (\d+) workers, (\d+) jobs done, (\d+) times")
_SLOW = "never-ends"
"""A submission that only shows the time limits; they are tested elsewhere."""


@dataclass(frozen=True)
class Row:
    """What one way of grading came to."""

    name: str
    workers: str
    lost: str
    results: int
    same: bool
    expected_losses: int

    @property
    def ok(self) -> bool:
        return self.same and self.lost == str(self.expected_losses)


@dataclass(frozen=True)
class Class:
    """The small course, its class, and where the results go."""

    course: Path
    submissions: Path
    folder: Path

    def grade(self, out: str, *more: str) -> subprocess.Popen[str]:
        return subprocess.Popen(
            command("grade", self.submissions, "--out", self.folder / out,
                    "--course", self.course, *more),
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        )  # fmt: skip

    def grades(self, out: str) -> bytes:
        return (self.folder / out / "grades.json").read_bytes()


Disturb = Callable[[LocalCluster], None]


def kill_one(cluster: LocalCluster) -> None:
    cluster.kill_in_mid_job(0)


def kill_and_replace(cluster: LocalCluster) -> None:
    cluster.kill_in_mid_job(0)
    cluster.add_worker()
    cluster.kill_in_mid_job(1)


def join_late(cluster: LocalCluster) -> None:
    cluster.wait_for_a_job(0)
    cluster.add_worker()


WAYS: tuple[tuple[str, int, Disturb | None, int], ...] = (
    ("2 workers", 2, None, 0),
    ("2 workers, one killed in mid-job", 2, kill_one, 1),
    ("2 workers, both killed in mid-job, one more joins", 2, kill_and_replace, 2),
    ("1 worker, one more joins late", 1, join_late, 0),
)
"""Name, workers at the start, what happens on the way, and the jobs that are lost by it."""


def on_cluster(some: Class, name: str, workers: int, disturb: Disturb | None, losses: int) -> Row:
    """Grade the class on a cluster of its own."""
    out = name.replace(" ", "-")
    with LocalCluster(some.folder / f"cluster-{out}") as cluster:
        for _ in range(workers):
            cluster.add_worker()
        grading = some.grade(out, "--scheduler", cluster.address)
        if disturb is not None:
            disturb(cluster)
        said, _ = grading.communicate()
        if grading.returncode:
            raise SystemExit(f"{name}: exit code {grading.returncode}\n{said}\n{cluster.said()}")
    found = _LOST.search(said)
    met, lost = (found[1], found[3]) if found else ("?", "?")
    same = some.grades(out) == some.grades("local")
    return Row(name, met, lost, len(done(some.folder / out)), same, losses)


def main() -> int:
    """Print the table."""
    with tempfile.TemporaryDirectory(prefix="raybook-") as scratch:
        folder = Path(scratch)
        submissions = folder / "submissions"
        make_class(submissions)
        shutil.rmtree(submissions / _SLOW)
        some = Class(small_course(folder / "course"), submissions, folder)
        said, _ = (local := some.grade("local")).communicate()
        if local.returncode:
            raise SystemExit(said)
        begun = time.monotonic()
        rows = [Row("local pool", "-", "0", len(done(folder / "local")), True, 0)]
        rows += [on_cluster(some, *way) for way in WAYS]
        print(f"{len(list(submissions.iterdir()))} submissions, {time.monotonic() - begun:.0f} s")
    return report(rows)


def report(rows: list[Row]) -> int:
    table = Table("graded by", "workers met", "jobs lost and done again", "results", "same grades")
    for row in rows:
        same = "yes" if row.same else "NO"
        table.add_row(row.name, row.workers, row.lost, str(row.results), same)
    Console(width=100).print(table)
    good = all(row.ok and row.results == rows[0].results for row in rows)
    print("all as expected" if good else "NOT AS EXPECTED")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
