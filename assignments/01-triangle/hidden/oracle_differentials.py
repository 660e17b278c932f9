"""The oracle of ``triangle_uv_differentials``: group "differentials".

The two vectors are found by Cramer's rule in float64; a result that float64 cannot clear of
doubt is decided again in exact rational arithmetic, so no failure is reported that exact
arithmetic did not confirm. With u = 2^-24, E = |e1| + |e2|, U = |du1| + |du2|, V = |dv1| + |dv2|
and the determinant D = du1 dv2 - du2 dv1, the length of the error may be

    dp_du: 1e-4 |dp_du| + K u V (E + U |dp_du|) / |D|
    dp_dv: 1e-4 |dp_dv| + K u U (E + V |dp_dv|) / |D|

K = 10 counts the roundings of Cramer's rule: four in each product, four in D, one in 1 / D and
one in the last product. It also bounds elimination with a pivot, whose roundings are fewer. Where
10 u U V is a quarter of |D| or more, rounding may hide that D is not 0: either answer is right.

probe_triangle.c says how the files are laid out.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from raybook_grader.cases import numbers, point, read_table, wrong_length
from raybook_grader.probes import Cases, Failure

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

WORDS_IN, WORDS_OUT = 15, 8
WROTE_ON_FALSE = 1
UNIT = 2.0**-24
ROUNDINGS = 10
PROMISED = 1e-4
LARGEST = float(np.finfo(np.float32).max)
EDGES = Path(__file__).with_name("edges_differentials.txt")
RANDOM_CASES = 1500


@dataclass(frozen=True)
class Context:
    """The cases; ``answer`` holds dp_du and dp_dv (n, 2, 3), ``error`` how far each may be off.

    ``none``: no answer exists in any arithmetic. ``unclear``: rounding may hide that one does.
    """

    p: Array
    uv: Array
    answer: Array
    error: Array
    none: Mask
    unclear: Mask
    label: list[str]


def make_cases(group: str, seed: int) -> Cases:
    """The hand-picked cases, then 1500 random ones, the same for the same seed."""
    if group != "differentials":
        raise ValueError(f"group {group!r}, expected 'differentials'")
    picked, picked_label = _hand_picked()
    chosen, chosen_label = _random(np.random.default_rng(seed), RANDOM_CASES)
    words, label = np.concatenate([picked, chosen]), picked_label + chosen_label
    return Cases(words.tobytes(), len(label), _context(words, label, len(picked)))


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Every wrong result, told in words."""
    if faults := wrong_length(output, 4 * WORDS_OUT, cases.count):
        return faults
    context: Context = cases.context
    words = np.frombuffer(output, "<u4").reshape(cases.count, WORDS_OUT)
    values = words.view("<f4")[:, 1:7].astype(np.float64).reshape(-1, 2, 3)
    true, flags = words[:, 0] != 0, words[:, 7]
    with np.errstate(invalid="ignore"):
        away = np.linalg.norm(values - context.answer, axis=2)
        good = (away <= 0.99 * context.error).all(axis=1) & ~context.none
    good = np.where(true, good, context.none | context.unclear) & (flags == 0)
    failures = []
    for case in np.flatnonzero(~good):
        wrong = _wrong(context, int(case), bool(true[case]), values[case], int(flags[case]))
        if wrong:
            kind, sentence = wrong
            text = _geometry(context, int(case))
            name = context.label[case]
            fingerprint = f"{kind}: {name.split(':')[0]}"
            message = f"{name}: {text}: {sentence}"
            failures.append(Failure(int(case), message, fingerprint, -float(len(text))))
    return failures


def _context(words: NDArray[np.float32], label: list[str], picked: int) -> Context:
    wide = words.astype(np.float64)
    p, uv = wide[:, :9].reshape(-1, 3, 3), wide[:, 9:].reshape(-1, 3, 2)
    with np.errstate(all="ignore"):
        e1, e2 = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
        (du1, dv1), (du2, dv2) = (uv[:, 1] - uv[:, 0]).T, (uv[:, 2] - uv[:, 0]).T
        det = du1 * dv2 - du2 * dv1
        dp_du = (e1 * dv2[:, None] - e2 * dv1[:, None]) / det[:, None]
        dp_dv = (e2 * du1[:, None] - e1 * du2[:, None]) / det[:, None]
        answer = np.stack([dp_du, dp_dv], axis=1)
        none = ~(np.abs(answer) <= LARGEST).all(axis=(1, 2)) | (det == 0) | _equal_uv(uv)

        size = np.linalg.norm(answer, axis=2)
        edges = np.linalg.norm(e1, axis=1) + np.linalg.norm(e2, axis=1)
        width, height = np.abs(du1) + np.abs(du2), np.abs(dv1) + np.abs(dv2)
        small = ROUNDINGS * UNIT / np.abs(det)
        rounding = np.stack(
            [height * (edges + width * size[:, 0]), width * (edges + height * size[:, 1])], axis=1
        )
        error = PROMISED * size + small[:, None] * rounding
        unclear = ~(small * width * height < 0.25)
    # Of the hand-picked cases each is clear, and so is one with two equal uv.
    unclear &= ~_equal_uv(uv)
    unclear[:picked] = False
    return Context(p, uv, answer, error, none, unclear, label)


def _equal_uv(uv: Array) -> Mask:
    same: Mask = (uv == np.roll(uv, 1, axis=1)).all(axis=2).any(axis=1)
    return same


Vector = tuple[Fraction, Fraction, Fraction]


def _exact(context: Context, case: int) -> tuple[Vector, Vector] | None:
    """dp_du and dp_dv; None when they do not exist or are beyond single precision."""
    p, uv = context.p[case], context.uv[case]
    if not (np.isfinite(p).all() and np.isfinite(uv).all()):
        return None
    p0, p1, p2 = ([Fraction(x) for x in corner] for corner in p)
    (u0, v0), (u1, v1), (u2, v2) = ([Fraction(x) for x in pair] for pair in uv)
    det = (u1 - u0) * (v2 - v0) - (u2 - u0) * (v1 - v0)
    if det == 0:
        return None
    e1 = [a - b for a, b in zip(p1, p0, strict=True)]
    e2 = [a - b for a, b in zip(p2, p0, strict=True)]
    dp_du = [(a * (v2 - v0) - b * (v1 - v0)) / det for a, b in zip(e1, e2, strict=True)]
    dp_dv = [(b * (u1 - u0) - a * (u2 - u0)) / det for a, b in zip(e1, e2, strict=True)]
    if max(abs(x) for x in dp_du + dp_dv) > LARGEST:
        return None
    return (dp_du[0], dp_du[1], dp_du[2]), (dp_dv[0], dp_dv[1], dp_dv[2])


def _wrong(
    context: Context, case: int, true: bool, values: Array, flags: int
) -> tuple[str, str] | None:
    """The kind of error and the words for it; None when the result is right."""
    got = f"got dp_du = {point(values[0])}, dp_dv = {point(values[1])}" if true else "got false"
    exact = _exact(context, case)
    if flags & WROTE_ON_FALSE:
        return (
            "wrote on false",
            "expected both vectors as they were before, because it returned false",
        )
    if context.unclear[case] and not (true and not np.isfinite(values).all()):
        return None
    if exact is None:
        return ("false answer", f"expected false, no such vectors exist, {got}") if true else None
    answer = np.array([[float(x) for x in vector] for vector in exact])
    expected = f"expected dp_du = {point(answer[0])}, dp_dv = {point(answer[1])}, {got}"
    if not true:
        return "no answer", expected
    away = np.linalg.norm(values - answer, axis=1)
    if np.isfinite(away).all() and (away <= context.error[case]).all():
        return None
    which = "dp_du" if not away[0] <= context.error[case, 0] else "dp_dv"
    return f"wrong {which}", expected


def _geometry(context: Context, case: int) -> str:
    corners = " ".join(point(q) for q in context.p[case])
    pairs = " ".join(point(q) for q in context.uv[case])
    return f"triangle {corners} with texture coordinates {pairs}"


def _hand_picked() -> tuple[NDArray[np.float32], list[str]]:
    """Each line of edges_differentials.txt three times, with its axes moved on."""
    rows, label = [], []
    for turn in range(3):
        for _, kind, corners, uvs, name in read_table(EDGES):
            turned = [numbers(q, turn) for q in corners.split(",")]
            rows.append(np.concatenate([*turned, *(numbers(q) for q in uvs.split(","))]))
            label.append(f"{kind}: {name}")
    return np.array(rows).astype("<f4"), label


KINDS = {  # share of the random cases, in per cent
    "any uv": 45,
    "small chart": 20,
    "many repeats": 12,
    "uv sliver": 12,
    "equal uv": 8,
    "NaN uv": 3,
}


def _random(rng: np.random.Generator, n: int) -> tuple[NDArray[np.float32], list[str]]:
    kind = rng.choice(list(KINDS), n, p=np.array(list(KINDS.values())) / 100)
    size = 10 ** rng.uniform(-4, 4, (n, 1, 1))
    p = size * (rng.normal(size=(n, 3, 3)) + rng.normal(size=(n, 1, 3)) * 3)
    chart = np.where(kind == "small chart", 10 ** rng.uniform(-3, 0, n), 1.0)
    chart = np.where(kind == "many repeats", 10 ** rng.uniform(0, 2, n), chart)
    uv = rng.uniform(0, 1, (n, 1, 2)) + chart[:, None, None] * rng.uniform(-1, 1, (n, 3, 2))
    along = rng.uniform(-1, 2, (n, 1))
    line = uv[:, 0] + along * (uv[:, 1] - uv[:, 0]) + rng.normal(size=(n, 2)) * 3e-3
    sliver = kind == "uv sliver"
    uv[sliver, 2] = line[sliver]
    equal = np.flatnonzero(kind == "equal uv")
    first = rng.integers(0, 3, len(equal))
    uv[equal, first] = uv[equal, (first + 1) % 3]
    broken = np.flatnonzero(kind == "NaN uv")
    uv[broken, rng.integers(0, 3, len(broken)), rng.integers(0, 2, len(broken))] = np.nan
    columns = [p.reshape(n, 9), uv.reshape(n, 6)]
    return np.concatenate(columns, axis=1).astype("<f4"), [str(k) for k in kind]
