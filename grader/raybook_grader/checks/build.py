"""The `build` check: its points ask for a module without warnings."""

from __future__ import annotations

from ..course import BuildCheck
from .diagnostics import first_error, first_warning, warning_count
from .program import BuildFailure
from .result import CheckResult, Status, conclude
from .subject import Subject


def check_build(check: BuildCheck, subject: Subject) -> CheckResult:
    """Passed without a warning; with some, nothing is wrong but the points are lost."""
    warnings = subject.module.warnings
    if not warnings:
        return conclude(check, Status.PASSED, "compiles without a warning")
    count = warning_count(warnings)
    message = f"compiles with {count} warning{'' if count == 1 else 's'}"
    return conclude(
        check, Status.PARTIAL, message, words=warnings, fingerprint=first_warning(warnings)
    )


def failed_build(check: BuildCheck, failure: BuildFailure) -> CheckResult:
    """The result when there is no program at all."""
    return conclude(
        check,
        Status.BUILD_ERROR,
        failure.message,
        words=failure.words,
        fingerprint=first_error(failure.words) or failure.message,
    )
