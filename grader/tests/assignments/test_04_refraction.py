"""Assignment 04 judges rightly: what its probes see, and in which words.

What all assignments have in common is tested in test_every_probe.py and test_museum.py.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from probe_bench import ROOT, Bench, assignment_of, bench_fixture, name_of, right_modules

from raybook_grader.cases import read_table
from raybook_grader.checks.oracles import load_oracle

ASSIGNMENT = assignment_of("04")
RIGHT = right_modules(ASSIGNMENT)
REFRACTION, INTEGRATOR = (ROOT / path for path in ASSIGNMENT.owned)
EDGES, RANDOM = "refraction at hand-picked angles", "refraction at random angles"
MIRRORS, GLASS = "rays through halls of mirrors", "rays through glass"
UNITS = ["public tests of refraction", "public tests of the integrator"]
TABLE = read_table(ASSIGNMENT.folder / "hidden" / "edges_refraction.txt")
ANSWERS = {"through": (True, False), "mirrored": (False, True), "either": (True, True)}

bench = bench_fixture(ASSIGNMENT)


@pytest.mark.parametrize("module", RIGHT, ids=name_of)
def test_right_modules_pass_with_other_seeds(bench: Bench, module: Path) -> None:
    own = RANDOM if module.name == REFRACTION.name else MIRRORS
    for seed in range(100, 103):
        for check in (own, GLASS):
            assert bench.failures(module, check, seed=seed) == [], f"{check}, seed {seed}"


@pytest.mark.parametrize(
    "todo, module, expected",
    [
        ("refraction_direction", REFRACTION, {UNITS[0], EDGES, RANDOM, GLASS}),
        ("intersection_test", INTEGRATOR, {UNITS[1], MIRRORS, GLASS}),
    ],
)
def test_half_a_solution_earns_its_half(
    bench: Bench, todo: str, module: Path, expected: set[str]
) -> None:
    assert bench.failing(module, "gcc", ("-O2", f"-DTODO_{todo}")) == expected


MUTANTS = {
    "grazing is inside": ("normal) >= 0.0f", "normal) > 0.0f", REFRACTION, EDGES),
    "the exact formula's sign": ("(1.0f - ratio)", "(ratio - 1.0f)", REFRACTION, EDGES),
    "no square": ("(ratio * cosine) * (ratio * cosine)", "(ratio * cosine)", REFRACTION, EDGES),
    "half a degree": ("passes = cosine2_beyond > 0.0f", "passes = cosine2_beyond > 1e-3f",
                      REFRACTION, RANDOM),
    "0.01 % more index": ("1.0f / eta_inside_over_outside", "1.0001f / eta_inside_over_outside",
                          REFRACTION, RANDOM),
    "along kept": ("vec3_scale(along, -ratio)", "vec3_scale(along, ratio)", REFRACTION, EDGES),
    "root along the normal": ("-sqrtf(cosine2_beyond)", "sqrtf(cosine2_beyond)", REFRACTION, EDGES),
    "mirror downwards": ("vec3_negate(along), cosine", "vec3_negate(along), -cosine", REFRACTION,
                         EDGES),
    "mirror straight back": ("vec3_negate(along)", "along", REFRACTION, EDGES),
    "answers exchanged": ("return passes", "return !passes", REFRACTION, EDGES),
    "one more": ("passed <= t", "passed <= 1 + t", INTEGRATOR, MIRRORS),
    "the first depth": ("int passed = 0", "int passed = 1", INTEGRATOR, MIRRORS),
    "grey": ("rgb_mul(throughput, way.weight)", "rgb_scale(throughput, way.weight.g)", INTEGRATOR,
             MIRRORS),
    "never white": ("throughput = rgb_grey(1.0f)", "throughput = rgb_grey(0.99f)", INTEGRATOR,
                    MIRRORS),
    "grey where it ends": ("return rgb_grey(0.0f);\n#else", "return rgb_grey(1e-3f);\n#else",
                           INTEGRATOR, MIRRORS),
    "light on the way": ("return rgb_grey(0.0f);\n#else", "return throughput;\n#else",
                         INTEGRATOR, MIRRORS),
}  # fmt: skip


@pytest.mark.parametrize("mutant", MUTANTS)
def test_small_faults_are_found(bench: Bench, mutant: str, tmp_path: Path) -> None:
    old, new, module, check = MUTANTS[mutant]
    assert bench.failures(bench.mutant(old, new, tmp_path, module), check, "gcc", ("-O1",))


# --- The cases --------------------------------------------------------------------------------


def test_the_oracle_agrees_with_the_author(bench: Bench) -> None:
    """What the table's first column says is right, and nothing else."""
    right = bench.cases(EDGES).context.right
    expected = [ANSWERS[row[0]] for row in TABLE * 3]
    assert list(zip(right.through, right.mirrored, strict=True)) == expected
    assert len(TABLE) >= 60


def test_the_oracle_obeys_the_laws(bench: Bench) -> None:
    """The same sine times index on both sides, in one plane, of length one; or a mirror."""
    context = bench.cases(RANDOM).context
    n, o = (v / np.linalg.norm(v, axis=1)[:, None] for v in (context.normal, context.outgoing))
    right, ratio = context.right, np.where(context.right.outside, 1 / context.eta, context.eta)
    own = np.sum(o * n, axis=1)
    passes = ~right.mirrored
    beyond, mirror = right.beyond[passes], right.mirror
    for vectors in (beyond, mirror):
        assert np.allclose(np.linalg.norm(vectors, axis=1), 1, rtol=0, atol=1e-13)
    law = np.cross(beyond, n[passes]) + ratio[passes, None] * np.cross(o, n)[passes]
    assert np.abs(law).max() < 1e-12
    assert (np.sum(beyond * n[passes], axis=1) * own[passes] < 0).all()
    assert np.allclose(np.sum(mirror * n, axis=1), own, rtol=0, atol=1e-13)
    assert np.allclose(mirror + o, 2 * own[:, None] * n, rtol=0, atol=1e-13)


def test_most_random_angles_have_one_narrow_answer(bench: Bench) -> None:
    right = bench.cases(RANDOM).context.right
    sure = right.through ^ right.mirrored
    assert np.mean(sure) > 0.9
    assert min(np.mean(right.through & sure), np.mean(right.mirrored & sure)) > 0.2
    assert np.median(right.beyond_error[right.through & sure]) < 1e-5


@pytest.mark.parametrize("check", [MIRRORS, GLASS])
def test_ways_of_all_kinds_occur(bench: Bench, check: str) -> None:
    context = bench.cases(check).context
    oracle = vars(load_oracle(ASSIGNMENT.folder / bench.probes[check].oracle))
    needed = list(oracle["BLACK"]) if check == MIRRORS else [oracle["TOO_DEEP"], oracle["UNLIT"]]
    assert np.bincount(context.end, minlength=7)[needed].min() >= 6
    lit = context.radiance.any(axis=1)
    assert lit.sum() > 700
    deep = [len(met) for met, shines in zip(context.met, lit, strict=True) if shines]
    assert np.mean(np.array(deep) >= 3) > 0.25
    allowed = context.tolerance[lit].max(axis=1) / context.radiance[lit].max(axis=1)
    assert np.median(allowed) < 3e-4 and allowed.max() < 0.01


# --- Words ------------------------------------------------------------------------------------


def test_a_failure_is_told_in_words(bench: Bench, tmp_path: Path) -> None:
    mutant = bench.mutant("return passes", "return true", tmp_path, REFRACTION)
    told = [f.message for f in bench.failures(mutant, EDGES)]
    assert (
        "total reflection: 45 degrees in glass: normal (0, 0, 1), outgoing (0.70710677, 0, "
        "-0.70710677), eta_inside_over_outside 1.5 (outgoing is inside, 45 degrees from the "
        "normal): expected false and (-0.70710677, 0, -0.70710677), got true and (-0.7071068, 0, "
        "-0.7071068): Snell's law has no solution"
    ) in told


def test_a_way_is_told_in_words(bench: Bench, tmp_path: Path) -> None:
    mutant = bench.mutant("passed <= t", "passed < t", tmp_path, INTEGRATOR)
    failures = bench.failures(mutant, MIRRORS)
    simplest = max(failures, key=lambda failure: failure.simplicity)
    assert simplest.fingerprint == "black: behind one clear surface"
    assert simplest.message == (
        "mirrors in a row: max_depth 1, a ray from (10, 20, 30) along (0.7066653, 0.7066653, "
        "-0.03533326) meets a rect of index 10 (object 0) that mirrors it, then a diffuse rect "
        "(object 2): expected (2.4677424, 2.284947, 1.4806455), got (0, 0, 0)"
    )
