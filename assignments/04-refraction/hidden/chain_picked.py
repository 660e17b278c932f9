"""The hand-picked chains: one question each, at three sizes of the scene."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from chain_scenes import GREY, Shot, Stage, box, clear, lamp_of, mirror, pane

SCALES = (1.0, 1e-3, 1e3)


def mirrors(scales: Sequence[float] = SCALES) -> Iterator[Shot]:
    """Halls of mirrors: a zigzag between two mirrors, and what stands at its end."""
    for scale in scales:
        yield from _no_mirror(scale)
        yield from _ends(scale)
        for count in (1, 2, 3, 5, 8):
            for limit in sorted({1, max(1, count - 1), count, count + 1}):
                yield _zigzag(count, limit, scale)


def glasses(scales: Sequence[float] = SCALES) -> Iterator[Shot]:
    """Through glass balls, panes, cubes and bubbles, on to a wall."""
    for scale in scales:
        for eta in (1.0, 1.33, 1.5, 2.4, 0.75):
            yield _ball(f"a ball of index {eta:g}", eta, scale)
            yield _slab(f"a thick pane of index {eta:g}", eta, scale)
        for limit in (1, 2, 3):
            yield _ball("a glass ball, and a limit", 1.5, scale, max_depth=limit)
        for eta in (1.5, 1.2):
            yield _cube(f"a cube of index {eta:g}", eta, scale)
        yield _bubble("a bubble in a glass ball", scale)
        yield _panes("coloured panes", scale)


def _no_mirror(scale: float) -> Iterator[Shot]:
    for limit in (16, 1):
        stage = Stage(lamp=(1, 1, 1), scale=scale, max_depth=limit)
        stage.rect((0, 0, -2), (8, 0, 0), (0, 8, 0), stage.paint(GREY))
        yield stage.shot("a wall, and nothing clear", [(0, 0, 3), (1, 0, 3)], (0.1, 0.2, -1))
    stage = Stage(lamp=(0, 0, 3), scale=scale)
    stage.rect((0, 0, -2), (8, 0, 0), (0, 8, 0), stage.paint(GREY))
    stage.sphere((0, 0, 0), 1, clear(1.5))
    yield stage.shot("the shadow of a glass ball", (6, 0, 0), (-5.5, 0.3, -2))
    stage = Stage(lamp=(1, 1, 1), scale=scale, sky=True)
    stage.rect((0, 0, -2), (8, 0, 0), (0, 8, 0), stage.paint(GREY))
    yield stage.shot("past everything, under a bright sky", (0, 0, 3), (0, 1, 1))


def _zigzag(count: int, limit: int, scale: float) -> Shot:
    """Mirrors above and below; the ray goes up and down by 45 degrees, ``count`` times."""
    stage = Stage(lamp=(2 * count - 1.2, 0.3, 0.4), scale=scale, max_depth=limit)
    _tunnel(stage, count, 0.9, 0.8)
    stage.rect((2 * count, 0, 0), (0, 0, 4), (0, 4, 0), stage.paint(GREY))
    return stage.shot("mirrors in a row", (0.01, 0.02, 0.03), [(1, 1, 0.1), (1, 1, -0.05)])


def _tunnel(stage: Stage, count: int, above: float, below: float) -> None:
    long = 2 * count + 8
    stage.rect((count, 1, 0), (0, 0, 4), (long, 0, 0), mirror((above, 1, above**2)))
    stage.rect((count, -1, 0), (long, 0, 0), (0, 0, 4), mirror((1, below, below**2)))


def _ends(scale: float) -> Iterator[Shot]:
    """Three mirrors, then something else than a wall."""
    start, way = (0.01, 0.02, 0.03), [(1, 1, 0.1), (1, 1, -0.05)]
    far, tall, wide = (6, 0, 0), (0, 0, 4), (0, 4, 0)

    def tunnel(sky: bool = False) -> Stage:
        stage = Stage(lamp=(4.8, 0.3, 0.4), scale=scale, sky=sky)
        _tunnel(stage, 3, 0.9, 0.8)
        return stage

    stage = tunnel(sky=True)
    yield stage.shot("mirrors, then a bright sky", start, way)

    stage = tunnel()
    stage.rect(far, tall, wide, None)
    yield stage.shot("mirrors, then a lamp without a material", start, way)

    for turn, side in ((tall, "shining side"), (wide, "back")):
        stage = tunnel()
        other = wide if turn is tall else tall
        stage.rect(far, turn, other, stage.paint(GREY), light=lamp_of((5, 4, 3)))
        yield stage.shot(f"mirrors, then the {side} of a painted lamp", start, way)

    for turn, side in ((tall, "back"), (wide, "front")):
        stage = tunnel()
        other = wide if turn is tall else tall
        stage.rect(far, turn, other, stage.paint(GREY, twosided=False))
        yield stage.shot(f"mirrors, then the {side} of a one-sided wall", start, way)

    stage = tunnel()
    stage.rect((3, 1.5, 0), (0.1, 0, 0), (0, 0.1, 0), stage.paint(GREY), light=lamp_of((9, 9, 9)))
    stage.rect(far, tall, wide, stage.paint(GREY))
    stage.rect((1, 0.5, 3), (3, 0, 0), (0, 3, 0), None)
    yield stage.shot("mirrors, then a wall that an area light shines on, too", start, way)

    # The lamp shines on the wall behind the camera; a small shield keeps its light off the metal.
    stage = tunnel()
    stage.lamp = (-3.5, 0, 0.5)
    stage.rect(far, tall, wide, {"type": "roughconductor", "alpha_x": 0.2, "alpha_y": 0.2})
    stage.rect((-4, 0, 0), tall, wide, stage.paint(GREY))
    stage.rect((-3, 0, 0.5), (0, 0, 0.6), (0, 0.6, 0), None)
    fan = [(1, 1, z) for z in np.linspace(-0.2, 0.2, 24)]
    yield stage.shot("mirrors, then brushed metal in the dark", start, fan)

    stage = tunnel()
    stage.rect(far, tall, wide, stage.paint((0.9, 0.5, 0.1)))
    stage.shine((4.5, -0.5, -0.3), (100, 0, 300))
    stage.lights.append(
        {"type": "directional", "direction": [1.0, 0.01, 0.02], "irradiance": [3.0, 2.0, 1.0]}
    )
    yield stage.shot("mirrors, then a wall under three lights", start, way)

    stage = Stage(lamp=(4.8, 0.3, 0.4), scale=scale)
    _tunnel(stage, 3, 0.9, 0.0)
    stage.rect(far, tall, wide, stage.paint(GREY))
    yield stage.shot("a mirror that leaves only red", start, way)

    stage = Stage(lamp=(1.4, 0.3, 0.4), scale=scale)
    stage.rect((1, 1, 0), (0, 0, 4), (20, 0, 0), mirror((0, 0, 0)))
    stage.rect((2, 0, 0), tall, wide, stage.paint(GREY))
    yield stage.shot("a black mirror", start, way)

    stage = Stage(lamp=(1.4, 0.3, 0.4), scale=scale)
    stage.rect((1, 1, 0), (0, 0, 4), (20, 0, 0), mirror((0.5, 1, 1)), light=lamp_of((7, 7, 7)))
    stage.rect((2, 0, 0), tall, wide, stage.paint(GREY))
    yield stage.shot("a mirror that is a lamp, too", start, way)


def _room(scale: float, max_depth: int = 16) -> Stage:
    """A painted room around the origin, each wall of another colour, with a lamp in a corner."""
    stage = Stage(lamp=(3.2, 3.4, 3.1), flux=(900, 800, 700), scale=scale, max_depth=max_depth)
    colors = np.array([[7, 3, 2], [2, 5, 7], [6, 6, 5], [3, 7, 4], [7, 7, 2], [5, 3, 6]]) / 10
    box(stage, (4, 4, 4), [stage.paint(c) for c in colors], np.eye(3), (0, 0, 0))
    return stage


AIM = np.array([(x, y, 0) for x in (-0.55, -0.2, 0, 0.3, 0.65) for y in (-0.6, -0.15, 0.25, 0.5)])
EYE = np.array([0.3, 0.4, 3.3])


def _aimed(stage: Stage, label: str) -> Shot:
    return stage.shot(label, EYE, AIM - EYE)


def _ball(label: str, eta: float, scale: float, max_depth: int = 16) -> Shot:
    stage = _room(scale, max_depth)
    stage.sphere((0, 0, 0), 1, clear(eta))
    return _aimed(stage, label)


def _slab(label: str, eta: float, scale: float) -> Shot:
    stage = _room(scale)
    stage.rect((0, 0, 0.5), (3, 0, 0), (0, 3, 0), clear(eta))
    stage.rect((0, 0, -0.5), (0, 3, 0), (3, 0, 0), clear(eta))
    return stage.shot(label, (1.8, 1.1, 3.3), AIM - (1.8, 1.1, 3.3))


def _cube(label: str, eta: float, scale: float) -> Shot:
    stage = _room(scale)
    c, s = np.cos(0.5), np.sin(0.5)
    frame = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    box(stage, (0.9, 0.8, 0.7), [clear(eta)] * 6, frame, (0, 0, 0))
    return _aimed(stage, label)


def _bubble(label: str, scale: float) -> Shot:
    stage = _room(scale)
    stage.sphere((0, 0, 0), 1, clear(1.5))
    stage.sphere((0.1, 0, 0), 0.5, clear(1 / 1.5))
    return _aimed(stage, label)


def _panes(label: str, scale: float) -> Shot:
    stage = _room(scale)
    for i, color in enumerate([(1, 0.5, 0.9), (0.6, 1, 0.9), (0.9, 0.8, 0.4)]):
        stage.rect((0, 0, 0.5 * i), (3, 0, 0), (0, 3, 0), pane(color))
    return _aimed(stage, label)


def deep() -> Iterator[Shot]:
    """Long ways, right to the end: no array that seemed large enough holds them."""
    for count, limit in ((20, 19), (20, 20), (40, 39), (40, 100)):
        stage = Stage(lamp=(0.5, 0.5, -1), max_depth=limit)
        for i in range(count):
            stage.rect((0, 0, 0.1 * i), (3, 0, 0), (0, 3, 0), pane((0.99, 1, 0.98)))
        stage.rect((0, 0, -2), (8, 0, 0), (0, 8, 0), stage.paint(GREY))
        label = f"{count} panes"
        yield stage.shot(label, (0, 0, 5), [(0.01, 0.02, -1), (0, -0.01, -1)])
