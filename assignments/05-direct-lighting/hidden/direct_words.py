"""What the oracles of assignment 05 share: how a colour is wrong."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray
from raybook_grader.cases import point


def triple(values: Sequence[float] | NDArray[np.float64]) -> str:
    """ "(1, 2.5, 0)", for points and colours."""
    return point(np.array(values, np.float64) + 0.0)  # no -0


def how_wrong(expected: Iterable[float], got: Iterable[float]) -> str:
    """The kind of a wrong colour in a few words that do not change from case to case."""
    want, have = np.array([*expected]), np.array([*got])
    if not np.isfinite(have).all():
        return "not finite"
    if (have < 0).any():
        return "negative"
    if not want.any():
        return "light where there is none"
    if not have.any():
        return "black where there is light"
    with np.errstate(all="ignore"):
        ratio = have[want > 0] / want[want > 0]
    if (have[want == 0] != 0).any() or ratio.max() > 1.01 * ratio.min():
        return "wrong colour"
    return "too bright" if ratio[0] > 1 else "too dark"
