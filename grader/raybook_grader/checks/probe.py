"""The `probe` check: a driver runs in the box on cases that an oracle judges outside of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from ..course import ProbeCheck
from ..diagnosis.trace import trace_of_cases
from ..probes import Failure
from .oracles import cases_of, load_oracle
from .result import CheckResult, Status, conclude
from .subject import Subject

_SHOWN = 3


def check_probe(check: ProbeCheck, subject: Subject) -> CheckResult:
    """Passed if no case fails; a failure tells the simplest case in words.

    Raises `Stopped` if the program gives no answer.
    """
    folder = subject.assignment.folder
    cases = cases_of(folder / check.oracle, check.group, check.seed)
    program = subject.driver(folder / check.driver)
    result = subject.run(
        program,
        ["cases.bin", "results.bin", check.group],
        inputs={"cases.bin": cases.payload},
        collect=["results.bin"],
    )
    if not result.ok or "results.bin" not in result.files:
        return conclude(
            check,
            Status.FAILED,
            f"the program {result.describe()} before it had answered all {cases.count} cases",
            fingerprint="ended too early",
        )
    failures = load_oracle(folder / check.oracle).judge(cases, result.files["results.bin"])
    if not failures:
        return conclude(check, Status.PASSED, f"all {cases.count} cases are right")
    return _tell(check, cases.count, failures)


def _tell(check: ProbeCheck, count: int, failures: Sequence[Failure]) -> CheckResult:
    shown = _simplest_of_each_kind(failures)
    kinds = Counter(failure.fingerprint for failure in failures)
    wrong = len({failure.case for failure in failures})
    return conclude(
        check,
        Status.FAILED,
        f"{wrong} of {count} cases {'is' if wrong == 1 else 'are'} wrong",
        cases=tuple(failure.message for failure in shown),
        fingerprint=kinds.most_common(1)[0][0],
        trace=trace_of_cases(count, failures),
    )


def _simplest_of_each_kind(failures: Sequence[Failure]) -> list[Failure]:
    """The simplest failure of each fingerprint, the simplest of all first."""
    best: dict[str, Failure] = {}
    for failure in sorted(failures, key=lambda f: -f.simplicity):
        best.setdefault(failure.fingerprint, failure)
    return list(best.values())[:_SHOWN]
