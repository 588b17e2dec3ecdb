"""Weights and resampling: normalised whatever their scale, unbiased whatever the seed."""

import numpy as np
import pytest
from filterpy.monte_carlo import resampling as peer
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import chi2

from slamlab.filters.particle_filters.importance_weights import effective_sample_size, normalise
from slamlab.filters.particle_filters.resampling import multinomial, systematic, systematic_at

logs = st.lists(st.floats(-50, 50), min_size=1, max_size=30).map(np.array)
FALSE_ALARM = 1e-6


def some_weights(seed, n):
    """Uneven weights, one of them zero."""
    weights = np.random.default_rng(seed).exponential(size=n) ** 2
    weights[n // 2] = 0
    return weights / weights.sum()


@given(logs)
def test_weights_sum_to_one_and_keep_their_ratios(logs):
    weights, total = normalise(logs)
    assert np.isclose(weights.sum(), 1)
    np.testing.assert_allclose(weights, np.exp(logs - logs.max()) * weights.max(), atol=1e-15)
    assert np.isclose(np.exp(total - logs.max()), np.exp(logs - logs.max()).sum())


@given(logs, st.floats(-1e5, 1e5))
def test_a_common_factor_changes_no_weight_and_moves_the_total(logs, offset):
    weights, total = normalise(logs)
    moved, moved_total = normalise(logs + offset)
    np.testing.assert_allclose(moved, weights, rtol=1e-9, atol=1e-12)
    assert np.isclose(moved_total, total + offset, rtol=1e-12, atol=1e-8)


def test_weights_that_are_all_zero_become_equal_and_the_total_shows_it():
    weights, total = normalise(np.full(4, -np.inf))
    np.testing.assert_array_equal(weights, np.full(4, 0.25))
    assert total == -np.inf


@pytest.mark.parametrize("logs", [[], [[0.0]], [0.0, np.nan], [0.0, np.inf]])
def test_invalid_log_weights_are_refused(logs):
    with pytest.raises(ValueError, match="log-weight"):
        normalise(logs)


@given(logs)
def test_the_effective_size_lies_between_one_and_all(logs):
    weights, _ = normalise(logs)
    assert 1 - 1e-9 <= effective_sample_size(weights) <= len(logs) + 1e-9
    assert np.isclose(effective_sample_size(np.full(len(logs), 1 / len(logs))), len(logs))


@given(st.integers(0, 2**32), st.integers(2, 200))
@settings(max_examples=100, deadline=None)
def test_systematic_resampling_equals_filterpys_for_the_same_random_number(seed, n):
    weights, u = some_weights(seed, n), np.random.default_rng(seed).random()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(peer, "random", lambda: u)
        np.testing.assert_array_equal(
            systematic_at(weights, n, u), peer.systematic_resample(weights)
        )


@given(st.integers(0, 2**32), st.integers(1, 60), st.integers(1, 300))
def test_systematic_resampling_gives_each_particle_its_share_rounded_up_or_down(seed, m, n):
    rng = np.random.default_rng(seed)
    weights = rng.dirichlet(np.full(m, 0.3))
    drawn = systematic(weights, n, rng)
    assert len(drawn) == n
    assert (np.diff(drawn) >= 0).all()
    copies = np.bincount(drawn, minlength=m)
    assert (np.abs(copies - n * weights) < 1 + 1e-9).all()


@pytest.mark.parametrize("draw", [systematic, multinomial])
def test_a_particle_of_weight_zero_is_never_drawn(draw):
    # ten tenths do not sum to one
    weights = np.append(np.full(10, 0.1), 0.0)
    for seed in range(200):
        assert draw(weights, 50, np.random.default_rng(seed)).max() < 10


def test_independent_draws_follow_the_weights():
    """Pearson's χ² over 20 000 draws of many seeds."""
    weights, n, runs = some_weights(3, 12), 100, 200
    copies = sum(
        np.bincount(multinomial(weights, n, np.random.default_rng(seed)), minlength=12)
        for seed in range(runs)
    )
    expected = runs * n * weights
    some = expected > 0
    assert (copies[~some] == 0).all()
    distance = ((copies - expected)[some] ** 2 / expected[some]).sum()
    assert distance < chi2.ppf(1 - FALSE_ALARM, some.sum() - 1)


def test_systematic_resampling_draws_each_particle_in_proportion_to_its_weight():
    """Over seeds: copies are ⌊n w⌋ and one more with the probability of the rest, so each
    sample's sum over seeds is binomial, and its standard score squared is χ² of one degree."""
    weights, n, runs = some_weights(4, 12), 30, 4000
    extra = np.zeros(12)
    whole = np.floor(n * weights)
    for seed in range(runs):
        extra += np.bincount(systematic(weights, n, np.random.default_rng(seed)), minlength=12)
    rest = n * weights - whole
    some = rest > 0
    scores = (extra - runs * n * weights)[some] / np.sqrt(runs * rest * (1 - rest))[some]
    # the samples share a random number: each is tried on its own, at its part of the false alarm
    assert (scores**2).max() < chi2.ppf(1 - FALSE_ALARM / some.sum(), 1)
