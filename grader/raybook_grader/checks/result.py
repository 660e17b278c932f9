"""What a check found out, as a plain value that can be stored and told."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from enum import StrEnum
from typing import Any

from ..course import Check


class Status(StrEnum):
    """How a check ended. What each one is worth, and makes of a module, is in `scoring`."""

    PASSED = "passed"
    PARTIAL = "partial"
    """Nothing is wrong, but not all points are earned."""
    FAILED = "failed"
    UNCONFIRMED = "unconfirmed"
    """It passed by its own word only, and no judged check bears it out."""
    BUILD_ERROR = "build-error"
    CRASH = "crash"
    TIMEOUT = "timeout"
    MEMORY = "memory"
    FORBIDDEN = "forbidden"
    NOT_RUN = "not run"
    INTERNAL_ERROR = "internal-error"


NO_FAULT = (Status.PASSED, Status.UNCONFIRMED, Status.NOT_RUN, Status.INTERNAL_ERROR)
"""Statuses that say nothing against the module."""


@dataclass(frozen=True)
class CheckResult:
    """One check of one module.

    ``score`` is None only when the harness failed. All texts but ``picture`` are plain and may
    hold anything that a student wrote; ``picture`` is trusted HTML, made by
    the judge, for a page that holds its `VIEWER_STYLES` and `VIEWER_SCRIPTS`.
    """

    name: str
    kind: str
    score: float | None
    max_score: float
    status: Status
    message: str
    """The reason in a few words; `told` adds the first case."""
    cases: tuple[str, ...] = ()
    """What exactly is wrong, in words, the simplest first."""
    fingerprint: str = ""
    """A few stable words that name the kind of failure, for counting."""
    words: str = ""
    """What the compiler or the program said, cleaned and cut."""
    picture: str = ""
    trace: Mapping[str, Any] = field(default_factory=dict)
    """What the diagnosis compares; see `diagnosis.trace`."""

    @property
    def told(self) -> str:
        """The message with the simplest failing case."""
        return f"{self.message}: {self.cases[0]}" if self.cases else self.message

    def to_json(self) -> dict[str, Any]:
        return asdict(self)

    @classmethod
    def from_json(cls, values: dict[str, Any]) -> CheckResult:
        """The inverse of `to_json`, through a JSON text."""
        return cls(
            **{
                **values,
                "status": Status(values["status"]),
                "cases": tuple(values["cases"]),
            }
        )


JUDGED = ("probe", "statistics")
"""The kinds whose answers are judged outside of the box, so that none can be forged."""


def kind_of(check: Check) -> str:
    """The word for a check's kind in the rubric: "build", "unit", "probe" and so on."""
    return type(check).__name__.removesuffix("Check").lower()


def conclude(
    check: Check,
    status: Status,
    message: str,
    *,
    share: float | None = None,
    cases: tuple[str, ...] = (),
    fingerprint: str = "",
    words: str = "",
    picture: str = "",
    trace: Mapping[str, Any] | None = None,
) -> CheckResult:
    """The result of ``check``; by default it earns all its points if passed, and else none.

    ``share``, from 0 to 1, gives a part of the points instead.
    """
    if share is None:
        share = 1.0 if status is Status.PASSED else 0.0
    internal = status is Status.INTERNAL_ERROR
    return CheckResult(
        name=check.name,
        kind=kind_of(check),
        score=None if internal else round(share * check.points, 2),
        max_score=check.points,
        status=status,
        message=message,
        cases=cases,
        fingerprint=fingerprint,
        words=words,
        picture=picture,
        trace=trace or {},
    )
