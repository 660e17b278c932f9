"""Cleaning what a compiler or a student's program said, before anybody reads it."""

from __future__ import annotations

import re

LINES = 60
LINE_LENGTH = 400

_TERMINAL_CODE = re.compile(r"\x1b(?:\[[0-?]*[ -/]*[@-~]|\][^\x07\x1b]*(?:\x07|\x1b\\)?|[@-_])")
_INVISIBLE = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ud800-\udfff]"
)


def clean(raw: bytes | str, lines: int = LINES) -> str:
    """Readable text: no terminal codes, no characters that hide or reorder others, cut to size."""
    text = raw if isinstance(raw, str) else raw.decode("utf-8", "replace")
    text = _TERMINAL_CODE.sub("", text.replace("\r\n", "\n").replace("\r", "\n"))
    rows = _INVISIBLE.sub("\N{REPLACEMENT CHARACTER}", text).expandtabs(8).rstrip().split("\n")
    kept = [_shorten(row) for row in rows[:lines]]
    if len(rows) > lines:
        kept.append(f"... and {len(rows) - lines} more lines")
    return "\n".join(kept)


def _shorten(row: str) -> str:
    return row if len(row) <= LINE_LENGTH else row[:LINE_LENGTH] + " ..."
