"""A filter over the footprint beside more samples: group `textures`.

The picture that everything converges to is the one of bilinear lookups with very many samples. At a
few samples a filter as wide as the pixel's footprint is nearer to it, though it never quite gets
there; how long must plain lookups go on until they are as near?
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt
from bench_effort import Effort
from bench_renderers import Pixels, ours
from bench_rows import Row, spread
from bench_scenes import BILINEAR, INDEPENDENT, ONE_BOUNCE, BenchScene, merged

PLAIN = BenchScene("bilinear", "textures.json", merged(merged(BILINEAR, ONE_BOUNCE), INDEPENDENT))
FILTERED = BenchScene("ewa", "textures.json", merged(ONE_BOUNCE, INDEPENDENT))
FEW = 4  # samples a pixel of the filtered picture
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


@dataclass(frozen=True)
class Point:
    """What so many samples a pixel cost, and how far from the truth they are (mean square)."""

    spp: int
    seconds: float
    error: float


@dataclass(frozen=True)
class Curves:
    """Errors of both, for the plot."""

    filtered: Sequence[Point]
    plain: Sequence[Point]


_measured: list[Curves] = []


def texture_curves() -> Curves | None:
    """What texture_rows measured last, for the plot."""
    return _measured[-1] if _measured else None


def texture_rows(effort: Effort) -> Iterator[Row]:
    """Seconds for the same error, the plain lookups' over the filter's."""
    found = curves(effort)
    _measured.append(found)
    row = Row("textures", "mipmap and EWA", "textures", f"{FEW} samples a pixel", "supersampling")
    one = next(point for point in found.filtered if point.spp == FEW)
    equal = seconds_for(found.plain, one.error)
    spp = equal / found.plain[0].seconds * found.plain[0].spp
    row = replace(
        row, figure=one.seconds * 1e3, unit="ms", note=f"as near with {spp:.0f} plain samples"
    )
    ratio = equal / one.seconds
    yield replace(row, ratio=ratio, low=ratio, high=ratio)


def curves(effort: Effort) -> Curves:
    """Both ways at several numbers of samples, measured against the truth."""
    resolution = (3 * effort.side // 2, effort.side)
    most = 64 if effort.side < 64 else 1024 if effort.side < 200 else 4096
    counts = [2**k for k in range(0, int(math.log2(most)) - 3)]
    with tempfile.TemporaryDirectory(prefix="raybook-bench-") as folder:
        scratch = Path(folder)
        plain, filtered = (s.write(scratch, resolution) for s in (PLAIN, FILTERED))
        with ours(plain, scratch, resolution) as one, ours(filtered, scratch, resolution) as other:
            truth = _light(one.shoot(999, most).pixels)
            shots = {
                name: [[r.shoot(seed, spp) for seed in range(3)] for spp in counts]
                for name, r in (("plain", one), ("filtered", other))
            }
    points = {
        name: [
            Point(
                spp,
                spread([shot.cpu for shot in same]).median,
                float(np.mean([(_light(shot.pixels) - truth) ** 2 for shot in same])),
            )
            for spp, same in zip(counts, all_of_them, strict=True)
        ]
        for name, all_of_them in shots.items()
    }
    return Curves(points["filtered"], points["plain"])


def seconds_for(points: Sequence[Point], error: float) -> float:
    """Where the curve reaches an error: on the straight line, in logarithms, through all points
    (independent samples: error and time are inverse to each other)."""
    products = [point.seconds * point.error for point in points]
    return math.exp(float(np.mean(np.log(products)))) / error


def _light(pixels: Pixels) -> npt.NDArray[np.float64]:
    return pixels.astype(float) @ LUMINANCE
