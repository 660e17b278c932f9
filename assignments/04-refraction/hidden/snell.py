"""Snell's law in float64, and how far a module may be from it.

With r the index on outgoing's side over the one beyond, s and c the sine and cosine of outgoing's
angle with the normal, the squared cosine beyond the boundary is k = 1 - r^2 s^2: the angle is found
by its sine, from vectors that are scaled to length one first.

The bounds are the contract's. Single precision can keep them: with u = 2^-24 a cosine is off by at
most 5 u (three products and sums, two vectors whose length is off by u each), so k as
1 - r^2 (1 - c^2) is by 16 u (1 + r^2) < 1e-6 (1 + r^2), and the part along the boundary by 8 u r.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

PROMISED = 1e-6


@dataclass(frozen=True)
class Snell:
    """The answers to n cases.

    ``beyond``: the direction beyond the boundary, along it where there is none. ``beyond_error``:
    how far each component may be off; ``mirror`` and ``mirror_error`` are the same for total
    reflection. ``through``, ``mirrored``: the answers that are right; near the critical angle both.
    """

    outside: Mask
    sine: Array
    beyond: Array
    beyond_error: Array
    mirror: Array
    mirror_error: Array
    through: Mask
    mirrored: Mask


def snell(normal: Array, outgoing: Array, eta: Array) -> Snell:
    """Normals and directions are (n, 3), of any length."""
    n, o = _unit(normal), _unit(outgoing)
    c = np.sum(n * o, axis=1, keepdims=True)
    outside = np.sum(normal * outgoing, axis=1) >= 0
    r = np.where(outside, 1 / eta, eta)
    along = o - c * n
    k = 1 - r**2 * np.sum(along**2, axis=1)
    k_error = PROMISED * (1 + r**2)
    cosine = np.sqrt(np.maximum(k, 0))
    least = np.sqrt(np.maximum(k - k_error, 0))
    most = np.sqrt(np.maximum(k, 0) + k_error)
    side = np.where(outside, 1.0, -1.0)[:, None]
    return Snell(
        outside=outside,
        sine=np.linalg.norm(along, axis=1),
        beyond=_unit(-r[:, None] * along - side * cosine[:, None] * n),
        beyond_error=PROMISED * (1 + r) + np.maximum(cosine - least, most - cosine),
        mirror=c * n - along,
        mirror_error=PROMISED * (1 + r),
        through=k > -k_error,
        mirrored=k < k_error,
    )


def _unit(v: Array) -> Array:
    length: Array = np.linalg.norm(v, axis=1, keepdims=True)
    return np.asarray(v / length)
