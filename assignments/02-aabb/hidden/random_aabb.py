"""The random cases of oracle_aabb.py: groups "random", "short ways" and "hostile".

Boxes of every size from 1e-4 to 1e4, up to ten sizes from the world's origin; a third have a
side a thousand times thinner, a tenth are flat. Directions of any length; along an axis, with one
zero, or with a component so small that one is tempted to call it zero. Zeros have either sign.
The files of cases hold single precision: what the rounding of the aim does is for the oracle.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Cases32 = tuple[NDArray[np.float32], list[str]]

KINDS = {  # share of the random cases, in per cent
    "through": 24,
    "inside": 12,
    "past": 18,
    "behind": 12,
    "before t_min": 8,
    "after t_max": 12,
    "clipped": 8,
    "zero, on a plane": 5,
    "empty": 1,
}


def random_cases(rng: np.random.Generator, n: int) -> Cases32:
    """n input records of probe_aabb.c, and a label for each."""
    kind = rng.choice(list(KINDS), n, p=np.array(list(KINDS.values())) / 100)
    lower, extent, size = _boxes(rng, n)
    target = lower + extent * rng.uniform(0.02, 0.98, (n, 3))
    direction, way = _directions(rng, n)
    distance = size * 10 ** rng.uniform(-1, 1, n)
    t = distance / np.linalg.norm(direction, axis=1)
    origin = target - t[:, None] * direction
    past = kind == "past"
    origin[past] += _aside(rng, direction, extent + size[:, None] * 0.05)[past]
    behind = kind == "behind"
    origin[behind] = (target + 2 * _through(extent, direction)[:, None] * direction)[behind]
    inside = kind == "inside"
    origin[inside] = target[inside]
    t_min, t_max = _ranges(rng, kind, t)
    _put_on_planes(rng, kind, lower, extent, origin, direction)
    lower32, upper32 = lower.astype("<f4"), (lower + extent).astype("<f4")
    upper32 = np.where(extent == 0, lower32, upper32)
    empty = kind == "empty"
    lower32[empty], upper32[empty] = np.inf, -np.inf
    label = [f"{k}{w}" for k, w in zip(kind, way, strict=True)]
    return _records(lower32, upper32, origin, direction, t_min, t_max), label


def short_ways(rng: np.random.Generator, n: int) -> Cases32:
    """Rays that cross a box so near to an edge that rounding may turn entry and exit round."""
    lower, extent, size = _boxes(rng, n)
    lower32, upper32 = lower.astype("<f4"), (lower + extent).astype("<f4")
    upper32 = np.where(extent == 0, lower32, upper32)
    corner = np.where(rng.random((n, 3)) < 0.5, lower32, upper32).astype(np.float64)
    along = rng.integers(0, 3, n)
    rows = np.arange(n)
    corner[rows, along] = (lower + extent * rng.uniform(0.1, 0.9, (n, 3)))[rows, along]
    away = rng.normal(size=(n, 3)) * size[:, None] * 10 ** rng.uniform(-0.5, 1, (n, 1))
    # The origin first, rounded: the direction then leads to the edge as nearly as it can.
    origin = (corner + away).astype("<f4").astype(np.float64)
    direction = corner - origin
    kinds = ["beside an edge"] * n
    return _records(lower32, upper32, origin, direction, np.zeros(n), np.full(n, np.inf)), kinds


def hostile_cases(rng: np.random.Generator, n: int) -> Cases32:
    """What no scene holds: NaN, infinities, no direction, boxes inside out, ends of the range."""
    words, label = random_cases(rng, n)
    odd = np.array(
        [np.nan, np.inf, -np.inf, 0, -0.0, 1e-45, -1e-38, 3e38, -3e38, 1e-20], np.float32
    )
    struck = rng.random(words.shape) < rng.choice([0.05, 0.3, 1.0], (n, 1))
    words = np.where(struck, rng.choice(odd, words.shape), words).astype("<f4")
    words[: n // 20, 9:12] = 0
    turned = slice(n // 20, n // 10)
    words[turned, 0:3], words[turned, 3:6] = words[turned, 3:6].copy(), words[turned, 0:3].copy()
    return words, [f"hostile, from {name}" for name in label]


def _records(
    lower: NDArray[np.float32], upper: NDArray[np.float32], origin: Array, direction: Array,
    t_min: Array, t_max: Array,
) -> NDArray[np.float32]:  # fmt: skip
    columns = [lower, upper, origin, direction, t_min[:, None], t_max[:, None]]
    return np.concatenate(columns, axis=1).astype("<f4")


def _boxes(rng: np.random.Generator, n: int) -> tuple[Array, Array, Array]:
    """Lower corners, extents and sizes."""
    size = 10 ** rng.uniform(-4, 4, n)
    extent = rng.uniform(0.2, 1, (n, 3))
    thin = rng.random((n, 3)) < 0.12
    extent[thin] *= 10 ** rng.uniform(-3, -1, int(thin.sum()))
    extent[rng.random((n, 3)) < 0.04] = 0
    where = rng.normal(size=(n, 3)) * 10 ** rng.uniform(-1, 0.7, (n, 1))
    return where * size[:, None], extent * size[:, None], size


def _directions(rng: np.random.Generator, n: int) -> tuple[Array, list[str]]:
    """Directions with a word for each: one or two zeros, a component of 1e-3 to 1e-7, or any."""
    direction = rng.normal(size=(n, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    choice = rng.random(n)
    axes = rng.permuted(np.tile(np.arange(3), (n, 1)), axis=1)
    rows = np.arange(n)
    way = np.full(n, "", dtype=object)
    zeros = rng.choice([0.0, -0.0], (n, 2))
    one, two = choice < 0.15, choice < 0.07
    direction[rows[one], axes[one, 0]] = zeros[one, 0]
    direction[rows[two], axes[two, 1]] = zeros[two, 1]
    way[one], way[two] = ", one zero", ", two zeros"
    flat = (choice > 0.15) & (choice < 0.3)
    small = rng.choice([-1, 1], n) * 10 ** rng.uniform(-7, -3, n)
    direction[rows[flat], axes[flat, 0]] = small[flat]
    way[flat] = ", nearly parallel"
    speed = np.where(rng.random(n) < 0.5, 1.0, 10 ** rng.uniform(-6, 2, n))
    return direction * speed[:, None], list(way)


def _through(extent: Array, direction: Array) -> Array:
    """How long, in t, a ray in that direction can be in the box."""
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = np.where(direction == 0, np.inf, extent / np.abs(direction))
    longest: Array = np.where(np.isfinite(crossing), crossing, 0).max(axis=1)
    size = np.linalg.norm(extent, axis=1) / np.linalg.norm(direction, axis=1)
    return np.minimum(longest, 10 * size) + size


def _aside(rng: np.random.Generator, direction: Array, step: Array) -> Array:
    """A step across the direction, by one to ten boxes."""
    across: Array = np.cross(direction, rng.normal(size=direction.shape))
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    return (
        across
        * np.linalg.norm(step, axis=1, keepdims=True)
        * 10 ** rng.uniform(-0.5, 1, (len(direction), 1))
    )


def _ranges(rng: np.random.Generator, kind: NDArray[np.str_], t: Array) -> tuple[Array, Array]:
    """The kind's range: most hold the box, some end before it or begin behind it."""
    n = len(t)
    near, far = t * 10 ** rng.uniform(-3, -1, n), t * 10 ** rng.uniform(1, 2, n)
    t_min = np.where(rng.random(n) < 0.5, 0.0, near)
    t_max = np.where(rng.random(n) < 0.5, np.inf, far)
    t_min = np.where(kind == "before t_min", t * 10 ** rng.uniform(0.5, 2, n), t_min)
    t_max = np.where(kind == "before t_min", np.inf, t_max)
    t_max = np.where(kind == "after t_max", t_min + t * 10 ** rng.uniform(-2, -0.5, n), t_max)
    clipped = kind == "clipped"
    t_min = np.where(clipped, t * rng.uniform(0.9, 1.0, n), t_min)
    t_max = np.where(clipped, t * rng.uniform(1.0, 1.1, n), t_max)
    return np.where(kind == "inside", 0.0, t_min), t_max


def _put_on_planes(
    rng: np.random.Generator, kind: NDArray[np.str_], lower: Array, extent: Array,
    origin: Array, direction: Array,
) -> None:  # fmt: skip
    """Moves these origins onto a plane of the box and their directions along it."""
    rows = np.flatnonzero(kind == "zero, on a plane")
    axis = rng.integers(0, 3, len(rows))
    upper = rng.random(len(rows)) < 0.5
    corner = np.where(upper[:, None], lower[rows] + extent[rows], lower[rows])
    at = np.arange(len(rows))
    origin[rows, axis] = corner[at, axis].astype(np.float32)
    direction[rows, axis] = rng.choice([0.0, -0.0], len(rows))
    # A direction along that axis is none any more.
    lost = rows[~direction[rows].any(axis=1)]
    direction[lost, (axis[np.isin(rows, lost)] + 1) % 3] = 1
