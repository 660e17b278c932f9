"""The rules of a class as plain values. Every instant is in UTC; the zone says what clocks show."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from enum import StrEnum
from zoneinfo import ZoneInfo

from ..submissions.clock import GREENWICH


class Counts(StrEnum):
    """Which of several hand-ins of a module counts."""

    LAST = "last"
    BEST = "best"


@dataclass(frozen=True)
class Late:
    """What being late costs. ``days`` are each student's own, to be late without a penalty.

    After them each day takes ``percent_per_day`` off the points that were earned, up to
    ``percent_at_most``. ``grace`` after a deadline costs nothing.
    """

    days: int = 0
    percent_per_day: float = 0.0
    percent_at_most: float = 100.0
    grace: timedelta = timedelta()


@dataclass(frozen=True)
class Extension:
    """More time for one student: ``days`` more, or ``until`` an instant (the other is empty).

    ``assignment`` is None for all of them.
    """

    student: str
    assignment: str | None
    days: int = 0
    until: datetime | None = None


@dataclass(frozen=True)
class Policy:
    """One class's rules. Without a deadline nothing is ever late."""

    course: str | None = None
    zone: ZoneInfo = GREENWICH
    counts: Counts = Counts.LAST
    late: Late = Late()
    deadlines: Mapping[str, datetime] = field(default_factory=dict)
    extensions: tuple[Extension, ...] = ()
