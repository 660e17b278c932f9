"""What the oracles of assignment 10 share: mipmaps in float64, their bytes, numbers in words.

The layout of the bytes is told in probe_mipmap.c.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from raybook_grader.probes import Failure

Array = NDArray[np.float64]

REPEAT, CLAMP, MIRROR, BLACK = range(4)
WRAPS = ("repeat", "clamp", "mirror", "black")


@dataclass(frozen=True)
class Mipmap:
    """``levels``: (height, width, 3) each, the first one is the image."""

    name: str
    wrap: int
    levels: tuple[Array, ...]

    @property
    def size(self) -> Array:
        """Width and height of the image."""
        height, width = self.levels[0].shape[:2]
        return np.array([width, height], np.float64)

    def __str__(self) -> str:
        width, height = self.size.astype(int)
        return f"{self.name} of {width} x {height} texels ({WRAPS[self.wrap]})"


def single(a: Array) -> Array:
    """The nearest floats, as float64."""
    return np.asarray(a, np.float32).astype(np.float64)


def half(size: int) -> int:
    return max(size // 2, 1)


def shares(size: int, parts: int) -> Array:
    """(parts, size): which share of each of so many equal parts of a row each texel has.

    With F(x) the length of [0, x] that lies in a texel, a part has F(end) - F(begin) of it.
    """
    ends = np.arange(parts + 1) * (size / parts)
    covered = np.clip(ends[:, None] - np.arange(size), 0.0, 1.0)
    return np.diff(covered, axis=0) * (parts / size)


def means(image: Array, width: int, height: int) -> Array:
    """The image in so many texels, each the mean of the area that it covers."""
    rows, columns = shares(image.shape[0], height), shares(image.shape[1], width)
    return np.einsum("yj,jic,xi->yxc", rows, image, columns, optimize=True)


def pyramid(image: Array) -> tuple[Array, ...]:
    levels = [image]
    while levels[-1].shape[:2] != (1, 1):
        height, width = levels[-1].shape[:2]
        levels.append(means(levels[-1], half(width), half(height)))
    return tuple(levels)


def wrapped(index: NDArray[np.int64], size: int, wrap: int) -> NDArray[np.int64]:
    """The index of the texel that lies there; -1 for none."""
    if wrap == REPEAT:
        return index % size
    if wrap == CLAMP:
        return np.clip(index, 0, size - 1)
    if wrap == MIRROR:
        there_and_back = index % (2 * size)
        return np.minimum(there_and_back, 2 * size - 1 - there_and_back)
    return np.where((index >= 0) & (index < size), index, -1)


def bilinear(m: Mipmap, level: int, uv: Array) -> Array:
    """The colour between the middles of the four texels around uv."""
    image = m.levels[level]
    place = uv * [image.shape[1], image.shape[0]] - 0.5
    first = np.floor(place).astype(np.int64)
    rest = place - first
    color = np.zeros(3)
    for dx in (0, 1):
        for dy in (0, 1):
            x = wrapped(first[..., 0] + dx, image.shape[1], m.wrap)
            y = wrapped(first[..., 1] + dy, image.shape[0], m.wrap)
            weight = np.abs(1 - dx - rest[..., 0]) * np.abs(1 - dy - rest[..., 1])
            if x >= 0 and y >= 0:
                color += weight * image[y, x]
    return color


def packed(mipmaps: Sequence[Mipmap], lookups: Sequence[tuple[int, Sequence[float]]]) -> bytes:
    """The file of cases: the mipmaps, and of each lookup its mipmap and its seven numbers."""
    parts = [np.array([len(mipmaps)], "<u4").tobytes()]
    for m in mipmaps:
        parts.append(np.array([m.wrap, len(m.levels)], "<u4").tobytes())
        for level in m.levels:
            parts.append(np.array(level.shape[1::-1], "<u4").tobytes())
            parts.append(level.astype("<f4").tobytes())
    for index, numbers in lookups:
        parts.append(np.array([index], "<u4").tobytes())
        parts.append(np.array(numbers, "<f4").tobytes())
    return b"".join(parts)


def number(x: float) -> str:
    """The shortest text that gives this float again."""
    return str(np.float32(x)).removesuffix(".0")


def tuple_of(a: Array) -> str:
    """ "(1, 2.5)"; a colour of three equal components is one number."""
    if len(a) == 3 and a[0] == a[1] == a[2]:
        return number(a[0])
    return "(" + ", ".join(number(x) for x in a) + ")"


def about(a: Array) -> str:
    """The same with four digits: what was expected is exact to no more."""
    if len(a) == 3 and a[0] == a[1] == a[2]:
        return f"{a[0]:.4g}"
    return "(" + ", ".join(f"{x:.4g}" for x in a) + ")"


def wrong_length(output: bytes, expected: int) -> list[Failure]:
    """The failure of an output that is not of this length; else none."""
    if len(output) == expected:
        return []
    message = f"the probe wrote {len(output)} bytes, expected {expected}"
    return [Failure(0, message, "output of a wrong length")]
