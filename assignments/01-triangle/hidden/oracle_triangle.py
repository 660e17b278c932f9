"""The oracle of ``triangle_intersect``: groups "edges", "random", "degenerate", "hostile".

*Independent.* It does not solve the 3x3 system as the module does. A weight is the ratio of two
signed volumes, those of the tetrahedra that the ray's direction spans with an edge of the
triangle; t is the ratio of two distances from the triangle's plane.

*Certain.* Float64 looks at every case. A result that it cannot clear of doubt is decided again
in exact rational arithmetic, so no failure is reported that exact arithmetic did not confirm.

*Fair.* triangle.h promises that within a tolerance of an edge, or of an end of the range, either
answer is right; triangle_bounds.py derives it. The numbers of the group "edges" are such that
every method is exact, so there hit or miss is not a matter of tolerance.

No case of "hostile" is judged. probe_triangle.c says how the files are laid out.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from random_triangle import degenerate_cases, hostile_cases, random_cases
from raybook_grader.cases import number, numbers, point, read_table, wrong_length
from raybook_grader.probes import Cases, Failure
from triangle_bounds import Array, Mask, solve, verdict

WORDS_IN, WORDS_OUT = 17, 5
WROTE_ON_MISS, CHANGED_RAY = 1, 2
EDGES = Path(__file__).with_name("edges_triangle.txt")
RANDOM_CASES, DEGENERATE_CASES, HOSTILE_CASES = 6000, 2000, 4000


@dataclass(frozen=True)
class Context:
    """The cases and what float64 knows of them; n cases, corners and weights along axis 1.

    ``may_hit``/``must_hit``: which answers are right, as far as float64 can tell. ``strict``:
    hit or miss is decided without a tolerance. ``hopeless``: rounding may have changed even the
    sign of the determinant, so that every answer is accepted. ``flat``: no area in any arithmetic.
    """

    p: Array
    origin: Array
    direction: Array
    t_min: Array
    t_max: Array
    t: Array
    b: Array
    t_error: Array
    b_error: Array
    may_hit: Mask
    must_hit: Mask
    strict: Mask
    hopeless: Mask
    flat: Mask
    label: list[str]


def make_cases(group: str, seed: int) -> Cases:
    """ "edges": hand-picked, whatever the seed. The others: the same for the same seed."""
    if group == "edges":
        words, label = _hand_picked()
        strict = True
    elif group == "random":
        words, label = random_cases(np.random.default_rng(seed), RANDOM_CASES)
        strict = False
    elif group == "degenerate":
        words, label = degenerate_cases(np.random.default_rng(seed), DEGENERATE_CASES)
        strict = False
    elif group == "hostile":
        words, label = hostile_cases(np.random.default_rng(seed), HOSTILE_CASES)
        strict = False
    else:
        raise ValueError(f"group {group!r}: there is none of that name")
    return Cases(words.tobytes(), len(label), _context(words, label, strict))


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Every wrong result, told in words."""
    if faults := wrong_length(output, 4 * WORDS_OUT, cases.count):
        return faults
    context: Context = cases.context
    words = np.frombuffer(output, "<u4").reshape(cases.count, WORDS_OUT)
    values = words.view("<f4")[:, 1:4].astype(np.float64)
    hit = words[:, 0] != 0
    flags = words[:, 4]
    failures = []
    for case in np.flatnonzero(_doubtful(context, hit, values) | (flags != 0)):
        failure = _failure(context, int(case), bool(hit[case]), values[case], int(flags[case]))
        if failure:
            failures.append(failure)
    return failures


# --- What float64 knows ---------------------------------------------------------------------


def _context(words: NDArray[np.float32], label: list[str], strict: bool) -> Context:
    wide = words.astype(np.float64)
    p, origin, d = wide[:, :9].reshape(-1, 3, 3), wide[:, 9:12], wide[:, 12:15]
    t_min, t_max = wide[:, 15], wide[:, 16]
    with np.errstate(all="ignore"):
        t, b, t_error, b_error, hopeless = solve(p, origin, d)
        flat = ~np.isfinite(p).all(axis=(1, 2)) | _equal_corners(p)
        may, must = verdict(t, b, t_error, b_error, t_min, t_max)
    everything = np.full(len(label), strict)
    may = ~flat & (may | hopeless)
    must = ~flat & must & ~hopeless
    return Context(
        p, origin, d, t_min, t_max, t, b, t_error, b_error, may, must, everything,
        hopeless & ~everything, flat, label,
    )  # fmt: skip


def _equal_corners(p: Array) -> Mask:
    """Two corners are the same: the area is 0 in every arithmetic, rounded or not."""
    same: Mask = (p == np.roll(p, 1, axis=1)).all(axis=2).any(axis=1)
    return same


def _doubtful(context: Context, hit: Mask, values: Array) -> Mask:
    """Results that float64 does not clear: a superset of the wrong ones.

    The margin of 1 % of the tolerance is above float64's own error: 2^-29 of it for t, and for the
    weights 2^-29 (reach / size) of it, where reach is the largest coordinate.
    """
    t, b1, b2 = values.T
    with np.errstate(invalid="ignore"):
        near = np.abs(t - context.t) <= 0.99 * context.t_error
        near &= np.abs(b1 - context.b[:, 1]) <= 0.99 * context.b_error[:, 1]
        near &= np.abs(b2 - context.b[:, 2]) <= 0.99 * context.b_error[:, 2]
        may, must = verdict(
            context.t, context.b, 0.99 * context.t_error, 0.99 * context.b_error,
            context.t_min, context.t_max,
        )  # fmt: skip
    certain_hit = hit & (may & near | context.hopeless & np.isfinite(values).all(axis=1))
    certain_miss = ~hit & (~must | context.flat | context.hopeless)
    doubtful: Mask = context.strict | context.flat & hit | ~(certain_hit | certain_miss)
    return doubtful


# --- What exact arithmetic decides -----------------------------------------------------------


@dataclass(frozen=True)
class Exact:
    t: Fraction
    b: tuple[Fraction, Fraction, Fraction]


Point = list[Fraction]


def _minus(a: Point, b: Point) -> Point:
    return [x - y for x, y in zip(a, b, strict=True)]


def _volume(a: Point, b: Point, c: Point) -> Fraction:
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def _exact(context: Context, case: int) -> Exact | None:
    """Where the line meets the plane; None when they are parallel or the area is 0."""
    p0, p1, p2 = ([Fraction(x) for x in corner] for corner in context.p[case])
    origin = [Fraction(x) for x in context.origin[case]]
    d = [Fraction(x) for x in context.direction[case]]
    to = [_minus(q, origin) for q in (p0, p1, p2)]
    volumes = [_volume(d, to[(i + 1) % 3], to[(i + 2) % 3]) for i in range(3)]
    whole = sum(volumes, Fraction(0))
    if whole == 0:
        return None
    e1, e2 = _minus(p1, p0), _minus(p2, p0)
    return Exact(
        _volume(to[0], e1, e2) / _volume(d, e1, e2),
        (volumes[0] / whole, volumes[1] / whole, volumes[2] / whole),
    )


def _allowed(context: Context, case: int, exact: Exact | None) -> tuple[bool, bool]:
    """(a hit may be reported, a hit must be reported)."""
    if context.flat[case]:
        return False, False
    if context.hopeless[case]:
        return True, False
    if exact is None:
        return not context.strict[case], False
    t_min, t_max = float(context.t_min[case]), float(context.t_max[case])
    if context.strict[case]:
        inside = min(exact.b) >= 0 and t_min <= exact.t <= t_max
        return inside, inside
    may, must = verdict(
        np.array([float(exact.t)]), np.array([[float(x) for x in exact.b]]),
        context.t_error[[case]], context.b_error[[case]], np.array([t_min]), np.array([t_max]),
    )  # fmt: skip
    return bool(may[0]), bool(must[0])


def _failure(context: Context, case: int, hit: bool, values: Array, flags: int) -> Failure | None:
    exact = None if context.flat[case] else _exact(context, case)
    may, must = _allowed(context, case, exact)
    wrong = _wrong(context, case, exact, may, must, hit, values, flags)
    if wrong is None:
        return None
    kind, sentence = wrong
    text = _geometry(context, case)
    return Failure(
        case,
        f"{context.label[case]}: {text}: {sentence}",
        f"{kind}: {context.label[case].split(':')[0]}",
        -float(len(text)),
    )


def _wrong(
    context: Context, case: int, exact: Exact | None, may: bool, must: bool,
    hit: bool, values: Array, flags: int,
) -> tuple[str, str] | None:  # fmt: skip
    """The kind of error and the words for it; None when the result is right."""
    got = f"got a hit at {_hit_text(*values)}" if hit else "got none"
    if must and not hit:
        return "missed", f"expected a hit at {_exact_text(exact)}, got none"
    if hit and not np.isfinite(values).all():
        return "not a number", f"expected {'a hit' if must else 'no hit'}, {got}"
    if hit and not may:
        return "false hit", f"expected no hit, {got}"
    if hit and exact and not context.hopeless[case]:
        error = np.abs(values - [float(exact.t), float(exact.b[1]), float(exact.b[2])])
        expected = f"expected a hit at {_exact_text(exact)}, {got}"
        if error[0] > context.t_error[case]:
            return "wrong t", expected
        if error[1] > context.b_error[case, 1] or error[2] > context.b_error[case, 2]:
            return "wrong weights", expected
    if flags & CHANGED_RAY:
        return "changed the ray", "expected the ray as it was before the call"
    if flags & WROTE_ON_MISS:
        return (
            "wrote on a miss",
            "expected *hit as it was before the call, because it returned false",
        )
    return None


# --- Words -----------------------------------------------------------------------------------


def _geometry(context: Context, case: int) -> str:
    corners = " ".join(point(q) for q in context.p[case])
    return (
        f"ray from {point(context.origin[case])} along {point(context.direction[case])}, "
        f"t in [{number(context.t_min[case])}, {number(context.t_max[case])}], "
        f"triangle {corners}"
    )


def _hit_text(t: float, b1: float, b2: float) -> str:
    return f"t = {number(t)}, b1 = {number(b1)}, b2 = {number(b2)}"


def _exact_text(exact: Exact | None) -> str:
    if exact is None:
        return "no finite t"
    return _hit_text(float(exact.t), float(exact.b[1]), float(exact.b[2]))


# --- Cases -----------------------------------------------------------------------------------


def _hand_picked() -> tuple[NDArray[np.float32], list[str]]:
    """Each line of edges_triangle.txt three times: as it stands, and with its axes moved on."""
    rows, label = [], []
    for turn in range(3):
        for _, kind, corners, origin, direction, ends, name in read_table(EDGES):
            points = [*corners.split(","), origin, direction]
            rows.append(np.concatenate([*(numbers(q, turn) for q in points), numbers(ends)]))
            label.append(f"{kind}: {name}")
    return np.array(rows).astype("<f4"), label
