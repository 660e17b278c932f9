"""Assignment 10's probes: are their oracles right, and what do they see?

What all assignments have in common is tested in test_every_probe.py and test_museum.py.
"""

from __future__ import annotations

import sys
from fractions import Fraction
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from probe_bench import Bench, assignment_of, bench_fixture, right_modules

from raybook_grader.checks.oracles import load_oracle

ASSIGNMENT = assignment_of("10")
RIGHT = right_modules(ASSIGNMENT)
PYRAMID, LEVEL, TRILINEAR, EWA = PROBES = [
    "every level is the mean of the image",
    "the level fits the footprint",
    "trilinear lookups",
    "elliptically weighted averages",
]


def _oracle(name: str) -> Any:
    return load_oracle(ASSIGNMENT.folder / "hidden" / f"oracle_{name}.py")


def _hidden(name: str) -> ModuleType:
    """A neighbour of the oracles, as they imported it."""
    for oracle in ("pyramid", "lookup", "ewa"):
        _oracle(oracle)
    return sys.modules[name]


bench = bench_fixture(ASSIGNMENT)


# --- What is right passes, what is half done fails by half ------------------------------------


@pytest.mark.parametrize("module", RIGHT, ids=lambda file: file.stem)
def test_right_modules_pass_with_other_seeds(bench: Bench, module: Path) -> None:
    for check in PROBES:
        assert bench.failures(module, check, seed=101) == [], check


@pytest.mark.parametrize(
    "todos, expected",
    [
        (("mipmap_pyramid",), {PYRAMID}),
        (("mipmap_level",), {LEVEL, TRILINEAR}),
        (("mipmap_trilinear",), {TRILINEAR}),
        (("mipmap_ewa",), {EWA}),
        (ASSIGNMENT.todos, set(PROBES)),
    ],
)
def test_a_stub_fails_its_own_probes(
    bench: Bench, todos: tuple[str, ...], expected: set[str]
) -> None:
    flags = ["-O1", *(f"-DTODO_{todo}" for todo in todos)]
    assert bench.failing(bench.module, "gcc", flags) == {bench.unit.name} | expected


MUTANTS = {
    "one texel for three": ("* from + to - 1) / to);", "* from) / to);", PYRAMID),
    "rows for columns": ("overlapped(y, from->height, to->height)",
                         "overlapped(y, from->width, to->width)", PYRAMID),
    "rounded up": ("size > 1 ? size / 2 : 1", "size > 1 ? (size + 1) / 2 : 1", PYRAMID),
    "not the last level": ("return count;", "return count > 1 ? count - 1 : 1;", PYRAMID),
    "level a tenth higher": ("log2(fmax(longer, 1.0))", "log2(fmax(1.02 * longer, 1.0))", LEVEL),
    "only uv_dx": ("fmax(length_in_texels(m, uv_dx), length_in_texels(m, uv_dy))",
                   "fmax(length_in_texels(m, uv_dx), 0.0 * uv_dy.x)", LEVEL),
    "the sum of both": ("fmax(length_in_texels(m, uv_dx), length_in_texels(m, uv_dy))",
                        "length_in_texels(m, uv_dx) + length_in_texels(m, uv_dy)", LEVEL),
    "the finer level alone": ("return rgb_mix(color, mipmap_bilinear(m, fine + 1, uv),",
                              "return rgb_mix(color, mipmap_bilinear(m, fine, uv),", TRILINEAR),
    "nearest": ("return rgb_mix(color, mipmap_bilinear(m, fine + 1, uv),",
                "return rgb_mix(color, mipmap_nearest(m, fine + 1, uv),", TRILINEAR),
    "a square for a bell": ("return float_max(expf(-2.0f * (float)distance2) - lowest, 0.0f);",
                            "return distance2 + lowest > 0.0 ? 1.0 : 0.0;", EWA),
    "a narrow bell": ("expf(-2.0f *", "expf(-6.0f *", EWA),
    "the mirrored ellipse": ("double slope = e.xy / e.yy", "double slope = -e.xy / e.yy", EWA),
    "beside the middle": ("uv.x, image->width) - 0.5;\n    double center_y",
                          "uv.x, image->width);\n    double center_y", EWA),
    "two levels too high": ("shortest / fewest_texels, 1.0",
                            "4.0 * shortest / fewest_texels, 1.0", EWA),
    "without a mix": ("return rgb_mix(color, ewa_on_level(m, fine + 1, uv, &e),",
                      "return rgb_mix(rgb_grey(0.5f), color,", EWA),
}  # fmt: skip


@pytest.mark.parametrize("mutant", MUTANTS)
def test_small_faults_are_found(bench: Bench, mutant: str, tmp_path: Path) -> None:
    old, new, check = MUTANTS[mutant]
    assert bench.failures(bench.mutant(old, new, tmp_path), check, "gcc", ("-O1",))


# --- The oracles ------------------------------------------------------------------------------


@pytest.mark.parametrize("size, parts", [(1, 1), (2, 1), (5, 2), (7, 3), (257, 128), (6, 3)])
def test_shares_are_exact_lengths(size: int, parts: int) -> None:
    shares = _hidden("mipmap_cases").shares(size, parts)
    for k in range(parts):
        begin, end = Fraction(k * size, parts), Fraction((k + 1) * size, parts)
        for i in range(size):
            inside = max(Fraction(0), min(end, Fraction(i + 1)) - max(begin, Fraction(i)))
            assert shares[k, i] == pytest.approx(float(inside * parts / size), abs=1e-13)


def test_means_of_steps_keep_the_mean_of_the_image() -> None:
    cases = _hidden("mipmap_cases")
    image = np.random.default_rng(3).random((31, 50, 3))
    for level in cases.pyramid(image):
        assert level.mean(axis=(0, 1)) == pytest.approx(image.mean(axis=(0, 1)))


def test_levels_by_hand() -> None:
    oracle, cases = _oracle("lookup"), _hidden("mipmap_cases")
    m = cases.Mipmap("m", 0, cases.pyramid(np.zeros((8, 128, 3))))
    nan = np.array([np.nan, 0.0])
    for dx, dy, level in [
        ((0, 0), (0, 0), 0),
        ((1 / 128, 0), (0, 1 / 8), 0),
        ((4 / 128, 0), (0, 1 / 8), 2),
        ((0, 4 / 8), (1 / 128, 0), 2),
        ((3 / 128, 4 / 8), (0, 0), np.log2(5)),
        ((100, 0), (0, 0), 7),
    ]:
        assert oracle.level_of(m, np.array(dx), np.array(dy)) == pytest.approx(level)
    assert oracle.level_of(m, nan, np.array([2 / 128, 0])) == pytest.approx(1)


@pytest.mark.parametrize("wrap", range(4))
def test_bilinear_by_hand(wrap: int) -> None:
    cases = _hidden("mipmap_cases")
    row = np.repeat(np.array([[[1.0], [5.0]]]), 3, axis=2)
    m = cases.Mipmap("m", wrap, (row,))
    at = [cases.bilinear(m, 0, np.array([u, 0.5]))[0] for u in (0.25, 0.5, 1.25, -0.25)]
    assert at == pytest.approx([[1, 3, 1, 5], [1, 3, 5, 1], [1, 3, 5, 1], [1, 3, 0, 0]][wrap])


@pytest.mark.parametrize("rho", [0.05, 0.2, 0.4, 0.7, 1.0])
def test_the_bounds_hold_the_gaussian(rho: float) -> None:
    """exp(-2 q) without an end has the transform exp(-pi^2 rho^2 / 2)."""
    bell = _hidden("mipmap_bell")
    least, largest = bell.damping(rho, rho, 1e-6, 1.0)
    gaussian = np.exp(-(np.pi**2) * rho**2 / 2)
    assert least - 0.002 < gaussian < largest
    assert largest - least < 0.35


def test_the_exact_integral_is_accepted(bench: Bench) -> None:
    """Not sums of texels but waves under the untruncated bell, by the closed form."""
    cases = bench.cases(EWA)
    output = np.zeros((cases.count, 3), "<f4")
    waves = []
    for i, lookup in enumerate(cases.context.lookups):
        m = cases.context.mipmaps[lookup.mipmap]
        if not m.name.endswith("waves"):
            continue
        waves.append(i)
        across, down = (float(word) for word in m.name.split()[0:3:2])
        steps = np.stack([lookup.uv_dx, lookup.uv_dy], axis=1) * m.size[:, None]
        axes, lengths, _ = np.linalg.svd(steps)
        lengths[1] = max(lengths[1], lengths[0] / lookup.max_anisotropy)
        k = np.array([across, down]) / m.size
        rho2 = float(np.sum((lengths * (axes.T @ k)) ** 2))
        wave = np.exp(2j * np.pi * (k @ (lookup.uv * m.size)) - np.pi**2 * rho2 / 2)
        output[i] = 0.5 + 0.5 * wave.real, 0.5 + 0.5 * wave.imag, 0.5
    wrong = {failure.case for failure in bench.judge(EWA, cases, output.tobytes())}
    assert len(waves) > 2000 and not wrong & set(waves)


@pytest.mark.parametrize("check", PROBES)
def test_there_are_enough_cases(bench: Bench, check: str) -> None:
    assert bench.cases(check).count >= (90 if check == PYRAMID else 3000)


# --- Words ------------------------------------------------------------------------------------


def test_failures_are_told_in_words(bench: Bench, tmp_path: Path) -> None:
    old = "log2(fmax(longer, 1.0))"
    module = bench.mutant(old, f"floor({old})", tmp_path)
    simplest = max(bench.failures(module, TRILINEAR), key=lambda failure: failure.simplicity)
    assert "mipmap of " in simplest.message and "expected" in simplest.message


def test_a_missing_level_is_told_in_words(bench: Bench, tmp_path: Path) -> None:
    module = bench.mutant("last->width > 1 ||", "last->width > 1 &&", tmp_path)
    simplest = max(bench.failures(module, PYRAMID), key=lambda failure: failure.simplicity)
    assert simplest.message == (
        "pyramid over a ramp of 2 x 1 texels: expected 2 levels (the last one is 1 x 1), got 1"
    )
    assert simplest.fingerprint == "number of levels"
