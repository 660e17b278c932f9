"""Assignment 01 judges rightly: what its probes see, and in which words.

What all assignments have in common is tested in test_every_probe.py and test_museum.py.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from probe_bench import Bench, assignment_of, bench_fixture, right_modules

from raybook_grader.cases import read_table

ASSIGNMENT = assignment_of("01")
FOLDER = ASSIGNMENT.folder
RIGHT = right_modules(ASSIGNMENT)
TODOS = ASSIGNMENT.todos
UNIT = "public unit tests"
EDGES, RANDOM = "edge cases", "hits match exact arithmetic"
DEGENERATE, DIFFERENTIALS = "triangles without area", "texture differentials"
PROBES = [EDGES, RANDOM, DEGENERATE, DIFFERENTIALS]

bench = bench_fixture(ASSIGNMENT)


# --- What is right passes ---------------------------------------------------------------------


@pytest.mark.parametrize("module", RIGHT, ids=lambda file: file.stem)
def test_right_modules_pass_with_other_seeds(bench: Bench, module: Path) -> None:
    for check in (RANDOM, DEGENERATE, DIFFERENTIALS):
        for seed in (100, 101, 102):
            assert bench.failures(module, check, seed=seed) == [], f"{check}, seed {seed}"


# --- What is wrong fails, and where it should -------------------------------------------------


MUTANTS = {
    "b1 open": ("b1 >= -slack", "b1 > 0.0", EDGES),
    "b2 open": ("b2 >= -slack", "b2 > 0.0", EDGES),
    "sum open": ("b1 + b2 <= 1.0 + slack", "b1 + b2 < 1.0", EDGES),
    "t_min open": ("t >= (double)r->t_min", "t > (double)r->t_min", EDGES),
    "t_max open": ("t <= (double)r->t_max", "t < (double)r->t_max", EDGES),
    "no t_max": (" && t <= (double)r->t_max", "", RANDOM),
    "0 for t_min": ("t >= (double)r->t_min", "t >= 0.0", RANDOM),
    "an epsilon for t_min": ("t >= (double)r->t_min", "t > 1e-3", RANDOM),
    "square": ("b1 + b2 <= 1.0 + slack", "b1 <= 1.0 && b2 <= 1.0", RANDOM),
    "slack": ("b1 >= -slack", "b1 >= -1e-3", RANDOM),
    "less slack": ("b1 >= -slack", "b1 >= -4.9e-4", EDGES),
    "weights exchanged": ("hit->b1 = (float)b1", "hit->b1 = (float)b2", RANDOM),
    "weight of p0": ("hit->b1 = (float)b1", "hit->b1 = (float)(1.0 - b1 - b2)", RANDOM),
    "distance for t": (
        "hit->t = (float)t",
        "hit->t = (float)t * vec3_length(r->direction)",
        RANDOM,
    ),
    "t off by 0.1 %": ("hit->t = (float)t", "hit->t = (float)(t * 1.001)", RANDOM),
    "writes first": ("    bool inside", "    hit->t = (float)t;\n    bool inside", RANDOM),
    "changes the ray": (
        "    bool inside",
        "    ((ray *)r)->t_max = (float)t;\n    bool inside",
        RANDOM,
    ),
    "smaller epsilon": ("inverse != 0.0", "fabs(determinant) > 1e-8", RANDOM),
    "grazing": (
        "inverse != 0.0",
        "fabs(determinant) > 0.02 * sqrt(dot(normal, normal) * dot(direction, direction))",
        RANDOM,
    ),
    "back only": ("inverse != 0.0", "determinant > 0.0", EDGES),
    "sum of products": ("du1 * dv2 - du2 * dv1", "du1 * dv2 + du2 * dv1", DIFFERENTIALS),
    "no division": ("float k = 1.0f / determinant", "float k = 1.0f", DIFFERENTIALS),
    "uv epsilon": ("determinant == 0.0f", "fabsf(determinant) < 1e-6f", DIFFERENTIALS),
    "vectors exchanged": ("*dp_du = u_axis", "*dp_du = v_axis", DIFFERENTIALS),
    "lost sign": ("*dp_dv = v_axis", "*dp_dv = vec3_negate(v_axis)", DIFFERENTIALS),
    "unit length": ("*dp_du = u_axis", "*dp_du = vec3_normalize(u_axis)", DIFFERENTIALS),
    "dp_du not finite": ("!vec3_is_finite(u_axis) ||", "", DIFFERENTIALS),
    "dp_dv not finite": ("|| !vec3_is_finite(v_axis)", "", DIFFERENTIALS),
    "writes first too": ("    float k =", "    dp_du->x = 0.0f;\n    float k =", DIFFERENTIALS),
}


@pytest.mark.parametrize("mutant", MUTANTS)
def test_small_faults_are_found(bench: Bench, mutant: str, tmp_path: Path) -> None:
    old, new, check = MUTANTS[mutant]
    assert bench.failures(bench.mutant(old, new, tmp_path), check, "gcc", ("-O1",))


def test_the_stub_fails_its_tests(bench: Bench) -> None:
    flags = ["-O2", *(f"-DTODO_{todo}" for todo in TODOS)]
    # A module that never reports a hit is right about triangles that have none.
    assert bench.failing(bench.module, "gcc", flags) == {UNIT, *PROBES} - {DEGENERATE}


@pytest.mark.parametrize(
    "todo, expected",
    [(TODOS[0], {UNIT, EDGES, RANDOM}), (TODOS[1], {UNIT, DIFFERENTIALS})],
)
def test_half_a_solution_earns_its_half(bench: Bench, todo: str, expected: set[str]) -> None:
    assert bench.failing(bench.module, "gcc", ["-O2", f"-DTODO_{todo}"]) == expected


# --- The cases --------------------------------------------------------------------------------


def table(name: str) -> list[list[str]]:
    return read_table(FOLDER / "hidden" / name)


def test_there_are_enough_cases(bench: Bench) -> None:
    assert len(table("edges_triangle.txt")) >= 60
    assert bench.cases(EDGES).count == 3 * len(table("edges_triangle.txt"))
    assert bench.cases(RANDOM).count >= 5000
    assert bench.cases(DIFFERENTIALS).count >= 1000 + 3 * len(table("edges_differentials.txt"))


@pytest.mark.parametrize("seed", range(1, 4))
def test_most_random_cases_have_one_right_answer(bench: Bench, seed: int) -> None:
    context = bench.cases(RANDOM, seed).context
    decided = context.must_hit | ~context.may_hit
    assert np.mean(decided) > 0.8
    assert np.mean(context.must_hit) > 0.3
    assert np.mean(~context.may_hit) > 0.3
    # The weights' tolerance is near what the contract names for a good half of them.
    assert np.median(context.b_error[context.must_hit, 1:]) < 3e-4


@pytest.mark.parametrize(
    "check, file, words, positive",
    [
        (EDGES, "edges_triangle.txt", 5, "hit"),
        (DIFFERENTIALS, "edges_differentials.txt", 8, "answer"),
    ],
)
def test_exact_arithmetic_agrees_with_the_author(
    bench: Bench, check: str, file: str, words: int, positive: str
) -> None:
    """A module that always says false is wrong exactly where the table's first column says so."""
    cases = bench.cases(check)
    rows = table(file) * 3
    failures = bench.judge(check, cases, bytes(4 * words * cases.count))
    wrong = {failure.case for failure in failures if failure.case < len(rows)}
    assert wrong == {case for case, row in enumerate(rows) if row[0] == positive}


# --- Words ------------------------------------------------------------------------------------


def test_a_failure_is_told_in_words(bench: Bench, tmp_path: Path) -> None:
    failures = bench.failures(bench.mutant("b2 >= -slack", "b2 > 0.0", tmp_path), EDGES)
    simplest = max(failures, key=lambda failure: failure.simplicity)
    assert simplest.message == (
        "edge: the middle of p0 p1 (b2 = 0): ray from (1, 0, 5) along (0, 0, -1), t in [0, inf], "
        "triangle (0, 0, 0) (2, 0, 0) (0, 2, 0): "
        "expected a hit at t = 5, b1 = 0.5, b2 = 0, got none"
    )
    assert simplest.fingerprint == "missed: edge"
