"""The oracle of ``bvh_nearest`` and ``bvh_any``: groups "walk-nearest", "walk-any", "walk-cost".

The trees are given, so a student's builder has no say. The expected answer is the least t of a
list that the ray's case brings along, exactly; how the list was made (bvh_rays.py, bvh_mesh.py)
owes nothing to the renderer. Where two hits differ by rounding alone (1e-6 of t), either is right:
the box of the nearer may begin beyond the other by as much.

*Counts.* The driver counts in its own functions. A program could still bend them: by testing boxes
with code of its own, which nobody counts, or by writing over the counters. Both are refused
when the count is below what any walk needs (bvh_walk.py), so nothing is to be gained by it.

probe_bvh.c says how the files are laid out.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass, replace

import numpy as np
from bvh_mesh import Scene
from bvh_rays import ANY, BEYOND, Case, Query, counted_cases, hand_picked, random_cases
from bvh_walk import Array, Rays, visit
from numpy.typing import NDArray
from raybook_grader.cases import number, point, wrong_length
from raybook_grader.probes import Cases, Failure

COUNTED = "boxes and triangles tested a ray"

WORDS_OUT = 7
CLEAR = 1e-4
"""How far inside a box a ray must be for the oracle to insist that the box is entered."""

_FLAGS = {
    1: ("no leaf's range", "the test was called with a range of order[] that is no leaf's"),
    2: ("another hit handed on", "the test was not given the caller's own hit"),
    4: ("wrote without a hit", "*hit changed, although no test returned true"),
    8: (
        "changed the ray",
        "afterwards the ray is not what it was before but for the t_max that the tests left",
    ),
    16: ("asked after a hit", "a leaf was tested after a test had returned true"),
    32: (
        "disturbed by another walk",
        "a test that walked the tree itself spoilt the walk it was called from, as a second thread "
        "would: the walk keeps something where all walks share it",
    ),
    128: ("endless", "the walk was given up: it went on testing the same leaves"),
    64: ("changed the tree", "the nodes are not what they were before the rays"),
}


Work = tuple[Array, Array]
"""Primitives and boxes, for each ray of a case."""


@dataclass(frozen=True)
class Context:
    """The cases, and a bound of each one's work: from below where it is counted, else from above.

    ``queries`` are the rays of all cases, each with its case.
    """

    cases: list[Case]
    queries: list[tuple[Case, Query]]
    most: list[Work]
    least: list[Work]


def make_cases(group: str, seed: int) -> Cases:
    """Small trees, whatever the seed, then random ones; or, to be counted on, meshes."""
    rng = np.random.default_rng(seed)
    most: list[Work] = []
    least: list[Work] = []
    if group == "walk-cost":
        both = list(counted_cases(rng))
        cases = [case for case, _ in both]
        least = [_least(case, scene) for case, scene in both]
    elif group in ("walk-nearest", "walk-any"):
        cases = [*hand_picked(), *random_cases(rng)]
        if group == "walk-any":
            cases = [_any(case) for case in cases]
        most = [_most(case) for case in cases]
    else:
        raise ValueError(f"group {group!r}, expected walk-nearest, walk-any or walk-cost")
    queries = [(case, query) for case in cases for query in case.queries]
    payload = b"".join(_case_bytes(case) for case in cases)
    return Cases(payload, len(queries), Context(cases, queries, most, least))


def _any(case: Case) -> Case:
    return replace(case, queries=[replace(q, kind=q.kind | ANY) for q in case.queries])


def _case_bytes(case: Case) -> bytes:
    head = struct.pack("<II", len(case.nodes), len(case.queries))
    return head + case.nodes.tobytes() + b"".join(map(_query_bytes, case.queries))


def _query_bytes(q: Query) -> bytes:
    ray = struct.pack("<I8fI", q.kind, *q.origin, *q.direction, q.t_min, q.t_max, len(q.hits))
    return ray + b"".join(struct.pack("<If", i, t) for i, t in q.hits)


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Every wrong answer, told in words; then the counts that cannot be."""
    context: Context = cases.context
    if faults := wrong_length(output, 4 * WORDS_OUT, cases.count):
        return faults
    words = np.frombuffer(output, "<u4").reshape(-1, WORDS_OUT)
    failures = []
    for case, (given, query) in enumerate(context.queries):
        fault = _wrong(query, words[case])
        if fault:
            kind, sentence = fault
            text = f"{query.label}: {given.words}: {_ray(query)}: {sentence}"
            simplicity = -float(len(given.nodes) * 1000 + len(query.hits))
            failures.append(Failure(case, text, kind, simplicity))
    return [*failures, *_needless(context, words)] or _impossible(context, words)


def cost(cases: Cases, output: bytes) -> float:
    """Boxes and triangles a ray; the geometric mean of the scenes, so that each counts alike."""
    context: Context = cases.context
    work = np.frombuffer(output, "<u4").reshape(-1, WORDS_OUT)[:, 4:6].sum(axis=1, dtype=np.float64)
    scenes = np.split(work, np.cumsum([len(case.queries) for case in context.cases])[:-1])
    return float(np.exp(np.mean([np.log(np.mean(scene)) for scene in scenes])))


# --- Answers -------------------------------------------------------------------------------------


def _in_range(query: Query) -> list[tuple[int, float]]:
    return [(i, t) for i, t in query.hits if query.t_min <= t <= query.t_max]


def _wrong(query: Query, words: NDArray[np.uint32]) -> tuple[str, str] | None:
    """The kind of error and the words for it; None when the answer is right."""
    hits = _in_range(query)
    returned, index, flags = bool(words[0]), int(words[1]), int(words[6])
    t = float(words[2:3].view("<f4")[0])
    for bit, fault in _FLAGS.items():
        if flags & bit and bit in (2, 32, 128):
            return fault
    got = f"got one at t = {number(t)}" if np.isfinite(t) else "got none"
    if not hits:
        if returned:
            return "a hit out of nothing", "expected no hit, but true was returned"
    else:
        nearest = min(t for _, t in hits)
        what = "a hit" if query.kind & ANY else f"a hit at t = {number(nearest)}"
        if not returned and np.isfinite(t):
            return "hit not told", "a test returned true, but false was returned"
        if not returned:
            return "missed", f"expected {what}, got none"
        if (index, t) not in hits:
            return "not a hit", f"expected {what}, {got}"
        if not query.kind & ANY and t > nearest * (1 + 1e-6):
            return "not the nearest", f"expected {what}, {got}"
    return next((fault for bit, fault in _FLAGS.items() if flags & bit), None)


def _ray(query: Query) -> str:
    origin, direction = point(np.array(query.origin)), point(np.array(query.direction))
    kind = "bvh_any" if query.kind & ANY else "bvh_nearest"
    beyond = ", tests leave t_max a little beyond the hit" if query.kind & BEYOND else ""
    return (
        f"{kind}, ray from {origin} along {direction}, "
        f"t in [{number(query.t_min)}, {number(query.t_max)}]{beyond}"
    )


# --- Counts --------------------------------------------------------------------------------------


def _needless(context: Context, words: NDArray[np.uint32]) -> list[Failure]:
    """Rays for which something below a missed box was tested. Testing a box twice is no fault."""
    failures = []
    start = 0
    for case, (primitives, boxes) in zip(context.cases, context.most, strict=False):
        told = words[start : start + len(case.queries), 4:6].astype(np.float64)
        for i in np.flatnonzero((told[:, 0] > primitives) | (told[:, 1] > 2 * boxes)):
            query = case.queries[i]
            text = (
                f"{query.label}: {case.words}: {_ray(query)}: {told[i, 1]:.0f} boxes and "
                f"{told[i, 0]:.0f} primitives were tested; without what is below boxes that "
                f"the ray misses there are {boxes[i]:.0f} and {primitives[i]:.0f}"
            )
            simplicity = -float(len(case.nodes) * 1000 + 1e6)
            failures.append(Failure(start + int(i), text, "looked below a missed box", simplicity))
        start += len(case.queries)
    return failures


def _most(case: Case) -> Work:
    """Primitives and boxes at the children of all nodes that a ray enters, near misses too."""
    n, nodes = len(case.queries), case.nodes
    if len(nodes) == 0:
        return np.zeros(n), np.zeros(n)
    # Whether a box that begins beyond t_max is left out is a matter of cost.
    rays = _rays(case)
    seen = visit(nodes, replace(rays, t_max=np.full(n, np.inf)), -CLEAR)
    first = nodes["first"][seen.inner].astype(np.int64)
    below = nodes["count"][first].astype(np.float64) + nodes["count"][first + 1]
    primitives = np.bincount(seen.inner_ray, below, minlength=n) + nodes["count"][0]
    return primitives, seen.boxes(n)


def _rays(case: Case) -> Rays:
    columns = [(*q.origin, *q.direction, q.t_min, q.t_max) for q in case.queries]
    numbers = np.array(columns, np.float64)
    return Rays(numbers[:, :3], numbers[:, 3:6], numbers[:, 6], numbers[:, 7])


def _impossible(context: Context, words: NDArray[np.uint32]) -> list[Failure]:
    """Counts below what every walk needs."""
    failures = []
    start = 0
    for case, (primitives, boxes) in zip(context.cases, context.least, strict=False):
        told = words[start : start + len(case.queries)].astype(np.float64)
        if (told[:, 4] < primitives).any():
            failures.append(_too_few(start, case, "triangles", told[:, 4], primitives))
        # Half: a walk may leave out the boxes of leaves, or the root's.
        elif told[:, 5].sum() < 0.5 * boxes.sum():
            failures.append(_too_few(start, case, "boxes", told[:, 5], boxes))
        start += len(case.queries)
    return failures


def _least(case: Case, scene: Scene) -> Work:
    """Triangles and opened nodes that a ray cannot do without; any-hit may end at its first hit."""
    n, nodes = len(scene.rays), case.nodes
    ends = scene.nearest * (1 - CLEAR)
    seen = visit(nodes, replace(scene.rays, t_max=ends), CLEAR)
    needed = np.array([not (q.kind & ANY and _in_range(q)) for q in case.queries], np.float64)
    return needed * seen.primitives(nodes, n), needed * np.bincount(seen.inner_ray, minlength=n)


def _too_few(case: int, given: Case, what: str, told: Array, least: Array) -> Failure:
    advice = "test them with aabb_test, which counts" if what == "boxes" else "each leaf on its way"
    return Failure(
        case,
        f"{given.words}: {told.mean():.4g} {what} tested a ray, which is fewer than any walk needs "
        f"({least.mean():.4g}): {advice}",
        f"too few {what} counted",
    )
