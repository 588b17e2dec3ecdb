"""Ray casting is exact: equal to a plain double loop, and right in every corner case."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from slamlab.simulation.worlds.ray_casting import cast

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
    walls = scattered(rng, 300, 0.6)
    circles = np.column_stack([rng.uniform(-10, 10, (80, 2)), rng.uniform(0.05, 0.5, 80)])
    directions = rng.uniform(-4, 4, 40)
    clear = assert_equal_to_brute_force(rng.uniform(-9, 9, 2), directions, walls, circles)
    assert clear > 30


def scattered(rng, count, sigma):
    """Walls about places all over."""
    centres, half = rng.uniform(-10, 10, (count, 2)), rng.normal(0, sigma, (count, 2))
    return np.hstack([centres - half, centres + half])


def screened(rng):
    """Walls, most of them behind three others."""
    screen = [[-9.0, 2.0, 0.0, 2.5], [0.0, 2.5, 9.5, -8.0], [9.5, -8.0, -9.0, 2.0]]
    return np.vstack([scattered(rng, 400, 0.1), screen])


def far_away(rng):
    """Walls from rim to rim of a circle: many beams on many of them."""
    angles = rng.uniform(-np.pi, np.pi, 2000)
    ends = 10 * np.column_stack([np.cos(angles), np.sin(angles)])
    return np.hstack([ends, np.roll(ends, 1, axis=0)])


@pytest.mark.parametrize(
    ("walls", "beams"),
    [(lambda rng: scattered(rng, 6000, 0.3), 400), (screened, 20_000), (far_away, 3000)],
    ids=["thousands", "hidden", "far"],
)
def test_many_walls_together_are_seen_as_the_nearest_of_their_parts(walls, beams):
    walls = walls(np.random.default_rng(3))
    directions = np.linspace(-np.pi, np.pi, beams)
    ranges = cast((0.2, 0.1), directions, walls)
    in_parts = [cast((0.2, 0.1), directions, part) for part in np.array_split(walls, 40)]
    np.testing.assert_allclose(ranges, np.min(in_parts, axis=0), rtol=1e-12)


@pytest.mark.parametrize("side", [-2.0, 2.0])
def test_a_wall_across_the_seam_of_a_turn_is_seen_on_both_sides(side):
    off = np.array([0.0, -1e-20, 1e-20, 0.1, -0.1, 2 * np.pi - 0.1, -2 * np.pi])
    directions = off if side > 0 else np.pi + off
    ranges = cast((0.0, 0.0), directions, [[side, -1.0, side, 1.0]])
    np.testing.assert_allclose(ranges, 2 / np.abs(np.cos(directions)))


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


def test_a_sensor_that_stands_on_a_slanted_wall_or_a_rim_sees_zero_all_round():
    start, end = np.array([-1.3, 0.7]), np.array([2.9, 1.9])
    on_wall = start + 0.37 * (end - start)
    assert np.all(cast(on_wall, [0.0, 1.0, 2.0], [[*start, *end]]) == 0)
    on_rim = np.array([1.0, 2.0]) + 0.6 * np.array([np.cos(0.7), np.sin(0.7)])
    assert np.all(cast(on_rim, [0.0, 1.0, 2.0], [], [[1.0, 2.0, 0.6]]) == 0)


@pytest.mark.parametrize("distance", [1e-8, 1e-6, 1e-3])
def test_a_sensor_close_to_a_wall_sees_it_over_half_of_the_circle(distance):
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
