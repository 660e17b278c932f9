"""Sets of boxes to build trees over, each with a label; the simplest first."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]
Array = NDArray[np.float64]
Set = tuple[str, Floats]


def hand_picked() -> Iterator[Set]:
    """What breaks builders: little, nothing to sort by, and sizes that differ by far."""
    rng = np.random.default_rng(3)
    yield "no boxes", around(np.zeros((0, 3)), 1.0)
    yield "one box", around(np.array([[1.0, 2.0, 3.0]]), 0.5)
    yield "one point", around(np.array([[1.0, 2.0, 3.0]]), 0.0)
    yield "two boxes side by side", around(np.array([[0.0, 0, 0], [3, 0, 0]]), 1.0)
    yield "two equal boxes", around(np.zeros((2, 3)), 1.0)
    for n in (3, 4, 5, 6, 7, 8, 9, 15, 16, 17, 31, 32, 33, 63, 64, 65, 127):
        yield f"{n} boxes in a row", _row(n, 0)
        yield f"{n} boxes here and there", around(rng.uniform(-1, 1, (n, 3)), 0.1)
    yield "5 boxes, all coordinates below 0", around(_lattice(5) * -1.0 - 10, 0.25)
    yield "1000 boxes, all coordinates below 0", around(rng.uniform(-30, -10, (1000, 3)), 0.25)
    yield from _nothing_to_sort_by()
    yield from _flat(rng)
    yield from _uneven(rng)


def around(centre: Array, half: Array | float) -> Floats:
    """Boxes with these centres and half sides."""
    h = np.broadcast_to(half, centre.shape)
    boxes: Floats = np.stack([centre - h, centre + h], axis=1).astype(np.float32)
    return boxes


def _row(n: int, axis: int) -> Floats:
    centre = np.zeros((n, 3))
    centre[:, axis] = np.arange(n)
    return around(centre, 0.25)


def _lattice(n: int) -> Array:
    k = np.arange(n)
    return np.stack([k % 4, k // 4 % 4, k // 16], axis=1).astype(np.float64)


def _nothing_to_sort_by() -> Iterator[Set]:
    for n in (3, 33, 100, 1000, 100_000):
        yield f"{n} equal boxes", around(np.full((n, 3), 2.0), 0.5)
    for n in (40, 50_000):
        half = np.arange(1, n + 1)[:, None] / 64
        yield f"{n} boxes of different sizes about one centre", around(np.zeros((n, 3)), half)
    yield "1000 equal points", around(np.full((1000, 3), 7.0), 0.0)
    two = np.zeros((20_000, 3))
    two[::3, 1] = 5
    yield "20000 boxes in two piles of equal ones", around(two, 0.25)
    lone = np.zeros((5000, 3))
    lone[1234] = 1e6
    yield "4999 equal boxes and one far away", around(lone, 0.25)
    pairs = np.repeat(_lattice(64), 50, axis=0)
    yield "64 places with 50 equal boxes each", around(pairs, 0.25)


def _flat(rng: np.random.Generator) -> Iterator[Set]:
    for axis, name in enumerate("xyz"):
        yield f"3000 boxes in a row along {name}", _row(3000, axis)
        yield f"3000 boxes in a row along {name}, the last first", _row(3000, axis)[::-1].copy()
        centre = rng.uniform(-1, 1, (2000, 3))
        centre[:, axis] = 0.5
        half = np.full((2000, 3), 0.02)
        half[:, axis] = 0
        yield f"2000 rectangles at {name} = 0.5", around(centre, half)
    line = rng.uniform(-1, 1, (2000, 1)) * np.ones(3)
    yield "2000 points on a diagonal", around(line, 0.0)


def _uneven(rng: np.random.Generator) -> Iterator[Set]:
    size = 10 ** rng.uniform(-6, 6, (4000, 1))
    yield "4000 boxes with sizes from 1e-6 to 1e6", around(rng.normal(size=(4000, 3)) * size, size)
    grow = 1e-6 * 10 ** (12 * np.arange(4000)[:, None] / 4000) * np.array([1.0, -1.0, 0.5])
    yield "4000 boxes, each a little larger and further away", around(grow, np.abs(grow) / 4)
    yield "boxes whose centres halve their distance along x, then along y, then along z", chain()
    yield "the same in another order", chain()[rng.permutation(len(chain()))]
    nested = 1.01 ** np.arange(2000.0)[:, None] * np.ones(3)
    yield "2000 boxes, each around the one before", around(np.zeros((2000, 3)), nested / 1e3)
    far = np.array([1e5, -1e5, 1e5]) + rng.uniform(-0.01, 0.01, (3000, 3))
    yield "3000 small boxes far from the origin", around(far, 0.01)
    yield "500 boxes of size 1e-30", around(rng.normal(size=(500, 3)) * 1e-30, 1e-30)
    yield "500 boxes of size 1e15", around(rng.uniform(-0.9e15, 0.9e15, (500, 3)), 1e14)
    room = np.concatenate([around(np.zeros((1, 3)), 1e3), around(_lattice(200), 0.25)])
    yield "200 boxes and a large one around them all", room


def chain() -> Floats:
    """A split that looks good takes a few off the far end, so that the tree becomes deep."""
    steps = 2.0 ** -np.arange(-49, 100)
    centre = np.zeros((3 * len(steps), 3))
    for axis in range(3):
        centre[axis * len(steps) : (axis + 1) * len(steps), axis] = steps
    half = 0.25 * centre.max(axis=1, keepdims=True)
    return around(centre, half)


def random_sets(rng: np.random.Generator) -> Iterator[Set]:
    """Thirty clouds of up to 3000 boxes, then three sets that are too large for slow builders."""
    for _ in range(30):
        n = int(10 ** rng.uniform(0.5, 3.5))
        name, centre, half = _cloud(rng, n)
        yield f"{n} boxes, {name}", around(centre, half)
    n = 200_000
    yield f"{n} boxes here and there", around(rng.uniform(-1, 1, (n, 3)), 0.002)
    yield f"{n} boxes in a row", _row(n, int(rng.integers(3)))
    yield f"{n} equal boxes", around(np.full((n, 3), 0.5), 0.25)


def _cloud(rng: np.random.Generator, n: int) -> tuple[str, Array, Array]:
    half = 0.02 * 10 ** rng.uniform(-1, 1, (n, 1)) * rng.uniform(0.2, 1, (n, 3))
    kind = int(rng.integers(4))
    if kind == 0:
        return "spread evenly", rng.uniform(-1, 1, (n, 3)), half
    if kind == 1:
        stretched = rng.uniform(-1, 1, (n, 3)) * 10 ** rng.uniform(-2, 2, 3)
        return "spread evenly, but not equally far along the axes", stretched, half
    if kind == 2:
        clump = rng.normal(size=(8, 3))[rng.integers(8, size=n)]
        return "in eight clumps", clump + 0.02 * rng.normal(size=(n, 3)), half
    whole = rng.integers(-3, 4, (n, 3)).astype(np.float64)
    return "with few different centres", whole, np.full((n, 3), 0.25)
