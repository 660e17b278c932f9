"""The `unit` check: the public tests, run for feedback.

The tests run in the student's own process, which could print any verdict it likes. So their
word alone earns nothing: the points are given only if every probe of the module, judged outside
of the box, has passed too (`confirm`). Whoever forges the output gains nothing by it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from ..course import UnitCheck
from .result import JUDGED, CheckResult, Status, conclude
from .subject import Subject
from .words import clean

_SUMMARY = re.compile(r"^(\d+) Tests (\d+) Failures (\d+) Ignored", re.MULTILINE)
_FAILURE = re.compile(r"^[^\n:]*:\d+:(\w+):FAIL(?::\s*([^\n]*))?$", re.MULTILINE)
_SHOWN = 5


def check_unit(check: UnitCheck, subject: Subject) -> CheckResult:
    """What the tests say; see `confirm` for what that is worth.

    Raises `Stopped` if the program does not end by itself.
    """
    source = subject.assignment.folder / check.tests
    result = subject.run(subject.workshop.unit_tests(subject.module, source), [])
    words = clean(result.stdout + result.stderr)
    summary = _SUMMARY.search(words)
    failures = [f"{name}: {why}" if why else name for name, why in _FAILURE.findall(words)]
    if summary and result.ok and not failures:
        return conclude(check, Status.PASSED, f"{summary[1]} tests passed", words=words)
    told = f"{summary[2]} of {summary[1]} tests fail" if summary else "the tests stopped half way"
    return conclude(
        check,
        Status.FAILED,
        told,
        cases=tuple(failures[:_SHOWN]),
        words=words,
        fingerprint=failures[0].split(":")[0] if failures else told,
    )


def confirm(results: Sequence[CheckResult]) -> list[CheckResult]:
    """Withhold the points of passed unit checks unless every probe has passed."""
    borne_out = all(r.status is Status.PASSED for r in results if r.kind in JUDGED)
    return [_withhold(r) if r.kind == "unit" and not borne_out else r for r in results]


def _withhold(result: CheckResult) -> CheckResult:
    if result.status is not Status.PASSED:
        return result
    message = f"{result.message}; the points count only once every probe below passes too"
    return replace(result, status=Status.UNCONFIRMED, score=0.0, message=message)
