"""The oracle of ``mipmap_level`` and ``mipmap_trilinear``: groups "level", "trilinear" and
"hostile" (whose answers nobody judges: it is what the sanitizers watch).

Everything is computed again in float64. The levels of these mipmaps are no means of each other but
random, so that a lookup in a wrong level shows.

Tolerances: the level 0.01, as the contract says. A colour 0.01 of the largest texel, as the
contract says, and 0.001 more for a coordinate that was multiplied by the level's size in single
precision: |uv| <= 4 and 512 texels make at most 2^-13 of a texel, which is as much of the
difference between two texels.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from mipmap_cases import (
    BLACK,
    CLAMP,
    MIRROR,
    REPEAT,
    Array,
    Mipmap,
    about,
    bilinear,
    half,
    number,
    packed,
    single,
    tuple_of,
    wrong_length,
)
from raybook_grader.probes import Cases, Failure

LEVEL_TOLERANCE = 0.01
COLOR_TOLERANCE = 0.011
LEVEL_CASES, TRILINEAR_CASES = 3000, 3000
ANISOTROPY = 8.0


@dataclass(frozen=True)
class Lookup:
    kind: str
    mipmap: int
    uv: Array
    uv_dx: Array
    uv_dy: Array


@dataclass(frozen=True)
class Context:
    group: str
    mipmaps: list[Mipmap]
    lookups: list[Lookup]


def make_cases(group: str, seed: int) -> Cases:
    """The same for the same seed."""
    if group not in _GROUPS:
        raise ValueError(f"group {group!r}, expected one of {', '.join(_GROUPS)}")
    rng = np.random.default_rng(seed)
    mipmaps, lookups = _GROUPS[group](rng)
    rows = [(i.mipmap, [*i.uv, *i.uv_dx, *i.uv_dy, ANISOTROPY]) for i in lookups]
    return Cases(packed(mipmaps, rows), len(rows), Context(group, mipmaps, lookups))


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Every wrong result, told in words."""
    context: Context = cases.context
    words = {"level": 1, "trilinear": 3, "hostile": 7}[context.group]
    if faults := wrong_length(output, 4 * words * cases.count):
        return faults
    if context.group == "hostile":
        return []
    found = np.frombuffer(output, "<f4").astype(np.float64).reshape(cases.count, words)
    wrong = _wrong_level if context.group == "level" else _wrong_color
    failures = []
    for case, lookup in enumerate(context.lookups):
        m = context.mipmaps[lookup.mipmap]
        if sentence := wrong(m, lookup, found[case]):
            text = _told(m, lookup, context.group)
            message = f"{lookup.kind}: {text}: {sentence}"
            failures.append(Failure(case, message, lookup.kind, -float(len(text))))
    return failures


# --- What is right ----------------------------------------------------------------------------


def finite(step: Array) -> Array:
    """A step; no step where it is not finite."""
    return step if np.isfinite(step).all() else np.zeros(2)


def level_of(m: Mipmap, uv_dx: Array, uv_dy: Array) -> float:
    sides = [np.hypot(*(finite(step) * m.size)) for step in (uv_dx, uv_dy)]
    return float(np.clip(np.log2(max(*sides, 1.0)), 0, len(m.levels) - 1))


def trilinear(m: Mipmap, uv: Array, level: float) -> Array:
    place = np.where(np.isfinite(uv), uv, 0.0)
    fine = int(level)
    coarse = min(fine + 1, len(m.levels) - 1)
    part = level - fine
    return (1 - part) * bilinear(m, fine, place) + part * bilinear(m, coarse, place)


def _wrong_level(m: Mipmap, lookup: Lookup, found: Array) -> str:
    level = level_of(m, lookup.uv_dx, lookup.uv_dy)
    good = abs(found[0] - level) <= LEVEL_TOLERANCE
    return "" if good else f"expected level {level:.4g}, got {number(found[0])}"


def _wrong_color(m: Mipmap, lookup: Lookup, found: Array) -> str:
    level = level_of(m, lookup.uv_dx, lookup.uv_dy)
    color = trilinear(m, lookup.uv, level)
    largest = max(float(np.abs(image).max()) for image in m.levels)
    with np.errstate(invalid="ignore"):
        good = (np.abs(found - color) <= COLOR_TOLERANCE * largest).all()
    return "" if good else f"at level {level:.4g} expected {about(color)}, got {tuple_of(found)}"


def _told(m: Mipmap, lookup: Lookup, group: str) -> str:
    steps = f"uv_dx = {tuple_of(lookup.uv_dx)}, uv_dy = {tuple_of(lookup.uv_dy)}"
    where = "" if group == "level" else f"uv = {tuple_of(lookup.uv)}, "
    return f"{m}, {where}{steps}"


# --- Cases ------------------------------------------------------------------------------------


def _sizes_of(width: int, height: int) -> Iterator[tuple[int, int]]:
    yield width, height
    while (width, height) != (1, 1):
        width, height = half(width), half(height)
        yield width, height


def _random_levels(
    rng: np.random.Generator,
    name: str,
    wrap: int,
    size: tuple[int, int],
    most: int = 32,
) -> Mipmap:
    """A mipmap whose levels have nothing to do with each other."""
    sizes = list(_sizes_of(*size))[:most]
    return Mipmap(name, wrap, tuple(single(rng.random((h, w, 3))) for w, h in sizes))


Made = tuple[list[Mipmap], list[Lookup]]
ZERO = np.zeros(2)


def _steps_in_texels(rng: np.random.Generator, kind: str, top: float) -> tuple[Array, Array]:
    """Two steps in texels, by what the kind says, mostly up to 2^top long."""
    angle, other = rng.uniform(0, 2 * np.pi, 2)
    length, ratio = 2 ** rng.uniform(0.1, max(top, 0.2)), 2 ** -rng.uniform(1, 5)
    a = np.array([np.cos(angle), np.sin(angle)])
    b = np.array([-a[1], a[0]])
    c = np.array([np.cos(other), np.sin(other)])
    return {
        "a square footprint": (length * a, length * b),
        "uv_dx is the longer side": (length * a, length * ratio * c),
        "uv_dy is the longer side": (length * ratio * c, length * a),
        "along the axes": (np.array([length, 0]), np.array([0, length * ratio])),
        "axes exchanged": (np.array([0, length * ratio]), np.array([length, 0])),
        "no uv_dy": (length * a, ZERO),
        "no uv_dx": (ZERO, length * a),
        "magnified": (ratio * a, ratio * ratio * c),
        "far away": (2.0 ** (top + rng.uniform(0, 8)) * a, c),
    }[kind]


_KINDS = (
    "a square footprint",
    "uv_dx is the longer side",
    "uv_dy is the longer side",
    "along the axes",
    "axes exchanged",
    "no uv_dy",
    "no uv_dx",
    "magnified",
    "far away",
)
_SHAPES = [(64, 64), (128, 8), (8, 128), (1, 1), (3, 5), (100, 75), (256, 2), (1, 64)]


def _regular(
    rng: np.random.Generator, mipmaps: Sequence[Mipmap], n: int
) -> Iterator[tuple[str, int, Array, Array]]:
    for i in range(n):
        index, kind = int(rng.integers(len(mipmaps))), _KINDS[i % len(_KINDS)]
        m = mipmaps[index]
        dx, dy = _steps_in_texels(rng, kind, np.log2(m.size.max()))
        yield kind, index, single(dx / m.size), single(dy / m.size)


def _level_cases(rng: np.random.Generator) -> Made:
    mipmaps = [_random_levels(rng, "mipmap", REPEAT, size) for size in _SHAPES]
    mipmaps.append(_random_levels(rng, "one level", REPEAT, (64, 64), 1))
    lookups = [Lookup(k, i, ZERO, dx, dy) for k, i, dx, dy in _regular(rng, mipmaps, LEVEL_CASES)]
    for index in range(len(mipmaps)):
        lookups += [Lookup(k, index, ZERO, dx, dy) for k, dx, dy in _edge_steps()]
    return mipmaps, lookups


def _edge_steps() -> Iterator[tuple[str, Array, Array]]:
    """Steps in texture coordinates."""
    quarter, eighth = np.array([0.25, 0.0]), np.array([0.0, 0.125])
    yield "no footprint", ZERO, ZERO
    yield "whole numbers", quarter, eighth
    yield "whole numbers", eighth, quarter
    yield "negative steps", -quarter, -eighth
    yield "negative steps", eighth, -quarter
    for size in (1e-30, 1e-10):
        yield "a tiny footprint", size * quarter, size * eighth
    for size in (1e3, 1e10, 1e30):
        yield "an enormous footprint", single(size * quarter), single(size * eighth)
        yield "an enormous footprint", single(size * eighth), single(size * quarter)
    for bad in (np.nan, np.inf, -np.inf):
        for broken in (np.array([bad, 0.1]), np.array([0.1, bad])):
            yield "a step that is not finite", single(broken), eighth
            yield "a step that is not finite", quarter, single(broken)
            yield "a step that is not finite", single(broken), single(broken)


def _random_uv(rng: np.random.Generator, m: Mipmap) -> Array:
    """Inside; across the border; on texels' middles and borders."""
    uv = rng.uniform(0, 1, 2)
    kind = rng.integers(4)
    if kind == 1:
        uv = rng.uniform(-3, 4, 2)
    elif kind == 2:
        uv = rng.integers(-1, 3, 2) + rng.uniform(-1, 1, 2) / m.size
    elif kind == 3:
        uv = rng.integers(0, 2 * m.size + 1) / (2 * m.size)
    return single(uv)


def _trilinear_cases(rng: np.random.Generator) -> Made:
    sizes = [(16, 16), (32, 8), (8, 32), (1, 1), (3, 5), (25, 18), (64, 64), (1, 16)]
    mipmaps = [
        _random_levels(rng, "mipmap", wrap, size)
        for size in sizes
        for wrap in (REPEAT, CLAMP, MIRROR, BLACK)
    ]
    mipmaps.append(_random_levels(rng, "one level", CLAMP, (16, 16), 1))
    lookups = [
        Lookup(f"{kind}, {_wrap_word(mipmaps[index])}", index,
               _random_uv(rng, mipmaps[index]), dx, dy)
        for kind, index, dx, dy in _regular(rng, mipmaps, TRILINEAR_CASES)
    ]  # fmt: skip
    middle = np.array([0.5, 0.5])
    for index in (0, 4, 12, len(mipmaps) - 1):
        lookups += [Lookup(k, index, middle, dx, dy) for k, dx, dy in _edge_steps()]
        for bad in (np.nan, np.inf):
            for uv in (np.array([bad, 0.3]), np.array([0.3, -bad])):
                step = np.array([0.1, 0.0])
                lookups.append(Lookup("uv is not finite", index, single(uv), step, ZERO))
    return mipmaps, lookups


def _wrap_word(m: Mipmap) -> str:
    return ("repeated", "clamped", "mirrored", "black beside the image")[m.wrap]


def _hostile_cases(rng: np.random.Generator) -> Made:
    """All wraps and odd sizes; coordinates and steps that are huge, or no numbers."""
    sizes = [(1, 1), (1, 5), (7, 1), (3, 3), (5, 9), (16, 16), (31, 2), (64, 48)]
    mipmaps = [
        Mipmap("mipmap", wrap, (single(rng.random((h, w, 3))),))
        for w, h in sizes
        for wrap in (REPEAT, CLAMP, MIRROR, BLACK)
    ]
    strange = np.array([0, -0.0, 1, -1, 1e-38, 1e-7, 1e3, -1e6, 1e9, -1e20, 1e38, np.nan, np.inf])
    lookups = []
    for index, m in enumerate(mipmaps):
        for _ in range(40):
            values = rng.uniform(-2, 2, 6) * np.repeat([1, 1 / m.size.max(), 1 / m.size.min()], 2)
            bad = rng.random(6) < 0.3
            values[bad] = rng.choice(strange, bad.sum())
            values = single(values)
            lookups.append(Lookup("hostile", index, values[:2], values[2:4], values[4:]))
    return mipmaps, lookups


_GROUPS: dict[str, Callable[[np.random.Generator], Made]] = {
    "level": _level_cases,
    "trilinear": _trilinear_cases,
    "hostile": _hostile_cases,
}
