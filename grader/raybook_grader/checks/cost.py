"""The `cost` check: how much work right answers take, counted and never timed.

The driver runs in the box with the student's module, and once a process with the reference in its
place. The oracle counts the work behind both outputs; the points hang on the ratio.
"""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import cast

from ..course import Assignment, CostCheck
from ..probes import Cases, CostOracle
from ..sandbox import Limits
from .oracles import cases_of, load_oracle
from .program import HarnessFault, Workshop
from .result import CheckResult, Status, conclude
from .subject import Subject

_RESULTS = "results.bin"
_REFERENCE_LIMITS = Limits(wall_seconds=600, cpu_seconds=300, memory_bytes=4 << 30)


def check_cost(check: CostCheck, subject: Subject) -> CheckResult:
    """Passed up to a ratio of `full`, failed from `none` on; wrong answers earn nothing.

    Raises `Stopped` if the program gives no answer.
    """
    folder = subject.assignment.folder
    cases = cases_of(folder / check.oracle, check.group, check.seed)
    result = subject.run(
        subject.driver(folder / check.driver),
        _arguments(check),
        inputs={"cases.bin": cases.payload},
        collect=[_RESULTS],
    )
    if not result.ok or _RESULTS not in result.files:
        message = f"the program {result.describe()} before it had answered all {cases.count} cases"
        return conclude(check, Status.FAILED, message, fingerprint="ended too early")
    oracle = cost_oracle(folder / check.oracle)
    failures = oracle.judge(cases, result.files[_RESULTS])
    if failures:
        worst = max(failures, key=lambda failure: failure.simplicity)
        return conclude(
            check,
            Status.FAILED,
            "answers are wrong, so what they cost counts for nothing",
            cases=(worst.message,),
            fingerprint=worst.fingerprint,
        )
    cost = _counted(oracle, cases, result.files[_RESULTS])
    return weigh(
        check, cost, reference_cost(check, subject.workshop, subject.assignment), oracle.COUNTED
    )


def weigh(check: CostCheck, cost: float, reference: float, counted: str) -> CheckResult:
    """The verdict on a cost; ``counted`` says what was counted."""
    ratio = cost / reference
    share = share_of(ratio, check.full, check.none)
    status = Status.PASSED if share == 1 else Status.PARTIAL if share > 0 else Status.FAILED
    return conclude(
        check,
        status,
        f"{ratio:.3g} times as many {counted} as the reference ({cost:.4g} against "
        f"{reference:.4g}; all points up to {check.full:g} times, none from {check.none:g} times)",
        share=share,
        fingerprint="" if share == 1 else f"too many {counted}",
    )


def share_of(ratio: float, full: float, none: float) -> float:
    """The part of the points that a ratio earns: 1 up to ``full``, 0 from ``none`` on."""
    if ratio <= full:
        return 1.0
    if ratio >= none:
        return 0.0
    return math.log(none / ratio) / math.log(none / full)


def cost_oracle(file: Path) -> CostOracle:
    """The oracle at ``file``, which must be able to count."""
    oracle = load_oracle(file)
    if not callable(getattr(oracle, "cost", None)) or not hasattr(oracle, "COUNTED"):
        raise HarnessFault(f"{file}: defines no cost and COUNTED, expected a CostOracle")
    return cast(CostOracle, oracle)


@cache
def reference_cost(check: CostCheck, workshop: Workshop, assignment: Assignment) -> float:
    """What the reference needs for the same cases; no submission has a say in it."""
    folder = assignment.folder
    cases = cases_of(folder / check.oracle, check.group, check.seed)
    result = workshop.box.run(
        ["/program", *_arguments(check)],
        inputs={
            "/program": workshop.driver(None, folder / check.driver),
            "cases.bin": cases.payload,
        },
        collect=[_RESULTS],
        limits=_REFERENCE_LIMITS,
    )
    if not result.ok or _RESULTS not in result.files:
        raise HarnessFault(f"{check.name}: the reference {result.describe()}, expected results")
    oracle = cost_oracle(folder / check.oracle)
    if failures := oracle.judge(cases, result.files[_RESULTS]):
        raise HarnessFault(f"{check.name}: the reference is wrong: {failures[0].message}")
    return _counted(oracle, cases, result.files[_RESULTS])


def _arguments(check: CostCheck) -> list[str]:
    return ["cases.bin", _RESULTS, check.group]


def _counted(oracle: CostOracle, cases: Cases, output: bytes) -> float:
    cost = oracle.cost(cases, output)
    if not (math.isfinite(cost) and cost > 0):
        raise HarnessFault(f"an oracle counted a cost of {cost}, expected a number above 0")
    return cost
