"""The oracle of the table of lights: groups "table" and, with fewer random numbers, "few".

Each probability must be what the contract's rule gives in float64, to one part in 10^4. Then the
table is swept with evenly spaced random numbers. Whatever the method, the numbers that pick one
light are at most as many stretches of [0, 1) as there are lights, and one more; each stretch holds
its length times the steps of them, give or take one. So the counts are exact up to 2 n + 3, and
no luck is involved. probe_lights.c says how the files are laid out.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from lamps import (
    DIRECTIONAL,
    POINT,
    RECT,
    SPHERE,
    SPOT,
    Case,
    Lamp,
    flagged,
    short,
    single,
    wrong_length,
)
from raybook_grader.probes import Cases, Failure

PROMISED = 1e-4
RANDOM_CASES = 150


def make_cases(group: str, seed: int) -> Cases:
    """The hand-picked cases, then random ones, the same for the same seed."""
    if group not in ("table", "few"):
        raise ValueError(f"group {group!r}, expected 'table' or 'few'")
    rng = np.random.default_rng(seed)
    cases = [*_picked(), *(_random(rng) for _ in range(RANDOM_CASES))]
    if group == "few":
        cases = [replace(case, steps=256) for case in cases]
    return Cases(b"".join(case.record() for case in cases), len(cases), tuple(cases))


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Every wrong result, told in words."""
    context: tuple[Case, ...] = cases.context
    expected = sum(4 + 8 * len(case.lamps) for case in context)
    if faults := wrong_length(output, expected, cases.count):
        return faults
    failures, place = [], 0
    for number, case in enumerate(context):
        size = 1 + 2 * len(case.lamps)
        words = np.frombuffer(output, "<u4", size, place)
        place += 4 * size
        failures += _judge(number, case, words)
    return failures


def _judge(number: int, case: Case, words: np.ndarray) -> list[Failure]:
    text, want = case.tell(), case.probabilities()
    got = words[1::2].copy().view("<f4").astype(np.float64)
    picks = words[2::2].astype(np.float64)
    failures = flagged(number, text, int(words[0]))
    with np.errstate(invalid="ignore"):
        wrong = ~(np.abs(got - want) <= PROMISED * want)
    numbers = case.steps + 1
    spread = np.where(want > 0, 2 * len(want) + 3, 0)
    miscounted = np.abs(picks - want * numbers) > spread
    if wrong.any():
        light = int(np.argmax(wrong))
        message = (
            f"{text}: light {light}: expected a probability of {short(want[light])}, "
            f"got {short(got[light])}"
        )
        failures.append(Failure(number, message, "wrong probability", -float(len(text))))
    if miscounted.any():
        light = int(np.argmax(miscounted))
        message = (
            f"{text}: light {light}: of {numbers} random numbers {picks[light]:.0f} pick it, "
            f"expected {want[light] * numbers:.0f}, give or take {spread[light]}"
        )
        failures.append(Failure(number, message, "picked too often or too rarely", -len(text)))
    return failures


def _grey(*powers: float) -> tuple[Lamp, ...]:
    """Point lights; the luminance of a grey flux is that flux."""
    return tuple(Lamp(colour=(single(p),) * 3) for p in powers)


def _picked() -> list[Case]:
    many = _grey(*(1 + k % 7 for k in range(1000)))
    shapes = tuple(Lamp(kind) for kind in (POINT, DIRECTIONAL, SPOT, RECT, SPHERE))
    red_green_blue = tuple(Lamp(colour=colour) for colour in ((9, 0, 0), (0, 9, 0), (0, 0, 9)))
    by_power = [
        Case("no light", ()),
        Case("one light", _grey(5)),
        Case("one light without power", _grey(0)),
        Case("two alike", _grey(7, 7)),
        Case("one to three", _grey(10, 30)),
        Case("the first without power", _grey(0, 30, 10)),
        Case("the last without power", _grey(10, 30, 0)),
        Case("without power on both sides", _grey(0, 0, 10, 0, 30, 0, 0)),
        Case("none has power", _grey(0, 0, 0, 0)),
        Case("the last is the brightest", _grey(1, 2, 3, 94)),
        Case("a faint light", _grey(10, 1e-6, 30, 60), steps=1 << 20),
        Case("faint lights and dark ones", _grey(0, 1e-9, 1e-7, 0, 1, 0), steps=1 << 20),
        Case("just above the floor and below", _grey(0.002, 0.0005, 3), steps=1 << 20),
        Case("very bright lights", _grey(1e30, 3e30, 6e30)),
        Case("very faint lights only", _grey(1e-30, 3e-30, 6e-30)),
        Case("red, green and blue", red_green_blue),
        Case("a light of each kind", shapes, radius=2.0),
        Case("a sun over a large scene", (Lamp(), Lamp(DIRECTIONAL)), radius=100.0),
        Case("a sun over a small scene", (Lamp(), Lamp(DIRECTIONAL)), radius=0.125),
        Case("large and small spheres", tuple(Lamp(SPHERE, area=a) for a in (4.0, 0.25, 1.0))),
        Case("narrow and wide spots", tuple(Lamp(SPOT, beam=0.1, cutoff=c) for c in (0.5, 1.5))),
        Case("a hundred lights", many[:100], steps=1 << 18),
        Case("a thousand lights", many, steps=1 << 14),
    ]
    return [*by_power, *(replace(case, by_power=False) for case in by_power)]


def _random(rng: np.random.Generator) -> Case:
    count = int(np.ceil(2 ** rng.uniform(0, 6)))
    spread = rng.uniform(0, 6)
    lamps = []
    for _ in range(count):
        colour = 10 ** rng.uniform(-spread, spread) * rng.uniform(0.1, 1, 3)
        if rng.random() < 0.2:
            colour = np.zeros(3)
        beam = rng.uniform(0.05, 0.6)
        lamps.append(
            Lamp(
                kind=int(rng.choice([POINT, DIRECTIONAL, SPOT, RECT, SPHERE])),
                colour=tuple(single(x) for x in colour),
                beam=single(beam),
                cutoff=single(beam + rng.uniform(0.3, 0.8)),
                area=single(10 ** rng.uniform(-3, 2)),
            )
        )
    by_power = bool(rng.random() < 0.8)
    radius = single(10 ** rng.uniform(-2, 2))
    return Case("random lights", tuple(lamps), by_power, radius, 1 << 15)
