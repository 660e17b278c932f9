"""The oracle of single places: groups "places" and "even".

"places": random pixels, filters, sample numbers and random numbers, 0 and the last float below 1
among them. A place must be within the filter's reach of the pixel's centre. The tolerance is the
rounding of the place, a float of the size of the pixel's coordinate: four times half a unit in its
last place, for the sums that lead to it.

"even": the numbers of a pixel's samples lie one in each cell of a square grid. With a box filter
each column of that grid, laid over the reach, must hold as many places as the others, and each
row. The numbers stay a hundredth of a cell away from the cells' borders: no rounding moves a
place into another column.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pixel_words import (
    KINDS,
    LAST_BELOW_ONE,
    WORDS_OUT,
    Array,
    Filter,
    Floats,
    call_in_words,
    place_records,
    rows_of,
)
from raybook_grader.cases import number, wrong_length
from raybook_grader.probes import Cases, Failure

RANDOM_CASES = 6000
EVEN_SETS = 60
EVEN_COUNTS = (4, 16, 64)


@dataclass(frozen=True)
class Context:
    """The records, their filters, and for "even" where each set starts."""

    records: Floats
    filters: list[Filter]
    which: NDArray[np.int64]
    starts: list[int]


def make_cases(group: str, seed: int) -> Cases:
    rng = np.random.default_rng(seed)
    if group == "places":
        context = _random(rng)
    elif group == "even":
        context = _even(rng)
    else:
        raise ValueError(f"group {group!r}, expected 'places' or 'even'")
    return Cases(context.records.tobytes(), len(context.records), context)


def judge(cases: Cases, output: bytes) -> list[Failure]:
    if faults := wrong_length(output, 4 * WORDS_OUT, cases.count):
        return faults
    context: Context = cases.context
    values, flags = rows_of(output)
    if context.starts:
        return _judge_even(context, values)
    return _judge_places(context, values, flags)


def _random_filters(rng: np.random.Generator) -> list[Filter]:
    """Some of each kind; the first are those of most scenes."""
    usual = [Filter("box", 0.5), Filter("tent", 1), Filter("gaussian", 1.5), Filter("mitchell", 2)]
    radii = 10 ** rng.uniform(-3, np.log10(64), 60)
    others = [
        Filter(KINDS[i % 4], float(np.float32(r)), float(np.float32(rng.uniform(0.1, 3) / r**2)))
        for i, r in enumerate(radii)
    ]
    return usual + others


def _random(rng: np.random.Generator) -> Context:
    n = RANDOM_CASES
    filters = _random_filters(rng)
    which = np.sort(rng.integers(0, len(filters), n))
    x, y = (np.floor(10 ** rng.uniform(0, np.log10(65536), n)) - 1 for _ in range(2))
    small = rng.random(n) < 0.5
    x, y = np.where(small, x % 8, x), np.where(small, y % 8, y)
    count = np.where(rng.random(n) < 0.5, rng.integers(1, 20, n), rng.integers(1, 5000, n))
    index = np.floor(rng.random(n) * count)
    shared = rng.integers(0, 2**24, n)
    numbers = rng.integers(0, 2**24, (n, 2)) * 2.0**-24
    for column in range(2):
        numbers[rng.random(n) < 0.1, column] = 0
        numbers[rng.random(n) < 0.1, column] = LAST_BELOW_ONE
    columns = [c.astype(np.float32) for c in (x, y, index, count, shared, numbers)]
    return Context(place_records(filters, which, columns), filters, which, [])


def _judge_places(context: Context, values: Array, flags: NDArray[np.uint32]) -> list[Failure]:
    pixel = context.records[:, 5:7].astype(np.float64)
    radius = np.array([np.float32(f.radius) for f in context.filters], float)[context.which]
    away = np.abs(values[:, :2] - pixel - 0.5)
    slack = 2.0**-22 * (pixel + 1 + radius[:, None])
    fine = (away <= radius[:, None] + slack).all(axis=1) & np.isfinite(values[:, 2])
    failures = []
    for case in np.flatnonzero(~fine | (flags != 0)):
        call = call_in_words(context.filters, context.which[case], context.records[case])
        x, y, weight = (number(v) for v in values[case])
        if not fine[case] and np.isfinite(values[case]).all():
            cx, cy = (number(c + 0.5) for c in pixel[case])
            message = (
                f"{call}: got the place ({x}, {y}), expected at most "
                f"{number(radius[case])} from the centre ({cx}, {cy}) along x and along y"
            )
            kind = "beyond the reach"
        elif not fine[case]:
            message = f"{call}: got ({x}, {y}) with weight {weight}, expected finite numbers"
            kind = "not finite"
        else:
            message = f"{call}: another answer when asked again; it may depend on these only"
            kind = "not a function of its arguments"
        failures.append(Failure(int(case), message, kind, _simplicity(context, int(case))))
    return failures


def _simplicity(context: Context, case: int) -> float:
    record = context.records[case]
    digits = sum(len(number(v)) for v in record[5:12])
    return float(-digits - context.which[case])


def _even(rng: np.random.Generator) -> Context:
    filters = [Filter("box", r) for r in (0.5, 1.0, 2.5)]
    parts, which, starts = [], [], []
    for i in range(EVEN_SETS):
        count = EVEN_COUNTS[i % 3]
        side = int(np.sqrt(count))
        starts.append(len(which))
        cells = rng.permutation(count)
        jitter = 0.01 + 0.98 * rng.random((count, 2))
        numbers = (np.column_stack([cells % side, cells // side]) + jitter) / side
        pixel = np.tile(rng.integers(0, 64, 2), (count, 1))
        shared = np.tile([count, rng.integers(0, 2**24)], (count, 1))
        parts.append(np.column_stack([pixel, np.arange(count), shared, numbers]))
        which += [i // 3 % len(filters)] * count
    columns = [np.concatenate(parts).astype(np.float32)]
    chosen = np.array(which)
    return Context(place_records(filters, chosen, columns), filters, chosen, starts)


def _judge_even(context: Context, values: Array) -> list[Failure]:
    failures = []
    ends = [*context.starts[1:], len(context.records)]
    for start, end in zip(context.starts, ends, strict=True):
        count = end - start
        side = int(np.sqrt(count))
        radius = context.filters[context.which[start]].radius
        pixel = context.records[start, 5:7].astype(np.float64)
        share = (values[start:end, :2] - pixel - 0.5 + radius) / (2 * radius)
        for axis, name in ((0, "columns"), (1, "rows")):
            # Not a number, or out of reach, is in none of them.
            held = np.histogram(share[:, axis], bins=side, range=(0, 1))[0]
            if (held != side).any():
                failures.append(_uneven(context, start, count, name, held))
    return failures


def _uneven(
    context: Context, start: int, count: int, name: str, held: NDArray[np.int64]
) -> Failure:
    side = int(np.sqrt(count))
    x, y = (int(v) for v in context.records[start, 5:7])
    message = (
        f"{context.filters[context.which[start]].name}, pixel ({x}, {y}), {count} samples whose "
        f"random numbers lie one in each cell of a grid of {side} by {side}: the {name} of the "
        f"grid hold {', '.join(map(str, held))} places, expected {side} each"
    )
    return Failure(start, message, f"uneven {name}", float(-count))
