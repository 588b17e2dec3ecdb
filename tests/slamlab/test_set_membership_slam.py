"""Set-membership SLAM (BOR) as an estimator: bounds of so many sigmas, boxes, when it is lost."""

from dataclasses import replace

import numpy as np
import pytest

from slamlab import estimators
from slamlab.estimators.ekf_slam import predict
from slamlab.estimators.runner import run
from slamlab.estimators.set_membership_slam import BOUNDS, SetMembershipSlam, bounds
from slamlab.evaluation import inside, outside
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.set_membership.angle_intervals import contains
from slamlab.layers import Boxes, Points, Poses
from slamlab.models.noise import C_wheels
from slamlab.models.parameters import RobotModel
from slamlab.readings import Observations, Reading
from slamlab.simulation.differential_drive import arc
from slamlab.sources.arena_runs import ArenaRun
from slamlab.sources.landmark_runs import LandmarkRun, Loop

CALM = Loop(steps=80, v_sigma=0.004, omega_sigma=0.002, range_sigma=0.02, bearing_sigma=0.005)


@pytest.mark.parametrize("seed", range(3))
def test_with_bounds_that_no_noise_leaves_the_truth_is_in_its_boxes_at_every_step(seed):
    source = LandmarkRun(CALM, np.random.default_rng(seed))
    slam = SetMembershipSlam(source.robot, source.sensor, sigmas=5.5)
    for reading, pose in zip(source, source.truth.poses, strict=True):
        slam.step(reading)
        assert outside(slam.filter, pose, source.landmarks) == []
    assert slam.lost == ""
    assert set(slam.filter.ids) == set(np.concatenate([r.observations.ids for r in source]))


def test_bounds_far_too_narrow_are_broken_and_the_status_states_since_when_and_what_to_do():
    source = LandmarkRun(CALM, np.random.default_rng(1))
    slam = run(source, SetMembershipSlam(source.robot, source.sensor, sigmas=0.3)).estimator
    assert slam.contradictions > 0
    assert slam.lost in slam.status
    assert "lost at" in slam.lost and "Widen the bounds" in slam.lost
    assert np.isfinite(slam.pose).all()


def test_a_map_known_beforehand_is_used():
    source = LandmarkRun(CALM, np.random.default_rng(2))
    known = {i: (x, x, y, y) for i, (x, y) in enumerate(source.landmarks)}
    slam = SetMembershipSlam(source.robot, source.sensor, sigmas=5.5, boxes=known)
    run(source, slam)
    assert slam.filter.ids == list(known)
    assert outside(slam.filter, source.truth.poses[-1], source.landmarks) == []
    assert np.diff(slam.filter.robot)[::2].max() < 0.6


def test_without_ids_it_finds_out_itself_who_is_seen():
    source = LandmarkRun(CALM, np.random.default_rng(3))
    slam = SetMembershipSlam(source.robot, source.sensor)
    for reading in list(source)[:15]:
        seen = reading.observations
        nameless = Observations(seen.z, np.full(len(seen.ids), -1))
        slam.step(replace(reading, scan=None, observations=nameless))
    assert len(slam.filter) >= len(next(iter(source)).observations.ids)
    for box in slam.filter.boxes():
        assert any(inside(box, landmark) for landmark in source.landmarks)


def test_it_draws_the_landmarks_boxes_and_the_robots_and_the_track():
    source = LandmarkRun(CALM, np.random.default_rng(1))
    slam = run(source, estimators.make("bor", source)).estimator
    landmarks, around, track, robot = slam.layers()
    assert [type(a) for a in slam.layers()] == [Points, Boxes, Poses, Boxes]
    assert all(inside(box, middle) for box, middle in zip(around.rows, landmarks.xy, strict=True))
    assert len(track.rows) == len(source)
    assert inside(robot.rows[0], slam.pose)
    assert "landmarks" in slam.status


def test_a_bound_is_so_many_standard_deviations_of_the_arcs_length_and_turn():
    robot = RobotModel(distance_error=0.1, turn_error=0.2, turn_per_metre=0.0, slip=0.05, base=0.4)
    motion, C = arc(0.3, 0.5, 0.4), C_wheels((0.4, 0.5), 0.05, 0.4)
    d = np.hypot(*motion[:2])
    of_length, of_turn = bounds(motion, robot, 3)
    assert np.isclose(of_length, 3 * np.hypot(0.1 * d, np.sqrt(C[0, 0])), rtol=1e-2)
    assert np.isclose(of_turn, 3 * np.hypot(0.2 * 0.5, np.sqrt(C[1, 1])), rtol=1e-2)


def test_standing_still_changes_nothing():
    slam = SetMembershipSlam(RobotModel(), Loop().sensor)
    for time in range(5):
        slam.step(Reading(float(time)))
    np.testing.assert_array_equal(slam.filter.robot, 0)
    np.testing.assert_array_equal(slam.filter.heading, 0)


@pytest.mark.parametrize("sigmas", [0, -1, np.nan, np.inf])
def test_bounds_of_no_width_or_none_are_refused(sigmas):
    for name in ("sigmas", "motion_sigmas", "accumulated_sigmas"):
        with pytest.raises(ValueError, match=f"^{name} must be a number above 0"):
            SetMembershipSlam(RobotModel(), Loop().sensor, **{name: sigmas})


def test_a_known_map_has_its_own_landmark_ids():
    with pytest.raises(ValueError, match='use association="own"'):
        SetMembershipSlam(RobotModel(), Loop().sensor, boxes={0: (0, 0, 1, 1)}, association="ekf")


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4000, 4006))
def test_in_the_arena_the_guaranteed_box_holds_the_truth_and_is_never_wider_than_odometrys(seed):
    source = ArenaRun(np.random.default_rng(seed), laps=1)
    slam, alone = estimators.make("bor", source), MAK(np.zeros(3), np.zeros((3, 3)))
    most = BOUNDS["conservative"]["accumulated_sigmas"]
    for reading, pose in zip(source, source.truth.poses, strict=True):
        slam.step(reading)
        predict(alone, reading, source.robot)
        assert inside(slam.filter.robot, pose) and contains(slam.filter.heading, pose[2])
        sides = np.diff(slam.filter.robot)[::2]
        assert np.all(sides <= 2 * most * np.sqrt(np.diag(alone.P)[:2]) + 0.005)
    assert slam.lost == "" and len(slam.filter) > 8


def test_without_landmarks_the_whole_paths_bound_grows_like_a_root_and_the_steps_like_a_sum():
    robot, widths = RobotModel(distance_error=0, turn_error=0, turn_per_metre=0, slip=0.01), {}
    for name, accumulated_sigmas in (("steps", None), ("way", 3.0)):
        limits = {"sigmas": 3.0, "accumulated_sigmas": accumulated_sigmas}
        slam = SetMembershipSlam(robot, Loop().sensor, **limits)
        widths[name] = []
        for k in range(65):
            slam.step(Reading(float(k), np.array([0.01, 0.0, 0.0])))
            widths[name].append(np.diff(slam.filter.heading)[0])
    ratio = {name: each[63] / each[3] for name, each in widths.items()}
    assert ratio["steps"] == pytest.approx(16, rel=0.01)
    assert ratio["way"] == pytest.approx(4, rel=0.01)
