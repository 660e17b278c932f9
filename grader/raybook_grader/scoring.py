"""From the checks of a module to its verdict and its points.

Points. A check's points are its own affair: a build, a unit test or a probe earns all or
nothing, an image a share by its perceptual score, a cost a share by its ratio to the
reference's. A probe with half of its cases right earns nothing: a stub that never reports a hit is
right in most of them too. The partial credit of a module lies in the number of its checks.

Verdict, the first that applies:

1. ``internal-error``: the harness failed in some check. The module has no score.
2. ``missing``: nothing was handed in, or only the stub. ``build-error``: no program to run.
3. ``forbidden``, ``crash``, ``memory``, ``timeout``: some run of the program ended so. What
   the program did worst names the module, for it is what its author must mend first.
4. ``fail``: some check found a wrong result.
5. ``partial``: no result is wrong, but points were lost (warnings, a noisier picture, more work).
6. ``pass``: every check passed with all of its points.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from enum import StrEnum

from .checks.result import CheckResult, Status


class Verdict(StrEnum):
    """The verdict on one module of one submission."""

    PASS = "pass"
    PARTIAL = "partial"
    FAIL = "fail"
    MISSING = "missing"
    BUILD_ERROR = "build-error"
    CRASH = "crash"
    TIMEOUT = "timeout"
    MEMORY = "memory"
    FORBIDDEN = "forbidden"
    INTERNAL_ERROR = "internal-error"


_WORST_FIRST = (
    (Status.INTERNAL_ERROR, Verdict.INTERNAL_ERROR),
    (Status.BUILD_ERROR, Verdict.BUILD_ERROR),
    (Status.FORBIDDEN, Verdict.FORBIDDEN),
    (Status.CRASH, Verdict.CRASH),
    (Status.MEMORY, Verdict.MEMORY),
    (Status.TIMEOUT, Verdict.TIMEOUT),
    (Status.FAILED, Verdict.FAIL),
)


def verdict_of(checks: Sequence[CheckResult]) -> Verdict:
    """The verdict on a module that was handed in."""
    statuses = {check.status for check in checks}
    for status, verdict in _WORST_FIRST:
        if status in statuses:
            return verdict
    complete = all(check.status is Status.PASSED for check in checks)
    return Verdict.PASS if complete and score_of(checks) == max_of(checks) else Verdict.PARTIAL


def score_of(checks: Iterable[CheckResult]) -> float | None:
    """The points earned; None when the harness failed in any check."""
    return total(check.score for check in checks)


def max_of(checks: Iterable[CheckResult]) -> float:
    return round(sum(check.max_score for check in checks), 2)


def total(scores: Iterable[float | None]) -> float | None:
    """A sum in which one unknown score makes the whole unknown: never silently a zero."""
    known: list[float] = []
    for score in scores:
        if score is None:
            return None
        known.append(score)
    return round(sum(known, 0.0), 2)
