"""Students' modules compiled by clang: the confusion table must not hang on the compiler.

`make calibrate ARGS="--cc clang"` judges everything with it; here are what once went wrong.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from raybook_grader.calibration.judging import Compiler
from raybook_grader.checks.program import Workshop
from raybook_grader.checks.reference import References
from raybook_grader.checks.result import CheckResult, Status
from raybook_grader.course import BuildCheck, RobustCheck, load_course
from raybook_grader.grading.module import ModuleGrader
from raybook_grader.kit import load_kit
from raybook_grader.museum import exhibits_of
from raybook_grader.sandbox import Box
from raybook_grader.submissions import SubmittedFile

ROOT = Path(__file__).resolve().parents[3]
COURSE = load_course(ROOT)


@pytest.fixture(scope="module")
def workshop() -> Workshop:
    kit = load_kit(ROOT / "build" / "kit")
    return Workshop(COURSE, Compiler("clang").apply(kit), Box())


def judged(workshop: Workshop, name: str) -> list[CheckResult]:
    """What the build and robust checks say of an exhibit."""
    whole = COURSE.assignment(name.split("/")[0])
    checks = tuple(c for c in whole.checks if isinstance(c, BuildCheck | RobustCheck))
    (exhibit,) = (e for e in exhibits_of(ROOT, whole) if e.name == name)
    files = {path: SubmittedFile(content) for path, content in exhibit.files.items()}
    grader = ModuleGrader(workshop, References(workshop))
    return list(grader.grade(replace(whole, checks=checks), files).checks)


def test_the_harness_adds_no_warning_and_counts_in_each_thread(workshop: Workshop) -> None:
    """Flags of gcc alone were warned about; thread-local counters called what is not there."""
    results = judged(workshop, "03/reference")
    assert [r.status for r in results] == [Status.PASSED] * 3, results


def test_a_read_that_is_not_used_is_still_seen(workshop: Workshop) -> None:
    build, robust = judged(workshop, "01/reads-a-fourth-corner")
    assert build.status is Status.PASSED, build.words
    assert robust.status is Status.FAILED, robust.message
