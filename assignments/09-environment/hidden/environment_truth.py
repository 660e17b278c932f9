"""What an environment map shows in a direction, in double precision; and how sure that is.

A module gets single precision. Turning a direction into the light's own frame takes six rounded
terms, so its local direction may be off by ANGLE radians, whatever the order (Higham, "Accuracy and
Stability of Numerical Algorithms", 2nd ed., section 3.1: 8 u, with u = 2^-24). The polar angle
from acos(z) is off by that over sin theta, and never by more than its root; the azimuth by that
over sin theta. `bounds` gives the least and the largest radiance in that neighbourhood, and the
contract's 1e-4 of the texels around on top.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ANGLE = 5e-7
PROMISED = 1e-4
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


@dataclass(frozen=True)
class Map:
    """An environment as a module gets it: all numbers are single precision."""

    name: str
    image: NDArray[np.float32]
    """Texels, (height, width, 3)."""
    scale: float = 1.0
    rotation: NDArray[np.float32] = field(default_factory=lambda: np.eye(3, dtype=np.float32))

    @property
    def height(self) -> int:
        return int(self.image.shape[0])

    @property
    def width(self) -> int:
        return int(self.image.shape[1])

    def to_local(self, world: Array) -> Array:
        """Unit directions in the light's own frame."""
        local: Array = world @ np.linalg.inv(self.rotation.astype(np.float64)).T
        local /= np.linalg.norm(local, axis=1, keepdims=True)
        return local

    def to_world(self, local: Array) -> Array:
        """In single precision, as a module gets them."""
        world = (local @ self.rotation.astype(np.float64).T).astype(np.float32)
        return world.astype(np.float64)


def direction_at(u: Array, v: Array) -> Array:
    """The local direction of a place in the image; u and v from 0 to 1."""
    phi, theta = 2 * np.pi * u, np.pi * v
    sine = np.sin(theta)
    return np.stack([sine * np.cos(phi), sine * np.sin(phi), np.cos(theta)], axis=-1)


def sine_of(local: Array) -> Array:
    length: Array = np.hypot(local[:, 0], local[:, 1])
    return length


def place_of(local: Array) -> tuple[Array, Array]:
    """u in [0, 1) and v in [0, 1]."""
    u = np.arctan2(local[:, 1], local[:, 0]) / (2 * np.pi)
    v = np.arctan2(sine_of(local), local[:, 2]) / np.pi
    return u % 1.0, v


def radiance_at(m: Map, u: Array, v: Array) -> Array:
    """The bilinear blend, times scale: it wraps in u and goes on beyond the outer rows."""
    x, y = u * m.width - 0.5, v * m.height - 0.5
    column, row = np.floor(x).astype(int), np.floor(y).astype(int)
    a, b = (x - column)[:, None], (y - row)[:, None]
    left, right = column % m.width, (column + 1) % m.width
    above, below = (np.clip(r, 0, m.height - 1) for r in (row, row + 1))
    t = m.image.astype(np.float64)
    upper = t[above, left] * (1 - a) + t[above, right] * a
    lower = t[below, left] * (1 - a) + t[below, right] * a
    blend: Array = upper * (1 - b) + lower * b
    return blend * m.scale


def radiance(m: Map, world: Array) -> Array:
    return radiance_at(m, *place_of(m.to_local(world)))


def bounds(m: Map, world: Array) -> tuple[Array, Array]:
    """The least and the largest radiance that a right module may return."""
    local = m.to_local(world)
    u, v = place_of(local)
    sine = np.maximum(sine_of(local), 1e-30)
    polar = (np.minimum(ANGLE / sine, np.sqrt(2 * ANGLE)) + ANGLE) / np.pi
    turn = np.minimum(ANGLE / sine + ANGLE, np.pi) / (2 * np.pi)
    near = [
        radiance_at(m, (u + i * turn) % 1.0, np.clip(v + j * polar, 0.0, 1.0))
        for i in (-1, 0, 1)
        for j in (-1, 0, 1)
    ]
    least, most = np.min(near, axis=0), np.max(near, axis=0)
    row_least, row_most = _row_range(m, v)
    # A kink between two of the places above may stick out by as much as they differ.
    slack = (most - least) + PROMISED * row_most
    # At a pole the azimuth is lost: anything of those rows will do.
    lost = (turn * m.width > 0.25)[:, None]
    least = np.where(lost, row_least * (1 - PROMISED), least - slack)
    most = np.where(lost, row_most * (1 + PROMISED), most + slack)
    return np.maximum(least, 0.0), most


def _row_range(m: Map, v: Array) -> tuple[Array, Array]:
    """The least and the largest texel of the two rows around v."""
    row = np.floor(v * m.height - 0.5).astype(int)
    above, below = (np.clip(r, 0, m.height - 1) for r in (row, row + 1))
    low, high = m.image.min(axis=1) * m.scale, m.image.max(axis=1) * m.scale
    return np.minimum(low[above], low[below]), np.maximum(high[above], high[below])
