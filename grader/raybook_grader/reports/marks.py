"""How verdicts and statuses look: never by colour alone."""

from __future__ import annotations

from dataclasses import dataclass

from ..checks.result import Status
from ..scoring import Verdict


@dataclass(frozen=True)
class Mark:
    """A sign and a tone (a CSS class); the word itself is shown beside the sign."""

    sign: str
    tone: str


_GOOD = Mark("\u2713", "good")
_FAIR = Mark("\u25d0", "fair")
_BAD = Mark("\u2717", "bad")
_STOPPED = Mark("\u26a0", "stopped")
_NONE = Mark("\u2013", "none")
_OURS = Mark("\u203c", "ours")

_VERDICTS = {
    Verdict.PASS: _GOOD,
    Verdict.PARTIAL: _FAIR,
    Verdict.FAIL: _BAD,
    Verdict.MISSING: _NONE,
    Verdict.INTERNAL_ERROR: _OURS,
}
_STATUSES = {
    Status.PASSED: _GOOD,
    Status.PARTIAL: _FAIR,
    Status.UNCONFIRMED: _FAIR,
    Status.FAILED: _BAD,
    Status.NOT_RUN: _NONE,
    Status.INTERNAL_ERROR: _OURS,
}


def mark_of(word: Verdict | Status | None) -> Mark:
    """The mark of a verdict or a status; what is in neither table stopped a program."""
    if word is None:
        return _NONE
    if isinstance(word, Verdict):
        return _VERDICTS.get(word, _STOPPED)
    return _STATUSES.get(word, _STOPPED)
