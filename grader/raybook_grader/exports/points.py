"""Our points against what a learning platform says an assignment is worth."""

from __future__ import annotations

import math

from ..errors import BadInput


def factor(ours: float, theirs: str, where: str, scale: bool) -> float:
    """What our scores are multiplied by: 1, or with ``scale`` whatever makes the maxima agree.

    An empty ``theirs`` says nothing, so that nothing is scaled. A platform given other points than
    it expects takes them without a word, or drops them: so the difference is refused here.
    """
    if not theirs.strip():
        return 1.0
    try:
        value = float(theirs.strip().replace(",", "."))
    except ValueError as error:
        raise BadInput(f"{where}: is worth {theirs!r}, expected a number of points") from error
    if math.isclose(value, ours, abs_tol=0.005):
        return 1.0
    if not scale or value <= 0 or ours <= 0:
        raise BadInput(
            f"{where}: is worth {value:g} points there and {ours:g} here, expected the same; "
            "change it there, or give --scale"
        )
    return value / ours


def scaled(score: float | None, by: float) -> float | None:
    """The score in the platform's points; unknown stays unknown."""
    return None if score is None else round(score * by, 2)
