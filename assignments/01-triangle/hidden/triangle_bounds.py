"""How far a right answer of ``triangle_intersect`` may be from the exact one.

triangle.h promises that within a tolerance of an edge, or of an end of the range, either answer
is right. With u = 2^-24 (half a unit in the last place of a float), edges e1 and e2 from p0,
s from the origin to p0 and direction d, the tolerances are

    t:  1e-4 |t| + K u ((|s||e1||e2| + |t||d||e1||e2|) / |det| + R W / (|d| cos))
    b1: 1e-4     + K u ((|d||s||e2| + |b1||d||e1||e2|) / |det| + R W |grad b1| / cos)
                 + |grad b1 . d| (the second term of t)

and b2 likewise: the contract's figure and a bound on rounding. A triple product of differences of
floats takes at most eight roundings in each of its six terms, in whatever order, so its error is
below 8 u times the sum of the terms' sizes (Higham, "Accuracy and Stability of Numerical
Algorithms", 2nd ed., section 3.1), and that sum is at most sqrt(2) times the product of the three
lengths (Cauchy-Schwarz, twice): hence K = 12. R is the largest coordinate plus the longest edge,
W = |b0| + |b1| + |b2|, and cos belongs to the angle with the normal: K u R is what a method
commits that moves the triangle to the ray, or the hit into the world. The last term of b1 is a
hit that slides along the ray by the error of t.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

UNIT = 2.0**-24
ROUNDINGS = 12  # of which 8 sqrt(2) are needed
PROMISED = 1e-4


def _dot(a: Array, b: Array) -> Array:
    product: Array = np.sum(a * b, axis=-1)
    return product


def _length(a: Array) -> Array:
    return np.sqrt(_dot(a, a))


def solve(p: Array, origin: Array, d: Array) -> tuple[Array, Array, Array, Array, Mask]:
    """t, the three weights, how far rounding may move each, and where it hides everything."""
    to = p - origin[:, None, :]
    volumes = _dot(d[:, None, :], np.cross(np.roll(to, -1, 1), np.roll(to, -2, 1)))
    e1, e2 = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    normal = np.cross(e1, e2)
    det = _dot(normal, d)
    t = _dot(normal, to[:, 0]) / det
    b = volumes / np.sum(volumes, axis=1, keepdims=True)

    small = ROUNDINGS * UNIT
    edges, speed, size1, size2 = p - np.roll(p, 1, 1), _length(d), _length(e1), _length(e2)
    det_error = small * speed * size1 * size2
    reach = np.maximum(np.abs(p).max(axis=(1, 2)), np.abs(origin).max(axis=1))
    reach += _length(edges).max(axis=1)
    cosine = np.abs(det) / (_length(normal) * speed)
    shift = small * reach * np.abs(b).sum(axis=1) / cosine
    away = _length(to[:, 0])
    t_error = (small * away * size1 * size2 + np.abs(t) * det_error) / np.abs(det) + shift / speed
    b_error = np.empty_like(b)
    for i, opposite in ((1, e2), (2, e1)):
        gradient = np.cross(opposite, normal) / _dot(normal, normal)[:, None]
        triple_error = small * speed * away * _length(opposite)
        b_error[:, i] = (triple_error + np.abs(b[:, i]) * det_error) / np.abs(det)
        b_error[:, i] += shift * _length(gradient) + np.abs(_dot(gradient, d)) * t_error
    b_error[:, 0] = b_error[:, 1] + b_error[:, 2]
    hopeless = ~(det_error < 0.25 * np.abs(det))
    return t, b, t_error + PROMISED * np.abs(t), b_error + PROMISED, hopeless


def verdict(
    t: Array, b: Array, t_error: Array, b_error: Array, t_min: Array, t_max: Array
) -> tuple[Mask, Mask]:
    """Whether a hit may, and whether it must, be reported."""
    may = (b >= -b_error).all(axis=1) & (t >= t_min - t_error) & (t <= t_max + t_error)
    must = (b > b_error).all(axis=1) & (t > t_min + t_error) & (t < t_max - t_error)
    return may, must
