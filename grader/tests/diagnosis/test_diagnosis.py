"""The nearest known mistake: the right one where there is one, and silence elsewhere."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

import numpy as np
import pytest

from raybook_grader.checks.result import CheckResult, Status
from raybook_grader.diagnosis import Known, load_known, nearest, save_known
from raybook_grader.diagnosis.trace import (
    Trace,
    likeness,
    trace_of_cases,
    trace_of_names,
    trace_of_picture,
    trace_of_ratio,
)
from raybook_grader.errors import BadInput
from raybook_grader.probes import Failure

COUNT = 1000


def cases(wrong: Collection[int], kind: str = "missed") -> Trace:
    return trace_of_cases(COUNT, [Failure(case, "message", kind) for case in wrong])


def check(name: str, status: Status = Status.FAILED, trace: Trace | None = None) -> CheckResult:
    return CheckResult(name, "probe", 0.0, 1.0, status, "", trace=trace or {})


def known(slug: str, wrong: Collection[int], kind: str = "missed") -> Known:
    return Known(slug, f"hint of {slug}", (check("rays", trace=cases(wrong, kind)),))


LIBRARY = [
    known("first-half", range(500)),
    known("second-half", range(500, 1000)),
    known("every-third", range(0, 1000, 3), "wrong t"),
]


def said(wrong: Collection[int], kind: str = "missed") -> list[str]:
    found = nearest([check("rays", trace=cases(wrong, kind))], LIBRARY)
    return [diagnosis.mistake for diagnosis in found]


def test_the_same_cases_are_the_same_mistake() -> None:
    (only,) = nearest([check("rays", trace=cases(range(500)))], LIBRARY)
    assert only.mistake == "first-half"
    assert only.confidence > 0.95
    assert only.hint == "hint of first-half"
    assert "rays" in only.because


def test_nearly_the_same_cases_are_near_enough() -> None:
    assert said(range(0, 480)) == ["first-half"]
    assert said(range(1, 1000, 3), "wrong t")[:1] != ["every-third"]


def test_what_is_far_from_everything_is_not_named() -> None:
    assert said(range(490, 520), "other kind") == []
    assert nearest([check("rays", Status.CRASH)], LIBRARY) == ()


@pytest.mark.parametrize("status", [Status.PASSED, Status.PARTIAL, Status.NOT_RUN])
def test_silent_on_what_is_not_wrong(status: Status) -> None:
    assert nearest([check("rays", status)], LIBRARY) == ()


def test_nothing_is_known_at_first() -> None:
    assert nearest([check("rays", trace=cases([1]))], []) == ()


def test_two_that_are_alike_share_the_confidence() -> None:
    twins = [known("one", range(500)), known("other", range(501))]
    found = nearest([check("rays", trace=cases(range(500)))], twins)
    assert [d.mistake for d in found] == ["one", "other"]
    assert 0.4 < found[1].confidence <= found[0].confidence < 0.6


def test_a_check_that_only_one_of_them_fails_counts_against() -> None:
    checks = [check("rays", trace=cases(range(500))), check("edges", trace=cases([1]))]
    (unasked,) = nearest(checks, [known("first-half", range(500))])
    assert unasked.confidence > 0.95, "a check that was not run says nothing"
    passed = Known("x", "", (*LIBRARY[0].checks, check("edges", Status.PASSED)))
    (both,) = nearest(checks, [passed])
    assert both.confidence < 0.6


def test_traces_are_compared_by_what_they_hold() -> None:
    assert likeness(cases([1, 2]), cases([1, 2])) == pytest.approx(1.0)
    assert likeness(cases([1, 2]), cases([3, 4], "other")) == pytest.approx(0.0)
    assert likeness(trace_of_names(["a", "b"]), trace_of_names(["b", "c"])) == pytest.approx(1 / 3)
    assert likeness(trace_of_ratio(2.0), trace_of_ratio(2.0)) == pytest.approx(1.0)
    assert likeness(trace_of_ratio(2.0), trace_of_ratio(20.0)) == pytest.approx(0.0)
    assert likeness(cases([1]), trace_of_names(["a"])) is None
    assert likeness({}, {}) is None


def test_cases_out_of_range_leave_no_trace() -> None:
    trace = trace_of_cases(3, [Failure(7, "m", "k"), Failure(-1, "m", "k"), Failure(2, "m", "k")])
    assert likeness(trace, trace_of_cases(3, [Failure(2, "m", "k")])) == pytest.approx(1.0)


def test_pictures_are_alike_where_the_light_is_wrong_alike() -> None:
    reference = np.ones((64, 64, 3), np.float32)
    left, right = reference.copy(), reference.copy()
    left[:, :32] = 0.5
    right[:, 32:] = 0.5
    traces = [trace_of_picture(["R"], image, reference) for image in (left, right, left * 1.01)]
    assert likeness(traces[0], traces[0]) == pytest.approx(1.0)
    assert likeness(traces[0], traces[1]) == pytest.approx(0.0)
    almost = likeness(traces[0], traces[2])
    assert almost is not None and almost > 0.9
    tiny = trace_of_picture(["size"], reference[:3, :3], reference[:3, :3])
    assert likeness(tiny, traces[0]) is None


def test_what_is_known_is_kept(tmp_path: Path) -> None:
    file = tmp_path / "deep" / "known.json"
    save_known(file, LIBRARY)
    loaded = {k.slug: k for k in load_known(file)}
    assert loaded == {k.slug: k for k in LIBRARY}
    file.write_text("[{}]")
    with pytest.raises(BadInput, match="expected known mistakes"):
        load_known(file)
