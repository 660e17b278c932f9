"""What the oracles of assignment 06 share: filters, the layout of the files, and calls in words.

probe_pixel_sampling.c says how the files are laid out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from raybook_grader.cases import number

Array = NDArray[np.float64]
Floats = NDArray[np.float32]

KINDS = ("box", "tent", "gaussian", "mitchell")
WORDS_IN, WORDS_OUT = 12, 4
LAST_BELOW_ONE = np.float32(1) - np.float32(2) ** -24


@dataclass(frozen=True)
class Filter:
    """One axis of a filter, by the definition in camera/filter.h, in double precision."""

    kind: str
    radius: float
    alpha: float = 2.0
    b: float = 1 / 3
    c: float = 1 / 3

    @property
    def words(self) -> list[float]:
        return [KINDS.index(self.kind), self.radius, self.alpha, self.b, self.c]

    @property
    def name(self) -> str:
        return f"{self.kind} filter of radius {self.radius:g}"

    def value(self, at: Array) -> Array:
        x = np.abs(at) / self.radius
        if self.kind == "tent":
            inside = 1 - x
        elif self.kind == "gaussian":
            square = self.alpha * self.radius**2
            inside = np.exp(-square * x**2) - np.exp(-square)
        elif self.kind == "mitchell":
            inside = self._cubic(2 * x)
        else:
            inside = np.ones_like(x)
        found: Array = np.where(x <= 1, inside, 0)
        return found

    def _cubic(self, x: Array) -> Array:
        """Mitchell and Netravali 1988, equation 8."""
        b, c = self.b, self.c
        near = (12 - 9 * b - 6 * c) * x**3 + (-18 + 12 * b + 6 * c) * x**2 + (6 - 2 * b)
        far = (-b - 6 * c) * x**3 + (6 * b + 30 * c) * x**2
        far = far + (-12 * b - 48 * c) * x + (8 * b + 24 * c)
        found: Array = np.where(x < 1, near, far) / 6
        return found

    def shares(self, edges: Array) -> Array:
        """Of the filter's integral, what lies between one edge and the next (Gauss-Legendre, in
        pieces short enough that a bend of the curve does not matter)."""
        nodes, weights = np.polynomial.legendre.leggauss(8)
        found = []
        for lower, upper in zip(edges[:-1], edges[1:], strict=True):
            cuts = np.linspace(lower, upper, 257)
            half = np.diff(cuts)[:, None] / 2
            at = (cuts[:-1] + cuts[1:])[:, None] / 2 + half * nodes
            found.append(float((self.value(at) * half * weights).sum()))
        return np.array(found) / np.sum(found)


def place_records(
    filters: list[Filter], which: NDArray[np.int64], columns: list[NDArray[np.float32]]
) -> Floats:
    """Input records of the groups that ask for places: filter, x, y, index, count, shared,
    two numbers."""
    table = np.array([f.words for f in filters])
    found: Floats = np.column_stack([table[which], *columns]).astype("<f4")
    return found


def call_in_words(filters: list[Filter], which: int, record: Floats) -> str:
    x, y, index, count = (int(v) for v in record[5:9])
    return (
        f"{filters[which].name}, pixel ({x}, {y}), sample {index} of {count}, random numbers "
        f"({number(record[10])}, {number(record[11])})"
    )


def rows_of(output: bytes) -> tuple[Array, NDArray[np.uint32]]:
    """The three numbers of each output record, and its last word."""
    words = np.frombuffer(output, "<u4").reshape(-1, WORDS_OUT)
    return words.view("<f4")[:, :3].astype(np.float64), words[:, 3]
