"""One case of ``direct_light``: a small scene, a vertex in it, a light sample, and the answer.

The answer is worked out here from the numbers that the record holds, by closed forms in float64;
how the case was made has no say in it.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from direct_geometry import Array, Rect, Thing, first_hit, is_blocked, single, unit
from direct_words import triple
from raybook_grader.cases import number

OBJECTS_MAX = 3
SMALLEST_COSINE = 0.01
"""With a normal: below it a direction's side is a matter of rounding."""

ONE_SIDED, TWO_SIDED, METAL = 0, 1, 2
PROMISED = 1e-4
FLAT_ERROR, ROUND_ERROR = 2e-6, 1e-5
"""How far rounding may move a cosine: a dot product of two unit vectors that carry a few units of
2^-24 each; on a sphere the normal is a difference of coordinates up to some six times its radius.
"""


@dataclass(frozen=True)
class Paint:
    kind: int = ONE_SIDED
    albedo: Sequence[float] = (0.5, 0.25, 1.0)
    alpha: float = 0.3
    eta: Sequence[float] = (0.2, 0.9, 1.1)
    k: Sequence[float] = (3.9, 2.4, 2.2)


@dataclass(frozen=True)
class Case:
    """``normal`` is None where the vertex keeps the surface's own. The receiver is things[0]."""

    label: str
    things: tuple[Thing, ...]
    origin: Array
    direction: Array
    to_light: Array
    target: Array
    radiance: Array
    paint: Paint = field(default_factory=Paint)
    normal: Array | None = None
    pdf: float = 1.0
    infinite: bool = False
    delta: bool = True

    def record(self) -> bytes:
        paint = self.paint
        normal = np.zeros(3) if self.normal is None else self.normal
        words = struct.pack("<I", paint.kind)
        words += _floats(*paint.albedo, paint.alpha, *paint.eta, *paint.k)
        words += _floats(*self.origin, *self.direction, *normal, *self.to_light, *self.target)
        words += struct.pack("<II", self.infinite, self.delta)
        words += _floats(*self.radiance, self.pdf) + struct.pack("<I", len(self.things))
        for thing in self.things:
            shape, values = thing.record()
            words += struct.pack("<II", shape, thing.made_of) + _floats(*values)
        return words + bytes(44 * (OBJECTS_MAX - len(self.things)))

    def tell(self) -> str:
        """What a student needs to repeat it."""
        light = "a light without end in direction" if self.infinite else "a light in direction"
        at = "" if self.infinite else f" at {triple(self.target)}"
        normal = "" if self.normal is None else f" with shading normal {triple(self.normal)}"
        others = "".join(f", {thing.words}" for thing in self.things[1:])
        kind = ("one-sided", "two-sided", "metal")[self.paint.kind]
        return (
            f"{self.label}: {self.things[0].words} ({kind}, colour {triple(self.paint.albedo)})"
            f"{normal}, seen from {triple(self.origin)} along {triple(self.direction)}{others}; "
            f"{light} {triple(self.to_light)}{at}, radiance {triple(self.radiance)}, "
            f"pdf {number(self.pdf)}"
        )


def _floats(*values: float) -> bytes:
    return np.array(values, "<f4").tobytes()


@dataclass(frozen=True)
class Answer:
    """``radiance`` is exactly black where no light comes from."""

    radiance: Array
    tolerance: Array


def answer(case: Case) -> Answer | None:
    """What direct_light must return; None if rounding may decide, or the eye misses things[0]."""
    hit = first_hit(case.things, case.origin, case.direction)
    if hit is None or hit[0] != 0:
        return None
    place = case.origin + hit[1] * case.direction
    true_normal = case.things[0].normal(place)
    normal = true_normal if case.normal is None else case.normal
    outgoing = -unit(case.direction)
    cosines = [float(n @ w) for w in (outgoing, case.to_light) for n in (true_normal, normal)]
    if min(abs(c) for c in cosines) < SMALLEST_COSINE:
        return None
    sides = [_side(*cosines[:2]), _side(*cosines[2:])]
    way = case.to_light if case.infinite else case.target - place
    if case.paint.kind == METAL and float(outgoing @ case.to_light) < 1 - 1e-6:
        raise ValueError(f"{case.label}: metal is known for light from the eye only")
    blocked = is_blocked(case.things, place, way, endless=case.infinite)
    if blocked is None:
        return None
    front = sides == [1, 1] or (case.paint.kind == TWO_SIDED and sides == [-1, -1])
    if blocked or not front:
        return Answer(np.zeros(3), np.zeros(3))
    scattered = _metal(case.paint, cosines[3]) if case.paint.kind == METAL else _diffuse(case.paint)
    cosine = abs(float(normal @ case.to_light))
    full = scattered * case.radiance / case.pdf
    error = FLAT_ERROR if isinstance(case.things[0], Rect) else ROUND_ERROR
    return Answer(full * cosine, full * (PROMISED * cosine + error))


def _side(true: float, shading: float) -> int:
    """1: outside by both normals, -1: inside by both, 0: they disagree."""
    return int(true > 0 and shading > 0) - int(true < 0 and shading < 0)


def _diffuse(paint: Paint) -> Array:
    return np.asarray(single(paint.albedo) / np.pi)


def _metal(paint: Paint, cosine: float) -> Array:
    """GGX, of light that goes back where it came from: then the mirrors that matter face it."""
    alpha2 = float(np.float32(paint.alpha)) ** 2
    facing = alpha2 / (np.pi * (cosine**2 * (alpha2 - 1) + 1) ** 2)
    tangent2 = 1 / cosine**2 - 1
    seen = 2 / (1 + np.sqrt(1 + alpha2 * tangent2))
    eta, k2 = single(paint.eta), single(paint.k) ** 2
    fresnel = ((eta - 1) ** 2 + k2) / ((eta + 1) ** 2 + k2)
    return np.asarray(single(paint.albedo) * fresnel * facing * seen**2 / (4 * cosine**2))
