"""Saying why a module's points are not those of its checks: for programs and for people."""

from __future__ import annotations

from datetime import datetime
from typing import Any
from zoneinfo import ZoneInfo

from .settle import Penalty, Settled


def settled_json(settled: Settled, zone: ZoneInfo) -> dict[str, Any]:
    """The keys that `grades.json` has beside a module's final ``score``."""
    penalty, override = settled.penalty, settled.override
    return {
        "handed_in": settled.handed_in and settled.handed_in.astimezone(zone).isoformat(),
        "raw_score": settled.raw_score,
        "penalty": penalty
        and {
            "deadline": penalty.deadline.astimezone(zone).isoformat(),
            "days_late": penalty.days_late,
            "late_days_used": penalty.late_days,
            "percent": penalty.percent,
            "points": penalty.points,
        },
        "override": override
        and {
            "score": override.score,
            "reason": override.reason,
            "by": override.by,
            "at": override.at,
        },
    }


def told(settled: Settled, zone: ZoneInfo) -> list[str]:
    """The same as sentences for the student; none where nothing was changed."""
    found = []
    if settled.penalty:
        found.append(_late(settled.penalty, zone))
    if settled.override:
        before = "no points" if settled.raw_score is None else f"{settled.raw_score:g} points"
        found.append(
            f"Set to {settled.override.score:g} points by {settled.override.by}; the grader "
            f"found {before}. Reason: {settled.override.reason}"
        )
    return found


def _late(penalty: Penalty, zone: ZoneInfo) -> str:
    days = "1 day" if penalty.days_late == 1 else f"{penalty.days_late} days"
    free = f", {penalty.late_days} of them covered by late days" if penalty.late_days else ""
    if penalty.percent == 0:
        taken = "Nothing is taken off."
    else:
        points = "" if penalty.points is None else f": {penalty.points:g} points"
        taken = f"{penalty.percent:g} % are taken off{points}."
    return (
        f"Handed in {_clock(penalty.handed_in, zone)}, due {_clock(penalty.deadline, zone)}: "
        f"{days} late{free}. {taken}"
    )


def _clock(moment: datetime, zone: ZoneInfo) -> str:
    return f"{moment.astimezone(zone):%Y-%m-%d %H:%M:%S %Z}"
