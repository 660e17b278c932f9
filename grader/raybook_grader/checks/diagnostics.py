"""Reading a compiler's warnings and errors."""

from __future__ import annotations

import re

_WARNING = re.compile(r"\bwarning: (.*)")
_ERROR = re.compile(r"\b(?:error: |fatal error: |undefined reference to )(.*)")
_QUOTED = re.compile(r"[\u2018'`][^\u2019']*[\u2019']")


def warning_count(words: str) -> int:
    """How many warnings there are."""
    return len(_WARNING.findall(words))


def first_warning(words: str) -> str:
    """The first warning without names and numbers, so that like ones count as one."""
    return _first(_WARNING, words)


def first_error(words: str) -> str:
    """The first error, likewise; "" if there is none."""
    return _first(_ERROR, words)


def _first(pattern: re.Pattern[str], words: str) -> str:
    found = pattern.search(words)
    return _QUOTED.sub("...", found[1])[:100] if found else ""
