"""The compressed filter equals the full one after its global update; relative vectors are right."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab import models
from slamlab.filters.compressed_ekf import CompressedEKF
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.relative_map import relative_vector

Q, R = np.diag([1e-3, 2e-3, 5e-4]), np.diag([0.01, 0.001])


def filled(rng, landmarks=12):
    mak = MAK([0.3, -0.2, 0.4], np.diag([0.02, 0.03, 0.01]))
    z = np.column_stack([rng.uniform(1, 6, landmarks), rng.uniform(-3, 3, landmarks)])
    mak.add(range(landmarks), z, R)
    return mak


@given(st.integers(0, 2**32), st.booleans())
@settings(max_examples=25, deadline=None)
def test_compressed_equals_full_when_linearised_at_the_same_points(seed, first_estimates):
    rng = np.random.default_rng(seed)
    full, whole = filled(np.random.default_rng(seed)), filled(np.random.default_rng(seed))
    full.first_estimates = whole.first_estimates = first_estimates
    compressed = CompressedEKF(whole)
    for _ in range(4):
        region = rng.choice(12, 5, replace=False).tolist()
        compressed.focus(region)
        for _ in range(6):
            x_new = models.f_odometry(full.pose, rng.normal(0, 0.3, 2))
            full.predict(x_new, Q)
            compressed.predict(x_new, Q)
            ids = rng.choice(region, 3, replace=False).tolist()
            z = models.h(full.pose, full.x[full.rows(ids)].reshape(-1, 2))
            z = z + rng.normal(size=z.shape) * 0.03
            a, b = full.update(ids, z, R), compressed.update(ids, z, R)
            assert np.allclose(a.innovation, b.innovation, atol=1e-9)
    compressed.settle()
    assert np.allclose(whole.x, full.x, atol=1e-9)
    assert np.allclose(whole.P, full.P, atol=1e-9)


def test_without_a_region_nothing_can_be_seen():
    compressed = CompressedEKF(filled(np.random.default_rng(0)))
    with pytest.raises(ValueError, match="call focus"):
        compressed.update([1], [[1, 0]], R)
    compressed.settle()


def test_relative_vectors_have_the_covariance_of_the_difference():
    mak = filled(np.random.default_rng(1), 4)
    P = mak.P
    d, C = relative_vector(mak, 3, 1)
    i, j = slice(9, 11), slice(5, 7)
    assert np.allclose(d, mak.x[j] - mak.x[i])
    assert np.allclose(C, P[i, i] - P[i, j] - P[j, i] + P[j, j])
