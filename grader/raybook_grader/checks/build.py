"""The `build` check: its points ask for a module without warnings."""

from __future__ import annotations

import re

from ..course import BuildCheck
from .program import BuildFailure
from .result import CheckResult, Status, conclude
from .subject import Subject

_WARNING = re.compile(r"\bwarning: (.*)")
_ERROR = re.compile(r"\b(?:error: |fatal error: |undefined reference to )(.*)")
_QUOTED = re.compile(r"[\u2018'`][^\u2019']*[\u2019']")


def check_build(check: BuildCheck, subject: Subject) -> CheckResult:
    """Passed without a warning; with some, nothing is wrong but the points are lost."""
    warnings = subject.module.warnings
    if not warnings:
        return conclude(check, Status.PASSED, "compiles without a warning")
    count = len(_WARNING.findall(warnings))
    message = f"compiles with {count} warning{'' if count == 1 else 's'}"
    return conclude(
        check, Status.PARTIAL, message, words=warnings, fingerprint=_first(_WARNING, warnings)
    )


def failed_build(check: BuildCheck, failure: BuildFailure) -> CheckResult:
    """The result when there is no program at all."""
    return conclude(
        check,
        Status.BUILD_ERROR,
        failure.message,
        words=failure.words,
        fingerprint=_first(_ERROR, failure.words) or failure.message,
    )


def _first(pattern: re.Pattern[str], words: str) -> str:
    """The first complaint without names and numbers, so that like complaints count as one."""
    found = pattern.search(words)
    return _QUOTED.sub("...", found[1])[:100] if found else ""
