"""The oracle of ``all_lights`` and ``one_light``: group "sum".

Point lights over a floor that hides nothing: each one's part is a closed form. Their sum must be
right to one part in 10^4. The mean of one_light is taken over evenly spaced random numbers. With
p the probability of a light and n their number, the light is picked by p times the steps of them,
give or take 2 n + 3 (see oracle_table.py), so the mean may be off by its part times (2 n + 3) /
(p steps): a bound, not a chance. probe_lights.c says how the files are laid out.
"""

from __future__ import annotations

import math

import numpy as np
from lamps import Array, Case, Lamp, colour_words, flagged, single, wrong_length
from raybook_grader.probes import Cases, Failure

ALBEDO = np.array([0.5, 0.25, 1.0])
"""The floor's, as probe_lights.c has it."""

PROMISED = 1e-4
RANDOM_CASES = 60
HEAD = 10


def make_cases(group: str, seed: int) -> Cases:
    """The hand-picked cases, then 60 random ones, the same for the same seed."""
    if group != "sum":
        raise ValueError(f"group {group!r}, expected 'sum'")
    rng = np.random.default_rng(seed)
    cases = [*_picked(), *(_random(rng) for _ in range(RANDOM_CASES))]
    return Cases(b"".join(case.record() for case in cases), len(cases), tuple(cases))


def parts(case: Case) -> Array:
    """What each light adds, one row a light."""
    rows = [_part(lamp) for lamp in case.lamps]
    return np.array(rows).reshape(-1, 3)


def _part(lamp: Lamp) -> Array:
    height = lamp.position[1]
    square = float(np.sum(np.square(lamp.position)))
    cosine = max(0.0, height / math.sqrt(square))
    return np.asarray(ALBEDO / math.pi * np.array(lamp.colour) / (4 * math.pi * square) * cosine)


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Every wrong result, told in words."""
    context: tuple[Case, ...] = cases.context
    expected = sum(4 * (HEAD + len(case.lamps)) for case in context)
    if faults := wrong_length(output, expected, cases.count):
        return faults
    failures, place = [], 0
    for number, case in enumerate(context):
        size = HEAD + len(case.lamps)
        words = np.frombuffer(output, "<u4", size, place)
        place += 4 * size
        failures += _judge(number, case, int(words[0]), words[1:].view("<f4").astype(np.float64))
    return failures


def _judge(number: int, case: Case, flags: int, values: Array) -> list[Failure]:
    text, part = case.tell(), parts(case)
    failures = flagged(number, text, flags)
    half = len(part) // 2
    for got, first, name in (
        (values[0:3], len(part), "all_lights of all"),
        (values[3:6], half, f"all_lights of the first {half}"),
    ):
        want = part[:first].sum(axis=0)
        failures += _compare(number, text, name, want, PROMISED * want, got)
    if case.lamps:
        probability, steps = values[9:, None], case.steps
        with np.errstate(all="ignore"):
            loose = np.where(probability > 0, (2 * len(part) + 3) / (probability * steps), 0)
        want = part.sum(axis=0)
        error = 2 * PROMISED * want + (part * loose).sum(axis=0)
        name = f"the mean of one_light over {steps} random numbers"
        failures += _compare(number, text, name, want, error, values[6:9])
    return failures


def _compare(
    number: int, text: str, name: str, want: Array, error: Array, got: Array
) -> list[Failure]:
    with np.errstate(invalid="ignore"):
        if (np.abs(got - want) <= error).all():
            return []
    message = f"{text}: {name}: expected {colour_words(want)}, got {colour_words(got)}"
    with np.errstate(invalid="ignore"):
        way = "too bright" if got.sum() > want.sum() else "too dark"
    kind = f"{name.split(' of ')[0].split(' over ')[0]}: {way}"
    return [Failure(number, message, kind, -float(len(text)))]


def _picked() -> list[Case]:
    red, green = Lamp(colour=(90, 9, 9)), Lamp(colour=(9, 90, 9), position=(1, 2, 0))
    blue = Lamp(colour=(9, 9, 90), position=(-1, 2, 2))
    below, dark = Lamp(position=(1, -2, 0)), Lamp(colour=(0, 0, 0))
    faint = Lamp(colour=(0.001, 0.001, 0.001), position=(0, 0.125, 0))
    pure = tuple(
        Lamp(colour=colour, position=(k - 1, 3, 0))
        for k, colour in enumerate(((9, 0, 0), (0, 9, 0), (0, 0, 9)))
    )
    sets = {
        "no light": (),
        "one light": (red,),
        "two of different colours": (red, green),
        "two alike": (red, red),
        "three of different colours": (red, green, blue),
        "one under the floor": (red, below, green),
        "one without power": (dark, red, green, dark),
        "the last alone shines": (dark, below, blue),
        "a faint one beside the eye": (red, faint, green),
        "red, green and blue": pure,
    }
    return [
        Case(label, lamps, by_power, steps=1 << 17)
        for label, lamps in sets.items()
        for by_power in (False, True)
    ]


def _random(rng: np.random.Generator) -> Case:
    lamps = []
    for _ in range(int(rng.integers(1, 13))):
        place = rng.uniform((-4, 0.5, -4), (4, 4, 4))
        if rng.random() < 0.1:
            place[1] *= -1
        colour = 10 ** rng.uniform(-1, 3) * rng.uniform(0, 1, 3) * (rng.random() > 0.1)
        position = tuple(single(x) for x in place)
        lamps.append(Lamp(colour=tuple(single(x) for x in colour), position=position))
    return Case("random lights", tuple(lamps), bool(rng.random() < 0.7), steps=1 << 16)
