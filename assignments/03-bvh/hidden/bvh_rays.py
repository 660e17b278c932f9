"""Trees that others built, rays to walk them with, and what each ray hits: edges and random ones.

What a ray hits is a list of (place in order, t). A walk must find the least t that is in range.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from bvh_mesh import Scene, scenes
from bvh_sets import Array, around
from bvh_tree import NODE, Floats, Nodes, build
from raybook_grader.cases import numbers

ANY, NESTED, BEYOND = 1, 2, 4
"""Kinds of rays, as in probe_bvh.c; they add up."""


@dataclass(frozen=True)
class Query:
    """One ray; all numbers are single precision. ``label`` names the kind of case."""

    label: str
    origin: tuple[float, ...]
    direction: tuple[float, ...]
    t_min: float
    t_max: float
    hits: list[tuple[int, float]]
    kind: int = 0


@dataclass(frozen=True)
class Case:
    """One tree and its rays. ``words`` describes the tree."""

    words: str
    nodes: Nodes
    queries: list[Query] = field(default_factory=list)


INF = float("inf")
Ray = tuple[str, str, str, tuple[float, float], list[tuple[int, float]]]


# --- Hand-picked ---------------------------------------------------------------------------------


def hand_picked() -> Iterator[Case]:
    """Small trees of whole numbers, each also with x y z moved on to y z x and z x y."""
    yield Case("a tree without nodes", np.zeros(0, NODE), [_query(row, 0) for row in _NOTHING])
    for turn in range(3):
        for words, shape, rays in _SMALL:
            nodes = _tree(shape, turn)
            yield Case(words, nodes, [_query(row, turn) for row in rays])
    rng = np.random.default_rng(5)
    for style in ("comb", "comb-behind", "zigzag"):
        yield _deepest(style, rng)


def _query(row: Ray, turn: int) -> Query:
    label, origin, direction, (t_min, t_max), hits = row
    return Query(
        label, tuple(numbers(origin, turn)), tuple(numbers(direction, turn)), t_min, t_max, hits
    )


Shape = str | tuple["Shape", "Shape"] | tuple[str, "Shape", "Shape"]
"""A leaf's box, "x y z, x y z" with or without " * n" primitives; or two children, with a box
before them if it is larger than need be."""


def _tree(shape: Shape, turn: int) -> Nodes:
    rows: list[tuple[Floats, int, int]] = [(np.zeros((2, 3), np.float32), 0, 0)]
    places = 0

    def fill(node: int, part: Shape) -> Floats:
        nonlocal places
        if isinstance(part, str):
            text, _, count = part.partition(" * ")
            n = int(count or 1)
            rows[node] = (_box(text, turn), places, n)
            places += n
        else:
            child = len(rows)
            rows.extend([rows[node], rows[node]])
            a, b = fill(child, part[-2]), fill(child + 1, part[-1])
            whole = np.stack([np.minimum(a[0], b[0]), np.maximum(a[1], b[1])])
            rows[node] = (_box(part[0], turn) if len(part) == 3 else whole, child, 0)
        return rows[node][0]

    fill(0, shape)
    return np.array(rows, NODE)


def _box(text: object, turn: int) -> Floats:
    corners = [numbers(corner, turn) for corner in str(text).split(",")]
    return np.array(corners, np.float32)


_ALL = (0.0, INF)
_NOTHING: list[Ray] = [
    ("nothing to hit", "0 0 0", "1 0 0", _ALL, []),
    ("nothing to hit", "5 -1 2", "-1 0.5 0", (0.0, 3.0), []),
]

# A leaf of one square at z = 0, met at whole numbers.
_SQUARE: list[Ray] = [
    ("one leaf", "0 0 5", "0 0 -1", _ALL, [(0, 5.0)]),
    ("one leaf", "0.5 -0.5 5", "-0 -0 -1", _ALL, [(0, 5.0)]),
    ("one leaf", "4 0 4", "-1 0 -1", _ALL, [(0, 4.0)]),
    ("one leaf, missed", "3 0 5", "0 0 -1", _ALL, []),
    ("one leaf, missed", "0 0 5", "0 0 1", _ALL, []),
    ("end of the range", "0 0 5", "0 0 -1", (0.0, 5.0), [(0, 5.0)]),
    ("end of the range", "0 0 5", "0 0 -1", (5.0, INF), [(0, 5.0)]),
    ("end of the range", "0 0 5", "0 0 -1", (5.0, 5.0), [(0, 5.0)]),
    ("end of the range", "0 0 0", "0 0 -1", (0.0, 0.0), [(0, 0.0)]),
    ("beyond the range", "0 0 5", "0 0 -1", (0.0, 4.5), [(0, 5.0)]),
    ("before the range", "0 0 5", "0 0 -1", (5.5, INF), [(0, 5.0)]),
    ("along a plane", "-3 0 0", "1 0 0", _ALL, [(0, 3.0)]),
    ("along a plane", "-3 0.5 0", "1 -0 0", (0.0, 3.5), [(0, 3.5)]),
    ("along a plane", "0 -8 -0", "0 4 -0", _ALL, [(0, 2.0)]),
    ("along an edge", "-3 1 0", "1 0 0", _ALL, [(0, 3.0)]),
    ("starts on it", "0 0 0", "0 0 1", _ALL, [(0, 0.0)]),
    ("long direction", "0 0 5", "0 0 -1024", _ALL, [(0, 5 / 1024)]),
    ("short direction", "0 0 5", "0 0 -0.0009765625", _ALL, [(0, 5120.0)]),
]

# Two leaves, 0 <= x <= 1 and 2 <= x <= 3. The first primitive is named 0, the second 1.
_ROW: list[Ray] = [
    ("both leaves are hit", "-1 0.5 0.5", "1 0 0", _ALL, [(0, 1.5), (1, 3.5)]),
    ("both leaves are hit", "4 0.5 0.5", "-1 0 0", _ALL, [(0, 3.5), (1, 1.5)]),
    ("only the far leaf is hit", "-1 0.5 0.5", "1 0 0", _ALL, [(1, 3.5)]),
    ("only the far leaf is hit", "4 0.5 0.5", "-1 0 0", _ALL, [(0, 3.5)]),
    ("only the near leaf is hit", "-1 0.5 0.5", "1 0 0", _ALL, [(0, 1.5)]),
    ("only the near leaf is hit", "4 0.5 0.5", "-1 0 0", _ALL, [(1, 1.5)]),
    ("no leaf is hit", "-1 0.5 0.5", "1 0 0", _ALL, []),
    ("passes between the leaves", "1.5 -4 0.5", "0 1 0", _ALL, []),
    ("starts in the first leaf", "0.5 0.5 0.5", "1 0 0", _ALL, [(1, 2.0)]),
    ("starts in the first leaf", "0.5 0.5 0.5", "-1 0 0", _ALL, [(0, 0.25)]),
    ("starts in the second leaf", "2.5 0.5 0.5", "-1 0 0", _ALL, [(0, 2.0)]),
    ("the range ends at the hit", "-1 0.5 0.5", "1 0 0", (0.0, 3.0), [(1, 3.0)]),
    ("the range ends at the hit", "4 0.5 0.5", "-1 0 0", (0.0, 3.0), [(0, 3.0)]),
    ("the range ends before the hit", "-1 0.5 0.5", "1 0 0", (0.0, 2.5), [(1, 3.0)]),
    ("the range begins behind a hit", "-1 0.5 0.5", "1 0 0", (2.5, INF), [(0, 1.5), (1, 3.5)]),
    ("the range begins at the hit", "-1 0.5 0.5", "1 0 0", (4.0, INF), [(0, 1.5), (1, 4.0)]),
    ("slanted", "-1 -1.5 0.5", "2 2 0", _ALL, [(0, 0.875)]),
    ("slanted", "-1 -2.5 0.5", "1 1 0", _ALL, [(1, 3.25)]),
    ("along an edge of both", "-1 1 1", "1 0 0", _ALL, [(1, 3.5)]),
]

# The second leaf lies in the first: the nearer box need not hold the nearer hit.
_NESTED: list[Ray] = [
    ("the box behind holds the nearer hit", "-1 2 2", "1 0 0", _ALL, [(0, 4.5), (1, 2.5)]),
    ("the box behind holds the nearer hit", "5 2 2", "-1 0 0", _ALL, [(0, 4.5), (1, 2.5)]),
    ("the nearer box holds the nearer hit", "-1 2 2", "1 0 0", _ALL, [(0, 1.25), (1, 2.5)]),
    ("starts in both boxes", "1.5 2 2", "1 0 0", _ALL, [(0, 2.0), (1, 0.25)]),
    ("starts in both boxes", "1.5 2 2", "1 0 0", _ALL, [(0, 0.125), (1, 0.25)]),
    ("only the outer box is entered", "-1 0.5 0.5", "1 0 0", _ALL, [(0, 2.0)]),
    ("equal hits", "-1 2 2", "1 0 0", _ALL, [(0, 2.5), (1, 2.5)]),
]

# Four leaves, two and two; each pair overlaps the other.
_FOUR: list[Ray] = [
    ("four leaves", "-1 0.5 0.5", "1 0 0", _ALL, [(0, 1.5), (1, 5.5), (2, 3.5), (3, 7.5)]),
    ("four leaves", "9 0.5 0.5", "-1 0 0", _ALL, [(0, 8.5), (1, 4.5), (2, 6.5), (3, 2.5)]),
    ("four leaves", "-1 0.5 0.5", "1 0 0", _ALL, [(1, 5.5), (2, 3.5), (3, 7.5)]),
    ("four leaves", "-1 0.5 0.5", "1 0 0", _ALL, [(1, 5.5), (3, 7.5)]),
    ("four leaves", "-1 0.5 0.5", "1 0 0", _ALL, [(3, 7.5)]),
    ("four leaves", "9 0.5 0.5", "-1 0 0", _ALL, [(0, 8.5)]),
    ("four leaves", "9 0.5 0.5", "-1 0 0", _ALL, [(0, 8.5), (1, 4.5)]),
    ("four leaves", "9 0.5 0.5", "-1 0 0", (0.0, 4.0), [(0, 8.5), (1, 4.5)]),
]

_ROOMY: list[Ray] = [
    ("the root's box is much too large", "-9 0.5 0.5", "1 0 0", _ALL, [(0, 9.5), (1, 11.5)]),
    ("the root's box is much too large", "-9 5 0.5", "1 0 0", _ALL, []),
    ("the root's box is much too large", "5 5 5", "1 0 0", _ALL, []),
    ("the root's box is much too large", "5 0.5 0.5", "-1 0 0", _ALL, [(0, 4.5), (1, 2.5)]),
]

_MANY: list[Ray] = [
    ("a leaf of several", "-1 0.5 0.5", "1 0 0", _ALL, [(0, 1.75), (1, 1.5), (2, 1.25)]),
    ("a leaf of several", "-1 0.5 0.5", "1 0 0", _ALL, [(0, 1.25), (1, 1.5), (2, 1.75)]),
    ("a leaf of several", "-1 0.5 0.5", "1 0 0", _ALL, [(4, 3.5), (2, 1.75)]),
    ("a leaf of several", "4 0.5 0.5", "-1 0 0", _ALL, [(4, 1.5), (5, 1.25)]),
    ("a leaf of several", "4 0.5 0.5", "-1 0 0", _ALL, [(0, 3.5)]),
]

_UNIT, _SECOND = "0 0 0, 1 1 1", "2 0 0, 3 1 1"
_SMALL: list[tuple[str, Shape, list[Ray]]] = [
    ("a root that is a leaf, (-1, -1, 0) to (1, 1, 0)", "-1 -1 0, 1 1 0", _SQUARE),
    ("two leaves, (0, 0, 0) to (1, 1, 1) and (2, 0, 0) to (3, 1, 1)", (_UNIT, _SECOND), _ROW),
    (
        "two leaves, (0, 0, 0) to (4, 4, 4) and (1, 1, 1) to (2, 3, 3)",
        ("0 0 0, 4 4 4", "1 1 1, 2 3 3"),
        _NESTED,
    ),
    (
        "two nodes with two leaves each, at x = 0 and 4, and at x = 2 and 6",
        ((_UNIT, "4 0 0, 5 1 1"), (_SECOND, "6 0 0, 7 1 1")),
        _FOUR,
    ),
    (
        "two leaves in a root of (-8, -8, -8) to (8, 8, 8)",
        ("-8 -8 -8, 8 8 8", _UNIT, _SECOND),
        _ROOMY,
    ),
    ("two leaves of three primitives each", (f"{_UNIT} * 3", f"{_SECOND} * 3"), _MANY),
]


def _deepest(style: str, rng: np.random.Generator) -> Case:
    """64 boxes in a row, one leaf a level; the boxes of inner nodes are all as large as the root's.

    So at each level both children are entered, and as many nodes wait as there may ever be.
    """
    centre = np.zeros((64, 3))
    centre[:, 0] = 2 * np.arange(64)
    nodes, order = build(around(centre, 0.5), rng, 1, style)
    nodes["box"][nodes["count"] == 0] = [[-200, -0.5, -0.5], [400, 0.5, 0.5]]
    place = np.argsort(order)
    queries = []
    for i in range(64):
        hits = [(int(place[i]), 203.0 + 2 * i)]
        queries.append(Query("the deepest tree", (-203, 0, 0), (1, 0, 0), 0.0, INF, hits))
        hits = [(int(place[i]), 403.0 - 2 * i)]
        queries.append(Query("the deepest tree", (403, 0, 0), (-1, 0, 0), 0.0, INF, hits))
    everything = [(int(place[i]), 203.0 + 2 * i) for i in range(64)]
    queries.append(Query("the deepest tree", (-203, 0, 0), (1, 0, 0), 0.0, INF, everything))
    return Case(f"a tree of depth 64 ({style}), 64 boxes in a row", nodes, queries)


# --- Random --------------------------------------------------------------------------------------


def random_cases(rng: np.random.Generator) -> Iterator[Case]:
    """Balls in boxes: trees of every shape, rays of every kind."""
    for n, size, style, leaf in [
        (2, 0.4, "median", 1),
        (9, 0.3, "random", 1),
        (60, 0.2, "median", 4),
        (60, 0.2, "random", 1),
        (62, 0.3, "comb-behind", 1),
        (62, 0.3, "zigzag", 1),
        (300, 0.1, "median", 1),
        (300, 0.1, "random", 2),
        (300, 0.6, "median", 8),
        (300, 0.01, "median", 2),
        (30, 0.3, "median", 32),
    ]:
        yield _balls(rng, n, size, style, leaf)


def _balls(rng: np.random.Generator, n: int, size: float, style: str, leaf: int) -> Case:
    scale = float(10 ** rng.uniform(-3, 3))
    centre = rng.uniform(-1, 1, (n, 3)) * scale
    half = rng.uniform(0.2, 1, (n, 1)) * size * scale
    boxes = around(centre, half)
    nodes, order = build(boxes, rng, leaf, style)
    loose = rng.random(len(nodes)) < 0.1
    nodes["box"][loose] += np.float32(0.2 * size * scale) * np.array([[-1], [1]], np.float32)
    origin, direction = _rays(rng, boxes, 300)
    t = _meet(boxes[order], origin, direction)
    queries = [_random_query(rng, *row) for row in zip(origin, direction, t, strict=True)]
    return Case(f"{n} balls in {len(nodes)} nodes, {_STYLES[style]}", nodes, queries)


_STYLES = {
    "median": "halved",
    "random": "split at random",
    "comb-behind": "one split off at a time",
    "zigzag": "one split off at a time, left and right in turns",
}


def _rays(rng: np.random.Generator, boxes: Floats, n: int) -> tuple[Array, Array]:
    """From around and from among the boxes, at a box or anywhere; some along an axis."""
    wide = boxes.astype(np.float64)
    lower, upper = wide[:, 0].min(axis=0), wide[:, 1].max(axis=0)
    origin = rng.uniform(1.5 * lower - 0.5 * upper, 1.5 * upper - 0.5 * lower, (n, 3))
    middle = wide[rng.integers(len(wide), size=n)].mean(axis=1)
    spread = (upper - lower) * np.where(rng.random((n, 1)) < 0.5, 0.02, 0.5)
    direction = middle + spread * rng.uniform(-0.5, 0.5, (n, 3)) - origin
    direction *= 10 ** rng.uniform(-2, 2, (n, 1))
    axis = rng.random(n) < 0.2
    pick = np.eye(3)[rng.integers(3, size=n)]
    side = np.where(rng.random((n, 3)) < 0.5, 0.0, -0.0)
    along = np.where(pick == 1, direction, side)
    straight = np.where(pick == 1, origin, middle)
    direction[axis], origin[axis] = along[axis], straight[axis]
    flat = (rng.random(n) < 0.2) & ~axis
    direction[flat] = np.where(pick == 1, 0.0, direction)[flat]
    return origin.astype(np.float32).astype(float), direction.astype(np.float32).astype(float)


def _meet(boxes: Floats, origin: Array, direction: Array) -> Array:
    """Where ray i enters and leaves ball k: [i, k, 0] and [i, k, 1], in single precision.

    A ball is smaller than its box by a twentieth, so that rounding takes no hit out of a box.
    """
    wide = boxes.astype(np.float64)
    centre = wide.mean(axis=1)
    radius = 0.95 * 0.5 * (wide[:, 1] - wide[:, 0]).min(axis=1)
    s = origin[:, None] - centre
    a = (direction**2).sum(axis=1)[:, None]
    b = np.einsum("iks,is->ik", s, direction)
    square = b * b - a * ((s**2).sum(axis=2) - radius**2)
    with np.errstate(invalid="ignore"):
        root = np.sqrt(square)
    t: Array = np.stack([(-b - root) / a, (-b + root) / a], axis=2)
    return t.astype(np.float32).astype(np.float64)


def _random_query(rng: np.random.Generator, origin: Array, direction: Array, t: Array) -> Query:
    hits = [(int(k), float(t[k, s])) for k in range(len(t)) for s in (0, 1) if t[k, s] >= 0]
    reach = float(np.max(t[np.isfinite(t)], initial=1.0))
    t_min = float(np.float32(rng.uniform(0, abs(reach)))) if rng.random() < 0.25 else 0.0
    t_max = float(np.float32(rng.uniform(t_min, 2 * abs(reach)))) if rng.random() < 0.4 else INF
    # Away from all hits: whether one at the very end counts is asked with whole numbers.
    near = [t for _, t in hits]
    if any(abs(h - t_min) < 1e-4 * h for h in near):
        t_min = 0.0
    if any(abs(h - t_max) < 1e-4 * h for h in near):
        t_max = INF
    kind = (NESTED if rng.random() < 0.3 else 0) + (BEYOND if rng.random() < 0.5 else 0)
    where = "a random ray" if (direction != 0).all() else "a ray along an axis or a plane"
    return Query(where, tuple(origin), tuple(direction), t_min, t_max, hits, kind)


# --- Counted -------------------------------------------------------------------------------------


def counted_cases(rng: np.random.Generator) -> Iterator[tuple[Case, Scene]]:
    """Meshes, halved trees over them, and rays that ask for the nearest hit or for any."""
    for scene in scenes(rng):
        place = np.argsort(scene.order)
        hits: list[list[tuple[int, float]]] = [[] for _ in range(len(scene.rays))]
        for ray, triangle, t in zip(scene.hit_ray, scene.hit_triangle, scene.hit_t, strict=True):
            hits[ray].append((int(place[triangle]), float(t)))
        queries = [
            Query(
                "a ray through a mesh",
                tuple(scene.rays.origin[i]),
                tuple(scene.rays.direction[i]),
                float(scene.rays.t_min[i]),
                INF,
                hits[i],
                ANY if i % 3 == 0 else 0,
            )
            for i in range(len(scene.rays))
        ]
        yield Case(f"{len(scene.boxes)} triangles of {scene.name}", scene.nodes, queries), scene
