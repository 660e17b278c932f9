"""Reading a submission that is a folder: regular files only, and no link is ever followed."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Collection
from pathlib import Path

from .place import choose_folder
from .submission import SIZE_LIMIT, SubmittedFile

_NO_LINK = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC


def read_folder(folder: Path, owned: Collection[str]) -> dict[str, SubmittedFile]:
    """The owned files of a submitted folder."""
    inside = sorted(
        entry.name for entry in os.scandir(folder) if entry.is_dir(follow_symlinks=False)
    )
    places = {place: _read_all(folder / place, owned) for place in ["", *inside]}
    chosen = choose_folder(place for place, files in places.items() if files)
    return {} if chosen is None else places[chosen]


def _read_all(base: Path, owned: Collection[str]) -> dict[str, SubmittedFile]:
    files = {path: _read(base, path) for path in owned}
    return {path: file for path, file in files.items() if file is not None}


def _read(base: Path, path: str) -> SubmittedFile | None:
    """One owned file; None when there is nothing of that name."""
    try:
        descriptor = _open(base, path)
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as error:
        return SubmittedFile(refusal=f"{path}: is a link or cannot be read ({error.strerror})")
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        return SubmittedFile(refusal=f"{path}: is no regular file")
    with os.fdopen(descriptor, "rb") as stream:
        content = stream.read(SIZE_LIMIT + 1)
    if len(content) > SIZE_LIMIT:
        return SubmittedFile(refusal=f"{path}: is larger than {SIZE_LIMIT >> 20} MiB")
    return SubmittedFile(content)


def _step_into(folder: str, here: int) -> int:
    try:
        return os.open(folder, _NO_LINK | os.O_DIRECTORY, dir_fd=here)
    except NotADirectoryError:
        # What Linux says of a link, too, when asked for a folder.
        if stat.S_ISLNK(os.lstat(folder, dir_fd=here).st_mode):
            raise OSError(errno.ELOOP, os.strerror(errno.ELOOP)) from None
        raise


def _open(base: Path, path: str) -> int:
    """A descriptor of base/path, with no link on the way from ``base`` on."""
    *folders, name = path.split("/")
    here = os.open(base, _NO_LINK | os.O_DIRECTORY)
    try:
        for folder in folders:
            below = _step_into(folder, here)
            os.close(here)
            here = below
        return os.open(name, _NO_LINK, dir_fd=here)
    finally:
        os.close(here)
