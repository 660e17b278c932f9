"""What the oracles of assignment 08 share: rectangles, also in words."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from raybook_grader.cases import number, point

Array = NDArray[np.float64]


def rect_text(rect: Array) -> str:
    """The 13 numbers of a struct rect."""
    center, side_x, side_y, normal = rect[:12].reshape(4, 3)
    return (
        f"rect with center {point(center)}, side_x {point(side_x)}, side_y {point(side_y)}, "
        f"normal {point(normal)}, area {number(rect[12])}"
    )


def make_rect(center: Array, side_x: Array, side_y: Array, sign: float = 1.0) -> Array:
    """The 13 numbers; the normal is on the side that ``sign`` says."""
    cross = np.cross(side_x, side_y)
    area = float(np.linalg.norm(cross))
    return np.concatenate([center, side_x, side_y, sign * cross / area, [area]])


def unit(vectors: Array) -> Array:
    length: Array = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    return length
