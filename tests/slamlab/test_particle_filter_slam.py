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
from slamlab.sources import simulation
from slamlab.sources.base import Source
from slamlab.sources.landmark_runs import LandmarkRun, Loop

NAMES = ["montecarlo", "fastslam"]


class Nameless(Source):
    """A landmark run that keeps the names to itself."""

    name = "nameless"

    def __init__(self, run):
        super().__init__()
        self.run, self.robot, self.sensor, self.truth = run, run.robot, run.sensor, run.truth

    def __iter__(self):
        for reading in self.run:
            z = reading.observations.z
            yield replace(reading, observations=Observations(z, np.full(len(z), -1)))


def ratio(name, source, **options):
    """Error by odometry alone over the estimator's, and the estimator."""
    result = run(source, estimators.make(name, source, **options))
    found, naive = (absolute_error(t, source.truth) for t in (result.trajectory, result.naive))
    return naive.translation / found.translation, result.estimator


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_it_beats_dead_reckoning_on_a_loop_and_finds_every_landmark_it_saw(name):
    source = simulation("landmarks", np.random.default_rng(2))
    better, slam = ratio(name, source)
    assert better > 2
    seen = set(np.concatenate([reading.observations.ids for reading in source]).tolist())
    assert set(slam.filter.ids) == seen


@pytest.mark.parametrize("name", NAMES)
def test_without_ids_data_association_uses_each_particles_own_covariance(name):
    source = Nameless(LandmarkRun(Loop(steps=150, landmarks=8), np.random.default_rng(1)))
    better, slam = ratio(name, source, association="own")
    assert better > 1.5
    # sets believe more than they know, and take some of the eight for new ones in the second lap
    assert 6 <= len(slam.filter.ids) <= (12 if name == "fastslam" else 20)
    assert max(slam.filter.ids) < 0


@pytest.mark.parametrize("name", NAMES)
def test_named_by_an_ekf_slam_beside_there_are_as_many_landmarks_as_there_are(name):
    source = Nameless(LandmarkRun(Loop(steps=150, landmarks=8), np.random.default_rng(1)))
    better, slam = ratio(name, source)
    assert better > 1.5 and len(slam.filter.ids) == 8 and slam.association.ambiguous == 0


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_it_takes_the_corners_of_scans(name):
    better, slam = ratio(name, simulation("situation-2", np.random.default_rng(1)))
    assert better > 3
    assert "landmarks" in slam.status


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
def test_before_any_observation_there_are_particles_of_the_robot_only(name):
    source = LandmarkRun(Loop(steps=2), np.random.default_rng(1))
    slam = estimators.make(name, source)
    slam.step(Reading(0.0, np.array([0.1, 0.0, 0.0])))
    assert len(slam.layers()) == 4
    assert slam.filter.ids == []
    assert abs(slam.pose[0] - 0.1) < 0.05


@pytest.mark.parametrize("name", NAMES)
def test_a_name_seen_twice_in_a_reading_counts_once(name):
    source = LandmarkRun(Loop(steps=2), np.random.default_rng(1))
    slam = estimators.make(name, source)
    for _ in range(2):
        twice = Observations(np.array([[2.0, 0.1], [2.1, 0.1]]), np.array([4, 4]))
        slam.step(Reading(0.0, np.zeros(3), observations=twice))
    assert slam.filter.ids == [4]
    assert slam.ambiguous == 2
