"""Worlds: what they refuse, and what the ready ones promise."""

from itertools import pairwise

import numpy as np
import pytest

from slamlab.geometry import compose
from slamlab.simulation import worlds
from slamlab.simulation.worlds.world import World
from slamlab.sources.simulated_robot import POLYGON_TRUE_STEPS, ROUTES, turn_then_drive
from tests.slamlab.support import refuses

ALL_ROUND = np.linspace(-np.pi, np.pi, 720, endpoint=False)


test_a_world_that_is_invalid_is_refused_with_its_row = refuses(
    lambda rows: World(*rows),
    (([[0, 0, 1, 0], [0, 0, np.nan, 1]], []), "walls: row 1 contains a number that is not fin"),
    (([[0, 0, 1]], []), r"walls has the shape \(1, 3\); use rows x1 y1 x2 y2"),
    (([0, 0, 1, 0], []), r"walls has the shape \(4,\)"),
    (([[0, 0, 1, 0], [1, 2, 1, 2]], []), "walls: row 1 has no length"),
    (([["a", 0, 1, 0]], []), "walls is not a table of numbers"),
    (([[0, 0, 1, 0], [0, 0]], []), "walls is not a table of numbers"),
    (([], [[0, 0, 0]]), "circles: row 0 must have a radius greater than zero"),
)


def test_a_world_keeps_a_copy_that_cannot_be_written_to():
    walls = np.array([[1.0, -1.0, 1.0, 1.0]])
    world = World(walls)
    walls[:] = 0
    assert world.cast((0, 0), [0.0]) == pytest.approx(1)
    with pytest.raises(ValueError, match="read-only"):
        world.walls[0, 0] = 7


def test_an_empty_world_is_allowed_and_shows_nothing():
    assert np.isinf(World().cast((0, 0), [0.0, 1.0])).all()


def test_the_outline_of_a_circle_lies_on_its_rim_and_is_closed():
    rows = World(circles=[(1.0, 2.0, 0.5)]).outline()
    ends = rows.reshape(-1, 2)
    np.testing.assert_allclose(np.hypot(*(ends - [1.0, 2.0]).T), 0.5)
    np.testing.assert_allclose(rows[:, 2:], np.roll(rows[:, :2], -1, axis=0), atol=1e-12)


@pytest.mark.parametrize("name", ROUTES)
def test_every_route_avoids_the_walls_and_returns_to_its_start(name):
    world, stops = worlds.by_name(name), np.array([(0.0, 0.0), *ROUTES[name]])
    np.testing.assert_array_equal(stops[-1], stops[0])
    for start, end in pairwise(stops):
        for share in np.linspace(0, 1, 40):
            assert world.cast(start + share * (end - start), ALL_ROUND).min() > 0.25


def polygon_places():
    places = [np.zeros(3)]
    for motion in turn_then_drive(POLYGON_TRUE_STEPS):
        places.append(compose(places[-1], motion))
    return np.array(places)


def seen(world, place, spots):
    """Which spots of the outline are visible from a place."""
    way = spots - place[:2]
    ranges = world.cast(place[:2], np.arctan2(way[:, 1], way[:, 0]))
    return ranges > np.hypot(*way.T) - 1e-6


def test_no_position_in_the_polygon_sees_all_that_the_four_see_together():
    world = worlds.polygon()
    rows = world.outline()
    shares = np.linspace(0.02, 0.98, 25)[:, None, None]
    spots = (rows[:, :2] + shares * (rows[:, 2:] - rows[:, :2])).reshape(-1, 2)
    visible = np.array([seen(world, place, spots) for place in polygon_places()])
    together = visible.any(axis=0)
    assert np.all(visible.sum(axis=1) < 0.97 * together.sum())
    box = slice(8, 12)  # its four walls: one place sees two sides at most, the four places three
    sides = visible.reshape(4, 25, -1)[:, :, box].any(axis=1)
    assert sides.sum(axis=1).max() <= 2
    assert sides.any(axis=0).sum() >= 3


def test_the_polygons_positions_are_out_of_the_lidars_dead_zone():
    world = worlds.polygon()
    assert min(world.cast(place[:2], ALL_ROUND).min() for place in polygon_places()) > 0.25


def test_an_unknown_world_is_refused_with_the_available_names():
    with pytest.raises(ValueError, match="no world 'garden'; available: room, corridor, twins"):
        worlds.by_name("garden")
