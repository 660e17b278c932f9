"""Deadlines and days late, over the nights when the clocks change."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from zoneinfo import ZoneInfo

import pytest

from raybook_grader.policy.lateness import days_late, due
from raybook_grader.policy.model import Extension, Late, Policy
from raybook_grader.submissions.clock import NoInstant, days_after, instant

ZURICH = ZoneInfo("Europe/Zurich")
DEADLINE = "2026-11-20T23:59:00"


def at(text: str, zone: ZoneInfo = ZURICH) -> datetime:
    return instant(datetime.fromisoformat(text), zone)


def test_a_time_without_an_offset_is_the_zone_s() -> None:
    assert at("2026-07-01T12:00") == datetime(2026, 7, 1, 10, tzinfo=UTC)
    assert at("2026-12-01T12:00") == datetime(2026, 12, 1, 11, tzinfo=UTC)
    assert at("2026-12-01T12:00-08:00") == datetime(2026, 12, 1, 20, tzinfo=UTC)


@pytest.mark.parametrize(
    ("text", "words"), [("2026-10-25T02:30", "twice"), ("2026-03-29T02:30", "never")]
)
def test_a_time_that_clocks_show_twice_or_never_is_refused(text: str, words: str) -> None:
    with pytest.raises(NoInstant, match=words):
        at(text)
    assert at(text + "+02:00") + timedelta(hours=1) == at(text + "+01:00")


@pytest.mark.parametrize(
    ("handed_in", "days"),
    [
        ("2026-11-20T23:58:59", 0),
        ("2026-11-20T23:59:00", 0),
        ("2026-11-20T23:59:01", 1),
        ("2026-11-21T23:59:00", 1),
        ("2026-11-21T23:59:01", 2),
        ("2026-11-20T23:59:00+00:00", 1),
        ("2027-01-20T23:59:00", 61),
        ("2020-01-01T00:00:00", 0),
    ],
)
def test_days_late(handed_in: str, days: int) -> None:
    assert days_late(Policy(zone=ZURICH), at(DEADLINE), at(handed_in)) == days


@pytest.mark.parametrize(
    ("handed_in", "days"),
    [
        ("2026-11-21T00:14:00", 0),
        ("2026-11-21T00:14:01", 1),
        ("2026-11-22T00:14:00", 1),
        ("2026-11-22T00:14:01", 2),
    ],
)
def test_grace_is_given_each_day(handed_in: str, days: int) -> None:
    policy = Policy(zone=ZURICH, late=Late(grace=timedelta(minutes=15)))
    assert days_late(policy, at(DEADLINE), at(handed_in)) == days


@pytest.mark.parametrize(
    ("deadline", "handed_in", "days"),
    [
        # 25 hours, then 23: a day ends at the deadline's time of day.
        ("2026-10-24T23:59:00", "2026-10-25T23:59:00", 1),
        ("2026-10-24T23:59:00", "2026-10-25T23:59:01", 2),
        ("2026-03-28T23:59:00", "2026-03-29T23:59:00", 1),
        ("2026-03-28T23:59:00", "2026-03-29T23:59:01", 2),
        # The hour that clocks show twice, and the one that they never show.
        ("2026-10-24T02:30:00", "2026-10-25T02:30:00+01:00", 1),
        ("2026-10-24T02:30:00", "2026-10-25T02:30:01+01:00", 2),
        ("2026-03-28T02:30:00", "2026-03-29T03:30:00", 1),
        ("2026-03-28T02:30:00", "2026-03-29T03:30:01", 2),
    ],
)
def test_days_when_the_clocks_change(deadline: str, handed_in: str, days: int) -> None:
    assert days_late(Policy(zone=ZURICH), at(deadline), at(handed_in)) == days


def test_a_day_that_a_country_left_out() -> None:
    apia = ZoneInfo("Pacific/Apia")  # went from the 29th to the 31st of December 2011
    deadline = at("2011-12-29T12:00", apia)
    assert days_late(Policy(zone=apia), deadline, at("2011-12-31T12:00", apia)) == 1
    assert days_after(deadline, 2, apia) == at("2011-12-31T12:00", apia)


@pytest.mark.parametrize(
    ("extensions", "expected"),
    [
        ([], DEADLINE),
        ([Extension("s1", "03", days=2)], "2026-11-22T23:59:00"),
        ([Extension("s1", None, days=2)], "2026-11-22T23:59:00"),
        ([Extension("s2", "03", days=2)], DEADLINE),
        ([Extension("s1", "04", days=2)], DEADLINE),
        ([Extension("s1", "03", until=at("2026-11-25T08:00"))], "2026-11-25T08:00:00"),
        ([Extension("s1", None, until=at("2026-11-01T08:00"))], DEADLINE),
        ([Extension("s1", None, days=1), Extension("s1", "03", days=3)], "2026-11-23T23:59:00"),
        ([Extension("s1", "03", days=3), Extension("s1", None, days=1)], "2026-11-23T23:59:00"),
    ],
)
def test_extensions(extensions: list[Extension], expected: str) -> None:
    policy = Policy(zone=ZURICH, deadlines={"03": at(DEADLINE)}, extensions=tuple(extensions))
    assert due(policy, "s1", "03") == at(expected)
    assert due(policy, "s1", "09") is None


def test_an_extension_over_the_change_of_clocks_ends_at_the_same_time_of_day() -> None:
    policy = Policy(
        zone=ZURICH,
        deadlines={"03": at("2026-10-24T12:00")},
        extensions=(Extension("s1", "03", days=2),),
    )
    assert due(policy, "s1", "03") == at("2026-10-26T12:00")
