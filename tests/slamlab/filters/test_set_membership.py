"""Set-membership estimation: clipped boxes, predictions and feasible sets contain the truth."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.evaluation import inside
from slamlab.filters.set_membership.angle_intervals import angle_interval, contains, midpoint
from slamlab.filters.set_membership.clipping import clip, clip_all, overlapping_boxes
from slamlab.filters.set_membership.half_planes import edges, landmark_box, reversed_edges
from slamlab.filters.set_membership.intervals import ROUNDING, widened, width
from slamlab.filters.set_membership.prediction import odometry, predict_box, steered, wheels
from slamlab.geometry import compose
from slamlab.models.motion import f_steered
from slamlab.models.observation import g
from slamlab.simulation.differential_drive import arc as true_arc
from tests.property_testing import same_angle
from tests.slamlab.filters.boxes_and_intervals import boxes, in_box, seeds, within

units = st.floats(-4, 4).map(lambda u: (float(np.cos(u)), float(np.sin(u))))


@given(boxes, units, st.floats(-30, 30), seeds)
def test_a_clipped_box_holds_every_valid_point_and_never_grows(box, normal, c, seed):
    edge = (*normal, c)
    left = clip(box, edge)
    points = in_box(box, 200, np.random.default_rng(seed))
    valid = points[points @ normal <= c]
    if left is None:
        assert len(valid) == 0
        return
    slack = 1e-7  # of a clip by an edge that runs almost along an axis
    assert left[0] >= box[0] and left[1] <= box[1] and left[2] >= box[2] and left[3] <= box[3]
    assert left[0] <= left[1] and left[2] <= left[3]
    assert all(inside(widened_box(left, slack), point) for point in valid)


@given(boxes, units, st.floats(-30, 30))
def test_each_side_of_a_clipped_box_touches_a_valid_point(box, normal, c):
    left = clip(box, (*normal, c))
    if left is None:
        return
    (a, b), (x0, x1, y0, y1) = normal, left
    sides = [[(x0, y0), (x0, y1)], [(x1, y0), (x1, y1)], [(x0, y0), (x1, y0)], [(x0, y1), (x1, y1)]]
    for ends in sides:
        assert min(a * x + b * y for x, y in ends) <= c + 1e-9


def widened_box(box, by=ROUNDING):
    return (*widened(box[:2], by), *widened(box[2:], by))


@given(boxes, st.lists(st.tuples(units, st.floats(-30, 30)), min_size=1, max_size=4))
def test_many_boxes_at_once_meet_a_region_when_each_edge_leaves_something(box, lines):
    lines = [(*normal, c) for normal, c in lines]
    region = (-10.0, 10.0, -10.0, 10.0)
    beside = box[0] > 10 or box[1] < -10 or box[2] > 10 or box[3] < -10
    alone = all(clip(box, line) is not None for line in lines)
    found = overlapping_boxes(np.array(box)[:, None], region, lines)
    assert (len(found) == 1) == (alone and not beside)
    assert len(found) == 1 or beside or clip_all(box, lines) is None


headings = st.tuples(st.floats(-3.2, 3.2), st.one_of(st.floats(0, 0.6), st.floats(0, 7))).map(
    lambda a: angle_interval(a[0], a[0] + a[1])
)
lengths = st.tuples(st.floats(-2, 2), st.floats(0, 1)).map(lambda a: (a[0] - a[1], a[0] + a[1]))
turns = st.tuples(st.floats(-2, 2), st.floats(0, 1)).map(lambda a: (a[0] - a[1], a[0] + a[1]))


def assert_holds_poses(found, poses):
    """The box and the heading hold every pose."""
    box, heading = found
    x, y, theta = np.array(poses).T
    assert box[0] <= x.min() and x.max() <= box[1]
    assert box[2] <= y.min() and y.max() <= box[3]
    assert all(contains(heading, angle) for angle in theta)


def starts(robot, heading, n, rng):
    return np.column_stack([in_box(robot, n - 4, rng), within(heading, n - 2, rng)])


@given(boxes, headings, lengths, turns, seeds)
def test_no_steered_robot_leaves_its_prediction(robot, heading, V, gamma, seed):
    rng, B, T = np.random.default_rng(seed), 0.4, 0.5
    found = predict_box(robot, heading, *steered(V, gamma, B, T))
    poses = starts(robot, heading, 60, rng)
    controls = zip(within(V, 58, rng), rng.permutation(within(gamma, 58, rng)), strict=True)
    assert_holds_poses(found, [f_steered(x, u, B, T) for x, u in zip(poses, controls, strict=True)])


@given(boxes, headings, lengths, lengths, seeds)
def test_no_robot_on_two_wheels_leaves_its_prediction(robot, heading, left, right, seed):
    rng, base = np.random.default_rng(seed), 1.5
    found = predict_box(robot, heading, *wheels(left, right, base))
    poses = starts(robot, heading, 60, rng)
    rolled = zip(within(left, 58, rng), rng.permutation(within(right, 58, rng)), strict=True)
    ends = [compose(x, true_arc(*u, base)) for x, u in zip(poses, rolled, strict=True)]
    assert_holds_poses(found, ends)


@given(boxes, headings, lengths, turns, seeds)
def test_no_robot_that_reads_its_odometry_leaves_its_prediction(robot, heading, way, turn, seed):
    rng = np.random.default_rng(seed)
    measured = (way[0] + way[1]) / 2, (turn[0] + turn[1]) / 2
    motion = true_arc(measured[0] - measured[1] / 2, measured[0] + measured[1] / 2, 1.0)
    found = predict_box(robot, heading, *odometry(motion, width(way) / 2, width(turn) / 2))
    poses = starts(robot, heading, 60, rng)
    driven = zip(within(way, 58, rng), rng.permutation(within(turn, 58, rng)), strict=True)
    arcs = [true_arc(w - t / 2, w + t / 2, 1.0) for w, t in driven]
    assert_holds_poses(found, compose(poses, np.array(arcs)))


def test_odometry_that_is_no_arc_is_taken_as_it_is():
    motion = np.array([0.1, -0.3, 0.5])
    robot, heading = (1.0, 1.0, 2.0, 2.0), angle_interval(0.7, 0.7)
    box, turned_to = predict_box(robot, heading, *odometry(motion, 0.0, 0.0))
    end = compose(np.array([1.0, 2.0, 0.7]), motion)
    np.testing.assert_allclose(box, np.repeat(end[:2], 2), atol=1e-9)
    assert same_angle(np.array(turned_to), end[2], 1e-9)


@given(boxes, headings, lengths, turns)
def test_a_steered_prediction_touches_the_exact_hull_on_every_side(robot, heading, V, gamma):
    B, T = 0.4, 0.5
    box, _ = predict_box(robot, heading, *steered(V, gamma, B, T))
    course = np.linspace(heading[0] + gamma[0], heading[1] + gamma[1], 4001)
    x, y = (T * np.outer(V, f(course)) for f in (np.cos, np.sin))
    exact = robot[0] + x.min(), robot[1] + x.max(), robot[2] + y.min(), robot[3] + y.max()
    np.testing.assert_allclose(box, exact, atol=1e-4)


observation_vectors = st.tuples(st.floats(0.05, 10), st.floats(-3.1, 3.1))
seen_bounds = st.tuples(st.floats(0, 1), st.floats(0, 2))


def true_places(robot, heading, z, bounds, n, rng):
    """Where the pose and noise of each sample put the object."""
    r = np.maximum(within((z[0] - bounds[0], z[0] + bounds[0]), n - 2, rng), 0)
    bearing = rng.permutation(within((z[1] - bounds[1], z[1] + bounds[1]), n - 2, rng))
    poses = starts(robot, heading, n + 2, rng)[:n]
    return poses, np.array([g(*each) for each in zip(poses, np.c_[r, bearing], strict=True)])


@given(boxes, headings, observation_vectors, seen_bounds, seeds)
def test_every_feasible_position_lies_within_the_edges_and_the_box(robot, heading, z, bounds, seed):
    rng = np.random.default_rng(seed)
    poses, places = true_places(robot, heading, z, bounds, 60, rng)
    d_abs = bounds[1] + width(heading) / 2
    direction = midpoint(heading) + z[1]
    for a, b, c in edges(z, bounds, direction, d_abs, robot):
        assert (places @ [a, b] <= c).all()
    assert all(inside(widened_box(landmark_box(robot, heading, z, bounds)), p) for p in places)
    for (x, y, _), p in zip(poses, places, strict=True):
        target = (p[0], p[0], p[1], p[1])
        for a, b, c in reversed_edges(z, bounds, direction, d_abs, target):
            assert a * x + b * y <= c


def test_the_four_edges_stand_where_the_thesis_puts_them():
    far, near, left, right = edges((4.0, 0.0), (0.5, 0.1), 0.0, 0.3, (1.0, 1.0, 2.0, 2.0))
    np.testing.assert_allclose(far, (1, 0, 1 + 4.5), atol=1e-9)
    np.testing.assert_allclose(near, (-1, 0, -1 - 3.5 * np.cos(0.3)), atol=1e-9)
    s, c = np.sin(0.3), np.cos(0.3)
    np.testing.assert_allclose(left, (-s, c, -s + 2 * c), atol=1e-9)
    np.testing.assert_allclose(right, (-s, -c, -s - 2 * c), atol=1e-9)


@pytest.mark.parametrize("d_abs", [np.pi / 2, 2.0, 9.0])
def test_from_a_right_angle_on_only_the_range_counts(d_abs):
    lines = edges((2.0, 0.0), (0.5, 0.1), 0.7, d_abs, (0.0, 1.0, 0.0, 1.0))
    assert {tuple(np.round(line, 6)) for line in lines} == {
        (1, 0, 3.5),
        (-1, 0, 2.5),
        (0, 1, 3.5),
        (0, -1, 2.5),
    }
