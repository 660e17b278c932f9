"""Spheres, rectangles and lines between points, in float64: who sees what in a probe's scene."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

PLAIN, GLASS, NO_MATERIAL = 0, 1, 2
"""What a thing is made of, as probe_direct.c counts."""

EDGE = 0.03
"""A line is clear of an outline if it passes this far inside or outside; 1 is the half width."""

NEAR = 1e-5
"""What is closer to an end of the way than this may count or not: direct_lighting.h."""


@dataclass(frozen=True)
class Sphere:
    center: Array
    radius: float
    words: str
    made_of: int = PLAIN

    def hits(self, start: Array, way: Array) -> tuple[list[float], bool]:
        """All t at which start + t way meets it, and whether rounding could change how many."""
        length = float(np.linalg.norm(way))
        along_way, offset = way / length, self.center - start
        along = float(offset @ along_way)
        apart = float(np.linalg.norm(offset - along * along_way))
        unclear = abs(apart - self.radius) < EDGE * self.radius
        if apart >= self.radius:
            return [], unclear
        half = float(np.sqrt(self.radius**2 - apart**2))
        return [(along - half) / length, (along + half) / length], unclear

    def normal(self, place: Array) -> Array:
        return unit(place - self.center)

    def record(self) -> tuple[int, list[float]]:
        """The shape's number and its nine floats, as probe_direct.c reads them."""
        return 1, [*self.center, self.radius, 0, 0, 0, 0, 0]


@dataclass(frozen=True)
class Rect:
    """The sides are at right angles to each other. See `Sphere` for the methods."""

    center: Array
    side_x: Array
    side_y: Array
    words: str
    made_of: int = PLAIN

    def hits(self, start: Array, way: Array) -> tuple[list[float], bool]:
        across = self.normal(start)
        toward = float(across @ way)
        if abs(toward) < 1e-9 * float(np.linalg.norm(way)):
            return [], False
        t = float(across @ (self.center - start)) / toward
        place = start + t * way - self.center
        u = abs(float(place @ self.side_x) / float(self.side_x @ self.side_x))
        v = abs(float(place @ self.side_y) / float(self.side_y @ self.side_y))
        outermost = 2 * max(u, v)
        return ([t] if outermost <= 1 else []), abs(outermost - 1) < EDGE

    def normal(self, _: Array) -> Array:
        return unit(np.cross(self.side_x, self.side_y))

    def record(self) -> tuple[int, list[float]]:
        return 2, [*self.center, *self.side_x, *self.side_y]


Thing = Sphere | Rect


def unit(vector: Array) -> Array:
    return np.asarray(vector / np.linalg.norm(vector))


def single(vector: Sequence[float] | Array) -> Array:
    """Rounded to what a record can hold."""
    return np.asarray(vector, dtype=np.float32).astype(np.float64)


def wall(center: Array, facing: Array, width: float, words: str, made_of: int = PLAIN) -> Rect:
    """A square whose normal is ``facing``, of length one."""
    side_x = unit(np.cross(np.eye(3)[int(np.argmin(np.abs(facing)))], facing))
    side_y = np.cross(facing, side_x)
    return Rect(single(center), single(width * side_x), single(width * side_y), words, made_of)


def ball(center: Array, radius: float, words: str, made_of: int = PLAIN) -> Sphere:
    return Sphere(single(center), float(np.float32(radius)), words, made_of)


def first_hit(things: Sequence[Thing], origin: Array, way: Array) -> tuple[int, float] | None:
    """Which thing a ray meets first, and its t; None for nothing, or if that is not clear."""
    found: list[tuple[float, int]] = []
    for number, thing in enumerate(things):
        hits, unclear = thing.hits(origin, way)
        if unclear:
            return None
        found += [(t, number) for t in hits if t > 0]
    if not found:
        return None
    t, number = min(found)
    return number, t


def is_blocked(things: Sequence[Thing], start: Array, way: Array, *, endless: bool) -> bool | None:
    """Whether a thing is on the way, from t = 0 to 1 or, if ``endless``, from 0 on.

    None if rounding, or the contract, leaves it open.
    """
    length = float(np.linalg.norm(way))
    size = way_size(start, way, endless)
    blocked = False
    for thing in things:
        hits, unclear = thing.hits(start, way)
        if unclear:
            return None
        for t in hits:
            to_an_end = (abs(t) if endless else min(abs(t), abs(1 - t))) * length / size
            if NEAR / 4 < to_an_end < 4 * NEAR:
                return None
            inside = t > 0 and (endless or t < 1)
            blocked |= inside and to_an_end >= NEAR
    return blocked


def way_size(start: Array, way: Array, endless: bool) -> float:
    """What "near an end" is measured by: the way's length, or a coordinate if that is larger."""
    ends = [start, 1e-6 * way] if endless else [start, start + way, way]
    return float(np.max(np.abs(ends)))
