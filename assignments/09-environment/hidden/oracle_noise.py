"""How good a density is: groups "glow" and "suns".

With luminance L and density p, an estimate of the light that falls on a surface is L cos / p for
one direction. Averaged over all ways that the surface may face, its mean square is one sixth of the
integral of L^2 / p, and by Cauchy and Schwarz's inequality no p makes that less than (integral of
L)^2 / 6, which p in proportion to L does. So

    noise = integral of L^2 / p over (integral of L)^2

says how many times as many directions p needs. It is a number without chance, since p is asked on
a grid; that the directions follow p is tested as in oracle_sampling.py, for else p says nothing.

For comparison, around a single bright texel: in proportion 1; constant between texel centres, at
the mean of the four texels, 1.8; constant in each texel, at the mean of the blend over it 2.1, at
the mean of it and its eight neighbours 4.1. Even directions need 5 for the glow and 58 to 500 for
the suns here. A table of the texels as they stand, with a little of even directions added, needs
thousands: it all but misses what a sun shines into the texels beside it.
"""

from __future__ import annotations

import numpy as np
from environment_grid import Grid, follows, grid_of
from environment_maps import smooth_maps, sunny_maps
from environment_probe import Answer, Block, answers, cases_for, map_text, number
from environment_truth import LUMINANCE, Array, Map, radiance
from raybook_grader.probes import Cases, Failure

PICKS = 20000
ALLOWED = {"glow": 1.5, "suns": 8.0}


def make_cases(group: str, seed: int) -> Cases:
    if group not in ALLOWED:
        raise ValueError(f"group {group!r}, expected 'glow' or 'suns'")
    rng = np.random.default_rng(seed)
    maps = smooth_maps(rng) if group == "glow" else sunny_maps(rng)
    grids = [grid_of(m) for m in maps]
    blocks = [
        Block(m, m.to_world(grid.local), rng.random((PICKS, 2)))
        for m, grid in zip(maps, grids, strict=True)
    ]
    return cases_for(blocks, (group, blocks, grids))


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """The maps whose density is too noisy, told in words."""
    group, blocks, grids = cases.context
    found = answers(blocks, output)
    if isinstance(found, Failure):
        return [found]
    failures, start = [], 0
    for block, grid, answer in zip(blocks, grids, found, strict=True):
        if told := _noisy(block.map, grid, block.directions, answer, ALLOWED[group]):
            kind, sentence = told
            text = f"{map_text(block.map)}: {sentence}"
            failures.append(Failure(start, text, kind, -float(len(text))))
        start += block.count
    return failures


def noise(light: Array, density: Array, solid: Array) -> float:
    """Infinite where light is never picked."""
    with np.errstate(divide="ignore", invalid="ignore"):
        square = np.where(light > 0, light**2 / density, 0.0)
    return float(square @ solid / (light @ solid) ** 2)


def _noisy(
    m: Map, grid: Grid, directions: Array, answer: Answer, allowed: float
) -> tuple[str, str] | None:
    density = answer.density
    if not (np.isfinite(density).all() and (density >= 0).all()):
        return "not a density", "some densities are not finite, or below 0"
    if not (np.abs(np.linalg.norm(answer.picked, axis=1) - 1) < 1e-5).all():
        return "not a direction", "some directions that were picked are not of length one"
    if told := follows(m, grid, density, answer.picked):
        return "directions do not follow the density", told
    light = radiance(m, directions) @ LUMINANCE
    measured = noise(light, density, grid.solid)
    if measured <= allowed:
        return None
    with np.errstate(divide="ignore"):
        cost = np.where(light > 0, light**2 * grid.solid / density, 0.0)
    i = int(np.argmax(cost))
    if not np.isfinite(measured):
        return "light that is never picked", (
            f"light of luminance {number(light[i])} has the density 0: no number of directions "
            "would be enough"
        )
    return "noisy", (
        f"it takes {number(measured)} times as many directions as the best density would, expected "
        f"at most {number(allowed)}. Where it costs most, the luminance is {number(light[i])} and "
        f"the density {number(density[i])}; where it is brightest, {number(light.max())} and "
        f"{number(density[int(np.argmax(light))])}"
    )
