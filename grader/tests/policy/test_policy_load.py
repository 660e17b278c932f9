"""Reading course.toml: what it says is what holds, and each fault is one message."""

from __future__ import annotations

import re
from datetime import UTC, datetime, timedelta
from pathlib import Path
from zoneinfo import ZoneInfo

import pytest
from tiny_course import CHECKOUT

from raybook_grader.course import load_course
from raybook_grader.errors import BadInput
from raybook_grader.policy import Counts, Extension, Late, Policy, find_policy, parse_policy

PAGE = CHECKOUT / "docs" / "instructor" / "policies.md"
FILE = Path("course.toml")
NUMBERS = ("01", "02", "03")
TEXT = """
time_zone = "Europe/Zurich"

[late]
percent_per_day = 10

[deadlines]
01 = 2026-10-02T23:59:00
03 = 2026-10-23T23:59:00

[[extension]]
student = "s1"
assignment = "03"
days = 2
"""


def test_the_example_of_the_docs() -> None:
    (text,) = re.findall(r"```toml\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    numbers = [assignment.number for assignment in load_course(CHECKOUT).assignments]
    assert parse_policy(text, PAGE, numbers) == Policy(
        course="Computer graphics, autumn 2026",
        zone=ZoneInfo("Europe/Zurich"),
        counts=Counts.LAST,
        late=Late(5, 10, 50, timedelta(minutes=15)),
        deadlines={
            "01": datetime(2026, 10, 2, 21, 59, tzinfo=UTC),
            "02": datetime(2026, 10, 9, 21, 59, tzinfo=UTC),
            "03": datetime(2026, 10, 23, 21, 59, tzinfo=UTC),
            "10": datetime(2026, 12, 18, 11, tzinfo=UTC),
        },
        extensions=(Extension("s042", "03", days=4),),
    )


def test_nothing_said_is_no_rule() -> None:
    assert parse_policy("", FILE, NUMBERS) == Policy()


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("[late]", "[late", "course.toml: .*expected TOML"),
        ('"Europe/Zurich"', '"Europe/Turich"', "time_zone: is 'Europe/Turich', expected a time"),
        ('"Europe/Zurich"', '"../../etc/passwd"', "time_zone: is .*, expected a time zone"),
        ("time_zone =", "timezone =", "timezone: is no key of this table, expected 'time_zone'"),
        ("[late]", 'counts = "first"\n[late]', "counts: is 'first', expected 'last' or 'best'"),
        ("percent_per_day = 10", "", "late, percent_per_day: is missing, expected a number from"),
        ("percent_per_day = 10", "percent_per_day = 101", "is 101, expected a number from 0 to"),
        ("percent_per_day = 10", "percent_per_day = nan", "is nan, expected a number from 0 to"),
        ("_day = 10", "_day = 10\ndays = -1", "late, days: is -1, expected a whole number"),
        ("_day = 10", "_day = 10\ndays = 1.5", "late, days: is 1.5, expected a whole number"),
        ("_day = 10", "_day = 10\ngrace_minutes = 2000", "grace_minutes: is 2000, expected less"),
        ("_day = 10", "_day = 10\ngrace_minutes = inf", "grace_minutes: is inf, expected"),
        ("_day = 10", "_day = 10\npercent_max = 5", "late, percent_max: is no key of this table"),
        ("[late]\npercent_per_day = 10", "", "late: is missing, expected a table"),
        ("03 = 2", "04 = 2", "deadlines, 04: is no key of this table"),
        ("2026-10-23T23:59:00", "2026-10-23", "deadlines, 03: is '2026-10-23', expected a date"),
        ("2026-10-23T23:59:00", '"2026-10-23"', "deadlines, 03: .* without quotes"),
        ("2026-10-23T23:59:00", "23", "deadlines, 03: is 23, expected a date and time"),
        ("2026-10-23T23:59:00", "2026-10-25T02:30:00", "03: clocks in Europe/Zurich show .* twice"),
        ('student = "s1"', "", "extension 1, student: is missing"),
        ('assignment = "03"', 'assignment = "02"', "assignment: is '02', expected one with a"),
        ("days = 2", "", "extension 1, days: is missing"),
        ("days = 2", "days = 2\nuntil = 2026-10-30T12:00:00", "'until' is there too, expected one"),
        ("days = 2", "days = 0", "extension 1, days: is 0, expected a whole number, at least 1"),
        ("days = 2", "days = 2\nwhy = 3", "extension 1, why: is no key of this table"),
        ("[[extension]]", "[extension]", "extension: .* expected tables, each headed"),
    ],
)
def test_faults(old: str, new: str, fault: str) -> None:
    assert old in TEXT
    with pytest.raises(BadInput, match=fault) as told:
        parse_policy(TEXT.replace(old, new), FILE, NUMBERS)
    assert str(told.value).startswith("course.toml: ")


def test_one_file_or_the_other(tmp_path: Path) -> None:
    assert find_policy(tmp_path, None) is None
    (tmp_path / "course.toml").write_text("a = 1")
    (tmp_path / "other.toml").write_text("b = 2")
    assert find_policy(tmp_path, None) == (tmp_path / "course.toml", "a = 1")
    assert find_policy(tmp_path, tmp_path / "other.toml") == (tmp_path / "other.toml", "b = 2")
    with pytest.raises(BadInput, match=r"none\.toml: No such file"):
        find_policy(tmp_path, tmp_path / "none.toml")
    (tmp_path / "course.toml").write_bytes(b"\xff")
    with pytest.raises(BadInput, match="is no UTF-8 text"):
        find_policy(tmp_path, None)
