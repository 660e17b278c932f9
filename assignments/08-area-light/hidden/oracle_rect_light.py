"""The oracle of the three functions of rect_light.h: groups "places", "density" and "emitted";
and "wild", whose answers are nobody's business: zeros, infinities and NaN where they come.

*Independent.* A place is turned back into coordinates along the two sides, whatever way a module
came to it. A density is checked by the solid angle of a patch, in double precision.

*Fair.* rect_light.h promises 1e-4 of a value, and that within 1e-6 radians of the surface either
side's answer will do. The cosine of an angle comes from three products of rounded numbers: its
error is below ROUNDINGS u, with u = 2^-24, in whatever order (Higham, "Accuracy and Stability of
Numerical Algorithms", 2nd ed., section 3.1), so a density may be off by that over the cosine. A
place is a sum of at most six rounded terms; the contract allows 1e-6 of their sizes, 16 u.

probe_rect_light.c says how the files are laid out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from raybook_grader.cases import number, point, wrong_length
from raybook_grader.probes import Cases, Failure
from rect_light_cases import RANDOM_CASES, picked, picked_places, random_cases, random_places, wild
from rect_light_words import Array, rect_text

UNIT = 2.0**-24
ROUNDINGS = 12
PROMISED = 1e-4
UNDECIDED = 2e-6  # the contract's 1e-6 radians, and the rounding of the cosine
OTHER_PLACE = 1
WORDS = {"places": (21, 8), "density": (10, 1), "emitted": (9, 3), "wild": (21, 8)}


@dataclass(frozen=True)
class Context:
    """The cases as float64; ``exact`` marks those whose cosine every method has exactly."""

    group: str
    words: Array
    exact: NDArray[np.bool_]
    label: list[str]


def make_cases(group: str, seed: int) -> Cases:
    """Hand-picked cases, then random ones, the same for the same seed."""
    if group not in WORDS:
        raise ValueError(f"group {group!r}, expected one of {', '.join(WORDS)}")
    rng = np.random.default_rng(seed)
    if group == "wild":
        words, label, exact = wild(rng), ["wild"] * RANDOM_CASES, 0
    else:
        by_hand, names = picked_places(rng) if group == "places" else picked(group)
        chosen, kinds = random_places(rng) if group == "places" else random_cases(rng, group)
        words, label, exact = np.concatenate([by_hand, chosen]), names + kinds, len(by_hand)
    given = words.astype("<f4")
    context = Context(group, given.astype(np.float64), np.arange(len(given)) < exact, label)
    return Cases(given.tobytes(), len(given), context)


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Every wrong result, told in words."""
    context: Context = cases.context
    width = WORDS[context.group][1]
    faults = wrong_length(output, 4 * width, cases.count)
    if faults or context.group == "wild":
        return faults
    words = np.frombuffer(output, "<u4").reshape(cases.count, width)
    values = words.view("<f4").astype(np.float64)
    if context.group == "places":
        return _judge_places(context, values, words[:, 7])
    if context.group == "density":
        return _judge_density(context, values[:, 0])
    return _judge_emitted(context, values)


def _failure(context: Context, case: int, kind: str, given: str, sentence: str) -> Failure:
    label = context.label[case]
    return Failure(
        case, f"{label}: {given}: {sentence}", f"{kind}: {label.split(':')[0]}", -float(len(given))
    )


# --- Places -----------------------------------------------------------------------------------


def _outside(rects: Array, places: Array) -> tuple[Array, Array]:
    """How far each place is off its rectangle, and how far rounding may have moved it."""
    center, side_x, side_y = rects[:, 0:3], rects[:, 3:6], rects[:, 6:9]
    normal = np.cross(side_x, side_y)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    basis = np.stack([side_x, side_y, normal], axis=2)
    x, y, height = np.linalg.solve(basis, (places - center)[..., None])[..., 0].T
    beyond_x = np.maximum(np.abs(x) - 0.5, 0.0)[:, None] * side_x
    beyond_y = np.maximum(np.abs(y) - 0.5, 0.0)[:, None] * side_y
    off = np.linalg.norm(beyond_x, axis=1) + np.linalg.norm(beyond_y, axis=1) + np.abs(height)
    lengths = np.linalg.norm(side_x, axis=1), np.linalg.norm(side_y, axis=1)
    sine = np.linalg.norm(np.cross(side_x, side_y), axis=1) / (lengths[0] * lengths[1])
    size = np.linalg.norm(center, axis=1) + lengths[0] + lengths[1]
    return off, 1e-6 * size * (1.0 + 2.0 / sine)


def _judge_places(context: Context, values: Array, flags: NDArray[np.uint32]) -> list[Failure]:
    finite = np.atleast_1d(np.isfinite(values[:, :3]).all(axis=1))
    off, allowed = _outside(context.words, np.where(finite[:, None], values[:, :3], 0.0))
    bad = ~finite | (off > allowed) | (flags != 0)
    failures = []
    for case in np.flatnonzero(bad):
        words = context.words[case]
        given = f"{rect_text(words)}, random {point(words[13:15])}"
        got = f"got {point(values[case, :3])}"
        if not finite[case]:
            kind, sentence = "not a number", f"expected a place on it, {got}"
        elif off[case] > allowed[case]:
            kind = "off the rectangle"
            sentence = f"expected a place on it, {got}, which is {number(off[case])} off it"
        else:
            kind = "another place"
            sentence = f"{got}, and at the next call with the same numbers another place"
        failures.append(_failure(context, int(case), kind, given, sentence))
    return failures


# --- Density ----------------------------------------------------------------------------------


def _judge_density(context: Context, values: Array) -> list[Failure]:
    to_point, normal, area = (
        context.words[:, 0:3] - context.words[:, 3:6], context.words[:, 6:9], context.words[:, 9],
    )  # fmt: skip
    distance = np.linalg.norm(to_point, axis=1)
    with np.errstate(all="ignore"):
        cosine = np.sum(to_point * normal, axis=1) / distance
        expected = np.where(cosine > 0.0, distance**2 / (cosine * area), 0.0)
        error = PROMISED + ROUNDINGS * UNIT / np.abs(cosine)
        good = np.abs(values - expected) <= error * expected
        good = np.where(expected == 0.0, values == 0.0, good)
        undecided = ~context.exact & (np.abs(cosine) < UNDECIDED)
        good = np.where(undecided, np.isfinite(values) & (values >= 0.0), good)
    failures = []
    for case in np.flatnonzero(~good):
        words = context.words[case]
        given = (
            f"point {point(words[0:3])}, on_light {point(words[3:6])}, normal "
            f"{point(words[6:9])}, area {number(words[9])}"
        )
        kind = "light from behind" if expected[case] == 0.0 else "wrong density"
        sentence = f"expected {number(expected[case])} per steradian, got {number(values[case])}"
        failures.append(_failure(context, int(case), kind, given, sentence))
    return failures


# --- Emission ---------------------------------------------------------------------------------


def _judge_emitted(context: Context, values: Array) -> list[Failure]:
    radiance, normal, outgoing = (context.words[:, i : i + 3] for i in (0, 3, 6))
    with np.errstate(all="ignore"):
        cosine = np.sum(normal * outgoing, axis=1) / np.linalg.norm(outgoing, axis=1)
    shines = np.atleast_1d(cosine > 0.0)
    expected = np.where(shines[:, None], radiance, 0.0)
    full = (np.abs(values - radiance) <= 1e-6 * radiance).all(axis=1)
    black = (values == 0.0).all(axis=1)
    undecided = ~context.exact & (np.abs(cosine) < UNDECIDED)
    good = np.where(undecided, full | black, np.where(shines, full, black))
    failures = []
    for case in np.flatnonzero(~good):
        given = (
            f"radiance {point(radiance[case])}, normal {point(normal[case])}, outgoing "
            f"{point(outgoing[case])}"
        )
        kind = "wrong radiance" if shines[case] else "light from the back"
        sentence = f"expected {point(expected[case])}, got {point(values[case])}"
        failures.append(_failure(context, int(case), kind, given, sentence))
    return failures
