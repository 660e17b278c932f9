"""CSV that a spreadsheet shows and never runs.

What a spreadsheet takes for a formula gets an apostrophe in front, and every cell is in quotes
(OWASP, "CSV Injection"; RFC 4180). Numbers stay numbers, negative ones too.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Sequence

from ..visible import visible

Value = str | float | None

_FORMULA = re.compile("[=+\\-@\t\r\n\uff1d\uff0b\uff0d\uff20]")
_NUMBER = re.compile(r"[+-]?\d+(\.\d+)?")
_PLAIN = ("-",)
"""Not a formula by itself: what Moodle writes for a time that never was."""


def cell(value: Value) -> str:
    """The text of a cell; empty for None."""
    if value is None:
        return ""
    if not isinstance(value, str):
        return number(value)
    if _NUMBER.fullmatch(value) or value in _PLAIN:
        return value
    value = visible(value, keep="\n\t\r\u00a0")
    begins = value.lstrip(" \u00a0")
    return f"'{value}" if _FORMULA.match(begins) or _FORMULA.match(value) else value


def number(value: float) -> str:
    """A score with at most two decimals and no exponent."""
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def table(rows: Iterable[Sequence[Value]], delimiter: str = ",") -> str:
    """The rows as CSV."""
    text = io.StringIO()
    writer = csv.writer(text, delimiter=delimiter, quoting=csv.QUOTE_ALL, lineterminator="\r\n")
    writer.writerows([[cell(value) for value in row] for row in rows])
    return text.getvalue()
