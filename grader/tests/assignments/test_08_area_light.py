"""Assignment 08 judges rightly: what its probes see, and in which words.

What all assignments have in common is tested in test_every_probe.py and test_museum.py.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from probe_bench import Bench, assignment_of, bench_fixture, right_modules

from raybook_grader.checks.oracles import load_oracle

ASSIGNMENT = assignment_of("08")
RIGHT = right_modules(ASSIGNMENT)
PLACES, SPREAD, DENSITY, EMITTED, LAMP = (
    "places lie on the rectangle", "places are spread evenly", "density of directions",
    "emitted radiance", "light of a lamp",
)  # fmt: skip
PROBES = [PLACES, SPREAD, DENSITY, EMITTED, LAMP]
Lamps: Any = load_oracle(ASSIGNMENT.folder / "hidden" / "oracle_lamp.py")

Array = NDArray[np.float64]

bench = bench_fixture(ASSIGNMENT)


def test_these_are_the_probes(bench: Bench) -> None:
    assert list(bench.probes) == PROBES


@pytest.mark.parametrize("module", RIGHT, ids=lambda file: file.stem)
def test_right_modules_pass_with_other_seeds(bench: Bench, module: Path) -> None:
    for seed in range(100, 104):
        for check in PROBES:
            assert bench.failures(module, check, seed=seed) == [], f"{check}, seed {seed}"


TODOS = {
    "rect_light_place": {SPREAD, LAMP},
    "area_light_pdf": {DENSITY, LAMP},
    "area_light_emitted": {EMITTED},
}


@pytest.mark.parametrize("todo", TODOS)
def test_a_part_of_a_solution_earns_its_part(bench: Bench, todo: str) -> None:
    flags = ("-O2", f"-DTODO_{todo}")
    assert bench.failing(bench.module, "gcc", flags) == {bench.unit.name, *TODOS[todo]}


def test_the_stub_fails_all_but_lying_on_the_lamp(bench: Bench) -> None:
    flags = ("-O2", *(f"-DTODO_{todo}" for todo in TODOS))
    assert bench.failing(bench.module, "gcc", flags) == {bench.unit.name, *PROBES} - {PLACES}


MUTANTS = {
    "2 % too bright": ("(height * area)", "(1.02f * height * area)", DENSITY),
    "0.1 % too bright": ("(height * area)", "(1.001f * height * area)", DENSITY),
    "a larger lamp": ("random.x - 0.5f,", "1.001f * random.x - 0.5f,", PLACES),
    "a lamp beside it": ("random.y - 0.5f,", "random.y - 0.4999f,", PLACES),
    "a little crowded": ("random.x - 0.5f,", "powf(random.x, 1.1f) - 0.5f,", SPREAD),
    "a margin": ("random.x - 0.5f,", "0.97f * (random.x - 0.5f),", SPREAD),
    "edge on": ("!(height > 0.0f)", "!(height >= 0.0f)", DENSITY),
    "edge on shines": ("outgoing) > 0.0f", "outgoing) >= 0.0f", EMITTED),
    "one colour": ("> 0.0f ? radiance", "> 0.0f ? rgb_grey(radiance.g)", EMITTED),
}


@pytest.mark.parametrize("mutant", MUTANTS)
def test_small_faults_are_found(bench: Bench, mutant: str, tmp_path: Path) -> None:
    old, new, check = MUTANTS[mutant]
    assert bench.failures(bench.mutant(old, new, tmp_path), check, "gcc", ("-O1",))


# --- The oracle against another truth ---------------------------------------------------------


def by_quadrature(lamp: Any, side: int = 400) -> tuple[float, float]:
    """Solid angle and irradiance as sums over small patches."""
    center, x, y, normal = lamp.rect[:12].reshape(4, 3)
    at = (np.arange(side) + 0.5) / side - 0.5
    a, b = np.meshgrid(at, at)
    to_point = lamp.point - (center + a[..., None] * x + b[..., None] * y)
    distance = np.linalg.norm(to_point, axis=-1)
    patch = lamp.rect[12] / side**2
    seen = np.abs(to_point @ normal) / distance**3 * patch
    cosine = -(to_point @ lamp.normal) / distance
    assert cosine.min() > 0, f"{lamp.name}: a part of it is below the horizon"
    return float(seen.sum()), float((seen * cosine).sum())


FRONT = [la for la in Lamps._lamps() if (la.point - la.rect[:3]) @ la.rect[9:12] > 0]


@pytest.mark.parametrize("lamp", FRONT, ids=lambda la: la.name)
def test_closed_forms_agree_with_a_sum_over_patches(lamp: Any) -> None:
    solid_angle, irradiance = by_quadrature(lamp)
    assert Lamps.solid_angle(lamp.rect, lamp.point) == pytest.approx(solid_angle, rel=2e-4)
    assert Lamps.irradiance(lamp.rect, lamp.point, lamp.normal) == pytest.approx(
        irradiance, rel=2e-4
    )


def test_there_are_lamps_before_and_behind() -> None:
    assert len(FRONT) == 9 and len(Lamps._lamps()) == 12


@pytest.mark.parametrize("seed", range(1, 4))
def test_the_cases_are_of_all_kinds(bench: Bench, seed: int) -> None:
    words: Array = bench.cases(DENSITY, seed).context.words
    to_point = words[:, :3] - words[:, 3:6]
    distance = np.linalg.norm(to_point, axis=1)
    with np.errstate(invalid="ignore"):
        cosine = np.sum(to_point * words[:, 6:9], axis=1) / distance
    assert np.mean(cosine > 0.05) > 0.4 and np.mean(cosine < -1e-5) > 0.2
    assert np.mean((cosine > 1e-5) & (cosine < 0.02)) > 0.1
    assert distance.max() > 3e5 and distance[distance > 0].min() < 3e-6


# --- Words ------------------------------------------------------------------------------------


def test_a_failure_is_told_in_words(bench: Bench, tmp_path: Path) -> None:
    flat = bench.mutant("return distance * distance * distance / (height * area);",
                        "return distance * distance / area;", tmp_path)  # fmt: skip
    failures = bench.failures(flat, DENSITY)
    told = {f.message for f in failures}
    assert (
        "tilted: a cosine of 0.8, five metres away: point (3, 0, 4), on_light (0, 0, 0), "
        "normal (0, 0, 1), area 1: expected 31.25 per steradian, got 25"
    ) in told
    assert {f.fingerprint.split(":")[0] for f in failures} == {"wrong density"}


def test_an_uneven_spread_is_told_in_words(bench: Bench) -> None:
    flags = ("-O2", "-DTODO_rect_light_place")
    (first, *_) = bench.failures(bench.module, SPREAD, "gcc", flags)
    assert first.message.startswith("one metre in front of a square: rect with center (0, 0, 0)")
    assert "part 12 along side_x and 12 along side_y got 20000" in first.message
