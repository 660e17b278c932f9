"""One look at an estimator: its renders reduced to what the bias tests ask about."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .differences import Difference, moderated_welch, paired, quieter, welch
from .pixels import LUMINANCE, Array, Image, luminance
from .reference import ReferenceStatistics
from .thresholds import Thresholds
from .tiles import tile_means

NOTHING = 1e-30  # added where a black picture would make a scale zero


@dataclass(frozen=True)
class Evidence:
    """Differences from the reference with their scales; means of luminance by pixel."""

    shape: tuple[int, int]
    channels: Difference  # (3,)
    channel_scale: Array  # what a channel's difference is relative to
    overall: float  # relative difference of the mean luminance
    tiles: dict[int, Difference]
    tile_scale: dict[int, Array]
    mean: Array  # luminance (height, width)
    mean_variance: Array  # of `mean`; never below what the reference's estimator would have
    noise_ratio: float  # variance of a sample, relative to the reference's


def measure(
    stack: Image,
    reference: ReferenceStatistics,
    spp: int,
    tile_sizes: Sequence[int],
    limits: Thresholds,
    twins: Image | None = None,
) -> Evidence:
    """Reduce finite renders (seeds, height, width, 3) of `spp` samples a pixel each.

    `twins` are the reference's renders at the same seeds, if there are any.
    """
    grey = luminance(stack)
    picture = float(luminance(reference.mean).mean())
    dark = limits.dark_floor * picture + NOTHING
    channels = _channels(stack, reference, spp, twins)
    return Evidence(
        shape=reference.shape,
        channels=channels,
        channel_scale=np.maximum(reference.channel_mean, dark),
        overall=float(channels.value @ LUMINANCE) / (picture + NOTHING),
        tiles={size: _tiles(grey, reference, size, spp, twins) for size in tile_sizes},
        tile_scale={size: reference.tile_mean[size] + dark for size in tile_sizes},
        mean=grey.mean(axis=0),
        mean_variance=np.maximum(
            grey.var(axis=0, ddof=1) / len(stack), reference.pixel_variance / (len(stack) * spp)
        ),
        noise_ratio=noise_ratio(grey, reference, spp, limits),
    )


def rms_bias(difference: Difference, scale: Array) -> float:
    """Root mean square of the relative differences, less what their noise adds on average."""
    squares = (difference.value**2 - difference.variance) / scale**2
    return float(np.sqrt(max(squares.mean(), 0.0)))


def noise_ratio(grey: Array, reference: ReferenceStatistics, spp: int, limits: Thresholds) -> float:
    """Relative variance of one sample over the reference's, averaged over the picture.

    Relative to each one's own mean brightness, so that a light four times too bright is wrong and
    not "noisy".
    """
    expected = luminance(reference.mean)
    picture = expected.mean() + NOTHING
    scale = (expected + limits.dark_floor * picture) ** 2
    own = (grey.var(axis=0, ddof=1) * spp / scale).mean() * (picture / (grey.mean() + NOTHING)) ** 2
    return float(own / max((reference.pixel_variance / scale).mean(), limits.harmless_variance))


def _channels(
    stack: Image, reference: ReferenceStatistics, spp: int, twins: Image | None
) -> Difference:
    means = stack.mean(axis=(1, 2), dtype=np.float64)
    unpaired = welch(
        means,
        reference.channel_mean,
        reference.channel_variance,
        reference.chunks,
        reference.channel_variance * _noise_share(len(stack) * spp, reference),
    )
    if twins is None:
        return unpaired
    return quieter(unpaired, paired(means, twins.mean(axis=(1, 2), dtype=np.float64)))


def _tiles(
    grey: Array, reference: ReferenceStatistics, size: int, spp: int, twins: Image | None
) -> Difference:
    means = tile_means(grey, size)
    variance = reference.tile_variance[size]
    unpaired = moderated_welch(
        means,
        reference.tile_mean[size],
        variance,
        reference.chunks,
        variance * _noise_share(len(grey) * spp, reference),
    )
    if twins is None:
        return unpaired
    return quieter(unpaired, paired(means, tile_means(luminance(twins), size)))


def _noise_share(samples: int, reference: ReferenceStatistics) -> float:
    """The variance of the reference's estimator at `samples` a pixel, over that of its mean."""
    return reference.spp / samples
