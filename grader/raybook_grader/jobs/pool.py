"""A pool of worker processes that knows which job each one holds.

So when a worker dies (the system is out of memory, a library crashes), exactly its job is to
blame: it is tried once more in a fresh worker, then reported as `Died`, and the rest goes on.
"""

from __future__ import annotations

import contextlib
import ctypes
import multiprocessing
import signal
from collections import deque
from collections.abc import Callable, Generator, Iterable
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from typing import Generic, TypeVar

J = TypeVar("J")
R = TypeVar("R")

ATTEMPTS = 2
_PR_SET_PDEATHSIG = 1


@dataclass(frozen=True)
class Died:
    """Given in place of a result: the worker process died of the job, each time."""

    message: str


def run_jobs(
    jobs: Iterable[J], make: Callable[[], Callable[[J], R]], workers: int
) -> Generator[tuple[J, R | Died]]:
    """Yield each job with its result as it is finished, in any order.

    ``make`` runs once in each worker and gives the function that does a job; it, the jobs and
    the results must pickle, and the function must not raise. Closing the generator (so does an
    exception at the place where it is consumed) kills the workers and what they run.
    """
    waiting = deque((job, 1) for job in jobs)
    pool: dict[Connection, _Worker[J, R]] = {}
    try:
        for _ in range(min(workers, len(waiting))):
            worker = _Worker(make)
            pool[worker.connection] = worker
            worker.give(*waiting.popleft())
        while pool:
            for ready in wait(list(pool)):
                assert isinstance(ready, Connection)
                worker = pool.pop(ready)
                job, attempt, outcome = worker.take()
                again = isinstance(outcome, Died) and attempt < ATTEMPTS
                if again:
                    waiting.appendleft((job, attempt + 1))
                if isinstance(outcome, Died) or not waiting:
                    worker.kill()
                if waiting:
                    worker = _Worker(make) if isinstance(outcome, Died) else worker
                    pool[worker.connection] = worker
                    worker.give(*waiting.popleft())
                if not again:
                    yield job, outcome
    finally:
        for worker in pool.values():
            worker.kill()


class _Worker(Generic[J, R]):
    """One process and the job in its hands."""

    def __init__(self, make: Callable[[], Callable[[J], R]]) -> None:
        # Not forked: the parent has threads (the progress bar, numerical libraries).
        context = multiprocessing.get_context("spawn")
        self.connection, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(theirs, make), daemon=True)
        self._process.start()
        theirs.close()
        self._held: tuple[J, int] | None = None

    def give(self, job: J, attempt: int) -> None:
        self._held = job, attempt
        # A worker that is already dead is noticed by `take`.
        with contextlib.suppress(OSError):
            self.connection.send(job)

    def take(self) -> tuple[J, int, R | Died]:
        """The job that was given, its attempt, and what came of it."""
        assert self._held is not None
        job, attempt = self._held
        try:
            result: R | Died = self.connection.recv()
        except (EOFError, OSError):
            self._process.join()
            result = Died(f"the worker process ended with code {self._process.exitcode}")
        return job, attempt, result

    def kill(self) -> None:
        self._process.kill()
        self._process.join()
        self.connection.close()


def _serve(connection: Connection, make: Callable[[], Callable[[J], R]]) -> None:
    """A worker's life: Ctrl-C is its parent's to handle, and it dies with its parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    work = make()
    while True:
        try:
            job: J = connection.recv()
        except EOFError:
            return
        connection.send(work(job))
