"""The statistics under the verdict, against distributions that are known."""

import numpy as np
import pytest
from scipy import special, stats

from raybook_grader.judge.differences import (
    _inverse_trigamma,
    chi_squared,
    moderated_welch,
    simes,
    welch,
)


def test_welch_is_scipys() -> None:
    random = np.random.default_rng(3)
    ours, theirs = random.normal(0.1, 1, (8, 5)), random.normal(0, 0.5, (64, 5))
    expected = stats.ttest_ind(ours, theirs, equal_var=False)
    found = welch(ours, theirs.mean(0), theirs.var(0, ddof=1) / 64, 64, np.zeros(5))
    np.testing.assert_allclose(found.p_differs(), expected.pvalue, rtol=1e-6)
    np.testing.assert_allclose(found.freedom, expected.df, rtol=1e-6)


def test_seeds_that_met_no_rare_event_are_not_certain() -> None:
    mean, least = np.full(1, 0.8), np.full(1, 0.1)
    found = welch(np.zeros((8, 1)), mean, np.full(1, 1e-3), 64, least)
    assert found.p_differs()[0] > 0.01
    assert welch(np.zeros((8, 1)), mean, np.full(1, 1e-3), 64, 0 * least).p_differs()[0] < 1e-9


def test_p_exceeds_is_small_only_beyond_the_limit() -> None:
    samples = np.random.default_rng(4).normal(1.0, 0.01, (8, 1))
    found = welch(samples, np.zeros(1), np.full(1, 1e-6), 64, np.zeros(1))
    assert found.p_exceeds(np.full(1, 0.5))[0] < 1e-8
    assert found.p_exceeds(np.full(1, 1.5))[0] > 0.999


@pytest.mark.parametrize("spread", [0.0, 0.5])
def test_moderated_p_values_are_uniform(spread: float) -> None:
    """Under the null hypothesis, in the body and in the tail, whatever the pattern of noise."""
    random = np.random.default_rng(5)
    values = []
    for _ in range(60):
        pattern = random.uniform(0.5, 2, 256)
        own = 3 * pattern * np.exp(spread * random.normal(size=256))
        reference = random.normal(0, np.sqrt(pattern), (64, 256))
        samples = random.normal(0, np.sqrt(own), (8, 256))
        found = moderated_welch(
            samples,
            reference.mean(0),
            reference.var(0, ddof=1) / 64,
            64,
            np.zeros(256),
        )
        values.append(found.p_differs())
    p = np.concatenate(values)
    for level in (0.5, 0.1, 0.01, 0.001):
        chance = stats.binom.sf((p < level).sum() - 1, p.size, level)
        assert chance > 1e-3, f"{(p < level).mean()} below {level}"


def test_moderation_gains_freedom_only_where_the_patterns_agree() -> None:
    random = np.random.default_rng(6)
    pattern = random.uniform(0.5, 2, 256)
    alike = random.normal(0, np.sqrt(pattern), (8, 256))
    unlike = alike * np.exp(2 * random.normal(size=256))
    zero, certain = np.zeros(256), pattern * 1e-6
    gained = moderated_welch(alike, zero, certain, 64, zero).freedom
    not_gained = moderated_welch(unlike, zero, certain, 64, zero).freedom
    assert np.median(gained) > 40
    assert np.median(not_gained) < 8


def test_nothing_random_gives_no_nan() -> None:
    same = moderated_welch(np.ones((8, 20)), np.ones(20), np.zeros(20), 64, np.zeros(20))
    assert np.all(same.p_differs() == 1)
    off = moderated_welch(np.full((8, 20), 1.05), np.ones(20), np.zeros(20), 64, np.zeros(20))
    assert np.all(off.p_differs() < 1e-20)


def test_simes_and_chi_squared_are_uniform() -> None:
    random = np.random.default_rng(7)
    p = random.uniform(size=(4000, 64))
    for combined in (
        np.array([simes(row) for row in p]),
        np.array([chi_squared(row, 60.0) for row in p]),
    ):
        assert stats.kstest(combined, "uniform").pvalue > 1e-3
    assert simes(np.array([1e-9, *[0.5] * 63])) == pytest.approx(64e-9)


def test_inverse_trigamma() -> None:
    for x in (0.05, 1.0, 3.5, 30.0):
        assert _inverse_trigamma(float(special.polygamma(1, x))) == pytest.approx(x, rel=1e-6)
    assert _inverse_trigamma(-0.1) == 1000
