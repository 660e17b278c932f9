"""Assignment 03 judges rightly, with any compiler, any seed and any answer, and counts rightly.

That each mistake fails what it announces is tested for all assignments in test_museum.py.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from probe_bench import COMPILERS, Bench, assignment_of, right_modules, run

from raybook_grader.checks.cost import cost_oracle, share_of
from raybook_grader.checks.oracles import cases_of, load_oracle
from raybook_grader.course import CostCheck
from raybook_grader.probes import Cases, Failure

ASSIGNMENT = assignment_of("03")
RIGHT = right_modules(ASSIGNMENT)
EDGES, RANDOM, NEAREST, ANY = PROBES = (
    "trees of hand-picked boxes", "trees of random and huge sets", "nearest hits", "any hit"
)  # fmt: skip
TREE, WALK = "the tree costs little", "the walk costs little"
COSTS = {c.name: c for c in ASSIGNMENT.checks if isinstance(c, CostCheck)}
HIDDEN = ASSIGNMENT.folder / "hidden"

Array = NDArray[np.float64]


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Bench:
    return Bench(tmp_path_factory.mktemp("bvh"), ASSIGNMENT)


def part(name: str) -> ModuleType:
    """One of the modules beside the oracles, which load them by their bare names."""
    load_oracle(HIDDEN / "oracle_walk.py")
    load_oracle(HIDDEN / "oracle_tree.py")
    return sys.modules[name]


def counted(
    bench: Bench, module: Path, name: str, cc: str = "gcc", level: str = "-O2", seed: int = -1
) -> float | list[Failure]:
    """What a module costs in one of the cost checks, or what is wrong with its answers."""
    check = COSTS[name]
    oracle = cost_oracle(ASSIGNMENT.folder / check.oracle)
    cases = cases_of(ASSIGNMENT.folder / check.oracle, check.group, max(seed, check.seed))
    driver = bench.program(ASSIGNMENT.folder / check.driver, module, cc, (level,))
    given, results = bench.folder / "cases.bin", bench.folder / "results.bin"
    given.write_bytes(cases.payload)
    run(str(driver), str(given), str(results), check.group)
    output = results.read_bytes()
    return oracle.judge(cases, output) or oracle.cost(cases, output)


def ratio(bench: Bench, module: Path, name: str, **how: Any) -> float:
    cost, reference = counted(bench, module, name, **how), counted(bench, bench.module, name, **how)
    assert isinstance(cost, float) and isinstance(reference, float), cost
    return cost / reference


# --- What is right passes ---------------------------------------------------------------------


@pytest.mark.parametrize("cc, level", COMPILERS)
@pytest.mark.parametrize("module", RIGHT, ids=lambda file: file.stem)
def test_right_modules_pass(bench: Bench, module: Path, cc: str, level: str) -> None:
    for check in PROBES:
        assert bench.failures(module, check, cc, (level,)) == [], check


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


def test_a_forged_count_is_refused() -> None:
    """Whoever writes over the driver's counters can claim the least possible, and no less."""
    oracle = cost_oracle(HIDDEN / "oracle_walk.py")
    cases = cases_of(HIDDEN / "oracle_walk.py", "walk-cost", 6)
    words = np.frombuffer(right_answers(cases), "<u4").reshape(-1, 7).copy()
    least = np.concatenate([np.stack(work, axis=1) for work in cases.context.least])
    words[:, 4:6] = np.ceil(least)
    assert oracle.judge(cases, words.tobytes()) == []
    words[np.argmax(least[:, 0]), 4] -= 1
    (failure,) = oracle.judge(cases, words.tobytes())
    assert failure.fingerprint == "too few triangles counted"


def right_answers(cases: Cases) -> bytes:
    """What a walk answers that knows the hits."""
    rows = []
    for _, query in cases.context.queries:
        hits = sorted((t, i) for i, t in query.hits if query.t_min <= t <= query.t_max)
        t, i = hits[0] if hits else (np.inf, 0xFFFFFFFF)
        bits = int(np.float32(t).view(np.uint32))
        rows.append((bool(hits), i, bits, bits, 0, 0, 0))
    return np.array(rows, "<u4").tobytes()


# --- The oracles against an independent truth ---------------------------------------------------


def scene_of(seed: int, number: int) -> Any:
    return list(part("bvh_mesh").scenes(np.random.default_rng(seed)))[number]


@pytest.mark.parametrize("number", range(3))
def test_the_meshes_hits_are_those_of_testing_every_triangle(
    number: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    mesh = part("bvh_mesh")
    kept: list[Array] = []
    meet = mesh._meet

    def keep(*ask: Array) -> Array:
        kept.append(meet(*ask))
        return kept[-1]

    build = mesh.build
    monkeypatch.setattr(mesh, "build", lambda *ask: one_leaf(ask[0]) if build(*ask) else None)
    monkeypatch.setattr(mesh, "RAYS", 40)
    monkeypatch.setattr(mesh, "_meet", keep)
    scene = scene_of(9, number)
    assert len(kept[number]) == 40 * len(scene.boxes), "one leaf: every ray meets every triangle"
    monkeypatch.undo()
    monkeypatch.setattr(mesh, "RAYS", 40)
    with_tree = scene_of(9, number)
    assert np.array_equal(scene.nearest, with_tree.nearest)
    assert np.isfinite(scene.nearest).sum() > 5


def one_leaf(boxes: NDArray[np.float32]) -> tuple[Any, NDArray[np.int64]]:
    nodes = np.zeros(1, part("bvh_tree").NODE)
    nodes["box"], nodes["count"] = [[-1e9] * 3, [1e9] * 3], len(boxes)
    return nodes, np.arange(len(boxes))


@pytest.mark.parametrize("number", range(3))
def test_hits_lie_in_their_triangles_boxes(number: int) -> None:
    scene = scene_of(4, number)
    at = scene.rays.origin[scene.hit_ray]
    at = at + scene.hit_t[:, None] * scene.rays.direction[scene.hit_ray]
    box = scene.boxes[scene.hit_triangle].astype(np.float64)
    room = 1e-5 * np.abs(box).max()
    assert (box[:, 0] - room <= at).all() and (at <= box[:, 1] + room).all()
    assert len(at) > 400


def test_visits_are_those_of_a_plain_walk() -> None:
    walk, scene = part("bvh_walk"), scene_of(5, 1)
    rays = replace(scene.rays, t_max=scene.nearest)
    seen = walk.visit(scene.nodes, rays)
    boxes, primitives = seen.boxes(len(rays)), seen.primitives(scene.nodes, len(rays))
    for i in range(0, len(rays), 60):
        plain = plain_walk(scene.nodes, rays, i, 0)
        assert (boxes[i], primitives[i]) == (1 + plain[0], plain[1])


def plain_walk(nodes: Any, rays: Any, i: int, node: int) -> tuple[int, int]:
    """Boxes tested below a node and primitives, one node and one axis at a time."""
    lower, upper = nodes["box"][node].astype(np.float64)
    enter, leave = rays.t_min[i], rays.t_max[i]
    for axis in range(3):
        o, d = rays.origin[i, axis], rays.direction[i, axis]
        a, b = (lower[axis] - o) / d, (upper[axis] - o) / d
        enter, leave = max(enter, min(a, b)), min(leave, max(a, b))
    if enter > leave:
        return 0, 0
    if nodes["count"][node] > 0:
        return 0, int(nodes["count"][node])
    first = int(nodes["first"][node])
    below = [plain_walk(nodes, rays, i, child) for child in (first, first + 1)]
    return 2 + below[0][0] + below[1][0], below[0][1] + below[1][1]


def broken(kind: str, nodes: Any, order: Any) -> None:
    """Breaks a tree of 200 boxes in one way."""
    inner = int(np.flatnonzero(nodes["count"][1:] == 0)[0]) + 1
    leaf = int(np.flatnonzero(nodes["first"] * (nodes["count"] > 1) == 100)[0])
    match kind:
        case "order is no permutation":
            order[7] = order[8]
        case "box too small: inner node":
            nodes["box"][inner, 1, 2] -= np.float32(0.3)
        case "box too small: leaf":
            nodes["box"][leaf, 0] = nodes["box"][leaf, 1]
        case "children out of range":
            nodes["first"][inner] = len(nodes) - 1
        case "two parents":
            nodes["first"][inner] = nodes["first"][0]
        case "in no leaf":
            nodes["count"][leaf] -= 1
        case "in two leaves":
            nodes["count"][leaf] += 1
        case "leaf out of range":
            nodes["first"][leaf] = 199
        case "leaf too large":
            nodes["count"][leaf] = 33


@pytest.mark.parametrize(
    "kind",
    [
        "order is no permutation", "box too small: inner node", "box too small: leaf",
        "children out of range", "two parents", "in no leaf", "in two leaves",
        "leaf out of range", "leaf too large",
    ],
)  # fmt: skip
def test_a_broken_tree_is_told(kind: str) -> None:
    tree, sets = part("bvh_tree"), part("bvh_sets")
    rng = np.random.default_rng(1)
    boxes = sets.around(rng.uniform(-1, 1, (200, 3)), 0.1)
    nodes, order = tree.build(boxes, rng)
    assert tree.faults(boxes, nodes, order.astype(np.uint32)) == []
    broken(kind, nodes, order)
    assert kind in dict(tree.faults(boxes, nodes, order.astype(np.uint32)))


def test_a_node_that_is_its_own_grandparent_ends() -> None:
    tree, sets = part("bvh_tree"), part("bvh_sets")
    boxes = sets.around(np.zeros((4, 3)), 1.0)
    nodes, order = tree.build(boxes, np.random.default_rng(1), 1)
    nodes["first"][nodes["first"][0]], nodes["count"][nodes["first"][0]] = nodes["first"][0], 0
    assert tree.faults(boxes, nodes, order.astype(np.uint32))


# --- The cases --------------------------------------------------------------------------------


@pytest.mark.parametrize("check", PROBES)
def test_cases_are_the_same_for_the_same_seed(bench: Bench, check: str) -> None:
    probe = bench.probes[check]
    oracle = load_oracle(ASSIGNMENT.folder / probe.oracle)
    seven, again, eight = (oracle.make_cases(probe.group, seed).payload for seed in (7, 7, 8))
    assert seven == again
    assert (seven == eight) == (check == EDGES)


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


@pytest.mark.parametrize("check", PROBES)
@pytest.mark.parametrize("size", [0, 1, 4321, 5_000_000])
def test_an_output_of_a_wrong_length_is_a_failure(bench: Bench, check: str, size: int) -> None:
    failures = bench.judge(check, bench.cases(check), bytes(size))
    assert failures[-1].fingerprint == "output of a wrong length"


@pytest.mark.parametrize("byte", [0x00, 0x01, 0x7F, 0xFF])
@pytest.mark.parametrize("check", PROBES)
def test_any_bytes_are_judged(bench: Bench, check: str, byte: int) -> None:
    cases = bench.cases(check)
    assert bench.judge(check, cases, bytes([byte]) * (28 * cases.count))


def test_the_driver_refuses_a_file_that_ends_too_early(bench: Bench, tmp_path: Path) -> None:
    driver = bench.program(HIDDEN / "probe_bvh.c", bench.module, "gcc", ("-O2",))
    short = tmp_path / "short.bin"
    for group, size in [("tree-edges", 25), ("walk-any", 50), ("walk-any", 1)]:
        short.write_bytes(b"\x01" + bytes(size - 1))
        with pytest.raises(AssertionError, match=r"short\.bin: ends inside a"):
            run(str(driver), str(short), str(tmp_path / "out.bin"), group)
