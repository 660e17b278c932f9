"""Assignment 02 judges rightly: what its probes see, and in which words.

What all assignments have in common is tested in test_every_probe.py and test_museum.py.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from probe_bench import Bench, assignment_of, bench_fixture, right_modules

from raybook_grader.cases import read_table

ASSIGNMENT = assignment_of("02")
RIGHT = right_modules(ASSIGNMENT)
EDGES, RANDOM, SHORT_WAYS = "edge cases", "entry and exit match exact arithmetic", (
    "no box that is crossed is lost"
)  # fmt: skip
PROBES = [EDGES, RANDOM, SHORT_WAYS]
TABLE = read_table(ASSIGNMENT.folder / "hidden" / "edges_aabb.txt")

bench = bench_fixture(ASSIGNMENT)


@pytest.mark.parametrize("module", RIGHT, ids=lambda file: file.stem)
def test_right_modules_pass_with_other_seeds(bench: Bench, module: Path) -> None:
    for seed in (100, 101, 102):
        for check in (RANDOM, SHORT_WAYS):
            assert bench.failures(module, check, seed=seed) == [], f"{check}, seed {seed}"


def test_the_stub_fails_everything_that_is_judged(bench: Bench) -> None:
    flags = ("-O2", "-DTODO_aabb_intersect")
    assert bench.failing(bench.module, "gcc", flags) == {bench.unit.name, *PROBES}


MUTANTS = {
    "touching misses": ("if (!(enter <= leave))", "if (!(enter * 1.000001f < leave))", EDGES),
    "0 for t_min": ("float enter = r->t_min,", "float enter = 0.0f,", RANDOM),
    "a little after t_min": ("float enter = r->t_min,", "float enter = r->t_min + 1e-4f,", RANDOM),
    "t_max halved": ("leave = r->t_max;", "leave = 0.5f * r->t_max;", RANDOM),
    "ends exchanged": ("*t_enter = enter;\n    *t_exit = leave;",
                       "*t_enter = leave;\n    *t_exit = enter;", RANDOM),
    "enter only": ("*t_exit = leave;", "(void)t_exit;", RANDOM),
    "x for y": ("box->lower.y, box->upper.y", "box->lower.x, box->upper.y", RANDOM),
    "no origin": ("box->upper.z, o.z, inverse.z", "box->upper.z, 0.0f, inverse.z", RANDOM),
    "no z": ("    clip_to_slab(box->lower.z, box->upper.z, o.z, inverse.z, &enter, &leave);\n", "",
             RANDOM),
    "exit off by 2e-5": ("6.0f * 0x1p-24f", "2e-5f", RANDOM),
    "entry off by 2e-5": ("- origin) * inverse;", "- origin) * inverse * 0.99998f;", RANDOM),
    "no negative zero": ("signbit(inverse)", "inverse < 0.0f && isfinite(inverse)", EDGES),
    "nan wins": ("t_near > *t_enter ? t_near : *t_enter", "t_near <= *t_enter ? *t_enter : t_near",
                 EDGES),
    "nan wins at the exit": ("t_far < *t_exit ? t_far : *t_exit",
                             "t_far >= *t_exit ? *t_exit : t_far", EDGES),
    "tighter by rounding": ("1.0f + 6.0f * 0x1p-24f", "1.0f - 4.0f * 0x1p-24f", SHORT_WAYS),
    "no margin": ("1.0f + 6.0f * 0x1p-24f", "1.0f", SHORT_WAYS),
    "changes the ray": ("    if (!(enter", "    ((ray *)r)->t_max = leave;\n    if (!(enter",
                        RANDOM),
}  # fmt: skip


@pytest.mark.parametrize("mutant", MUTANTS)
def test_small_faults_are_found(bench: Bench, mutant: str, tmp_path: Path) -> None:
    old, new, check = MUTANTS[mutant]
    assert bench.failures(bench.mutant(old, new, tmp_path), check, "gcc", ("-O1",))


# --- The cases --------------------------------------------------------------------------------


def test_exact_arithmetic_agrees_with_the_author(bench: Bench) -> None:
    """A module that always says false is wrong exactly where the table's first column says so."""
    cases = bench.cases(EDGES)
    assert len(TABLE) >= 80 and cases.count == 24 * len(TABLE)
    wrong = {f.case for f in bench.judge(EDGES, cases, bytes(16 * cases.count))}
    assert wrong == {case for case, row in enumerate(TABLE * 24) if row[0] == "hit"}


@pytest.mark.parametrize("seed", range(1, 4))
def test_most_random_cases_have_one_right_answer(bench: Bench, seed: int) -> None:
    context = bench.cases(RANDOM, seed).context
    assert np.mean(context.must_hit | ~context.may_hit) > 0.9
    assert np.mean(context.must_hit) > 0.3
    assert np.mean(~context.may_hit) > 0.3
    crossed = bench.cases(SHORT_WAYS, seed).context.must_hit
    assert np.mean(crossed) > 0.3, "too few rays cross the box beside its edge"


@pytest.mark.parametrize("axis", range(3))
def test_zeros_of_both_signs_occur(bench: Bench, axis: int) -> None:
    for check in (EDGES, RANDOM):
        component = bench.cases(check).context.direction[:, axis]
        zeros = component[component == 0]
        assert 20 < np.sum(np.signbit(zeros)) < len(zeros) - 20


# --- Words ------------------------------------------------------------------------------------


def test_a_failure_is_told_in_words(bench: Bench, tmp_path: Path) -> None:
    endless = bench.mutant("leave = r->t_max;", "leave = INFINITY;", tmp_path)
    told = {f.fingerprint: f.message for f in bench.failures(endless, EDGES)}
    assert told["wrong t_exit: clipped"].startswith("clipped: ")
    assert any(
        f.message.startswith(
            "inside: a range of one point: ray from (1, 1, 3) along (1, 0.25, 0.25), t in [0, 0], "
            "box from (0, 0, 0) to (4, 2, 6): expected a hit from t = 0 to 0, got a hit from t = 0"
        )
        for f in bench.failures(endless, EDGES)
    )


def test_ends_out_of_order_by_a_last_digit_are_found(bench: Bench, tmp_path: Path) -> None:
    late = bench.mutant("*t_exit = leave;", "*t_exit = leave * slack;", tmp_path)
    told = {f.fingerprint: f.message for f in bench.failures(late, EDGES)}
    assert told["not in order: clipped"].endswith(
        "expected t_min <= t_enter <= t_exit <= t_max, got a hit from t = 2 to 3.000001"
    )
