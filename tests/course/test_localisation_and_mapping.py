"""Runs of lesson 05: localisation, mapping, and overconfidence of alternating filters."""

import numpy as np
import pytest

from course.studies import alternating_filters, pose_posterior_samples
from course.studies.localisation_and_mapping import (
    landmark_nees,
    localised_laps,
    locate,
    mean_nees,
    odometry_poses,
)
from slamlab.evaluation import band
from slamlab.filters import Belief
from slamlab.models import observation
from slamlab.sources.landmark_runs import LandmarkRun, Loop

LAP = Loop(landmarks=8, v=0.6, steps=42, range_max=2.0, v_sigma=0.03, omega_sigma=0.015)
P_START = np.diag([0.2, 0.2, 0.1]) ** 2
EXACT = Belief(np.zeros(3), np.zeros((3, 3)))


@pytest.fixture(scope="module")
def runs():
    return [LandmarkRun(LAP, np.random.default_rng(seed)) for seed in range(8)]


def test_without_a_map_localisation_is_dead_reckoning(runs):
    poses, P = locate(runs[0], {}, Belief(np.zeros(3), P_START))
    assert np.allclose(poses, odometry_poses(runs[0]), atol=1e-12)
    # a determinant: the ellipse of the place may shrink on the way home
    assert (np.diff(np.linalg.det(P)) >= 0).all()


def test_a_landmark_outside_the_map_is_not_used(runs):
    whole = dict(enumerate(runs[0].landmarks))
    part = {id: whole[id] for id in (1, 4)}
    with_others_far_away = LandmarkRun(LAP, np.random.default_rng(0))
    with_others_far_away.landmarks = runs[0].landmarks.copy()
    first, second = (locate(run, part, EXACT)[0] for run in (runs[0], with_others_far_away))
    assert np.array_equal(first, second)
    assert not np.allclose(first, locate(runs[0], whole, EXACT)[0])


def test_in_a_known_map_nees_is_in_its_band_and_in_a_wrong_one_far_above():
    low, high = band(3 * 43, 30, 0.999999)  # wide: the steps of a run hang together
    exact, wrong = (mean_nees(localised_laps(LAP, P_START, off, 30)) for off in (0.0, 0.3))
    assert 0.7 * low < exact.sum() < 1.4 * high
    assert wrong.mean() > 10 * exact.mean()


def test_a_map_from_the_wheels_poses_misses_and_does_not_know_it(runs):
    known = np.mean([landmark_nees(run, run.truth.poses) for run in runs])
    trusted = np.mean([landmark_nees(run, odometry_poses(run)) for run in runs])
    assert known < 4 < 40 < trusted


def test_taking_turns_is_overconfident_with_care_and_without_and_one_filter_is_not(runs):
    def mean(scheme):
        return mean_nees([(run, *scheme(run)) for run in runs], begin=3).mean()

    assert mean(alternating_filters.together) < 6
    for careful in (False, True):
        assert mean(lambda run, careful=careful: alternating_filters.alternate(run, careful)) > 10


def test_taking_turns_changes_no_belief_before_something_is_seen_again():
    once = LandmarkRun(Loop(landmarks=1, steps=3, range_max=50), np.random.default_rng(1))
    (pretending, _), (careful, _) = (alternating_filters.alternate(once, c) for c in (False, True))
    assert np.array_equal(pretending[0], careful[0])
    assert not np.allclose(pretending[-1], careful[-1])


@pytest.mark.parametrize("count", [1, 2, 3])
def test_poses_that_agree_see_the_landmarks_where_they_were_seen(count):
    landmarks = np.array([[1.7, 1.0], [0.4, -1.6], [-1.5, 0.8]])[:count]
    x, R = np.array([0.2, -0.1, 0.3]), np.diag([0.1, 0.03]) ** 2
    z = observation.h(x, landmarks)
    rng = np.random.default_rng(2)
    poses = pose_posterior_samples.sample_posterior(landmarks, z, 0.3, 0.8, R, rng, 4000)
    seen = observation.h(poses[:, None], landmarks)
    assert np.abs(seen[..., 0] - z[:, 0]).max() < 0.6
    assert len(poses) == 4000 if count == 1 else 10 < len(poses) < 2000


def test_an_ellipse_holds_95_in_100_of_the_poses_that_it_is_the_covariance_of():
    P, rng = np.diag([0.3, 0.1, 0.2]) ** 2, np.random.default_rng(3)
    b = Belief(np.array([1.0, 2.0, 0.5]), P)
    poses = rng.multivariate_normal(b.x, P, 20_000)
    assert abs(pose_posterior_samples.share_in_ellipse(b, poses) - 0.95) < 0.01
