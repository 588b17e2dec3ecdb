"""Laws of the linear Kalman filter."""

import numpy as np
import pytest
from filterpy.kalman import KalmanFilter
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab.filters.kalman_filter import belief, filter_runs, predict, update
from tests.slamlab.filters.textbook import random_covariance


def problem(rng, n, m):
    """A belief of size n and a measurement of size m, all generic."""
    b = belief(rng.normal(size=n), random_covariance(rng, n))
    return b, rng.normal(size=m), rng.normal(size=(m, n)), random_covariance(rng, m)


@given(st.integers(0, 2**32), st.integers(1, 5), st.integers(1, 3))
@settings(max_examples=40, deadline=None)
def test_it_agrees_with_filterpy(seed, n, m):
    rng = np.random.default_rng(seed)
    ours, _, H, R = problem(rng, n, m)
    F = np.linalg.qr(rng.normal(size=(n, n)))[0]
    G, Q = rng.normal(size=(n, 2)), random_covariance(rng, n, 0.1)
    peer = KalmanFilter(n, m, 2)
    peer.x, peer.P, peer.F, peer.H, peer.B = ours.x.copy(), ours.P.copy(), F, H, G
    peer.Q, peer.R = Q, R
    for _ in range(5):
        u, z = rng.normal(size=2), rng.normal(size=m)
        ours, _ = update(predict(ours, F, Q, G, u), z, H, R)
        peer.predict(u)
        peer.update(z)
        assert np.allclose(ours.x, peer.x, rtol=1e-12, atol=1e-12)
        assert np.allclose(ours.P, peer.P, rtol=1e-12, atol=1e-12)


@given(st.integers(0, 2**32), st.integers(1, 5), st.integers(1, 8))
@settings(max_examples=40, deadline=None)
def test_a_batch_update_is_least_squares_in_information_form(seed, n, m):
    rng = np.random.default_rng(seed)
    b, z, H, R = problem(rng, n, m)
    after, _ = update(b, z, H, R)
    information = np.linalg.inv(b.P) + H.T @ np.linalg.solve(R, H)
    vector = np.linalg.solve(b.P, b.x) + H.T @ np.linalg.solve(R, z)
    assert np.allclose(after.P, np.linalg.inv(information), rtol=1e-8, atol=1e-9)
    assert np.allclose(after.x, np.linalg.solve(information, vector), rtol=1e-8, atol=1e-8)


@given(st.integers(0, 2**32), st.floats(1e-3, 1))
@settings(max_examples=40, deadline=None)
def test_any_other_gain_has_a_larger_trace(seed, size):
    rng = np.random.default_rng(seed)
    b, z, H, R = problem(rng, 4, 2)
    after, step = update(b, z, H, R)
    K = step.K + size * rng.normal(size=(4, 2))
    I_KH = np.eye(4) - K @ H
    other = I_KH @ b.P @ I_KH.T + K @ R @ K.T
    assert np.trace(other) > np.trace(after.P)


def test_a_step_reports_innovation_gain_and_nis():
    b, z, H, R = problem(np.random.default_rng(1), 4, 2)
    after, step = update(b, z, H, R)
    S = H @ b.P @ H.T + R
    assert np.allclose(step.innovation, z - H @ b.x) and np.allclose(step.S, S)
    assert np.allclose(step.K, b.P @ H.T @ np.linalg.inv(S))
    assert np.allclose(after.x, b.x + step.K @ step.innovation)
    assert np.isclose(step.nis, step.innovation @ np.linalg.solve(S, step.innovation))


H, R = np.eye(2), np.eye(2)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda b: belief([0, np.nan], np.eye(2)), "x contains NaN"),
        (lambda b: belief([0, 0], np.eye(3)), "P has shape"),
        (lambda b: belief([0, 0], np.diag([1, -1])), "P has a negative eigenvalue"),
        (lambda b: predict(b, np.eye(3), R), "F has shape"),
        (lambda b: predict(b, np.eye(2), [[1, 1], [0, 1]]), "Q is not symmetric"),
        (lambda b: predict(b, np.eye(2), R, [[1], [1]], [1, 2]), "G has shape"),
        (lambda b: predict(b, np.eye(2), R, None, [1, 2]), "G"),
        (lambda b: update(b, [1, 2], np.eye(3), R), "H has shape"),
        (lambda b: update(b, [1, np.inf], H, R), "z contains NaN"),
        (lambda b: update(b, ["far", 1], H, R), "z is not an array of numbers"),
        (lambda b: update(b, [1, 2], H, -R), "R has a negative eigenvalue"),
        (lambda b: update(belief([0, 0], R * 0), [1, 2], H, R * 0), "S = H P Hᵀ \\+ R is singular"),
    ],
)
def test_bad_input_is_named_and_changes_nothing(call, message):
    b = belief([1, 2], np.eye(2))
    with pytest.raises(ValueError, match=message):
        call(b)
    assert np.array_equal(b.x, [1, 2]) and np.array_equal(b.P, np.eye(2))


def test_many_runs_at_once_are_each_filtered_step_by_step():
    rng = np.random.default_rng(3)
    b, zs = belief(rng.normal(size=3), random_covariance(rng, 3)), rng.normal(size=(4, 6, 2))
    F, G, H = (rng.normal(size=shape) for shape in ((3, 3), (3, 2), (2, 3)))
    Q, R, us = random_covariance(rng, 3), random_covariance(rng, 2), rng.normal(size=(6, 2))
    zs[:, 2:4] = np.nan
    found = filter_runs(b, zs, F, Q, H, R, G, us)
    for run in range(4):
        now = b
        for k in range(6):
            now = predict(now, F, Q, G, us[k])
            assert np.allclose(found.innovations[run, k], zs[run, k] - H @ now.x, equal_nan=True)
            assert np.allclose(found.S[k], H @ now.P @ H.T + R)
            if k not in (2, 3):
                now, _ = update(now, zs[run, k], H, R)
            assert np.allclose(found.x[run, k], now.x) and np.allclose(found.P[k], now.P)


def test_runs_that_measure_at_different_steps_are_refused():
    zs = np.zeros((2, 3, 1))
    zs[0, 1] = np.nan
    with pytest.raises(ValueError, match="same steps"):
        filter_runs(belief([0.0], [[1.0]]), zs, *(np.eye(1) for _ in range(4)))
