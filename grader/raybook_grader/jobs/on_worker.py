"""What runs in a worker process of a cluster: it is made ready once, then does job after job."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, TypeVar

J = TypeVar("J")
R = TypeVar("R")

_ready: dict[Any, Callable[[Any], Any]] = {}
"""The function of the latest run: what it holds in memory (references) serves all its jobs."""
_lock = threading.Lock()


class Refused(Exception):
    """This process cannot do the work; the message says why."""


def prepare(make: Callable[[], Callable[[J], R]]) -> str:
    """Make this process ready for the jobs of a run; "" or what stands against it."""
    with _lock:
        if make not in _ready:
            _ready.clear()
            try:
                _ready[make] = make()
            except Exception as fault:
                return str(fault) or type(fault).__name__
    return ""


def do(make: Callable[[], Callable[[J], R]], job: J) -> R:
    """Do a job, in a process that may have been started anew since it was asked."""
    objection = prepare(make)
    if objection:
        raise Refused(objection)
    work: Callable[[J], R] = _ready[make]
    return work(job)
