"""The oracle of the pixel's value, group "value": the weighted mean, summed exactly.

pixel_sampling.h asks for 1e-6 of the sum of the terms' absolute values; the tolerance is that and
the rounding of the answer to a float. Where the weights' sum is near a tenth of the samples'
number, within 5 %, either divisor is right.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from pixel_words import WORDS_OUT, Array, Floats, rows_of
from raybook_grader.cases import number, point, wrong_length
from raybook_grader.probes import Cases, Failure

PROMISED, UNIT = 1e-6, 2.0**-24
NEXT, FIRST, NONE = 0, 1, 2
RANDOM_PIXELS = 600
MANY = 200_000

# (radiance (r, g, b), weight), ... of one pixel, and what it is.
HAND_PICKED: list[tuple[str, list[tuple[tuple[float, float, float], float]]]] = [
    ("one sample", [((0.25, 0.5, 1), 1)]),
    ("one black sample", [((0, 0, 0), 1)]),
    ("one sample of weight 2.5", [((1, 2, 3), 2.5)]),
    ("one sample brighter than 1", [((7, 80, 900), 1)]),
    ("two samples", [((1, 0, 4), 1), ((3, 2, 0), 1)]),
    ("two weights", [((1, 0, 4), 0.5), ((5, 8, 4), 1.5)]),
    ("a weight of 0", [((9, 9, 9), 0), ((1, 2, 3), 1), ((1, 2, 3), 2)]),
    ("a weight below 0", [((1, 1, 1), 1.5), ((3, 0, 1), -0.5), ((1, 1, 1), 1.5)]),
    ("a value below 0", [((1, 0.5, 1), 1.5), ((8, 9, 0), -0.5)]),
    ("weights that add up to 0", [((3, 2, 1), 1.25), ((1, 2, 2), -1.25)]),
    ("weights that add up to nearly 0", [((3, 2, 1), 1.25), ((1, 2, 2), -1.1875)]),
    ("weights that add up to less than 0", [((3, 2, 1), -1.25), ((1, 2, 2), 0.5)]),
    ("a fifth of the samples' number", [((4, 2, 1), 1.2), ((1, 2, 3), -0.8)]),
    ("very bright and very dark", [((1e6, 1, 1e-3), 1), ((1e-3, 1e6, 1), 1)]),
    ("a tiny radiance", [((1e-20, 2e-20, 0), 1), ((3e-20, 0, 0), 1)]),
]


@dataclass(frozen=True)
class Context:
    """The records, and for each pixel its name and the records' range."""

    records: Floats
    pixels: list[tuple[str, int, int]]


def make_cases(group: str, seed: int) -> Cases:
    if group != "value":
        raise ValueError(f"group {group!r}, expected 'value'")
    rng = np.random.default_rng(seed)
    parts = [np.array([[9.0, 9, 9, 9, NONE]])]
    names = ["no samples"]
    for name, samples in HAND_PICKED:
        parts.append(_pixel(np.array([[*radiance, w] for radiance, w in samples], float)))
        names.append(name)
    for _ in range(RANDOM_PIXELS):
        parts.append(_pixel(_random(rng)))
        names.append(f"{len(parts[-1])} samples")
    parts.append(_pixel(np.tile([0.1, 0.7, 300.0, 0.7], (MANY, 1))))
    names.append(f"{MANY} equal samples")
    parts.append(np.array([[9.0, 9, 9, 9, NONE]]))
    names.append("no samples, after another pixel")
    records = np.concatenate(parts).astype("<f4")
    ends = np.cumsum([len(part) for part in parts]).tolist()
    pixels = [(n, e - len(p), e) for n, e, p in zip(names, ends, parts, strict=True)]
    return Cases(records.tobytes(), len(records), Context(records, pixels))


def _pixel(samples: Array) -> Array:
    what = np.full((len(samples), 1), NEXT)
    what[0] = FIRST
    return np.hstack([samples, what])


def _random(rng: np.random.Generator) -> Array:
    """1 to 64 samples of one brightness or of all; all weights 1, above 0, or of both signs."""
    n = int(rng.integers(1, 65))
    size = 10 ** rng.uniform(-3, 3) * 10 ** (rng.uniform(-2, 2, (n, 1)) * rng.integers(0, 2))
    weights = [np.ones(n), rng.uniform(0, 2, n), rng.choice([-0.4, 1.6], n)][rng.integers(0, 3)]
    found: Array = np.column_stack([size * rng.random((n, 3)), weights])
    return found


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Of each pixel the value after its last sample; of small ones after each."""
    if faults := wrong_length(output, 4 * WORDS_OUT, cases.count):
        return faults
    context: Context = cases.context
    values, counts = rows_of(output)
    failures = []
    for name, start, end in context.pixels:
        ends = range(start + 1, end + 1) if end - start <= 8 else [end]
        for stop in ends:
            message = _judge(context.records[start:stop], values[stop - 1], int(counts[stop - 1]))
            if message:
                kind = _kind(name, context.records[start:stop])
                told = f"{name}: {message}" if stop == end else message
                failures.append(Failure(stop - 1, told, kind, float(start - stop)))
                break
    return failures


def _judge(records: Floats, value: Array, count: int) -> str:
    """What is wrong, in words; "" if nothing is."""
    samples = records.astype(float)
    if records[0, 4] == NONE:
        samples = samples[:0]
    n = len(samples)
    if count != n:
        return f"{_told(samples)}: `samples` is {count}, expected {n}"
    total = math.fsum(samples[:, 3])
    right, of = [], []
    for divisor in _divisors(total, n):
        terms = samples[:, :3] * samples[:, 3:4]
        right.append([math.fsum(terms[:, c]) / divisor for c in range(3)])
        of.append([math.fsum(np.abs(terms[:, c])) / abs(divisor) for c in range(3)])
    slack = PROMISED * np.array(of) + UNIT * np.abs(right) + 1e-37
    if (np.abs(value - np.array(right)) <= slack).all(axis=1).any():
        return ""
    return f"{_told(samples)}: got {point(value)}, expected {point(np.array(right[0]))}"


def _divisors(total: float, n: int) -> list[float]:
    if n == 0:
        return [1.0]
    if abs(total - 0.1 * n) < 0.005 * n:
        return [total, float(n)]
    return [total if total > 0.1 * n else float(n)]


def _kind(name: str, records: Floats) -> str:
    if records[0, 4] == NONE:
        return "no samples"
    if len(records) >= MANY:
        return "many samples"
    weights = records[:, 3].astype(float)
    if (weights == 1).all():
        return "equal weights"
    return "weights of both signs" if (weights < 0).any() else "weights"


def _told(samples: Array) -> str:
    if len(samples) == 0:
        return "no sample was added"
    shown = [f"{point(s[:3])} with weight {number(s[3])}" for s in samples[:3]]
    more = f" and {len(samples) - 3} more" if len(samples) > 3 else ""
    return "added " + ", ".join(shown) + more
