"""The oracle of ``refraction_direction``: groups "edges" and "random".

snell.py says what is right and how exact an answer must be; probe_refraction.c says how the files
are laid out.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from raybook_grader.cases import number, numbers, point, read_table, wrong_length
from raybook_grader.probes import Cases, Failure
from snell import Array, Snell, snell

WORDS_IN, WORDS_OUT = 7, 4
EDGES = Path(__file__).with_name("edges_refraction.txt")
RANDOM_CASES = 10_000
LENGTH_ERROR = 2e-6
"""For vectors that are right but for their length: three components off by the promised 1e-6."""


@dataclass(frozen=True)
class Context:
    """The cases, and what is right."""

    normal: Array
    outgoing: Array
    eta: Array
    right: Snell
    label: list[str]


def make_cases(group: str, seed: int) -> Cases:
    """ "edges": hand-picked, whatever the seed. "random": 10,000, the same for the same seed."""
    if group == "edges":
        wide, label = _hand_picked()
    elif group == "random":
        wide, label = _random(np.random.default_rng(seed), RANDOM_CASES)
    else:
        raise ValueError(f"group {group!r}, expected 'edges' or 'random'")
    words = wide.astype("<f4")
    wide = words.astype(np.float64)
    normal, outgoing, eta = wide[:, :3], wide[:, 3:6], wide[:, 6]
    right = snell(normal, outgoing, eta)
    return Cases(words.tobytes(), len(label), Context(normal, outgoing, eta, right, label))


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Every wrong result, told in words."""
    if faults := wrong_length(output, 4 * WORDS_OUT, cases.count):
        return faults
    context: Context = cases.context
    words = np.frombuffer(output, "<u4").reshape(cases.count, WORDS_OUT)
    through = words[:, 0] != 0
    got = words.view("<f4")[:, 1:].astype(np.float64)
    right = context.right
    want = np.where(through[:, None], right.beyond, right.mirror)
    error = np.where(through, right.beyond_error, right.mirror_error)
    allowed = np.where(through, right.through, right.mirrored)
    with np.errstate(invalid="ignore"):
        good = allowed & (np.abs(got - want) <= error[:, None]).all(axis=1)
    return [
        _failure(context, int(case), bool(through[case]), got[case])
        for case in np.flatnonzero(~good)
    ]


# --- Words -----------------------------------------------------------------------------------


def _failure(context: Context, case: int, through: bool, got: Array) -> Failure:
    right = context.right
    expects_through = bool(right.through[case]) and (through or not right.mirrored[case])
    want = right.beyond[case] if expects_through else right.mirror[case]
    side = "outside" if right.outside[case] else "inside"
    degrees = float(np.degrees(np.arcsin(min(1.0, right.sine[case]))))
    label = context.label[case]
    text = (
        f"{label}: normal {point(context.normal[case])}, outgoing {point(context.outgoing[case])}, "
        f"eta_inside_over_outside {number(context.eta[case])} (outgoing is {side}, "
        f"{degrees:.4g} degrees from the normal): "
    )
    sentence = (
        f"expected {_answer(expects_through)} and {point(want + 0.0)}, got {_answer(through)} and "
        f"{point(got + 0.0)}"
    )
    what = _what(context, case, expects_through, through, want, got)
    return Failure(
        case, f"{text}{sentence}{what[1]}", f"{what[0]}: {label.split(':')[0]}", -float(len(text))
    )


def _answer(through: bool) -> str:
    return "true" if through else "false"


def _what(
    context: Context, case: int, expects_through: bool, through: bool, want: Array, got: Array
) -> tuple[str, str]:
    """The kind of error, and what there is to say beside the numbers."""
    if np.isnan(got).all():
        return "not written", ", which *incoming held before"
    if not np.isfinite(got).all():
        return "not a number", ""
    if expects_through and not through:
        return "no way through", ": Snell's law has a solution"
    if through and not expects_through:
        return "no total reflection", ": Snell's law has no solution"
    length = float(np.linalg.norm(got))
    if abs(length - 1) > LENGTH_ERROR + context.right.beyond_error[case]:
        return "length", f", of length {length:.7g}"
    if np.dot(got, context.normal[case]) * np.dot(want, context.normal[case]) < 0:
        return "wrong side", ", on the wrong side of the boundary"
    return "direction", ""


# --- Cases -----------------------------------------------------------------------------------


def _hand_picked() -> tuple[Array, list[str]]:
    """Each line of edges_refraction.txt three times, with its axes moved on."""
    wide, label = [], []
    for turn in range(3):
        for _, kind, normal, outgoing, eta, name in read_table(EDGES):
            vectors = [_unit(numbers(v, turn)) for v in (normal, outgoing)]
            wide.append(np.concatenate([*vectors, [float(eta)]]))
            label.append(f"{kind}: {name}")
    return np.array(wide), label


KINDS = {  # share of the random cases, in per cent
    "any angle": 55,
    "near straight on": 12,
    "grazing": 13,
    "near the critical angle": 20,
}
COMMON = np.array([1.0, 1.33, 1.5, 2.4, 1 / 1.5, 0.75])


def _random(rng: np.random.Generator, n: int) -> tuple[Array, list[str]]:
    kind = rng.choice(list(KINDS), n, p=np.array(list(KINDS.values())) / 100)
    eta = np.where(rng.random(n) < 0.5, rng.choice(COMMON, n), 10 ** rng.uniform(-1, 1, n))
    inside = rng.random(n) < 0.5
    cosine = np.cos(rng.uniform(0, np.pi / 2, n))
    small = 10 ** rng.uniform(-6, -1, n)
    cosine = np.where(kind == "near straight on", np.sqrt(1 - small**2), cosine)
    cosine = np.where(kind == "grazing", small, cosine)
    critical = np.where(inside, 1 / eta, eta)  # the sine there; none where it is above 1
    off = np.sqrt(np.maximum(0, 1 - np.minimum(critical, 1) ** 2))
    off = np.clip(off + rng.choice([-1, 1], n) * small, 0, 1)
    cosine = np.where((kind == "near the critical angle") & (critical < 1), off, cosine)

    normal, other = _unit(rng.normal(size=(n, 3))), rng.normal(size=(n, 3))
    along_axis = np.flatnonzero(rng.random(n) < 0.2)
    normal[along_axis] = rng.choice(np.concatenate([np.eye(3), -np.eye(3)]), len(along_axis))
    tangent = _unit(other - np.sum(other * normal, axis=1, keepdims=True) * normal)
    side = np.where(inside, -1.0, 1.0)
    sine = np.sqrt(1 - cosine**2)
    outgoing = sine[:, None] * tangent + (side * cosine)[:, None] * normal
    return np.column_stack([normal, outgoing, eta]), [str(k) for k in kind]


def _unit(v: NDArray[np.float64]) -> Array:
    length: Array = np.linalg.norm(v, axis=-1, keepdims=True)
    return np.asarray(v / length)
