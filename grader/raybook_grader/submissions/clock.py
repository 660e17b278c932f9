"""Wall clocks and instants, over the nights when the clocks change.

Two datetimes of one zone are compared by what the clocks show, so that an hour of the night when
they go back is wrong. Hence every instant is turned into UTC before anything is compared.
"""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from zoneinfo import ZoneInfo

GREENWICH = ZoneInfo("UTC")


class NoInstant(ValueError):
    """Clocks show that time twice, or never; ``str()`` says which."""


def instant(time: datetime, zone: ZoneInfo) -> datetime:
    """The instant in UTC. A time without an offset is what the clocks of ``zone`` show."""
    if time.tzinfo is not None:
        return time.astimezone(UTC)
    first, second = _both(time, zone)
    if first == second:
        return first
    shown = first.astimezone(zone).replace(tzinfo=None)
    times = "twice" if shown == time else "never"
    raise NoInstant(f"clocks in {zone.key} show {time.isoformat()} {times}, as they change then")


def days_after(moment: datetime, days: int, zone: ZoneInfo) -> datetime:
    """The same time of day so many days later; where clocks show it twice or never, the later."""
    if days == 0:
        return moment
    wall = moment.astimezone(zone).replace(tzinfo=None) + timedelta(days=days)
    return max(_both(wall, zone))


def _both(wall: datetime, zone: ZoneInfo) -> tuple[datetime, datetime]:
    """The two readings of a wall clock; they differ only where clocks change."""
    first, second = (wall.replace(tzinfo=zone, fold=fold).astimezone(UTC) for fold in (0, 1))
    return first, second
