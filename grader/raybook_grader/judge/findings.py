"""What the bias verdict says, for a program and for a student."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from .pixels import CHANNELS, Mask
from .tiles import Tile

Status = Literal["pass", "fail", "inconclusive"]


@dataclass(frozen=True)
class Reason:
    """One sub-test's finding.

    `code` is size, nan, infinite, negative, identical, G, R, L16, L32, D or noise; `number` the
    size of the effect (a signed fraction for G and L, a fraction for R, a count of pixels, a ratio
    of variances for noise); `tile` where to look, when there is a place.
    """

    code: str
    number: float
    sentence: str
    tile: Tile | None = None

    def as_json(self) -> dict[str, Any]:
        """Plain values, the tile as [x0, y0, x1, y1]."""
        t = self.tile
        place = [t.x0, t.y0, t.x1, t.y1] if t else None
        return {"code": self.code, "number": self.number, "tile": place, "message": self.sentence}


@dataclass(frozen=True)
class BiasVerdict:
    """Part A's answer.

    `unconfirmed` holds first-look failures that did not repeat; they cost nothing. The numbers are
    the first look's, None when an image could not be measured at all.
    """

    status: Status
    reasons: tuple[Reason, ...]
    unconfirmed: tuple[Reason, ...] = ()
    noise_ratio: float | None = None
    channel_bias: tuple[float, float, float] | None = None
    rms_bias: float | None = None

    def as_json(self) -> dict[str, Any]:
        """Plain values for a database."""
        return {
            "status": self.status,
            "reasons": [reason.as_json() for reason in self.reasons],
            "unconfirmed": [reason.as_json() for reason in self.unconfirmed],
            "noise_ratio": self.noise_ratio,
            "channel_bias": list(self.channel_bias) if self.channel_bias else None,
            "rms_bias": self.rms_bias,
        }


def percent(fraction: float, signed: bool = False) -> str:
    """Two figures that a reader can use: "0.43 %", "+5.2 %", "170 %"."""
    value = 100 * fraction
    digits = 2 if abs(value) < 0.995 else 1 if abs(value) < 9.95 else 0
    return f"{value:{'+' if signed else ''}.{digits}f} %"


def global_sentence(overall: float, by_channel: Sequence[float]) -> str:
    """The whole picture is too bright, too dark or tinted."""
    parts = ", ".join(
        f"{c} {percent(v, signed=True)}" for c, v in zip(CHANNELS, by_channel, strict=True)
    )
    if abs(overall) < 0.5 * max(abs(v) for v in by_channel):
        return f"the image has the wrong colour on average ({parts})"
    direction = "bright" if overall > 0 else "dark"
    return f"the image is {percent(abs(overall))} too {direction} on average ({parts})"


def spread_sentence(rms: float, size: int, worst: float, tile: Tile) -> str:
    """Tiles are off all over the picture."""
    return (
        f"tiles of {size} x {size} pixels are off by {percent(rms)} (root mean square, noise taken "
        f"out), the worst, at {tile}, by {percent(worst, signed=True)}"
    )


def tile_sentence(bias: float, tile: Tile, others: int) -> str:
    """One tile is off, and how many more."""
    direction = "bright" if bias > 0 else "dark"
    more = f", and {others} more tiles of that size are off" if others > 1 else ""
    more = ", and one more tile of that size is off" if others == 1 else more
    return f"the tile at {tile} is {percent(abs(bias))} too {direction}{more}"


def dead_sentence(count: int, x: int, y: int, seen: float, expected: float) -> str:
    """Pixels that stay dark in every seed."""
    which = "one pixel stays" if count == 1 else f"{count} pixels stay"
    first = "it is" if count == 1 else "the one that lacks most is"
    return (
        f"{which} dark where light should arrive: {first} x={x}, y={y}, "
        f"{seen:.3g} where the reference has {expected:.3g}"
    )


def noise_sentence(ratio: float) -> str:
    """Advice, not a verdict."""
    return (
        f"too noisy to judge: a sample's variance is {ratio:.0f} times the reference's; sample "
        "in proportion to what the integrand holds most of (cosine, light, material), and check "
        "that no density is far too small somewhere"
    )


def first_pixel(mask: Mask | np.bool) -> tuple[int, int]:
    """(x, y) of the first true element in reading order."""
    y, x = np.unravel_index(int(np.argmax(mask)), mask.shape)
    return int(x), int(y)
