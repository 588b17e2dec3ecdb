"""Laws of the cart in a corridor: its drives are as its matrices say."""

import numpy as np
import pytest

from slamlab.evaluation import band, nees
from slamlab.filters.linear_kalman import belief, filter_runs
from slamlab.simulation import cart


def filtered(zs, Q=cart.Q):
    start = belief(cart.START_X, cart.START_P)
    return filter_runs(start, zs, cart.F, Q, cart.H, cart.R, cart.G, cart.PUSHES)


def test_a_filter_that_knows_its_matrices_is_consistent_on_its_drives():
    truth, zs = cart.drives(np.random.default_rng(1), 500)
    found = filtered(zs)
    low, high = band(2, 500, 1 - 1e-6)
    for step in (0, 20, 35, 59):
        mean = nees(truth[:, step] - found.x[:, step], found.P[step][None]).mean()
        assert low < mean < high


@pytest.mark.parametrize("blocked", [slice(0, 0), slice(24, 36), slice(10, 11)])
def test_nothing_is_measured_where_the_range_finder_is_blocked(blocked):
    _, zs = cart.drives(np.random.default_rng(2), 3, blocked)
    assert np.array_equal(np.flatnonzero(np.isnan(zs[0, :, 0])), np.arange(60)[blocked])


def test_without_noise_it_comes_to_rest_where_the_pushes_bring_it():
    x = cart.START_X
    for u in cart.PUSHES:
        x = cart.F @ x + cart.G @ u
    assert x[0] == pytest.approx(2 + 0.9 * 22) and x[1] == pytest.approx(0)
