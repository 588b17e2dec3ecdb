"""EKF-SLAM (MAK) as an estimator: it beats odometry, is consistent, draws what it has."""

from dataclasses import replace

import numpy as np
import pytest

from slamlab import estimators
from slamlab.estimators.ekf_slam import EkfSlam, Q_arc
from slamlab.estimators.runner import run
from slamlab.evaluation import absolute_error, band, nees
from slamlab.geometry import compose, wrap
from slamlab.layers import Ellipses, Points, Poses
from slamlab.models.parameters import RobotModel
from slamlab.readings import Observations, Reading
from slamlab.sources import simulation
from slamlab.sources.arena_runs import ArenaRun
from slamlab.sources.landmark_runs import LandmarkRun, Loop
from tests.slamlab.support import Given

BRIEF = Loop(steps=60, landmarks=12)


def after(source, name="mak"):
    return run(source, estimators.make(name, source))


def pose_nees(seed, name):
    """NEES of the last pose, and of the whole map."""
    source = LandmarkRun(BRIEF, np.random.default_rng(seed))
    slam = after(source, name).estimator
    error = slam.pose - source.truth.poses[-1]
    error[2] = wrap(error[2])
    off = slam.filter.landmarks() - source.landmarks[slam.filter.ids]
    P = slam.filter.P
    return nees(error, P[:3, :3]), nees(off.ravel(), P[3:, 3:]) / off.size


@pytest.mark.parametrize("name", ["mak", "mak-first-estimates"])
def test_it_beats_dead_reckoning_on_a_loop_and_finds_every_landmark_it_saw(name):
    source = simulation("landmarks", np.random.default_rng(2))
    result = after(source, name)
    mak, naive = (absolute_error(t, source.truth) for t in (result.trajectory, result.naive))
    assert mak.translation < naive.translation / 2
    seen = set(np.concatenate([reading.observations.ids for reading in source]).tolist())
    assert set(result.estimator.filter.ids) == seen
    off = result.estimator.filter.landmarks() - source.landmarks[result.estimator.filter.ids]
    assert np.hypot(*off.T).max() < 0.5


@pytest.mark.slow
@pytest.mark.parametrize("name", ["mak", "mak-first-estimates"])
def test_over_a_short_run_its_nees_lies_in_its_chi_squared_interval(name):
    runs = 50
    pose, landmarks = np.mean([pose_nees(seed, name) for seed in range(runs)], axis=0)
    low, high = band(3, runs, 0.9999)
    assert low < pose < high
    # the maps differ in size; a component each, so the spread is at most that of one landmark
    low, high = band(2, runs, 0.9999)
    assert low / 2 < landmarks < high / 2


def test_turning_on_the_spot_changes_no_position():
    Q = Q_arc(np.array([0.0, 0.0, 0.4]), np.array([0.0, 0.0, 0.3]), RobotModel())
    assert np.count_nonzero(Q) == 1
    assert Q[2, 2] > 0


def test_it_draws_landmarks_an_ellipse_for_each_and_for_the_robot_and_the_track():
    source = LandmarkRun(BRIEF, np.random.default_rng(1))
    slam = after(source).estimator
    landmarks, around, track, robot = slam.layers()
    assert [type(a) for a in slam.layers()] == [Points, Ellipses, Poses, Ellipses]
    np.testing.assert_array_equal(landmarks.xy, around.centres)
    assert len(track.rows) == len(source)
    np.testing.assert_array_equal(robot.centres, [slam.pose[:2]])
    for P in (*around.covariances, *robot.covariances):
        assert np.linalg.eigvalsh(P).min() > 0


def without_names(reading):
    seen = reading.observations
    return replace(reading, observations=Observations(seen.z, np.full(len(seen.ids), -1)))


def test_without_names_data_association_gives_the_same_map_where_landmarks_stand_apart():
    precise = replace(BRIEF, landmarks=8, range_sigma=0.01, omega_sigma=0.002)
    source = LandmarkRun(precise, np.random.default_rng(1))
    named = after(source).estimator
    slam = EkfSlam(source.robot, source.sensor)
    for reading in source:
        slam.step(without_names(reading))
    assert slam.association.ambiguous == 0
    assert all(i < 0 for i in slam.filter.ids)
    np.testing.assert_allclose(slam.filter.x, named.filter.x, atol=1e-12)


def test_an_ambiguous_observation_is_ignored_and_counted():
    slam = EkfSlam(RobotModel(), replace(Loop().sensor, range_sigma=0.1, bearing_sigma=0.01))
    see = [Observations(np.array([[r, 0.5]]), np.array([-1])) for r in (2.0, 2.7, 4.0)]
    for k, observations in enumerate(see):  # 0, 5 and 14 standard deviations off
        slam.step(Reading(float(k), observations=observations))
    assert len(slam.filter.ids) == 2 and slam.association.ambiguous == 1
    assert "2 landmarks, 1 ambiguous observation" in slam.status


def test_two_observations_of_one_reading_are_never_one_landmark():
    slam = EkfSlam(RobotModel(), Loop().sensor)
    for k, z in enumerate(([[2.0, 0.5]], [[2.0, 0.5], [2.01, 0.5]])):
        slam.step(Reading(float(k), observations=Observations(np.array(z), np.full(len(z), -1))))
    assert len(slam.filter.ids) == 1 and slam.association.ambiguous == 1


def steps_apart(smoothing, seed):
    """How much the shown pose jumps beyond the odometry [m], and how wrong it is [m], root mean."""
    source = LandmarkRun(Loop(steps=200), np.random.default_rng(seed))
    slam = EkfSlam(source.robot, source.sensor, smoothing=smoothing)
    shown = run(source, slam).trajectory.poses
    moved = [compose(a, r.odometry) for a, r in zip(shown, list(source)[1:], strict=False)]
    jumps = (shown[1:] - np.array(moved))[:, :2]
    return jumps.std(), np.sqrt(np.mean((shown - source.truth.poses)[:, :2] ** 2)), slam


@pytest.mark.slow
def test_smoothing_makes_the_shown_pose_calmer_and_wrong_and_leaves_the_filter_alone():
    calm, plain = (
        np.array([steps_apart(smoothing, seed)[:2] for seed in range(8)]).mean(axis=0)
        for smoothing in (0.95, 0.0)
    )
    assert calm[0] < plain[0] / 3
    assert calm[1] > plain[1] * 1.1
    filters = [steps_apart(smoothing, 3)[2].filter for smoothing in (0.95, 0.0)]
    np.testing.assert_array_equal(filters[0].x, filters[1].x)


def test_smoothed_landmarks_follow_the_recursion_and_leave_the_filter_alone():
    source, keep = LandmarkRun(Loop(steps=60), np.random.default_rng(3)), 0.8
    calm, plain = (
        EkfSlam(source.robot, source.sensor, landmark_smoothing=share) for share in (keep, 0.0)
    )
    expected = {}
    for reading in source:
        calm.step(reading)
        plain.step(reading)
        np.testing.assert_array_equal(calm.filter.x, plain.filter.x)
        np.testing.assert_array_equal(plain.landmarks(), plain.filter.landmarks())
        for i, p in zip(plain.filter.ids, plain.filter.landmarks(), strict=True):
            expected[i] = (1 - keep) * p + keep * expected.get(i, p)
        shown = [expected[i] for i in calm.filter.ids]
        np.testing.assert_allclose(calm.landmarks(), np.reshape(shown, (-1, 2)), atol=1e-12)
    np.testing.assert_array_equal(calm.layers()[0].xy, calm.landmarks())
    np.testing.assert_array_equal(calm.trajectory().poses, plain.trajectory().poses)
    assert np.abs(calm.landmarks() - plain.landmarks()).max() > 1e-3


@pytest.mark.parametrize("smoothing", [-0.1, 1.0, np.nan])
@pytest.mark.parametrize("which", ["smoothing", "landmark_smoothing"])
def test_a_smoothing_outside_its_range_is_refused(smoothing, which):
    with pytest.raises(ValueError, match="smoothing must be from 0"):
        EkfSlam(RobotModel(), Loop().sensor, **{which: smoothing})


@pytest.mark.parametrize("name", ["mak", "montecarlo", "fastslam", "bor"])
def test_a_source_with_neither_landmarks_nor_scans_is_refused_in_one_line(name):
    with pytest.raises(ValueError, match=f"blind has neither landmarks nor scans.*{name}"):
        estimators.make(name, Given([Reading(0.0), Reading(1.0)], name="blind"))


def corner(r, bearing, bisector, convex):
    """A reading that shows one corner, a millimetre sure."""
    z, R = np.array([[r, bearing]]), np.diag([1e-6, 1e-4])[None]
    seen = Observations(z, np.array([-1]), R, np.array([bisector]), np.array([convex]))
    return Reading(0.0, observations=seen)


def test_corners_at_one_position_are_associated_only_if_compatible():
    sensor = ArenaRun.scanner.model
    for turned, convex, landmarks, ambiguous in (
        (0.4, True, 1, 0),  # by less than 30°
        (0.7, True, 1, 1),  # it opens elsewhere: not the known one, and too near it to be new
        (0.0, False, 1, 1),
    ):
        slam = EkfSlam(RobotModel(), sensor)
        slam.step(corner(0.2, 0.0, 3.0, True))
        slam.step(corner(0.2, 0.0, wrap(3.0 + turned), convex))
        assert (len(slam.filter.ids), slam.association.ambiguous) == (landmarks, ambiguous)


@pytest.mark.parametrize(("bisector", "least"), [(0.0, 0.08), (3.0, 0.2)])
def test_a_new_corner_needs_a_distance_from_known_ones_larger_if_compatible(bisector, least):
    for apart, landmarks in ((least - 0.01, 1), (least + 0.01, 2)):
        slam = EkfSlam(RobotModel(), ArenaRun.scanner.model)
        for reading in (corner(0.2, 0.0, 3.0, True), corner(0.2 + apart, 0.0, bisector, True)):
            slam.step(reading)
        assert len(slam.filter.ids) == landmarks


def test_bisectors_are_compared_in_the_map_frame():
    slam = EkfSlam(RobotModel(), ArenaRun.scanner.model)
    slam.step(corner(0.2, 0.0, 3.0, True))
    turned = replace(corner(0.2, -1.0, 2.0, True), odometry=np.array([0.0, 0.0, 1.0]))
    slam.step(turned)
    assert len(slam.filter.ids) == 1 and slam.association.ambiguous == 0
