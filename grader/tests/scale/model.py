"""A discrete-event model of a run on a cluster.

Workers take jobs in order. A finished job's result goes through the scheduler and then to the one
process that hands out jobs and stores results: both are servers that do one thing after another,
in the order of arrival. A worker has its next job when its result was taken; the result is stored
after that. So time falls with workers until one of the two servers is always busy, or until less
is left than one job for each.
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice


@dataclass(frozen=True)
class Overheads:
    """Processor seconds of one job with its result, but for the grading itself."""

    scheduler: float
    """of the scheduler's process"""
    take: float
    """of the client: handing out a job and fetching its result"""
    store: float
    """of the client: a result into the database"""
    latency: float = 0.0
    """of a worker between being given a job and beginning it, and from its end to the scheduler"""
    start: float = 0.0
    """of a worker before its first job"""


@dataclass(frozen=True)
class Run:
    """How one run went: ``seconds`` from its beginning to the last stored result."""

    workers: int
    seconds: float
    busy_workers: float
    busy_client: float
    busy_scheduler: float

    @property
    def stopped_by(self) -> str:
        """What more workers would not help."""
        if self.busy_client > 0.95:
            return "the process that stores results"
        if self.busy_scheduler > 0.95:
            return "the scheduler"
        return "the last jobs" if self.busy_workers < 0.9 else ""


def simulate(durations: Sequence[float], workers: int, over: Overheads) -> Run:
    """Run jobs of these durations, in their order."""
    waiting = iter(durations)
    ends: list[float] = []
    for duration in islice(waiting, workers):
        # Handing out the first jobs takes the client's time, too.
        ends.append(over.start + (len(ends) + 1) * over.take + over.latency + duration)
    heapq.heapify(ends)
    scheduler = client = 0.0
    while ends:
        scheduler = max(scheduler, heapq.heappop(ends) + over.latency) + over.scheduler
        client = max(client, scheduler) + over.take
        following = next(waiting, None)
        if following is not None:
            heapq.heappush(ends, client + over.latency + following)
        client += over.store
    jobs = len(durations)
    return Run(
        workers,
        client,
        sum(durations) / (client * workers),
        jobs * (over.take + over.store) / client,
        jobs * over.scheduler / client,
    )
