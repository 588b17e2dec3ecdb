"""Landmark models of points and lines: equal to the dense filter, with a consistent NEES."""

import numpy as np
import pytest

from slamlab import models
from slamlab.evaluation import band, nees
from slamlab.filters.data_association import squared_distances
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.landmark_models import LINES, POINTS
from slamlab.geometry import compose, wrap
from slamlab.models import noise

WALLS = np.array([[2.0, 0.2], [3.0, 1.8], [1.5, -2.9], [2.5, -1.4], [1.0, 0.9 - np.pi]])
R = np.diag([0.02, 0.01]) ** 2


@pytest.mark.parametrize("kind", [POINTS, LINES])
def test_an_update_is_the_dense_kalman_update_with_the_kinds_own_H(kind):
    rng = np.random.default_rng(3)
    mak = MAK([0.4, -0.3, 0.6], np.diag([0.02, 0.03, 0.01]), kind=kind)
    mak.add(range(4), np.column_stack([rng.uniform(1, 4, 4), rng.uniform(-3, 3, 4)]), R)
    x, P = mak.x.copy(), mak.P
    p = mak.landmarks()[[2, 0]]
    z = kind.h(mak.pose, p) + rng.normal(0, 0.02, (2, 2))
    H = np.zeros((4, len(x)))
    H_r, H_p = kind.H(mak.pose, p)
    for k, i in enumerate([2, 0]):
        H[2 * k : 2 * k + 2, :3], H[2 * k : 2 * k + 2, 3 + 2 * i : 5 + 2 * i] = H_r[k], H_p[k]
    v = z - kind.h(mak.pose, p)
    v[:, 1] = wrap(v[:, 1])
    S = H @ P @ H.T + np.kron(np.eye(2), R)
    K = P @ H.T @ np.linalg.inv(S)
    mak.update([2, 0], z, R)
    np.testing.assert_allclose(mak.x, x + K @ v.ravel(), atol=1e-12)
    np.testing.assert_allclose(mak.P, P - K @ S @ K.T, atol=1e-12)
    assert squared_distances(mak, kind.h(mak.pose, p), R)[0].argmin() == 2


def one_walk(seed, steps=25):
    """A robot among five walls, each seen at every step; the error at the end and its P."""
    rng = np.random.default_rng(seed)
    true, mak = np.zeros(3), MAK(np.zeros(3), np.zeros((3, 3)), kind=LINES)
    root = np.array([0.02, 0.01, 0.01])
    for k in range(steps):
        move = np.array([0.1, 0.0, 0.12])
        true = compose(true, move)
        believed = mak.pose
        c, s = np.cos(believed[2]), np.sin(believed[2])
        W = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        measured = move + root * rng.standard_normal(3)
        mak.predict(compose(believed, measured), noise.Q(W, np.diag(root**2)))
        z = models.h_line(true, WALLS) + rng.standard_normal((5, 2)) * np.sqrt(np.diag(R))
        (mak.update if k else mak.add)(range(5), z, R)
    error = mak.x - np.concatenate([true, WALLS.ravel()])
    error[[2, *range(4, 13, 2)]] = wrap(error[[2, *range(4, 13, 2)]])
    return error, mak.P


def test_errors_of_its_lines_and_its_pose_match_its_covariance():
    runs = 40
    errors, P = zip(*(one_walk(seed) for seed in range(runs)), strict=True)
    errors, P = np.array(errors), np.array(P)
    low, high = band(3, runs, 0.9999)
    assert low < nees(errors[:, :3], P[:, :3, :3]).mean() < high
    low, high = band(13, runs, 0.9999)
    assert low < nees(errors, P).mean() < high
