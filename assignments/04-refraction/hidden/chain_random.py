"""Random chains: halls of mirrors, and rooms with glass in them."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from chain_scenes import Shot, Stage, box, clear, lamp_of, mirror, pane
from chain_things import Array, Json

ROOMS = 40
RAYS = 40
INDICES = np.array([1.0, 1.2, 1.33, 1.5, 2.4, 0.75, 1 / 1.5])

Rng = np.random.Generator


def mirrors(rng: Rng) -> Iterator[Shot]:
    """Boxes whose walls are mirrors but for a few; the camera is inside."""
    for _ in range(ROOMS):
        stage = _stage(rng, int(rng.integers(1, 10)))
        half = rng.uniform(1, 3, 3)
        box(stage, half, _walls(rng, stage), np.eye(3), (0, 0, 0))
        stage.sphere(half * rng.uniform(-0.6, 0.6, 3), 0.3, _opaque(rng, stage))
        stage.lamp = half * rng.uniform(-0.8, 0.8, 3)
        if rng.random() < 0.5:
            stage.shine(half * rng.uniform(-0.8, 0.8, 3), rng.uniform(0, 500, 3))
        start = half * rng.uniform(-0.8, 0.8, (RAYS, 3))
        yield stage.shot("a hall of mirrors", start, rng.normal(size=(RAYS, 3)))


def glasses(rng: Rng) -> Iterator[Shot]:
    """Painted rooms with balls, panes and cubes of glass, looked at from a corner."""
    for _ in range(ROOMS):
        stage = _stage(rng, int(rng.choice([1, 2, 3, 4, 6, 16])))
        box(stage, (4, 4, 4), [stage.paint(c) for c in rng.uniform(0.1, 0.9, (6, 3))],
            np.eye(3), (0, 0, 0))  # fmt: skip
        stage.lamp = np.array([3, 3.5, -3]) + rng.uniform(-0.4, 0.4, 3)
        count = rng.integers(1, 4)
        centers = rng.uniform((0, -1, 0), (0, 1, 0), (count, 3))
        centers[:, 0] = rng.permutation([-2, 0, 2])[:count]
        for center in centers:
            kinds: list[Callable[[Rng, Stage, Array], None]] = [_ball, _shell, _slab, _cube]
            kinds[rng.integers(len(kinds))](rng, stage, center)
        start = rng.uniform((-3, -2, 2.5), (3, 2, 3.5), (RAYS, 3))
        target = rng.choice(centers, RAYS) + rng.uniform(-0.7, 0.7, (RAYS, 3))
        yield stage.shot("a room with glass", start, target - start)


def _stage(rng: Rng, max_depth: int) -> Stage:
    scale = float(rng.choice([1.0, 1e-3, 1e3], p=[0.6, 0.2, 0.2]))
    return Stage(flux=rng.uniform(100, 900, 3), max_depth=max_depth, scale=scale,
                 sky=bool(rng.random() < 0.3))  # fmt: skip


def _walls(rng: Rng, stage: Stage) -> list[Json | None]:
    """One painted wall, one of any kind, four mirrors; in any order."""
    walls: list[Json | None] = [mirror(rng.uniform(0.3, 1, 3)) for _ in range(4)]
    walls.append(stage.paint(rng.uniform(0.1, 0.9, 3)))
    walls.append([{}, None, stage.paint((0.5, 0.6, 0.7))][rng.integers(3)])
    return [walls[i] for i in rng.permutation(6)]


def _opaque(rng: Rng, stage: Stage) -> Json | None:
    return stage.paint(rng.uniform(0.1, 0.9, 3)) if rng.random() < 0.7 else None


def _index(rng: Rng) -> Json:
    return clear(float(rng.choice(INDICES)))


def _ball(rng: Rng, stage: Stage, center: Array) -> None:
    glow = {"light": lamp_of((3, 3, 3))} if rng.random() < 0.2 else {}
    stage.sphere(center, float(rng.uniform(0.4, 0.9)), _index(rng), **glow)


def _shell(rng: Rng, stage: Stage, center: Array) -> None:
    stage.sphere(center, 0.9, clear(1.5))
    stage.sphere(center + rng.uniform(-0.1, 0.1, 3), 0.6, clear(1 / 1.5))


def _slab(rng: Rng, stage: Stage, center: Array) -> None:
    frame = _frame(rng)
    color = rng.uniform(0.3, 1, 3)
    material = pane(color) if rng.random() < 0.4 else _index(rng)
    box(stage, (0.15, 0.8, 0.8), [material] * 6, frame, center)


def _cube(rng: Rng, stage: Stage, center: Array) -> None:
    box(stage, rng.uniform(0.4, 0.55, 3), [_index(rng)] * 6, _frame(rng), center)


def _frame(rng: Rng) -> Array:
    """Three directions at right angles, right-handed, as columns."""
    q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return np.asarray(q * np.sign(np.linalg.det(q)))
