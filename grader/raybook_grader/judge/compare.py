"""Two pictures, and nothing known about either: are they the same but for noise?

They are **the same** when the sizes agree, every pixel is a radiance, and none of these holds, each
with the limits in `thresholds` and noise measured within the pair (see `single_pair`):

    G, R, L16, L32   the bias tests of `bias`, on one look (no fresh seeds: about 4e-4 false alarms)
    shift            the test picture looks moved
    visible          FLIP exceeds what the pair's noise explains

Weaker than the grader's verdict, which has seeds: differences that look like noise pass, and the
noisier the pair, the larger they may be.
"""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .bias import global_test, rms_test, tile_test
from .evidence import Evidence, rms_bias
from .findings import Reason, first_pixel, percent
from .itp import ColourDifference, colour_difference
from .perceptual import flip
from .pixels import CHANNELS, Image, Map
from .single_pair import noise_twin, pair_evidence, shift
from .thresholds import ALL_TILES, THRESHOLDS, Thresholds
from .viewing import Viewing, viewing_of


@dataclass(frozen=True)
class PairNumbers:
    """What was measured, for pictures of one size."""

    flip: float
    noise_flip: float
    colour: ColourDifference
    overall_bias: float  # of the mean luminance
    channel_bias: tuple[float, float, float]
    rms_bias: float
    worst_tile: float
    flip_map: Map
    viewing: Viewing


@dataclass(frozen=True)
class Comparison:
    """`reasons` why the pictures differ: none when they are the same."""

    reasons: tuple[Reason, ...]
    numbers: PairNumbers | None = field(default=None)

    @property
    def same(self) -> bool:
        """No reason to call them different."""
        return not self.reasons

    @property
    def reason(self) -> str:
        """In words, one or several sentences."""
        if self.reasons:
            return "; ".join(reason.sentence for reason in self.reasons)
        return "the difference is no more than the noise in the two pictures explains"

    def as_json(self) -> dict[str, Any]:
        """The object that `raybook-grader compare --json` prints; null where nothing was measured.

        `bias.global` is the channel's that is furthest off.
        """
        n = self.numbers
        return {
            "same": self.same,
            "flip": n.flip if n else None,
            "flip_excess": n.flip - n.noise_flip if n else None,
            "delta_e_itp": {
                "mean": n.colour.mean if n else None,
                "p95": n.colour.p95 if n else None,
            },
            "bias": {
                "global": max(n.channel_bias, key=abs) if n else None,
                "rms": n.rms_bias if n else None,
                "worst_tile": n.worst_tile if n else None,
            },
            "reason": self.reason,
        }


def compare(
    reference: Image,
    test: Image,
    viewing: Viewing | None = None,
    limits: Thresholds = THRESHOLDS,
) -> Comparison:
    """Compare two pictures (height, width, 3); the reference must be finite.

    In the numbers, pixels of `test` that are no radiance count as black.
    """
    if reference.shape != test.shape:
        sizes = [f"{image.shape[1]} x {image.shape[0]}" for image in (test, reference)]
        sentence = f"the image is {sizes[0]} pixels, the reference {sizes[1]}"
        return Comparison((Reason("size", float(test.size), sentence),))
    viewing = viewing or viewing_of(reference)
    usable = np.nan_to_num(test, nan=0.0, posinf=0.0, neginf=0.0)
    seen = pair_evidence(reference, usable, limits)
    numbers = _numbers(reference, usable, seen, viewing)
    found = [
        _not_radiance(test, reference),
        global_test(seen, limits),
        rms_test(seen, ALL_TILES[0], limits),
        *(tile_test(seen, size, limits) for size in ALL_TILES),
        _shift_test(reference, usable, limits),
        _visible_test(numbers, limits),
    ]
    return Comparison(tuple(reason for reason in found if reason), numbers)


def _numbers(reference: Image, test: Image, seen: Evidence, viewing: Viewing) -> PairNumbers:
    value, flip_map = flip(reference, test, viewing)
    tiles, scale = seen.tiles[ALL_TILES[0]], seen.tile_scale[ALL_TILES[0]]
    clearest = np.argmax(np.abs(tiles.value) / np.sqrt(tiles.variance))
    red, green, blue = (seen.channels.value / seen.channel_scale).tolist()
    return PairNumbers(
        flip=value,
        noise_flip=flip(reference, noise_twin(reference, test), viewing)[0],
        colour=colour_difference(reference, test, viewing.white),
        overall_bias=seen.overall,
        channel_bias=(red, green, blue),
        rms_bias=rms_bias(tiles, scale),
        worst_tile=float((tiles.value / scale).flat[clearest]),
        flip_map=flip_map,
        viewing=viewing,
    )


def _not_radiance(test: Image, reference: Image) -> Reason | None:
    bad = (~np.isfinite(test)).any(axis=-1)
    if not (reference < 0).any():  # a filter with negative lobes makes negative pixels
        bad |= (test < 0).any(axis=-1)
    count = int(bad.sum())
    if not count:
        return None
    x, y = first_pixel(bad)
    which = "1 pixel is" if count == 1 else f"{count} pixels are"
    sentence = f"{which} NaN, infinite or negative, the first at x={x}, y={y}"
    return Reason("nan", float(count), sentence)


def _shift_test(reference: Image, test: Image, limits: Thresholds) -> Reason | None:
    moved, explained = shift(reference, test)
    across, down = moved.value.tolist()
    certain = 2 * moved.p_differs() < limits.alpha
    if (
        explained < limits.shift_explains
        or not (certain & (np.abs(moved.value) > limits.shift)).any()
    ):
        return None
    sentence = f"the image looks moved by {across:+.2f} pixels to the right and {down:+.2f} down"
    return Reason("shift", float(np.hypot(across, down)), sentence)


def _visible_test(numbers: PairNumbers, limits: Thresholds) -> Reason | None:
    excess = numbers.flip - numbers.noise_flip
    if excess <= limits.tolerated_excess(numbers.noise_flip):
        return None
    sentence = (
        f"the pictures look different: FLIP {numbers.flip:.3f}, of which noise explains "
        f"{numbers.noise_flip:.3f}"
    )
    return Reason("visible", excess, sentence)


def _channels_in_words(bias: tuple[float, float, float]) -> str:
    pairs = zip(CHANNELS, bias, strict=True)
    return ", ".join(f"{name} {percent(value, signed=True)}" for name, value in pairs)


def summary(comparison: Comparison) -> str:
    """The comparison for a reader at a terminal, several lines."""
    head = "same" if comparison.same else "different"
    lines = [
        f"{head}: {comparison.reasons[0].sentence if comparison.reasons else comparison.reason}"
    ]
    lines += [f"  also {reason.sentence}" for reason in comparison.reasons[1:]]
    n = comparison.numbers
    if n:
        lines += [
            f"  FLIP            {n.flip:.4f}, of which noise explains {n.noise_flip:.4f}",
            f"  Delta E ITP     mean {n.colour.mean:.2f}, 95th percentile {n.colour.p95:.2f}",
            f"  mean            {_channels_in_words(n.channel_bias)}",
            f"  16 x 16 tiles   {percent(n.rms_bias)} off (root mean square, noise taken out)",
        ]
    return "\n".join(lines)
