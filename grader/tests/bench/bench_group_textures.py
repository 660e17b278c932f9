"""A filter over the footprint beside more samples: group `textures`.

Bilinear lookups with very many samples are what every way converges to, or nearly: a filter is a
little too wide, and stays so. With one sample a pixel it is nearer to that picture than one lookup
is; how long must lookups go on until they are as near?
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
from bench_effort import Effort
from bench_renderers import Pixels, ours
from bench_rows import Row, spread
from bench_scenes import BILINEAR, SOBOL, BenchScene, Json, merged

DIRECT: Json = {"integrator": {"type": "direct", "light_selection": "all"}}
"""The lights are no source of noise here."""

FILTERS = ("trilinear", "ewa")
LOOKUPS = "bilinear"
TAKEN = (1, 2, 4, 8, 16)  # samples a pixel
REFERENCE = 64  # times as many as the most of these
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


@dataclass(frozen=True)
class Point:
    """What so many samples a pixel cost, and how far from the truth they are (mean square)."""

    spp: int
    seconds: float
    error: float


Curves = dict[str, list[Point]]
"""By the filter's name."""

_measured: list[Curves] = []


def texture_curves() -> Curves | None:
    """What texture_rows measured last, for the plot."""
    return _measured[-1] if _measured else None


def texture_rows(effort: Effort) -> Iterator[Row]:
    """Seconds for the same error: the lookups' over the filter's with one sample a pixel."""
    found = curves(effort)
    _measured.append(found)
    for name in FILTERS:
        one = found[name][0]
        equal = seconds_for(found[LOOKUPS], one.error)
        ratio = equal / one.seconds
        yield Row(
            "textures", name, "textures", "at equal error", "bilinear lookups",
            figure=one.seconds * 1e3, unit="ms", ratio=ratio, low=ratio, high=ratio,
            note=f"mean square error {one.error:.2g}",
        )  # fmt: skip


def scene_with(name: str) -> BenchScene:
    """The textured scene with one filter for all its textures."""
    textures = {key: {"filter": name} for key in BILINEAR["textures"]}
    return BenchScene(name, "textures.json", merged(merged(DIRECT, SOBOL), {"textures": textures}))


def curves(effort: Effort) -> Curves:
    """All ways at several numbers of samples, measured against the truth."""
    side = effort.side
    resolution = (3 * side // 2, side)
    found: Curves = {}
    with tempfile.TemporaryDirectory(prefix="raybook-bench-") as folder:
        scratch = Path(folder)
        with ours(scene_with(LOOKUPS).write(scratch, resolution), scratch, resolution) as renderer:
            truth = _light(renderer.shoot(999, REFERENCE * TAKEN[-1]).pixels)
        for name in (LOOKUPS, *FILTERS):
            file = scene_with(name).write(scratch, resolution)
            with ours(file, scratch, resolution) as renderer:
                renderer.shoot(0, 1)
                shots = {spp: [renderer.shoot(seed, spp) for seed in range(3)] for spp in TAKEN}
            found[name] = [
                Point(
                    spp,
                    spread([shot.cpu for shot in same]).median,
                    float(np.mean([(_light(shot.pixels) - truth) ** 2 for shot in same])),
                )
                for spp, same in shots.items()
            ]
    return found


def seconds_for(points: Sequence[Point], error: float) -> float:
    """Where the curve reaches an error: between its points on straight lines in logarithms."""
    errors = [-np.log(point.error) for point in points]
    seconds = [np.log(point.seconds) for point in points]
    return float(np.exp(np.interp(-np.log(error), errors, seconds)))


def _light(pixels: Pixels) -> npt.NDArray[np.float64]:
    light: npt.NDArray[np.float64] = pixels.astype(float) @ LUMINANCE
    return light
