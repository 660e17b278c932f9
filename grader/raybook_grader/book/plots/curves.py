"""What a plot of errors shows: panels of curves over the number of samples."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Curve:
    """`errors` is relative to the mean of the picture, by samples a pixel. `style` is one of
    `drawing`'s."""

    label: str
    style: str
    errors: tuple[tuple[int, float], ...]


@dataclass(frozen=True)
class Panel:
    """Curves over the same axes."""

    title: str
    curves: tuple[Curve, ...]
