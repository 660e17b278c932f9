"""What a large class asks for: how many different modules it hands in, and how long each takes."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from durations import Duration

CLASS = 200
"""The class for which a third of the modules are different ones."""


@dataclass(frozen=True)
class Demand:
    """Of n submissions, n * third * (n / CLASS) ** (growth - 1) are different in an assignment.

    The rest are still stubs, or the same as another's. A growth of 1 is a third of any class; below
    that, a larger class has more in common, as texts have more words in common the longer they are
    (Heaps' law).
    """

    submissions: int
    growth: float
    endless: float = 0.01
    """The share of modules that run into their time limits."""

    def different(self) -> int:
        """Modules to grade in one assignment."""
        scale = (self.submissions / CLASS) ** (self.growth - 1)
        return math.ceil(self.submissions / 3 * min(float(scale), 3.0))

    def jobs(self, measured: Sequence[Duration], seed: int = 1) -> list[float]:
        """Durations in the order of the submissions: one of each assignment, then the next."""
        numbers = random.Random(seed)
        by_assignment = _by_assignment(measured)
        longest = max(duration.cpu_seconds for duration in measured)
        return [
            longest if numbers.random() < self.endless else numbers.choice(some)
            for _ in range(self.different())
            for some in by_assignment.values()
        ]


def _by_assignment(measured: Sequence[Duration]) -> Mapping[str, list[float]]:
    found: dict[str, list[float]] = {}
    for duration in measured:
        found.setdefault(duration.assignment, []).append(duration.cpu_seconds)
    return found
