"""The oracles of assignment 03 against an independent truth: hits, visits, faults of trees."""

from __future__ import annotations

import sys
from dataclasses import replace
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from probe_bench import assignment_of

from raybook_grader.checks.cost import cost_oracle
from raybook_grader.checks.oracles import cases_of, load_oracle
from raybook_grader.probes import Cases

HIDDEN = assignment_of("03").folder / "hidden"

Array = NDArray[np.float64]


def part(name: str) -> ModuleType:
    """One of the modules beside the oracles, which load them by their bare names."""
    load_oracle(HIDDEN / "oracle_walk.py")
    load_oracle(HIDDEN / "oracle_tree.py")
    return sys.modules[name]


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


# --- What a walk can claim ---------------------------------------------------------------------


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
