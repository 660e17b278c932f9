"""Do two renderers agree pixel by pixel? The judge looks at tiles and the whole picture: a filter
or a texture that is too sharp keeps the means of both.

It is asked twice: with all pixels alike, and with each as it is known, so that a noisy edge does
not hide the rest. The worse answer counts.

Each side has two independent halves. The product of the halves' differences is, on average, the
square of the true difference: what noise adds is independent in the two and averages to nothing.
"""

from dataclasses import dataclass

import numpy as np

from raybook_grader.judge.pixels import Array, Image

DARK_FLOOR = 0.05  # as the judge's: next to black, a ratio means nothing
RMS_LIMIT = 0.0025
DEVIATIONS = 4.0


@dataclass(frozen=True)
class PixelBias:
    """Root mean square of the relative differences, and how many deviations its square is from
    none."""

    rms: float
    deviations: float

    @property
    def fine(self) -> bool:
        """Small, or not more than noise."""
        return self.rms <= RMS_LIMIT or self.deviations <= DEVIATIONS


def pixel_bias(ours: list[Image], reference: list[Image], share: float) -> PixelBias:
    """Renders of one seed each (height, width, 3); `share`: how many times the samples of all of
    ours together the reference has."""
    stack = np.stack(reference).astype(float)
    mean: Array = stack.mean(axis=0)
    scale = mean + DARK_FLOOR * mean.mean(axis=(0, 1))
    # Of the reference only, which has more samples: a pixel of ours that lacks its rare bright
    # ones looks quiet, and is wrong.
    variance = (1 + share) * stack.var(axis=0, ddof=1) / len(stack) / scale**2
    weight = (RMS_LIMIT**2 + variance) ** -2
    pairs = zip(halves(ours), halves(reference), strict=True)
    first, second = ((a.astype(float) - b) / scale for a, b in pairs)
    squares = first * second
    answers = _mean_square(squares), _mean_square(weight / weight.mean() * squares)
    return max(answers, key=lambda bias: (not bias.fine, bias.deviations))


def _mean_square(squares: Array) -> PixelBias:
    pixels = squares.mean(axis=-1)
    error = float(pixels.std() / np.sqrt(pixels.size))
    square = float(pixels.mean())
    return PixelBias(np.sqrt(max(square, 0.0)), square / max(error, 1e-30))


def halves(images: list[Image]) -> tuple[Image, Image]:
    """The means of every other image."""
    return np.mean(images[::2], axis=0), np.mean(images[1::2], axis=0)
