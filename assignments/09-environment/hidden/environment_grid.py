"""The sphere of directions cut into parts of the map; counting picks in them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from environment_truth import Array, Map, direction_at, place_of
from numpy.typing import NDArray
from scipy.stats import chi2

DOUBT = 2e-3
LEVEL = 1e-9


@dataclass(frozen=True)
class Grid:
    """``local``: the middle of each part, row by row; ``solid``: its solid angle."""

    columns: int
    rows: int
    local: Array
    solid: Array


def grid_of(m: Map) -> Grid:
    """At least 96 rows and columns: a multiple of twelve for each texel, six if they are many."""
    sizes = (m.width, m.height)
    part = 12 if max(sizes) <= 32 else 6
    columns, rows = (size * part * max(1, -(-96 // (part * size))) for size in sizes)
    u, v = np.meshgrid((np.arange(columns) + 0.5) / columns, (np.arange(rows) + 0.5) / rows)
    edges = np.cos(np.pi * np.arange(rows + 1) / rows)
    solid = np.repeat((edges[:-1] - edges[1:]) * 2 * np.pi / columns, columns)
    return Grid(columns, rows, direction_at(u.ravel(), v.ravel()), solid)


def bins_of(m: Map) -> tuple[int, int]:
    """How many columns and rows of bins: the texels, or parts of them if they are few."""
    parts = (1, 2, 3, 4, 6, 12)
    columns = next(m.width * part for part in parts if m.width * part >= 12)
    rows = next(m.height * part for part in parts if m.height * part >= 6)
    return columns, rows


def follows(m: Map, grid: Grid, density: Array, picked: Array) -> str | None:
    """None if the picks are spread as the density says; else what is wrong, in words."""
    columns, rows = bins_of(m)
    expected = len(picked) * _sums(grid, density * grid.solid, columns, rows)
    counts = _counts(m, picked, columns, rows)
    # Chi-squared is for large numbers: what expects few is put together.
    few = expected < 10
    e = np.append(expected[~few], expected[few].sum())
    c = np.append(counts[~few], counts[few].sum())
    variance = np.maximum(e, 1.0) + (DOUBT * e) ** 2
    statistic = float(np.sum((c - e) ** 2 / variance))
    if statistic < chi2.isf(LEVEL, len(e)):
        return None
    worst = int(np.argmax(np.abs(counts - expected) / np.sqrt(np.maximum(expected, 1.0))))
    row, column = divmod(worst, columns)
    return (
        f"of {len(picked)} picks {counts[worst]} are in columns "
        f"{_part(column, m.width, columns)}, rows {_part(row, m.height, rows)} of the map; "
        f"environment_pdf, summed over that part, gives {expected[worst]:.1f}"
    )


def _part(index: int, texels: int, bins: int) -> str:
    return f"{index * texels / bins:.4g} to {(index + 1) * texels / bins:.4g}"


def _sums(grid: Grid, shares: Array, columns: int, rows: int) -> Array:
    parts = shares.reshape(rows, grid.rows // rows, columns, grid.columns // columns)
    summed: Array = parts.sum(axis=(1, 3)).ravel()
    return summed


def _counts(m: Map, picked: Array, columns: int, rows: int) -> NDArray[np.int64]:
    u, v = place_of(m.to_local(picked))
    column = np.minimum((u * columns).astype(int), columns - 1)
    row = np.minimum((v * rows).astype(int), rows - 1)
    return np.bincount(row * columns + column, minlength=rows * columns)
