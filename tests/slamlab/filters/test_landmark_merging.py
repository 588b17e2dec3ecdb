"""Laws of merging two landmarks that are one, by an exact observation."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import chi2

from slamlab import models
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.landmark_merging import merge, squared_difference
from slamlab.filters.landmark_models import LINES, POINTS

R = np.diag([0.02, 0.01]) ** 2
KINDS = pytest.mark.parametrize("kind", [POINTS, LINES], ids=["points", "lines"])


def seen(rng, kind=POINTS, landmarks=5, **options):
    """A map of correlated landmarks after some steps; the last is the first, observed again."""
    mak = MAK(np.zeros(3), np.diag([0.02, 0.01, 0.02]) ** 2, kind=kind, **options)
    z = np.column_stack([rng.uniform(1, 5, landmarks), rng.uniform(-3, 3, landmarks)])
    mak.add(range(landmarks), z, R)
    for _ in range(4):
        mak.predict(models.f_odometry(mak.pose, [0.2, rng.normal(0, 0.2)]), R[0, 0] * np.eye(3))
        ids = rng.choice(landmarks, 2, replace=False).tolist()
        z = kind.h(mak.pose, mak.x[mak.rows(ids)].reshape(-1, 2))
        mak.update(ids, z + rng.normal(size=(2, 2)) * np.sqrt(np.diag(R)), R)
    again = kind.h(mak.pose, mak.landmarks()[:1]) + rng.normal(size=2) * np.sqrt(np.diag(R))
    mak.add([landmarks], again, R)
    return mak


@KINDS
@given(seed=st.integers(0, 2**32))
@settings(max_examples=30, deadline=None)
def test_it_is_the_kalman_update_by_a_zero_difference_without_noise(kind, seed):
    mak = seen(np.random.default_rng(seed), kind)
    x, P, n = mak.x.copy(), mak.P, len(mak.x)
    H = np.zeros((2, n))
    H[:, 3:5], H[:, -2:] = -np.eye(2), np.eye(2)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T)
    after, less = x + K @ -kind.minus(x[-2:], x[3:5]), P - K @ H @ P
    np.testing.assert_allclose(after[-2:], after[3:5], atol=1e-12)  # for sure
    merge(mak, 0, 5)
    assert mak.ids == [0, 1, 2, 3, 4]
    np.testing.assert_allclose(mak.x, after[:-2], atol=1e-9)
    now = mak.P
    np.testing.assert_allclose(now, less[:-2, :-2], atol=1e-9)
    assert np.array_equal(now, now.T)
    assert np.linalg.eigvalsh(now)[0] >= -1e-12 * now.max()
    assert np.linalg.eigvalsh(P[:-2, :-2] - now)[0] >= -1e-9


@KINDS
def test_the_result_does_not_depend_on_which_landmark_is_kept(kind):
    one, other = (seen(np.random.default_rng(4), kind) for _ in range(2))
    merge(one, 0, 5)
    merge(other, 5, 0)
    rows = one.rows([0, 1, 2, 3, 4]), other.rows([5, 1, 2, 3, 4])
    np.testing.assert_allclose(one.x[rows[0]], other.x[rows[1]], atol=1e-9)
    np.testing.assert_allclose(one.block(rows[0]), other.block(rows[1]), atol=1e-9)


def test_directions_either_side_of_the_seam_of_a_turn_are_near():
    mak = MAK(np.zeros(3), np.zeros((3, 3)), kind=LINES)
    mak.add([0, 1], [[2.0, np.pi - 0.01], [2.0, -np.pi + 0.01]], R)
    assert squared_difference(mak, 0, 1) < 4
    merge(mak, 0, 1)
    assert abs(abs(mak.landmarks()[0, 1]) - np.pi) < 1e-9


@KINDS
def test_the_squared_difference_of_copies_of_one_landmark_is_chi_squared(kind):
    rng, found, root = np.random.default_rng(8), [], np.array([0.02, 0.02, 0.01])
    landmark = np.array([3.0, 0.8])
    for _ in range(400):
        true, step = np.zeros(3), np.array([0.1, 0.1, 0.2])
        mak = MAK(true, np.zeros((3, 3)), kind=kind)
        for i in (0, 1):  # two steps in error, a look after each
            true = true + step + root * rng.normal(size=3)
            mak.predict(mak.pose + step, np.diag(root**2))
            noise = rng.normal(size=2) * np.sqrt(np.diag(R))
            mak.add([i], [kind.h(true, landmark) + noise], R)
        found.append(squared_difference(mak, 0, 1))
        assert squared_difference(mak, 1, 0) == pytest.approx(found[-1])
    inside = np.mean(np.array(found) < 9.21)
    assert abs(inside - chi2.cdf(9.21, 2)) < 0.02
    assert abs(np.mean(found) - 2) < 0.4  # four standard deviations of such a mean


def test_what_is_equal_already_is_refused_and_nothing_changes():
    mak = MAK(np.zeros(3), np.diag([0.02, 0.01, 0.02]) ** 2)
    mak.add([0, 1], [[2.0, 0.5], [2.1, 0.5]], np.zeros((2, 2)))
    mak.remove([1])
    mak.add([1], [[2.0, 0.5]], np.zeros((2, 2)))
    x, P = mak.x.copy(), mak.P
    with pytest.raises(ValueError, match="0, 1: their difference has zero variance in P"):
        merge(mak, 0, 1)
    with pytest.raises(ValueError, match=r"\[7\] are not in the map"):
        merge(mak, 0, 7)
    assert np.array_equal(mak.x, x) and np.array_equal(mak.P, P) and mak.ids == [0, 1]
