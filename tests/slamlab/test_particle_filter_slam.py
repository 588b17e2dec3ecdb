"""Particle-filter SLAM beats odometry: with known data association, without it, on scans."""

from dataclasses import replace

import numpy as np
import pytest

from slamlab import estimators
from slamlab.estimators.particle_filter_slam import montecarlo
from slamlab.estimators.runner import run
from slamlab.evaluation import absolute_error
from slamlab.layers import Ellipses, Particles, Points, Poses
from slamlab.readings import Observations, Reading
from slamlab.sources.landmark_runs import LandmarkRun, Loop
from tests.slamlab.support import Given

NAMES = ["montecarlo", "fastslam"]


def nameless():
    """A landmark run that keeps the names to itself."""
    run = LandmarkRun(Loop(steps=150, landmarks=8), np.random.default_rng(1))
    readings = []
    for reading in run:
        z = reading.observations.z
        readings.append(replace(reading, observations=Observations(z, np.full(len(z), -1))))
    return Given(readings, run, truth=run.truth)


def ratio(name, source, **options):
    """Error by odometry alone over the estimator's, and the estimator."""
    result = run(source, estimators.make(name, source, **options))
    found, naive = (absolute_error(t, source.truth) for t in (result.trajectory, result.naive))
    return naive.translation / found.translation, result.estimator


@pytest.mark.parametrize("name", NAMES)
def test_without_ids_data_association_uses_each_particles_own_covariance(name):
    better, slam = ratio(name, nameless(), association="own")
    assert better > 1.5
    # sets believe more than they know, and take some of the eight for new ones in the second lap
    assert 6 <= len(slam.filter.ids) <= (12 if name == "fastslam" else 20)
    assert max(slam.filter.ids) < 0


@pytest.mark.parametrize("name", NAMES)
def test_named_by_an_ekf_slam_beside_there_are_as_many_landmarks_as_there_are(name):
    better, slam = ratio(name, nameless())
    assert better > 1.5 and len(slam.filter.ids) == 8 and slam.association.ambiguous == 0


def test_the_same_seed_gives_the_same_run_and_another_one_another():
    source = LandmarkRun(Loop(steps=20), np.random.default_rng(1))
    poses = [run(source, montecarlo(source, seed)).trajectory.poses for seed in (0, 0, 1)]
    np.testing.assert_array_equal(poses[0], poses[1])
    assert not np.array_equal(poses[0], poses[2])


def test_it_draws_particles_with_weights_that_sum_to_one():
    source = LandmarkRun(Loop(steps=30), np.random.default_rng(1))
    options = {"particles": 100, "landmark_particles": 30, "freeze_distance": 0.3}
    slam = run(source, montecarlo(source, **options)).estimator
    loose, frozen, track, robot = slam.layers()
    assert [type(a) for a in slam.layers()] == [Particles, Points, Poses, Particles]
    assert len(robot.rows) == 100
    assert len(frozen.xy) == len(slam.filter.frozen)
    assert len(loose.rows) == 30 * (len(slam.filter.ids) - len(frozen.xy))
    for layer in (loose, robot):
        assert np.isclose(layer.weights.sum(), 1) or not len(layer.weights)
    assert len(track.rows) == len(source)


def test_fastslam_draws_an_ellipse_for_each_landmark():
    source = LandmarkRun(Loop(steps=30), np.random.default_rng(1))
    points, ellipses, _, robot = ratio("fastslam", source)[1].layers()
    assert [type(a) for a in (points, ellipses, robot)] == [Points, Ellipses, Particles]
    assert len(points.xy) == len(ellipses.covariances) > 3


@pytest.mark.parametrize("name", NAMES)
def test_a_name_seen_twice_in_a_reading_counts_once(name):
    source = LandmarkRun(Loop(steps=2), np.random.default_rng(1))
    slam = estimators.make(name, source)
    for _ in range(2):
        twice = Observations(np.array([[2.0, 0.1], [2.1, 0.1]]), np.array([4, 4]))
        slam.step(Reading(0.0, np.zeros(3), observations=twice))
    assert slam.filter.ids == [4]
    assert slam.ambiguous == 2
