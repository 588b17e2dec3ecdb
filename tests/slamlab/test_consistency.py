"""NEES, NIS, their bands and the definition of consistency, tried on filters known to be so."""

import numpy as np
import pytest

from slamlab.evaluation import band, consistency, nees, nis
from slamlab.evaluation.consistency import largest_eigenvalue
from tests.slamlab.support import refuses

RUNS, STEPS = 100, 12
A, H = np.array([[1.0, 0.5], [0.0, 1.0]]), np.array([[1.0, 0.0]])
Q, R, P0 = np.diag([0.02, 0.05]), np.array([[0.3]]), np.diag([1.0, 0.4])


def tracked(rng, believed_Q=Q):
    """A linear filter over many runs: errors, P, innovations, S at the last step."""
    truth = rng.multivariate_normal(np.zeros(2), P0, RUNS)
    x, P = np.zeros((RUNS, 2)), P0
    for _ in range(STEPS):
        truth = truth @ A.T + rng.multivariate_normal(np.zeros(2), Q, RUNS)
        x, P = x @ A.T, A @ P @ A.T + believed_Q
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        v = truth @ H.T + rng.normal(0, np.sqrt(R[0, 0]), (RUNS, 1)) - x @ H.T
        x, P = x + v @ K.T, P - K @ S @ K.T
    each = np.ones((RUNS, 1, 1))
    return x - truth, each * P, v, each * S


def within(value, limits):
    return limits[0] < value < limits[1]


def random_covariance(rng, n):
    root = rng.normal(size=(n, n))
    return root @ root.T + 0.1 * np.eye(n)


# a consistent filter leaves these bands once in 10⁴ seeds; the seeds here are fixed
@pytest.mark.parametrize(("factor", "side"), [(1, 0), (0.01, 1), (20, -1)])
@pytest.mark.parametrize("seed", range(5))
def test_nees_lies_in_above_or_below_its_band_and_only_overconfidence_is_refuted(
    seed, factor, side
):
    errors, P, v, S = tracked(np.random.default_rng(seed), factor * Q)
    low, high = band(2, RUNS, 0.9999)
    mean = nees(errors, P).mean()
    assert int(mean > high) - int(mean < low) == side
    assert consistency(errors, P, 0.9999).refuted == (side > 0)
    if side == 0:
        assert within(nis(v, S).mean(), band(1, RUNS, 0.9999))


def test_one_overconfident_direction_is_found_though_the_others_hide_it_from_nees():
    rng = np.random.default_rng(3)
    errors = rng.multivariate_normal(np.zeros(3), np.diag([0.3, 2.4, 0.3]), 200)
    each = np.broadcast_to(np.eye(3), (200, 3, 3))
    assert within(nees(errors, each).mean(), band(3, 200, 0.9999))
    found = consistency(errors, each, 0.9999)
    assert found.refuted
    assert abs(found.direction[1]) > 0.95


@pytest.mark.parametrize(("size", "runs"), [(1, 50), (2, 12), (3, 50), (5, 20)])
def test_a_filter_that_is_just_consistent_is_refuted_as_rarely_as_promised(size, runs):
    rng, tries = np.random.default_rng(size), 3000
    w = rng.standard_normal((tries, runs, size))
    largest = np.linalg.eigvalsh(np.swapaxes(w, 1, 2) @ w / runs)[:, -1]
    wrong = np.mean(largest > largest_eigenvalue(size, runs, 0.95))
    assert 0.03 < wrong < 0.065


@pytest.mark.parametrize(("size", "runs"), [(3, 1), (3, 50), (2, 200)])
def test_the_band_holds_the_share_of_averages_it_names(size, runs):
    rng = np.random.default_rng(runs)
    averages = (rng.standard_normal((4000, runs, size)) ** 2).sum(axis=-1).mean(axis=-1)
    low, high = band(size, runs, 0.9)
    assert np.mean(averages < low) == pytest.approx(0.05, abs=0.015)
    assert np.mean(averages > high) == pytest.approx(0.05, abs=0.015)


def test_nees_does_not_hang_on_the_units_of_the_state():
    rng = np.random.default_rng(8)
    P, error = random_covariance(rng, 4), rng.normal(size=4)
    T = rng.normal(size=(4, 4))
    assert nees(T @ error, T @ P @ T.T) == pytest.approx(nees(error, P))
    assert nees(error, P) == pytest.approx(error @ np.linalg.inv(P) @ error)


def test_many_steps_of_many_runs_are_normalised_at_once():
    rng = np.random.default_rng(9)
    P = np.array([[random_covariance(rng, 3) for _ in range(4)] for _ in range(2)])
    errors = rng.normal(size=(2, 4, 3))
    at_once = nees(errors, P)
    assert at_once.shape == (2, 4)
    assert at_once[1, 2] == pytest.approx(nees(errors[1, 2], P[1, 2]))


test_an_error_that_cannot_be_normalised_is_refused_by_name = refuses(
    lambda call: call(),
    (lambda: nees(np.zeros(3), np.eye(2)), "but its covariance"),
    (lambda: nees(np.ones(2), np.diag([1.0, 0.0])), "not positive definite"),
    (lambda: nis(np.ones(2), -np.eye(2)), "not positive definite"),
    (lambda: band(3, 0), "at least 1"),
    (lambda: band(3, 50, 95), "between 0 and 1"),
    (lambda: consistency(np.ones((2, 3)), np.ones((2, 1, 1)) * np.eye(3)), "at least 3"),
)
