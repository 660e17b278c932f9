"""The bias verdict: right estimators pass, wrong ones fail and say where, noisy ones get advice."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from judge_scenes import SPP, Estimator, radiance, reference_of

from raybook_grader.judge.bias import FIRST_SEEDS, FRESH_SEEDS, verdict
from raybook_grader.judge.findings import BiasVerdict
from raybook_grader.judge.pixels import Array, Image
from raybook_grader.judge.reference import reduce_reference
from raybook_grader.judge.thresholds import CAUSTIC_TILES

RIGHT = Estimator(radiance())
REFERENCE = reference_of(RIGHT)
SMALL = Estimator(radiance(64, 64))
SMALL_REFERENCE = reference_of(SMALL)


def judge(estimator: Estimator, offset: int = 0) -> BiasVerdict:
    return verdict(estimator.seeds(offset), REFERENCE, SPP)


def codes(result: BiasVerdict) -> set[str]:
    return {reason.code for reason in result.reasons}


def patched(y: slice, x: slice, factor: float) -> Estimator:
    scale: Array = np.ones((128, 128, 1))
    scale[y, x] = factor
    return RIGHT.scaled(scale)


def test_a_right_estimator_is_never_failed() -> None:
    # Under the tests' own model a first look fails in at most 4e-4 of trials, a verdict in 4e-8:
    # of 300, none with probability above 0.99998. A first look has a failure with p = 0.11.
    verdicts = [verdict(SMALL.seeds(5000 * n), SMALL_REFERENCE, SPP) for n in range(300)]
    assert [v.status for v in verdicts] == ["pass"] * 300
    assert sum(bool(v.unconfirmed) for v in verdicts) <= 2


def test_an_unbiased_but_noisier_estimator_passes() -> None:
    result = judge(replace(RIGHT, variance=3.0))
    assert result.status == "pass"
    assert result.noise_ratio == pytest.approx(3, rel=0.1)


def test_another_pattern_of_noise_passes() -> None:
    left = np.arange(64)[None, :] < 32

    def render(seeds: Sequence[int]) -> Image:
        quiet, loud = replace(SMALL, variance=0.2).seeds(), replace(SMALL, variance=8.0).seeds(7)
        return np.where(left[..., None], quiet(seeds), loud(seeds))

    for n in range(30):
        at = [5000 * n + seed for seed in FIRST_SEEDS]
        fresh = [5000 * n + seed for seed in FRESH_SEEDS]
        result = verdict(render, SMALL_REFERENCE, SPP, seeds=at, fresh_seeds=fresh)
        assert result.status == "pass"


def test_caustics_pass_with_large_tiles() -> None:
    caustic = replace(SMALL, variance=60.0)
    reference = reference_of(caustic)
    for n in range(30):
        result = verdict(caustic.seeds(5000 * n), reference, SPP, tile_sizes=CAUSTIC_TILES)
        assert result.status == "pass"


def test_rare_events_that_no_seed_has_met_are_not_certainty() -> None:
    """A glow carried by one bright sample in three thousand: about 20 in a tile of all seeds."""

    def render(seeds: Sequence[int], spp: int = SPP) -> Image:
        images = SMALL.seeds()(seeds)
        for image, seed in zip(images, seeds, strict=True):
            random = np.random.default_rng([seed, 77])
            image[:16] += 0.2 * random.poisson(spp * 3e-4, (16, 64, 1)) / (spp * 3e-4)
        return images

    chunks = (render([900_000 + n], 64)[0] for n in range(64))
    reference = reduce_reference(chunks, 64)
    looks = 0
    for n in range(60):
        at = [5000 * n + seed for seed in FIRST_SEEDS]
        fresh = [5000 * n + seed for seed in FRESH_SEEDS]
        result = verdict(render, reference, SPP, seeds=at, fresh_seeds=fresh)
        assert result.status == "pass"
        looks += bool(result.unconfirmed)
    assert looks <= 1


@pytest.mark.parametrize("variance", [20.0, 200.0])
def test_a_much_noisier_estimator_is_inconclusive_with_advice(variance: float) -> None:
    result = judge(replace(RIGHT, variance=variance))
    assert result.status == "inconclusive"
    assert codes(result) == {"noise"}
    assert "too noisy to judge" in result.reasons[0].sentence


def test_noise_does_not_hide_a_wrong_mean() -> None:
    result = judge(replace(RIGHT.scaled(1.3), variance=20.0))
    assert result.status == "fail"
    assert codes(result) == {"G", "noise"}


def test_brightness_is_not_mistaken_for_noise() -> None:
    result = judge(RIGHT.scaled(4 * np.pi))
    assert result.status == "fail"
    assert result.noise_ratio == pytest.approx(1, rel=0.1)


@pytest.mark.parametrize(("factor", "word"), [(1.01, "bright"), (0.99, "dark")])
def test_a_light_off_by_one_per_cent_fails(factor: float, word: str) -> None:
    for offset in (0, 5000, 10_000):
        result = judge(RIGHT.scaled(factor), offset)
        assert result.status == "fail"
        assert "R" in codes(result)
    result = judge(RIGHT.scaled(1 + 2 * (factor - 1)))
    (reason,) = (r for r in result.reasons if r.code == "G")
    assert f"too {word} on average (red " in reason.sentence
    assert reason.number == pytest.approx(2 * (factor - 1), rel=0.2)


def test_a_wrong_tint_fails_by_channel() -> None:
    result = judge(RIGHT.scaled(np.array([1.03, 1.0, 0.94])))
    (reason,) = (r for r in result.reasons if r.code == "G")
    assert reason.sentence.startswith("the image has the wrong colour on average (red +")
    assert result.channel_bias is not None
    np.testing.assert_allclose(result.channel_bias, [0.03, 0.0, -0.06], atol=0.003)


def test_a_wrong_tile_is_found_where_it_is() -> None:
    result = judge(patched(slice(32, 48), slice(64, 80), 1.05))
    assert result.status == "fail"
    (reason,) = (r for r in result.reasons if r.code == "L16")
    assert str(reason.tile) == "x=64..79, y=32..47"
    assert reason.number == pytest.approx(0.05, abs=0.012)
    assert "the tile at x=64..79, y=32..47 is" in reason.sentence
    assert reason.sentence.endswith("% too bright")
    assert reason.as_json()["tile"] == [64, 32, 79, 47]


def test_light_in_wrong_places_fails_though_the_mean_is_right() -> None:
    y, x = np.mgrid[0:128, 0:128] / 128
    wave = 1 + 0.03 * np.sin(2 * np.pi * x) * np.cos(2 * np.pi * y)
    result = judge(RIGHT.scaled(wave[..., None]))
    assert "R" in codes(result)
    assert "G" not in codes(result)
    assert result.rms_bias == pytest.approx(0.014, abs=0.004)


def test_a_dead_pixel_is_found_where_it_is() -> None:
    result = judge(patched(slice(40, 41), slice(70, 71), 0.0))
    assert codes(result) == {"D"}
    assert "one pixel stays dark" in result.reasons[0].sentence
    assert "x=70, y=40" in result.reasons[0].sentence


def test_a_pixel_that_is_dark_by_chance_must_be_dark_again() -> None:
    def render(seeds: Sequence[int]) -> Image:
        images = RIGHT.seeds()(seeds)
        images[:, 40, 70 if seeds[0] < 1000 else 71] = 0
        return images

    result = verdict(render, REFERENCE, SPP)
    assert result.status == "pass"
    assert [reason.code for reason in result.unconfirmed] == ["D"]


def test_fresh_seeds_are_asked_for_only_after_a_failure() -> None:
    asked: list[tuple[int, ...]] = []

    def render(seeds: Sequence[int]) -> Image:
        asked.append(tuple(seeds))
        wrong = 1.05 if len(asked) == 1 else 1.0
        return RIGHT.scaled(wrong).seeds()(seeds)

    assert verdict(RIGHT.seeds(), REFERENCE, SPP).status == "pass"
    result = verdict(render, REFERENCE, SPP)
    assert asked == [FIRST_SEEDS, FRESH_SEEDS]
    assert result.status == "pass"
    assert {"G", "R"} <= {reason.code for reason in result.unconfirmed}


@pytest.mark.parametrize(
    ("value", "code", "text"),
    [
        (np.nan, "nan", "2 pixels are NaN (not a number) in the image of seed 3, the first at"),
        (np.inf, "infinite", "2 pixels are infinite"),
        (-0.5, "negative", "2 pixels are negative"),
    ],
)
def test_what_is_no_radiance_is_refused(value: float, code: str, text: str) -> None:
    def render(seeds: Sequence[int]) -> Image:
        images = RIGHT.seeds()(seeds)
        images[2, 5, 7:9, 1] = value
        return images

    result = verdict(render, REFERENCE, SPP)
    assert (result.status, codes(result)) == ("fail", {code})
    assert text in result.reasons[0].sentence
    assert "x=7, y=5" in result.reasons[0].sentence


def test_a_nan_that_only_the_fresh_seeds_have_is_refused() -> None:
    def render(seeds: Sequence[int]) -> Image:
        images = RIGHT.scaled(1.05).seeds()(seeds)
        if seeds[0] > 1000:
            images[0, 0, 0] = np.nan
        return images

    assert codes(verdict(render, REFERENCE, SPP)) == {"nan"}


def test_a_wrong_size_is_refused() -> None:
    result = verdict(lambda seeds: [RIGHT.image(s)[:100] for s in seeds], REFERENCE, SPP)
    assert (result.status, codes(result)) == ("fail", {"size"})
    assert "128 x 100 x 3" in result.reasons[0].sentence
    grey = verdict(lambda seeds: [RIGHT.image(s)[..., 0] for s in seeds], REFERENCE, SPP)
    assert codes(grey) == {"size"}


def test_identical_images_are_refused_where_they_should_differ() -> None:
    result = verdict(lambda seeds: [RIGHT.image(1) for _ in seeds], REFERENCE, SPP)
    assert (result.status, codes(result)) == ("fail", {"identical"})
    assert "seeds 1 and 2 are identical" in result.reasons[0].sentence


def test_identical_images_pass_where_nothing_is_random() -> None:
    still = Estimator(radiance(64, 64), noisy=False)
    reference = reference_of(still)
    truth = still.image(1)
    ulp = np.nextafter(truth, np.float32(9))

    def judge_still(image: Image) -> BiasVerdict:
        return verdict(lambda seeds: [image for _ in seeds], reference, SPP)

    assert judge_still(truth).status == "pass"
    assert judge_still(ulp.astype(np.float32)).status == "pass"
    assert judge_still(truth * np.float32(1.001)).status == "pass"
    wrong = judge_still(truth * np.float32(1.05))
    assert codes(wrong) == {"G", "R", "L16", "L32"}
    local = truth.copy()
    local[16:32, 32:48] *= np.float32(1.05)
    assert "L16" in codes(judge_still(local))


def test_half_a_picture_without_noise_passes_and_fails() -> None:
    half = replace(SMALL, noisy=np.arange(64)[None, :] < 32)
    reference = reference_of(half)
    for n in range(20):
        assert verdict(half.seeds(5000 * n), reference, SPP).status == "pass"
    scale: Array = np.ones((64, 64, 1))
    scale[0:16, 48:64] = 1.05
    result = verdict(half.scaled(scale).seeds(), reference, SPP)
    (reason,) = (r for r in result.reasons if r.code == "L16")
    assert str(reason.tile) == "x=48..63, y=0..15"


def test_black_pictures_and_channels_are_judged() -> None:
    black = Estimator(np.zeros((64, 64, 3)))
    assert verdict(black.seeds(), reference_of(black), SPP).status == "pass"
    assert verdict(SMALL.seeds(), reference_of(black), SPP).status == "fail"
    red = SMALL.scaled(np.array([1.0, 0.0, 0.0]))
    reference = reference_of(red)
    assert verdict(red.seeds(), reference, SPP).status == "pass"
    leak = SMALL.scaled(np.array([1.0, 0.01, 0.0]))
    assert "G" in codes(verdict(leak.seeds(), reference, SPP))
    assert "D" in codes(verdict(black.scaled(0).seeds(), SMALL_REFERENCE, SPP)) or codes(
        verdict(black.seeds(), SMALL_REFERENCE, SPP)
    ) == {"identical"}


def test_shared_random_numbers_see_a_smaller_bias() -> None:
    scale: Array = np.ones((128, 128, 1))
    scale[32:48, 64:80] = 1.02
    wrong = RIGHT.scaled(scale)
    assert verdict(wrong.seeds(), REFERENCE, SPP).status == "pass"
    result = verdict(wrong.seeds(), REFERENCE, SPP, reference_renders=RIGHT.seeds())
    (reason,) = (r for r in result.reasons if r.code == "L16")
    assert reason.number == pytest.approx(0.0195, abs=0.001)
    assert verdict(RIGHT.seeds(), REFERENCE, SPP, reference_renders=RIGHT.seeds()).status == "pass"


def test_other_random_numbers_lose_nothing_by_pairing() -> None:
    for n in range(30):
        result = verdict(
            SMALL.seeds(5000 * n), SMALL_REFERENCE, SPP, reference_renders=SMALL.seeds(10**6)
        )
        assert result.status == "pass"


def test_too_few_or_shared_seeds_are_a_mistake_of_the_caller() -> None:
    with pytest.raises(ValueError, match="two separate sets"):
        verdict(RIGHT.seeds(), REFERENCE, SPP, seeds=[1, 2])
    with pytest.raises(ValueError, match="two separate sets"):
        verdict(RIGHT.seeds(), REFERENCE, SPP, fresh_seeds=FIRST_SEEDS)
