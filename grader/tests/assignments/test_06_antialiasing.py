"""Assignment 06 judges rightly: what its probes see, and in which words.

What all assignments have in common is tested in test_every_probe.py and test_museum.py.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from probe_bench import Bench, assignment_of, bench_fixture, right_modules
from scipy.integrate import quad

from raybook_grader.checks.oracles import load_oracle

ASSIGNMENT = assignment_of("06")
HIDDEN = ASSIGNMENT.folder / "hidden"
RIGHT = right_modules(ASSIGNMENT)
PLACES, SPREAD, EVEN, VALUE = PROBES = [
    "places are within reach",
    "places are spread like the filter",
    "what is even stays even",
    "value is the weighted mean",
]

bench = bench_fixture(ASSIGNMENT)


@pytest.mark.parametrize("module", RIGHT, ids=lambda file: file.stem)
def test_right_modules_pass_with_other_seeds(bench: Bench, module: Path) -> None:
    for check in PROBES:
        for seed in range(100, 103):
            assert bench.failures(module, check, seed=seed) == [], f"{check}, seed {seed}"


def test_the_stub_fails_what_asks_for_more_than_the_centre(bench: Bench) -> None:
    """Its places are within reach: a probe that passes, and is worth half a point."""
    flags = ("-O2", *(f"-DTODO_{todo}" for todo in ASSIGNMENT.todos))
    assert bench.failing(bench.module, "gcc", flags) == {bench.unit.name, SPREAD, EVEN, VALUE}


@pytest.mark.parametrize(
    "todo, expected",
    [("pixel_sample", {SPREAD, EVEN}), ("pixel_add", {VALUE}), ("pixel_value", {VALUE})],
)
def test_half_a_solution_earns_its_half(bench: Bench, todo: str, expected: set[str]) -> None:
    failing = bench.failing(bench.module, "gcc", ("-O2", f"-DTODO_{todo}"))
    assert failing == {bench.unit.name} | expected


PLACE = "vec2_make((float)x + 0.5f + offset.x, (float)y + 0.5f + offset.y);"
SAMPLE = "    vec2 offset = filter_sample(filter, random, &sample.weight);\n"
WITHOUT_WEIGHT = "    double w = 1.0;\n    (void)weight;\n"
MUTANTS = {
    "a tenth beyond the reach": ("+ offset.x,", "+ 1.1f * offset.x,", PLACES),
    "a hundredth of a pixel aside": ("0.5f + offset.y", "0.51f + offset.y", PLACES),
    "y upwards": ("(float)y + 0.5f", "-(float)y + 0.5f", PLACES),
    "a weight that is no number": (
        SAMPLE,
        SAMPLE + "    sample.weight = sample.weight * 0.0f / 0.0f;\n",
        PLACES,
    ),
    "nine tenths of the reach": ("+ offset.x,", "+ 0.9f * offset.x,", SPREAD),
    "half of the weight": (SAMPLE, SAMPLE + "    sample.weight *= 0.5f;\n", SPREAD),
    "two per cent of the weight": (SAMPLE, SAMPLE + "    sample.weight *= 0.98f;\n", SPREAD),
    "one side only": ("offset.x, (float)y", "fabsf(offset.x), (float)y", SPREAD),
    "a number squared": (SAMPLE, "    random.x *= random.x;\n" + SAMPLE, SPREAD),
    "one number for both": (SAMPLE, "    random.y = random.x;\n" + SAMPLE, SPREAD),
    "numbers that avoid the middle": (
        SAMPLE,
        "    random.x = random.x < 0.5f ? 0.9f * random.x : 1.0f - 0.9f * (1.0f - random.x);\n"
        + SAMPLE,
        SPREAD,
    ),
    "numbers turned by a third": (
        SAMPLE,
        "    random.x = fmodf(random.x + 0.31f * (float)(number.index % 3), 1.0f);\n" + SAMPLE,
        EVEN,
    ),
    "no divisor": ("k = sums->samples > 0 ? 1.0 / total : 0.0", "k = 1.0 / total", VALUE),
    "a threshold of a half": ("0.1 * sums", "0.5 * sums", VALUE),
    "no red": ("(float)(sums->sum[0] * k)", "(float)(sums->sum[1] * k)", VALUE),
    "never negative": (
        "(float)(sums->sum[0] * k)",
        "fmaxf(0.0f, (float)(sums->sum[0] * k))",
        VALUE,
    ),
    "the weight squared": ("sums->weight += w;", "sums->weight += w * w;", VALUE),
    "not counted": ("    sums->samples++;\n", "    sums->samples = 1;\n", VALUE),
    "a float weight": ("sums->weight += w;", "sums->weight = (float)(sums->weight + w);", VALUE),
}


@pytest.mark.parametrize("mutant", MUTANTS)
def test_small_faults_are_found(bench: Bench, mutant: str, tmp_path: Path) -> None:
    old, new, check = MUTANTS[mutant]
    flags = ("-O1", "-Wno-unused-variable", "-Wno-unused-parameter")
    assert bench.failures(bench.mutant(old, new, tmp_path), check, "gcc", flags)


# --- The oracles ------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def spread() -> Any:
    return load_oracle(HIDDEN / "oracle_spread.py")


def test_the_shares_of_the_strips_are_integrals(spread: Any) -> None:
    for f in spread.FILTERS:
        edges = np.linspace(-f.radius, f.radius, 6)
        whole = quad(f.value, -f.radius, f.radius, points=[0.0, f.radius / 2, -f.radius / 2])[0]
        for share, (lower, upper) in zip(f.shares(edges), pairwise(edges), strict=True):
            assert share == pytest.approx(quad(f.value, lower, upper)[0] / whole, abs=1e-6)


def test_the_strips_hold_the_filter_evenly(spread: Any) -> None:
    for f in spread.FILTERS:
        edges = spread.strips(f)
        assert (np.diff(edges) > 0).all()
        if f.kind != "mitchell":
            edges[[0, -1]] = -f.radius, f.radius
            assert f.shares(edges) == pytest.approx(1 / spread.STRIPS, rel=2e-2)


# --- Words ------------------------------------------------------------------------------------


def test_a_failure_is_told_in_words(bench: Bench, tmp_path: Path) -> None:
    wide = bench.mutant("+ offset.x,", "+ 2.0f * offset.x,", tmp_path)
    simplest = max(bench.failures(wide, PLACES), key=lambda failure: failure.simplicity)
    assert simplest.message.startswith("box filter of radius 0.5, pixel (")
    assert "expected at most 0.5 from the centre (" in simplest.message
    assert simplest.fingerprint == "beyond the reach"


def test_a_wrong_value_is_told_in_words(bench: Bench, tmp_path: Path) -> None:
    plain = bench.mutant("    double w = (double)weight;\n", WITHOUT_WEIGHT, tmp_path)
    told = "\n".join(f.message for f in bench.failures(plain, VALUE))
    assert (
        "two weights: added (1, 0, 4) with weight 0.5, (5, 8, 4) with weight 1.5: "
        "got (3, 4, 4), expected (4, 6, 4)" in told
    )
