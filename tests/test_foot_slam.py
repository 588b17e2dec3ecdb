"""Smolec's listing on feet of walls: each mend changes what it names, and nothing is singular."""

from dataclasses import replace

import numpy as np
import pytest

from slamlab import estimators
from slamlab.estimators.foot_formulas import R_feet, make_filter, predict
from slamlab.estimators.foot_mends import MENDS, checked
from slamlab.estimators.foot_slam import FootSlam
from slamlab.filters.mak import MAK
from slamlab.geometry import transform
from slamlab.landmarks.line_fitting import total_least_squares
from slamlab.landmarks.ransac import THESIS, Ransac
from slamlab.landmarks.sampled_lines import ordinary_least_squares, sampled_lines
from slamlab.layers import Points, Segments
from slamlab.models import jacobians
from slamlab.models.parameters import RobotModel, SensorModel
from slamlab.readings import Reading
from slamlab.simulation.range_scanners import Scanner
from slamlab.sources import simulation
from slamlab.sources.simulated_robot import THESIS_LIDAR
from slamlab.worlds import World

POSE, FOOT = np.array([0.3, -0.4, 0.7]), np.array([2.0, 1.0])
LIDAR = Scanner(range_error=0.0, beams=400)
CORRIDOR = World([[-20.0, 1.0, 20.0, 1.0], [-20.0, -1.5, 20.0, -1.5]])


def without(*mends):
    return frozenset(MENDS) - set(mends)


def made(mends, **options):
    return FootSlam(RobotModel(), SensorModel(), np.random.default_rng(0), mends=mends, **options)


def jacobian_of(kind, x, p, step=1e-6):
    """∂h/∂x and ∂h/∂p by differences."""
    both = np.concatenate([x, p])
    columns = [
        (kind.h((both + d)[:3], (both + d)[3:]) - kind.h((both - d)[:3], (both - d)[3:])) / 2 / step
        for d in step * np.eye(5)
    ]
    H = np.transpose(columns)
    return H[:, :3], H[:, 3:]


def test_with_every_mend_the_filter_is_plain_mak():
    assert type(make_filter(frozenset(MENDS), np.zeros((3, 3)))) is MAK


def test_a_mend_that_there_is_not_is_named_with_those_there_are():
    with pytest.raises(ValueError, match=r"no mend 'neerest'.*nearest"):
        made(["neerest"])
    assert checked("nearest") == {"nearest"}


@pytest.mark.parametrize(
    "wrong", [{"sightings": 0}, {"lives": 0}, {"samples": 0}, {"offset": 0.0}, {"c": -1.0}]
)
def test_numbers_out_of_range_are_named(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        made((), **wrong)


def test_lines_that_grow_are_told_which_mends_they_need():
    with pytest.raises(ValueError, match="distinct-lines"):
        made((), ransac=Ransac())


# ---- the formulas


def test_H_mended_is_the_derivative_and_printed_has_one_sign_wrong():
    true_H, true_p = jacobian_of(make_filter(frozenset(MENDS), np.zeros((3, 3))).kind, POSE, FOOT)
    printed = make_filter(without("H"), np.zeros((3, 3))).kind.H(POSE, FOOT)
    mended = make_filter(without("J"), np.zeros((3, 3))).kind.H(POSE, FOOT)
    np.testing.assert_allclose(mended[0], true_H, atol=1e-8)
    np.testing.assert_allclose(mended[1], true_p, atol=1e-8)
    off = printed[0] - true_H
    assert off[1, 1] == pytest.approx(-2 * true_H[1, 1])
    off[1, 1] = 0
    np.testing.assert_allclose(off, 0, atol=1e-8)
    np.testing.assert_allclose(printed[1], -printed[0][:, :2])


def test_J_printed_does_not_know_the_range():
    printed = make_filter(without("J"), np.zeros((3, 3))).kind.J
    near, far = (printed(POSE, np.array([[r, 0.4]])) for r in (1.0, 5.0))
    for a, b in zip(near, far, strict=True):
        np.testing.assert_allclose(a, b)
    assert not np.allclose(jacobians.J_z(POSE, np.array([1.0, 0.4])), near[1])


def test_in_degrees_lever_arms_are_too_long_and_bearings_too_stiff():
    factor = 180 / np.pi
    radians, degrees = (make_filter(m, np.zeros((3, 3))) for m in (without(), without("radians")))
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
    for mends in (without(), without("radians")):
        filter = make_filter(mends, P)
        filter.predict([0.3, 0.0, 0.1], np.zeros((3, 3)))
        np.testing.assert_allclose(filter.pose, [0.3, 0.0, 0.1])
        swings.append(filter.P[1, 2])
    assert swings[1] == pytest.approx(factor * swings[0])


@pytest.mark.parametrize(("mends", "rank"), [(without("Q"), 1), (without(), 2)])
def test_printed_Q_has_rank_one(mends, rank):
    filter = make_filter(mends, np.zeros((3, 3)))
    predict(filter, [0.3, 0.02, 0.1], RobotModel(), 0.01, mends)
    assert np.linalg.matrix_rank(filter.P, tol=1e-12) == rank


def test_printed_R_is_linear_in_the_range_and_the_mended_one_square():
    sensor, ranges = SensorModel(range_error=0.01), np.array([1.0, 4.0])
    printed, mended = (R_feet(sensor, ranges, m) for m in (without("R"), without()))
    assert printed[1, 0, 0] == pytest.approx(4 * printed[0, 0, 0])
    assert mended[1, 0, 0] == pytest.approx(16 * mended[0, 0, 0])
    assert np.sqrt(printed[0, 1, 1]) == pytest.approx(np.radians(1))


def test_the_start_is_in_doubt_as_printed_and_exact_when_mended():
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


def test_samples_find_one_wall_any_number_of_times_and_none_without_points():
    points = transform(
        np.zeros(3), LIDAR.scan(CORRIDOR, np.zeros(3), np.random.default_rng(0)).points()
    )
    rng = np.random.default_rng(1)
    found = np.array(sampled_lines(points, rng, THESIS, 40, total_least_squares))
    rho = np.unique(found[:, 0].round(6))
    assert len(found) > 10
    np.testing.assert_allclose(rho, [1.0, 1.5])
    assert sampled_lines(points[:24], rng, THESIS, 40, total_least_squares) == []


def counted(mends, **options):
    """Landmarks after the first of a corridor's scans."""
    slam = made(mends, **options)
    scan = LIDAR.scan(CORRIDOR, np.zeros(3), np.random.default_rng(0))
    slam.step(Reading(time=0.0, odometry=np.zeros(3), scan=scan))
    return slam


def test_distinct_lines_hold_few_landmarks_and_sampled_ones_heaps():
    """A scan's landmarks are not compared with each other, so a wall enters as often as found."""
    few, heaps = counted(without()), counted(without("distinct-lines"))
    assert len(heaps.filter.ids) > 2 * len(few.filter.ids)


# ---- the loop


def test_the_first_under_the_offset_or_the_nearest():
    feet = np.array([[0.0, 2.0], [0.0, 2.4]])
    for mends, expected in ((without(), 1), (without("nearest"), 0)):
        slam = made(mends)
        slam._augment(feet)
        paired, new = slam._associate(np.array([[0.0, 2.35], [5.0, 0.0]]))
        assert list(paired) == [slam.filter.ids[expected]]
        np.testing.assert_allclose(new, [[5.0, 0.0]])


def test_the_second_foot_of_a_landmark_in_a_scan_is_dropped():
    slam = made(without())
    slam._augment(np.array([[0.0, 2.0]]))
    paired, new = slam._associate(np.array([[0.0, 2.1], [0.0, 2.05]]))
    np.testing.assert_allclose(paired[slam.filter.ids[0]], [0.0, 2.1])
    assert new == []


def driven_along(mends, steps=12):
    """How far it believes to have come along a corridor, driven straight with true odometry."""
    slam, step = made(mends, sightings=2), np.array([0.2, 0.0, 0.0])
    for k in range(steps):
        scan = LIDAR.scan(CORRIDOR, k * step, np.random.default_rng(k))
        slam.step(Reading(time=float(k), odometry=step if k else np.zeros(3), scan=scan))
    return slam.pose[0] / ((steps - 1) * step[0])


def test_who_predicts_after_the_association_is_held_back_along_the_walls():
    assert driven_along(without()) == pytest.approx(1.0, abs=0.02)
    assert driven_along(without("predict-first")) < 0.9


def test_one_landmark_at_a_time_is_the_same_to_first_order_and_not_the_same():
    states = []
    for mends in (without(), without("joint-update")):
        slam = made(mends)
        slam.filter = make_filter(mends, np.diag([0.1, 0.1, 0.02]) ** 2)
        feet = np.array([[0.0, 2.0], [2.0, 0.5], [-1.0, -1.0]])
        slam._augment(feet)
        slam.observed = dict.fromkeys(slam.observed, 9)
        z = {i: slam.filter.kind.h(np.array([0.02, -0.01, 0.01]), f) for i, f in enumerate(feet)}
        slam._update(z)
        states.append(slam.filter.x.copy())
    np.testing.assert_allclose(*states, atol=1e-3)
    assert not np.array_equal(*states)


def test_a_landmark_not_seen_for_its_lives_is_forgotten():
    slam = counted(without(), lives=2)
    empty = LIDAR.scan(World([[-30.0, 9.0, -29.0, 9.0]]), np.zeros(3), np.random.default_rng(0))
    assert slam.filter.ids
    one = replace(empty, ranges=np.where(np.arange(400) == 7, 3.0, empty.ranges))
    for k in (1, 2):
        slam.step(Reading(time=float(k), odometry=np.zeros(3), scan=one))
    assert slam.filter.ids == []
    assert slam.observed == slam.lives_left == {}


# ---- the whole


@pytest.mark.parametrize("mends", [(), tuple(MENDS)], ids=["as printed", "all mends"])
def test_it_runs_through_and_shows_feet_on_their_perpendiculars(mends):
    source = simulation("situation-2", np.random.default_rng(4))
    slam = FootSlam(source.robot, source.sensor, np.random.default_rng(4), mends=mends)
    for reading in source:
        slam.step(reading)
    layers = {(type(layer), layer.name): layer for layer in slam.layers()}
    feet = layers[Points, "landmark"].xy
    assert len(feet) > 0
    np.testing.assert_array_equal(layers[Segments, "perpendicular"].rows[:, 2:], feet)
    assert not layers[Segments, "perpendicular"].rows[:, :2].any()
    assert np.isfinite(slam.trajectory().poses).all()
    assert len(slam.trajectory().poses) == len(source)


def test_by_its_name_it_is_as_printed():
    source = simulation("situation-2", np.random.default_rng(0), lidar=THESIS_LIDAR)
    assert estimators.make("walls-foot", source).mends == frozenset()
