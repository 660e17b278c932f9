"""A ray tracer in float64 for scenes of rects and spheres: what `intersection_test` must see.

It reads the scene file's own JSON and follows many rays at once. A ray's way can be nudged on one
of its segments, which tells how much a rounding there changes the answer (chain_bounds.py).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from chain_things import Array, Json, Mask, Thing, nearest, single, surface, things_of, unit
from numpy.typing import NDArray

LEFT, UNLIT, NO_MATERIAL, TOO_DEEP, ABSORBED, LIT, UNKNOWN = range(7)
"""How a way ends. UNLIT: on a surface that no light reaches. UNKNOWN: chance or a gloss decides, or
the ray comes near a critical angle."""


@dataclass(frozen=True)
class Nudges:
    """For each ray: the segment that is nudged (-1: none), and by how much.

    ``across`` moves the segment's start, ``turn`` turns it; both (n, 2), along two directions at
    right angles to the segment.
    """

    segment: NDArray[np.int64]
    across: Array
    turn: Array


@dataclass(frozen=True)
class Ways:
    """What n rays met.

    ``met`` (n, steps): the thing at each step, -1 after the last; ``total``: did it mirror;
    ``bends``: how far rounding may turn the ray there. ``lights``: which lights reach the end, as
    bits. ``throughput``: the product of the weights on the way.
    """

    radiance: Array
    throughput: Array
    end: NDArray[np.int64]
    met: NDArray[np.int64]
    total: Mask
    bends: Array
    lights: NDArray[np.int64]


def trace(scene: Json, origin: Array, direction: Array, nudges: Nudges | None = None) -> Ways:
    """Follow the rays."""
    things = things_of(scene)
    limit = int(scene["integrator"]["max_depth"])
    n = len(origin)
    o, d = origin.copy(), unit(direction)
    throughput, radiance = np.ones((n, 3)), np.zeros((n, 3))
    end = np.full(n, LEFT)
    lights = np.zeros(n, np.int64)
    met = np.full((n, limit + 1), -1)
    total = np.zeros((n, limit + 1), bool)
    bends = np.zeros((n, limit + 1))
    going, leaving = np.arange(n), np.full(n, -1)
    for depth in range(limit + 1):
        if not len(going):
            break
        if nudges:
            _nudge(o, d, going[nudges.segment[going] == depth], nudges)
        thing, t = nearest(things, o[going], d[going], leaving[going])
        met[going, depth] = thing
        going, thing, t = going[thing >= 0], thing[thing >= 0], t[thing >= 0]
        leaving[going] = thing
        point, normal = surface(things, thing, o[going], d[going], t)
        stays = np.zeros(len(going), bool)
        for index in np.unique(thing):
            rows = np.flatnonzero(thing == index)
            at, p, nrm, way = going[rows], point[rows], normal[rows], d[going[rows]]
            material = things[index].material
            if material is None:
                end[at] = NO_MATERIAL
            elif material["type"] in ("refraction", "glass"):
                out, weight, mirrored, known, bend = _bend(material, nrm, -way)
                total[at, depth], bends[at, depth] = mirrored, bend
                throughput[at] *= weight
                o[at], d[at] = p, out
                on = np.where(known, LEFT, UNKNOWN)
                end[at] = TOO_DEEP if depth == limit else on
                end[at[(weight == 0).all(axis=1) & known]] = ABSORBED
                stays[rows] = end[at] == LEFT
            else:
                light, bits = _lit(scene, things, int(index), p, nrm, -way)
                gloss = material["type"] != "diffuse"
                radiance[at], lights[at] = throughput[at] * light, bits
                dark = (light == 0).all(axis=1)
                end[at] = np.where(dark, UNLIT, UNKNOWN if gloss else LIT)
        going = going[stays]
    return Ways(radiance, throughput, end, met, total, bends, lights)


def _bend(material: Json, normal: Array, outgoing: Array) -> tuple[Array, Array, Mask, Mask, Array]:
    """Where the ray goes on, its weight, whether it is mirrored, and whether that is sure."""
    eta = float(np.float32(material.get("eta", 1.5)))
    c = np.sum(outgoing * normal, axis=1, keepdims=True)
    side = np.where(c >= 0, 1.0, -1.0)
    r = np.where(c >= 0, 1 / eta, eta)
    along = outgoing - c * normal
    k = 1 - r**2 * np.sum(along**2, axis=1, keepdims=True)
    mirrored = (k < 0)[:, 0]
    beyond = -r * along - side * np.sqrt(np.maximum(k, 0)) * normal
    out = np.where(k < 0, c * normal - along, beyond)
    glass = material["type"] == "glass"
    passed, back = (single(material.get(part, [1, 1, 1])) for part in "TR")
    weight = np.where(k < 0, back, passed) if glass else np.ones_like(out)
    known = mirrored | (eta == 1) if glass else np.ones(len(out), bool)
    # The contract of refraction_direction; near the critical angle it promises nothing.
    with np.errstate(all="ignore"):
        bend = 1e-6 * (1 + r) + np.where(k < 0, 0, 0.5e-6 * (1 + r**2) / np.sqrt(np.abs(k)))
    sure = known & (np.abs(k) > 0.02)[:, 0]
    return out, weight, mirrored, sure, bend[:, 0]


def _lit(
    scene: Json, things: list[Thing], index: int, point: Array, normal: Array, outgoing: Array
) -> tuple[Array, NDArray[np.int64]]:
    """What the lights without extent give, and which of them do."""
    thing = things[index]
    material = thing.material or {}
    leaving = np.full(len(point), index)
    sum_, bits = np.zeros_like(point), np.zeros(len(point), np.int64)
    facing = np.sign(np.sum(outgoing * normal, axis=1))
    if not material.get("twosided", material["type"] != "diffuse"):
        facing = np.where(facing > 0, facing, 0)
    for number, light in enumerate(_lights(scene)):
        if light["type"] == "point":
            way = single(light["position"]) - point
            square = np.sum(way**2, axis=1, keepdims=True)
            reach = np.sqrt(square)
            arriving = single(light["flux"]) / (4 * np.pi * square)
        else:
            way = np.broadcast_to(-single(light["direction"]), point.shape)
            reach = np.full((len(point), 1), np.inf)
            arriving = np.broadcast_to(single(light["irradiance"]), point.shape)
        to = unit(way)
        cosine = np.sum(to * normal, axis=1) * facing
        blocked = nearest(things, point, to, leaving)[1] < reach[:, 0]
        seen = (cosine > 0) & ~blocked
        part = thing.albedo / np.pi * arriving * cosine[:, None]
        sum_ += np.where(seen[:, None], part, 0)
        bits |= seen.astype(np.int64) << number
    return sum_, bits


def _lights(scene: Json) -> list[Json]:
    own = scene["integrator"]
    course = {"type": "point", "position": own["point_light_position"],
              "flux": own["point_light_flux"]}  # fmt: skip
    return [course, *scene.get("lights", [])]


def _nudge(o: Array, d: Array, at: NDArray[np.int64], nudges: Nudges) -> None:
    first = unit(np.cross(d[at], np.eye(3)[np.abs(d[at]).argmin(axis=1)]))
    second = np.cross(d[at], first)
    across, turn = nudges.across[at], nudges.turn[at]
    o[at] += across[:, :1] * first + across[:, 1:] * second
    d[at] = unit(d[at] + turn[:, :1] * first + turn[:, 1:] * second)
