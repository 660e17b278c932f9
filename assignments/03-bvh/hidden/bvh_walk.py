"""A walk through a tree outside of the box: many rays at once, in double precision.

It visits what no walk can leave out: the nodes whose box the ray enters before its nearest hit.
A walk that knows where that hit is visits these and no others, in whatever order; so the count
measures the tree and nothing else, and it bounds every walk's count from below.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from bvh_tree import Indices, Nodes
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class Rays:
    """origin and direction are (n, 3), t_min and t_max (n,)."""

    origin: Array
    direction: Array
    t_min: Array
    t_max: Array

    def __len__(self) -> int:
        return len(self.origin)


@dataclass(frozen=True)
class Visits:
    """Pairs of a ray and a node: the inner nodes that are opened, and the leaves."""

    inner_ray: Indices
    inner: Indices
    leaf_ray: Indices
    leaf: Indices

    def primitives(self, nodes: Nodes, rays: int) -> Array:
        """How many primitives each of ``rays`` rays is tested with."""
        count = nodes["count"][self.leaf].astype(np.float64)
        return np.bincount(self.leaf_ray, count, minlength=rays).astype(np.float64)

    def boxes(self, rays: int) -> Array:
        """How many boxes each ray is tested with: the root's, and each opened node's children's."""
        opened = np.bincount(self.inner_ray, minlength=rays).astype(np.float64)
        return 1 + 2 * opened


def visit(nodes: Nodes, rays: Rays, margin: float = 0.0) -> Visits:
    """The nodes that each ray enters within its range.

    A positive ``margin`` asks for clear hits only: the part of the ray in the box must be longer
    than this share of its end's t. A negative one takes in near misses.
    """
    ray, node = np.arange(len(rays)), np.zeros(len(rays), np.int64)
    found: list[tuple[Indices, Indices, Mask]] = []
    if len(nodes) == 0:
        ray, node = ray[:0], node[:0]
    while len(ray):
        entered = _enters(nodes["box"][node].astype(np.float64), rays, ray, margin)
        ray, node = ray[entered], node[entered]
        is_inner = nodes["count"][node] == 0
        found.append((ray, node, is_inner))
        first = nodes["first"][node[is_inner]].astype(np.int64)
        ray = np.tile(ray[is_inner], 2)
        node = np.concatenate([first, first + 1])
    parts = [[r[m], n[m], r[~m], n[~m]] for r, n, m in found]
    nothing = [np.zeros(0, np.int64)] * 4
    return Visits(*(np.concatenate(column) for column in zip(*parts, nothing, strict=True)))


def _enters(box: Array, rays: Rays, ray: Indices, margin: float) -> Mask:
    origin, direction = rays.origin[ray], rays.direction[ray]
    with np.errstate(all="ignore"):
        t = (box - origin[:, None]) / direction[:, None]
    along = direction == 0  # between the planes always, or never
    between = (box[:, 0] <= origin) & (origin <= box[:, 1])
    near = np.where(along, np.where(between, -np.inf, np.inf), t.min(axis=1)).max(axis=1)
    far = np.where(along, np.where(between, np.inf, -np.inf), t.max(axis=1)).min(axis=1)
    near, far = np.maximum(near, rays.t_min[ray]), np.minimum(far, rays.t_max[ray])
    with np.errstate(invalid="ignore"):
        entered: Mask = (far - near >= margin * np.abs(far)) | (np.isinf(far) & (far > near))
    return entered
