"""Verdicts, points and totals from the results of checks."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from raybook_grader.checks.result import CheckResult, Status, conclude
from raybook_grader.checks.unit import confirm
from raybook_grader.course import BuildCheck, ProbeCheck, UnitCheck
from raybook_grader.database import Module, Student
from raybook_grader.grading.result import ModuleResult, from_checks
from raybook_grader.grading.totals import totals
from raybook_grader.scoring import Verdict, score_of, total, verdict_of

BUILD = BuildCheck("compiles", 1)
UNIT = UnitCheck("tests", 1, "test.c")
PROBE = ProbeCheck("edges", 3, "probe.c", "oracle.py", "edges", 1)


def results(*statuses: Status) -> list[CheckResult]:
    return [conclude(BUILD, status, "") for status in statuses]


@pytest.mark.parametrize(
    ("statuses", "verdict"),
    [
        ([Status.PASSED, Status.PASSED], Verdict.PASS),
        ([Status.PASSED, Status.PARTIAL], Verdict.PARTIAL),
        ([Status.PASSED, Status.UNCONFIRMED], Verdict.PARTIAL),
        ([Status.PARTIAL, Status.FAILED], Verdict.FAIL),
        ([Status.FAILED, Status.TIMEOUT, Status.NOT_RUN], Verdict.TIMEOUT),
        ([Status.TIMEOUT, Status.MEMORY], Verdict.MEMORY),
        ([Status.MEMORY, Status.CRASH], Verdict.CRASH),
        ([Status.CRASH, Status.FORBIDDEN], Verdict.FORBIDDEN),
        ([Status.BUILD_ERROR, Status.NOT_RUN], Verdict.BUILD_ERROR),
        ([Status.CRASH, Status.INTERNAL_ERROR], Verdict.INTERNAL_ERROR),
    ],
)
def test_verdicts(statuses: Sequence[Status], verdict: Verdict) -> None:
    assert verdict_of(results(*statuses)) is verdict
    assert verdict_of(results(*reversed(statuses))) is verdict


def test_a_pass_with_part_of_its_points_is_partial() -> None:
    almost = conclude(PROBE, Status.PASSED, "", share=0.99)
    assert verdict_of([almost]) is Verdict.PARTIAL


def test_an_internal_error_has_no_score() -> None:
    assert score_of(results(Status.PASSED, Status.INTERNAL_ERROR)) is None
    assert total([1.0, None]) is None
    assert total([0.1, 0.2]) == 0.3
    assert total([]) == 0.0


@pytest.mark.parametrize(("probe", "points"), [(Status.PASSED, 5.0), (Status.FAILED, 1.0)])
def test_unit_tests_alone_earn_nothing(probe: Status, points: float) -> None:
    told = [conclude(c, Status.PASSED, "") for c in (BUILD, UNIT)]
    confirmed = confirm([*told, conclude(PROBE, probe, "")])
    assert score_of(confirmed) == points
    assert confirmed[1].status is (Status.PASSED if points == 5 else Status.UNCONFIRMED)


def test_failed_unit_tests_stay_failed() -> None:
    confirmed = confirm([conclude(UNIT, Status.FAILED, ""), conclude(PROBE, Status.FAILED, "")])
    assert confirmed[0].status is Status.FAILED


def test_results_survive_storage() -> None:
    checks = [
        conclude(BUILD, Status.PARTIAL, "\ud800", words="w", share=0.5, cases=("a", "b")),
        conclude(PROBE, Status.INTERNAL_ERROR, "m", fingerprint="f"),
    ]
    result = from_checks(checks, "trace")
    assert ModuleResult.from_json(result.to_json()) == result


def module(number: str, points: float, optional: bool) -> Module:
    return Module(number, "m", "t", points, optional)


def test_totals_keep_optional_points_apart() -> None:
    modules = [module("01", 10, False), module("02", 5, True), module("03", 20, False)]
    done = ModuleResult(Verdict.FAIL, 4.0)
    broken = ModuleResult(Verdict.INTERNAL_ERROR, None)
    sums = totals(Student("s", None, {"01": done, "02": done}), modules)
    assert (sums.score, sums.max_score, sums.optional) == (4, 10, 4)
    sums = totals(Student("s", None, {"01": done, "02": broken, "03": None}), modules)
    assert (sums.score, sums.max_score, sums.optional) == (None, 30, None)
