"""The oracle of environment_radiance: group "radiance".

Fourteen maps, each asked in 400 random directions and in hand-picked ones: along the axes, at the
poles and close to them, on both sides of the seam, at texel centres and on their borders. The
truth and how far a right module may be off are in environment_truth.py; probe_environment.c says
how the files are laid out.
"""

from __future__ import annotations

import numpy as np
from environment_maps import lookup_maps
from environment_probe import Block, answers, cases_for, colour, map_text, place_text
from environment_truth import Array, Map, bounds, direction_at, radiance
from raybook_grader.probes import Cases, Failure

RANDOM_DIRECTIONS = 400


def make_cases(group: str, seed: int) -> Cases:
    if group != "radiance":
        raise ValueError(f"group {group!r}, expected 'radiance'")
    rng = np.random.default_rng(seed)
    blocks = []
    for m in lookup_maps(rng):
        world = rng.normal(size=(RANDOM_DIRECTIONS, 3))
        world /= np.linalg.norm(world, axis=1, keepdims=True)
        directions = np.concatenate([m.to_world(_picked(m)), _axes(), world])
        asked = directions.astype(np.float32).astype(np.float64)
        blocks.append(Block(m, asked, np.zeros((0, 2))))
    return cases_for(blocks, blocks)


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Every wrong radiance, told in words."""
    blocks: list[Block] = cases.context
    found = answers(blocks, output)
    if isinstance(found, Failure):
        return [found]
    failures, start = [], 0
    for block, answer in zip(blocks, found, strict=True):
        least, most = bounds(block.map, block.directions)
        with np.errstate(invalid="ignore"):
            good = ((answer.radiance >= least) & (answer.radiance <= most)).all(axis=1)
        expected = radiance(block.map, block.directions)
        for i in np.flatnonzero(~good):
            got, want = answer.radiance[i], expected[i]
            failures.append(_failure(block.map, start + int(i), block.directions[i], want, got))
        start += block.count
    return failures


def _failure(m: Map, case: int, direction: Array, want: Array, got: Array) -> Failure:
    text = (
        f"{map_text(m)}: {place_text(m, direction)}: expected radiance {colour(want)}, "
        f"got {colour(got)}"
    )
    kind = "wrong radiance" if np.isfinite(got).all() else "not a number"
    # Simple: a small map that is not turned, and a short direction.
    return Failure(case, text, f"{kind}: {m.name}", -float(len(text)) - m.width * m.height)


def _axes() -> Array:
    axes = np.concatenate([np.eye(3), -np.eye(3)])
    # With zeros of the other sign: atan2 tells them apart.
    return np.concatenate([axes, np.where(axes == 0.0, -0.0, axes)])


def _picked(m: Map) -> Array:
    """Local directions: all texel centres and corners of small maps, the seam, the poles."""
    tiny = np.array([0.0, 1e-7, 1e-5, 1e-3, 1e-2])
    u = [np.array([0.25, 0.6, 0.99]), np.array([0.1, 0.5]), np.concatenate([tiny, 1 - tiny])]
    v = [np.array([0.3, 0.5, 0.8]), np.concatenate([tiny, 1 - tiny]), np.array([0.2, 0.5, 0.9])]
    places = [np.meshgrid(a, b) for a, b in zip(u, v, strict=True)]
    if m.width * m.height <= 200:
        for shift in (0.0, 0.25, 0.5):
            columns = (np.arange(m.width) + shift) / m.width
            rows = (np.arange(m.height) + shift) / m.height
            places.append(np.meshgrid(columns, rows))
    return np.concatenate([direction_at(a.ravel(), b.ravel()) for a, b in places])
