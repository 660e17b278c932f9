"""The random cases of oracle_triangle.py: groups "random", "degenerate" and "hostile".

Triangles of every size from 1e-4 to 1e4, up to sixteen sizes from the world's origin, seen from a
tenth of their size to a hundred sizes away; needles, grazing and axis-parallel rays,
directions of any length; rays aimed inside, near an edge and outside, and ranges of every kind.
The files of cases hold single precision: what the rounding of the aim does is for the oracle.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

KINDS = {  # share of the random cases, in per cent
    "inside": 36,
    "near an edge": 24,
    "outside": 15,
    "behind": 8,
    "before t_min": 8,
    "after t_max": 9,
}

BROKEN = {  # share of the degenerate cases, in per cent
    "equal corners": 70,
    "a point": 10,
    "corner not finite": 20,
}


def random_cases(rng: np.random.Generator, n: int) -> tuple[NDArray[np.float32], list[str]]:
    """n input records of probe_triangle.c, and a label for each: kind, size, grazing."""
    return _cases(rng, rng.choice(list(KINDS), n, p=np.array(list(KINDS.values())) / 100))


def degenerate_cases(rng: np.random.Generator, n: int) -> tuple[NDArray[np.float32], list[str]]:
    """The same with triangles that have no area in any arithmetic; the rays meet what is left."""
    return _cases(rng, rng.choice(list(BROKEN), n, p=np.array(list(BROKEN.values())) / 100))


def _cases(
    rng: np.random.Generator, kind: NDArray[np.str_]
) -> tuple[NDArray[np.float32], list[str]]:
    n = len(kind)
    size = 10 ** rng.uniform(-4, 4, n)
    p = _random_triangles(rng, size)
    p[kind == "equal corners", 2] = p[kind == "equal corners", 1]
    p[kind == "a point", 1:] = p[kind == "a point", :1]
    p = _shuffled_corners(rng, p)
    target = np.einsum("ni,nij->nj", _random_weights(rng, kind), p)
    towards, grazing = _random_directions(rng, p, n)
    distance = size * 10 ** rng.uniform(-1, 2, n)
    speed = np.where(rng.random(n) < 0.5, 1.0, 10 ** rng.uniform(-2, 2, n))
    t = np.where(kind == "behind", -1.0, 1.0) * distance / speed
    direction = towards * speed[:, None]
    origin = target - t[:, None] * direction
    t_min, t_max = _random_ranges(rng, kind, np.abs(t))
    poisoned = np.flatnonzero(kind == "corner not finite")
    p[poisoned, rng.integers(0, 3, len(poisoned)), rng.integers(0, 3, len(poisoned))] = rng.choice(
        [np.nan, np.inf, -np.inf], len(poisoned)
    )
    label = [_label(k, s, g) for k, s, g in zip(kind, size, grazing, strict=True)]
    columns = [p.reshape(n, 9), origin, direction, t_min[:, None], t_max[:, None]]
    return np.concatenate(columns, axis=1).astype("<f4"), label


def hostile_cases(rng: np.random.Generator, n: int) -> tuple[NDArray[np.float32], list[str]]:
    """What no scene holds: NaN, infinities, no direction, ends of a float's range."""
    words, label = random_cases(rng, n)
    odd = np.array(
        [np.nan, np.inf, -np.inf, 0, -0.0, 1e-45, -1e-38, 3e38, -3e38, 1e-20], np.float32
    )
    struck = rng.random(words.shape) < rng.choice([0.05, 0.3, 1.0], (n, 1))
    words = np.where(struck, rng.choice(odd, words.shape), words).astype("<f4")
    words[: n // 20, 12:15] = 0
    words[n // 20 : n // 10, 3:9] = np.tile(words[n // 20 : n // 10, 0:3], 2)
    return words, [f"hostile, from {name}" for name in label]


def _label(kind: str, size: float, grazing: bool) -> str:
    scale = "a tiny " if size < 1e-2 else "a huge " if size > 1e2 else "a "
    return f"{kind}, {scale}triangle" + (", grazing" if grazing else "")


def _unit(vectors: Array) -> Array:
    """Each vector at length one; one of length zero becomes NaN."""
    with np.errstate(invalid="ignore", divide="ignore"):
        unit: Array = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    return unit


def _random_triangles(rng: np.random.Generator, size: Array) -> Array:
    """A third are needles down to 1:1000, a quarter lie in an axis-aligned plane."""
    n = len(size)
    flat = np.zeros((n, 3, 3))
    flat[:, 1, 0] = 1
    flat[:, 2, 0] = rng.uniform(-0.3, 1.3, n)
    flat[:, 2, 1] = np.where(rng.random(n) < 1 / 3, 10 ** rng.uniform(-3, 0, n), 1)
    flat[:, 2, 1] *= rng.uniform(0.3, 1, n) * rng.choice([-1, 1], n)
    basis = np.linalg.qr(rng.normal(size=(n, 3, 3)))[0]
    aligned = rng.random(n) < 0.25
    basis[aligned] = np.eye(3)[rng.permuted(np.tile(np.arange(3), (n, 1)), axis=1)][aligned]
    centre = _unit(rng.normal(size=(n, 3))) * 10 ** rng.uniform(-1, 1.2, (n, 1))
    placed: Array = (flat @ basis + centre[:, None, :]) * size[:, None, None]
    return placed


def _shuffled_corners(rng: np.random.Generator, p: Array) -> Array:
    order = rng.permuted(np.tile(np.arange(3), (len(p), 1)), axis=1)
    return np.take_along_axis(p, order[:, :, None], axis=1)


def _random_weights(rng: np.random.Generator, kind: NDArray[np.str_]) -> Array:
    """Where the ray is aimed, as weights of the corners."""
    n = len(kind)
    weights = rng.dirichlet([1, 1, 1], n)
    # The first weight is small, of either sign, or clearly negative; the others share the rest.
    small = rng.choice([-1, 1], n) * 10 ** rng.uniform(-3.7, -1.5, n)
    negative = -(10 ** rng.uniform(-1.5, 0.5, n))
    first = np.where(kind == "near an edge", small, negative)
    share = np.where(kind == "near an edge", rng.random(n), rng.uniform(-0.5, 1.5, n))
    aside = np.stack([first, (1 - first) * share, (1 - first) * (1 - share)], axis=1)
    chosen = np.isin(kind, ["near an edge", "outside"])
    weights[chosen] = rng.permuted(aside, axis=1)[chosen]
    return weights


def _random_directions(rng: np.random.Generator, p: Array, n: int) -> tuple[Array, Mask]:
    """Unit directions: any, along an axis, or at a grazing angle to the triangle."""
    towards = _unit(rng.normal(size=(n, 3)))
    choice = rng.random(n)
    axis = choice < 0.1
    towards[axis] = (rng.choice([-1, 1], (n, 1)) * np.eye(3)[rng.integers(0, 3, n)])[axis]
    grazing: Mask = choice > 0.85
    normal = _unit(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]))
    grazing &= np.isfinite(normal).all(axis=1)
    along = _unit(np.cross(normal, towards))
    height = rng.choice([-1, 1], (n, 1)) * 10 ** rng.uniform(-3, -0.7, (n, 1))
    low = along * np.sqrt(1 - height**2) + normal * height
    towards[grazing] = low[grazing]
    return towards, grazing


def _random_ranges(
    rng: np.random.Generator, kind: NDArray[np.str_], t: Array
) -> tuple[Array, Array]:
    """Ranges that hold t, unless the kind says otherwise."""
    n = len(t)
    beyond = 1 + 10 ** rng.uniform(-3, 1, n)
    short = 1 - 10 ** rng.uniform(-3, -0.1, n)
    t_min = np.where(rng.random(n) < 0.5, 0.0, t * short)
    t_max = np.where(rng.random(n) < 0.5, np.inf, t * beyond)
    t_min = np.where(kind == "behind", 0.0, np.where(kind == "before t_min", t * beyond, t_min))
    t_max = np.where(kind == "before t_min", np.inf, t_max)
    t_min = np.where(kind == "after t_max", 0.0, t_min)
    t_max = np.where(kind == "after t_max", t * short, t_max)
    return t_min, t_max
