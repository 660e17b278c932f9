"""Meshes and rays that work is counted on: (n, 3, 3) corners, and what a ray meets of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from bvh_tree import Floats, Indices, Nodes, build
from bvh_walk import Array, Rays, visit

RAYS = 1200


@dataclass(frozen=True)
class Scene:
    """A mesh, rays, and every hit of a ray with a triangle's inside: (ray, triangle, t)."""

    name: str
    boxes: Floats
    rays: Rays
    hit_ray: Indices
    hit_triangle: Indices
    hit_t: Array
    nodes: Nodes
    order: Indices

    @property
    def nearest(self) -> Array:
        """Each ray's first t, or its t_max if it hits nothing."""
        t = self.rays.t_max.copy()
        np.minimum.at(t, self.hit_ray, self.hit_t)
        return t


def scenes(rng: np.random.Generator) -> Iterator[Scene]:
    """Three of them, which reward a good choice of splits a little, well, and very much."""
    yield _scene("a knot", _knot(), rng)
    yield _scene("triangles of all sizes", _debris(rng), rng)
    yield _scene("a ball in a hall", _hall(rng), rng)


def _scene(name: str, corners: Array, rng: np.random.Generator) -> Scene:
    corners = corners[rng.permutation(len(corners))].astype(np.float32).astype(np.float64)
    boxes = np.stack([corners.min(axis=1), corners.max(axis=1)], axis=1).astype(np.float32)
    rays = _rays(corners, rng)
    nodes, order = build(boxes, rng)
    seen = visit(nodes, rays, -1e-5)
    count = nodes["count"][seen.leaf].astype(np.int64)
    ray = np.repeat(seen.leaf_ray, count)
    before = np.cumsum(count) - count
    place = np.arange(int(count.sum())) + np.repeat(
        nodes["first"][seen.leaf].astype(np.int64) - before, count
    )
    triangle = order[place]
    t = _meet(corners[triangle], rays.origin[ray], rays.direction[ray])
    hit = np.isfinite(t) & (t >= rays.t_min[ray])
    t32 = t[hit].astype(np.float32).astype(np.float64)
    return Scene(name, boxes, rays, ray[hit], triangle[hit], t32, nodes, order)


def _meet(p: Array, origin: Array, direction: Array) -> Array:
    """Where each ray meets its triangle; NaN where it does not."""
    e1, e2, s = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0], origin - p[:, 0]
    normal = np.cross(e1, e2)
    with np.errstate(all="ignore"):
        k = 1 / np.einsum("ni,ni->n", direction, normal)
        turned = np.cross(s, direction)
        b1 = -np.einsum("ni,ni->n", e2, turned) * k
        b2 = np.einsum("ni,ni->n", e1, turned) * k
        t = -np.einsum("ni,ni->n", s, normal) * k
        inside = (b1 >= 0) & (b2 >= 0) & (b1 + b2 <= 1)
    return np.where(inside, t, np.nan)


def _rays(corners: Array, rng: np.random.Generator) -> Rays:
    """Half come from around, half go from one place of the surface to another, or beyond it."""
    weights = rng.dirichlet([1, 1, 1], 2 * RAYS)
    chosen = rng.integers(len(corners), size=2 * RAYS)
    on = np.einsum("ni,nij->nj", weights, corners[chosen])
    centre, reach = corners.mean(axis=(0, 1)), np.ptp(corners, axis=(0, 1)).max()
    origin = on[RAYS:].copy()
    away = rng.normal(size=(RAYS // 2, 3))
    away /= np.linalg.norm(away, axis=1, keepdims=True)
    origin[: RAYS // 2] = centre + away * reach
    direction = on[:RAYS] - origin
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    some = np.full(RAYS, 1e-3 * reach)
    origin32, direction32 = (a.astype(np.float32).astype(np.float64) for a in (origin, direction))
    t_min = np.where(np.arange(RAYS) < RAYS // 2, 0.0, some).astype(np.float32).astype(np.float64)
    return Rays(origin32, direction32, t_min, np.full(RAYS, np.inf))


def _sheet(points: Array) -> Array:
    """The triangles of a grid of (rows, columns) points."""
    a, b, c, d = points[:-1, :-1], points[:-1, 1:], points[1:, :-1], points[1:, 1:]
    both = np.stack([np.stack([a, b, c], axis=2), np.stack([d, c, b], axis=2)], axis=2)
    return both.reshape(-1, 3, 3)


def _knot() -> Array:
    """A (2, 3) torus knot, a tube of 12,000 triangles."""
    u = np.linspace(0, 2 * np.pi, 301)[:, None, None]
    v = np.linspace(0, 2 * np.pi, 21)[None, :, None]
    r = 2 + np.cos(3 * u)
    path = np.concatenate([r * np.cos(2 * u), r * np.sin(2 * u), np.sin(3 * u)], axis=2)
    ahead = np.gradient(path[:, 0], axis=0)
    side = np.cross(ahead, [0.0, 0.0, 1.0])
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    up = np.cross(side, ahead)
    up /= np.linalg.norm(up, axis=1, keepdims=True)
    return _sheet(path + 0.35 * (np.cos(v) * side[:, None] + np.sin(v) * up[:, None]))


def _debris(rng: np.random.Generator) -> Array:
    """8000 triangles, small ones and a few large ones, in clumps."""
    size = 0.005 * 10 ** (2.5 * rng.random((8000, 1, 1)) ** 4)
    clump = rng.normal(size=(20, 1, 3))[rng.integers(20, size=8000)]
    middle = clump + 0.3 * rng.normal(size=(8000, 1, 3))
    return middle + size * rng.normal(size=(8000, 3, 3))


def _hall(rng: np.random.Generator) -> Array:
    """A ball of 5000 triangles in the corner of a hall of walls, beams and a floor of tiles."""
    u = np.linspace(0, np.pi, 51)[:, None, None]
    v = np.linspace(0, 2 * np.pi, 51)[None, :, None]
    unit = np.concatenate([np.sin(u) * np.cos(v), np.sin(u) * np.sin(v), np.cos(u) + 0 * v], axis=2)
    ball = _sheet(unit) + np.array([30.0, 30.0, 2.0])
    x, y = np.meshgrid(np.linspace(-50, 50, 31), np.linspace(-50, 50, 31), indexing="ij")
    floor = _sheet(np.stack([x, y, 0 * x], axis=2))
    start = rng.uniform([-50, -50, 20], [50, 50, 30], (100, 3))
    along = np.eye(3)[rng.integers(2, size=100)] * rng.uniform(20, 60, (100, 1))
    beams = np.stack([start, start + along, start + along + [0, 0, 1.0]], axis=1)
    corner = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]]) * 50.0
    low, high = (np.concatenate([corner, np.full((5, 1), z)], axis=1) for z in (0.0, 40.0))
    walls = _sheet(np.stack([low, high]))
    return np.concatenate([ball, floor, beams, walls])
