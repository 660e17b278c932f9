"""Assignment 03 judges rightly, and counts rightly: what its probes see, and in which words.

What all assignments have in common is tested in test_every_probe.py and test_museum.py.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from probe_bench import COMPILERS, Bench, assignment_of, bench_fixture, right_modules

from raybook_grader.checks.cost import cost_oracle, share_of
from raybook_grader.checks.oracles import cases_of
from raybook_grader.course import CostCheck
from raybook_grader.probes import Failure

ASSIGNMENT = assignment_of("03")
RIGHT = right_modules(ASSIGNMENT)
EDGES, RANDOM, NEAREST, ANY = PROBES = (
    "trees of hand-picked boxes", "trees of random and huge sets", "nearest hits", "any hit"
)  # fmt: skip
TREE, WALK = "the tree costs little", "the walk costs little"
COSTS = {c.name: c for c in ASSIGNMENT.checks if isinstance(c, CostCheck)}

bench = bench_fixture(ASSIGNMENT)


def counted(
    bench: Bench, module: Path, name: str, cc: str = "gcc", level: str = "-O2", seed: int = -1
) -> float | list[Failure]:
    """What a module costs in one of the cost checks, or what is wrong with its answers."""
    check = COSTS[name]
    oracle = cost_oracle(ASSIGNMENT.folder / check.oracle)
    cases = cases_of(ASSIGNMENT.folder / check.oracle, check.group, max(seed, check.seed))
    output = bench.answers(check, cases, module, cc, (level,))
    return oracle.judge(cases, output) or oracle.cost(cases, output)


def ratio(bench: Bench, module: Path, name: str, **how: Any) -> float:
    cost, reference = counted(bench, module, name, **how), counted(bench, bench.module, name, **how)
    assert isinstance(cost, float) and isinstance(reference, float), cost
    return cost / reference


# --- What is right passes ---------------------------------------------------------------------


@pytest.mark.parametrize("module", RIGHT, ids=lambda file: file.stem)
def test_right_modules_pass_with_other_seeds(bench: Bench, module: Path) -> None:
    for seed in range(100, 106):
        for check in (NEAREST, ANY):
            assert bench.failures(module, check, seed=seed) == [], f"{check}, seed {seed}"


EARNED = {  # the least and the most of the tree's points; a walk earns all of its own
    "bvh": (1.0, 1.0),
    "sah-sweep": (1.0, 1.0),
    "sah-12-bins": (1.0, 1.0),
    "sah-one-a-leaf": (1.0, 1.0),
    "lbvh-morton": (0.85, 0.99),
    "median-quickselect": (0.4, 0.65),
}


@pytest.mark.parametrize("cc, level", COMPILERS)
@pytest.mark.parametrize("module", RIGHT, ids=lambda file: file.stem)
def test_right_modules_earn_what_the_rubric_says(
    bench: Bench, module: Path, cc: str, level: str
) -> None:
    ratios = {name: ratio(bench, module, name, cc=cc, level=level) for name in COSTS}
    shares = {n: share_of(ratios[n], c.full, c.none) for n, c in COSTS.items()}
    print(
        f"{module.stem:20} {cc:5} {level}  tree {ratios[TREE]:.3f} ({shares[TREE]:4.0%})  "
        f"walk {ratios[WALK]:.3f} ({shares[WALK]:4.0%})"
    )
    least, most = EARNED[module.stem]
    assert least <= shares[TREE] <= most
    assert shares[WALK] == 1


@pytest.mark.parametrize("module", RIGHT[1:], ids=lambda file: file.stem)
def test_other_seeds_give_the_same_share(bench: Bench, module: Path) -> None:
    """With room: a seed must not decide about points."""
    least, most = EARNED[module.stem]
    for seed in range(100, 104):
        tree = ratio(bench, module, TREE, seed=seed)
        assert least <= share_of(tree, COSTS[TREE].full, COSTS[TREE].none) <= most, seed
        assert ratio(bench, module, WALK, seed=seed) < COSTS[WALK].full - 0.03


# --- What is wrong fails ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("todo", "expected"), [("bvh_build", {EDGES, RANDOM}), ("bvh_traverse", {NEAREST, ANY})]
)
def test_half_a_solution_earns_its_half(bench: Bench, todo: str, expected: set[str]) -> None:
    flags = ("-O2", f"-DTODO_{todo}")
    assert {c for c in PROBES if bench.failures(bench.module, c, "gcc", flags)} == expected


MUTANTS = {
    "nodes one too few": ("return b.node_count;", "return b.node_count - 1;", EDGES),
    "a node too many": ("return b.node_count;", "return b.node_count + 1;", EDGES),
    "nodes for nothing": ("if (primitive_count == 0)\n        return 0;",
                          "if (primitive_count == 0)\n        return 1;", EDGES),
    "beyond order": ("    make_leaf(&b, 0, 0,", "    order[primitive_count] = 0;\n"
                     "    make_leaf(&b, 0, 0,", EDGES),
    "beyond nodes": ("    make_leaf(&b, 0, 0,", "    nodes[2 * primitive_count].count = 1;\n"
                     "    make_leaf(&b, 0, 0,", EDGES),
    "changes the boxes": ("    make_leaf(&b, 0, 0,", "    ((aabb *)boxes)[0].lower.x = 1.5f;\n"
                          "    make_leaf(&b, 0, 0,", EDGES),
    "a hidden memory": ("    make_leaf(&b, 0, 0,", "    static uint32_t calls;\n"
                        "    if (calls++ % 2 && primitive_count > 1) {\n"
                        "        order[0] = 1;\n        order[1] = 0;\n    }\n"
                        "    make_leaf(&b, 0, 0,", EDGES),
    "a leaf of 33": ("enum { BIN_COUNT = 16, LEAF_TARGET = 4 };",
                     "enum { BIN_COUNT = 16, LEAF_TARGET = 33 };", EDGES),
    "left box only": ("b->nodes[node].box = bounds_of(b, first, count);",
                      "b->nodes[node].box = bounds_of(b, first, (count + 1) / 2);", RANDOM),
    "children exchanged": ("    node->first = children;", "    node->first = children + 1;", EDGES),
    "returns the last": ("            found = true;", "            found = !found;", NEAREST),
    "never true": ("            found = true;", "            (void)found;", NEAREST),
    "another range": ("leaf->first, leaf->count, r", "leaf->first, leaf->count - 1, r", NEAREST),
    "another hit": ("leaf->count, r, hit)", "leaf->count, r, (char *)hit + 1)", NEAREST),
    "another ray": ("test(context, leaf->first, leaf->count, r, hit)",
                    "test(context, leaf->first, leaf->count, &(ray){r->origin, r->t_min, "
                    "r->direction, r->t_max, r->inverse_direction}, hit)", NEAREST),
    "writes the hit": ("    uint32_t node = 0;\n    float t_enter",
                       "    uint32_t node = 0;\n    *(uint32_t *)hit = 0;\n    float t_enter",
                       NEAREST),
    "changes t_min": ("    return found;\n}\n//< bvh.traverse.walk",
                      "    r->t_min = r->t_max;\n    return found;\n}\n//< bvh.traverse.walk",
                      NEAREST),
    "root only": ("inside = descend", "inside = node == 0 && descend", NEAREST),
    "drops one that waits": ("s->size++;", "s->size += s->size < 40;", NEAREST),
    "prunes too much": ("if (w.t_enter <= t_max)", "if (w.t_enter < 0.9f * t_max)", NEAREST),
    "asks for ever": ("} while (pop(&stack, r->t_max, &node));",
                      "} while (pop(&stack, r->t_max, &node) || found);", NEAREST),
    "any never stops": ("return walk(tree, r, test, context, hit, true);",
                        "return walk(tree, r, test, context, hit, false);", ANY),
    "any is never": ("return walk(tree, r, test, context, hit, true);",
                     "return walk(tree, r, test, context, hit, true) && false;", ANY),
}  # fmt: skip


@pytest.mark.parametrize("mutant", MUTANTS)
def test_small_faults_are_found(bench: Bench, mutant: str, tmp_path: Path) -> None:
    old, new, check = MUTANTS[mutant]
    assert bench.failures(bench.mutant(old, new, tmp_path), check, "gcc", ("-O1",))


TRICKS = {
    "a box test of one's own": "#define aabb_test aabb_intersect",
    "the counters turned back": (
        "#define aabb_test(box, r, t, u) \\\n"
        "    (counters_mine.boxes_tested--, aabb_test(box, r, t, u))"
    ),
}


@pytest.mark.parametrize("trick", TRICKS)
def test_work_that_is_not_counted_is_refused(bench: Bench, trick: str, tmp_path: Path) -> None:
    old = '#include "accel/aabb.h"'
    failures = counted(bench, bench.mutant(old, f"{old}\n{TRICKS[trick]}", tmp_path), WALK)
    assert isinstance(failures, list)
    assert {failure.fingerprint for failure in failures} == {"too few boxes counted"}


# --- The cases --------------------------------------------------------------------------------


@pytest.mark.parametrize("check", [NEAREST, ANY])
def test_rays_hit_and_miss_and_ask_on_the_way(bench: Bench, check: str) -> None:
    queries = [query for _, query in bench.cases(check).context.queries]
    hits = [[t for _, t in q.hits if q.t_min <= t <= q.t_max] for q in queries]
    assert len(queries) > 3500
    assert 0.2 < np.mean([bool(h) for h in hits]) < 0.8
    assert np.mean([len(h) > 1 for h in hits]) > 0.2
    assert np.mean([bool(q.kind & 2) for q in queries]) > 0.2, "walks within walks"
    assert np.mean([0.0 in q.direction for q in queries]) > 0.2, "along an axis or a plane"


# --- Words ------------------------------------------------------------------------------------


def test_failures_are_told_in_words(bench: Bench, tmp_path: Path) -> None:
    old = "        push(s, swap ? near : far, swap ? t_near : t_far);\n"
    deaf = bench.mutant(old, "        (void)push;\n        (void)s;\n", tmp_path)
    simplest = max(bench.failures(deaf, NEAREST), key=lambda f: f.simplicity)
    assert simplest.message.startswith(
        "only the far leaf is hit: two leaves, (0, 0, 0) to (1, 1, 1) and (2, 0, 0) to (3, 1, 1): "
        "bvh_nearest, ray from (-1, 0.5, 0.5) along (1, 0, 0), t in [0, inf]: "
        "expected a hit at t = 3.5, got none"
    )
    stub = bench.failures(bench.module, EDGES, "gcc", ("-O2", "-DTODO_bvh_build"))
    assert max(stub, key=lambda f: f.simplicity).message == (
        "33 boxes in a row: leaf 0 holds 33 primitives, expected 32 at most"
    )


def test_walks_that_share_their_state_are_told_apart(bench: Bench, tmp_path: Path) -> None:
    shared = bench.mutant("    struct stack stack;\n", "    static struct stack stack;\n", tmp_path)
    kinds = {f.fingerprint for f in bench.failures(shared, NEAREST)}
    assert "disturbed by another walk" in kinds
