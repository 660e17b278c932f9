"""What the end of a student's program says: a crash, a limit, or something forbidden."""

from __future__ import annotations

import signal
from dataclasses import dataclass

from ..sandbox import BoxResult
from .program import HarnessFault
from .result import Status

_FORBIDDEN_SIGNALS = {
    signal.SIGSYS: "asked the system for something that no module needs",
    signal.SIGXFSZ: "wrote a file larger than allowed",
}


@dataclass(frozen=True)
class Trouble:
    """An end that is no answer."""

    status: Status
    message: str
    fingerprint: str


_MEMORY = "used too much memory"
_NEARLY_ALL = 0.9
"""A program that fails while it holds this part of its memory ran out of it: `malloc` gave 0."""


def trouble(result: BoxResult, memory_bytes: int) -> Trouble | None:
    """The trouble in a run that had so much memory.

    None if the program ended by itself, with whatever exit code. Raises `HarnessFault` for a run
    that the box lost.
    """
    if result.outcome == "lost":
        raise HarnessFault(f"a run in the box was lost: {result.detail}")
    ended = result.outcome in ("exited", "signaled")
    if ended and not result.ok and result.max_rss_bytes >= _NEARLY_ALL * memory_bytes:
        limit = f"{memory_bytes >> 20} MiB"
        return Trouble(Status.MEMORY, f"the program used up its {limit} of memory", _MEMORY)
    if result.outcome == "exited":
        return None
    if result.outcome == "signaled":
        return _signaled(result)
    status, fingerprint = {
        "timeout": (Status.TIMEOUT, "did not finish in time"),
        "memory": (Status.MEMORY, _MEMORY),
        "output-flood": (Status.FORBIDDEN, "wrote too much"),
    }[result.outcome]
    return Trouble(status, f"the program was stopped: it {_past(result)}", fingerprint)


def _past(result: BoxResult) -> str:
    words = result.describe()
    return f"gave {words}" if words.startswith("no ") else words


def _signaled(result: BoxResult) -> Trouble:
    for number, words in _FORBIDDEN_SIGNALS.items():
        if result.signal == number:
            return Trouble(Status.FORBIDDEN, f"the program was stopped: it {words}", words)
    words = result.describe()
    return Trouble(Status.CRASH, f"the program crashed: {words}", f"crashed: {words}")
