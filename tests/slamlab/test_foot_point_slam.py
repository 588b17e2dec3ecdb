"""Smolec's system of foot points: each correction changes what it names, no matrix is singular."""

from dataclasses import replace

import numpy as np
import pytest

from slamlab.estimators.foot_point_corrections import CORRECTIONS, checked
from slamlab.estimators.foot_point_formulas import R_foot_points, make_filter, predict
from slamlab.estimators.foot_point_slam import FootPointSlam
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.landmarks.line_fitting import total_least_squares
from slamlab.landmarks.ransac import THESIS, Ransac
from slamlab.landmarks.thesis_line_extraction import ordinary_least_squares, sampled_lines
from slamlab.layers import Points, Segments
from slamlab.models import jacobians
from slamlab.models.parameters import RobotModel, SensorModel
from slamlab.readings import Reading
from slamlab.simulation.range_scanners import Scanner
from slamlab.simulation.worlds import World
from slamlab.sources import simulation

POSE, FOOT = np.array([0.3, -0.4, 0.7]), np.array([2.0, 1.0])
LIDAR = Scanner(range_error=0.0, beams=400)
CORRIDOR = World([[-20.0, 1.0, 20.0, 1.0], [-20.0, -1.5, 20.0, -1.5]])


def without(*corrections):
    return frozenset(CORRECTIONS) - set(corrections)


def made(corrections, **options):
    return FootPointSlam(
        RobotModel(), SensorModel(), np.random.default_rng(0), corrections=corrections, **options
    )


def filter_of(corrections):
    return make_filter(corrections, np.zeros((3, 3)))


def jacobian_of(kind, x, p, step=1e-6):
    """∂h/∂x and ∂h/∂p by differences."""
    both = np.concatenate([x, p])
    columns = [
        (kind.h((both + d)[:3], (both + d)[3:]) - kind.h((both - d)[:3], (both - d)[3:])) / 2 / step
        for d in step * np.eye(5)
    ]
    H = np.transpose(columns)
    return H[:, :3], H[:, 3:]


def test_with_every_correction_the_filter_is_plain_mak():
    assert type(filter_of(without())) is MAK


def test_an_unknown_correction_is_refused_with_the_known_ones():
    with pytest.raises(ValueError, match=r"unknown correction 'neerest'.*nearest"):
        made(["neerest"])
    assert checked("nearest") == {"nearest"}


@pytest.mark.parametrize(
    "wrong",
    [{"min_observations": 0}, {"max_misses": 0}, {"samples": 0}, {"offset": 0.0}, {"c": -1.0}],
)
def test_numbers_out_of_range_are_named(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        made((), **wrong)


def test_grown_lines_report_the_corrections_that_they_need():
    with pytest.raises(ValueError, match="distinct-lines"):
        made((), ransac=Ransac())


# ---- the formulas


def test_corrected_H_is_the_derivative_and_the_printed_one_has_a_wrong_sign():
    true_H, true_p = jacobian_of(filter_of(without()).kind, POSE, FOOT)
    printed, corrected = (filter_of(without(each)).kind.H(POSE, FOOT) for each in ("H", "J"))
    np.testing.assert_allclose(corrected[0], true_H, atol=1e-8)
    np.testing.assert_allclose(corrected[1], true_p, atol=1e-8)
    off = printed[0] - true_H
    assert off[1, 1] == pytest.approx(-2 * true_H[1, 1])
    off[1, 1] = 0
    np.testing.assert_allclose(off, 0, atol=1e-8)
    np.testing.assert_allclose(printed[1], -printed[0][:, :2])


def test_printed_J_is_independent_of_the_range():
    printed = filter_of(without("J")).kind.J
    near, far = (printed(POSE, np.array([[r, 0.4]])) for r in (1.0, 5.0))
    for a, b in zip(near, far, strict=True):
        np.testing.assert_allclose(a, b)
    assert not np.allclose(jacobians.J_z(POSE, np.array([1.0, 0.4])), near[1])


def test_in_degrees_lever_arms_are_too_long_and_bearings_too_insensitive():
    factor = 180 / np.pi
    radians, degrees = (filter_of(m) for m in (without(), without("radians")))
    (H, H_p), (G, G_p) = (each.kind.H(POSE, FOOT) for each in (radians, degrees))
    np.testing.assert_allclose(G[1, :2] * factor, H[1, :2])
    np.testing.assert_allclose(G_p[1] * factor, H_p[1])
    np.testing.assert_allclose(G[0], H[0])
    assert G[1, 2] == H[1, 2] == -1
    z = np.array([[2.0, 0.4]])
    (J, J_z), (K, K_z) = (each.kind.J(POSE, z) for each in (radians, degrees))
    np.testing.assert_allclose(K[..., 2], factor * J[..., 2])
    np.testing.assert_allclose(K_z[..., 1], factor * J_z[..., 1])
    P = np.diag([0.0, 0.0, 1.0])
    swings = []
    for corrections in (without(), without("radians")):
        filter = make_filter(corrections, P)
        filter.predict([0.3, 0.0, 0.1], np.zeros((3, 3)))
        np.testing.assert_allclose(filter.pose, [0.3, 0.0, 0.1])
        swings.append(filter.P[1, 2])
    assert swings[1] == pytest.approx(factor * swings[0])


@pytest.mark.parametrize(("corrections", "rank"), [(without("Q"), 1), (without(), 2)])
def test_printed_Q_has_rank_one(corrections, rank):
    filter = filter_of(corrections)
    predict(filter, [0.3, 0.02, 0.1], RobotModel(), 0.01, corrections)
    assert np.linalg.matrix_rank(filter.P, tol=1e-12) == rank


def test_printed_R_is_linear_in_the_range_and_the_corrected_one_square():
    sensor, ranges = SensorModel(range_error=0.01), np.array([1.0, 4.0])
    printed, corrected = (R_foot_points(sensor, ranges, m) for m in (without("R"), without()))
    assert printed[1, 0, 0] == pytest.approx(4 * printed[0, 0, 0])
    assert corrected[1, 0, 0] == pytest.approx(16 * corrected[0, 0, 0])
    assert np.sqrt(printed[0, 1, 1]) == pytest.approx(np.radians(1))


def test_the_start_is_uncertain_as_printed_and_exact_when_corrected():
    assert np.all(np.diag(made(()).filter.P) > 0)
    assert not made(["exact-start"]).filter.P.any()


# ---- the lines


@pytest.mark.parametrize("slope", [0.0, 0.4, -1.5])
def test_both_fits_agree_on_a_line_that_has_a_slope(slope):
    x = np.linspace(-1, 2, 9)
    points = np.column_stack([x, slope * x - 1.0])
    np.testing.assert_allclose(ordinary_least_squares(points), total_least_squares(points))


def test_y_on_x_turns_a_wall_along_y_and_orthogonal_fit_does_not():
    rng, y = np.random.default_rng(0), np.linspace(-0.3, 0.3, 25)
    points = np.column_stack([3 + 0.01 * rng.standard_normal(25), y])
    assert abs(total_least_squares(points)[1]) < np.radians(3)
    assert abs(ordinary_least_squares(points)[1]) > np.radians(10)


def test_random_points_find_a_wall_repeatedly_and_none_without_points():
    points = LIDAR.scan(CORRIDOR, np.zeros(3), np.random.default_rng(0)).points()
    rng = np.random.default_rng(1)
    found = np.array(sampled_lines(points, rng, THESIS, 40, total_least_squares))
    rho = np.unique(found[:, 0].round(6))
    assert len(found) > 10
    np.testing.assert_allclose(rho, [1.0, 1.5])
    assert sampled_lines(points[:24], rng, THESIS, 40, total_least_squares) == []


def counted(corrections, **options):
    """Landmarks after the first of a corridor's scans."""
    slam = made(corrections, **options)
    scan = LIDAR.scan(CORRIDOR, np.zeros(3), np.random.default_rng(0))
    slam.step(Reading(time=0.0, odometry=np.zeros(3), scan=scan))
    return slam


def test_distinct_lines_make_few_landmarks_and_sampled_ones_many():
    """A scan's landmarks are not compared with each other, so a wall enters as often as found."""
    few, heaps = counted(without()), counted(without("distinct-lines"))
    assert len(heaps.filter.ids) > 2 * len(few.filter.ids)


# ---- the loop


def test_the_first_under_the_offset_or_the_nearest():
    foot_points = np.array([[0.0, 2.0], [0.0, 2.4]])
    for corrections, expected in ((without(), 1), (without("nearest"), 0)):
        slam = made(corrections)
        slam._augment(foot_points)
        paired, new = slam._associate(np.array([[0.0, 2.35], [5.0, 0.0]]))
        assert list(paired) == [slam.filter.ids[expected]]
        np.testing.assert_allclose(new, [[5.0, 0.0]])


def test_the_second_foot_of_a_landmark_in_a_scan_is_dropped():
    slam = made(without())
    slam._augment(np.array([[0.0, 2.0]]))
    paired, new = slam._associate(np.array([[0.0, 2.1], [0.0, 2.05]]))
    np.testing.assert_allclose(paired[slam.filter.ids[0]], [0.0, 2.1])
    assert new == []


def driven_along(corrections, steps=12):
    """How far it believes to have come along a corridor, driven straight with true odometry."""
    slam, step = made(corrections, min_observations=2), np.array([0.2, 0.0, 0.0])
    for k in range(steps):
        scan = LIDAR.scan(CORRIDOR, k * step, np.random.default_rng(k))
        slam.step(Reading(time=float(k), odometry=step if k else np.zeros(3), scan=scan))
    return slam.pose[0] / ((steps - 1) * step[0])


def test_prediction_after_association_retards_the_pose_along_the_walls():
    assert driven_along(without()) == pytest.approx(1.0, abs=0.02)
    assert driven_along(without("predict-first")) < 0.9


def test_one_landmark_at_a_time_is_the_same_to_first_order_and_not_the_same():
    states = []
    for corrections in (without(), without("joint-update")):
        slam = made(corrections)
        slam.filter = make_filter(corrections, np.diag([0.1, 0.1, 0.02]) ** 2)
        foot_points = np.array([[0.0, 2.0], [2.0, 0.5], [-1.0, -1.0]])
        slam._augment(foot_points)
        slam.observed = dict.fromkeys(slam.observed, 9)
        pose, h = np.array([0.02, -0.01, 0.01]), slam.filter.kind.h
        slam._update({i: h(pose, foot) for i, foot in enumerate(foot_points)})
        states.append(slam.filter.x.copy())
    np.testing.assert_allclose(*states, atol=1e-3)
    assert not np.array_equal(*states)


def test_a_landmark_missed_too_often_is_deleted():
    slam = counted(without(), max_misses=2)
    empty = LIDAR.scan(World([[-30.0, 9.0, -29.0, 9.0]]), np.zeros(3), np.random.default_rng(0))
    assert slam.filter.ids
    one = replace(empty, ranges=np.where(np.arange(400) == 7, 3.0, empty.ranges))
    for k in (1, 2):
        slam.step(Reading(time=float(k), odometry=np.zeros(3), scan=one))
    assert slam.filter.ids == []
    assert slam.observed == slam.misses_left == {}


# ---- the whole


@pytest.mark.parametrize("corrections", [(), tuple(CORRECTIONS)], ids=["as printed", "all"])
def test_it_runs_through_and_shows_foot_points_on_their_perpendiculars(corrections):
    source = simulation("situation-2", np.random.default_rng(4))
    rng = np.random.default_rng(4)
    slam = FootPointSlam(source.robot, source.sensor, rng, corrections=corrections)
    for reading in source:
        slam.step(reading)
    layers = {(type(layer), layer.name): layer for layer in slam.layers()}
    foot_points = layers[Points, "landmark"].xy
    assert len(foot_points) > 0
    np.testing.assert_array_equal(layers[Segments, "perpendicular"].rows[:, 2:], foot_points)
    assert not layers[Segments, "perpendicular"].rows[:, :2].any()
    assert np.isfinite(slam.trajectory().poses).all()
    assert len(slam.trajectory().poses) == len(source)
