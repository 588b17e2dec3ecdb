"""Studies of lesson 07: origin of correlations, dropped correlations, unobservable directions."""

import numpy as np
import pytest

from course.studies import dropped_correlations, landmark_correlations, observability
from slamlab.evaluation import correlation
from slamlab.models import observation
from slamlab.sources.landmark_runs import LandmarkRun, Loop

ROUND = Loop(steps=90)


def test_blocks_are_filled_one_observation_after_the_other():
    (before, first, both), _ = landmark_correlations.two_observations(0.3, heading_sigma=0.1)
    robot, one, two = slice(0, 3), slice(3, 5), slice(5, 7)
    assert not before[robot, one].any() and not before[robot, two].any()
    assert first[robot, one].any() and not first[one, two].any() and not first[robot, two].any()
    assert both[one, two].any() and both[robot, two].any()
    assert np.allclose(first[two, two], before[two, two], atol=1e-12)


@pytest.mark.parametrize("motion_sigma", [0.0, 0.2, 0.9])
def test_in_a_corridor_the_correlation_equals_the_formula(motion_sigma):
    ahead = {"pose": np.zeros(3), "landmarks": np.array([[2.0, 0.0], [3.0, 0.0]])}
    stages, _ = landmark_correlations.two_observations(0.3, motion_sigma, prior_sigma=100, **ahead)
    R = landmark_correlations.R[0, 0]
    expected = 0.09 / np.sqrt((0.09 + R) * (0.09 + motion_sigma**2 + R))
    assert correlation(stages[2])[3, 5] == pytest.approx(expected, abs=1e-4)


def test_the_covariance_shows_a_map_that_moves_as_a_whole():
    landmarks = np.random.default_rng(1).uniform(-3, 3, (6, 2))
    motions = landmark_correlations.rigid_motions(landmarks)
    P = 0.04 * motions[:, :2] @ motions[:, :2].T
    assert landmark_correlations.rigid_share(P, landmarks) == pytest.approx((1, 0))
    about_middle = landmark_correlations.rigid_motions(landmarks - landmarks.mean(axis=0))[:, 2:]
    turned = landmark_correlations.rigid_share(about_middle @ about_middle.T, landmarks)
    assert turned == pytest.approx((0, 1))


def test_with_a_compass_a_landmarks_variance_converges_to_that_of_the_start():
    _, own, vector, _ = landmark_correlations.long_run(0.0, 0.2, laps=6)
    assert (own > 0.2).all() and own[-1] < 0.23
    assert vector[-1] < 0.3 * own[-1]


def test_a_filter_that_keeps_all_is_the_usual_one_and_one_that_forgets_is_overconfident():
    all_kept, none = (dropped_correlations.laps(ROUND, share, 5) for share in (1.0, 0.0))
    mean = [np.mean([lap.nees for lap in each]) for each in (all_kept, none)]
    assert mean[0] < 6 < 30 < mean[1]
    assert np.mean([lap.inside for lap in none]) < 0.5 < np.mean([lap.inside for lap in all_kept])


def test_a_share_of_every_correlation_is_kept_and_all_of_every_variance():
    z = observation.h(np.zeros(3), np.array([[1.0, 0.5], [2.0, -0.3]]))
    kept = {}
    for share in (0.25, 1.0):
        mak = dropped_correlations.DroppedCorrelations(share)
        mak.predict(np.zeros(3), np.diag([0.1, 0.1, 0.05]) ** 2)
        mak.add([1, 2], z, np.diag([0.1, 0.03]) ** 2)
        kept[share] = mak.P
    blocks = np.arange(7) < 3, np.isin(np.arange(7), (3, 4)), np.isin(np.arange(7), (5, 6))
    for a, row in enumerate(blocks):
        for b, column in enumerate(blocks):
            factor = 1 if a == b else 0.25
            at = np.ix_(row, column)
            assert np.allclose(kept[0.25][at], factor * kept[1.0][at])


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_no_landmark_becomes_less_certain_whatever_the_filter_forgets(share):
    run, sizes = LandmarkRun(Loop(landmarks=5, steps=40), np.random.default_rng(3)), {}
    mak, R = dropped_correlations.DroppedCorrelations(share), np.diag([0.1, 0.03]) ** 2
    for reading, true in zip(run, run.truth.poses, strict=True):
        mak.predict(true, np.diag([0.02, 0.02, 0.01]) ** 2)
        for id, z in zip(reading.observations.ids.tolist(), reading.observations.z, strict=True):
            (mak.update if id in mak.ids else mak.add)([id], [z], R)
        for id, P in zip(mak.ids, mak.blocks()[2], strict=True):
            assert np.linalg.det(P) <= sizes.get(id, np.inf) * (1 + 1e-9)
            sizes[id] = np.linalg.det(P)
    assert len(sizes) > 2


def test_no_observation_distinguishes_a_moved_and_turned_scene_from_the_scene():
    run = LandmarkRun(Loop(landmarks=3), np.random.default_rng(2))
    state = np.concatenate([[0.4, -0.2, 0.7], run.landmarks.ravel()])

    def seen(state):
        return observation.h(state[:3], state[3:].reshape(-1, 2))

    for direction in observability.rigid_scene_motions(state).T:
        displaced = [seen(state + step * direction) for step in (1e-6, -1e-6)]
        assert np.abs(displaced[0] - displaced[1]).max() < 1e-10


@pytest.mark.parametrize("seed", range(2))
def test_standard_jacobians_learn_a_turn_and_first_estimates_do_not(seed):
    ranks = {}
    for first_estimates in (False, True):
        stack, state = observability.observability_matrix(first_estimates, seed=seed)
        ranks[first_estimates] = np.linalg.matrix_rank(stack)
        shifts = observability.rigid_scene_motions(state)[:, :2]
        assert np.abs(stack @ shifts).max() < 1e-9
    assert ranks == {False: 7, True: 6}
    exact, _ = observability.observability_matrix(False, noise=0.0, seed=seed)
    assert np.linalg.matrix_rank(exact) == 6
