"""What a check of one assignment found."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto
from pathlib import Path

from .pictures import JudgedPicture
from .project import Assignment


class State(Enum):
    """Where an assignment stands."""

    TO_DO = auto()
    FAILING = auto()
    DONE = auto()


@dataclass(frozen=True)
class ShownPicture:
    """A judged picture and the PNG file of yours, the expected one and the difference."""

    judged: JudgedPicture
    sheet: Path


@dataclass(frozen=True)
class Finding:
    """``headline`` is one line; ``details`` is what failed, in words, the simplest first.

    ``notes`` cost nothing: what could not be looked at, and why. ``words`` is the compiler's.
    """

    assignment: Assignment
    state: State
    headline: str
    details: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    words: str = ""
    pictures: tuple[ShownPicture, ...] = ()
