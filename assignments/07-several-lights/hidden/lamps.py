"""What the oracles of assignment 07 share: lights, their power, and their probabilities, exactly.

All in float64 from the numbers that the record holds. The contract is lights/selection.h.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from raybook_grader.probes import Failure

Array = NDArray[np.float64]

POINT, DIRECTIONAL, SPOT, RECT, SPHERE = range(5)
NAMES = ("point light", "directional light", "spot", "rectangle", "sphere")
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
SMALLEST_SHARE = 1e-3


@dataclass(frozen=True)
class Lamp:
    """``colour`` is its flux, irradiance, intensity or radiance."""

    kind: int = POINT
    colour: Sequence[float] = (1.0, 1.0, 1.0)
    position: Sequence[float] = (0.0, 2.0, 0.0)
    beam: float = 0.3
    cutoff: float = 0.6
    area: float = 1.0

    def record(self) -> bytes:
        values = [*self.position, *self.colour, self.beam, self.cutoff, self.area]
        return struct.pack("<I9f", self.kind, *values)

    def power(self, radius: float) -> float:
        """In W, as luminance; light_power computes the same in single precision."""
        luminance = float(np.array(self.colour) @ LUMINANCE)
        if self.kind == POINT:
            return luminance
        if self.kind == DIRECTIONAL:
            return math.pi * radius**2 * luminance
        if self.kind == SPOT:
            slope = (math.sin(self.cutoff) - math.sin(self.beam)) / (self.cutoff - self.beam)
            return 2 * math.pi * (1 - slope) * luminance
        return self.area * math.pi * luminance


@dataclass(frozen=True)
class Case:
    label: str
    lamps: tuple[Lamp, ...]
    by_power: bool = True
    radius: float = 5.0
    steps: int = 1 << 16

    def record(self) -> bytes:
        head = struct.pack("<IIfI", len(self.lamps), self.by_power, self.radius, self.steps)
        return head + b"".join(lamp.record() for lamp in self.lamps)

    def probabilities(self) -> Array:
        """How likely each light is to be picked."""
        if not self.lamps:
            return np.zeros(0)
        weights = np.ones(len(self.lamps))
        if self.by_power:
            weights = np.array([lamp.power(self.radius) for lamp in self.lamps])
        least = SMALLEST_SHARE * weights.mean()
        weights = np.where(weights > 0, np.maximum(weights, least), 0.0)
        if not weights.any():
            weights = np.ones(len(self.lamps))
        return np.asarray(weights / weights.sum())

    def tell(self) -> str:
        powers = [short(lamp.power(self.radius)) for lamp in self.lamps]
        shown = ", ".join(powers[:8]) + (", ..." if len(powers) > 8 else "")
        kinds = {NAMES[lamp.kind] for lamp in self.lamps}
        what = (kinds.pop() if len(kinds) == 1 else "light") + "s" * (len(powers) != 1)
        how = "by power" if self.by_power else "evenly"
        return f"{self.label}: {len(powers)} {what} of power {shown} W, picked {how}"


def single(value: float) -> float:
    """Rounded to what a record can hold."""
    return float(np.float32(value))


def short(value: float) -> str:
    return f"{value:.6g}"


def colour_words(colour: Array) -> str:
    return "(" + ", ".join(short(x) for x in colour) + ")"


def wrong_length(output: bytes, expected: int, count: int) -> list[Failure]:
    """The failure of an output that is not ``expected`` bytes long; else none."""
    if len(output) == expected:
        return []
    message = f"the probe wrote {len(output)} bytes, expected {expected} for {count} cases"
    return [Failure(0, message, "output of a wrong length")]


FLAGS = {
    1: "picked an index that no light has",
    2: "the probability of a pick is not what light_table_probability says",
    4: "picked a light with a probability that is not above 0",
    8: "the count of a new table is not that of the lights",
    16: "light_table_free leaves a count or a pointer behind",
    32: "the lights are not what they were before",
    64: "asking all lights twice gives two different answers",
    128: "all_lights does not ask each light exactly once",
    256: "one_light does not ask one light exactly once",
}
"""What the probe's flags say."""


def flagged(case: int, text: str, flags: int) -> list[Failure]:
    """A failure for each flag that is set."""
    return [
        Failure(case, f"{text}: {words}", words, -float(len(text)))
        for flag, words in FLAGS.items()
        if flags & flag
    ]
