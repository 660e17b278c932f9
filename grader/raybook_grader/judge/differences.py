"""Differences of means with their uncertainty, and the tests on them."""

from dataclasses import dataclass

import numpy as np
from scipy import optimize, special, stats

from .pixels import Array

# A mean of floats is known to about this fraction: 32 float additions round by up to 32 * 2^-24.
# It keeps t finite where nothing is random; the effect sizes decide there.
ROUNDING = 2e-6


@dataclass(frozen=True)
class Difference:
    """Student minus reference: the mean, its variance, and the variance's degrees of freedom."""

    value: Array
    variance: Array
    freedom: Array

    def p_differs(self) -> Array:
        """Two-sided p of: the difference is zero."""
        p = stats.t.sf(np.abs(self.value) / np.sqrt(self.variance), self.freedom)
        return 2 * np.asarray(p, dtype=np.float64)

    def p_exceeds(self, limit: Array) -> Array:
        """One-sided p of: the difference is no larger than +-`limit`."""
        excess = np.abs(self.value) - limit
        p = stats.t.sf(excess / np.sqrt(self.variance), self.freedom)
        return np.asarray(p, dtype=np.float64)


def welch(
    samples: Array, mean: Array, variance: Array, count: int, least_variance: Array
) -> Difference:
    """Samples (seeds, ...) against a mean of `count` values with its `variance`.

    `least_variance` bounds the variance of the samples' mean from below: where rare events carry
    the light, a few seeds may have met none, and would look certain.
    Welch 1947, with Satterthwaite's freedom.
    """
    own = samples.var(axis=0, ddof=1) / len(samples)
    freedom = np.full(own.shape, len(samples) - 1.0)
    return _against(samples, own, freedom, mean, variance, count, least_variance)


def moderated_welch(
    samples: Array, mean: Array, variance: Array, count: int, least_variance: Array
) -> Difference:
    """`welch` for many tiles at once: what they have in common sharpens each one's variance.

    Eight seeds tell a variance badly, and a t test with 7 degrees of freedom must then allow for
    17 standard deviations. Tiles of one estimator are noisy in about the reference's pattern; how
    closely is measured, and weighed as that many degrees of freedom (Smyth 2004, "Linear models
    and empirical Bayes methods", sections 3 and 6). An estimator of another pattern gains nothing.
    """
    seeds = len(samples)
    own = samples.var(axis=0, ddof=1) / seeds
    prior, weight = _variance_prior(own, variance, seeds - 1, count - 1, _rounding(mean))
    moderated = (weight * prior * variance + (seeds - 1) * own) / (weight + seeds - 1)
    freedom = np.full(own.shape, weight + seeds - 1)
    return _against(samples, moderated, freedom, mean, variance, count, least_variance)


def paired(samples: Array, twins: Array) -> Difference:
    """Samples against the reference's at the same seeds, both (seeds, ...)."""
    seeds = len(samples)
    each = samples - twins
    variance = each.var(axis=0, ddof=1) / seeds + _rounding(twins.mean(axis=0))
    return Difference(each.mean(axis=0), variance, np.full(variance.shape, seeds - 1.0))


def quieter(unpaired: Difference, same_seeds: Difference) -> Difference:
    """The paired difference where shared random numbers cancel most of the noise, else the other.

    A quarter of the variance: two independent estimators give twice as much, so the choice does
    not follow from chance.
    """
    cancels = same_seeds.variance.sum() < 0.25 * unpaired.variance.sum()
    return same_seeds if cancels else unpaired


def simes(p: Array) -> float:
    """One p for "any of these": Simes 1986, valid for independent or positively dependent tests."""
    ordered = np.sort(p, axis=None)
    return float(min(1.0, (ordered * ordered.size / np.arange(1, ordered.size + 1)).min()))


def chi_squared(p: Array, cap: float) -> float:
    """One p for "all of these together": each p as a squared normal deviate, capped, summed."""
    deviates = stats.norm.isf(np.clip(p, 1e-300, 1.0) / 2) ** 2
    return float(stats.chi2.sf(np.minimum(deviates, cap).sum(), deviates.size))


def _against(
    samples: Array,
    own: Array,
    freedom: Array,
    mean: Array,
    variance: Array,
    count: int,
    least_variance: Array,
) -> Difference:
    own = np.maximum(own, least_variance) + _rounding(mean)
    total = own + variance
    joint = total**2 / (own**2 / freedom + variance**2 / (count - 1))
    return Difference(samples.mean(axis=0) - mean, total, joint)


def _variance_prior(
    own: Array, pattern: Array, freedom: int, most: int, negligible: Array
) -> tuple[float, float]:
    """The factor between `own` and `pattern`, and the degrees of freedom that it is worth.

    Method of moments on log variances: Smyth 2004, section 6.2. At most `most`, since the pattern
    itself was measured; none when there are too few random tiles to tell.
    """
    random = pattern > negligible
    if random.sum() < 16:
        return 1.0, 0.0
    # A tile in which nothing random happened counts as a million times too quiet.
    logs = np.log(np.maximum(own[random] / pattern[random], 1e-6))
    logs = logs - special.digamma(freedom / 2) + np.log(freedom / 2)
    surplus = logs.var(ddof=1) - special.polygamma(1, freedom / 2)
    worth = min(2 * _inverse_trigamma(float(surplus)), float(most))
    factor = np.exp(logs.mean() + special.digamma(worth / 2) - np.log(worth / 2))
    return float(factor), worth


def _inverse_trigamma(value: float) -> float:
    """The positive x of trigamma(x) = value; a large one for values near zero and below."""
    if value < 1e-3:
        return 1e3
    root = optimize.brentq(lambda log: special.polygamma(1, np.exp(log)) - value, -20.0, 7.0)
    return float(np.exp(root))


def _rounding(mean: Array) -> Array:
    floor: Array = (ROUNDING * np.abs(mean)) ** 2 + 1e-60
    return floor
