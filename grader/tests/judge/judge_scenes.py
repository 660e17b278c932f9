"""Synthetic scenes whose true radiance is known, rendered by drawing noise."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from raybook_grader.judge.pixels import Array, Image, Mask
from raybook_grader.judge.reference import ReferenceStatistics, reduce_reference

SPP = 32
REFERENCE_SPP = 64  # a chunk


def shade(x: Array, y: Array) -> Array:
    """Radiance at picture coordinates in [0, 1): a tinted wall, a floor, a ball and a lamp."""
    wall = 0.25 + 0.6 * x[..., None] * np.array([1.0, 0.8, 0.6]) + 0.2 * y[..., None]
    check = ((np.floor(x * 12) + np.floor(y * 12)) % 2)[..., None]
    floor = np.where(check > 0, [0.5, 0.3, 0.2], [0.12, 0.14, 0.2]) * (1.5 - y[..., None])
    image = np.where((y > 0.6)[..., None], floor, wall)
    image = np.where((np.hypot(x - 0.3, y - 0.45) < 0.18)[..., None], [0.04, 0.06, 0.10], image)
    lamp = (np.abs(x - 0.7) < 0.08) & (y < 0.1)
    return np.where(lamp[..., None], [6.0, 5.5, 4.5], image)


def radiance(height: int = 128, width: int = 128) -> Array:
    """One sample at every pixel's corner: no anti-aliasing, no noise."""
    y, x = np.mgrid[0:height, 0:width] / np.array([height, width]).reshape(2, 1, 1)
    return shade(x, y)


def jittered(seed: int, spp: int, size: int = 128) -> Image:
    """Anti-aliased, so that only the edges are noisy."""
    random = np.random.default_rng(seed)
    y, x = np.mgrid[0:size, 0:size]
    total = np.zeros((size, size, 3))
    for _ in range(spp):
        dx, dy = random.random((2, size, size))
        total += shade((x + dx) / size, (y + dy) / size)
    return (total / spp).astype(np.float32)


@dataclass(frozen=True)
class Estimator:
    """An unbiased estimator of `truth`: each sample gamma distributed around it.

    `variance` is the relative variance of one sample: 1 is exponential; above, most samples are
    nearly black and a few are bright. `noisy` masks the pixels that are random at all.
    """

    truth: Array
    variance: float = 1.0
    noisy: Array | Mask | bool = True

    def image(self, seed: int, spp: int = SPP) -> Image:
        """One seed's picture."""
        random = np.random.default_rng([seed, spp])
        shape = spp / self.variance
        factor = random.gamma(shape, 1 / shape, self.truth.shape[:2])
        factor = np.where(self.noisy, factor, 1.0)
        return (self.truth * factor[..., None]).astype(np.float32)

    def seeds(self, offset: int = 0) -> Callable[[Sequence[int]], Image]:
        """The function that `verdict` asks for renders."""
        return lambda seeds: np.stack([self.image(offset + seed) for seed in seeds])

    def scaled(self, factor: float | Array) -> "Estimator":
        """The same estimator with a wrong brightness."""
        return replace(self, truth=self.truth * factor)


def reference_of(estimator: Estimator, chunks: int = 64) -> ReferenceStatistics:
    """64 chunks of 64 samples: 4096 spp."""
    images = (estimator.image(900_000 + n, REFERENCE_SPP) for n in range(chunks))
    return reduce_reference(images, REFERENCE_SPP)
