"""Reading `course.toml`; every fault says the file, the key and what was expected."""

from __future__ import annotations

import tomllib
from collections.abc import Collection
from datetime import date, datetime, timedelta
from pathlib import Path
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from ..course.table import Table
from ..errors import BadInput
from ..submissions.clock import NoInstant, instant
from ..submissions.find import RULES
from .model import Counts, Extension, Late, Policy

NAME = RULES
_TIME = "a date and time such as 2026-11-20T23:59:59"
_SIZE_LIMIT = 1 << 20


def find_policy(submissions: Path, named: Path | None) -> tuple[Path, str] | None:
    """The class's file and its text: the one that was named, or else `course.toml` among the
    submissions; None when there is neither.
    """
    file = named or submissions / NAME
    if named is None and not file.is_file():
        return None
    try:
        with file.open(encoding="utf-8") as stream:
            text = stream.read(_SIZE_LIMIT + 1)
    except (OSError, UnicodeDecodeError) as error:
        words = error.strerror if isinstance(error, OSError) else "is no UTF-8 text"
        raise BadInput(f"{file}: {words}, expected a class's {NAME}") from error
    if len(text) > _SIZE_LIMIT:
        raise BadInput(f"{file}: is larger than 1 MiB, expected a class's {NAME}")
    return file, text


def parse_policy(text: str, file: Path, numbers: Collection[str] | None = None) -> Policy:
    """The rules in ``text``. ``numbers`` are the assignments that there are; None: any."""
    try:
        table = Table(file, "", tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        raise BadInput(f"{file}: {error}, expected TOML") from error
    zone = _zone(table)
    deadlines = _deadlines(table.table("deadlines"), zone, numbers)
    if deadlines and not table.has("late"):
        raise table.fault("late", "is missing", "a table [late], as there are [deadlines]")
    policy = Policy(
        course=table.text("course") if table.has("course") else None,
        zone=zone,
        counts=_counts(table),
        late=_late(table.table("late")) if table.has("late") else Late(),
        deadlines=deadlines,
        extensions=tuple(
            _extension(one, zone, deadlines)
            for one in table.tables("extension", lambda n: f"extension {n}")
        ),
    )
    table.finish()
    return policy


def _zone(table: Table) -> ZoneInfo:
    expected = "a time zone such as 'Europe/Zurich'"
    name = table.text("time_zone", "UTC")
    try:
        return ZoneInfo(name)
    except (ZoneInfoNotFoundError, ValueError, OSError) as error:
        raise table.fault("time_zone", f"is {name!r}", expected) from error


def _counts(table: Table) -> Counts:
    word = table.text("counts", Counts.LAST.value)
    if word not in list(Counts):
        raise table.fault("counts", f"is {word!r}", "'last' or 'best'")
    return Counts(word)


def _late(table: Table) -> Late:
    grace = _from_zero(table, "grace_minutes", float("inf"), 0)
    if grace >= 24 * 60:
        raise table.fault("grace_minutes", f"is {grace:g}", "less than a day")
    late = Late(
        days=table.whole("days", 0, 0),
        percent_per_day=_from_zero(table, "percent_per_day", 100),
        percent_at_most=_from_zero(table, "percent_at_most", 100, 100),
        grace=timedelta(minutes=grace),
    )
    table.finish()
    return late


def _from_zero(table: Table, key: str, most: float, default: float | None = None) -> float:
    expected = "a number, at least 0" if most == float("inf") else f"a number from 0 to {most:g}"
    value = table.take(key, (int, float), expected, default)
    if not 0 <= value <= most or value == float("inf"):
        raise table.fault(key, f"is {value!r}", expected)
    return float(value)


def _deadlines(
    table: Table, zone: ZoneInfo, numbers: Collection[str] | None
) -> dict[str, datetime]:
    known = sorted(table.keys() if numbers is None else numbers)
    found = {number: _time(table, number, zone) for number in known if table.has(number)}
    table.finish()
    return found


def _time(table: Table, key: str, zone: ZoneInfo) -> datetime:
    # TOML's plain dates are dates of Python, and its datetimes are too.
    value = table.take(key, (date, str), _TIME)
    if not isinstance(value, datetime):
        raise table.fault(key, f"is {str(value)!r}", f"{_TIME}, without quotes")
    try:
        return instant(value, zone)
    except NoInstant as problem:
        raise table.fault(key, str(problem), "a time with its offset, such as +01:00") from problem


def _extension(table: Table, zone: ZoneInfo, deadlines: Collection[str]) -> Extension:
    student = table.text("student")
    assignment = table.text("assignment") if table.has("assignment") else None
    if assignment is not None and assignment not in deadlines:
        expected = f"one with a deadline: {', '.join(deadlines) or 'there is none'}"
        raise table.fault("assignment", f"is {assignment!r}", expected)
    if table.has("days") == table.has("until"):
        raise table.fault("days", "is missing, or 'until' is there too", "one of the two")
    extension = Extension(
        student=student,
        assignment=assignment,
        days=table.whole("days", 1) if table.has("days") else 0,
        until=_time(table, "until", zone) if table.has("until") else None,
    )
    if table.has("reason"):
        table.text("reason")
    table.finish()
    return extension
