"""Ray casting is exact: equal to a plain double loop, and right in every corner case."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from slamlab.worlds.ray_casting import cast

CLEAR = 1e-6  # rounding may decide closer to an end of a wall or to a tangent than this


def brute_force(position, directions, walls, circles, slack):
    """Every beam against every obstacle; walls lengthened and circles widened by ``slack``."""
    ranges = np.full(len(directions), np.inf)
    for i, direction in enumerate(directions):
        u = np.array([np.cos(direction), np.sin(direction)])
        for x1, y1, x2, y2 in walls:
            a, w = np.array([x1, y1]) - position, np.array([x2 - x1, y2 - y1])
            sine = u[0] * w[1] - u[1] * w[0]
            if sine == 0:
                continue
            t = (a[0] * w[1] - a[1] * w[0]) / sine
            s = (a[0] * u[1] - a[1] * u[0]) / sine
            if t >= 0 and -slack <= s <= 1 + slack:
                ranges[i] = min(ranges[i], t)
        for x, y, radius in circles:
            to_centre = np.array([x, y]) - position
            middle = to_centre @ u
            under_root = (radius + slack) ** 2 - (to_centre @ to_centre - middle**2)
            if under_root >= 0:
                root = np.sqrt(max(radius**2 - (to_centre @ to_centre - middle**2), 0))
                ahead = [t for t in (middle - root, middle + root) if t >= 0]
                ranges[i] = min([ranges[i], *ahead])
    return ranges


def assert_equal_to_brute_force(position, directions, walls, circles):
    """Compare the beams whose answer does not hang on rounding; returns how many those are."""
    shy = brute_force(position, directions, walls, circles, -CLEAR)
    bold = brute_force(position, directions, walls, circles, CLEAR)
    clear = np.isclose(shy, bold, rtol=1e-9)
    ranges = cast(position, directions, walls, circles)
    np.testing.assert_allclose(ranges[clear], shy[clear], rtol=1e-7)
    return clear.sum()


coordinate = st.floats(-10, 10).map(lambda value: round(value, 2))
lengthy = st.tuples(coordinate, coordinate, coordinate, coordinate).filter(
    lambda row: np.hypot(row[2] - row[0], row[3] - row[1]) > 0.05
)
a_circle = st.tuples(coordinate, coordinate, st.floats(0.05, 12))


@given(
    st.tuples(coordinate, coordinate),
    st.lists(lengthy, max_size=8),
    st.lists(a_circle, max_size=4),
    st.lists(st.floats(-20, 20), min_size=1, max_size=12),
)
def test_it_equals_the_double_loop_for_any_scene_and_any_directions(
    position, walls, circles, directions
):
    walls, circles = np.array(walls).reshape(-1, 4), np.array(circles).reshape(-1, 3)
    on_something = cast(position, [0.0], walls, circles)[0] == 0
    assume(not on_something)
    assert_equal_to_brute_force(np.array(position), np.array(directions), walls, circles)


@pytest.mark.parametrize("seed", range(6))
def test_it_equals_the_double_loop_among_hundreds_of_obstacles(seed):
    rng = np.random.default_rng(seed)
    centres, half = rng.uniform(-10, 10, (300, 2)), rng.normal(0, 0.6, (300, 2))
    walls = np.hstack([centres - half, centres + half])
    circles = np.column_stack([rng.uniform(-10, 10, (80, 2)), rng.uniform(0.05, 0.5, 80)])
    directions = rng.uniform(-4, 4, 40)
    clear = assert_equal_to_brute_force(rng.uniform(-9, 9, 2), directions, walls, circles)
    assert clear > 30


def test_thousands_of_walls_hide_each_other_rightly():
    rng = np.random.default_rng(3)
    centres, half = rng.uniform(-10, 10, (6000, 2)), rng.normal(0, 0.3, (6000, 2))
    walls = np.hstack([centres - half, centres + half])
    directions = np.linspace(-np.pi, np.pi, 400, endpoint=False)
    ranges = cast((0.2, 0.1), directions, walls)
    in_parts = [cast((0.2, 0.1), directions, part) for part in np.split(walls, 120)]
    np.testing.assert_allclose(ranges, np.min(in_parts, axis=0), rtol=1e-12)


def test_walls_behind_others_are_left_out_only_where_they_cannot_be_seen():
    rng = np.random.default_rng(11)
    centres, half = rng.uniform(-10, 10, (400, 2)), rng.normal(0, 0.1, (400, 2))
    screen = np.array([[-9.0, 2.0, 0.0, 2.5], [0.0, 2.5, 9.5, -8.0], [9.5, -8.0, -9.0, 2.0]])
    walls = np.vstack([np.hstack([centres - half, centres + half]), screen])
    directions = np.linspace(-np.pi, np.pi, 20_000)
    ranges = cast((0.5, 0.3), directions, walls)
    in_parts = [cast((0.5, 0.3), directions, part) for part in np.array_split(walls, 10)]
    np.testing.assert_allclose(ranges, np.min(in_parts, axis=0), rtol=1e-12)


def test_many_beams_on_many_far_walls_are_handled_in_parts():
    rng = np.random.default_rng(5)
    angles = rng.uniform(-np.pi, np.pi, 2000)
    ends = 10 * np.column_stack([np.cos(angles), np.sin(angles)])
    walls = np.hstack([ends, np.roll(ends, 1, axis=0)])
    directions = np.linspace(0, 2 * np.pi, 3000)
    ranges = cast((0.0, 0.0), directions, walls)
    in_parts = [cast((0.0, 0.0), directions, part) for part in np.split(walls, 50)]
    np.testing.assert_allclose(ranges, np.min(in_parts, axis=0), rtol=1e-12)


def test_the_order_of_directions_and_whole_turns_do_not_matter():
    rng = np.random.default_rng(1)
    walls = rng.uniform(-5, 5, (12, 4))
    directions = np.linspace(-3, 3, 101)
    ranges = cast((0.1, 0.2), directions, walls)
    shuffled = rng.permutation(101)
    np.testing.assert_array_equal(cast((0.1, 0.2), directions[shuffled], walls), ranges[shuffled])
    turned = directions + 2 * np.pi * rng.integers(-3, 4, 101)
    np.testing.assert_allclose(cast((0.1, 0.2), turned, walls), ranges, rtol=1e-9)


@given(st.floats(-np.pi, np.pi), st.floats(-5, 5), st.floats(-5, 5))
def test_turning_and_moving_everything_changes_no_range(turn, x, y):
    rng = np.random.default_rng(7)
    walls, circles = rng.uniform(-5, 5, (10, 4)), np.array([[2.0, 1.0, 0.5], [-3.0, 0.0, 0.8]])
    directions = np.linspace(-3.1, 3.1, 57)
    c, s = np.cos(turn), np.sin(turn)
    rotation, shift = np.array([[c, s], [-s, c]]), np.array([x, y])
    moved_walls = np.hstack([walls[:, :2] @ rotation + shift, walls[:, 2:] @ rotation + shift])
    moved_circles = np.column_stack([circles[:, :2] @ rotation + shift, circles[:, 2]])
    np.testing.assert_allclose(
        cast(shift, directions + turn, moved_walls, moved_circles),
        cast((0.0, 0.0), directions, walls, circles),
        rtol=1e-6,
    )


def test_a_wall_across_the_seam_at_half_a_turn_is_seen_on_both_sides():
    directions = np.array([np.pi, -np.pi, np.pi - 0.1, -np.pi + 0.1, 3 * np.pi])
    ranges = cast((0.0, 0.0), directions, [[-2.0, -1.0, -2.0, 1.0]])
    np.testing.assert_allclose(ranges, 2 / np.abs(np.cos(directions)))


def test_a_wall_across_the_seam_at_zero_is_seen_on_both_sides():
    directions = np.array([0.0, -1e-20, 1e-20, 0.1, -0.1, 2 * np.pi - 0.1])
    ranges = cast((0.0, 0.0), directions, [[2.0, -1.0, 2.0, 1.0]])
    np.testing.assert_allclose(ranges, 2 / np.cos(directions))


def test_a_room_of_walls_has_no_leak_at_its_corners():
    rng = np.random.default_rng(0)
    for _ in range(50):
        bearings = np.sort(rng.uniform(-np.pi, np.pi, 5))
        corners = rng.uniform(1, 9, (5, 1)) * np.column_stack([np.cos(bearings), np.sin(bearings)])
        walls = np.hstack([corners, np.roll(corners, 1, axis=0)])
        into_corners = np.arctan2(corners[:, 1], corners[:, 0])
        ranges = cast((0.0, 0.0), into_corners, walls)
        assert np.all(ranges <= np.hypot(*corners.T) * (1 + 1e-9))


@pytest.mark.parametrize("position", [(0.0, 0.0), (0.5, 0.0), (-1.0, 0.0), (1.0, 0.0)])
def test_a_sensor_that_stands_on_a_wall_sees_zero_all_round(position):
    ranges = cast(position, np.linspace(-3, 3, 31), [[-1.0, 0.0, 1.0, 0.0], [-5, 3, 5, 3]])
    np.testing.assert_array_equal(ranges, 0)


def test_a_sensor_that_stands_on_a_slanted_wall_or_on_a_rim_sees_zero_all_round():
    start, end = np.array([-1.3, 0.7]), np.array([2.9, 1.9])
    on_wall = start + 0.37 * (end - start)
    assert np.all(cast(on_wall, [0.0, 1.0, 2.0], [[*start, *end]]) == 0)
    on_rim = np.array([1.0, 2.0]) + 0.6 * np.array([np.cos(0.7), np.sin(0.7)])
    assert np.all(cast(on_rim, [0.0, 1.0, 2.0], [], [[1.0, 2.0, 0.6]]) == 0)


@pytest.mark.parametrize("distance", [1e-8, 1e-6, 1e-3])
def test_a_sensor_close_to_a_wall_sees_it_on_half_of_the_turn(distance):
    directions = np.array([-2.5, -1.5, -0.5, 0.5, 1.5, 2.5])
    ranges = cast((0.0, distance), directions, [[-9.0, 0.0, 9.0, 0.0]])
    np.testing.assert_allclose(ranges[:3], distance / -np.sin(directions[:3]), rtol=1e-6)
    assert np.all(np.isinf(ranges[3:]))


def test_a_beam_along_a_wall_meets_its_near_end():
    for turn in np.linspace(0, 6, 13):
        c, s = np.cos(turn), np.sin(turn)
        wall = [[1.5 * c, 1.5 * s, 4 * c, 4 * s]]
        for rows in (wall, [[*wall[0][2:], *wall[0][:2]]]):
            ranges = cast((0.0, 0.0), [turn, turn + 1e-3, turn + np.pi], rows)
            np.testing.assert_allclose(ranges, [1.5, np.inf, np.inf])


def test_a_wall_without_length_is_a_point():
    ranges = cast((0.0, 0.0), [0.0, 1e-3, np.pi], [[2.0, 0.0, 2.0, 0.0]])
    np.testing.assert_allclose(ranges, [2.0, np.inf, np.inf])


def test_a_circle_is_seen_from_outside_at_its_front_and_from_inside_at_its_rim():
    circle = [[3.0, 0.0, 1.0]]
    outside = cast((0.0, 0.0), [0.0, np.arcsin(1 / 3) - 1e-3, 0.4, np.pi], [], circle)
    assert outside[0] == pytest.approx(2)
    assert outside[1] == pytest.approx(np.sqrt(8), rel=0.05)
    assert np.all(np.isinf(outside[2:]))
    inside = cast((3.5, 0.0), [0.0, np.pi, np.pi / 2], [], circle)
    np.testing.assert_allclose(inside, [0.5, 1.5, np.sqrt(0.75)])


def test_nothing_to_see_is_infinitely_far_and_no_beams_give_no_ranges():
    np.testing.assert_array_equal(cast((0.0, 0.0), [0.0, 1.0], []), [np.inf, np.inf])
    assert cast((0.0, 0.0), [], [[1.0, 0.0, 1.0, 1.0]]).shape == (0,)
