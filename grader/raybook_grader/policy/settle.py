"""Which hand-in of each module counts, and what is taken off it: arithmetic, nothing else.

1. A module is handed in when its files change; handing in the same files later changes nothing.
2. A student's late days are spent on required modules first, then on optional ones, each in the
   order of their deadlines: as many as a module is late, or what is left of them.
3. Each further day late costs its per cent of the points that were earned.
4. Work that earned nothing costs no late day.
5. Where the best hand-in counts, it is the one with the most points after 2 and 3, the earliest
   of equals. While the score of one is not known, nobody can say which is the best.
6. A person's decision stands above all of it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime

from .lateness import days_late, due
from .model import Counts, Policy


@dataclass(frozen=True)
class Attempt:
    """One hand-in of one module: when (None: not known, so on time) and its points, if known."""

    time: datetime | None
    score: float | None


@dataclass(frozen=True)
class Penalty:
    """Why a late hand-in counts for less, or would without late days.

    ``points`` are taken off; None where the score is not known. ``late_days`` were spent on it.
    """

    deadline: datetime
    handed_in: datetime
    days_late: int
    late_days: int
    percent: float
    points: float | None


@dataclass(frozen=True)
class Override:
    """A person's decision on the points of a module."""

    score: float
    reason: str
    by: str
    at: str


@dataclass(frozen=True)
class Settled:
    """What counts for a module: the place of the hand-in, its own points, and the final ones."""

    attempt: int
    handed_in: datetime | None
    raw_score: float | None
    score: float | None
    penalty: Penalty | None = None
    override: Override | None = None


def settle(
    policy: Policy,
    student: str,
    attempts: Mapping[str, Sequence[Attempt]],
    optional: Collection[str] = (),
    overrides: Mapping[str, Override] | None = None,
) -> dict[str, Settled]:
    """What counts of a student's attempts, by assignment; none is without an attempt.

    The attempts of a module are in the order in which they were handed in.
    """
    left = policy.late.days
    settled: dict[str, Settled] = {}
    for number in sorted(attempts, key=lambda n: (n in optional, _deadline(policy, n), n)):
        deadline = due(policy, student, number)
        found = [
            _judged(policy, deadline, place, attempt, left)
            for place, attempt in enumerate(attempts[number])
        ]
        chosen = found[-1] if policy.counts is Counts.LAST else _best(found)
        left -= chosen.penalty.late_days if chosen.penalty else 0
        override = (overrides or {}).get(number)
        settled[number] = chosen if override is None else _overridden(chosen, override)
    return {number: settled[number] for number in attempts}


def late_days_used(settled: Mapping[str, Settled]) -> int:
    """How many of a student's late days are spent."""
    return sum(one.penalty.late_days for one in settled.values() if one.penalty)


def _deadline(policy: Policy, number: str) -> datetime:
    return policy.deadlines.get(number, datetime.max.replace(tzinfo=UTC))


def _judged(
    policy: Policy, deadline: datetime | None, place: int, attempt: Attempt, left: int
) -> Settled:
    """One attempt with what being late costs it while so many late days are left."""
    plain = Settled(place, attempt.time, attempt.score, attempt.score)
    if deadline is None or attempt.time is None:
        return plain
    days = days_late(policy, deadline, attempt.time)
    if days == 0:
        return plain
    spent = 0 if attempt.score == 0 else min(days, left)
    percent = min((days - spent) * policy.late.percent_per_day, policy.late.percent_at_most)
    if attempt.score is None:
        score = points = None
    else:
        score = round(attempt.score * (1 - percent / 100), 2)
        points = round(attempt.score - score, 2)
    penalty = Penalty(deadline, attempt.time, days, spent, percent, points)
    return Settled(place, attempt.time, attempt.score, score, penalty)


def _best(found: Sequence[Settled]) -> Settled:
    best = found[0]
    for one in found:
        if one.score is None:
            return one
        if best.score is not None and one.score > best.score:
            best = one
    return best


def _overridden(chosen: Settled, override: Override) -> Settled:
    return Settled(
        chosen.attempt, chosen.handed_in, chosen.raw_score, override.score, chosen.penalty, override
    )
