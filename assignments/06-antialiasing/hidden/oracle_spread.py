"""The oracle of all places together, group "spread": do they follow the filter?

*Closed form.* The filter is cut along each axis into strips of equal integral of its absolute
value; what each of the 64 bins must hold is the product of two integrals of the definition in
camera/filter.h, not of the module's or the framework's tables.

*Statistics.* Each filter is asked for many samples with independent pixel, number and random
numbers. So the sum of the weights in a bin is a sum of independent terms, whose variance is
estimated with it. Two tests of each filter, each with a false-alarm rate of 1e-9: the worst bin
(Bonferroni), and all bins together (chi-squared; a bin's errors hardly depend on another's). The
framework samples from a table of 512 cells: up to 1e-3 of a bin is not an error.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pixel_words import WORDS_OUT, Array, Filter, Floats, place_records, rows_of
from raybook_grader.cases import wrong_length
from raybook_grader.probes import Cases, Failure
from scipy.stats import chi2, norm

SAMPLES = 30_000
STRIPS = 8
COUNTS = (1, 2, 4, 5, 7, 9, 16, 64)
FALSE_ALARM = 1e-9
OF_TABLE = 1e-3
FILTERS = [
    Filter("box", 0.5),
    Filter("box", 1.7),
    Filter("tent", 1.0),
    Filter("gaussian", 1.5),
    Filter("gaussian", 0.75, alpha=4.0),
    Filter("mitchell", 2.0),
    Filter("mitchell", 1.5, b=0.0, c=0.5),
    Filter("mitchell", 3.0, b=1.0, c=0.0),
]


@dataclass(frozen=True)
class Context:
    """The records, SAMPLES for each filter in turn."""

    records: Floats


def make_cases(group: str, seed: int) -> Cases:
    if group != "spread":
        raise ValueError(f"group {group!r}, expected 'spread'")
    rng = np.random.default_rng(seed)
    n = SAMPLES * len(FILTERS)
    which = np.repeat(np.arange(len(FILTERS)), SAMPLES)
    # A fifth in the first column, a fifth in the first row: the film's border is not special.
    x, y = rng.integers(0, 64, (2, n)) * (rng.random((2, n)) > 0.2)
    count = rng.choice(COUNTS, n)
    index = np.floor(rng.random(n) * count)
    shared = rng.integers(0, 2**24, n)
    numbers = rng.integers(0, 2**24, (n, 2)) * 2.0**-24
    columns = [c.astype(np.float32) for c in (x, y, index, count, shared, numbers)]
    records = place_records(FILTERS, which, columns)
    return Cases(records.tobytes(), n, Context(records))


def judge(cases: Cases, output: bytes) -> list[Failure]:
    if faults := wrong_length(output, 4 * WORDS_OUT, cases.count):
        return faults
    context: Context = cases.context
    values, _ = rows_of(output)
    offsets = values[:, :2] - context.records[:, 5:7] - 0.5
    failures = []
    for i, f in enumerate(FILTERS):
        part = slice(i * SAMPLES, (i + 1) * SAMPLES)
        message = _compare(f, offsets[part], values[part, 2])
        if message:
            kind = f"not spread like the {f.kind} filter"
            failures.append(Failure(i * SAMPLES, f"{f.name}: {message}", kind, float(-i)))
    return failures


def strips(f: Filter) -> Array:
    """Edges between strips of equal integral of |f|, to the nearest of a fine grid."""
    fine = np.linspace(-f.radius, f.radius, 4001)
    so_far = np.concatenate([[0], np.cumsum(np.abs(f.value((fine[1:] + fine[:-1]) / 2)))])
    inner = np.interp(np.arange(1, STRIPS) / STRIPS * so_far[-1], so_far, fine)
    # A little more than the reach: a place on its rim is inside.
    rim = f.radius * (1 + 1e-4) + 1e-4
    return np.concatenate([[-rim], inner, [rim]])


def _compare(f: Filter, offsets: Array, weights: Array) -> str:
    """What is wrong, in words; "" if nothing is."""
    if not (np.isfinite(offsets).all() and np.isfinite(weights).all()):
        return "not all places and weights are finite"
    edges = strips(f)
    inside = edges.copy()
    inside[[0, -1]] = -f.radius, f.radius
    shares = f.shares(inside)
    expected = np.outer(shares, shares)
    found, error = _binned(edges, offsets, weights)
    excess = np.maximum(np.abs(found - expected) - OF_TABLE * np.abs(expected), 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        z = np.where(excess > 0, excess / error, 0)
    total = float(weights.mean()), float(weights.std() / np.sqrt(len(weights)))
    return _mean_weight(*total) or _worst(z, edges, found, expected)


def _binned(edges: Array, offsets: Array, weights: Array) -> tuple[Array, Array]:
    """The mean weight that falls in each bin, and one standard error of it."""
    n = len(weights)
    x, y = offsets.T
    first = np.histogram2d(x, y, bins=(edges, edges), weights=weights)[0] / n
    second = np.histogram2d(x, y, bins=(edges, edges), weights=weights**2)[0] / n
    return first, np.sqrt(np.maximum(second - first**2, 0) / n)


def _mean_weight(mean: float, error: float) -> str:
    if abs(mean - 1) <= OF_TABLE + float(norm.isf(FALSE_ALARM / 2)) * error:
        return ""
    return f"the weights are {mean:.3f} on average, expected 1"


def _worst(z: NDArray[np.float64], edges: Array, found: Array, expected: Array) -> str:
    limit = norm.isf(FALSE_ALARM / 2 / z.size)
    if z.max() <= limit and chi2.sf((z**2).sum(), z.size) >= FALSE_ALARM:
        return ""
    i, k = np.unravel_index(np.argmax(z), z.shape)
    return (
        f"of all samples, counted by their weights, the share {found[i, k]:.4f} lies between "
        f"{edges[i]:.2f} and {edges[i + 1]:.2f} beside the pixel's centre along x and between "
        f"{edges[k]:.2f} and {edges[k + 1]:.2f} along y, expected {expected[i, k]:.4f}"
    )
