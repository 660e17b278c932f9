"""The maps that modules are tried on: of all sizes, turned, mirrored, with suns."""

from __future__ import annotations

import numpy as np
from environment_truth import Array, Map, direction_at
from numpy.typing import NDArray

Texels = NDArray[np.float32]


def turned(rng: np.random.Generator, mirror: bool = False) -> NDArray[np.float32]:
    """A rotation about no axis in particular, or the mirror image of one."""
    matrix = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    if (np.linalg.det(matrix) < 0) != mirror:
        matrix = -matrix
    return matrix.astype(np.float32)


def varied(rng: np.random.Generator, width: int, height: int, black: float = 0.2) -> Texels:
    """Texels of all colours, a share of them black."""
    image = rng.uniform(0.05, 1.0, (height, width, 3)) * rng.uniform(0.2, 1.0, (height, width, 1))
    image[rng.random((height, width)) < black] = 0.0
    return image.astype(np.float32)


def with_sun(image: Texels, row: int, column: int, value: float, side: int = 1) -> Texels:
    bright = image.copy()
    columns = (column + np.arange(side)) % image.shape[1]
    bright[row : row + side, columns] = np.array([1.0, 0.9, 0.7], np.float32) * value
    return bright


def sky(width: int, height: int) -> Texels:
    """A bright blue dome over a darker ground, no texel black."""
    v = (np.arange(height) + 0.5) / height
    dome = np.where(v[:, None] < 0.5, np.outer(0.3 + v, [0.4, 0.6, 1.0]), [0.1, 0.08, 0.06])
    return np.repeat(dome[:, None, :], width, axis=1).astype(np.float32)


def glow(width: int, height: int) -> Texels:
    """A wide lobe of light on a dim ground: it changes little from texel to texel."""
    v, u = np.mgrid[0:height, 0:width]
    at = direction_at((u + 0.5) / width, (v + 0.5) / height)
    middle = direction_at(np.array(0.97), np.array(0.4))
    lobe: Array = 0.05 + 8 * np.exp(6 * (at @ middle - 1))
    return (lobe[..., None] * [1.0, 0.8, 0.5]).astype(np.float32)


def lookup_maps(rng: np.random.Generator) -> list[Map]:
    """For environment_radiance."""
    eye = np.eye(3, dtype=np.float32)
    quarter = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]], np.float32)
    tipped = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]], np.float32)
    small = varied(rng, 8, 4, 0.0)
    return [
        Map("a small map", small),
        Map("a small map", small, 3.0),
        Map("a quarter turn about the pole", small, 1.0, quarter),
        Map("the pole along +x", small, 1.0, tipped),
        Map("turned", varied(rng, 16, 8), 1.0, turned(rng)),
        Map("mirrored", varied(rng, 12, 6), 0.5, turned(rng, mirror=True)),
        Map("one texel", varied(rng, 1, 1, 0.0), 2.0, turned(rng)),
        Map("two columns", varied(rng, 2, 1, 0.0), 1.0, eye),
        Map("two rows", varied(rng, 1, 2, 0.0), 1.0, eye),
        Map("odd sizes", varied(rng, 5, 3, 0.0), 1.0, turned(rng)),
        Map("taller than wide", varied(rng, 3, 9, 0.0), 1.0, turned(rng)),
        Map("fine", varied(rng, 96, 48), 1.0, turned(rng)),
        Map("a sun", with_sun(sky(32, 16), 4, 31, 1e5), 1.0, turned(rng)),
        Map("scale 0", small, 0.0),
    ]


def sampling_maps(rng: np.random.Generator) -> list[Map]:
    """For sampling and its density."""
    single = np.zeros((4, 8, 3), np.float32)
    single[2, 7] = (1.0, 2.0, 4.0)
    blue = np.zeros((3, 6, 3), np.float32)
    blue[:, :, 2] = rng.uniform(0.1, 1, (3, 6))
    return [
        Map("a constant map", np.full((4, 8, 3), 0.7, np.float32)),
        Map("all kinds of texels", varied(rng, 12, 6)),
        Map("turned", varied(rng, 16, 8), 5.0, turned(rng)),
        Map("mirrored", varied(rng, 8, 4, 0.4), 0.2, turned(rng, mirror=True)),
        Map("one bright texel at the last column", single),
        Map("a bright row at the pole", with_sun(sky(16, 8), 0, 3, 50.0)),
        Map("a sun", with_sun(varied(rng, 32, 16, 0.5), 5, 12, 1e4), 1.0, turned(rng)),
        Map("blue only", blue, 1.0, turned(rng)),
        Map("one texel", np.full((1, 1, 3), 3.0, np.float32), 1.0, turned(rng)),
        Map("two columns", varied(rng, 2, 1, 0.0)),
        Map("tall", varied(rng, 3, 12), 1.0, turned(rng)),
    ]


def smooth_maps(rng: np.random.Generator) -> list[Map]:
    """Where proportional directions need a third of the samples of even ones, and less."""
    return [
        Map("a glow across the seam", glow(32, 16)),
        Map("a glow across the seam, turned", glow(48, 24), 1.0, turned(rng)),
    ]


def sunny_maps(rng: np.random.Generator) -> list[Map]:
    """Where nearly all the light comes from a few texels."""
    return [
        Map("a sun of one texel", with_sun(sky(32, 16), 4, 9, 1e5)),
        Map("a sun of 2 x 2 texels", with_sun(sky(64, 32), 9, 40, 2e4, 2), 1.0, turned(rng)),
        Map("a sun on the seam", with_sun(sky(32, 16), 6, 31, 3e4, 2), 1.0, turned(rng)),
        Map("a sun near the pole", with_sun(sky(32, 16), 1, 20, 1e5), 1.0, turned(rng)),
    ]
