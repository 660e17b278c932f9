"""The oracle of ``aabb_intersect``: groups "edges", "random", "short ways" and "hostile".

*Certain.* Float64 looks at every case. A result that it cannot clear of doubt is decided again
in exact rational arithmetic, so no failure is reported that exact arithmetic did not confirm.

*Fair.* With [n, f] the exact range of t in the slab of an axis, the ray is in the box from
``enter``, the largest of t_min and the n, to ``leave``, the least of t_max and the f. aabb.h
promises 1e-5, relative, for both, and that within that of a hit or a miss either answer is right:

    a hit is right if   enter - leave <= 1e-5 (|enter| + |leave|),
    a miss is right if  some n >= f of another axis,
                        or an n >= t_max (1 - 1e-5), or an f <= t_min (1 + 1e-5).

So a box that the ray crosses is never missed, however short the way; that a ray along an edge
(n = f) may be is the doubt that the contract leaves. A zero component gives the whole line or
nothing, and no doubt. A method in single precision commits three roundings in each t and one
more for a safety margin, 4e-7 in all: 1e-5 leaves room. The numbers of the group "edges" are such
that every method is exact, so there touching is a hit.

No case of "hostile" is judged. probe_aabb.c says how the files are laid out.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from random_aabb import hostile_cases, random_cases, short_ways
from raybook_grader.cases import number, numbers, point, read_table, wrong_length
from raybook_grader.probes import Cases, Failure

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

WORDS_IN, WORDS_OUT = 14, 4
CHANGED_INPUT, NOT_WRITTEN = 1, 2
EDGES = Path(__file__).with_name("edges_aabb.txt")
RANDOM_CASES, SHORT_WAYS, HOSTILE_CASES = 8000, 4000, 4000
PROMISED = 1e-5
CLEAR = 0.99
"""Float64's own error is below 1e-15: what is within this part of a tolerance is within it."""


@dataclass(frozen=True)
class Context:
    """The cases, and what float64 knows of them; x y z along axis 1.

    ``may_hit`` is false, and ``must_hit`` is true, where there may be a doubt.
    """

    lower: Array
    upper: Array
    origin: Array
    direction: Array
    t_min: Array
    t_max: Array
    enter: Array
    leave: Array
    may_hit: Mask
    must_hit: Mask
    strict: bool
    label: list[str]


def make_cases(group: str, seed: int) -> Cases:
    """ "edges": hand-picked, whatever the seed. The others: the same for the same seed."""
    rng = np.random.default_rng(seed)
    if group == "edges":
        words, label = _hand_picked()
    elif group == "random":
        words, label = random_cases(rng, RANDOM_CASES)
    elif group == "short ways":
        words, label = short_ways(rng, SHORT_WAYS)
    elif group == "hostile":
        words, label = hostile_cases(rng, HOSTILE_CASES)
    else:
        raise ValueError(f"group {group!r}: there is none of that name")
    return Cases(words.tobytes(), len(label), _context(words, label, group == "edges"))


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Every wrong result, told in words."""
    if faults := wrong_length(output, 4 * WORDS_OUT, cases.count):
        return faults
    context: Context = cases.context
    words = np.frombuffer(output, "<u4").reshape(cases.count, WORDS_OUT)
    values = words.view("<f4")[:, 1:3].astype(np.float64)
    hit, flags = words[:, 0] != 0, words[:, 3]
    failures = []
    for case in np.flatnonzero(_doubtful(context, hit, values) | (flags != 0)):
        failure = _failure(context, int(case), bool(hit[case]), values[case], int(flags[case]))
        if failure:
            failures.append(failure)
    return failures


# --- What float64 knows ---------------------------------------------------------------------


def _context(words: NDArray[np.float32], label: list[str], strict: bool) -> Context:
    wide = words.astype(np.float64)
    lower, upper, origin, d = wide[:, 0:3], wide[:, 3:6], wide[:, 6:9], wide[:, 9:12]
    t_min, t_max = wide[:, 12], wide[:, 13]
    with np.errstate(all="ignore"):
        a, b = (lower - origin) / d, (upper - origin) / d
        between = (lower <= origin) & (origin <= upper)
        near = np.where(d == 0, np.where(between, -np.inf, np.inf), np.minimum(a, b))
        far = np.where(d == 0, np.where(between, np.inf, -np.inf), np.maximum(a, b))
        enter = np.maximum(t_min, near.max(axis=1))
        leave = np.minimum(t_max, far.min(axis=1))
        holds_a_point = (lower <= upper).all(axis=1)
        slack = CLEAR * PROMISED * (np.abs(enter) + np.abs(leave))
        may = holds_a_point & ((enter <= leave) | (enter - leave <= slack))
        must = holds_a_point & (near.max(axis=1) <= far.min(axis=1) + 1e-12 * np.abs(enter))
        must &= (near.max(axis=1) < t_max) & (far.min(axis=1) > t_min)
    return Context(lower, upper, origin, d, t_min, t_max, enter, leave, may, must, strict, label)


def _doubtful(context: Context, hit: Mask, values: Array) -> Mask:
    """Results that float64 does not clear: a superset of the wrong ones."""
    if context.strict:
        return np.ones(len(hit), np.bool_)
    tolerance = CLEAR * PROMISED
    with np.errstate(invalid="ignore"):
        near = np.abs(values[:, 0] - context.enter) <= tolerance * np.abs(context.enter)
        near &= (np.abs(values[:, 1] - context.leave) <= tolerance * np.abs(context.leave)) | (
            values[:, 1] == context.leave
        )
        near &= _in_order(context, values)
    doubtful: Mask = np.where(hit, ~(context.may_hit & near), context.must_hit)
    return doubtful


def _in_order(context: Context, values: Array) -> Mask:
    enter, leave = values.T
    right: Mask = (context.t_min <= enter) & (enter <= leave) & (leave <= context.t_max)
    return right


# --- What exact arithmetic decides -----------------------------------------------------------


@dataclass(frozen=True)
class Exact:
    """The ray's way through the box; ``near`` and ``far`` are of the axes that have planes."""

    near: list[Fraction]
    far: list[Fraction]

    def ends(self, t_min: float, t_max: float) -> tuple[Fraction, Fraction | None]:
        """Entry and exit; an exit of None is at infinity."""
        first = Fraction(t_min)
        last = self.far if t_max == np.inf else [*self.far, Fraction(t_max)]
        return max([first, *self.near]), min(last) if last else None


def _exact(context: Context, case: int) -> Exact | None:
    """None if the box is empty, or the ray runs along a slab and outside of it."""
    near, far = [], []
    for lower, upper, origin, d in zip(
        context.lower[case], context.upper[case], context.origin[case], context.direction[case],
        strict=True,
    ):  # fmt: skip
        if not lower <= upper or (d == 0 and not lower <= origin <= upper):
            return None
        if d != 0:
            o = Fraction(origin)
            ends = [(Fraction(lower) - o) / Fraction(d), (Fraction(upper) - o) / Fraction(d)]
            near.append(min(ends))
            far.append(max(ends))
    return Exact(near, far)


def _allowed(context: Context, case: int, exact: Exact | None) -> tuple[bool, bool]:
    """(a hit may be reported, a hit must be reported)."""
    if exact is None:
        return False, False
    t_min, t_max = float(context.t_min[case]), float(context.t_max[case])
    enter, leave = exact.ends(t_min, t_max)
    if leave is None:
        return True, True
    if context.strict:
        return enter <= leave, enter <= leave
    promised = Fraction(PROMISED)
    may = enter - leave <= promised * (abs(enter) + abs(leave))
    must = all(
        near < far for i, near in enumerate(exact.near) for j, far in enumerate(exact.far) if i != j
    )
    must &= min(exact.far) > Fraction(t_min) * (1 + promised)
    if t_max != np.inf:
        must &= max(exact.near) < Fraction(t_max) * (1 - promised)
    return may, must


def _failure(context: Context, case: int, hit: bool, values: Array, flags: int) -> Failure | None:
    exact = _exact(context, case)
    wrong = _wrong(context, case, exact, hit, values, flags)
    if wrong is None:
        return None
    kind, sentence = wrong
    text = _geometry(context, case)
    name = context.label[case]
    return Failure(
        case, f"{name}: {text}: {sentence}", f"{kind}: {name.split(':')[0]}", -float(len(text))
    )


def _wrong(
    context: Context, case: int, exact: Exact | None, hit: bool, values: Array, flags: int
) -> tuple[str, str] | None:
    """The kind of error and the words for it; None when the result is right."""
    may, must = _allowed(context, case, exact)
    got = f"got a hit from t = {number(values[0])} to {number(values[1])}" if hit else "got none"
    if must and not hit:
        return "missed", f"expected {_way(context, case, exact)}, got none"
    if hit and not may:
        return "false hit", f"expected no hit, {got}"
    if hit and exact is not None:
        if flags & NOT_WRITTEN:
            return (
                "not written",
                "expected t_enter and t_exit, because it returned true; one is missing",
            )
        if fault := _wrong_ends(context, case, exact, values):
            return fault, f"expected {_way(context, case, exact)}, {got}"
        if not context.t_min[case] <= values[0] <= values[1] <= context.t_max[case]:
            return "not in order", f"expected t_min <= t_enter <= t_exit <= t_max, {got}"
    if flags & CHANGED_INPUT:
        return "changed its input", "expected the ray and the box as they were before the call"
    return None


def _wrong_ends(context: Context, case: int, exact: Exact, values: Array) -> str:
    """Which of the two values is wrong, if any."""
    if not np.isfinite(values[0]) or np.isnan(values[1]):
        return "not a number"
    ends = exact.ends(float(context.t_min[case]), float(context.t_max[case]))
    for name, value, end in zip(("t_enter", "t_exit"), values, ends, strict=True):
        if end is None or not np.isfinite(value):
            if (end is None) != (value == np.inf):
                return f"wrong {name}"
        elif abs(Fraction(value) - end) > Fraction(PROMISED) * abs(end):
            return f"wrong {name}"
    return ""


# --- Words -----------------------------------------------------------------------------------


def _way(context: Context, case: int, exact: Exact | None) -> str:
    if exact is None:
        return "no hit"
    enter, leave = exact.ends(float(context.t_min[case]), float(context.t_max[case]))
    end = "infinity" if leave is None else number(float(leave))
    return f"a hit from t = {number(float(enter))} to {end}"


def _geometry(context: Context, case: int) -> str:
    return (
        f"ray from {point(context.origin[case])} along {point(context.direction[case])}, "
        f"t in [{number(context.t_min[case])}, {number(context.t_max[case])}], "
        f"box from {point(context.lower[case])} to {point(context.upper[case])}"
    )


# --- Cases -----------------------------------------------------------------------------------


def _hand_picked() -> tuple[NDArray[np.float32], list[str]]:
    """Each line of edges_aabb.txt 24 times: with its axes moved on, and mirrored."""
    rows, label = [], []
    signs = [np.array([1 - 2 * (k >> axis & 1) for axis in range(3)]) for k in range(8)]
    for turn, sign in ((turn, sign) for turn in range(3) for sign in signs):
        for _, kind, corners, origin, direction, ends, name in read_table(EDGES):
            a, b = (sign * numbers(text, turn) for text in corners.split(","))
            lower, upper = np.where(sign > 0, a, b), np.where(sign > 0, b, a)
            places = np.concatenate([lower, upper, sign * numbers(origin, turn)]) + 0.0  # no -0
            way = sign * numbers(direction, turn)
            rows.append(np.concatenate([places, way, numbers(ends)]))
            label.append(f"{kind}: {name}")
    return np.array(rows).astype("<f4"), label
