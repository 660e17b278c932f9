"""Statistics of an area light: groups "spread" and "irradiance".

"spread": numbers spread evenly give places spread evenly. 20000 independent pairs of numbers on
each of six rectangles; the places are counted in 23 x 23 cells and compared with Pearson's
chi-squared; so are the 23 strips along each side. Three tests each, at 1e-8.

"irradiance": what the framework makes of the three functions. On a jittered grid of 128 x 128
numbers the mean of 1 / density is the rectangle's solid angle (A. van Oosterom and J. Strackee,
"The Solid Angle of a Plane Triangle", IEEE Trans. Biomed. Eng. 30(2), 1983), and the mean of
radiance x cosine / density the irradiance (J. Lambert, Photometria, 1760: half the radiance times
the sum over the edges of angle x cosine). Each mean may be off by 6.5 standard errors of
independent numbers, and a jittered grid has no larger ones; 4 x 9 tests at 1e-10 each. Behind the
lamp all must be dark.

probe_rect_light.c says how the files are laid out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from raybook_grader.cases import number, point, wrong_length
from raybook_grader.probes import Cases, Failure
from rect_light_words import Array, make_rect, rect_text, unit
from scipy.stats import chi2

WORDS_OUT = 8
CELLS = 23  # a prime: no regular grid of places fits it
PLACES = 20000
GRID = 128
SIGMAS = 6.5
ROUNDING = 3e-4  # of the value: what the contract grants each density, and more
LEVEL = 1e-8
RADIANCE = np.array([3.0, 2.0, 0.5])


@dataclass(frozen=True)
class Lamp:
    """A rectangle, and who looks at it: a point with a normal."""

    name: str
    rect: Array
    point: Array
    normal: Array


@dataclass(frozen=True)
class Context:
    group: str
    lamps: list[Lamp]
    each: int
    """How many cases belong to each lamp."""


def make_cases(group: str, seed: int) -> Cases:
    """The same lamps whatever the seed; the numbers depend on it."""
    if group not in ("spread", "irradiance"):
        raise ValueError(f"group {group!r}, expected 'spread' or 'irradiance'")
    rng = np.random.default_rng(seed)
    lamps = _lamps()[: 6 if group == "spread" else None]
    records = []
    for lamp in lamps:
        numbers = rng.random((PLACES, 2)) if group == "spread" else _jittered(rng)
        fixed = np.concatenate([lamp.rect, [0.0, 0.0], lamp.point, RADIANCE])
        words = np.tile(fixed, (len(numbers), 1))
        words[:, 13:15] = np.minimum(numbers, 1.0 - 2.0**-24)
        records.append(words)
    payload = np.concatenate(records).astype("<f4")
    each = len(payload) // len(lamps)
    return Cases(payload.tobytes(), len(payload), Context(group, lamps, each))


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """What is wrong with each lamp, told in words; a failure's case is the lamp's first one."""
    if faults := wrong_length(output, 4 * WORDS_OUT, cases.count):
        return faults
    context: Context = cases.context
    values = np.frombuffer(output, "<f4").reshape(cases.count, WORDS_OUT).astype(np.float64)
    failures = []
    for index, lamp in enumerate(context.lamps):
        own = values[index * context.each : (index + 1) * context.each]
        wrong = _uneven(lamp, own) if context.group == "spread" else _wrong_light(lamp, own)
        if wrong is not None:
            kind, sentence = wrong
            text = f"{lamp.name}: {rect_text(lamp.rect)}: {sentence}"
            failures.append(Failure(index * context.each, text, kind, -float(index)))
    return failures


# --- Spread -----------------------------------------------------------------------------------


def _uneven(lamp: Lamp, values: Array) -> tuple[str, str] | None:
    """The kind of error and the words for it; None when the places fit."""
    if not np.isfinite(values[:, :3]).all():
        return "not a number", "some places are not finite"
    center, side_x, side_y = lamp.rect[:9].reshape(3, 3)
    basis = np.stack([side_x, side_y, lamp.rect[9:12]], axis=1)
    at = np.linalg.solve(basis, (values[:, :3] - center).T)[:2] + 0.5
    cell = np.clip(at * CELLS, 0, CELLS - 1).astype(int)
    counts = np.bincount(cell[0] * CELLS + cell[1], minlength=CELLS**2)
    strips = [counts.reshape(CELLS, CELLS).sum(axis=axis) for axis in (0, 1)]
    if not any(_far_from_even(c) for c in (counts, *strips)):
        return None
    expected = len(values) / CELLS**2
    worst = int(np.argmax(np.abs(counts - expected)))
    x, y = divmod(worst, CELLS)
    return "uneven places", (
        f"of {len(values)} places each of {CELLS} x {CELLS} equal parts expects about "
        f"{expected:.0f}; part {x + 1} along side_x and {y + 1} along side_y got {counts[worst]}, "
        f"and {np.count_nonzero(counts == 0)} parts got none"
    )


def _far_from_even(counts: NDArray[np.int64]) -> bool:
    expected = counts.sum() / len(counts)
    statistic = np.sum((counts - expected) ** 2) / expected
    return bool(statistic > chi2.isf(LEVEL, len(counts) - 1))


# --- Irradiance -------------------------------------------------------------------------------


def corners(rect: Array) -> Array:
    """The four corners, one after the other round the edge."""
    center, x, y = rect[:9].reshape(3, 3)
    return np.array(
        [center + a * x + b * y for a, b in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))]
    )


def solid_angle(rect: Array, seen_from: Array) -> float:
    a, b, c, d = unit(corners(rect) - seen_from)
    return abs(_triangle_angle(a, b, c)) + abs(_triangle_angle(a, c, d))


def _triangle_angle(a: Array, b: Array, c: Array) -> float:
    return float(2 * np.arctan2(a @ np.cross(b, c), 1 + a @ b + b @ c + c @ a))


def irradiance(rect: Array, seen_from: Array, normal: Array) -> float:
    """Of a radiance of 1, on a surface above whose horizon the whole rectangle is."""
    to = corners(rect) - seen_from
    total = 0.0
    for a, b in zip(to, np.roll(to, -1, axis=0), strict=True):
        cross = np.cross(a, b)
        total += np.arctan2(np.linalg.norm(cross), a @ b) * float(unit(cross) @ normal)
    return abs(total) / 2


def _wrong_light(lamp: Lamp, values: Array) -> tuple[str, str] | None:
    """The kind of error and the words for it; None when the means fit."""
    place, density, emitted = values[:, :3], values[:, 3], values[:, 4:7]
    front = float((lamp.point - lamp.rect[:3]) @ lamp.rect[9:12]) > 0
    who = f"seen from {point(lamp.point)}"
    if not np.isfinite(values[:, :7]).all() or (density < 0).any():
        return "not a number", f"{who}: some results are not finite, or a density is below 0"
    used = density > 0
    if not front:
        lit = used & (emitted > 0).any(axis=1)
        if not lit.any():
            return None
        return "light from behind", f"{who}, behind it: expected no light, some arrives"
    weight = np.where(used, 1 / np.where(used, density, 1), 0)
    towards = place - lamp.point
    cosine = np.maximum(towards @ lamp.normal, 0) / np.linalg.norm(towards, axis=1)
    light = irradiance(lamp.rect, lamp.point, lamp.normal) * RADIANCE
    tests = [("solid angle", "steradians", weight, solid_angle(lamp.rect, lamp.point))]
    for i, name in enumerate(("red", "green", "blue")):
        tests.append((f"{name} irradiance", "W/m^2", emitted[:, i] * cosine * weight, light[i]))
    for name, unit_name, samples, expected in tests:
        mean, error = float(samples.mean()), float(samples.std()) / GRID
        if abs(mean - expected) > SIGMAS * error + ROUNDING * expected:
            facing = f" on a surface with normal {point(lamp.normal)}" if "irr" in name else ""
            return f"wrong {name}", (
                f"{who}: its {name}{facing} is {number(expected)} {unit_name}; the mean over "
                f"{len(samples)} places is {number(mean)}"
            )
    return None


# --- Cases ------------------------------------------------------------------------------------


def _jittered(rng: np.random.Generator) -> Array:
    cells = np.stack(np.meshgrid(np.arange(GRID), np.arange(GRID)), axis=-1).reshape(-1, 2)
    jittered: Array = (cells + rng.random(cells.shape)) / GRID
    return jittered


def _lamp(name: str, rect: Array, at: tuple[float, float, float], tilt: float = 0.0) -> Lamp:
    """Seen from ``at`` in the rectangle's own axes: sides from its centre, then its normal. The
    surface there faces the centre, but for a tilt (radians)."""
    center, x, y, n = rect[:12].reshape(4, 3)
    # The numbers as the module gets them.
    place = (center + at[0] * x + at[1] * y + at[2] * n).astype(np.float32).astype(np.float64)
    to_center = unit(center - place)
    across = unit(np.cross(to_center, x + 0.3 * y))
    return Lamp(name, rect, place, np.cos(tilt) * to_center + np.sin(tilt) * across)


def _lamps() -> list[Lamp]:
    def rect(center: list[float], x: list[float], y: list[float], sign: float = 1.0) -> Array:
        made = make_rect(np.array(center), np.array(x), np.array(y), sign)
        return made.astype(np.float32).astype(np.float64)

    square = rect([0, 0, 0], [1, 0, 0], [0, 1, 0])
    ceiling = rect([0, 0, 2], [2, 0, 0], [0, -1, 0])
    skewed = rect([0.3, 1, 0.5], [1, 0.1, -0.3], [0.9, 0.8, -0.2], -1.0)
    strip = rect([5, -3, 2], [0, 8, 0], [0.1, 0, 0.1])
    tiny = rect([1, 0, 0], [2e-4, 0, 1e-4], [0, 3e-4, 1e-4])
    huge = rect([0, 0, 4e4], [3e4, 1e4, 0], [0, 5e4, 0], -1.0)
    return [
        _lamp("one metre in front of a square", square, (0, 0, 1)),
        _lamp("below a ceiling lamp", ceiling, (0.2, -0.1, 2), 0.4),
        _lamp("beside a skewed lamp", skewed, (1.4, 0.6, 0.7), 0.2),
        _lamp("before a strip", strip, (0.1, 2, 4), 0.1),
        _lamp("before a tiny lamp", tiny, (1, -2, 1e-3), 0.1),
        _lamp("below a huge lamp", huge, (0.5, 0.2, 3e4), 0.1),
        _lamp("far from a square", square, (30, 10, 40), 1.2),
        _lamp("near a square", square, (0.05, 0.1, 0.35)),
        _lamp("in the corner of a square", square, (0.5, 0.5, 0.6)),
        _lamp("behind a square", square, (0.1, 0.2, -0.5)),
        _lamp("above a ceiling lamp", ceiling, (0.4, 0.4, -0.01)),
        _lamp("behind a skewed lamp", skewed, (0, 0, -1)),
    ]
