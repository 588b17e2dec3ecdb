"""Faulty EKF-SLAM filters of lesson 06: the right ones are consistent, each fault is visible."""

import numpy as np
import pytest

from course.studies import ekf_slam_faults
from course.studies.ekf_slam_faults import EXACT, MeanOnlyUpdate, PriorMeanLost
from slamlab.estimators import run
from slamlab.estimators.ekf_slam import EkfSlam
from slamlab.filters import MAK
from slamlab.sources.landmark_runs import LandmarkRun, Loop


@pytest.fixture(scope="module")
def runs():
    return [LandmarkRun(Loop(steps=95), np.random.default_rng(seed)) for seed in range(10)]


@pytest.fixture(scope="module")
def right(runs):
    return ekf_slam_faults.final_errors(runs)


def test_driving_a_filter_is_what_the_estimator_does(runs):
    poses, P = ekf_slam_faults.run_filter(runs[0], MAK(np.zeros(3), EXACT))
    slam = EkfSlam(runs[0].robot, runs[0].sensor)
    assert np.allclose(poses, run(runs[0], slam).trajectory.poses, atol=1e-9)
    assert np.allclose(P[-1], slam.filter.block([0, 1, 2]), atol=1e-12)


def test_the_filter_claims_about_the_error_it_makes(right):
    assert 0.5 < right.claimed / right.robot < 2
    assert right.nees < 6


def test_without_the_update_of_P_the_filter_claims_far_too_little(runs, right):
    never = ekf_slam_faults.final_errors(runs, MeanOnlyUpdate)
    assert never.nees < 1
    assert never.claimed > 3 * never.robot
    assert never.landmarks > right.landmarks


def test_the_update_that_forgets_x_loses_robot_and_map(runs, right):
    forgetful = ekf_slam_faults.final_errors(runs, PriorMeanLost)
    assert min(forgetful.robot, forgetful.landmarks) > 1 > 10 * forgetful.claimed


def test_placing_before_predicting_is_overconfident(runs, right):
    wrong = ekf_slam_faults.final_errors(runs, landmarks_first=True)
    assert wrong.nees > 2 * right.nees
    assert wrong.landmarks > 1.5 * right.landmarks


def test_uncertainty_of_the_start_turns_the_map_and_leaves_its_shape(runs):
    maps = []
    for P in (EXACT, np.diag([0.1, 0.1, 0.1]) ** 2):
        filter = MAK(np.zeros(3), P)
        ekf_slam_faults.run_filter(runs[0], filter)
        maps.append(filter.landmarks())
    apart = [np.hypot(*(each[:, None] - each).T) for each in maps]
    moved = np.hypot(*(maps[0] - maps[1]).T).max()
    assert np.abs(apart[0] - apart[1]).max() < moved / 3
