"""Listening to a running box: its output, its report, its end."""

from __future__ import annotations

import contextlib
import os
import selectors
import subprocess
import time
from dataclasses import dataclass, field

_BLOCK = 65536


@dataclass
class Stream:
    """One descriptor's bytes, up to a cap; owns the descriptor, which is made non-blocking."""

    descriptor: int
    cap: int | None = None
    data: bytearray = field(default_factory=bytearray)
    cut: bool = False

    def __post_init__(self) -> None:
        os.set_blocking(self.descriptor, False)

    def pump(self) -> bool:
        """Reads what is there now; False at the end of the stream or beyond the cap."""
        while True:
            try:
                block = os.read(self.descriptor, _BLOCK)
            except BlockingIOError:
                return True
            self.data += block
            if self.cap is not None and len(self.data) > self.cap:
                del self.data[self.cap :]
                self.cut = True
            if self.cut or not block:
                return False


def listen(
    process: subprocess.Popen[bytes], text: list[Stream], report: Stream, control: int,
    fence_seconds: float,
) -> bool:  # fmt: skip
    """Reads the streams until the process has ended; False if the fence had to end it.

    A text stream beyond its cap makes the supervisor end the command, through the control pipe.
    The process is dead when this returns or raises. The end of a pipe is never waited for:
    another thread's fork may hold its other end for ever.
    """
    deadline = time.monotonic() + fence_seconds
    ended = os.pidfd_open(process.pid)
    try:
        with selectors.DefaultSelector() as selector:
            selector.register(ended, selectors.EVENT_READ)
            for stream in (*text, report):
                selector.register(stream.descriptor, selectors.EVENT_READ, stream)
            in_time = _until_ended(selector, control, deadline)
    finally:
        os.close(ended)
        process.kill()  # the kernel ends the whole box with it
        process.wait()
    for stream in (*text, report):
        if not stream.cut:
            stream.pump()
    return in_time


def _until_ended(selector: selectors.BaseSelector, control: int, deadline: float) -> bool:
    while True:
        left = deadline - time.monotonic()
        if left <= 0:
            return False
        for key, _ in selector.select(left):
            stream = key.data
            if stream is None:
                return True
            if not stream.pump():
                selector.unregister(stream.descriptor)
                if stream.cut:
                    _stop(control)


def _stop(control: int) -> None:
    with contextlib.suppress(BrokenPipeError):  # it has just ended by itself
        os.write(control, b"x")
