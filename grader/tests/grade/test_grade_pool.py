"""The pool of workers: every job comes back, and a death costs only its own job."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest

from raybook_grader.jobs.pool import Died, run_jobs


def doubler() -> Callable[[int], int]:
    def work(job: int) -> int:
        if job < 0:
            os._exit(7)
        return 2 * job

    return work


def recorder() -> Callable[[str], int]:
    def work(job: str) -> int:
        Path(job).touch()
        return os.getpid()

    return work


@pytest.mark.parametrize("workers", [1, 3])
def test_every_job_comes_back_once(workers: int) -> None:
    assert sorted(run_jobs(range(10), doubler, workers)) == [(i, 2 * i) for i in range(10)]


def test_no_jobs() -> None:
    assert list(run_jobs([], doubler, 2)) == []


def test_a_death_costs_its_own_job_only() -> None:
    found = dict(run_jobs([1, -1, 2, -2, 3], doubler, 2))
    assert {job: found[job] for job in (1, 2, 3)} == {1: 2, 2: 4, 3: 6}
    assert found[-1] == found[-2] == Died("the worker process ended with code 7")


def test_closing_stops_the_rest(tmp_path: Path) -> None:
    jobs = [str(tmp_path / str(i)) for i in range(50)]
    with closing(run_jobs(jobs, recorder, 1)) as done:
        _, worker = next(done)
    assert isinstance(worker, int)
    assert not Path(f"/proc/{worker}").exists()
    assert len(list(tmp_path.iterdir())) <= 3
