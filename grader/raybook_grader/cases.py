"""What the oracles of probes share: tables of cases, numbers in words, the output's length."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .probes import Failure


def number(x: float) -> str:
    """The shortest text that gives this single-precision number again; beyond its range "inf"."""
    with np.errstate(over="ignore"):
        return str(np.float32(x)).removesuffix(".0")


def point(a: NDArray[np.float64]) -> str:
    """ "(1, 2.5, 0)"."""
    return "(" + ", ".join(number(x) for x in a) + ")"


def read_table(file: Path) -> list[list[str]]:
    """The rows of a table of hand-picked cases: cells between "|", "#" begins a comment line."""
    lines = file.read_text(encoding="utf-8").splitlines()
    rows = [line.split("|") for line in lines if line.strip() and not line.startswith("#")]
    return [[cell.strip() for cell in row] for row in rows]


def numbers(text: str, turn: int = 0) -> NDArray[np.float64]:
    """ "1 2 3" as an array; with ``turn`` the elements are moved on, round the end."""
    return np.roll(np.array(text.split(), np.float64), turn)


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
