"""Gradescope: the `results.json` of one submission.

Format: Gradescope's Autograder Specifications, "Output format", "Controlling Test Case Visibility"
and "Test case status". One test is one check. The total is the grader's own sum, at the top.

Visibility: a check that is hidden in `assignment.toml` is shown when the grades are published
(`after_published`, unless another rule is asked for), because its words tell what the hidden cases
are; every other check is visible at once. A check that the course does not know is taken for
hidden. While a check is hidden, Gradescope does not show the total either.

Without a total, or a score in any test, Gradescope refuses the file and gives no grade. That is
what a failure of the harness has to look like: such a submission gets no score anywhere.
"""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping
from typing import Any

from ..course import Course
from ..database import Module
from .gradebook import Gradebook, Mark, Row

VISIBILITIES = ("after_published", "after_due_date", "hidden", "visible")
_NO_FAULT = ("passed", "not run")


def open_checks(course: Course) -> set[tuple[str, str]]:
    """The (assignment, check) pairs that are no secret."""
    return {
        (assignment.number, check.name)
        for assignment in course.assignments
        for check in assignment.checks
        if not check.hidden
    }


def results(
    row: Row, gradebook: Gradebook, visible: Collection[tuple[str, str]], hidden: str
) -> dict[str, Any]:
    """One submission's results; ``visible`` are its open checks, ``hidden`` is the others' rule."""
    is_known = row.score is not None
    values: dict[str, Any] = {
        "output": "\n".join(_words(row, gradebook)),
        "output_format": "text",
        "test_output_format": "text",
        "test_name_format": "text",
        "stdout_visibility": "hidden",
        "tests": [],
    }
    if is_known:
        values["score"] = row.score
    for module in gradebook.modules:
        mark = row.marks.get(module.number)
        if mark is not None and not mark.checks:
            values["tests"].append(_unchecked(module, mark, is_known))
        for i, check in enumerate(mark.checks if mark else (), 1):
            shown = "visible" if (module.number, check["name"]) in visible else hidden
            values["tests"].append(_test(module, i, check, shown, is_known))
    return values


def results_text(values: Mapping[str, Any]) -> str:
    return json.dumps(values, indent=1) + "\n"


def _test(
    module: Module, place: int, check: Mapping[str, Any], visibility: str, is_known: bool
) -> dict[str, Any]:
    passed = check["status"] == "passed"
    test: dict[str, Any] = {
        "name": f"{module.number} {module.module}: {check['name']}",
        "number": f"{int(module.number)}.{place}",
        "status": "passed" if passed else "failed",
        "output": check["message"] if passed else f"{check['status']}: {check['message']}",
        "visibility": visibility,
    }
    if is_known and check["score"] is not None:
        test |= {"score": check["score"], "max_score": check["max_score"]}
    return test


def _unchecked(module: Module, mark: Mark, is_known: bool) -> dict[str, Any]:
    """A module without a check: nothing was handed in, or the harness failed."""
    test: dict[str, Any] = {
        "name": f"{module.number} {module.module}",
        "number": str(int(module.number)),
        "status": "failed",
        "output": mark.message,
        "visibility": "visible",
    }
    if is_known and mark.score is not None:
        test |= {"score": mark.score, "max_score": mark.max_score}
    return test


def _words(row: Row, gradebook: Gradebook) -> list[str]:
    lines = [row.problem] if row.problem else []
    for module in gradebook.modules:
        mark = row.marks.get(module.number)
        if mark is not None:
            lines.append(f"{module.number} {module.module}: {_line(mark)}")
    if row.score is None:
        return [*lines, "The grader failed in some module, so there is no score yet. This is not "
                "your doing; the course's staff has to run it again."]  # fmt: skip
    return lines


def _line(mark: Mark) -> str:
    """Points are in the tests: told here, they would give away what hidden checks found."""
    return mark.message or ("graded" if mark.score is not None else "no score")
