"""Laws of the MAK filter (EKF-SLAM)."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab import models
from slamlab.filters.ekf_slam_filter import MAK
from tests.slamlab.filters import textbook

Q = np.diag([1e-3, 2e-3, 5e-4])
R = np.diag([0.01, 0.001])
P0 = np.array([[0.02, 0.001, 0.002], [0.001, 0.03, -0.001], [0.002, -0.001, 0.01]])
START = np.array([0.3, -0.2, 0.4])


def scan(rng, m):
    return np.column_stack([rng.uniform(1, 6, m), rng.uniform(-3, 3, m)])


def seen_again(mak, ids, rng):
    p = mak.x[mak.rows(ids)].reshape(-1, 2)
    return models.h(mak.pose, p) + rng.normal(size=(len(ids), 2)) * np.sqrt(np.diag(R))


def filled(rng, landmarks=4, **options):
    mak = MAK(START, P0, capacity=2, **options)
    mak.add(range(landmarks), scan(rng, landmarks), R)
    return mak


def drive(mak, rng, steps=1, m=2):
    """Move and look, with whatever noise the generator gives."""
    for _ in range(steps):
        mak.predict(models.f_odometry(mak.pose, [0.3, rng.normal(0, 0.3)]), Q)
        ids = rng.choice(mak.ids, m, replace=False).tolist()
        mak.update(ids, seen_again(mak, ids, rng), R)


def unchanged(mak, act):
    """Whether a failing call left mean and covariance as they were; the error's text."""
    x, P = mak.x.copy(), mak.P
    with pytest.raises(ValueError) as error:
        act()
    assert np.array_equal(mak.x, x) and np.array_equal(mak.P, P)
    return str(error.value)


@given(st.integers(0, 2**32), st.integers(1, 6), st.integers(1, 12))
@settings(max_examples=40, deadline=None)
def test_fast_form_equals_the_textbook(seed, m, steps):
    rng = np.random.default_rng(seed)
    mak = MAK(START, P0, capacity=1)
    first = scan(rng, 6)
    mak.add(range(6), first, R)
    x, P = textbook.add(START, P0, first, R)
    for _ in range(steps):
        x_new = models.f_odometry(mak.pose, rng.normal(0, 0.3, 2))
        mak.predict(x_new, Q)
        x, P = textbook.predict(x, P, x_new, Q)
        ids = rng.choice(6, m, replace=False).tolist()
        z = seen_again(mak, ids, rng)
        mak.update(ids, z, R)
        x, P = textbook.update(x, P, ids, z, R)
    assert np.allclose(mak.x, x, atol=1e-9) and np.allclose(mak.P, P, atol=1e-9)


@pytest.mark.parametrize("updates", [3_000, pytest.param(100_000, marks=pytest.mark.slow)])
def test_covariance_stays_symmetric_and_positive_over_a_hundred_thousand_updates(updates):
    rng = np.random.default_rng(1)
    mak = filled(rng, 3)
    z, noise = seen_again(mak, mak.ids, rng), Q * 1e-4
    for k in range(updates):
        if k % 10 == 0:
            mak.predict(mak.pose, noise)
        mak.update([k % 3], z[k % 3 : k % 3 + 1], R)
    P = mak.P
    assert np.array_equal(P, P.T)
    assert np.linalg.eigvalsh(P)[0] >= 0


def test_a_nearly_exact_measurement_leaves_no_negative_variance():
    rng = np.random.default_rng(2)
    mak = MAK([0, 0, 0], np.diag([1e6, 1e6, 10]), capacity=4)
    mak.add(range(4), scan(rng, 4), np.eye(2) * 1e6)
    for _ in range(200):
        mak.update(range(4), seen_again(mak, range(4), rng), np.eye(2) * 1e-9)
    assert np.linalg.eigvalsh(mak.P)[0] >= 0


@given(st.integers(0, 2**32))
@settings(max_examples=30, deadline=None)
def test_no_update_loses_information(seed):
    rng = np.random.default_rng(seed)
    mak = filled(rng)
    drive(mak, rng, 3)
    before = mak.P
    mak.update([1, 3], seen_again(mak, [1, 3], rng), R)
    assert np.linalg.eigvalsh(before - mak.P)[0] >= -1e-12 * np.abs(before).max()


@given(st.integers(0, 2**32))
@settings(max_examples=30, deadline=None)
def test_no_map_block_nor_relative_vector_ever_grows_in_determinant(seed):
    rng = np.random.default_rng(seed)
    mak = filled(rng)
    relative = np.hstack([np.eye(2), -np.eye(2)])

    def determinants():
        P = mak.P[3:, 3:]
        pair = np.ix_([0, 1, 4, 5], [0, 1, 4, 5])
        return np.array(
            [np.linalg.det(P), np.linalg.det(P[:2, :2]), np.linalg.det(P[pair]),
             np.linalg.det(relative @ P[pair] @ relative.T)]
        )  # fmt: skip

    for _ in range(6):
        before = determinants()
        drive(mak, rng)
        assert (determinants() <= before * (1 + 1e-9)).all()


def test_after_the_first_landmark_it_alone_is_correlated_after_the_second_all_are():
    """The thesis' two-update example: the map's entries start independent."""
    mak = MAK(START, P0)
    mak.add([1], [[2, 0.5]], R)
    mak.add([2], [[3, -0.7]], R)
    L = mak._P.lower
    L[3:, :3], L[5:, 3:5] = 0, 0
    rng = np.random.default_rng(3)
    mak.update([1], seen_again(mak, [1], rng), R)
    P = mak.P
    assert np.abs(P[3:5, :3]).min() > 0
    assert not P[5:, :3].any() and not P[5:, 3:5].any()
    mak.update([2], seen_again(mak, [2], rng), R)
    P = mak.P
    assert all(np.abs(block).max() > 1e-6 for block in (P[3:5, :3], P[5:, :3], P[5:, 3:5]))


def test_removing_a_landmark_changes_nobody_elses_mean_or_covariance():
    rng = np.random.default_rng(5)
    mak = filled(rng, 5)
    drive(mak, rng, 4)
    keep = np.concatenate([[0, 1, 2], mak.rows([0, 2, 4])])
    x, P = mak.x[keep].copy(), mak.P[np.ix_(keep, keep)]
    mak.remove([1, 3])
    assert mak.ids == [0, 2, 4]
    assert np.array_equal(mak.x, x) and np.array_equal(mak.P, P)
    drive(mak, rng)


def test_an_update_works_in_place_on_memory_allocated_ahead():
    rng = np.random.default_rng(6)
    mak = MAK(START, P0, capacity=6)
    buffer = mak._P._flat
    mak.add(range(3), scan(rng, 3), R)
    mak.add(range(3, 6), scan(rng, 3), R)
    drive(mak, rng)
    assert np.shares_memory(buffer, mak._P.lower)
    before = mak._P.lower.copy()
    mak._P.downdate(np.asfortranarray(np.eye(15)[:, :2] * 0.01))
    assert not np.array_equal(mak._P.lower, before)  # dsyrk wrote here, not into a copy


def test_first_estimates_differ_from_the_standard_filter_only_after_a_correction():
    a, b = (filled(np.random.default_rng(7), first_estimates=f) for f in (False, True))
    for mak in (a, b):
        mak.predict(models.f_odometry(mak.pose, [0.3, 0.1]), Q)
    assert np.allclose(a.P, b.P)
    for mak in (a, b):
        drive(mak, np.random.default_rng(8), 3)
    assert not np.allclose(a.P, b.P)


def test_dropped_cross_terms_are_all_zero():
    rng = np.random.default_rng(9)
    mak = filled(rng, 3, drop_cross_terms_for_demonstration=True)
    drive(mak, rng, 3)
    P = mak.P
    for k in range(3):
        P[3 + 2 * k : 5 + 2 * k, 3 + 2 * k : 5 + 2 * k] = 0
    P[:3, :3] = 0
    assert not P.any()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda m: m.update([7], [[1, 0]], R), "[7] are not in the map"),
        (lambda m: m.update([1, 1], [[1, 0], [1, 0]], R), "[1] occur more than once"),
        (lambda m: m.update([], np.empty((0, 2)), R), "z contains no observations"),
        (lambda m: m.update([1], [[1, 0, 2]], R), "z has shape (1, 3)"),
        (lambda m: m.update([1], [["near", 0]], R), "z is not an array of numbers"),
        (lambda m: m.update([1], [[1, np.nan]], R), "NaN"),
        (lambda m: m.update([1], [[-1, 0]], R), "range that is not positive"),
        (lambda m: m.update([1], [[1, 0]], -R), "R must be a covariance"),
        (lambda m: m.update([1], [[1, 0]], [[1, 0.5], [0, 1]]), "R must be a covariance"),
        (lambda m: m.update([1], [[1, 0]], np.eye(3)), "R has shape (3, 3)"),
        (lambda m: m.add([1], [[1, 0]], R), "[1] are in the map already"),
        (lambda m: m.add([8, 8], [[1, 0], [1, 0]], R), "[8] occur more than once"),
        (lambda m: m.remove([9]), "[9] are not in the map"),
        (lambda m: m.predict([0, 0], Q), "x has shape (2,)"),
        (lambda m: m.predict([0, 0, np.inf], Q), "x contains NaN or infinity"),
        (lambda m: m.predict([0, 0, 0], -Q), "Q has a negative eigenvalue"),
        (lambda m: m.predict([0, 0, 0], np.triu(np.ones((3, 3)))), "Q is not symmetric"),
    ],
)
def test_bad_input_is_named_and_changes_nothing(call, message):
    mak = filled(np.random.default_rng(10))
    assert message in unchanged(mak, lambda: call(mak))


def test_an_impossible_start_is_refused():
    with pytest.raises(ValueError, match="P has a negative eigenvalue"):
        MAK([0, 0, 0], np.diag([1, 1, -1]))
