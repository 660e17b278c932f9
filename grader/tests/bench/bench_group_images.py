"""Whole pictures beside Mitsuba 3's: groups `images` (equal samples) and `variance x time` (each
at its best).

A ratio only counts where the two pictures are the same within noise, or nearly so: each channel's
mean, and tile by tile (pixel_bias.py). `make mitsuba` is the stricter comparison.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt
from bench_effort import Effort
from bench_machine import busy
from bench_renderers import MITSUBA, Failed, Renderer, Shot, mitsuba, mitsuba_missing, ours
from bench_rows import Row, Spread, ratios, spread
from bench_scenes import SCENES, BenchScene

sys.path.insert(0, str(MITSUBA))
from pixel_bias import pixel_bias

Light = npt.NDArray[np.float64]

VARIANTS = ("scalar_rgb", "llvm_ad_rgb")
MEAN_LIMIT = 0.005
TILE_LIMIT = 0.01
TILE = 4  # pixels; single ones are too noisy at a few samples
DEVIATIONS = 5.0
DARKEST = 0.1  # of the mean
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def image_rows(effort: Effort) -> Iterator[Row]:
    """Both groups: a row for each scene and variant."""
    why = mitsuba_missing(effort.may_install)
    with tempfile.TemporaryDirectory(prefix="raybook-bench-") as folder:
        for scene in SCENES:
            for variant in VARIANTS:
                yield from _rows(effort, scene, variant, Path(folder), why)


def _rows(
    effort: Effort, scene: BenchScene, variant: str, scratch: Path, why: str
) -> Iterator[Row]:
    peer = f"mitsuba {variant}"
    speed = Row("images", "path", scene.name, "equal samples", peer, unit="Msamples/s")
    best = Row("variance x time", "path", scene.name, "each at its best", peer, unit="1/(s var)")
    if why:
        yield speed.missing(why)
        yield best.missing(why)
        return
    try:
        yield speed_row(speed, Duel(scene, scratch, effort, variant).fight("-"))
    except Failed as error:
        yield speed.missing(f"Mitsuba: {error}")
    try:
        duel = Duel(scene, scratch, effort, variant, best=True)
        found = [best_row(best, duel.fight(sampler), sampler) for sampler in effort.samplers]
        yield min(found, key=lambda row: (bool(row.fault), row.ratio or 0))
    except Failed as error:
        yield best.missing(f"Mitsuba: {error}")


@dataclass(frozen=True)
class Pictures:
    """Of both renderers, one of a seed at a time in turn, after one each to warm up."""

    ours: Sequence[Shot]
    theirs: Sequence[Shot]
    samples: int  # of a picture


@dataclass(frozen=True)
class Duel:
    """One scene that both render."""

    scene: BenchScene
    scratch: Path
    effort: Effort
    variant: str
    best: bool = False

    def fight(self, sampler: str) -> Pictures:
        """Render with both in turn."""
        resolution = (self.effort.side, self.effort.side)
        file = self.scene.write(self.scratch, resolution, self.best)
        with (
            ours(file, self.scratch, resolution) as we,
            mitsuba(file, self.scratch, resolution, self.variant, sampler) as they,
        ):
            shots = [(self._shoot(we, seed), self._shoot(they, seed)) for seed in self._seeds()]
        mine, theirs = zip(*shots[1:], strict=True)
        return Pictures(mine, theirs, self.effort.side**2 * self.effort.spp)

    def _seeds(self) -> range:
        return range(self.effort.seeds + 1)

    def _shoot(self, renderer: Renderer, seed: int) -> Shot:
        return renderer.shoot(seed, self.effort.spp)


def speed_row(row: Row, found: Pictures) -> Row:
    """How much faster ours takes the same number of samples."""
    mine, theirs = times(found.ours), times(found.theirs)
    speed = spread([found.samples / s / 1e6 for s in mine])
    row = replace(row, figure=speed.median).beside(ratios(theirs, mine))
    return _judged(row, found)


def best_row(row: Row, found: Pictures, sampler: str) -> Row:
    """How many times as much time the peer needs for pictures as good."""
    scale = scale_of(found)
    one, other = efficiency(found.ours, scale), efficiency(found.theirs, scale)
    row = replace(row, figure=one.median).beside(quotient(one, other))
    row = _judged(row, found)
    return replace(row, note=f"{row.note}; Mitsuba's sampler: {sampler}")


def _judged(row: Row, found: Pictures) -> Row:
    note, same = compare(pixels(found.ours), pixels(found.theirs))
    return replace(row, note=note, fault="" if same else "the pictures differ")


def times(shots: Sequence[Shot]) -> list[float]:
    """Processor time of each."""
    return [shot.cpu for shot in shots]


def pixels(shots: Sequence[Shot]) -> list[npt.NDArray[np.float32]]:
    """The pictures."""
    return [shot.pixels for shot in shots]


def scale_of(found: Pictures) -> Light:
    """What a pixel's error is measured by: how bright both renderers show it, and no less than a
    tenth of the picture's mean. Without it a handful of pixels at the rim of a lamp is all that
    counts. (The relative error of F. Rousselle, C. Knaus and M. Zwicker, "Adaptive Sampling and
    Reconstruction using Greedy Error Minimization", ACM Transactions on Graphics 30, 2011.)"""
    light: Light = luminance([*found.ours, *found.theirs]).mean(axis=0)
    darkest: float = DARKEST * light.mean()
    return light + darkest


def luminance(shots: Sequence[Shot]) -> Light:
    """Of every picture: (pictures, height, width)."""
    light: Light = np.stack(pixels(shots)).astype(float) @ LUMINANCE
    return light


def variances(shots: Sequence[Shot], scale: Light) -> Light:
    """A pixel's relative variance, the mean over the pixels: of all pictures, then with each left
    out."""
    light = luminance(shots) / scale
    every = [np.delete(light, i, axis=0) for i in range(len(light))] if len(light) > 2 else []
    return np.array([part.var(axis=0, ddof=1).mean() for part in (light, *every)])


def efficiency(shots: Sequence[Shot], scale: Light) -> Spread:
    """1 / (variance x time), and how far it is from sure: one standard error (jackknife)."""
    all_of_them, *others = variances(shots, scale)
    n = len(others)
    error = np.sqrt((n - 1) / n * np.sum((np.array(others) - np.mean(others)) ** 2)) if n else 0.0
    value = 1 / (all_of_them * spread(times(shots)).median)
    relative = float(error / all_of_them)
    return Spread(float(value), float(value * (1 - relative)), float(value * (1 + relative)))


def quotient(one: Spread, other: Spread) -> Spread:
    """Their ratio; relative errors of independent figures add up as squares."""
    value = one.median / other.median
    relative = np.hypot(one.high / one.median - 1, other.high / other.median - 1)
    return Spread(value, float(value * (1 - relative)), float(value * (1 + relative)))


def compare(
    one: Sequence[npt.NDArray[np.float32]], other: Sequence[npt.NDArray[np.float32]]
) -> tuple[str, bool]:
    """Are the two renderers' pictures the same but for noise? What to say of it, and the answer."""
    means = [np.stack(side).mean(axis=(1, 2), dtype=float) for side in (one, other)]
    difference = means[0].mean(axis=0) / means[1].mean(axis=0) - 1
    variance = sum(side.var(axis=0, ddof=1) / len(side) for side in means)
    error = np.sqrt(variance) / means[1].mean(axis=0)
    channel = int(np.argmax(np.abs(difference)))
    close = np.abs(difference) <= np.maximum(MEAN_LIMIT, DEVIATIONS * error)
    bias = pixel_bias([tiles(p) for p in one], [tiles(p) for p in other], share=1)
    text = (
        f"means differ by {100 * difference[channel]:+.2f} % ± {100 * error[channel]:.2f}, "
        f"{TILE} x {TILE} pixels by {100 * bias.rms:.1f} % ({bias.deviations:+.1f}σ)"
    )
    same = bias.rms <= TILE_LIMIT or bias.deviations <= DEVIATIONS
    return text, bool(close.all() and same)


def tiles(picture: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
    """The means of small squares."""
    height, width = (size // TILE for size in picture.shape[:2])
    cut = picture[: height * TILE, : width * TILE]
    means: npt.NDArray[np.float32] = cut.reshape(height, TILE, width, TILE, 3).mean(axis=(1, 3))
    return means


def thread_rows(effort: Effort) -> Iterator[Row]:
    """Our picture by two threads beside one."""
    row = Row("threads", "image", SCENES[0].name, "path", "1 thread", unit="Msamples/s")
    resolution = (effort.side, effort.side)
    with tempfile.TemporaryDirectory(prefix="raybook-bench-") as folder:
        file = SCENES[0].write(Path(folder), resolution)
        with ours(file, Path(folder), resolution, alone=False) as we:
            walls = [
                [we.shoot(seed, effort.spp, threads).wall for threads in (1, 2)]
                for seed in range(effort.repeats + 1)
            ][1:]
    one, two = ([pair[i] for pair in walls] for i in (0, 1))
    samples = effort.side**2 * effort.spp
    speed = samples / spread(two).median / 1e6
    yield replace(row, figure=speed, note=busy()).beside(ratios(one, two))
