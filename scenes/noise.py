"""Gradient noise, for generated textures, skies and terrain.

K. Perlin, "Improving Noise", SIGGRAPH 2002. Needs only the standard library: whole rows are
computed at a time, so that Python keeps up.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from functools import cache
from itertools import pairwise

SIZE = 256
"""The lattice repeats after so many cells."""


def fade(t: float) -> float:
    """6 t^5 - 15 t^4 + 10 t^3: from 0 to 1 with no slope and no bend at both ends."""
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0)


def slope(t: float) -> float:
    """The derivative of fade."""
    return 30.0 * t * t * (t * (t - 2.0) + 1.0)


@cache
def gradients(seed: int) -> list[tuple[float, float]]:
    """Unit vectors of the plane for SIZE x SIZE lattice points."""
    rng = random.Random(seed)
    angles = [2 * math.pi * rng.random() for _ in range(SIZE * SIZE)]
    return [(math.cos(a), math.sin(a)) for a in angles]


def gradient(seed: int, i: int, j: int) -> tuple[float, float]:
    """The gradient at lattice point (i, j)."""
    return gradients(seed)[j % SIZE * SIZE + i]


class Columns:
    """The x of a row of samples, split once into lattice cells for many rows.

    xs must be in ascending order. The noise repeats along x after "period" cells.
    """

    def __init__(self, xs: Sequence[float], period: int = SIZE) -> None:
        self.first = math.floor(xs[0])
        self.cells = math.floor(xs[-1]) - self.first + 1
        self.lattice = [(self.first + i) % period for i in range(self.cells + 1)]
        self.samples: list[list[tuple[float, float, float]]] = [[] for _ in range(self.cells)]
        for x in xs:
            t = x - math.floor(x)
            self.samples[math.floor(x) - self.first].append((t, fade(t), slope(t)))


def row(columns: Columns, y: float, seed: int) -> list[float]:
    """Noise of mean 0, about -0.7 .. 0.7, at all columns of the row y."""
    values: list[float] = []
    for samples, (a, b, c, d) in zip(columns.samples, cell_lines(columns, y, seed), strict=True):
        values += [a + b * t + s * (c + d * t) for t, s, _ in samples]
    return values


def row_with_slopes(columns: Columns, y: float, seed: int) -> list[tuple[float, float, float]]:
    """Noise and its derivatives by x and y at all columns of the row y."""
    values: list[tuple[float, float, float]] = []
    lines = cell_lines(columns, y, seed)
    rates = cell_lines_by_y(columns, y, seed)
    for samples, (a, b, c, d), (e, f, g, h) in zip(columns.samples, lines, rates, strict=True):
        values += [
            (
                a + b * t + s * (c + d * t),
                b + s * d + ds * (c + d * t),
                e + f * t + s * (g + h * t),
            )
            for t, s, ds in samples
        ]
    return values


Line = tuple[float, float, float, float]
"""a, b, c, d: noise in a cell along a row is a + b t + fade(t) (c + d t)."""


def cell_lines(columns: Columns, y: float, seed: int) -> list[Line]:
    """Noise along the row y, cell by cell."""
    j = math.floor(y)
    t = y - j
    s = fade(t)
    ends = []
    for i in columns.lattice:
        (x0, y0), (x1, y1) = gradient(seed, i, j), gradient(seed, i, j + 1)
        ends.append((x0 + s * (x1 - x0), y0 * t + s * (y1 * (t - 1.0) - y0 * t)))
    return [between(left, right) for left, right in pairwise(ends)]


def cell_lines_by_y(columns: Columns, y: float, seed: int) -> list[Line]:
    """The derivative by y of cell_lines."""
    j = math.floor(y)
    t = y - j
    s, ds = fade(t), slope(t)
    ends = []
    for i in columns.lattice:
        (x0, y0), (x1, y1) = gradient(seed, i, j), gradient(seed, i, j + 1)
        low, high = y0 * t, y1 * (t - 1.0)
        ends.append((ds * (x1 - x0), y0 + s * (y1 - y0) + ds * (high - low)))
    return [between(left, right) for left, right in pairwise(ends)]


def between(left: tuple[float, float], right: tuple[float, float]) -> Line:
    """The line of a cell from (slope, value at the lattice point) at both its ends."""
    (p, q), (u, v) = left, right
    return q, p, v - u - q, u - p
