"""Images that no statistics can save: each refusal is a fact, and needs no second look."""

from collections.abc import Callable, Sequence

import numpy as np

from .findings import Reason, first_pixel
from .pixels import Image, luminance
from .reference import ReferenceStatistics
from .thresholds import Thresholds

_BAD: dict[str, Callable[[Image], object]] = {
    "nan": np.isnan,
    "infinite": np.isinf,
    "negative": lambda image: np.less(image, 0),
}


def refusals(
    images: Sequence[Image],
    seeds: Sequence[int],
    reference: ReferenceStatistics,
    limits: Thresholds,
) -> list[Reason]:
    """Every refusal that applies; a wrong size hides the others."""
    wrong_size = _wrong_size(images, seeds, reference)
    if wrong_size:
        return [wrong_size]
    found = [_bad_pixels(images, seeds, code) for code in ("nan", "infinite", "negative")]
    found.append(_identical(images, seeds, reference, limits))
    return [reason for reason in found if reason]


def _wrong_size(
    images: Sequence[Image], seeds: Sequence[int], reference: ReferenceStatistics
) -> Reason | None:
    height, width = reference.shape
    for image, seed in zip(images, seeds, strict=True):
        if image.shape != (height, width, 3):
            has = " x ".join(str(n) for n in (image.shape[1], image.shape[0], *image.shape[2:]))
            sentence = (
                f"the image of seed {seed} is {has} (width, height, channels), "
                f"expected {width} x {height} x 3"
            )
            return Reason("size", float(image.size), sentence)
    return None


def _bad_pixels(images: Sequence[Image], seeds: Sequence[int], code: str) -> Reason | None:
    for image, seed in zip(images, seeds, strict=True):
        bad = np.asarray(_BAD[code](image)).any(axis=-1)
        if bad.any():
            x, y = first_pixel(bad)
            count = int(bad.sum())
            noun = "pixel is" if count == 1 else "pixels are"
            word = {"nan": "NaN (not a number)"}.get(code, code)
            first = "at" if count == 1 else "the first at"
            sentence = f"{count} {noun} {word} in the image of seed {seed}, {first} x={x}, y={y}"
            return Reason(code, float(count), sentence)
    return None


def _identical(
    images: Sequence[Image],
    seeds: Sequence[int],
    reference: ReferenceStatistics,
    limits: Thresholds,
) -> Reason | None:
    if not reference_is_random(reference, limits):
        return None
    met: dict[bytes, int] = {}
    for image, seed in zip(images, seeds, strict=True):
        twin = met.setdefault(image.tobytes(), seed)
        if twin != seed:
            sentence = (
                f"the images of seeds {twin} and {seed} are identical: the seed has no effect"
            )
            return Reason("identical", float(seed), sentence)
    return None


def reference_is_random(reference: ReferenceStatistics, limits: Thresholds) -> bool:
    """Whether the reference's own noise says that two seeds' images must differ."""
    grey = luminance(reference.mean)
    scale = (grey + limits.dark_floor * grey.mean()) ** 2 + 1e-60
    return bool((reference.pixel_variance / scale).mean() > limits.random_variance)
