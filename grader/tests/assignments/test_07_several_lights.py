"""Assignment 07 judges rightly: what its probes see, and in which words.

What all assignments have in common is tested in test_every_probe.py and test_museum.py.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from probe_bench import ROOT, Bench, assignment_of, bench_fixture, name_of, right_modules

from raybook_grader.checks.oracles import load_oracle

ASSIGNMENT = assignment_of("07")
RIGHT = right_modules(ASSIGNMENT)
SUM, TABLE = (ROOT / path for path in ASSIGNMENT.owned)
PICKS, LIGHTS = PROBES = ["table of lights", "light of several"]
UNIT = "public unit tests"

bench = bench_fixture(ASSIGNMENT)


@pytest.mark.parametrize("seed", [100])
@pytest.mark.parametrize("module", RIGHT, ids=name_of)
def test_right_modules_pass_with_other_seeds(bench: Bench, module: Path, seed: int) -> None:
    for check in PROBES:
        assert bench.failures(module, check, seed=seed) == [], check


@pytest.mark.parametrize(
    "todo, module, expected",
    [("several_lights", SUM, {UNIT, LIGHTS}), ("light_selection", TABLE, {UNIT, PICKS})],
)
def test_half_a_solution_earns_its_half(
    bench: Bench, todo: str, module: Path, expected: set[str]
) -> None:
    assert bench.failing(module, "gcc", ("-O2", f"-DTODO_{todo}")) == expected


MUTANTS = {
    "one less": ("light < count; light++", "light + 1 < count; light++", SUM, LIGHTS),
    "from the second": ("uint32_t light = 0; light", "uint32_t light = 1; light", SUM, LIGHTS),
    "twice": ("ask_light(a, light));", "ask_light(a, light));\n    (void)ask_light(a, 0);",
              SUM, LIGHTS),
    "1 % more": ("1.0f / probability", "1.01f / probability", SUM, LIGHTS),
    "half a random number": ("pick(table, random,", "pick(table, 0.5f * random,", SUM, LIGHTS),
    "always evenly": ("by_power ? light_power", "by_power && !count ? light_power", TABLE, PICKS),
    "power of a scene of 1 m": ("&lights[i], scene_radius", "&lights[i], 1.0f + 0 * scene_radius",
                                TABLE, PICKS),
    "a tenth of the share": ("LIGHT_SMALLEST_SHARE *", "0.1f * LIGHT_SMALLEST_SHARE *", TABLE,
                             PICKS),
    "0.1 % too likely": ("(float)(t->choices[light].end", "1.001f * (float)(t->choices[light].end",
                         TABLE, PICKS),
    "even with one dark": ("weights[i] > 0.0f", "weights[i] >= 0.0f", TABLE, PICKS),
    "count kept": ("t->choices = NULL;\n    t->count = 0;\n}\n#else",
                   "t->choices = NULL;\n}\n#else", TABLE, PICKS),
}  # fmt: skip


@pytest.mark.parametrize("mutant", MUTANTS)
def test_small_faults_are_found(bench: Bench, mutant: str, tmp_path: Path) -> None:
    old, new, module, check = MUTANTS[mutant]
    assert bench.failures(bench.mutant(old, new, tmp_path, module), check, "gcc", ("-O1",))


# --- The cases --------------------------------------------------------------------------------


def test_the_rule_by_hand(bench: Bench) -> None:
    """Probabilities of hand-picked lights, as selection.h has them."""
    known = {case.label: case for case in bench.cases(PICKS).context if case.by_power}
    least = 1e-3 * (100.000001 / 4)
    rules: dict[str, list[float]] = {
        "one to three": [1, 3],
        "without power on both sides": [0, 0, 1, 0, 3, 0, 0],
        "none has power": [1, 1, 1, 1],
        "a faint light": [10, least, 30, 60],
        "red, green and blue": [0.2126, 0.7152, 0.0722],
    }
    for label, weights in rules.items():
        want = np.array(weights) / np.sum(weights)
        assert np.allclose(known[label].probabilities(), want, rtol=1e-6, atol=0), label
    evenly = replace(known["one to three"], by_power=False)
    assert np.array_equal(evenly.probabilities(), [0.5, 0.5])


def test_one_lamp_by_hand(bench: Bench) -> None:
    """Two metres straight above the floor: albedo / pi x flux / (4 pi 2^2)."""
    case = next(case for case in bench.cases(LIGHTS).context if case.label == "one light")
    parts = vars(load_oracle(ASSIGNMENT.folder / bench.probes[LIGHTS].oracle))["parts"](case)
    want = np.array([0.5 * 90, 0.25 * 9, 1.0 * 9]) / np.pi / (16 * np.pi)
    assert np.allclose(parts, [want], rtol=1e-12, atol=0)


def test_the_sum_is_judged_narrowly(bench: Bench) -> None:
    """The mean of one_light may be off by 0.1 %, more only where a faint light matters much."""
    loose = []
    for case in bench.cases(LIGHTS).context:
        parts = vars(load_oracle(ASSIGNMENT.folder / bench.probes[LIGHTS].oracle))["parts"](case)
        p = case.probabilities()[:, None] if len(parts) else np.ones((0, 1))
        if parts.any():
            error = np.where(p > 0, parts / np.maximum(p, 1e-30), 0) * (2 * len(parts) + 3)
            loose.append(error.sum() / case.steps / parts.sum())
    assert np.median(loose) < 2e-3
    assert np.quantile(loose, 0.9) < 0.01


# --- Words ------------------------------------------------------------------------------------


def test_a_failure_is_told_in_words(bench: Bench, tmp_path: Path) -> None:
    mutant = bench.mutant("total > 0.0 ?", "total >= 0.0 ?", tmp_path, TABLE)
    failures = bench.failures(mutant, PICKS)
    told = {failure.message for failure in failures if failure.fingerprint == "wrong probability"}
    assert (
        "none has power: 4 point lights of power 0, 0, 0, 0 W, picked by power: light 0: "
        "expected a probability of 0.25, got nan"
    ) in told


def test_a_wrong_sum_is_told_in_words(bench: Bench, tmp_path: Path) -> None:
    mutant = bench.mutant("light < count; light++", "light + 1 < count; light++", tmp_path, SUM)
    failures = bench.failures(mutant, LIGHTS)
    simplest = max(failures, key=lambda failure: failure.simplicity)
    assert simplest.message == (
        "one light: 1 point light of power 26.2206 W, picked evenly: "
        "all_lights does not ask each light exactly once"
    )
    assert "all_lights: too dark" in {failure.fingerprint for failure in failures}
