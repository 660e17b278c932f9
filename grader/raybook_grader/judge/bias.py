"""Part A of judging an image: does the estimator converge to the reference? Pass or fail.

Sub-tests on K seeds of the student's renders against a converged reference:

    G    a channel's mean over the picture
    R    all tiles of one size together (root mean square, noise taken out)
    L16  any one 16 x 16 tile;  L32: any one 32 x 32 tile
    D    dead pixels

Each asks for significance and for size. A failure counts only if the same sub-test fails again on
fresh seeds. An estimator much noisier than the reference is not called wrong on local evidence: it
is "inconclusive", unless the picture's mean alone (G), an average over all pixels, is wrong twice.
"""

from collections.abc import Callable, Iterable, Sequence

import numpy as np
from scipy.ndimage import median_filter

from .differences import chi_squared, simes
from .evidence import Evidence, measure, rms_bias
from .findings import (
    BiasVerdict,
    Reason,
    dead_sentence,
    global_sentence,
    noise_sentence,
    spread_sentence,
    tile_sentence,
)
from .pixels import Array, Image, Mask, luminance
from .reference import ReferenceStatistics
from .refusal import refusals
from .thresholds import ALL_TILES, THRESHOLDS, Thresholds
from .tiles import Tile, tile_at

Renders = Callable[[Sequence[int]], Iterable[Image]]  # seeds -> one image a seed, same spp each

FIRST_SEEDS = tuple(range(1, 9))
FRESH_SEEDS = tuple(range(1001, 1009))
MIN_SEEDS = 4  # below, a t test at 1e-4 hardly ever fails anything


def verdict(
    render_seeds: Renders,
    reference: ReferenceStatistics,
    spp: int,
    *,
    tile_sizes: Sequence[int] = ALL_TILES,
    seeds: Sequence[int] = FIRST_SEEDS,
    fresh_seeds: Sequence[int] = FRESH_SEEDS,
    thresholds: Thresholds = THRESHOLDS,
    reference_renders: Renders | None = None,
) -> BiasVerdict:
    """Judge an estimator whose renders have `spp` samples a pixel each.

    `tile_sizes`: (16, 32), or (32,) for caustics; the first also carries R. `reference_renders`
    renders the reference at the same seeds: where both use the same random numbers, the paired
    test sees far smaller biases; elsewhere it changes nothing. Either function is called a second
    time only when the first look fails.
    """
    if min(len(seeds), len(fresh_seeds)) < MIN_SEEDS or set(seeds) & set(fresh_seeds):
        raise ValueError(f"two separate sets of at least {MIN_SEEDS} seeds are needed")

    def look(at: Sequence[int]) -> tuple[Evidence | None, list[Reason]]:
        images = [np.asarray(image) for image in render_seeds(at)]
        refused = refusals(images, at, reference, thresholds)
        if refused:
            return None, refused
        twins = None if reference_renders is None else np.stack(list(reference_renders(at)))
        seen = measure(np.stack(images), reference, spp, tile_sizes, thresholds, twins)
        return seen, failures(seen, reference, tile_sizes, thresholds)

    evidence, first = look(seeds)
    if evidence is None:
        return BiasVerdict("fail", tuple(first))
    again, second = look(fresh_seeds) if first else (evidence, [])
    if again is None:
        return conclude(evidence, second, [], tile_sizes, thresholds)
    repeated = {reason.code for reason in second}
    confirmed = [reason for reason in first if reason.code in repeated and reason.code != "D"]
    if "D" in repeated:
        # Chance kills a pixel here and there in a noisy picture, but not the same one twice.
        both = dead_pixels(evidence, reference, thresholds) & dead_pixels(
            again, reference, thresholds
        )
        confirmed += filter(None, [dead_test(evidence, both, reference, thresholds)])
    codes = {reason.code for reason in confirmed}
    unconfirmed = [reason for reason in first if reason.code not in codes]
    return conclude(evidence, confirmed, unconfirmed, tile_sizes, thresholds)


def conclude(
    evidence: Evidence,
    confirmed: list[Reason],
    unconfirmed: list[Reason],
    tile_sizes: Sequence[int],
    limits: Thresholds,
) -> BiasVerdict:
    """The verdict of what was confirmed; the numbers are those of `evidence`."""
    noisy = evidence.noise_ratio > limits.noise_ratio
    noise = Reason("noise", evidence.noise_ratio, noise_sentence(evidence.noise_ratio))
    red, green, blue = (evidence.channels.value / evidence.channel_scale).tolist()
    return BiasVerdict(
        status="fail" if confirmed else "inconclusive" if noisy else "pass",
        reasons=tuple([*confirmed, noise] if noisy else confirmed),
        unconfirmed=tuple(unconfirmed),
        noise_ratio=evidence.noise_ratio,
        channel_bias=(red, green, blue),
        rms_bias=rms_bias(evidence.tiles[tile_sizes[0]], evidence.tile_scale[tile_sizes[0]]),
    )


def failures(
    seen: Evidence, reference: ReferenceStatistics, tile_sizes: Sequence[int], limits: Thresholds
) -> list[Reason]:
    """All sub-tests that fail on this look; too much noise leaves only G."""
    found = [global_test(seen, limits)]
    if seen.noise_ratio <= limits.noise_ratio:
        found.append(rms_test(seen, tile_sizes[0], limits))
        found += [tile_test(seen, size, limits) for size in tile_sizes]
        dead = dead_pixels(seen, reference, limits)
        found.append(dead_test(seen, dead, reference, limits))
    return [reason for reason in found if reason]


def global_test(seen: Evidence, limits: Thresholds) -> Reason | None:
    """G: a channel's mean differs, significantly (Bonferroni over three) and by enough."""
    relative = seen.channels.value / seen.channel_scale
    wrong = (3 * seen.channels.p_differs() < limits.alpha) & (np.abs(relative) > limits.global_bias)
    if not wrong.any():
        return None
    worst = float(np.where(wrong, relative, 0)[np.argmax(np.abs(relative * wrong))])
    return Reason("G", worst, global_sentence(seen.overall, relative.tolist()))


def rms_test(seen: Evidence, size: int, limits: Thresholds) -> Reason | None:
    """R: the tiles together differ, significantly and by enough once noise is taken out."""
    p = seen.tiles[size].p_differs()
    rms = rms_bias(seen.tiles[size], seen.tile_scale[size])
    if rms <= limits.rms_bias or chi_squared(p, limits.deviation_cap) >= limits.alpha:
        return None
    bias, tile, _ = _worst_tile(seen, size, p, limits)
    return Reason("R", rms, spread_sentence(rms, size, bias, tile), tile)


def tile_test(seen: Evidence, size: int, limits: Thresholds) -> Reason | None:
    """L: some tile is off by more than the limit; Simes over all tiles."""
    p = seen.tiles[size].p_exceeds(limits.tile_bias * seen.tile_scale[size])
    if simes(p) >= limits.alpha:
        return None
    bias, tile, others = _worst_tile(seen, size, p, limits)
    return Reason(f"L{size}", bias, tile_sentence(bias, tile, others), tile)


def dead_pixels(seen: Evidence, reference: ReferenceStatistics, limits: Thresholds) -> Mask:
    """The pixels far darker than the reference's, given the noise at and around them."""
    expected = luminance(reference.mean)
    # A dead pixel's own variance is zero, so its neighbours' counts too.
    variance = np.maximum(median_filter(seen.mean_variance, size=5), seen.mean_variance)
    deviations = (expected - seen.mean) / np.sqrt(np.maximum(variance, 1e-20))
    dead: Mask = (deviations > limits.dead_deviations) & (
        seen.mean < limits.dead_fraction * expected
    )
    return dead


def dead_test(
    seen: Evidence, dead: Mask, reference: ReferenceStatistics, limits: Thresholds
) -> Reason | None:
    """D: pixels that stay dark."""
    count = int(dead.sum())
    if count < limits.dead_pixels:
        return None
    expected = luminance(reference.mean)
    missing = (expected - seen.mean) * dead
    y, x = (int(i) for i in np.unravel_index(np.argmax(missing), dead.shape))
    sentence = dead_sentence(count, x, y, float(seen.mean[y, x]), float(expected[y, x]))
    return Reason("D", float(count), sentence, Tile(x, y, x, y))


def _worst_tile(seen: Evidence, size: int, p: Array, limits: Thresholds) -> tuple[float, Tile, int]:
    """Of the tiles that are off by themselves (else the likeliest), the bias and place of the one
    that is off most, and how many others there are."""
    certain = p <= max(limits.alpha / p.size, float(p.min()))
    relative = seen.tiles[size].value / seen.tile_scale[size]
    worst = int(np.argmax(np.abs(relative) * certain))
    return float(relative.flat[worst]), tile_at(worst, seen.shape, size), int(certain.sum()) - 1
