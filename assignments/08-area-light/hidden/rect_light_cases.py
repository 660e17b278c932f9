"""The cases of oracle_rect_light.py: hand-picked ones and random ones, as float64 records.

probe_rect_light.c says what their columns are.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from raybook_grader.cases import read_table
from rect_light_words import Array, unit

RANDOM_CASES = 4000


def picked(group: str) -> tuple[Array, list[str]]:
    """Each line of the table with its axes moved on, at the origin and beside it, in three
    sizes; powers of two, which change no digit."""
    rows, label = [], []
    for turn in range(3):
        for place, size in ((0.0, 1.0), (1.0, 1.0), (0.0, 2.0**-12), (0.0, 2.0**12)):
            for _, away, axis, area, name in read_table(
                Path(__file__).with_name("edges_density.txt")
            ):
                to_point = size * np.roll(np.array(away.split(), np.float64), turn)
                if place and np.abs(to_point).max() < 1.0:
                    continue  # it would lose digits there
                normal = np.roll(np.array(axis.split(), np.float64), turn)
                on_light = np.full(3, place)
                if group == "density":
                    around = np.concatenate([on_light + to_point, on_light, normal])
                    rows.append(np.append(around, float(area) * size**2))
                elif to_point.any():
                    rows.append(np.concatenate([[3.0, 2.0, 0.5], normal, to_point]))
                else:
                    continue  # outgoing has a direction
                label.append(name)
    return np.array(rows), label


def _directions(rng: np.random.Generator, n: int) -> tuple[Array, Array, NDArray[np.str_]]:
    """Normals, unit directions at all angles to them, and what they are called."""
    kind = rng.choice(
        ["in front", "grazing", "behind", "grazing from behind"], n, p=(0.5, 0.2, 0.2, 0.1)
    )
    steep = rng.uniform(0.05, 1.0, n)
    low = 10 ** rng.uniform(-5.0, -1.3, n)
    cosine = np.where(np.char.startswith(kind, "grazing"), low, steep)
    cosine = np.where(np.isin(kind, ["behind", "grazing from behind"]), -cosine, cosine)
    normal = unit(rng.normal(size=(n, 3))).astype(np.float32).astype(np.float64)
    along = unit(np.cross(normal, rng.normal(size=(n, 3))))
    return normal, cosine[:, None] * normal + np.sqrt(1 - cosine**2)[:, None] * along, kind


def random_cases(rng: np.random.Generator, group: str) -> tuple[Array, list[str]]:
    """Lengths from 1e-6 to 1e6, areas from 1e-12 to 1e12."""
    n = RANDOM_CASES
    normal, direction, kind = _directions(rng, n)
    length = 10 ** rng.uniform(-6, 6, (n, 1))
    if group == "emitted":
        radiance = 10 ** rng.uniform(-3, 5, (n, 3)) * (rng.random((n, 3)) < 0.9)
        return np.concatenate([radiance, normal, length * direction], axis=1), list(kind)
    away = np.minimum(length * 10 ** rng.uniform(-1, 3.5, (n, 1)), 1e6) * rng.integers(0, 2, (n, 1))
    on_light = away * unit(rng.normal(size=(n, 3)))
    area = 10 ** rng.uniform(-12, 12, (n, 1))
    # Rounded as the module gets it: the density is to a place that is given exactly.
    on_light = on_light.astype(np.float32).astype(np.float64)
    point = on_light + length * direction
    far = np.where(length[:, 0] > 1e3, ", far away", np.where(length[:, 0] < 1e-3, ", near", ""))
    label = [f"{k}{f}" for k, f in zip(kind, far, strict=True)]
    return np.concatenate([point, on_light, normal, area], axis=1), label


def _frames(rng: np.random.Generator, n: int) -> tuple[Array, Array]:
    """The two sides of n rectangles: right-angled, skewed by up to 75 degrees, long and thin."""
    basis = np.linalg.qr(rng.normal(size=(n, 3, 3)))[0]
    skew = np.where(rng.random(n) < 0.4, 0.0, rng.uniform(-1.3, 1.3, n))
    side_x = basis[:, 0] * 10 ** rng.uniform(-1, 1, (n, 1))
    turned = np.sin(skew)[:, None] * basis[:, 0] + np.cos(skew)[:, None] * basis[:, 1]
    return side_x, turned * 10 ** rng.uniform(-1, 1, (n, 1))


def _place_cases(
    rng: np.random.Generator, center: Array, sides: tuple[Array, Array], numbers: Array
) -> Array:
    """Input records of group "places"; the point and the radiance do not matter there."""
    normal = np.cross(*sides)
    area = np.linalg.norm(normal, axis=1, keepdims=True)
    normal = normal / area * rng.choice([-1.0, 1.0], (len(center), 1))
    in_front = center + normal * np.sqrt(area)
    return np.concatenate(
        [center, *sides, normal, area, numbers, in_front, np.ones_like(center)], axis=1
    )


def picked_places(rng: np.random.Generator) -> tuple[Array, list[str]]:
    """The ends and the middle of the random numbers' range, on six rectangles."""
    ends = np.array([0.0, 2.0**-24, 0.25, 0.5, 0.75, 1.0 - 2.0**-24])
    numbers = np.stack(np.meshgrid(ends, ends), axis=-1).reshape(-1, 2)
    sides = [([2, 0, 0], [0, 1, 0]), ([0, 0, 4], [0, 1, 0]), ([1, 0, 0], [1, 1, 0])]
    centers = [[0, 0, 0], [1, 2, 3]]
    rows = [(c, *s, n) for c in centers for s in sides for n in numbers]
    center, x, y, chosen = (np.array([row[i] for row in rows], np.float64) for i in range(4))
    return _place_cases(rng, center, (x, y), chosen), ["range's ends"] * len(rows)


def random_places(rng: np.random.Generator) -> tuple[Array, list[str]]:
    n = RANDOM_CASES
    size = 10 ** rng.uniform(-5, 5, (n, 1))
    side_x, side_y = _frames(rng, n)
    center = unit(rng.normal(size=(n, 3))) * np.minimum(
        size * 10 ** rng.uniform(-1, 3, (n, 1)), 1e6
    )
    words = _place_cases(rng, center, (size * side_x, size * side_y), rng.random((n, 2)))
    skewed = np.abs(np.sum(unit(side_x) * unit(side_y), axis=1)) > 0.01
    label = ["skewed sides" if s else "sides at right angles" for s in skewed]
    # A number just below 1 must not become 1 in single precision.
    words[:, 13:15] = np.minimum(words[:, 13:15], 1.0 - 2.0**-24)
    return words, label


def wild(rng: np.random.Generator) -> Array:
    """Records of numbers that no rectangle should have; random numbers stay in [0, 1)."""
    strange = [0.0, -0.0, 1.0, -1.0, 1e-38, 1e-45, 3e38, -3e38, np.inf, -np.inf, np.nan]
    words: Array = np.where(
        rng.random((RANDOM_CASES, 21)) < 0.3,
        rng.choice(strange, (RANDOM_CASES, 21)),
        rng.normal(size=(RANDOM_CASES, 21)),
    )
    words[:, 13:15] = np.minimum(rng.random((RANDOM_CASES, 2)), 1.0 - 2.0**-24)
    return words
