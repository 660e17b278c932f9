"""Writing a file so that it is complete or absent; doing a thing one process at a time."""

from __future__ import annotations

import fcntl
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

_ASIDE = ".part"


def write_bytes(file: Path, content: bytes) -> None:
    """Write aside, then rename; the folder must exist."""
    prefix = f".{file.name[:50]}."
    descriptor, aside = tempfile.mkstemp(dir=file.parent, prefix=prefix, suffix=_ASIDE)
    try:
        with os.fdopen(descriptor, "wb") as stream:
            stream.write(content)
        os.chmod(aside, 0o644)
        os.replace(aside, file)
    except BaseException:
        Path(aside).unlink(missing_ok=True)
        raise


def sweep(folder: Path) -> None:
    """Remove what a killed `write_bytes` has left in a folder; nobody may be writing there."""
    for left in folder.glob(f".*{_ASIDE}"):
        left.unlink(missing_ok=True)


def write_text(file: Path, text: str) -> None:
    """`write_bytes` in UTF-8; what is no valid Unicode becomes a question mark."""
    write_bytes(file, text.encode("utf-8", "replace"))


@contextmanager
def locked(file: Path) -> Iterator[None]:
    """Waits until no other process holds the lock; it goes with the process that holds it."""
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield
