"""What the machine does to a run, in words: full disks, files that cannot be written or read."""

from __future__ import annotations

import errno
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..database import NAME
from ..errors import Trouble

_FULL = "there is no room left on the disk"
_CURE = {
    errno.ENOSPC: _FULL,
    errno.EDQUOT: "the quota of the disk is used up",
    errno.EFBIG: "a file would be larger than is allowed here",
    errno.EROFS: "it cannot be written to: its disk is read-only",
    errno.EACCES: "it cannot be written to: no permission",
    errno.EPERM: "it cannot be written to: no permission",
    errno.EIO: "the disk has an error",
}
_KEPT = "What is graded so far is kept; mend that and give the same command again."
_DAMAGED = (
    "It is damaged, or another program's. Nothing was written. Put a copy from a backup in its "
    "place; or try `sqlite3 {file} .recover`, which saves what can be read. Moved away, everything "
    "is graded anew, but the decisions in it (`raybook-grader override`) are gone"
)


@contextmanager
def in_words(out: Path) -> Iterator[None]:
    """Raise `Trouble` for what the machine did to the files in ``out``."""
    file = out / NAME
    try:
        yield
    except sqlite3.OperationalError as error:
        words = {
            sqlite3.SQLITE_FULL: _FULL,
            sqlite3.SQLITE_READONLY: "it cannot be written to",
            sqlite3.SQLITE_CANTOPEN: "it cannot be opened or written to",
            sqlite3.SQLITE_BUSY: "another program holds it",
        }.get(_code(error), str(error))
        raise Trouble(f"{file}: {words}. {_KEPT}") from error
    except sqlite3.DatabaseError as error:
        raise Trouble(f"{file}: {error}. {_DAMAGED.format(file=file)}.") from error
    except OSError as error:
        if error.errno not in _CURE:
            raise
        where = error.filename or out
        raise Trouble(f"{where}: {_CURE[error.errno]}. {_KEPT}") from error


def _code(error: sqlite3.Error) -> int:
    """SQLite's code without its details, which are in the higher bits."""
    return getattr(error, "sqlite_errorcode", 0) & 0xFF
