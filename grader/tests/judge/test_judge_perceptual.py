"""FLIP without noise, Delta E ITP, and the score."""

import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace

import flip_evaluator
import numpy as np
import pytest
from judge_scenes import SPP, Estimator, radiance, reference_of

from raybook_grader.judge.image import judge_image
from raybook_grader.judge.itp import colour_difference
from raybook_grader.judge.perceptual import flip, perceptual_error, score
from raybook_grader.judge.pixels import Image
from raybook_grader.judge.viewing import Viewing, viewing_of

SCENE = Estimator(radiance(64, 64), variance=0.3)
REFERENCE = reference_of(SCENE)
VIEWING = viewing_of(REFERENCE.mean)


def mean_score(factor: float, looks: int = 4) -> float:
    stacks = [SCENE.scaled(factor).seeds(100 * n)(range(8)) for n in range(looks)]
    errors = [perceptual_error(stack, REFERENCE.mean, VIEWING) for stack in stacks]
    return float(np.mean([score(error.excess) for error in errors]))


def test_scores_are_the_designs() -> None:
    """Its table: light +1 % -> 84, +3 % -> 46; this scene is about as noisy as its scenes are."""
    assert mean_score(1.01) == pytest.approx(84, abs=5)
    assert mean_score(1.03) == pytest.approx(46, abs=5)
    assert mean_score(0.4) == 0


def test_noise_alone_costs_nothing() -> None:
    for variance in (0.5, 2.0, 8.0):
        noisy = replace(SCENE, variance=variance).seeds()(range(8))
        error = perceptual_error(noisy, REFERENCE.mean, VIEWING)
        assert error.noise_flip > 0.02
        assert abs(error.excess) < 0.003


def test_the_scores_formula() -> None:
    assert score(-0.01) == score(0.003) == 100
    assert score(0.2) == score(0.9) == 0
    assert score(np.sqrt(0.003 * 0.2)) == pytest.approx(50)
    assert score(0.0, "fail") == score(0.0, "inconclusive") == 70
    assert score(0.1, "fail") == score(0.1)


def test_exposures_are_flips_own() -> None:
    _, _, own = flip_evaluator.evaluate(REFERENCE.mean, REFERENCE.mean, "HDR", applyMagma=False)
    ours = VIEWING.flip_parameters()
    for name in ("ppd", "startExposure", "stopExposure", "numExposures"):
        assert ours[name] == pytest.approx(own[name], abs=1e-3)


@pytest.mark.parametrize("value", [0.0, 1.0, np.nan])
def test_pictures_of_one_value_are_viewed(value: float) -> None:
    flat = np.full((16, 16, 3), value, np.float32)
    viewing = viewing_of(flat)
    assert viewing.start_exposure < viewing.stop_exposure
    assert viewing.white > 0
    assert flip(flat, flat, viewing)[0] == 0
    assert flip(flat, flat + np.float32(3), viewing)[0] > 0.1 or np.isnan(value)


def test_viewing_is_plain_values() -> None:
    assert Viewing(**VIEWING.as_json()) == VIEWING


def test_delta_e_itp_of_known_colours() -> None:
    """A grey at 100 and one at 203 cd/m2: 720 times the step in PQ intensity (BT.2124)."""
    one, other = np.full((2, 2, 3), 100 / 203), np.ones((2, 2, 3))
    found = colour_difference(one.astype(np.float32), other.astype(np.float32), white=1.0)

    def pq(luminance: float) -> float:  # SMPTE ST 2084
        y = (luminance / 10000) ** 0.1593017578125
        return float(((0.8359375 + 18.8515625 * y) / (1 + 18.6875 * y)) ** 78.84375)

    assert found.mean == pytest.approx(720 * (pq(203) - pq(100)), rel=1e-3)
    assert found.p95 == pytest.approx(found.mean)
    assert colour_difference(REFERENCE.mean, REFERENCE.mean, VIEWING.white).map.max() == 0


def test_numbers_are_told_the_same_after_a_picture_was_judged() -> None:
    """The library changes how NumPy prints; a student must not read other digits for that."""
    program = (
        "import numpy as np; from raybook_grader.judge import itp; from raybook_grader.cases import"
        " number; flat = np.full((8, 8, 3), 0.5, np.float32); before = number(1 / np.pi);"
        " itp.colour_difference(flat, flat, 1.0); print(before, number(1 / np.pi))"
    )
    said = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert said.stdout.split() == ["0.31830987", "0.31830987"], said.stderr


def test_judging_caps_what_is_biased() -> None:
    right = judge_image(SCENE.seeds(), REFERENCE, SPP)
    assert (right.bias.status, right.score) == ("pass", 100)
    wrong = judge_image(SCENE.scaled(1.01).seeds(), REFERENCE, SPP, viewing=VIEWING)
    assert (wrong.bias.status, wrong.score) == ("fail", 70)
    assert wrong.visible is not None
    assert wrong.visible.flip_map.shape == REFERENCE.shape
    assert wrong.as_json()["bias"]["status"] == "fail"


def test_judging_what_is_no_picture() -> None:
    cut = judge_image(lambda seeds: [SCENE.image(s)[1:] for s in seeds], REFERENCE, SPP)
    assert (cut.bias.status, cut.score, cut.visible) == ("fail", 0, None)
    nan = judge_image(
        lambda seeds: [SCENE.image(s) * np.float32(np.nan) for s in seeds], REFERENCE, SPP
    )
    assert (nan.bias.status, nan.score) == ("fail", 0)


def test_each_seed_is_rendered_once() -> None:
    asked: list[int] = []

    def render(seeds: Sequence[int]) -> Image:
        asked.extend(seeds)
        return SCENE.seeds()(seeds)

    judge_image(render, REFERENCE, SPP)
    assert asked == list(range(1, 9))
