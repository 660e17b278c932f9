"""Where the jobs of a run are done: on this machine, or on a cluster."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence

from ..jobs.cluster import run_on_cluster
from ..jobs.pool import Died, run_jobs
from .job import Job, Worker
from .plan import Order
from .remote import RemoteWorker
from .result import ModuleResult


def run_where_ordered(
    jobs: Sequence[Job], worker: Worker, order: Order, say: Callable[[str], None]
) -> Generator[tuple[Job, ModuleResult | Died]]:
    """Each job with its result as it is finished."""
    if order.scheduler is None or not jobs:
        return run_jobs(jobs, worker, order.workers)
    remote = RemoteWorker.of(worker, {job.assignment for job in jobs})
    return run_on_cluster(jobs, remote, order.scheduler, say)
