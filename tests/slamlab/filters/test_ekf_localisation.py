"""Localisation in a known map and mapping from known poses: the two easy halves."""

from types import SimpleNamespace

import numpy as np
import pytest
from filterpy.kalman import ExtendedKalmanFilter
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab import models
from slamlab.filters import ekf_localisation
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.kalman_filter import belief
from slamlab.filters.known_pose_mapping import KnownPoseMap
from slamlab.geometry import wrap
from slamlab.models import jacobians
from tests.slamlab.filters.textbook import random_covariance

Q, R = np.diag([1e-3, 2e-3, 5e-4]), np.array([[0.01, 0.0005], [0.0005, 0.001]])


def residual(a, b):
    v = a - b
    v[1::2] = wrap(v[1::2])
    return v


@given(st.integers(0, 2**32), st.integers(1, 4))
@settings(max_examples=30, deadline=None)
def test_localisation_agrees_with_filterpy(seed, m):
    rng = np.random.default_rng(seed)
    start = np.array([*rng.uniform(-1, 1, 2), rng.uniform(-2, 2)])
    ours = belief(start, random_covariance(rng, 3, 0.1))
    peer = ExtendedKalmanFilter(3, 2 * m)
    peer.x, peer.P, peer.R, peer.Q = ours.x.copy(), ours.P.copy(), np.kron(np.eye(m), R), Q
    for _ in range(5):
        u = rng.normal(0, 0.2, 2)
        moved, A = models.f_odometry(ours.x, u), jacobians.A_odometry(ours.x, u)
        ours = ekf_localisation.predict(ours, moved, A, Q)
        peer.F, peer.predict_x = A, lambda u=0, moved=moved: setattr(peer, "x", moved)
        peer.predict()
        p = moved[:2] + rng.uniform(2, 4, (m, 2)) * rng.choice([-1, 1], (m, 2))
        z = models.h(moved, p) + rng.normal(size=(m, 2)) * 0.05
        ours, _ = ekf_localisation.update(ours, z, p, R)
        peer.update(
            z.ravel(),
            lambda x, p=p: jacobians.H_robot(x, p).reshape(-1, 3),
            lambda x, p=p: models.h(x, p).ravel(),
            residual=residual,
        )
        peer.x[2] = wrap(peer.x[2])
        assert np.allclose(ours.x, peer.x, rtol=0, atol=1e-12)
        assert np.allclose(ours.P, peer.P, rtol=0, atol=1e-12)


def seen_map(rng, poses, points):
    """A map of the points, each seen from every pose with noise R."""
    found = KnownPoseMap()
    for x in poses:
        for k, z in enumerate(models.h(x, points)):
            found.update(x, k, z + rng.multivariate_normal([0, 0], R), R)
    return found


POSES = np.array([[0, 0, 0.3], [0.5, -0.4, 1.0], [-0.6, 0.3, -2.9]])
POINTS = np.array([[4.0, 1.0], [-2.0, 3.5], [1.0, -5.0]])


def test_mapping_equals_the_augmented_filter_with_a_certain_robot():
    rng = np.random.default_rng(5)
    mak, found = MAK(POSES[0], np.zeros((3, 3))), KnownPoseMap()
    for step in range(4):
        z = models.h(POSES[0], POINTS) + rng.multivariate_normal([0, 0], R, 3)
        for k in range(3):
            found.update(POSES[0], k, z[k], R)
        (mak.update if step else mak.add)(range(3), z, R)
    assert np.allclose(mak.x[3:], found.points().ravel(), rtol=0, atol=1e-10)
    P = np.zeros((6, 6))
    for k, landmark in found.landmarks.items():
        P[2 * k : 2 * k + 2, 2 * k : 2 * k + 2] = landmark.P
    assert np.allclose(mak.P[3:, 3:], P, rtol=0, atol=1e-10)


def localised():
    return belief([0, 0, 0.2], np.eye(3) * 0.1)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda b: ekf_localisation.predict(b, [0, 0], np.eye(3), Q), "x has shape"),
        (lambda b: ekf_localisation.predict(b, b.x, np.eye(2), Q), "A has shape"),
        (lambda b: ekf_localisation.predict(b, b.x, np.eye(3), -Q), "Q has a negative eigenvalue"),
        (lambda b: ekf_localisation.update(b, [[1, 0]], [[1, 2], [3, 4]], R), "p has shape"),
        (lambda b: ekf_localisation.update(b, [[1, np.nan]], [[1, 2]], R), "z or R contains NaN"),
        (lambda b: ekf_localisation.update(b, [[1, 0]], [[np.inf, 2]], R), "p contains NaN"),
        (lambda b: ekf_localisation.update(b, [[-1, 0]], [[1, 2]], R), "range that is not pos"),
        (lambda b: ekf_localisation.update(b, [[1, 0]], [[1, 2]], -R), "R must be a covariance"),
    ],
)
def test_bad_input_to_localisation_is_named_and_changes_nothing(call, message):
    b = localised()
    x, P = b.x.copy(), b.P.copy()
    with pytest.raises(ValueError, match=message):
        call(b)
    assert np.array_equal(b.x, x) and np.array_equal(b.P, P)


@pytest.mark.parametrize("id", [0, 9])
@pytest.mark.parametrize(
    ("bad", "message"),
    [
        (dict(x=[0, 0]), "x has shape"),
        (dict(z=[1, np.nan]), "z or R contains NaN"),
        (dict(z=[-1, 0]), "range that is not positive"),
        (dict(z=[1, 0, 2]), "z has shape"),
        (dict(R=-R), "R has a negative eigenvalue"),
    ],
)
def test_bad_input_to_mapping_is_named_and_changes_nothing(id, bad, message):
    found = seen_map(np.random.default_rng(7), POSES, POINTS)
    before = dict(found.landmarks)
    good = SimpleNamespace(**{"x": POSES[0], "z": [1, 0], "R": R, **bad})
    with pytest.raises(ValueError, match=message):
        found.update(good.x, id, good.z, good.R)
    assert found.landmarks == before
