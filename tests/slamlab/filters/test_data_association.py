"""Gating by 5 × 5 blocks equals the brute-force form, and passes what it promises."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab import models
from slamlab.filters.data_association import nearest_neighbours, squared_distances
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.geometry import wrap
from slamlab.models import jacobians
from tests.slamlab.support import refuses

Q, R = np.diag([1e-3, 2e-3, 5e-4]), np.array([[0.01, 0.0005], [0.0005, 0.001]])


def filled(rng, landmarks=6):
    """A filter whose every block is correlated."""
    mak = MAK([0.3, -0.2, 0.4], np.diag([0.02, 0.03, 0.01]))
    z = np.column_stack([rng.uniform(1, 6, landmarks), rng.uniform(-3, 3, landmarks)])
    mak.add([f"tree {k}" for k in range(landmarks)], z, R)
    mak.predict(models.f_odometry(mak.pose, [0.3, 0.2]), Q)
    seen = mak.ids[:2]
    mak.update(seen, models.h(mak.pose, mak.x[mak.rows(seen)].reshape(-1, 2)) + 0.01, R)
    return mak


def brute_force(mak, z, R):
    """The whole H against the whole P, one landmark at a time."""
    P, d2 = mak.P, np.empty(len(mak.ids))
    for k, p in enumerate(mak.landmarks()):
        H = np.zeros((2, len(P)))
        H[:, :3] = jacobians.H_robot(mak.pose, p)
        H[:, 3 + 2 * k : 5 + 2 * k] = jacobians.H_landmark(mak.pose, p)
        v = z - models.h(mak.pose, p)
        v[1] = wrap(v[1])
        d2[k] = v @ np.linalg.solve(H @ P @ H.T + R, v)
    return d2


@given(st.integers(0, 2**32), st.integers(1, 5))
@settings(max_examples=30, deadline=None)
def test_distances_equal_the_brute_force_form(seed, m):
    rng = np.random.default_rng(seed)
    mak = filled(rng)
    z = np.column_stack([rng.uniform(1, 6, m), rng.uniform(-3, 3, m)])
    noise = R * rng.uniform(0.5, 2, (m, 1, 1))
    expected = [brute_force(mak, row, own) for row, own in zip(z, noise, strict=True)]
    assert np.allclose(squared_distances(mak, z, noise), expected, rtol=1e-9)


def test_expected_observations_are_associated_and_new_ones_are_not():
    mak = filled(np.random.default_rng(1))
    z = models.h(mak.pose, mak.landmarks())[[4, 1]]
    assert nearest_neighbours(mak, np.vstack([z, [40, 0]]), R) == ["tree 4", "tree 1", None]


def test_the_gate_passes_as_many_true_pairings_as_it_promises():
    rng = np.random.default_rng(2)
    mak = MAK([0, 0, 0], np.diag([1e-6, 1e-6, 1e-7]))
    mak.add([0], [[3, 0.5]], R * 1e-4)
    z = np.array([3, 0.5]) + rng.multivariate_normal([0, 0], R, 20_000)
    rejected = nearest_neighbours(mak, z, R, 0.9).count(None)
    assert abs(rejected - 2000) < 5 * np.sqrt(20_000 * 0.9 * 0.1)


def test_with_no_landmark_all_is_new():
    mak = MAK([0, 0, 0], np.eye(3))
    assert nearest_neighbours(mak, [[1, 0], [2, 0]], R) == [None, None]


test_bad_input_is_named = refuses(
    lambda given: nearest_neighbours(filled(np.random.default_rng(3)), given[0], R, given[1]),
    (([[1, 0]], 1.5), "between 0 and 1"),
    (([[1, np.nan]], 0.9), "NaN"),
    (([[1]], 0.9), "z has shape"),
    ((7, 0.9), "z has"),
)
