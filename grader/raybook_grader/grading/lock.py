"""One command at a time writes into an output folder."""

from __future__ import annotations

import errno
import fcntl
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import BadInput

_OF_THE_MACHINE = (errno.ENOSPC, errno.EDQUOT, errno.EIO)


@contextmanager
def alone_in(out: Path) -> Iterator[None]:
    """The output folder, made if need be, for one run at a time; a kill frees it."""
    try:
        out.mkdir(parents=True, exist_ok=True)
        lock = (out / ".lock").open("w")
    except OSError as error:
        if error.errno in _OF_THE_MACHINE:
            raise
        raise BadInput(f"{out}: {error.strerror}, expected a folder to write to") from error
    with lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise BadInput(f"{out}: another run is grading into it") from error
        yield
