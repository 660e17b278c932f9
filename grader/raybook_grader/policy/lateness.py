"""When a student's work is due, and how many days late it is."""

from __future__ import annotations

from datetime import datetime, timedelta

from ..submissions.clock import days_after
from .model import Policy

_DAY = timedelta(days=1)


def due(policy: Policy, student: str, assignment: str) -> datetime | None:
    """The deadline with the student's extensions, the latest of them; None without a deadline."""
    deadline = policy.deadlines.get(assignment)
    if deadline is None:
        return None
    extended = [
        extension.until or days_after(deadline, extension.days, policy.zone)
        for extension in policy.extensions
        if extension.student == student and extension.assignment in (None, assignment)
    ]
    return max([deadline, *extended])


def days_late(policy: Policy, deadline: datetime, handed_in: datetime) -> int:
    """How many days late, each begun day a whole one; 0 up to the deadline and its grace.

    A day ends at the deadline's time of day, with the same grace, however long that day was.
    """
    over = handed_in - deadline - policy.late.grace
    if over <= timedelta():
        return 0
    # A day of the calendar is never as much as a day longer or shorter than 24 hours.
    days = max(1, over // _DAY - 1)
    while handed_in > days_after(deadline, days, policy.zone) + policy.late.grace:
        days += 1
    return days
