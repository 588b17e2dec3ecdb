"""The cart in a corridor: its runs follow its matrices."""

import numpy as np
import pytest

from slamlab.evaluation import band, nees
from slamlab.filters.kalman_filter import belief, filter_runs
from slamlab.simulation import linear_system


def filtered(zs, Q=linear_system.Q):
    system, start = linear_system, belief(linear_system.START_X, linear_system.START_P)
    return filter_runs(start, zs, system.F, Q, system.H, system.R, system.G, system.CONTROLS)


def test_a_filter_that_knows_its_matrices_is_consistent_on_its_runs():
    truth, zs = linear_system.simulate_runs(np.random.default_rng(1), 500)
    found = filtered(zs)
    low, high = band(2, 500, 1 - 1e-6)
    for step in (0, 20, 35, 59):
        mean = nees(truth[:, step] - found.x[:, step], found.P[step][None]).mean()
        assert low < mean < high


@pytest.mark.parametrize("blocked", [slice(0, 0), slice(24, 36), slice(10, 11)])
def test_nothing_is_measured_where_the_range_finder_is_blocked(blocked):
    _, zs = linear_system.simulate_runs(np.random.default_rng(2), 3, blocked)
    assert np.array_equal(np.flatnonzero(np.isnan(zs[0, :, 0])), np.arange(60)[blocked])


def test_without_noise_it_comes_to_rest_where_the_control_inputs_lead():
    x = linear_system.START_X
    for u in linear_system.CONTROLS:
        x = linear_system.F @ x + linear_system.G @ u
    assert x[0] == pytest.approx(2 + 0.9 * 22) and x[1] == pytest.approx(0)
