"""How far a right integrator in single precision may be from float64, ray by ray.

Each segment of a way is nudged: its start by what rounding may move a point (32 roundings of the
scene's largest coordinate, which covers the hit, the normal and the step off the surface), and its
direction by what the contract of refraction_direction lets it be off. The changes of the
radiance are added up, as if every rounding were against us, and doubled.

The nudges are made 256 times as large and the changes divided by as much. If one of them changes
what is met, mirrored or lit, the ray comes too near an edge, and is no case. Nor is it if its
radiance may be off by more than one per cent.
"""

from __future__ import annotations

import numpy as np
from chain_things import Array, Json, Mask, things_of
from chain_tracer import LEFT, LIT, UNKNOWN, Nudges, Ways, trace
from numpy.typing import NDArray

ENLARGED = 256
ROUNDING = 32 * 2.0**-24
TURN = 1e-6
"""Of a direction of length one that is mirrored, or just scaled to length one."""
SAFETY = 2
SHADING = 1e-5
"""Of the light's falloff, cosine and colours themselves: some 30 roundings, and to spare."""
WORST = 0.01
AXES = np.array([[1, 0], [-1, 0], [0, 1], [0, -1]], float)


def bounds(scene: Json, origin: Array, direction: Array) -> tuple[Ways, Array, Mask]:
    """What the rays see, how far each channel may be off, and which rays are cases."""
    ways = trace(scene, origin, direction)
    rows, segment = np.nonzero(_segments(ways))
    step = np.full(len(rows), ENLARGED * ROUNDING * _reach(scene, origin))
    before = np.where(segment > 0, ways.bends[rows, segment - 1], 0)
    sizes = (step, ENLARGED * (before + TURN))
    nudges = _nudges(segment, *sizes)
    rows = np.tile(rows, 2 * len(AXES))
    nudged = trace(scene, origin[rows], direction[rows], nudges)
    # Forth and back along four axes: the larger change of each counts.
    change = np.abs(nudged.radiance - ways.radiance[rows]).reshape(4, 2, -1, 3).max(axis=1)
    error, steady = np.zeros_like(origin), ways.end != UNKNOWN
    np.add.at(error, rows[: change[0].size // 3], change.sum(axis=0) / ENLARGED)
    np.logical_and.at(steady, rows, _same(ways, rows, nudged))
    tolerance = SAFETY * error + SHADING * ways.radiance
    steady &= (ways.end != LIT) | (tolerance.max(axis=1) < WORST * ways.radiance.max(axis=1))
    return ways, tolerance, steady


def _segments(ways: Ways) -> Mask:
    """Which segments the ways have; the one that leaves the scene counts."""
    met = ways.met >= 0
    left: Mask = np.zeros_like(met)
    left[:, 1:] = met[:, :-1] & ~met[:, 1:] & (ways.end == LEFT)[:, None]
    left[:, 0] = True
    return np.asarray(met | left)


def _nudges(segment: NDArray[np.int64], step: Array, turn: Array) -> Nudges:
    """Each segment nudged along each axis, forth and back: first all across, then all turned."""
    axes = np.repeat(AXES, len(segment), axis=0)
    none = np.zeros_like(axes)
    across = axes * np.tile(step, len(AXES))[:, None]
    turned = axes * np.tile(turn, len(AXES))[:, None]
    return Nudges(
        np.tile(segment, 2 * len(AXES)),
        np.concatenate([across, none]),
        np.concatenate([none, turned]),
    )


def _same(ways: Ways, rows: NDArray[np.int64], nudged: Ways) -> Mask:
    """Is all but the radiance as without the nudge?"""
    same = (nudged.end == ways.end[rows]) & (nudged.lights == ways.lights[rows])
    same &= (nudged.met == ways.met[rows]).all(axis=1)
    same &= (nudged.total == ways.total[rows]).all(axis=1)
    return np.asarray(same)


def _reach(scene: Json, origin: Array) -> float:
    """The largest coordinate of anything on the way."""
    sizes = [
        np.abs(thing.center).max() + max(thing.radius, np.abs(thing.x).max(), np.abs(thing.y).max())
        for thing in things_of(scene)
    ]
    return float(max([np.abs(origin).max(), *sizes]))
