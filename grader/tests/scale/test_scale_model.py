"""The model of a cluster against what can be reckoned by hand."""

from __future__ import annotations

import random
from itertools import pairwise

import pytest
from model import Overheads, simulate

FREE = Overheads(0.0, 0.0, 0.0)


def test_one_worker_does_one_after_the_other() -> None:
    assert simulate([1.0, 2.0, 3.0], 1, FREE).seconds == 6
    slow = Overheads(scheduler=0.1, take=0.01, store=0.5, latency=0.2)
    # It stores while the worker is at the next job.
    assert simulate([2.0, 2.0], 1, slow).seconds == pytest.approx(0.01 + 2 * 2.51 + 0.5)


def test_the_longest_job_is_a_bound() -> None:
    assert simulate([1.0] * 10 + [50.0], 100, FREE).seconds == 50


def test_jobs_are_taken_in_order() -> None:
    # 3 and 1 begin; the worker with 1 takes 4 at t = 1, the other 1 at t = 3.
    assert simulate([3.0, 1.0, 4.0, 1.0], 2, FREE).seconds == 5


@pytest.mark.parametrize(
    ("over", "rate", "what"),
    [
        (Overheads(0.01, 0.001, 0.001), 100, "the scheduler"),
        (Overheads(0.001, 0.005, 0.015), 50, "the process that stores results"),
    ],
)
def test_a_server_is_a_bound(over: Overheads, rate: float, what: str) -> None:
    run = simulate([1.0] * 20_000, 4096, over)
    assert run.seconds == pytest.approx(20_000 / rate, rel=0.05)
    assert run.stopped_by == what


def test_more_workers_are_never_much_slower() -> None:
    numbers = random.Random(7)
    durations = [numbers.lognormvariate(1, 1) for _ in range(3000)]
    over = Overheads(0.001, 0.002, 0.005, 0.01)
    times = [simulate(durations, 2**k, over).seconds for k in range(12)]
    # Greedy scheduling has anomalies, of one job's length at most.
    assert all(b <= a + max(durations) for a, b in pairwise(times))
    assert times[0] >= sum(durations)
