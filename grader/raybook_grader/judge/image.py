"""One scene of one module judged: bias verdict, perceptual error and score together."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .bias import FIRST_SEEDS, FRESH_SEEDS, Renders
from .findings import BiasVerdict
from .perceptual import PerceptualError, perceptual_error, score
from .pixels import Image
from .reference import ReferenceStatistics
from .sequential import Kept, sequential_verdict
from .thresholds import ALL_TILES, THRESHOLDS, Thresholds
from .viewing import Viewing, viewing_of


@dataclass(frozen=True)
class ImageJudgement:
    """`mean` is of the first `pictures` renders; None, as `visible`, at a wrong size."""

    bias: BiasVerdict
    visible: PerceptualError | None
    mean: Image | None
    score: float
    pictures: int = 0

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
    render = Kept(render_seeds)
    twins = None if reference_renders is None else Kept(reference_renders)
    bias = sequential_verdict(
        render,
        reference,
        spp,
        tile_sizes=tile_sizes,
        seeds=seeds,
        fresh_seeds=fresh_seeds,
        thresholds=thresholds,
        reference_renders=twins,
    )
    first = [seed for seed in seeds if seed in render.images]
    if any(render.images[seed].shape != (*reference.shape, 3) for seed in first):
        return ImageJudgement(bias, None, None, 0.0)
    stack = np.stack(render(first)).astype(np.float32)
    same = None if twins is None else np.stack(twins(first)).astype(np.float32)
    viewing = viewing or viewing_of(reference.mean)
    visible = perceptual_error(stack, reference.mean, viewing, same)
    points = score(visible.excess, bias.status)
    return ImageJudgement(bias, visible, stack.mean(axis=0), points, len(first))
