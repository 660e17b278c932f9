"""Part A of judging an image, stopped as soon as the answer is clear.

A quarter of the work is often enough: half of the first seeds show a large bias, or, where the
reference's random numbers are shared, that there is none. Each of the two looks gets half of the
significance, so that together they raise no more false alarms than one (Bonferroni).
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from scipy import stats

from .bias import MIN_SEEDS, Renders, conclude, dead_pixels, failures, verdict
from .differences import Difference
from .evidence import Evidence, measure, rms_bias
from .findings import BiasVerdict, Reason
from .pixels import Array, Image
from .reference import ReferenceStatistics
from .refusal import refusals
from .thresholds import Thresholds


class Kept:
    """Renders of seeds, each made once, however often it is asked for."""

    def __init__(self, render: Renders) -> None:
        self._render = render
        self.images: dict[int, Image] = {}

    def __call__(self, seeds: Sequence[int]) -> list[Image]:
        missing = [seed for seed in seeds if seed not in self.images]
        if missing:
            made = [np.asarray(image) for image in self._render(missing)]
            self.images.update(zip(missing, made, strict=True))
        return [self.images[seed] for seed in seeds]


def sequential_verdict(
    render_seeds: Renders,
    reference: ReferenceStatistics,
    spp: int,
    *,
    tile_sizes: Sequence[int],
    seeds: Sequence[int],
    fresh_seeds: Sequence[int],
    thresholds: Thresholds,
    reference_renders: Renders | None,
) -> BiasVerdict:
    """`bias.verdict` of the same arguments, by as few renders as will do."""
    render = render_seeds if isinstance(render_seeds, Kept) else Kept(render_seeds)
    limits = replace(thresholds, alpha=thresholds.alpha / 2)
    early = len(seeds) // 2
    if early >= MIN_SEEDS:

        def look(at: Sequence[int]) -> Evidence | list[Reason]:
            images = render(at)
            refused = refusals(images, at, reference, limits)
            if refused:
                return refused
            twins = None if reference_renders is None else np.stack(list(reference_renders(at)))
            return measure(np.stack(images), reference, spp, tile_sizes, limits, twins)

        early_answer = _early(look, reference, tile_sizes, seeds[:early], fresh_seeds, limits)
        if early_answer is not None:
            return early_answer
    return verdict(
        render,
        reference,
        spp,
        tile_sizes=tile_sizes,
        seeds=seeds,
        fresh_seeds=fresh_seeds,
        thresholds=limits,
        reference_renders=reference_renders,
    )


def _early(
    look: Callable[[Sequence[int]], Evidence | list[Reason]],
    reference: ReferenceStatistics,
    tile_sizes: Sequence[int],
    seeds: Sequence[int],
    fresh_seeds: Sequence[int],
    limits: Thresholds,
) -> BiasVerdict | None:
    """The answer of the first look, None where it gives none; dead pixels need the second."""
    seen = look(seeds)
    if not isinstance(seen, Evidence):
        return BiasVerdict("fail", tuple(seen))
    first = [r for r in failures(seen, reference, tile_sizes, limits) if r.code != "D"]
    if not first:
        clear = is_clear(seen, reference, tile_sizes, limits)
        return conclude(seen, [], [], tile_sizes, limits) if clear else None
    again = look(fresh_seeds[: len(seeds)])
    if not isinstance(again, Evidence):
        return BiasVerdict("fail", tuple(again))
    repeated = {r.code for r in failures(again, reference, tile_sizes, limits)}
    confirmed = [reason for reason in first if reason.code in repeated]
    return conclude(seen, confirmed, [], tile_sizes, limits) if confirmed else None


def is_clear(
    seen: Evidence, reference: ReferenceStatistics, tile_sizes: Sequence[int], limits: Thresholds
) -> bool:
    """Whether every bias is certain to be smaller than what a test would call wrong."""
    if seen.noise_ratio > limits.noise_ratio or dead_pixels(seen, reference, limits).any():
        return False
    certain = [_within(seen.channels, limits.global_bias * seen.channel_scale, limits.alpha)]
    for size in tile_sizes:
        limit = limits.tile_bias * seen.tile_scale[size]
        certain.append(_within(seen.tiles[size], limit, limits.alpha))
    first = tile_sizes[0]
    return all(certain) and rms_bias(seen.tiles[first], seen.tile_scale[first]) < limits.rms_bias


def _within(difference: Difference, limit: Array, alpha: float) -> bool:
    reach = stats.t.isf(alpha / difference.value.size, difference.freedom)
    bound = np.abs(difference.value) + reach * np.sqrt(difference.variance)
    return bool((bound < limit).all())
