"""What a probe's oracle is.

A probe is a small C driver, linked with a student's module and run in the box: it reads a file
of cases and writes a file of raw results. The oracle, in trusted Python outside the box, makes
the cases and judges the results. It stands in the assignment's ``hidden/`` folder as a module
with the two functions of :class:`Oracle`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol


@dataclass(frozen=True)
class Cases:
    """The input of one probe run.

    ``payload`` is what the driver reads, byte for byte. ``context`` is whatever the oracle
    wants to keep for judging (arrays, expected values); it never enters the box.
    """

    payload: bytes
    count: int
    context: Any


@dataclass(frozen=True)
class Failure:
    """One wrong result, told so that a student can repeat it by hand.

    ``simplicity`` orders failures: the report shows the largest first (whole numbers, few
    digits, one triangle). ``fingerprint`` names the kind of failure in a few stable words
    ("missed", "t out of range"), for counting and for the diagnosis.
    """

    case: int
    message: str
    fingerprint: str
    simplicity: float = 0.0


class Oracle(Protocol):
    """The interface of ``hidden/oracle_*.py``."""

    def make_cases(self, group: str, seed: int) -> Cases:
        """The cases of a named group ("edges", "random", ...); same seed, same bytes."""
        ...

    def judge(self, cases: Cases, output: bytes) -> list[Failure]:
        """Every wrong result. Output of a wrong length is a failure too, never an exception."""
        ...


class CostOracle(Oracle, Protocol):
    """An oracle that also counts the work behind results that it found right.

    What is counted must not rest on the word of the program that did the work: count what the
    results show (a tree can be walked here), or let the driver count calls of its own functions and
    let ``judge`` refuse a count below what any program needs.
    """

    COUNTED: str
    """What `cost` counts, in the plural: "boxes and triangles tested a ray"."""

    def cost(self, cases: Cases, output: bytes) -> float:
        """The work, above 0; asked only for output in which ``judge`` finds no failure."""
        ...
