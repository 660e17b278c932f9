"""One student's work, read into memory once and never touched on disk again."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime

SIZE_LIMIT = 1 << 20
"""The largest owned file that is read, in bytes."""


class Unusable(Exception):
    """Why a whole submission cannot be read, in words for its student."""


@dataclass(frozen=True)
class SubmittedFile:
    """An owned file: its bytes, or the reason why it was refused (never both)."""

    content: bytes = b""
    refusal: str | None = None


@dataclass(frozen=True)
class Submission:
    """``files`` holds what was found of the owned files, by their usual path.

    ``problem`` says why the submission as a whole is unusable; it then has no files.
    ``id`` is its student: valid Unicode but otherwise anything that a file can be called.
    ``time`` is when it was handed in, in UTC; None where that is not known. A student with several
    submissions has a time in each.
    """

    id: str
    files: Mapping[str, SubmittedFile] = field(default_factory=dict)
    problem: str | None = None
    time: datetime | None = None
