"""Who handed something in, and when: `s042--2026-11-20T23:10:00+01:00` and the like."""

from __future__ import annotations

import re
from datetime import datetime
from pathlib import Path
from zoneinfo import ZoneInfo

from ..errors import BadInput
from .clock import NoInstant, instant

_MARK = "--"
_LIKE_A_TIME = re.compile(r"\d{4}-?\d\d-?\d\dT?")


def split_name(folder: Path, name: str, zone: ZoneInfo) -> tuple[str, datetime | None]:
    """The student and the time of a submission's name (without a suffix); None without a time.

    The time is what follows the last `--`, in ISO 8601, with colons and hyphens or without.
    What begins like a date there and is no time is a fault: never silently another student.
    """
    student, mark, text = name.rpartition(_MARK)
    if not mark or not student or not _LIKE_A_TIME.match(text):
        return name, None
    expected = "expected a time such as 2026-11-20T23:10:00+01:00 or 20261120T221000Z after the --"
    try:
        if "T" not in text:
            raise ValueError("a date without a time of day")
        return student, instant(datetime.fromisoformat(text), zone)
    except NoInstant as problem:
        raise BadInput(f"{folder / name}: {problem}, expected an offset too") from problem
    except (ValueError, OverflowError) as error:
        raise BadInput(f"{folder / name}: {error}; {expected}") from error
