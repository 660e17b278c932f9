"""Cutting a picture into square tiles. The last tile of a row or column takes what is left over."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .pixels import Array


@dataclass(frozen=True)
class Tile:
    """A rectangle of pixels, both corners included."""

    x0: int
    y0: int
    x1: int
    y1: int

    def __str__(self) -> str:
        return f"x={self.x0}..{self.x1}, y={self.y0}..{self.y1}"


def tile_means(images: Array, size: int) -> Array:
    """(..., height, width) -> (..., rows, columns): the mean of every tile."""
    height, width = images.shape[-2:]
    rows, columns = _starts(height, size), _starts(width, size)
    sums = np.add.reduceat(np.add.reduceat(images, rows, axis=-2), columns, axis=-1)
    means: Array = sums / tile_counts((height, width), size)
    return means


def tile_counts(shape: tuple[int, int], size: int) -> Array:
    """How many pixels each tile holds: (rows, columns)."""
    lengths = [np.diff(_starts(n, size), append=n).astype(np.float64) for n in shape]
    counts: Array = np.outer(lengths[0], lengths[1])
    return counts


def spread(tiles: Array, shape: tuple[int, int], size: int) -> Array:
    """(rows, columns) -> `shape`: every pixel gets its tile's value."""
    rows, columns = (np.diff(_starts(n, size), append=n) for n in shape)
    return np.repeat(np.repeat(tiles, rows, axis=0), columns, axis=1)


def tile_at(index: int, shape: tuple[int, int], size: int) -> Tile:
    """The tile at a flat index into the (rows, columns) array of a picture of `shape`."""
    rows, columns = (np.append(_starts(n, size), n) for n in shape)
    row, column = divmod(index, len(columns) - 1)
    return Tile(
        int(columns[column]), int(rows[row]), int(columns[column + 1]) - 1, int(rows[row + 1]) - 1
    )


def _starts(length: int, size: int) -> NDArray[np.intp]:
    return np.arange(max(length // size, 1), dtype=np.intp) * size
