"""What verdicts, statuses and kinds of checks mean, for those who read a report."""

from __future__ import annotations

import re

from ..checks.result import CheckResult, Status
from ..grading.result import ModuleResult
from ..scoring import Verdict

VERDICTS = {
    Verdict.PASS: "Every check passed with all of its points.",
    Verdict.PARTIAL: "No result is wrong, but some points were lost.",
    Verdict.FAIL: "Some result is wrong.",
    Verdict.MISSING: "There is nothing to grade yet.",
    Verdict.BUILD_ERROR: "It does not compile and link, so nothing could be run.",
    Verdict.CRASH: "Some run of the program crashed.",
    Verdict.TIMEOUT: "Some run of the program took too long.",
    Verdict.MEMORY: "Some run of the program needed too much memory.",
    Verdict.FORBIDDEN: "Some run of the program did what no renderer needs to do.",
    Verdict.INTERNAL_ERROR: "The grader itself failed. This costs no points: the module has no "
    "score until it is graded again.",
}

STATUSES = {
    Status.PASSED: "nothing is wrong",
    Status.PARTIAL: "nothing is wrong, but not all points are earned",
    Status.UNCONFIRMED: "passed by its own word only: no judged check bears it out",
    Status.FAILED: "a result is wrong",
    Status.BUILD_ERROR: "it does not compile or link",
    Status.CRASH: "the program crashed",
    Status.TIMEOUT: "the program took too long",
    Status.MEMORY: "the program needed too much memory",
    Status.FORBIDDEN: "the program did what no renderer needs to do",
    Status.NOT_RUN: "this check was passed over",
    Status.INTERNAL_ERROR: "the grader itself failed",
}

KINDS = {
    "build": "Compiles as C99; warnings cost points",
    "unit": "The public tests, run again here",
    "probe": "Many inputs, each answer against an independent oracle",
    "statistics": "Many random results together, against what theory expects",
    "robust": "The same inputs and harder ones, under the sanitizers",
    "cost": "Work is counted, never timed, and compared with the reference's",
    "image": "A scene rendered with this module in the reference renderer",
    "artefact": "A file that tools made",
}


_CASE = re.compile(r"(?P<case>.+): expected (?P<expected>.+?), got (?P<got>.+)", re.DOTALL)


def parts_of(case: str) -> dict[str, str]:
    """A failing case with what was expected and what came, where it is told so."""
    found = _CASE.fullmatch(case)
    return found.groupdict() if found else {}


def headline(result: ModuleResult | None) -> str:
    """Why a module has its points, in a sentence or two."""
    if result is None:
        return "It is not graded yet."
    if result.message:
        return result.message
    worst = first_trouble(result)
    return f"{worst.name}: {worst.told}" if worst else VERDICTS[result.verdict]


def first_trouble(result: ModuleResult) -> CheckResult | None:
    """The check to look at first: one that names the verdict, else any that lost points."""
    named = [c for c in result.checks if c.status.value == _STATUS_OF.get(result.verdict)]
    lost = [c for c in result.checks if c.status is not Status.PASSED]
    return next(iter([*named, *lost]), None)


_STATUS_OF = {verdict: verdict.value for verdict in Verdict} | {Verdict.FAIL: Status.FAILED.value}
