"""The noise of a difference when there is only one picture of each: taken from within the pair.

Two right renders with other random numbers differ by noise that changes from pixel to pixel and
averages out; a bias keeps its sign over many pixels. So blocks of pixels inside a tile serve as
the samples that seeds are for `bias`. What is wrong in a way that looks like noise (every other
texel, or one pixel in a noisy picture) can't be told from it without more seeds.
"""

from itertools import pairwise

import numpy as np

from .differences import Difference
from .evidence import NOTHING, Evidence
from .pixels import LUMINANCE, Array, Image, Map, luminance
from .thresholds import ALL_TILES, Thresholds
from .tiles import spread, tile_counts, tile_means

_BLOCK = 4  # pixels: neighbours share samples under a reconstruction filter up to this wide
_OUTLIER = 3.0  # a difference this many standard deviations large is not taken for noise
_MAD_TO_SIGMA = 1.4826
# A tile's standard deviation is the robust one, which edges that moved don't touch, but at least
# this part of the plain one: where only edges are random (jittered pixels), they are the noise.
_PLAIN_SHARE = 0.5


def pair_evidence(reference: Image, test: Image, limits: Thresholds) -> Evidence:
    """`evidence.measure` for one picture against one, both finite."""
    difference = np.asarray(test, dtype=np.float64) - reference
    grey, expected = luminance(difference), luminance(reference)
    shape = (grey.shape[0], grey.shape[1])
    block = _BLOCK if min(shape) >= 8 * _BLOCK else 1
    dark = limits.dark_floor * float(expected.mean()) + NOTHING
    channel_means = reference.mean(axis=(0, 1), dtype=np.float64)
    channels = _channels(difference, block, channel_means)
    return Evidence(
        shape=shape,
        channels=channels,
        channel_scale=np.maximum(channel_means, dark),
        overall=float(channels.value @ LUMINANCE) / (float(expected.mean()) + NOTHING),
        tiles={size: _tiles(grey, expected, block, size) for size in ALL_TILES},
        tile_scale={size: tile_means(expected, size) + dark for size in ALL_TILES},
        mean=luminance(test),
        mean_variance=np.zeros(shape),
        noise_ratio=1.0,
    )


def shift(reference: Image, test: Image) -> tuple[Difference, float]:
    """By how many pixels (x, y) the test picture looks moved, and the part of the difference's
    energy that the move explains.

    First order: test - reference = -(sx, sy) . gradient(reference), by least squares. The central
    gradient leaves out the pixel itself, so the reference's own noise does not enter twice.
    """
    grey, expected = luminance(test) - luminance(reference), luminance(reference)
    across = (expected[1:-1, 2:] - expected[1:-1, :-2]).ravel() / 2
    down = (expected[2:, 1:-1] - expected[:-2, 1:-1]).ravel() / 2
    slopes, seen = np.stack([across, down]), grey[1:-1, 1:-1].ravel()
    nothing = Difference(np.zeros(2), np.full(2, NOTHING), np.full(2, max(seen.size - 2, 1.0)))
    squares = slopes @ slopes.T
    if seen.size < 64 or np.linalg.cond(squares) > 1e8:
        return nothing, 0.0
    moved: Array = -np.linalg.solve(squares, slopes @ seen).astype(np.float64)
    left = seen + moved @ slopes
    inverse = np.linalg.inv(squares)
    # White 1980: the noise is as uneven as the picture.
    variance = np.diag(inverse @ (slopes * left**2) @ slopes.T @ inverse) + NOTHING
    explained = 1 - float(left @ left) / (float(seen @ seen) + NOTHING)
    return Difference(moved, variance, nothing.freedom), explained


def noise_twin(reference: Image, test: Image) -> Image:
    """The reference plus noise like the pair's: local, of random sign, without outliers.

    Its visible difference from the reference is what noise alone explains.
    """
    difference = np.asarray(test, dtype=np.float64) - reference
    shape = (difference.shape[0], difference.shape[1])
    means = np.stack([tile_means(difference[..., c], 16) for c in range(3)], axis=-1)
    rest = difference - spread(means, shape, 16)
    size = np.abs(luminance(rest))
    robust = _MAD_TO_SIGMA * _tile_medians(size)
    plain = np.sqrt(spread(tile_means(size**2, 16), shape, 16))
    limit = _OUTLIER * np.maximum(robust, _PLAIN_SHARE * plain)
    kept = np.minimum(1.0, limit / np.maximum(size, NOTHING))
    sign = np.random.default_rng(0).choice([-1.0, 1.0], shape)
    twin: Image = (reference + rest * (kept * sign)[..., None]).astype(np.float32)
    return twin


def _channels(difference: Array, block: int, scale: Array) -> Difference:
    blocks = np.stack([tile_means(difference[..., c], block).ravel() for c in range(3)])
    count = blocks.shape[1]
    variance = blocks.var(axis=1, ddof=1) / count if count > 1 else np.zeros(3)
    freedom = np.full(3, max(count - 1.0, 1.0))
    return Difference(blocks.mean(axis=1), variance + _rounding(scale), freedom)


def _tiles(grey: Array, expected: Array, block: int, size: int) -> Difference:
    blocks = tile_means(grey, block)
    per_tile = size // block
    means = tile_means(blocks, per_tile)
    counts = tile_counts((blocks.shape[0], blocks.shape[1]), per_tile)
    free = np.maximum(counts - 1, 1)
    squares = np.maximum(tile_means(blocks**2, per_tile) - means**2, 0.0)
    value = tile_means(grey, size)
    return Difference(value, squares / free + _rounding(tile_means(expected, size)), free)


def _rounding(scale: Array) -> Array:
    floor: Array = (1e-6 * np.abs(scale)) ** 2 + NOTHING**2
    return floor


def _tile_medians(values: Array | Map) -> Array:
    """Every pixel gets the median of its 16 x 16 tile."""
    height, width = values.shape
    medians = np.empty((height, width))
    for rows in _bands(height):
        for columns in _bands(width):
            medians[rows, columns] = np.median(values[rows, columns])
    return medians


def _bands(length: int, size: int = 16) -> list[slice]:
    edges = [*range(0, max(length // size, 1) * size, size), length]
    return [slice(a, b) for a, b in pairwise(edges)]
