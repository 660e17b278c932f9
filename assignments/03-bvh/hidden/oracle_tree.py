"""The oracle of ``bvh_build``: groups "tree-edges", "tree-small", "tree-random" and "tree-cost".

A tree is judged by itself, outside of the box: what bvh.h asks of it can be seen in its arrays
(bvh_tree.py). Which tree it is, the contract leaves open.

The cost of a tree is what rays must test that know where their nearest hit is (bvh_walk.py): the
boxes and triangles that they meet on the way to it. The walk is the oracle's own, over the
student's tree, so no program can count in its own favour, and the student's walk has no say.

probe_bvh.c says how the files are laid out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from bvh_mesh import Scene, scenes
from bvh_sets import Set, hand_picked, random_sets
from bvh_tree import NODE, Floats, Nodes, faults
from bvh_walk import visit
from numpy.typing import NDArray
from raybook_grader.probes import Cases, Failure

COUNTED = "boxes and triangles on a ray's way to its nearest hit"

_SMALL = 300
"""Boxes of a set that is built under the sanitizers, which take twenty times the time."""

_FLAGS = {
    1: ("wrote beyond nodes", "wrote to memory outside of nodes[], which has room for 2 n - 1"),
    2: ("wrote beyond order", "wrote to memory outside of order[], which has room for n"),
    4: ("changed the boxes", "changed the boxes, which are only to be read"),
    8: (
        "not repeatable",
        "the same boxes gave two different trees: one of them depends on what the memory held "
        "before, or on the call before",
    ),
}


@dataclass(frozen=True)
class Context:
    """The sets, and for the group "tree-cost" what to count on each of them."""

    sets: list[Set]
    scenes: list[Scene]


@dataclass(frozen=True)
class Tree:
    """One answer. ``nodes`` is None if more were returned than there was room for."""

    returned: int
    flags: int
    nodes: Nodes | None
    order: NDArray[np.uint32]


def make_cases(group: str, seed: int) -> Cases:
    """ "tree-edges": hand-picked, whatever the seed, and "tree-small": the same, but a few
    of each set's boxes only. The others hang on the seed."""
    rng = np.random.default_rng(seed)
    counted: list[Scene] = []
    if group == "tree-edges":
        sets = list(hand_picked())
    elif group == "tree-small":
        sets = [(label, boxes[:: -(-len(boxes) // _SMALL) or 1]) for label, boxes in hand_picked()]
    elif group == "tree-random":
        sets = list(random_sets(rng))
    elif group == "tree-cost":
        counted = list(scenes(rng))
        sets = [(f"the {len(s.boxes)} triangles of {s.name}", s.boxes) for s in counted]
    else:
        raise ValueError(f"group {group!r}, expected tree-edges, -small, -random or -cost")
    payload = b"".join(np.uint32(len(b)).tobytes() + b.astype("<f4").tobytes() for _, b in sets)
    return Cases(payload, len(sets), Context(sets, counted))


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Every set whose tree is none, told in words."""
    context: Context = cases.context
    failures: list[Failure] = []
    trees = _trees(context, output)
    for case, (label, boxes) in enumerate(context.sets):
        if trees[case] is None:
            return [*failures, _ended_early(case, len(output))]
        for kind, words in _wrong(boxes, trees[case]):
            # Those that were written first are the simplest.
            failures.append(Failure(case, f"{label}: {words}", kind, -float(case)))
    if trees[-1] is None:
        failures.append(_ended_early(cases.count, len(output)))
    return failures


def cost(cases: Cases, output: bytes) -> float:
    """Boxes and triangles a ray; the geometric mean of the scenes, so that each counts alike."""
    context: Context = cases.context
    logs = [
        np.log(_work(scene, tree.nodes))
        for scene, tree in zip(context.scenes, _trees(context, output), strict=False)
        if tree is not None and tree.nodes is not None
    ]
    return float(np.exp(np.mean(logs)))


def _work(scene: Scene, nodes: Nodes) -> float:
    n = len(scene.rays)
    seen = visit(nodes, replace(scene.rays, t_max=scene.nearest))
    return float(np.mean(seen.boxes(n) + seen.primitives(nodes, n)))


def _ended_early(case: int, size: int) -> Failure:
    message = f"the probe wrote {size} bytes, which is not what so many trees take"
    return Failure(case, message, "output of a wrong length")


def _wrong(boxes: Floats, tree: Tree | None) -> list[tuple[str, str]]:
    assert tree is not None
    flagged = [fault for bit, fault in _FLAGS.items() if tree.flags & bit]
    if tree.nodes is None:
        room = max(2 * len(boxes) - 1, 1)
        return [
            (
                "too many nodes",
                f"bvh_build returned {tree.returned} nodes, expected {room} at most",
            ),
            *flagged,
        ]
    return faults(boxes, tree.nodes, tree.order) + flagged


def _trees(context: Context, output: bytes) -> list[Tree | None]:
    """One for each set; None where the output ends. One more, None, if it does not end there."""
    trees: list[Tree | None] = []
    place = 0
    for _, boxes in context.sets:
        tree, place = _take(output, place, len(boxes))
        trees.append(tree)
    return trees if place == len(output) else [*trees, None]


def _take(output: bytes, place: int, n: int) -> tuple[Tree | None, int]:
    if place + 8 > len(output):
        return None, len(output) + 1
    returned, flags = (int(word) for word in np.frombuffer(output, "<u4", 2, place))
    place += 8
    if returned > max(2 * n - 1, 1):
        return Tree(returned, flags, None, np.zeros(0, np.uint32)), place
    end = place + returned * NODE.itemsize + 4 * n
    if end > len(output):
        return None, len(output) + 1
    nodes = np.frombuffer(output, NODE, returned, place)
    order = np.frombuffer(output, "<u4", n, end - 4 * n)
    return Tree(returned, flags, nodes, order), end
