"""What the contract of ``mipmap_ewa`` leaves open, as bounds on how a wave is damped.

A wave cos(2 pi k . x) keeps the factor H(rho) under a bell w(q) over the ellipse E, in texels,
where rho^2 = k' E k: the Hankel transform of the bell,

    H(rho) = integral of w(r^2) J0(2 pi rho r) r dr / integral of w(r^2) r dr.

The bell is exp(-2 q), may end anywhere from q = 1 to q = 4, and may be lowered so that it ends at
0. `damping` holds the least and the largest factor of all of these.

The levels blur as well, in all directions: a texel is a box of at most the shortest half axis s (of
variance s^2 / 12 along each axis), interpolation between texels adds s^2 / 6 if it is bilinear, and
the ellipse is widened by up to a texel, which is s^2 / 4 of variance for the widest bell. Together
that is 0.5 s^2, or 0.5 where s is below one texel. A blur of variance c damps by
exp(-2 pi^2 c |k|^2).
"""

from __future__ import annotations

import numpy as np
from mipmap_cases import Array
from scipy.integrate import trapezoid
from scipy.special import j0

ENDS = (1.0, 1.25, 1.5, 2.0, 3.0, 4.0)
MOST_BLUR = 0.5
_RHO = np.linspace(0.0, 2.0, 401)


def _transform(end: float, lowered: bool) -> Array:
    r = np.linspace(0.0, np.sqrt(end), 801)
    weight = (np.exp(-2 * r**2) - lowered * np.exp(-2 * end)) * r
    waves = j0(2 * np.pi * _RHO[:, None] * r)
    return np.asarray(trapezoid(waves * weight, r) / trapezoid(weight, r))


_ALL = np.stack([_transform(end, lowered) for end in ENDS for lowered in (False, True)])
_LEAST, _LARGEST = _ALL.min(axis=0), _ALL.max(axis=0)


def damping(rho: float, least_rho: float, k: float, shortest: float) -> tuple[float, float]:
    """The least and the largest factor; ``k`` in waves a texel, ``shortest`` half axis.

    ``least_rho``: what rho may be at least, where the ellipse is as narrow as a texel.
    """
    blur = np.exp(-2 * np.pi**2 * MOST_BLUR * max(shortest, 1.0) ** 2 * k**2)
    least = float(np.interp(rho, _RHO, _LEAST))
    largest = float(np.interp(least_rho, _RHO, _LARGEST))
    return min(least, least * blur), max(largest, largest * blur)
