"""Rects and spheres in float64: where a ray meets them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Json = dict[str, Any]


@dataclass(frozen=True)
class Thing:
    """A rect (sides x and y) or a sphere (radius). ``material`` None: none."""

    center: Array
    x: Array
    y: Array
    normal: Array
    radius: float
    material: Json | None
    albedo: Array


def things_of(scene: Json) -> list[Thing]:
    """The scene's objects; numbers are rounded to single precision, as the loader does."""
    return [_thing(scene, entry) for entry in scene["objects"]]


def nearest(
    things: list[Thing], o: Array, d: Array, leaving: NDArray[np.int64]
) -> tuple[NDArray[np.int64], Array]:
    """The thing that each ray meets first, or -1, and where. ``leaving``: what it starts on."""
    best, found = np.full(len(o), np.inf), np.full(len(o), -1)
    for index, thing in enumerate(things):
        t = _crossing(thing, o, d, leaving == index)
        closer = t < best
        best[closer], found[closer] = t[closer], index
    return found, best


def _thing(scene: Json, entry: Json) -> Thing:
    material = scene["materials"].get(entry.get("material_name"))
    albedo = np.ones(3)
    if material and "texture_name" in material:
        albedo = single(scene["textures"][material["texture_name"]]["color"])
    if entry["type"] == "sphere":
        zero = np.zeros(3)
        return Thing(single(entry["center"]), zero, zero, zero,
                     float(np.float32(entry["radius"])), material, albedo)  # fmt: skip
    rows = single(entry["transform"]).reshape(4, 4)
    x, y, z = rows[:3, 0], rows[:3, 1], rows[:3, 2]
    across = np.cross(x, y)
    normal = unit(across[None])[0] * np.sign(np.dot(across, z))
    return Thing(rows[:3, 3], x, y, normal, 0.0, material, albedo)


def _crossing(thing: Thing, o: Array, d: Array, leaving: Mask) -> Array:
    """Where a ray meets the thing; infinite on a miss.

    A ray that leaves a rect does not meet it again; one that leaves a sphere for its inside does.
    """
    way = thing.center - o
    with np.errstate(all="ignore"):
        if thing.radius:
            b = np.sum(way * d, axis=1)
            root = np.sqrt(thing.radius**2 - np.sum((way - b[:, None] * d) ** 2, axis=1))
            t = np.where(leaving | (b - root <= 0), b + root, b - root)
            return np.asarray(np.where((t > 0) & ~(leaving & (b <= 0)), t, np.inf))
        t = way @ thing.normal / (d @ thing.normal)
        place = o + t[:, None] * d - thing.center
        # The sides of these rects are at right angles.
        u, v = place @ thing.x / (thing.x @ thing.x), place @ thing.y / (thing.y @ thing.y)
        inside = (np.abs(u) <= 0.5) & (np.abs(v) <= 0.5) & (t > 0) & ~leaving
        return np.asarray(np.where(inside, t, np.inf))


def surface(
    things: list[Thing], thing: NDArray[np.int64], o: Array, d: Array, t: Array
) -> tuple[Array, Array]:
    point = o + t[:, None] * d
    normal = np.zeros_like(point)
    for index in np.unique(thing):
        rows, it = thing == index, things[index]
        normal[rows] = unit(point[rows] - it.center) if it.radius else it.normal
    return point, normal


def single(values: Any) -> Array:
    """Rounded to single precision, as the loader does."""
    return np.array(values, np.float32).astype(np.float64)


def unit(v: Array) -> Array:
    """Rows of length one."""
    length: Array = np.linalg.norm(v, axis=1, keepdims=True)
    return np.asarray(v / length)
