"""The same jobs on a Dask cluster: the pool's interface, with worker processes on many machines.

Each worker process gets one job at a time, and the next one when it has answered. So here, too,
it is known which job a worker held when it went: exactly that job is given to another, a limited
number of times, and then reported as `Died`. (Dask's own retries would also blame the jobs that
merely waited in that worker's queue.) Workers may come and go at any time; a new one must first
say that it can do the work as it is meant.
"""

from __future__ import annotations

import queue
import time
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from .dask_client import ClusterLost, connect, worker_addresses
from .on_worker import Refused, do, prepare
from .pool import Died

if TYPE_CHECKING:
    from distributed import Client, Future

J = TypeVar("J")
R = TypeVar("R")

ATTEMPTS = 3
"""More than locally: workers also go because their time is up or their machine is wanted."""
_LOOK_SECONDS = 1.0
_FETCH_SECONDS = 60.0

Say = Callable[[str], None]


def run_on_cluster(
    jobs: Iterable[J], make: Callable[[], Callable[[J], R]], address: str, say: Say
) -> Generator[tuple[J, R | Died]]:
    """Yield each job with its result as it is finished, in any order, as `run_jobs` does.

    ``make`` must be hashable, too. ``address`` is the scheduler's, such as
    ``tcp://10.0.0.1:8786``. ``say`` is told of workers that are refused or go. Raises `ClusterLost`
    when the scheduler goes, and when no worker of those that are there can do the work.
    """
    waiting = deque((job, 1) for job in jobs)
    if not waiting:
        return
    client = connect(address)
    run = _Run(client, make, waiting, say)
    try:
        yield from run.results()
    finally:
        run.stop()
        client.close(timeout=2)


@dataclass(eq=False)
class _Hand(Generic[J]):
    """A worker as it is seen from here: ``future`` is what it is doing, if anything."""

    address: str
    refused: bool = False
    future: Future[Any] | None = None
    held: tuple[J, int] | None = None


class _Run(Generic[J, R]):
    """One run: which worker holds which job."""

    def __init__(
        self,
        client: Client,
        make: Callable[[], Callable[[J], R]],
        waiting: deque[tuple[J, int]],
        say: Say,
    ) -> None:
        self._client = client
        self._make = make
        self._waiting = waiting
        self._say = say
        self._hands: dict[str, _Hand[J]] = {}
        self._idle: dict[_Hand[J], None] = {}  # in the order in which they became so
        self._busy = 0
        self._answers: queue.SimpleQueue[tuple[_Hand[J], Future[Any]]] = queue.SimpleQueue()
        self._looked = -_LOOK_SECONDS
        self._told_to_wait = False
        self._met = self._done = self._lost = 0

    def results(self) -> Iterator[tuple[J, R | Died]]:
        """Every job with its result; gives the count of losses at the end."""
        while self._waiting or self._busy:
            finished = list(self._look())
            self._hand_out()
            answer = self._answer()
            if answer is not None:
                finished.extend(self._take(*answer))
            self._hand_out()  # nobody waits while a result is stored
            yield from finished
        self._say(
            f"cluster: {self._met} workers, {self._done} jobs done, "
            f"{self._lost} times a job was lost with its worker"
        )

    def stop(self) -> None:
        """Forget what is under way; workers finish what they hold, and nobody takes it."""
        for hand in self._hands.values():
            self._release(hand)

    def _hand_out(self) -> None:
        """A job for everybody who has none."""
        while self._idle and self._waiting:
            hand = next(iter(self._idle))
            del self._idle[hand]
            hand.held = self._waiting.popleft()
            self._busy += 1
            self._give(hand, do, self._make, hand.held[0])

    def _look(self) -> Iterator[tuple[J, R | Died]]:
        """Notice, now and then, who has come and who has gone."""
        if time.monotonic() - self._looked < _LOOK_SECONDS:
            return
        present = worker_addresses(self._client)
        for address in self._hands.keys() - present:
            yield from self._mourn(self._hands.pop(address))
        for address in sorted(present - self._hands.keys()):
            hand = self._hands[address] = _Hand(address)
            self._give(hand, prepare, self._make)
        self._looked = time.monotonic()
        if not self._told_to_wait and not present:
            self._say("no workers yet; waiting for some to come (Ctrl-C stops)")
        self._told_to_wait = not present

    def _give(self, hand: _Hand[J], task: Callable[..., Any], *arguments: Any) -> None:
        if self._client.status != "running":
            raise ClusterLost.gone()
        # By its address: a worker that goes takes this task with it.
        hand.future = self._client.submit(task, *arguments, workers=[hand.address], pure=False)
        hand.future.add_done_callback(lambda future: self._answers.put((hand, future)))

    def _answer(self) -> tuple[_Hand[J], Future[Any]] | None:
        until = self._looked + _LOOK_SECONDS - time.monotonic()
        try:
            return self._answers.get(timeout=max(until, 0.001))
        except queue.Empty:
            return None

    def _take(self, hand: _Hand[J], future: Future[Any]) -> Iterator[tuple[J, R | Died]]:
        """What a worker has answered; nothing if it has been given up since."""
        if hand.future is not future:
            return
        try:
            result = future.result(timeout=_FETCH_SECONDS)
        except BaseException as fault:
            yield from self._failed(hand, fault)
            return
        held = hand.held
        self._release(hand)
        if held is None:
            self._judge(hand, result)
        else:
            self._done += 1
            self._idle[hand] = None
            yield held[0], result

    def _failed(self, hand: _Hand[J], fault: BaseException) -> Iterator[tuple[J, R | Died]]:
        """No result came: the worker cannot do it, or has gone, or the whole cluster has."""
        if isinstance(fault, KeyboardInterrupt | SystemExit):
            raise fault
        if self._client.status != "running":
            raise ClusterLost.gone()
        if isinstance(fault, Refused) or hand.held is None:
            if hand.held is not None:
                self._waiting.appendleft(hand.held)
            self._release(hand)
            self._judge(hand, str(fault) or type(fault).__name__)
        else:
            # The worker may live: it will be met again, as a new one.
            del self._hands[hand.address]
            yield from self._mourn(hand, f"{type(fault).__name__}: {fault}")

    def _judge(self, hand: _Hand[J], objection: str) -> None:
        """A worker has said whether it can do the work; an empty objection is a yes."""
        hand.refused = bool(objection)
        if not hand.refused:
            self._met += 1
            self._idle[hand] = None
            return
        self._say(f"worker {hand.address} gets no work: {objection}")
        if all(other.refused for other in self._hands.values()):
            raise ClusterLost(f"no worker can do the work; the last one says:\n{objection}")

    def _mourn(self, hand: _Hand[J], words: str = "") -> Iterator[tuple[J, R | Died]]:
        """A worker has gone: what it held is for another, but not for ever."""
        held = hand.held
        self._release(hand)
        self._idle.pop(hand, None)
        if held is None:
            return
        job, attempt = held
        self._lost += 1
        if attempt < ATTEMPTS:
            self._say(f"worker {hand.address} has gone; another one gets its job")
            self._waiting.appendleft((job, attempt + 1))
        else:
            last = f"the last one, {hand.address}: {words}" if words else f"last {hand.address}"
            yield job, Died(f"the worker process was lost, {ATTEMPTS} times, {last}")

    def _release(self, hand: _Hand[J]) -> None:
        if hand.future is not None:
            hand.future.release()
        if hand.held is not None:
            self._busy -= 1
        hand.future = hand.held = None
