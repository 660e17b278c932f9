"""The `unit` check: the public tests, run for feedback.

The tests run in the student's own process, which could print any verdict it likes. So their
word alone earns nothing: the points are given only if every probe of the module, judged outside
of the box, has passed too (`confirm`). Whoever forges the output gains nothing by it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..course import UnitCheck
from ..diagnosis.trace import trace_of_names
from .result import JUDGED, CheckResult, Status, conclude
from .subject import Subject
from .unity import read_unity
from .words import clean

_SHOWN = 5


def check_unit(check: UnitCheck, subject: Subject) -> CheckResult:
    """What the tests say; see `confirm` for what that is worth.

    Raises `Stopped` if the program does not end by itself.
    """
    source = subject.assignment.folder / check.tests
    result = subject.run(subject.workshop.unit_tests(subject.module, source), [])
    words = clean(result.stdout + result.stderr)
    tests = read_unity(words)
    if tests.count is not None and result.ok and not tests.failures:
        return conclude(check, Status.PASSED, f"{tests.count} tests passed", words=words)
    told = "the tests stopped half way"
    if tests.count is not None:
        told = f"{tests.failed} of {tests.count} tests fail"
    return conclude(
        check,
        Status.FAILED,
        told,
        cases=tuple(map(str, tests.failures[:_SHOWN])),
        words=words,
        fingerprint=tests.failures[0].name if tests.failures else told,
        trace=trace_of_names(failure.name for failure in tests.failures),
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
