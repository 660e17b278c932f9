"""The oracle of ``direct_light``: groups "shading", "shadows" and "ends".

*Independent.* Each case is a receiver, at most two other things and one light sample, so simple
that both the visibility and the light are closed forms; direct_cases.py has them in float64.

*Fair.* A case is used only where neither rounding nor the contract leaves the answer open: every
line passes well inside or outside of what it meets. What is black must be exactly black. Elsewhere
the contract's one part in 10^4 is allowed, and what rounding can do to a cosine.

probe_direct.c says how the files are laid out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from direct_cases import Answer, Case, answer
from direct_picked import PICKED
from direct_random import RANDOM
from direct_words import how_wrong, triple
from raybook_grader.cases import wrong_length
from raybook_grader.probes import Cases, Failure

WORDS_OUT = 5
CHANGED_VERTEX, CHANGED_SAMPLE, NO_VERTEX = 1, 2, 4
RANDOM_CASES = {"shading": 800, "shadows": 800, "ends": 800}


@dataclass(frozen=True)
class Context:
    cases: tuple[Case, ...]
    answers: tuple[Answer, ...]


def make_cases(group: str, seed: int) -> Cases:
    """The hand-picked cases of a group, then random ones, the same for the same seed."""
    if group not in RANDOM_CASES:
        raise ValueError(f"group {group!r}, expected one of {', '.join(RANDOM_CASES)}")
    pairs = [_decided(case) for case in PICKED[group]()]
    rng = np.random.default_rng(seed)
    while len(pairs) < len(PICKED[group]()) + RANDOM_CASES[group]:
        case = RANDOM[group](rng)
        if (known := answer(case)) is not None:
            pairs.append((case, known))
    cases, answers = (tuple(column) for column in zip(*pairs, strict=True))
    payload = b"".join(case.record() for case in cases)
    return Cases(payload, len(cases), Context(cases, answers))


def _decided(case: Case) -> tuple[Case, Answer]:
    known = answer(case)
    if known is None:
        raise ValueError(f"{case.label}: the answer is left open")
    return case, known


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Every wrong result, told in words."""
    if faults := wrong_length(output, 4 * WORDS_OUT, cases.count):
        return faults
    context: Context = cases.context
    words = np.frombuffer(output, "<u4").reshape(cases.count, WORDS_OUT)
    values = words.view("<f4")[:, :3].astype(np.float64)
    want = np.array([known.radiance for known in context.answers])
    tolerance = np.array([known.tolerance for known in context.answers])
    with np.errstate(invalid="ignore"):
        good = (np.abs(values - want) <= tolerance).all(axis=1)
    good &= (words[:, 3] == 0) & (words[:, 4] == 0)
    return [
        _failure(context, int(case), words[case, 3:].tolist(), values[case])
        for case in np.flatnonzero(~good)
    ]


def _failure(context: Context, case: int, marks: list[int], got: np.ndarray) -> Failure:
    text = context.cases[case].tell()
    flags, met = marks
    if flags & NO_VERTEX or met != 0:
        return Failure(case, f"{text}: the ray misses what it should see", "no vertex")
    if flags & CHANGED_VERTEX:
        return Failure(case, f"{text}: the vertex is no longer what it was", "changed the vertex")
    if flags & CHANGED_SAMPLE:
        return Failure(case, f"{text}: the light sample has been changed", "changed the sample")
    want = context.answers[case].radiance
    message = f"{text}: expected {triple(want)}, got {triple(got)}"
    kind = f"{how_wrong(want, got)}: {context.cases[case].label.split(':')[0]}"
    return Failure(case, message, kind, -float(len(message)))
