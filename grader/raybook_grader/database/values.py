"""What is read from `grades.sqlite`, as plain values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime

from ..grading.result import ModuleResult
from ..policy import Settled


@dataclass(frozen=True)
class Module:
    """What an assignment is called and worth, as it was when it was graded."""

    number: str
    module: str
    title: str
    points: float
    optional: bool


@dataclass(frozen=True)
class Student:
    """One student with the results that count; None for a module that is not graded yet.

    The score of a result is the final one. ``settled`` says, by assignment, what it was before and
    why it changed: a penalty, a person's decision.
    """

    id: str
    problem: str | None
    results: Mapping[str, ModuleResult | None]
    settled: Mapping[str, Settled] = field(default_factory=dict)


@dataclass(frozen=True)
class Version:
    """One version of a module that a student handed in: the key of its work, a hash of its files
    alone (None in an old database), and the time in UTC if that is known.
    """

    key: str
    files: str | None = None
    time: datetime | None = None
