"""Part B of judging an image: how visible its error is, noise taken out, and the score."""

import functools
import os
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np

from .findings import Status
from .itp import ColourDifference, colour_difference
from .pixels import Image, Map
from .viewing import Viewing

FULL_SCORE_BELOW = 0.003  # excess FLIP that a right estimator's luck stays under
NO_SCORE_FROM = 0.2  # a missing cosine
UNPROVEN_CAP = 70.0  # a bias that a picture hides is still a bias
_SPLITS = 2  # ways to halve the seeds; the noise's FLIP varies little between them
_LARGEST = 1e6  # brighter pixels are shown as this, so that FLIP's single precision holds


@dataclass(frozen=True)
class PerceptualError:
    """FLIP of the picture, of its noise alone, and Delta E ITP; all against the reference."""

    flip: float
    noise_flip: float
    flip_map: Map
    colour: ColourDifference

    @property
    def excess(self) -> float:
        """What is visible beyond noise; negative by luck."""
        return self.flip - self.noise_flip

    def as_json(self) -> dict[str, Any]:
        """Plain values, without the maps."""
        return {
            "flip": self.flip,
            "flip_excess": self.excess,
            "delta_e_itp": {"mean": self.colour.mean, "p95": self.colour.p95},
        }


def perceptual_error(
    stack: Image, reference: Image, viewing: Viewing, twins: Image | None = None
) -> PerceptualError:
    """Of at least two renders (seeds, height, width, 3); what is no radiance counts as black.

    `twins` are the reference's renders at the same seeds. Where they share the random numbers,
    their noise is the picture's own, and is what is taken out.
    """
    usable = displayable(stack)
    mean = usable.mean(axis=0, dtype=np.float64).astype(np.float32)
    value, error_map = flip(reference, mean, viewing)
    noisy = _noise_twins(usable, reference)
    if twins is not None and _share_noise(usable, displayable(twins)):
        noisy = [displayable(twins.mean(axis=0, dtype=np.float64).astype(np.float32))]
    noise = [flip(reference, twin, viewing)[0] for twin in noisy]
    colour = colour_difference(reference, mean, viewing.white)
    return PerceptualError(value, float(np.mean(noise)), error_map, colour)


def score(excess: float, status: Status = "pass") -> float:
    """0 to 100: logarithmic in the excess FLIP; at most 70 unless the bias verdict is a pass."""
    span = np.log(NO_SCORE_FROM / FULL_SCORE_BELOW)
    lost = np.log(max(excess, FULL_SCORE_BELOW) / FULL_SCORE_BELOW) / span
    points = float(np.clip(100 * (1 - lost), 0.0, 100.0))
    return points if status == "pass" else min(points, UNPROVEN_CAP)


def flip(reference: Image, test: Image, viewing: Viewing) -> tuple[float, Map]:
    """Mean HDR-FLIP and its map, at the scene's fixed exposures."""
    pair = (np.ascontiguousarray(displayable(image)) for image in (reference, test))
    error_map, mean, _ = _flip_evaluator().evaluate(
        *pair, "HDR", applyMagma=False, parameters=viewing.flip_parameters()
    )
    return float(mean), np.asarray(error_map[..., 0], dtype=np.float32)


@functools.cache
def _flip_evaluator() -> ModuleType:
    """The library, told to use one thread: its OpenMP threads spin while they wait, and where
    several pictures are judged at once, each then waits for the others."""
    before = os.environ.get("OMP_NUM_THREADS")
    os.environ["OMP_NUM_THREADS"] = before or "1"
    try:
        import flip_evaluator
    finally:
        if before is None:
            del os.environ["OMP_NUM_THREADS"]
    module: ModuleType = flip_evaluator
    return module


def displayable(image: Image) -> Image:
    """NaN, negative and minus infinity as black, and nothing too bright for single precision."""
    clean = np.nan_to_num(image, nan=0.0, posinf=_LARGEST, neginf=0.0)
    return np.clip(clean, 0.0, _LARGEST).astype(np.float32)


def _share_noise(stack: Image, twins: Image) -> bool:
    """Whether the noise cancels; independent renders would leave twice as much."""
    left = (stack - twins).var(axis=0).sum(dtype=np.float64)
    return bool(left < 0.25 * stack.var(axis=0).sum(dtype=np.float64))


def _noise_twins(stack: Image, reference: Image) -> list[Image]:
    """The reference plus half the difference of two halves: the noise of the mean, and no bias."""
    random = np.random.default_rng(0)
    half = len(stack) // 2
    twins = []
    for _ in range(_SPLITS):
        order = random.permutation(len(stack))
        one = stack[order[:half]].mean(axis=0, dtype=np.float64)
        other = stack[order[half : 2 * half]].mean(axis=0, dtype=np.float64)
        twins.append(displayable((reference + (one - other) / 2).astype(np.float32)))
    return twins
