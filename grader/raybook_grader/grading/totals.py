"""What the modules of one submission add up to."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ..database import Module, Student
from ..scoring import total


@dataclass(frozen=True)
class Totals:
    """Points of required modules, what they could be, and the points of optional modules.

    None stands for "not known": a module's grading failed, or has not been done.
    """

    score: float | None
    max_score: float
    optional: float | None


def totals(student: Student, modules: Iterable[Module]) -> Totals:
    """The totals over the modules that the student was graded in."""
    graded = [module for module in modules if module.number in student.results]
    required = [module for module in graded if not module.optional]
    return Totals(
        score=total(_score(student, module) for module in required),
        max_score=round(sum(module.points for module in required), 2),
        optional=total(_score(student, module) for module in graded if module.optional),
    )


def _score(student: Student, module: Module) -> float | None:
    result = student.results[module.number]
    return None if result is None else result.score
