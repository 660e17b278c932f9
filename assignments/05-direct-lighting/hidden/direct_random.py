"""Random cases of ``direct_light``, of all sizes: a scene is a millimetre to a kilometre wide."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from direct_cases import METAL, ONE_SIDED, TWO_SIDED, Case, Paint
from direct_geometry import (
    GLASS,
    NO_MATERIAL,
    PLAIN,
    Array,
    Sphere,
    Thing,
    ball,
    first_hit,
    single,
    unit,
    wall,
    way_size,
)

Rng = np.random.Generator
NAMES = {PLAIN: "", GLASS: "glass ", NO_MATERIAL: "black "}


@dataclass(frozen=True)
class Stage:
    """A receiver with a vertex on it that an eye sees, and where the lamp is."""

    scale: float
    receiver: Thing
    origin: Array
    direction: Array
    place: Array
    target: Array

    @property
    def way(self) -> Array:
        return np.asarray(self.target - self.place)


def shading(rng: Rng) -> Case:
    """Nothing is in the way: the surface and the light alone decide."""
    stage = _stage(rng, anywhere=0.3)
    kind = int(rng.choice([ONE_SIDED, TWO_SIDED, METAL], p=[0.5, 0.3, 0.2]))
    to_light = unit(stage.way)
    if kind == METAL:
        to_light = unit(stage.origin - stage.place)
    target = single(stage.place + np.linalg.norm(stage.way) * to_light)
    things: list[Thing] = [stage.receiver]
    if rng.random() < 0.3:
        things.append(_obstacle(rng, stage, rng.uniform(0.2, 0.8), beside=True))
    normal = None
    if rng.random() < 0.4:
        true = stage.receiver.normal(stage.place)
        normal = single(unit(true + rng.uniform(0, 0.6) * unit(rng.normal(size=3))))
    delta = bool(rng.random() < 0.5)
    pdf = 1.0 if delta else float(np.float32(10 ** rng.uniform(-2, 3)))
    return Case(
        "nothing in the way", tuple(things), stage.origin, stage.direction,
        single(unit(target - stage.place)), target, _radiance(rng),
        _paint(rng, kind), normal, pdf, False, delta,
    )  # fmt: skip


def shadows(rng: Rng) -> Case:
    """One thing or two: between, beyond, below, beside."""
    stage = _stage(rng, anywhere=0.05)
    endless = bool(rng.random() < 0.3)
    where = str(rng.choice(["between", "beyond", "below", "beside"], p=[0.4, 0.2, 0.2, 0.2]))
    part = {
        "between": rng.uniform(0.05, 0.9),
        "beyond": 10 ** rng.uniform(0.3, 3) if endless else rng.uniform(1.1, 3),
        "below": -rng.uniform(0.1, 2),
        "beside": rng.uniform(0.05, 0.9),
    }[where]
    things = [stage.receiver, _obstacle(rng, stage, part, beside=where == "beside")]
    if rng.random() < 0.3:
        things.append(_obstacle(rng, stage, rng.uniform(0.1, 0.9), beside=True))
    label = f"{where}, a light without end" if endless else where
    return _lit(rng, label, stage, things, endless)


def ends(rng: Rng) -> Case:
    """Things that are very near to the lamp, or to the surface, or hold the lamp."""
    stage = _stage(rng, anywhere=0.0)
    where = str(rng.choice([*_ENDS]))
    near = 10 ** rng.uniform(-4.2, -1.5) * way_size(stage.place, stage.way, False)
    return _lit(rng, where, stage, [stage.receiver, _ENDS[where](rng, stage, near)])


RANDOM: dict[str, Callable[[Rng], Case]] = {"shading": shading, "shadows": shadows, "ends": ends}


# --- Things near an end of the way --------------------------------------------------------------


def _before_lamp(rng: Rng, stage: Stage, near: float) -> Thing:
    return _across(rng, stage, stage.target - near * unit(stage.way), "just before the lamp")


def _behind_lamp(rng: Rng, stage: Stage, near: float) -> Thing:
    return _across(rng, stage, stage.target + near * unit(stage.way), "just behind the lamp")


def _at_lamp(rng: Rng, stage: Stage, near: float) -> Thing:
    return _across(rng, stage, stage.target, "that holds the lamp")


def _ball_at_lamp(rng: Rng, stage: Stage, near: float) -> Thing:
    radius = rng.uniform(0.05, 0.5) * float(np.linalg.norm(stage.way))
    inward = unit(unit(stage.way) + rng.uniform(0, 0.8) * unit(rng.normal(size=3)))
    return ball(stage.target + radius * inward, radius, "a ball that the lamp lies on")


def _above_surface(rng: Rng, stage: Stage, near: float) -> Thing:
    center = stage.place + near * unit(stage.way)
    return wall(center, _facing(rng, stage, 0.3), 0.7 * near, "a speck just above the surface")


def _below_surface(rng: Rng, stage: Stage, near: float) -> Thing:
    normal = stage.receiver.normal(stage.place)
    below = -np.sign(float(normal @ stage.way)) * near * normal
    return wall(stage.place + below, normal, stage.scale, "a wall just below the surface")


_ENDS = {
    "just before the lamp": _before_lamp,
    "just behind the lamp": _behind_lamp,
    "lamp on a wall": _at_lamp,
    "lamp on a ball": _ball_at_lamp,
    "just above the surface": _above_surface,
    "just below the surface": _below_surface,
}


def _across(rng: Rng, stage: Stage, center: Array, words: str) -> Thing:
    width = rng.uniform(0.1, 0.4) * float(np.linalg.norm(stage.way))
    return wall(center, _facing(rng, stage, 0.8), width, f"a wall {words}")


def _facing(rng: Rng, stage: Stage, tilt: float) -> Array:
    """More or less along the way, forwards or back."""
    along = unit(stage.way) + rng.uniform(0, tilt) * unit(rng.normal(size=3))
    return np.asarray(unit(along) * rng.choice([-1, 1]))


# --- Parts of all cases -------------------------------------------------------------------------


def _stage(rng: Rng, anywhere: float) -> Stage:
    """``anywhere``: how often the lamp may be on either side, not only on the eye's."""
    while True:
        scale = 10 ** rng.uniform(-3, 3)
        receiver, place, true = _receiver(rng, scale)
        side = 1 if rng.random() < 0.8 else -1
        to_eye, to_lamp = (_on_side(rng, side * true) for _ in range(2))
        if rng.random() < anywhere:
            to_lamp = unit(rng.normal(size=3))
        reach = scale * rng.uniform(0.3, 3, 2)
        if isinstance(receiver, Sphere) and side < 0:
            reach = receiver.radius * rng.uniform(0.1, 1.5, 2) * abs(to_eye @ true)
        origin = single(place + reach[0] * to_eye)
        direction = single((place - origin) * rng.uniform(0.3, 3))
        hit = first_hit([receiver], origin, direction)
        if hit is not None:
            place = origin + hit[1] * direction
            target = single(place + reach[1] * to_lamp)
            return Stage(scale, receiver, origin, direction, place, target)


def _receiver(rng: Rng, scale: float) -> tuple[Thing, Array, Array]:
    """The thing, about where on it the vertex is, and its normal there."""
    normal, center = unit(rng.normal(size=3)), scale * rng.uniform(-1, 1, 3)
    if rng.random() < 0.7:
        floor = wall(center, normal, scale * rng.uniform(2, 4), "a floor")
        shift = rng.uniform(-0.3, 0.3, 2)
        return floor, floor.center + shift[0] * floor.side_x + shift[1] * floor.side_y, normal
    receiver = ball(center, scale * rng.uniform(0.4, 1.5), "a ball")
    return receiver, receiver.center + receiver.radius * normal, normal


def _on_side(rng: Rng, normal: Array) -> Array:
    direction = unit(rng.normal(size=3))
    return np.asarray(direction if float(direction @ normal) > 0 else -direction)


def _obstacle(rng: Rng, stage: Stage, part: float, beside: bool) -> Thing:
    """A wall or ball at this part of the way; off it by more than its size if ``beside``."""
    size = rng.uniform(0.05, 0.3) * float(np.linalg.norm(stage.way)) * max(1.0, abs(part))
    sideways = unit(np.cross(stage.way, rng.normal(size=3)))
    off = (rng.uniform(1.6, 4) if beside else rng.uniform(0, 0.5)) * size
    center = stage.place + part * stage.way + off * sideways
    made_of = int(rng.choice([PLAIN, GLASS, NO_MATERIAL], p=[0.6, 0.2, 0.2]))
    words = f"{NAMES[made_of]}%s at {part:.4g} of the way, {off / size:.2g} of its size off it"
    if rng.random() < 0.5:
        return ball(center, size, f"a {words % 'ball'}", made_of)
    return wall(center, _facing(rng, stage, 0.8), 2 * size, f"a {words % 'wall'}", made_of)


def _lit(
    rng: Rng, label: str, stage: Stage, things: Sequence[Thing], endless: bool = False
) -> Case:
    """A light that has no place says some place all the same: nobody may use it."""
    target = single(stage.place + 0.01 * stage.way) if endless else stage.target
    delta = bool(rng.random() < 0.7)
    pdf = 1.0 if delta else float(np.float32(10 ** rng.uniform(-1, 2)))
    paint = _paint(rng, int(rng.choice([ONE_SIDED, TWO_SIDED])))
    to_light = single(unit(stage.way))
    return Case(
        label, tuple(things), stage.origin, stage.direction, to_light, target, _radiance(rng),
        paint, None, pdf, endless, delta,
    )  # fmt: skip


def _paint(rng: Rng, kind: int) -> Paint:
    albedo = single(rng.uniform(0.05, 1, 3) * (rng.random(3) > 0.1) + 1e-3).tolist()
    eta, k = single(rng.uniform(0.1, 3, 3)).tolist(), single(rng.uniform(0.5, 5, 3)).tolist()
    return Paint(kind, albedo, float(np.float32(rng.uniform(0.2, 0.9))), eta, k)


def _radiance(rng: Rng) -> Array:
    """Never all black: light_sample gives no such light."""
    dark = rng.random(3) < 0.15
    dark[int(rng.integers(3))] = False
    return single(10 ** rng.uniform(-3, 4) * rng.uniform(0.1, 1, 3) * ~dark)
