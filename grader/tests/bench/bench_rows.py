"""What a measurement comes to: one row of build/bench/bench.json and of the table."""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal


@dataclass(frozen=True)
class Spread:
    """Repeated measurements: the middle one and the extremes."""

    median: float
    low: float
    high: float


def spread(values: Sequence[float]) -> Spread:
    """Of at least one value."""
    return Spread(statistics.median(values), min(values), max(values))


def ratios(above: Sequence[float], below: Sequence[float]) -> Spread:
    """Repetition by repetition: two that ran one after the other met the same machine."""
    return spread([a / b for a, b in zip(above, below, strict=True)])


@dataclass(frozen=True)
class Goal:
    """What a row is to reach, and what would be better still.

    ``of``: is it the ratio that is judged, or the figure?
    """

    value: float
    beyond: float | None = None
    at_least: bool = True
    of: Literal["ratio", "figure"] = "ratio"

    def met(self, row: Row) -> bool:
        """A row that was not measured meets nothing."""
        found = row.ratio if self.of == "ratio" else row.figure
        if found is None:
            return False
        return bool(found >= self.value if self.at_least else found <= self.value)

    def __str__(self) -> str:
        sign = "≥" if self.at_least else "≤"
        beyond = "" if self.beyond is None else f" ({self.beyond:g})"
        return f"{self.of} {sign} {self.value:g}{beyond}"


@dataclass(frozen=True)
class Row:
    """One measurement.

    figure, in unit: ours. ratio: ours beside the peer's. In the groups build and memory it is what
    ours takes for each 1 of the peer's, everywhere else how many times better ours is. low and
    high: the extremes of the repetitions, of the ratio, or of the figure where there is no ratio.
    fault: why the row does not count (the pictures are not the same) or was not measured.
    """

    group: str
    name: str
    scene: str
    kind: str = ""
    peer: str = ""
    figure: float | None = None
    unit: str = ""
    ratio: float | None = None
    low: float | None = None
    high: float | None = None
    note: str = ""
    fault: str = ""
    goal: Goal | None = None

    @property
    def met(self) -> bool | None:
        """Is the goal reached? None: there is no goal."""
        if self.goal is None:
            return None
        return not self.fault and self.goal.met(self)

    def beside(self, found: Spread) -> Row:
        """The row with this ratio to its peer."""
        return replace(self, ratio=found.median, low=found.low, high=found.high)

    def missing(self, why: str) -> Row:
        """The row when there was nothing to measure."""
        return replace(self, figure=None, ratio=None, low=None, high=None, fault=why)

    def values(self) -> dict[str, Any]:
        """For JSON."""
        goal = self.goal
        return {
            "group": self.group,
            "name": self.name,
            "scene": self.scene,
            "kind": self.kind,
            "peer": self.peer,
            "figure": _plain(self.figure),
            "unit": self.unit,
            "ratio": _plain(self.ratio),
            "goal": None if goal is None else goal.value,
            "met": self.met,
            "beyond": None if goal is None else goal.beyond,
            "goal_of": None if goal is None else goal.of,
            "at_least": None if goal is None else goal.at_least,
            "low": _plain(self.low),
            "high": _plain(self.high),
            "note": self.note,
            "fault": self.fault,
        }


def _plain(value: float | None) -> float | None:
    """A number of Python's own, whatever it was computed with; JSON has no other."""
    return None if value is None else float(value)
