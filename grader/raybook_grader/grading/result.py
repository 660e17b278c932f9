"""The result of grading one module of one submission."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..checks.result import CheckResult
from ..diagnosis import Diagnosis
from ..scoring import Verdict, score_of, verdict_of


@dataclass(frozen=True)
class ModuleResult:
    """``score`` is None exactly when the verdict is ``internal-error``.

    ``message`` says what no check can: why nothing was graded. ``traceback`` is for the harness's
    maintainers and never shown to a student.
    """

    verdict: Verdict
    score: float | None
    message: str = ""
    checks: tuple[CheckResult, ...] = ()
    traceback: str = ""
    diagnosis: tuple[Diagnosis, ...] = ()
    """Known mistakes that it looks like, the likeliest first."""
    unsafe: bool = False
    """Whether the student's code ran without the sandbox's walls: no result to rely on."""

    def to_json(self) -> dict[str, Any]:
        return {
            "verdict": self.verdict.value,
            "score": self.score,
            "message": self.message,
            "checks": [check.to_json() for check in self.checks],
            "traceback": self.traceback,
            "diagnosis": [diagnosis.to_json() for diagnosis in self.diagnosis],
            "unsafe": self.unsafe,
        }

    @classmethod
    def from_json(cls, values: dict[str, Any]) -> ModuleResult:
        """The inverse of `to_json`, through a JSON text."""
        return cls(
            verdict=Verdict(values["verdict"]),
            score=values["score"],
            message=values["message"],
            checks=tuple(CheckResult.from_json(check) for check in values["checks"]),
            traceback=values["traceback"],
            diagnosis=tuple(Diagnosis(**diagnosis) for diagnosis in values["diagnosis"]),
            unsafe=values.get("unsafe", False),
        )

    def without_pictures(self) -> ModuleResult:
        return replace(self, checks=tuple(replace(c, picture="") for c in self.checks))

    def with_pictures(self, pictures: dict[int, str]) -> ModuleResult:
        """The same with the pictures of the checks at the given places."""
        checks = tuple(replace(c, picture=pictures.get(i, "")) for i, c in enumerate(self.checks))
        return replace(self, checks=checks)


def from_checks(checks: Sequence[CheckResult], traceback: str = "") -> ModuleResult:
    """The result of a module whose checks have all run or been passed over."""
    return ModuleResult(verdict_of(checks), score_of(checks), "", tuple(checks), traceback)


def missing(message: str) -> ModuleResult:
    """Nothing to grade: no points, and the reason."""
    return ModuleResult(Verdict.MISSING, 0.0, message)


def internal_error(message: str, traceback: str) -> ModuleResult:
    """The harness failed: no score at all."""
    return ModuleResult(Verdict.INTERNAL_ERROR, None, message, (), traceback)
