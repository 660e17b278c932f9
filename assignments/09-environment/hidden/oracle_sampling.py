"""Statistics of environment_sample and environment_pdf: groups "density" and "samples".

Any density is right that environment.h allows. Nothing is compared with a module's: a student's
density is integrated, and a student's directions are counted against it.

The grid cuts each texel into a multiple of twelve parts a side, of six in fine maps, so that a
density that is constant in halves or thirds of texels, or between texel centres, steps only where
the grid does. Its parts are weighed by their exact solid angles; the density is taken in their
middles. Then the error of the integral is below DOUBT for densities that are smooth in between,
and for those that grow with 1 / sin theta towards the poles (a grid of at least 96 rows:
(pi / 96)^2 / 24).

"samples": 30000 independent pairs a map, counted in the bins of `bins_of` and compared by Pearson's
chi-squared at 1e-9, eleven maps; each count's variance is widened by (DOUBT x expected)^2.

probe_environment.c says how the files are laid out.
"""

from __future__ import annotations

import numpy as np
from environment_grid import DOUBT, Grid, follows, grid_of
from environment_maps import sampling_maps
from environment_probe import Answer, Block, answers, cases_for, map_text, number, place_text
from environment_truth import LUMINANCE, Array, Map, bounds, direction_at, sine_of
from numpy.typing import NDArray
from raybook_grader.probes import Cases, Failure

PICKS = 30000
LOOKS = 3000
Mask = NDArray[np.bool_]

POLE = 2e-3
"""Nearer to a pole than this (radians) only being finite is asked."""

Told = tuple[int, str, str]
"""Which direction or pick, the kind of error, and the words for it."""


def make_cases(group: str, seed: int) -> Cases:
    if group not in ("density", "samples"):
        raise ValueError(f"group {group!r}, expected 'density' or 'samples'")
    rng = np.random.default_rng(seed)
    blocks, grids = [], []
    maps = sampling_maps(rng)
    if group == "density":
        black = np.zeros((4, 8, 3), np.float32)
        maps += [Map("a black map", black), Map("scale 0", maps[1].image, 0.0)]
    for m in maps:
        grid = grid_of(m)
        looks = np.concatenate([np.eye(3), -np.eye(3), rng.normal(size=(LOOKS, 3))])
        looks /= np.linalg.norm(looks, axis=1, keepdims=True)
        looks = np.concatenate([m.to_world(looks), m.to_world(_inside_blends(m))])
        numbers = rng.random((PICKS if group == "samples" else 0, 2))
        blocks.append(Block(m, np.concatenate([m.to_world(grid.local), looks]), numbers))
        grids.append(grid)
    return cases_for(blocks, (group, blocks, grids))


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """What is wrong with each map, told in words."""
    group, blocks, grids = cases.context
    found = answers(blocks, output)
    if isinstance(found, Failure):
        return [found]
    failures, start = [], 0
    for block, grid, answer in zip(blocks, grids, found, strict=True):
        check = wrong_density if group == "density" else wrong_picks
        if told := check(block, grid, answer):
            case, kind, sentence = told
            text = f"{map_text(block.map)}: {sentence}"
            failures.append(Failure(start + case, text, kind, -float(len(text))))
        start += block.count
    return failures


# --- The density ------------------------------------------------------------------------------


def wrong_density(block: Block, grid: Grid, answer: Answer) -> Told | None:
    m, density = block.map, answer.density
    odd = np.flatnonzero(~(np.isfinite(density) & (density >= 0)))
    if len(odd):
        i = int(odd[0])
        where = place_text(m, block.directions[i])
        return i, "not a density", f"{where}: got {number(density[i])}, which no density is"
    if missed := _missed_light(block, answer):
        return missed
    total = float(grid.solid @ density[: len(grid.solid)])
    black = not m.image.any()
    if abs(total - 1) <= DOUBT or (black and not density.any()):
        return None
    return (
        0,
        "not normalised",
        (
            f"the density's integral over the sphere, a sum over {len(grid.solid)} directions, is "
            f"{number(total)}, expected 1"
        ),
    )


def _missed_light(block: Block, answer: Answer) -> Told | None:
    """Directions that are never picked, though light comes from there."""
    m = block.map
    suspects = np.flatnonzero(answer.density == 0)
    directions = block.directions[suspects]
    least, _ = bounds(Map(m.name, m.image, 1.0, m.rotation), directions)
    light = least @ LUMINANCE
    brightest = float((m.image.astype(np.float64) @ LUMINANCE).max())
    far = sine_of(m.to_local(directions)) > POLE
    light = np.where(far, light, 0.0)
    if len(light) == 0 or light.max() <= 1e-3 * brightest:
        return None
    i = int(np.argmax(light))
    return (
        int(suspects[i]),
        "light that is never picked",
        (
            f"{place_text(m, directions[i])}: the density is 0, but there is light of luminance "
            f"{number(light[i])} (at scale 1); the brightest of this map is {number(brightest)}"
        ),
    )


def _inside_blends(m: Map) -> Array:
    """Local directions close to the far border of what a texel shines into, if there are few."""
    if m.width * m.height > 600:
        return np.zeros((0, 3))
    u, v = np.meshgrid(np.arange(m.width) + 0.5, np.arange(m.height) + 0.5)
    steps = [(x, y) for x in (-0.99, -0.75, 0.75, 0.99) for y in (-0.9, 0.0, 0.9)]
    places = [((u + x) / m.width % 1.0, np.clip((v + y) / m.height, 0, 1)) for x, y in steps]
    return np.concatenate([direction_at(a.ravel(), b.ravel()) for a, b in places])


# --- The picks --------------------------------------------------------------------------------


def wrong_picks(block: Block, grid: Grid, answer: Answer) -> Told | None:
    m, first = block.map, len(block.directions)

    def tell(bad: Mask, kind: str, words: str) -> Told:
        i = int(np.flatnonzero(bad)[0])
        numbers = f"({block.numbers[i, 0]:.8g}, {block.numbers[i, 1]:.8g})"
        got = (
            f"direction {tuple(float(f'{x:.7g}') for x in answer.picked[i])} and "
            f"{number(answer.returned[i])}; environment_pdf says {number(answer.same[i])}"
        )
        return first + i, kind, f"random {numbers}: got {got}: {words}"

    finite = np.isfinite(answer.picked).all(axis=1) & np.isfinite(answer.returned)
    if not finite.all():
        return tell(~finite, "not a number", "expected numbers that are finite")
    bad: Mask = answer.returned <= 0
    if bad.any():
        return tell(bad, "nothing picked", "this map is not black: expected a density above 0")
    bad = np.abs(np.linalg.norm(answer.picked, axis=1) - 1) > 1e-5
    if bad.any():
        return tell(bad, "not of length one", "expected a direction of length one")
    if not answer.repeats.all():
        return tell(~answer.repeats, "another direction", "and at the next call something else")
    bad = _disagree(m, answer)
    if bad.any():
        share = f"{np.count_nonzero(bad)} of {len(bad)} picks differ so"
        return tell(bad, "two densities", f"expected the same density twice; {share}")
    told = follows(m, grid, answer.density[: len(grid.solid)], answer.picked)
    return None if told is None else (first, "directions do not follow the density", told)


def _disagree(m: Map, answer: Answer) -> Mask:
    """Picks whose density is neither what environment_pdf says of it nor of what is just beside.

    sin theta may come from a z that is off by 4 u: relative to it, that is 4 u / sin^2 theta.
    """
    near = np.concatenate([answer.same[:, None], answer.beside], axis=1)
    sine = np.maximum(sine_of(m.to_local(answer.picked)), 1e-9)
    error = 2e-3 + 4e-7 / sine**2
    low, high = near.min(axis=1) * (1 - error), near.max(axis=1) * (1 + error)
    outside: Mask = ~((answer.returned >= low) & (answer.returned <= high)) & (sine > POLE)
    return outside
