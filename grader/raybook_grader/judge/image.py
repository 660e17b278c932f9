"""One scene of one module judged: bias verdict, perceptual error and score together."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .bias import FIRST_SEEDS, FRESH_SEEDS, Renders, verdict
from .findings import BiasVerdict
from .perceptual import PerceptualError, perceptual_error, score
from .pixels import Image
from .reference import ReferenceStatistics
from .thresholds import ALL_TILES, THRESHOLDS, Thresholds
from .viewing import Viewing, viewing_of


@dataclass(frozen=True)
class ImageJudgement:
    """`mean` is the mean of the first seeds' renders; None, as `visible`, at a wrong size."""

    bias: BiasVerdict
    visible: PerceptualError | None
    mean: Image | None
    score: float

    def as_json(self) -> dict[str, Any]:
        """Plain values for a database, without pictures."""
        visible = self.visible.as_json() if self.visible else None
        return {"bias": self.bias.as_json(), "visible": visible, "score": self.score}


def judge_image(
    render_seeds: Renders,
    reference: ReferenceStatistics,
    spp: int,
    *,
    viewing: Viewing | None = None,
    tile_sizes: Sequence[int] = ALL_TILES,
    seeds: Sequence[int] = FIRST_SEEDS,
    fresh_seeds: Sequence[int] = FRESH_SEEDS,
    thresholds: Thresholds = THRESHOLDS,
    reference_renders: Renders | None = None,
) -> ImageJudgement:
    """Judge renders of `spp` samples a pixel and seed; the arguments are `bias.verdict`'s.

    Seeds are rendered once, however many parts look at them.
    """
    first: list[Image] = []

    def render(at: Sequence[int]) -> list[Image]:
        images = [np.asarray(image) for image in render_seeds(at)]
        if not first:
            first.extend(images)
        return images

    bias = verdict(
        render,
        reference,
        spp,
        tile_sizes=tile_sizes,
        seeds=seeds,
        fresh_seeds=fresh_seeds,
        thresholds=thresholds,
        reference_renders=reference_renders,
    )
    if any(image.shape != (*reference.shape, 3) for image in first):
        return ImageJudgement(bias, None, None, 0.0)
    stack = np.stack(first).astype(np.float32)
    viewing = viewing or viewing_of(reference.mean)
    visible = perceptual_error(stack, reference.mean, viewing)
    return ImageJudgement(bias, visible, stack.mean(axis=0), score(visible.excess, bias.status))
