"""Running an assignment's public tests."""

from __future__ import annotations

import re
import signal
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ..checks.unity import FailedTest, UnityReport, read_unity
from ..checks.words import clean
from .running import run_limited

_STUB = re.compile(r"^assignment \d\d [^:]*: not implemented yet, ([^:\n]+:\d+):", re.MULTILINE)
_BEGIN = re.compile(r"(?:static )?void (\w+)\(void\)\s*$")


@dataclass(frozen=True)
class TestRun:
    """How a test program ended. ``stopped`` says why it did not reach its end; "" if it did.

    ``left`` are the places of the stubs that the tests ran into; ``places`` says where each test
    begins, as file:line (Unity names the line of the assertion, which may be a helper's).
    """

    __test__ = False  # not one of pytest's

    report: UnityReport
    stopped: str
    left: tuple[str, ...]
    places: Mapping[str, str]

    @property
    def failures(self) -> tuple[FailedTest, ...]:
        return self.report.failures

    @property
    def is_right(self) -> bool:
        return not self.stopped and not self.failures


def run_tests(program: Path, root: Path, source: str, seconds: float) -> TestRun:
    """Run the program of the Unity tests in ``source``, at most so long."""
    ended = run_limited([str(program)], root, seconds)
    words = clean(ended.out + b"\n" + ended.err, lines=100_000)
    report = read_unity(words)
    left = tuple(dict.fromkeys(_STUB.findall(words)))
    return TestRun(report, _stopped(report, ended.code, seconds), left, _places(root, source))


def _places(root: Path, source: str) -> dict[str, str]:
    lines = (root / source).read_text(encoding="utf-8", errors="replace").splitlines()
    begins = ((_BEGIN.match(line), number) for number, line in enumerate(lines, 1))
    return {begin[1]: f"{source}:{number}" for begin, number in begins if begin}


def _stopped(report: UnityReport, ending: int | None, seconds: float) -> str:
    after = f"in the test after {report.last}" if report.last else "in the first test"
    if ending is None:
        return f"the tests did not end within {seconds:g} s: stuck {after}"
    if ending < 0:
        return f"the program crashed {after} ({_signal(-ending)})"
    if report.count is None:
        return f"the program ended too early, {after} (exit code {ending})"
    return ""


def _signal(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"
