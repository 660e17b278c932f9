"""What the judge keeps of a reference: many seeds of one scene, reduced to a few arrays."""

import io
import os
import zipfile
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import BadInput
from ..files import write_bytes
from .pixels import Array, Image, Map, luminance
from .tiles import tile_means

VERSION = 1
MIN_CHUNKS = 64  # so that the variances of the means are known to 18 % (one standard deviation)
TILE_SIZES = (16, 32)


class UnusableReference(BadInput):
    """The reference's chunks or its file can't be used; the text says why."""


@dataclass(frozen=True)
class ReferenceStatistics:
    """The mean of all chunks, and how well each of its summaries is known."""

    mean: Image
    pixel_variance: Map  # of the luminance of one sample
    tile_mean: dict[int, Array]  # tile size -> luminance (rows, columns)
    tile_variance: dict[int, Array]  # of tile_mean, not of one chunk
    channel_mean: Array  # (3,) over the whole picture
    channel_variance: Array  # of channel_mean
    chunks: int
    spp: int  # of all chunks together

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width."""
        return self.mean.shape[0], self.mean.shape[1]

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a compressed npz, complete or not at all."""
        arrays: dict[str, Any] = {f"tile_mean_{s}": a for s, a in self.tile_mean.items()}
        arrays |= {f"tile_variance_{s}": a for s, a in self.tile_variance.items()}
        for name in ("mean", "pixel_variance", "channel_mean", "channel_variance", "chunks", "spp"):
            arrays[name] = np.asarray(getattr(self, name))

        file = io.BytesIO()
        np.savez_compressed(file, version=np.int64(VERSION), **arrays)
        write_bytes(Path(path), file.getvalue())

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> "ReferenceStatistics":
        """Read what `save` wrote; raises `UnusableReference`."""
        try:
            with np.load(path, allow_pickle=False) as arrays:
                return cls._of_arrays(arrays)
        except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
            raise UnusableReference(f"{path}: not a saved reference ({error})") from None

    @classmethod
    def _of_arrays(cls, arrays: Any) -> "ReferenceStatistics":
        if int(arrays["version"]) != VERSION:
            raise ValueError(f"version {int(arrays['version'])}, expected {VERSION}")
        return cls(
            mean=arrays["mean"],
            pixel_variance=arrays["pixel_variance"],
            tile_mean={s: arrays[f"tile_mean_{s}"] for s in TILE_SIZES},
            tile_variance={s: arrays[f"tile_variance_{s}"] for s in TILE_SIZES},
            channel_mean=arrays["channel_mean"],
            channel_variance=arrays["channel_variance"],
            chunks=int(arrays["chunks"]),
            spp=int(arrays["spp"]),
        )


class Moments:
    """Mean and variance of a stream of equally shaped arrays (Welford 1962)."""

    def __init__(self) -> None:
        self.count = 0
        self.mean: Array = np.zeros(())
        self._squares: Array = np.zeros(())

    def add(self, values: Array) -> None:
        """Take one more."""
        self.count += 1
        step = values - self.mean
        self.mean = self.mean + step / self.count
        self._squares = self._squares + step * (values - self.mean)

    @property
    def variance(self) -> Array:
        """Unbiased variance of one value; needs two."""
        return self._squares / (self.count - 1)


def reduce_reference(
    chunks: Iterable[Image], spp_per_chunk: int, min_chunks: int = MIN_CHUNKS
) -> ReferenceStatistics:
    """Reduce renders of one scene, one seed and `spp_per_chunk` samples a pixel each.

    Holds one chunk at a time. Raises `UnusableReference` on a chunk that is not finite or of
    another size, and when there are fewer than `min_chunks`.
    """
    pixels, light, channels = Moments(), Moments(), Moments()
    tiles = {size: Moments() for size in TILE_SIZES}
    for number, chunk in enumerate(chunks):
        _check_chunk(chunk, number, pixels)
        grey = luminance(chunk)
        pixels.add(np.asarray(chunk, dtype=np.float64))
        light.add(grey)
        channels.add(chunk.mean(axis=(0, 1), dtype=np.float64))
        for size, moments in tiles.items():
            moments.add(tile_means(grey, size))
    count = pixels.count
    if count < max(min_chunks, 2):
        raise UnusableReference(f"{count} chunks; a reference needs at least {min_chunks}")
    return ReferenceStatistics(
        mean=pixels.mean.astype(np.float32),
        pixel_variance=(light.variance * spp_per_chunk).astype(np.float32),
        tile_mean={size: moments.mean for size, moments in tiles.items()},
        tile_variance={size: moments.variance / count for size, moments in tiles.items()},
        channel_mean=channels.mean,
        channel_variance=channels.variance / count,
        chunks=count,
        spp=count * spp_per_chunk,
    )


def _check_chunk(chunk: Image, number: int, pixels: Moments) -> None:
    expected = pixels.mean.shape if pixels.count else (*chunk.shape[:2], 3)
    if chunk.shape != expected or chunk.size == 0:
        raise UnusableReference(f"chunk {number} has shape {chunk.shape}, expected {expected}")
    if not np.isfinite(chunk).all():
        raise UnusableReference(f"chunk {number} holds NaN or infinite pixels")
