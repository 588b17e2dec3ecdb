"""Landmark models of points and lines: equal to the dense filter, with a consistent NEES."""

import numpy as np
import pytest

from slamlab.filters.data_association import squared_distances
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.landmark_models import LINES, POINTS
from slamlab.geometry import wrap

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
