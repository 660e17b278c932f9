"""The `robust` check: a probe's driver and cases, with the module under the sanitizers.

Nobody asks here whether the answers are right. Which is why its points are given only beside a
probe that has passed (`confirm`): a module that does nothing at all is as robust as a stone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..course import RobustCheck
from ..sandbox import BoxResult, Limits
from .oracles import cases_of
from .result import JUDGED, CheckResult, Status, conclude
from .sanitizers import ENVIRONMENT, Finding, evasions, finding
from .subject import Stopped, Subject

_SLOWER = 5
"""How many times the time a run may take: two or three are usual."""
_SHOWN = 3
_LARGER = 3
"""How many times the memory: red zones round each block, the shadow, what was freed."""


def check_robust(check: RobustCheck, subject: Subject) -> CheckResult:
    """Passed if the program answers all cases without a report.

    Raises `Stopped` if it is ended by something else than a sanitizer.
    """
    folder = subject.assignment.folder
    cases = cases_of(folder / check.oracle, check.group, check.seed)
    if hidden := evasions(subject.workshop.preprocessed(subject.module)):
        return conclude(
            check,
            Status.FAILED,
            "the module hides from the sanitizers, or asks whether they watch",
            cases=tuple(hidden[:_SHOWN]),
            fingerprint="hides from the sanitizers",
        )
    program = subject.sanitized_driver(folder / check.driver)
    try:
        result = subject.run(
            program,
            ["cases.bin", "results.bin", check.group],
            inputs={"cases.bin": cases.payload},
            collect=["results.bin"],
            limits=_limits(subject),
            env=ENVIRONMENT,
        )
    except Stopped as stop:
        if found := finding(stop.said, subject.module.files):
            return _tell(check, found, subject)
        raise
    if found := _report(result, subject):
        return _tell(check, found, subject)
    if not result.files.get("results.bin"):
        return conclude(
            check,
            Status.FAILED,
            f"the program {result.describe()} before it had answered all {cases.count} cases",
            fingerprint="ended too early",
        )
    return conclude(check, Status.PASSED, f"{cases.count} cases, and the sanitizers found nothing")


def confirm(results: Sequence[CheckResult]) -> list[CheckResult]:
    """Withhold the points of passed robust checks where no probe has passed."""
    probes = [r.status for r in results if r.kind in JUDGED]
    does_something = Status.PASSED in probes or not probes
    return [_withhold(r) if r.kind == "robust" and not does_something else r for r in results]


def _withhold(result: CheckResult) -> CheckResult:
    if result.status is not Status.PASSED:
        return result
    message = f"{result.message}; the points count only once a probe passes too"
    return replace(result, status=Status.UNCONFIRMED, score=0.0, message=message)


def _limits(subject: Subject) -> Limits:
    """AddressSanitizer reserves terabytes of addresses; resident memory is fenced all the same."""
    usual = subject.limits
    return replace(
        usual,
        wall_seconds=_SLOWER * usual.wall_seconds,
        cpu_seconds=_SLOWER * usual.cpu_seconds,
        memory_bytes=_LARGER * usual.memory_bytes,
        address_space=False,
    )


def _report(result: BoxResult, subject: Subject) -> Finding | None:
    """A report ends the program: without that, such words are the program's own."""
    return None if result.ok else finding(result.stderr, subject.module.files)


def _tell(check: RobustCheck, found: Finding, subject: Subject) -> CheckResult:
    lines = subject.module.files[found.path].split(b"\n") if found.path else []
    quoted = lines[found.line - 1].decode("utf-8", "replace").strip() if found.line else ""
    return conclude(
        check,
        Status.FAILED,
        "the sanitizers stopped the program",
        cases=(found.message,),
        words=quoted,
        fingerprint=found.kind,
    )
