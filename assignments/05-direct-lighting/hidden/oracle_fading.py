"""The oracle of ``point_light_irradiance``: group "fading".

flux / (4 pi d^2) in float64. Single precision makes a handful of roundings, far below the one
part in 10^5 that point_light.h asks for. probe_direct.c says how the files are laid out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from direct_words import how_wrong, triple
from numpy.typing import NDArray
from raybook_grader.cases import number, wrong_length
from raybook_grader.probes import Cases, Failure

Array = NDArray[np.float64]

WORDS_OUT = 3
PROMISED = 1e-5
RANDOM_CASES = 600

PICKED = [  # flux, distance
    ((1, 1, 1), 1), ((100, 50, 20), 2), ((100, 50, 20), 4), ((100, 50, 20), 0.5),
    ((100, 0, 0), 3), ((0, 100, 0), 3), ((0, 0, 100), 3), ((0, 0, 0), 3), ((1, 2, 3), 10),
    ((60, 60, 60), 0.001), ((1e6, 1e6, 1e6), 1000), ((1e-6, 1e-6, 1e-6), 0.01),
    ((1, 1, 1), 1e-6), ((1, 1, 1), 1e6), ((1e20, 1e20, 1e20), 1e15), ((1e-9, 1e-9, 1e-9), 1e-15),
]  # fmt: skip


@dataclass(frozen=True)
class Context:
    """One row a case."""

    flux: Array
    distance: Array
    answer: Array


def make_cases(group: str, seed: int) -> Cases:
    """The hand-picked cases, then 600 random ones, the same for the same seed."""
    if group != "fading":
        raise ValueError(f"group {group!r}, expected 'fading'")
    rng = np.random.default_rng(seed)
    picked = [[*flux, distance] for flux, distance in PICKED]
    flux = 10 ** rng.uniform(-4, 6, (RANDOM_CASES, 3)) * (rng.random((RANDOM_CASES, 3)) > 0.1)
    distance = 10 ** rng.uniform(-5, 5, (RANDOM_CASES, 1))
    words = np.concatenate([picked, np.hstack([flux, distance])]).astype("<f4")
    wide = words.astype(np.float64)
    answer = wide[:, :3] / (4 * np.pi * wide[:, 3:] ** 2)
    return Cases(words.tobytes(), len(words), Context(wide[:, :3], wide[:, 3], answer))


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Every wrong result, told in words."""
    if faults := wrong_length(output, 4 * WORDS_OUT, cases.count):
        return faults
    context: Context = cases.context
    values = np.frombuffer(output, "<f4").reshape(cases.count, 3).astype(np.float64)
    with np.errstate(invalid="ignore"):
        good = np.abs(values - context.answer) <= PROMISED * context.answer
    return [_failure(context, int(case), values[case]) for case in np.flatnonzero(~good.all(1))]


def _failure(context: Context, case: int, got: Array) -> Failure:
    want = context.answer[case]
    text = (
        f"flux {triple(context.flux[case])} W at a distance of {number(context.distance[case])} m: "
        f"expected an irradiance of {triple(want)}, got {triple(got)}"
    )
    return Failure(case, text, how_wrong(want, got), -float(len(text)))
