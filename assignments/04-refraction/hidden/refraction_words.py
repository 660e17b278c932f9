"""What the oracles of assignment 04 share: numbers in words, and outputs of a wrong length."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from raybook_grader.probes import Failure


def number(x: float) -> str:
    """The shortest text that gives this float again; 0 for -0, too."""
    return str(np.float32(x) + 0).removesuffix(".0")


def point(components: Iterable[float]) -> str:
    """ "(1, 2.5, 0)"; also a direction or a colour."""
    return "(" + ", ".join(number(x) for x in components) + ")"


def wrong_length(output: bytes, record: int, count: int) -> list[Failure]:
    """The failure of an output that is not ``count`` records of ``record`` bytes; else none."""
    expected = record * count
    if len(output) == expected:
        return []
    message = (
        f"the probe wrote {len(output)} bytes, expected {expected}: {record} for each of "
        f"{count} cases"
    )
    return [Failure(len(output) // record, message, "output of a wrong length")]
