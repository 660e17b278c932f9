"""Which submissions a folder holds."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Collection, Iterable
from datetime import UTC, datetime
from pathlib import Path
from zoneinfo import ZoneInfo

from ..errors import BadInput
from .archive import SUFFIXES, read_archive
from .clock import GREENWICH
from .folder import read_folder
from .name import split_name
from .submission import Submission, SubmittedFile, Unusable

RULES = "course.toml"
"""What the class's rules are called, which may lie among the submissions."""

_BEGINNING = datetime.min.replace(tzinfo=UTC)


def find_submissions(
    folder: Path, owned: Collection[str], zone: ZoneInfo = GREENWICH
) -> tuple[list[Submission], list[str]]:
    """Every submission, in the order of their ids and times, and the names of the entries that
    are none.

    A submission is a folder or an archive; its id is its name, for an archive without the
    suffix unless two would then share it. `id--TIME` says when it was handed in, on the clocks of
    ``zone`` unless the time has an offset. Entries that begin with a dot are passed over.
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
        if entry not in usable and not entry.name.startswith(".") and entry.name != RULES
    ]
    named = [(entry, *split_name(folder, _stem(entry.name), zone)) for entry in usable]
    names = Counter(name for _, name, time in named if time is None)
    found = []
    for entry, stem, time in named:
        name = entry.name if time is None and names[stem] > 1 else stem
        found.append(_read(_text(name), time, Path(entry.path), owned))
    found.sort(key=lambda submission: (submission.id, submission.time or _BEGINNING))
    _refuse_unordered(folder, found)
    return found, ignored


def latest(submissions: Iterable[Submission]) -> list[Submission]:
    """Of each student the last submission, of submissions as they were found."""
    return list({submission.id: submission for submission in submissions}.values())


def _refuse_unordered(folder: Path, found: Iterable[Submission]) -> None:
    """Fault of a student of whose submissions nobody can say which came first."""
    times: dict[str, set[datetime | None]] = {}
    for submission in found:
        own = times.setdefault(submission.id, set())
        if submission.time in own:
            raise BadInput(
                f"{folder}: two submissions of {submission.id!r} are of "
                f"{submission.time}, expected one at a time"
            )
        own.add(submission.time)
        if None in own and len(own) > 1:
            raise BadInput(
                f"{folder}: {submission.id!r} has a submission without a time beside others, "
                "expected a time in the name of each"
            )


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


def _read(name: str, time: datetime | None, place: Path, owned: Collection[str]) -> Submission:
    try:
        read = read_folder if place.is_dir() else read_archive
        files: dict[str, SubmittedFile] = read(place, owned)
    except Unusable as problem:
        return Submission(name, problem=str(problem), time=time)
    except OSError as error:
        return Submission(name, problem=f"it cannot be read ({error.strerror})", time=time)
    return Submission(name, files, time=time)
