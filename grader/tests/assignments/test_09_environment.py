"""Assignment 09 judges rightly: what its probes see, and in which words.

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

ASSIGNMENT = assignment_of("09")
RIGHT = right_modules(ASSIGNMENT)
RADIANCE, DENSITY, SAMPLES, GLOW, SUNS = (
    "radiance of a direction", "density over the sphere", "directions follow the density",
    "little noise under a glow", "little noise under a sun",
)  # fmt: skip
PROBES = [RADIANCE, DENSITY, SAMPLES, GLOW, SUNS]
HIDDEN = ASSIGNMENT.folder / "hidden"
Noise: Any = load_oracle(HIDDEN / "oracle_noise.py")
Lookup: Any = load_oracle(HIDDEN / "oracle_radiance.py")
Sampling: Any = load_oracle(HIDDEN / "oracle_sampling.py")

Array = NDArray[np.float64]

bench = bench_fixture(ASSIGNMENT)


def test_these_are_the_probes(bench: Bench) -> None:
    assert list(bench.probes) == PROBES


@pytest.mark.parametrize("module", RIGHT, ids=lambda file: file.stem)
def test_right_modules_pass_with_another_seed(bench: Bench, module: Path) -> None:
    for check in PROBES:
        assert bench.failures(module, check, seed=100) == [], check


def test_the_stub_picks_rightly_but_not_well(bench: Bench) -> None:
    """Even directions are right: what is missing are the map and the table."""
    flags = ("-O2", "-DTODO_environment")
    assert bench.failing(bench.module, "gcc", flags) == {bench.unit.name, RADIANCE, GLOW, SUNS}


MUTANTS = {
    "v off by a twentieth": ("image->height + 0.5f;", "image->height + 0.55f;", RADIANCE),
    "no clamp below": ("? y : image->height - 1;", "? y : 0;", RADIANCE),
    "clamp in u": ("phi < 0.0f ? 1.0f : 0.0f", "phi < 0.0f ? 0.999f : 0.0f", RADIANCE),
    "1 % too bright": ("rgb_scale(color, e->scale)", "rgb_scale(color, 1.01f * e->scale)",
                       RADIANCE),
    "1 % too dense": ("(lower - upper)) / total)", "(lower - upper)) / (0.99 * total))", DENSITY),
    "pole rows": ("fmin(fmax(v, 0.0), 1.0)", "fmin(fmax(v, -0.1), 1.1)", DENSITY),
    "even in theta": ("(float)fmin(fmax(b, 0.0), 1.0)", "(float)b + 0.2f", SAMPLES),
    "even in patches": ("warp_bilinear(in_patch, corners)", "in_patch", SAMPLES),
    "a fixed place": ("+ 0.5f + at.x)", "+ 1.0f)", SAMPLES),
    "not of length one": ("vec3_normalize(transform", "vec3_scale(transform", SAMPLES),
    "flat powers": ("0.25f * (c[0] + c[1] + c[2] + c[3]) * solid_angle", "solid_angle", SAMPLES),
}  # fmt: skip


@pytest.mark.parametrize("mutant", MUTANTS)
def test_small_faults_are_found(bench: Bench, mutant: str, tmp_path: Path) -> None:
    old, new, check = MUTANTS[mutant]
    module = bench.mutant(old, new, tmp_path)
    if "vec3_scale" in new:
        text = module.read_text()
        module.write_text(text.replace("&e->to_world, local));", "&e->to_world, local), 0.999f);"))
    assert bench.failures(module, check, "gcc", ("-O1",))


# --- The oracles against another truth --------------------------------------------------------


def test_the_lookup_agrees_with_an_interpolation_of_scipy() -> None:
    """The map laid out three times side by side, its outer rows twice: no border is left."""
    from scipy.interpolate import RegularGridInterpolator

    (m, *_) = (b.map for b in Lookup.make_cases("radiance", 1).context if b.map.width > 10)
    t = m.image.astype(float)
    wide = np.concatenate([t, t, t], axis=1)
    wide = np.concatenate([wide[:1], wide, wide[-1:]])
    x = np.arange(3 * m.width) - m.width + 0.5
    y = np.concatenate([[-1.0], np.arange(m.height) + 0.5, [m.height + 1.0]])
    reads = RegularGridInterpolator((y, x), wide)
    rng = np.random.default_rng(3)
    theta, phi = np.arccos(rng.uniform(-1, 1, 500)), rng.uniform(0, 2 * np.pi, 500)
    local = np.stack(
        [np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=1
    )
    want = reads(np.stack([theta / np.pi * m.height, phi / (2 * np.pi) * m.width], axis=1))
    got = Lookup.radiance(m, m.to_world(local))
    assert got == pytest.approx(want * m.scale, abs=1e-4)


@pytest.mark.parametrize("check", [GLOW, SUNS])
def test_noise_is_one_for_the_best_density_and_more_for_others(bench: Bench, check: str) -> None:
    _, blocks, grids = bench.cases(check).context
    for block, grid in zip(blocks, grids, strict=True):
        assert grid.solid.sum() == pytest.approx(4 * np.pi)
        light: Array = Noise.radiance(block.map, block.directions) @ Noise.LUMINANCE
        best = light / (light @ grid.solid)
        assert Noise.noise(light, best, grid.solid) == pytest.approx(1)
        half = 0.5 * best + 0.5 / (4 * np.pi)
        even = np.full_like(best, 1 / (4 * np.pi))
        noises = [Noise.noise(light, d, grid.solid) for d in (best, half, even)]
        assert noises == sorted(noises)
        assert noises[1] <= 2.0001  # half of the picks are the best ones
        assert noises[2] > (50 if check == SUNS else 3)


def test_the_noise_is_that_of_estimates() -> None:
    """Of L / p over even directions, found by chance, for a glow."""
    _, (block, *_), (grid, *_) = Noise.make_cases("glow", 1).context
    light = Noise.radiance(block.map, block.directions) @ Noise.LUMINANCE
    even = np.full_like(light, 1 / (4 * np.pi))
    rng = np.random.default_rng(1)
    directions = rng.normal(size=(200000, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    values = Noise.radiance(block.map, directions) @ Noise.LUMINANCE
    found = np.mean(values**2) / np.mean(values) ** 2
    assert Noise.noise(light, even, grid.solid) == pytest.approx(found, rel=0.03)


def test_half_of_the_maps_are_turned_and_some_are_mirrored(bench: Bench) -> None:
    for check in (RADIANCE, DENSITY):
        context = bench.cases(check).context
        blocks = context if check == RADIANCE else context[1]
        rotations = [block.map.rotation for block in blocks]
        assert sum(not np.array_equal(r, np.eye(3)) for r in rotations) >= 6
        assert sum(np.linalg.det(r) < 0 for r in rotations) >= 1


# --- Words ------------------------------------------------------------------------------------


def test_a_failure_is_told_in_words(bench: Bench) -> None:
    flags = ("-O2", "-DTODO_environment")
    failures = bench.failures(bench.module, RADIANCE, "gcc", flags)
    simplest = max(failures, key=lambda failure: failure.simplicity)
    assert simplest.message.startswith("two ")
    assert "of the map: expected radiance (" in simplest.message
    (first, *_) = bench.failures(bench.module, SUNS, "gcc", flags)
    assert "times as many directions as the best density would, expected at most 8" in first.message


def test_two_densities_are_told_in_words(bench: Bench, tmp_path: Path) -> None:
    module = bench.mutant("return environment_pdf(e, *direction);",
                          "return 2.0f * environment_pdf(e, *direction);", tmp_path)  # fmt: skip
    told = bench.failures(module, SAMPLES)
    assert {f.fingerprint for f in told} == {"two densities"}
    assert any("a constant map: a map of 8 x 4 texels: random (" in f.message for f in told)
    assert all("expected the same density twice" in f.message for f in told)
