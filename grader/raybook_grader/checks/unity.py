"""Reading what a program of Unity tests prints."""

from __future__ import annotations

import re
from dataclasses import dataclass

_SUMMARY = re.compile(r"^(\d+) Tests (\d+) Failures (\d+) Ignored", re.MULTILINE)
_RESULT = re.compile(r"^([^\n:]*):(\d+):(\w+):(PASS|FAIL)(?::\s*([^\n]*))?$", re.MULTILINE)


@dataclass(frozen=True)
class FailedTest:
    """One test: its name, what it says, and the file and line of the assertion."""

    name: str
    message: str
    file: str
    line: int

    def __str__(self) -> str:
        return f"{self.name}: {self.message}" if self.message else self.name


@dataclass(frozen=True)
class UnityReport:
    """``count`` and ``failed`` are the summary's; None if the program ended before it.

    ``last`` is the last test that said anything, "" if none did.
    """

    count: int | None
    failed: int | None
    failures: tuple[FailedTest, ...]
    last: str


def read_unity(words: str) -> UnityReport:
    """What the tests said."""
    summary = _SUMMARY.search(words)
    results = list(_RESULT.finditer(words))
    failures = [FailedTest(r[3], r[5] or "", r[1], int(r[2])) for r in results if r[4] == "FAIL"]
    return UnityReport(
        count=int(summary[1]) if summary else None,
        failed=int(summary[2]) if summary else None,
        failures=tuple(failures),
        last=results[-1][3] if results else "",
    )
