"""Trees as arrays: what bvh.h asks of one, and plain builders of others.

``nodes`` is an array of NODE, laid out as the C struct bvh_node. Boxes are (n, 2, 3): lower, upper.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from raybook_grader.cases import point

MAX_DEPTH, MAX_LEAF = 64, 32
"""BVH_MAX_DEPTH and BVH_MAX_LEAF of bvh.h."""

NODE = np.dtype([("box", "<f4", (2, 3)), ("first", "<u4"), ("count", "<u4")])

Floats = NDArray[np.float32]
Indices = NDArray[np.int64]
Nodes = NDArray[np.void]

Fault = tuple[str, str]
"""A kind of fault in a few stable words, and what exactly is wrong."""


def faults(boxes: Floats, nodes: Nodes, order: NDArray[np.uint32]) -> list[Fault]:
    """What keeps this from being a tree over the boxes; at most one fault of each kind."""
    found = list(_permutation(order))
    if len(boxes) == 0:
        return [("nodes for nothing", f"{len(nodes)} nodes for no primitives")] * (len(nodes) > 0)
    if len(nodes) == 0:
        return [("no nodes", f"no nodes for {len(boxes)} primitives")]
    found += _walk(boxes, nodes, None if found else order.astype(np.int64))
    first_of_kind: dict[str, Fault] = {}
    for fault in found:
        first_of_kind.setdefault(fault[0], fault)
    return list(first_of_kind.values())


def _permutation(order: NDArray[np.uint32]) -> Iterator[Fault]:
    n = len(order)
    outside = np.flatnonzero(order >= n)
    if len(outside):
        i = outside[0]
        yield "order is no permutation", f"order[{i}] is {order[i]}, expected 0 to {n - 1}"
        return
    times = np.bincount(order, minlength=n)
    if (times != 1).any():
        p = int(np.flatnonzero(times != 1)[0])
        yield "order is no permutation", f"primitive {p} is in order {times[p]} times, expected 1"


def _walk(boxes: Floats, nodes: Nodes, order: Indices | None) -> Iterator[Fault]:
    """The faults that show on the way down from the root, level by level."""
    seen = np.zeros(len(nodes), bool)
    leaves: list[Indices] = []
    level = np.zeros(1, np.int64)
    seen[0] = True
    depth = 1
    while len(level):
        if depth > MAX_DEPTH:
            yield "too deep", f"node {level[0]} has depth {depth}, expected {MAX_DEPTH} at most"
            return
        leaves.append(level[nodes["count"][level] > 0])
        inner = level[nodes["count"][level] == 0]
        first = nodes["first"][inner].astype(np.int64)
        wild = (first < 1) | (first > len(nodes) - 2)
        if wild.any():
            i = int(np.flatnonzero(wild)[0])
            yield (
                "children out of range",
                f"node {inner[i]} has the children {first[i]} and {first[i] + 1}, expected "
                f"1 to {len(nodes) - 1}",
            )
        inner, first = inner[~wild], first[~wild]
        parent = np.concatenate([inner, inner])
        child = np.concatenate([first, first + 1])
        fresh = ~seen[child] & (np.bincount(child, minlength=len(nodes))[child] == 1)
        if not fresh.all():
            twice = int(child[~fresh][0])
            yield "two parents", f"node {twice} is a child of two nodes, or a child twice"
        yield from _outside(nodes, parent[fresh], child[fresh])
        level = child[fresh]
        seen[level] = True
        depth += 1
    if not seen.all():
        lost = int(np.flatnonzero(~seen)[0])
        yield "lost nodes", f"of {len(nodes)} nodes, node {lost} does not hang below the root"
    yield from _leaves(boxes, nodes, order, np.sort(np.concatenate(leaves)))


def _outside(nodes: Nodes, parent: Indices, child: Indices) -> Iterator[Fault]:
    inner, outer = nodes["box"][child], nodes["box"][parent]
    held = _holds(outer, inner)
    if not held.all():
        i = int(np.flatnonzero(~held)[0])
        yield (
            "box too small: inner node",
            f"node {parent[i]} has the box {_words(outer[i])}, which does not hold that of its "
            f"child {child[i]}, {_words(inner[i])}",
        )


def _leaves(boxes: Floats, nodes: Nodes, order: Indices | None, leaves: Indices) -> Iterator[Fault]:
    n = len(boxes)
    first = nodes["first"][leaves].astype(np.int64)
    count = nodes["count"][leaves].astype(np.int64)
    wild = (first + count > n) | (first >= n)
    if wild.any():
        i = int(np.flatnonzero(wild)[0])
        yield (
            "leaf out of range",
            f"leaf {leaves[i]} holds order[{first[i]}] to order[{first[i] + count[i] - 1}], "
            f"expected places from 0 to {n - 1}",
        )
    leaves, first, count = leaves[~wild], first[~wild], count[~wild]
    if len(count) and count.max() > MAX_LEAF:
        i = int(np.argmax(count))
        yield (
            "leaf too large",
            f"leaf {leaves[i]} holds {count[i]} primitives, expected {MAX_LEAF} at most",
        )
    ends = np.bincount(first, minlength=n + 1) - np.bincount(first + count, minlength=n + 1)
    times = np.cumsum(ends)[:n]
    if (times != 1).any():
        i = int(np.flatnonzero(times != 1)[0])
        kind = "in no leaf" if times[i] == 0 else "in two leaves"
        yield kind, f"order[{i}] is in {times[i]} leaves, expected exactly one"
    if order is not None:
        yield from _spill(boxes, nodes, order, np.repeat(leaves, count), _ranges(first, count))


def _spill(
    boxes: Floats, nodes: Nodes, order: Indices, leaf: Indices, place: Indices
) -> Iterator[Fault]:
    inner, outer = boxes[order[place]], nodes["box"][leaf]
    held = _holds(outer, inner)
    if not held.all():
        i = int(np.flatnonzero(~held)[0])
        yield (
            "box too small: leaf",
            f"leaf {leaf[i]} has the box {_words(outer[i])}, which does not hold that of "
            f"primitive {order[place[i]]}, {_words(inner[i])}",
        )


def _holds(outer: Floats, inner: Floats) -> NDArray[np.bool_]:
    lower, upper = outer[:, 0] <= inner[:, 0], inner[:, 1] <= outer[:, 1]
    held: NDArray[np.bool_] = np.all(lower & upper, axis=1)
    return held


def _words(box: Floats) -> str:
    """ "(0, 0, 0) to (1, 1, 1)"."""
    lower, upper = box.astype(np.float64)
    return f"{point(lower)} to {point(upper)}"


def _ranges(first: Indices, count: Indices) -> Indices:
    """first[0], first[0] + 1, ... (count[0] of them), first[1], ..."""
    before = np.cumsum(count) - count
    return np.arange(int(count.sum())) - np.repeat(before - first, count)


# --- Builders for trees that walks are judged on ------------------------------------------------


def build(
    boxes: Floats,
    rng: np.random.Generator,
    leaf: int = 4,
    style: str = "median",
) -> tuple[Nodes, Indices]:
    """A tree over the boxes, and its order.

    "median": halved along the widest axis. "random": split anywhere by chance, so that children
    overlap. "comb": one primitive at a time, the first child; "comb-behind": the second;
    "zigzag": in turns. Pairs of children lie in the array in any order.
    """
    order = np.arange(len(boxes))
    pairs = rng.permutation(max(len(boxes) - 1, 0))
    taken = 0
    nodes = np.zeros(max(2 * len(boxes) - 1, 1), NODE)
    waiting = [(0, 0, len(boxes), 1)]
    while waiting:
        node, first, count, depth = waiting.pop()
        mine = order[first : first + count]
        nodes["box"][node, 0] = boxes[mine, 0].min(axis=0)
        nodes["box"][node, 1] = boxes[mine, 1].max(axis=0)
        if count <= leaf or depth == MAX_DEPTH:
            nodes["first"][node], nodes["count"][node] = first, count
            continue
        left = _divide(boxes, order, first, count, style, depth, rng)
        child = 1 + 2 * int(pairs[taken])
        taken += 1
        nodes["first"][node] = child
        waiting.append((child, first, left, depth + 1))
        waiting.append((child + 1, first + left, count - left, depth + 1))
    return _without_gaps(nodes, pairs[:taken]), order


def _divide(
    boxes: Floats,
    order: Indices,
    first: int,
    count: int,
    style: str,
    depth: int,
    rng: np.random.Generator,
) -> int:
    """Reorders a range of ``order``; how many of it go to the first child."""
    mine = order[first : first + count]
    if style == "random":
        order[first : first + count] = rng.permutation(mine)
        return int(rng.integers(1, count))
    if style == "median":
        centre = boxes[mine].astype(np.float64).sum(axis=1)
        axis = int(np.argmax(np.ptp(centre, axis=0)))
        order[first : first + count] = mine[np.argsort(centre[:, axis], kind="stable")]
        return count // 2
    alone_first = style == "comb" or (style == "zigzag" and depth % 2)
    return 1 if alone_first else count - 1


def _without_gaps(nodes: Nodes, pairs: Indices) -> Nodes:
    """The root and the pairs in use, moved together without a change in their order."""
    used = np.sort(pairs)
    place = np.zeros(len(nodes), np.int64)
    place[1 + 2 * used] = 1 + 2 * np.arange(len(used))
    kept = np.concatenate([[0], np.stack([1 + 2 * used, 2 + 2 * used], axis=1).ravel()])
    packed = nodes[kept.astype(np.int64)]
    inner = packed["count"] == 0
    packed["first"][inner] = place[packed["first"][inner]]
    return packed
