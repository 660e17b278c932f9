"""How the error of a picture falls with the number of samples, in three places of the book."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...judge.pixels import Array, luminance
from .curves import Curve, Panel
from .renders import Override, Renders

SEVEN = "scenes/test/several-lights.json"
AMBIENT = "05-direct-lighting/ambient-in-shadow.patch"
SAMPLED = ("scenes/soft-shadows.json", "scenes/sunny-sky.json")

_SPP = (1, 4, 16, 64, 256, 1024)
_TRUTH = 16_384
_TRUTH_SEED = 1_000
_LAMP = 2.0  # brighter than any lit surface of the scene; what shows some of the lamp is left out
_TILE = 8
_INDEPENDENT = {"sampler": {"type": "independent"}}
_STRATIFIED = {"sampler": {"type": "stratified"}}


def seven_lamps(root: Path) -> list[Panel]:
    """One lamp of seven: picked by power, evenly, and with better numbers."""
    renders, truth = _seven(root), _truth(root)

    def error(picture: Array) -> float:
        return _rms((picture - truth)[_surfaces(truth)]) / _brightness(truth)

    even = {**_INDEPENDENT, "integrator": {"light_selection": "uniform"}}
    rows = (("one lamp, by power", "orange", _INDEPENDENT),
            ("one lamp, evenly", "blue-dashed", even),
            ("one lamp, by power,\nstratified numbers", "green", _STRATIFIED))  # fmt: skip
    curves = (Curve(label, style, _curve(renders, error, o)) for label, style, o in rows)
    return [Panel("", tuple(curves))]


def bias_of_ambient(root: Path) -> list[Panel]:
    """A right program, a right one with less noise, and one with light in the shadows."""
    right, wrong, truth = _seven(root), _seven(root, AMBIENT), _truth(root)
    surfaces = _surfaces(truth)[..., None]

    def error(picture: Array) -> float:
        return _rms(tiles((picture - truth) * surfaces)) / _brightness(truth)

    rows = (("right", "blue", right, _INDEPENDENT),
            ("right, less noise", "green", right, _STRATIFIED),
            ("wrong: light\nin the shadows", "orange", wrong, _INDEPENDENT))  # fmt: skip
    curves = (Curve(label, style, _curve(who, error, o)) for label, style, who, o in rows)
    return [Panel("", tuple(curves))]


def samplers(root: Path) -> list[Panel]:
    """The three samplers on two scenes, each error from two pictures with different seeds."""
    kinds = (("independent", "orange"), ("stratified", "blue"), ("sobol", "green"))
    panels = []
    for scene in SAMPLED:
        renders = Renders(root, scene, (160, 128))
        curves = []
        for kind, style in kinds:
            override = {"sampler": {"type": kind}}
            errors = tuple((n, _from_two(renders, n, override)) for n in (4, 16, 64))
            curves.append(Curve(kind, style, errors))
        panels.append(Panel(Path(scene).stem, tuple(curves)))
    return panels


def tiles(picture: Array) -> Array:
    """The means of squares of 8 x 8 pixels."""
    rows, columns = picture.shape[0] // _TILE, picture.shape[1] // _TILE
    cut = picture[: rows * _TILE, : columns * _TILE]
    means: Array = cut.reshape(rows, _TILE, columns, _TILE, -1).mean(axis=(1, 3))
    return means


def _seven(root: Path, mistake: str = "") -> Renders:
    return Renders(root, SEVEN, (48, 48), mistake)


@cache
def _truth(root: Path) -> Array:
    return _seven(root).draw(_TRUTH, _TRUTH_SEED, _STRATIFIED)


def _surfaces(truth: Array) -> NDArray[np.bool_]:
    """All but the lamp."""
    mask: NDArray[np.bool_] = luminance(truth) < _LAMP
    return mask


def _brightness(truth: Array) -> float:
    return float(truth[_surfaces(truth)].mean())


def _curve(
    renders: Renders, error: Callable[[Array], float], override: Override
) -> tuple[tuple[int, float], ...]:
    return tuple((n, _pooled(renders, n, override, error)) for n in _SPP)


def _pooled(
    renders: Renders, spp: int, override: Override, error: Callable[[Array], float]
) -> float:
    """The root mean square error over some seeds: fewer where a picture has more samples."""
    seeds = range(1, 1 + max(2, min(16, 1024 // spp)))
    return _rms([error(renders.draw(spp, seed, override)) for seed in seeds])


def _from_two(renders: Renders, spp: int, override: Override) -> float:
    """A difference of two has twice the variance of one."""
    first, second = (renders.draw(spp, seed, override) for seed in (1, 2))
    return _rms(first - second) / math.sqrt(2.0) / float((first + second).mean() / 2.0)


def _rms(values: Array | Sequence[float]) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
