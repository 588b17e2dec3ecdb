"""The thesis' sets and FastSLAM: limits where they are other filters, and what they promise."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab import models
from slamlab.estimators.ekf_slam import Q_arc
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.known_pose_mapping import KnownPoseMap
from slamlab.filters.particle_filters.fastslam import FastSLAM
from slamlab.filters.particle_filters.independent_particle_sets import IndependentParticleSets
from slamlab.filters.particle_filters.particle_association import ExpectedScan, associate
from slamlab.geometry import compose
from slamlab.models.parameters import RobotModel
from slamlab.simulation.differential_drive import arc

R = np.array([[0.01, 0.0005], [0.0005, 0.001]])
STILL = RobotModel(distance_error=0, turn_error=0, turn_per_metre=0)
ROBOT = RobotModel(distance_error=0.05, turn_error=0.05, turn_per_metre=0.05)
OBJECTS = np.array([[2.0, 1.0], [-1.0, 2.5], [1.0, -3.0]])
MAKERS = {"sets": IndependentParticleSets, "fastslam": FastSLAM}


def drive(filter, steps, rng, robot=ROBOT, ids=(0, 1, 2)):
    """A run with every landmark visible; the true last pose."""
    truth = np.zeros(3)
    for k in range(steps):
        odometry = arc(0.15, 0.25, 0.4)
        truth = compose(truth, odometry)
        z = models.h(truth, OBJECTS[list(ids)]) + rng.multivariate_normal([0, 0], R, len(ids))
        filter.predict(odometry, robot)
        (filter.update if k else filter.add)(ids, z, R)
    return truth


@given(st.integers(0, 2**32))
@settings(max_examples=20, deadline=None)
def test_one_particle_without_motion_noise_equals_mapping_with_known_poses(seed):
    rng = np.random.default_rng(seed)
    fast, little, pose = FastSLAM(rng, 1), KnownPoseMap(), np.zeros(3)
    for k in range(6):
        odometry = arc(*rng.uniform(-0.3, 0.5, 2), 0.4)
        pose = compose(pose, odometry)
        z = models.h(pose, OBJECTS) + rng.multivariate_normal([0, 0], R, 3)
        fast.predict(odometry, STILL)
        (fast.update if k else fast.add)(range(3), z, R)
        for i in range(3):
            little.update(pose, i, z[i], R)
    np.testing.assert_allclose(fast.landmarks(), little.points(), atol=1e-9)
    for i, P in enumerate(fast.covariances()):
        np.testing.assert_allclose(P, little.landmarks[i].P, atol=1e-9)


def test_with_many_particles_fastslam_equals_the_augmented_filter():
    """Noise so small that the EKF is all but exact; bounds are six errors of the cloud's size."""
    rng = np.random.default_rng(1)
    small = RobotModel(distance_error=0.02, turn_error=0.02, turn_per_metre=0.02)
    fast, mak = FastSLAM(rng, 20_000), MAK(np.zeros(3), np.zeros((3, 3)))
    for k in range(5):
        odometry = arc(0.15, 0.25, 0.4)
        fast.predict(odometry, small)
        mak.predict(compose(mak.pose, odometry), Q_arc(mak.pose, odometry, small))
        z = models.h(mak.pose, OBJECTS) + 0.02 * rng.standard_normal((3, 2))
        for filter in (fast, mak):
            (filter.update if k else filter.add)(range(3), z, R)
    few = np.sqrt(fast.robot.effective_sample_size)
    sigmas = np.sqrt(np.diag(mak.P))
    assert (np.abs(fast.robot.moments.x - mak.pose) < 6 * sigmas[:3] / few).all()
    assert (np.abs(fast.landmarks().ravel() - mak.x[3:]) < 6 * sigmas[3:] / few).all()
    for i, P in enumerate(fast.covariances()):
        own = slice(3 + 2 * i, 5 + 2 * i)
        scale = np.outer(sigmas[own], sigmas[own])
        assert (np.abs(P - mak.P[own, own]) / scale < 6 * np.sqrt(2) / few + 0.02).all()


def test_with_a_certain_pose_particle_sets_map_as_independent_ekfs_do():
    """No motion noise: no correlations to lose, so the set is the Kalman filter's Gaussian."""
    rng, little = np.random.default_rng(2), KnownPoseMap()
    sets = IndependentParticleSets(rng, particles=10, landmark_particles=4000, freeze_distance=0)
    poses = [np.zeros(3)]
    for k in range(4):
        z = models.h(poses[-1], OBJECTS[:1]) + rng.multivariate_normal([0, 0], R, 1)
        (sets.update if k else sets.add)([0], z, R)
        little.update(poses[-1], 0, z[0], R)
        poses.append(compose(poses[-1], arc(0.3, 0.4, 0.4)))
        sets.predict(arc(0.3, 0.4, 0.4), STILL)
    exact, found = little.landmarks[0], sets.landmark_sets[0].moments
    sigmas, few = np.sqrt(np.diag(exact.P)), np.sqrt(1000)
    assert (np.abs(found.x - exact.x) < 6 * sigmas / few).all()
    assert (np.abs(found.P - exact.P) / np.outer(sigmas, sigmas) < 6 * np.sqrt(2) / few).all()


@pytest.mark.parametrize("name", MAKERS)
def test_it_localises_the_robot_and_the_landmarks(name):
    for seed in range(2):
        rng = np.random.default_rng(seed)
        filter = MAKERS[name](rng)
        truth = drive(filter, 40, rng)
        assert np.hypot(*(filter.robot.moments.x - truth)[:2]) < 0.4
        assert np.hypot(*(filter.landmarks() - OBJECTS).T).max() < 0.4


def test_frozen_landmarks_never_move_and_are_used_nonetheless():
    rng = np.random.default_rng(3)
    sets = IndependentParticleSets(rng, freeze_distance=0.4)
    drive(sets, 30, rng)
    assert sets.frozen == {0, 1, 2}
    places = sets.landmarks()
    before = sets.robot
    z = models.h(before.moments.x, OBJECTS)
    sets.update(range(3), z, R)
    np.testing.assert_array_equal(sets.landmarks(), places)
    assert sets.robot is not before


def test_a_set_that_is_not_seen_is_left_alone():
    rng = np.random.default_rng(5)
    sets = IndependentParticleSets(rng, freeze_distance=0)
    drive(sets, 1, rng)
    unseen = sets.landmark_sets[2]
    for _ in range(10):
        sets.predict(arc(0.1, 0.1, 0.4), ROBOT)
        sets.update([0, 1], models.h(sets.robot.moments.x, OBJECTS[:2]), R)
    assert sets.landmark_sets[2] is unseen


@pytest.mark.parametrize("name", MAKERS)
def test_improbable_observations_leave_finite_particles(name):
    rng = np.random.default_rng(7)
    filter = MAKERS[name](rng)
    drive(filter, 3, rng)
    filter.update([0, 1], [[500.0, 3.0], [0.1, -3.0]], R * 1e-6)
    assert np.isfinite(filter.robot.rows).all()
    assert np.isfinite(filter.landmarks()).all()
    assert np.isclose(filter.robot.weights.sum(), 1)


@pytest.mark.parametrize("name", MAKERS)
@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda f: f.predict([0, 0], ROBOT), "odometry has shape"),
        (lambda f: f.update([5], [[1, 0]], R), r"\[5\] are not in the map"),
        (lambda f: f.add([0], [[1, 0]], R), r"\[0\] are in the map already"),
        (lambda f: f.add([6, 6], [[1, 0], [1, 0]], R), "twice"),
        (lambda f: f.update([0, 0], [[1, 0], [1, 0]], R), "twice"),
        (lambda f: f.update([0], [[1, 0]], R * 0), "R is singular"),
        (lambda f: f.add([6], [[1, np.nan]], R), "z or R contains NaN"),
        (lambda f: type(f)(f.rng, 0), "at least 1"),
    ],
)
def test_bad_input_is_named_and_changes_nothing(name, call, message):
    rng = np.random.default_rng(9)
    filter = MAKERS[name](rng)
    drive(filter, 2, rng)
    robot, landmarks = filter.robot, filter.landmarks()
    with pytest.raises(ValueError, match=message):
        call(filter)
    assert filter.robot is robot
    np.testing.assert_array_equal(filter.landmarks(), landmarks)


def test_the_nearest_pair_comes_first_and_ambiguous_ones_are_ignored():
    seen = ExpectedScan(np.array([[2.0, 0.0], [2.0, 3.1]]), np.zeros((2, 2, 2)))
    far = np.array([[2.05, 0.0], [2.01, 0.0], [2.0, -3.1], [9.0, 1.0], [2.38, 0.0]])
    pairs, new = associate(far, np.tile(np.diag([0.01, 0.01]), (5, 1, 1)), seen)
    # row 0 lost its object to the nearer row 1; row 4 is four sigmas off
    assert pairs == {1: 0, 2: 1}
    assert new == [3]


def test_where_nothing_is_known_everything_is_new():
    seen = ExpectedScan(np.empty((0, 2)), np.empty((0, 2, 2)))
    assert associate(np.ones((2, 2)), np.tile(R, (2, 1, 1)), seen) == ({}, [0, 1])


@pytest.mark.parametrize("name", MAKERS)
def test_a_filter_predicts_landmarks_at_their_positions(name):
    rng = np.random.default_rng(10)
    filter = MAKERS[name](rng)
    truth = drive(filter, 10, rng)
    expected = filter.expected_scan()
    v = models.h(truth, OBJECTS) - expected.z
    assert np.abs(v).max() < 0.3
    assert np.linalg.eigvalsh(expected.S).min() > 0
