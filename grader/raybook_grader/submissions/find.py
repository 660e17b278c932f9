"""Which submissions a folder holds."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Collection
from pathlib import Path

from ..errors import BadInput
from .archive import SUFFIXES, read_archive
from .folder import read_folder
from .submission import Submission, SubmittedFile, Unusable


def find_submissions(folder: Path, owned: Collection[str]) -> tuple[list[Submission], list[str]]:
    """Every submission, in the order of their ids, and the names of the entries that are none.

    A submission is a folder or an archive; its id is its name, for an archive without the
    suffix unless two would then share it. Entries that begin with a dot are passed over.
    """
    try:
        entries = sorted(os.scandir(folder), key=lambda entry: entry.name)
    except OSError as error:
        raise BadInput(f"{folder}: {error.strerror}, expected a folder of submissions") from error
    usable = [entry for entry in entries if _is_submission(entry)]
    if not usable:
        raise BadInput(f"{folder}: no submission, expected folders or {', '.join(SUFFIXES)} files")
    ignored = [
        _text(entry.name)
        for entry in entries
        if entry not in usable and not entry.name.startswith(".")
    ]
    names = Counter(_stem(entry.name) for entry in usable)
    found = []
    for entry in usable:
        stem = _stem(entry.name)
        name = stem if names[stem] == 1 else entry.name
        found.append(_read(_text(name), Path(entry.path), owned))
    return sorted(found, key=lambda submission: submission.id), ignored


def _is_submission(entry: os.DirEntry[str]) -> bool:
    if entry.name.startswith(".") or entry.is_symlink():
        return False
    return entry.is_dir() or (entry.is_file() and entry.name.endswith(SUFFIXES))


def _stem(name: str) -> str:
    for suffix in SUFFIXES:
        if name.endswith(suffix):
            return name.removesuffix(suffix) or name
    return name


def _text(name: str) -> str:
    """A file's name as valid Unicode; bytes that are not UTF-8 are written out."""
    return os.fsencode(name).decode("utf-8", "backslashreplace")


def _read(name: str, place: Path, owned: Collection[str]) -> Submission:
    try:
        read = read_folder if place.is_dir() else read_archive
        files: dict[str, SubmittedFile] = read(place, owned)
    except Unusable as problem:
        return Submission(name, problem=str(problem))
    except OSError as error:
        return Submission(name, problem=f"it cannot be read ({error.strerror})")
    return Submission(name, files)
