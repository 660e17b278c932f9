"""Copies of files that the box's user could not reach where they lie.

As root, boxes run as nobody, who cannot enter /root or a private home folder and cannot read a
file made under umask 077. What is needed from there is copied into a private scratch folder of
the system's temporary folder. As an ordinary user nothing is ever copied.
"""

from __future__ import annotations

import contextlib
import fcntl
import os
import shutil
import stat
import tempfile
import threading
import weakref
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

from .errors import BoxError, SandboxUnavailable

NOBODY = 65534
_PREFIX = "raybook-box-"
_Signature = tuple[tuple[str, int, int, int, int], ...]


class Mirror:
    """A scratch folder, made when first needed and removed with the object. Thread-safe.

    Every use of a path looks at all that is below it, so a copy is never stale; paths in
    `unchanging` (a Python environment, say) are looked at once.
    """

    def __init__(self, unchanging: Iterable[Path] = ()) -> None:
        self._unchanging = frozenset(unchanging)
        self._settled: dict[Path, Path] = {}
        self._guard = threading.Lock()
        self._folder: Path | None = None
        self._copies: dict[Path, tuple[_Signature, Path]] = {}
        self._close: Callable[[], object] = _nothing

    def readable(self, path: Path) -> Path:
        """Where the box's user can read the file or folder: `path` itself, or a fresh copy.

        Raises BoxError unless it is a regular file or a folder, and no symbolic link (a
        submission must not choose what is bound; resolve trusted links first).
        """
        settled = self._settled.get(path)
        if settled is None:
            settled = self._look(path.parent.resolve() / path.name)
            if path in self._unchanging:
                self._settled[path] = settled
        return settled

    def close(self) -> None:
        """Removes the copies; calling `readable` afterwards starts anew."""
        with self._guard:
            self._close()
            self._folder, self._copies, self._close = None, {}, _nothing
            self._settled = {}

    def _look(self, path: Path) -> Path:
        try:
            mode = path.lstat().st_mode
        except OSError as error:
            raise BoxError(f"cannot bind {path}: {error.strerror}") from error
        if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
            raise BoxError(f"cannot bind {path}: expected a regular file or a folder")
        if os.geteuid() != 0 or _reachable(path):
            return path
        with self._guard:
            return self._copy(path)

    def _copy(self, path: Path) -> Path:
        signature = tuple(_describe(path))
        known = self._copies.get(path)
        if known is not None and known[0] == signature:
            return known[1]
        # A folder of its own for each copy: forked workers share this object's folder.
        target = Path(tempfile.mkdtemp(dir=self._open())) / "copy"
        if path.is_dir():
            shutil.copytree(path, target, symlinks=True)
        else:
            shutil.copyfile(path, target)
            shutil.copymode(path, target)
        _let_nobody_read(target.parent)
        self._copies[path] = (signature, target)
        return target

    def _open(self) -> Path:
        if self._folder is None:
            base = _temporary_folder()
            _sweep(base)
            self._folder = Path(tempfile.mkdtemp(prefix=_PREFIX, dir=base))
            lock = _lock(self._folder)
            os.chown(self._folder, -1, NOBODY)
            self._folder.chmod(0o710)
            self._close = weakref.finalize(self, _remove, self._folder, lock, os.getpid())
        return self._folder


def _nothing() -> None:
    """There is no folder to remove yet."""


def _lock(folder: Path) -> int:
    """Marks the folder as in use; it never shows a lock file that is not held."""
    new = folder / ".new-lock"
    lock = os.open(new, os.O_CREAT | os.O_RDWR | os.O_CLOEXEC, 0o600)
    fcntl.flock(lock, fcntl.LOCK_EX)
    new.rename(folder / ".lock")
    return lock


def _reachable(path: Path) -> bool:
    """Whether everyone may enter every folder above the path and read all that is in it."""
    if not all(folder.stat().st_mode & stat.S_IXOTH for folder in path.parents):
        return False
    return all(_everyone_may_read(mode) for _, mode, *_ in _describe(path))


def _everyone_may_read(mode: int) -> bool:
    needed = stat.S_IROTH | (stat.S_IXOTH if stat.S_ISDIR(mode) else 0)
    return mode & needed == needed or not (stat.S_ISDIR(mode) or stat.S_ISREG(mode))


def _describe(path: Path) -> Iterator[tuple[str, int, int, int, int]]:
    """Name, mode, inode, size and change time of the path and everything below it."""
    about = path.lstat()
    yield str(path), about.st_mode, about.st_ino, about.st_size, about.st_ctime_ns
    if stat.S_ISDIR(about.st_mode):
        for name in sorted(os.listdir(path)):
            yield from _describe(path / name)


def _let_nobody_read(top: Path) -> None:
    for folder, _, files in os.walk(top):
        _open_to_nobody(Path(folder), stat.S_IRGRP | stat.S_IXGRP)
        for name in files:
            path = Path(folder) / name
            if not path.is_symlink():
                executable = path.stat().st_mode & stat.S_IXUSR
                _open_to_nobody(path, stat.S_IRGRP | (stat.S_IXGRP if executable else 0))


def _open_to_nobody(path: Path, bits: int) -> None:
    os.chown(path, -1, NOBODY)
    path.chmod(stat.S_IMODE(path.stat().st_mode) | bits)


def _temporary_folder() -> Path:
    for folder in (Path(tempfile.gettempdir()), Path("/tmp"), Path("/var/tmp")):
        inside = folder.resolve() / "x"
        if os.access(folder, os.W_OK | os.X_OK) and all(
            above.stat().st_mode & stat.S_IXOTH for above in inside.parents
        ):
            return folder
    raise SandboxUnavailable(
        "no temporary folder that every user can enter (tried TMPDIR, /tmp, /var/tmp)"
    )


def _sweep(base: Path) -> None:
    """Removes what killed runs left: our folders whose lock nobody holds any more."""
    for folder in base.glob(_PREFIX + "*"):
        with contextlib.suppress(OSError):
            if folder.lstat().st_uid != os.geteuid() or folder.is_symlink():
                continue
            lock = os.open(folder / ".lock", os.O_RDWR | os.O_CLOEXEC | os.O_NOFOLLOW)
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(folder, ignore_errors=True)
            finally:
                os.close(lock)


def _remove(folder: Path, lock: int, owner: int) -> None:
    if os.getpid() == owner:  # a forked worker leaves the folder to the one who made it
        shutil.rmtree(folder, ignore_errors=True)
        os.close(lock)
