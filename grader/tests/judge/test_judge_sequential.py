"""Stopping early: the same answers by fewer renders, and no more false alarms."""

from collections.abc import Sequence

import numpy as np
import pytest
from judge_scenes import SPP, Estimator, radiance, reference_of

from raybook_grader.judge.bias import FIRST_SEEDS, FRESH_SEEDS, Renders
from raybook_grader.judge.findings import BiasVerdict
from raybook_grader.judge.pixels import Array, Image
from raybook_grader.judge.sequential import Kept, sequential_verdict
from raybook_grader.judge.thresholds import ALL_TILES, THRESHOLDS

RIGHT = Estimator(radiance())
REFERENCE = reference_of(RIGHT)
SMALL = Estimator(radiance(64, 64))
SMALL_REFERENCE = reference_of(SMALL)


class Counted:
    """Renders that remember which seeds were asked for."""

    def __init__(self, render: Renders) -> None:
        self.render = render
        self.asked: list[int] = []

    def __call__(self, seeds: Sequence[int]) -> Image:
        self.asked += seeds
        return np.stack(list(self.render(seeds)))


def judge(render: Renders, twins: Renders | None = None) -> tuple[BiasVerdict, list[int]]:
    counted = Counted(render)
    said = sequential_verdict(
        counted,
        REFERENCE,
        SPP,
        tile_sizes=ALL_TILES,
        seeds=FIRST_SEEDS,
        fresh_seeds=FRESH_SEEDS,
        thresholds=THRESHOLDS,
        reference_renders=twins,
    )
    return said, counted.asked


def test_shared_random_numbers_need_four_seeds() -> None:
    said, asked = judge(RIGHT.seeds(), RIGHT.seeds())
    assert said.status == "pass"
    assert asked == list(FIRST_SEEDS[:4])


def test_other_random_numbers_take_all_first_seeds() -> None:
    said, asked = judge(RIGHT.seeds(5000), RIGHT.seeds())
    assert said.status == "pass"
    assert sorted(asked) == list(FIRST_SEEDS)


@pytest.mark.parametrize("factor", [0.5, 0.97, 1.03, 2.0])
def test_a_plain_bias_fails_by_four_and_four(factor: float) -> None:
    said, asked = judge(RIGHT.scaled(factor).seeds())
    assert said.status == "fail"
    assert asked == [*FIRST_SEEDS[:4], *FRESH_SEEDS[:4]]


def test_a_small_bias_is_still_found() -> None:
    scale: Array = np.ones((128, 128, 1))
    scale[32:64, 64:96] = 1.03
    said, _ = judge(RIGHT.scaled(scale).seeds())
    assert said.status == "fail"
    assert {reason.code for reason in said.reasons} & {"L16", "L32", "R"}


def test_a_dead_pixel_is_found_by_the_whole_look() -> None:
    scale: Array = np.ones((128, 128, 1))
    scale[70, 40] = 0.0
    said, asked = judge(RIGHT.scaled(scale).seeds(), RIGHT.seeds())
    assert [reason.code for reason in said.reasons] == ["D"]
    assert set(FIRST_SEEDS) <= set(asked)


def test_each_seed_is_rendered_once() -> None:
    for factor in (1.0, 1.004, 1.006, 1.02):
        _, asked = judge(RIGHT.scaled(factor).seeds())
        assert len(asked) == len(set(asked))


def test_nan_is_refused_at_once() -> None:
    def render(seeds: Sequence[int]) -> Image:
        images = np.array(RIGHT.seeds()(seeds))
        images[1, 5, 7, 1] = np.nan
        return images

    said, asked = judge(render)
    assert [reason.code for reason in said.reasons] == ["nan"]
    assert asked == list(FIRST_SEEDS[:4])


def test_right_estimators_are_never_failed() -> None:
    """120 verdicts; the false-alarm rate is 4e-8 each, see `Thresholds`."""
    for n in range(120):
        said = sequential_verdict(
            SMALL.seeds(5000 * n),
            SMALL_REFERENCE,
            SPP,
            tile_sizes=ALL_TILES,
            seeds=FIRST_SEEDS,
            fresh_seeds=FRESH_SEEDS,
            thresholds=THRESHOLDS,
            reference_renders=None,
        )
        assert said.status == "pass"


def test_kept_renders_in_the_order_asked_for() -> None:
    kept = Kept(lambda seeds: [np.full((1, 1, 3), seed, np.float32) for seed in seeds])
    assert [image[0, 0, 0] for image in kept([3, 1])] == [3, 1]
    assert [image[0, 0, 0] for image in kept([1, 2, 3])] == [1, 2, 3]
