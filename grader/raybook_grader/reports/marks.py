"""How verdicts and statuses look: never by colour alone."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..checks.result import Status
from ..scoring import Verdict


@dataclass(frozen=True)
class Mark:
    """A sign and a tone (a CSS class); the word itself is shown beside the sign.

    ``cell`` is the sign where there is no room for the word: a different one for each verdict.
    """

    sign: str
    tone: str
    letter: str = ""

    @property
    def cell(self) -> str:
        return self.letter or self.sign


_GOOD = Mark("\u2713", "good")
_FAIR = Mark("\u25d0", "fair")
_BAD = Mark("\u2717", "bad")
_STOPPED = Mark("\u26a0", "stopped")
_NONE = Mark("\u2013", "none")
_OURS = Mark("\u203c", "ours")

_STOPPED_BY = {letter: replace(_STOPPED, letter=letter) for letter in "BCTMF"}

_VERDICTS = {
    Verdict.PASS: _GOOD,
    Verdict.PARTIAL: _FAIR,
    Verdict.FAIL: _BAD,
    Verdict.MISSING: _NONE,
    Verdict.BUILD_ERROR: _STOPPED_BY["B"],
    Verdict.CRASH: _STOPPED_BY["C"],
    Verdict.TIMEOUT: _STOPPED_BY["T"],
    Verdict.MEMORY: _STOPPED_BY["M"],
    Verdict.FORBIDDEN: _STOPPED_BY["F"],
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
