"""Ready worlds are ones to drive in; a world's file restores the world or reports the error."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.simulation import worlds
from slamlab.simulation.worlds.world import World
from slamlab.simulation.worlds.world_files import WorldFileError, load, save

finite = st.floats(-1e6, 1e6)
walls = st.lists(
    st.tuples(finite, finite, finite, finite).filter(lambda w: w[:2] != w[2:]), min_size=1
)
circles = st.lists(st.tuples(finite, finite, st.floats(1e-6, 1e3)))


@pytest.mark.parametrize("name", worlds.WORLDS)
def test_in_a_ready_world_the_robot_stands_free_and_is_enclosed(name):
    world = worlds.by_name(name)
    ranges = world.cast((0.0, 0.0), np.linspace(-np.pi, np.pi, 720))
    assert ranges.min() > 0.07
    assert np.isfinite(ranges).all()
    assert world.name == name


def test_through_its_door_the_robot_of_situation_1_sees_the_room_across_the_corridor():
    straight_up = worlds.situation_1().cast((0.0, 0.0), [np.pi / 2])
    np.testing.assert_allclose(straight_up, 7.5)


@given(walls, circles)
def test_a_saved_world_is_loaded_as_it_was(tmp_path_factory, some_walls, some_circles):
    path = tmp_path_factory.mktemp("world") / "mine.txt"
    world = World(some_walls, some_circles)
    save(world, path)
    again = load(path)
    np.testing.assert_array_equal(again.walls, world.walls)
    np.testing.assert_array_equal(again.circles, world.circles)
    assert again.name == "mine"


def test_comments_empty_lines_and_commas_are_understood(tmp_path):
    path = tmp_path / "w.txt"
    path.write_text("# a room\n\n0, 0, 1, 0  # south\n2 2 0.5\n")
    world = load(path)
    assert world.walls.tolist() == [[0, 0, 1, 0]]
    assert world.circles.tolist() == [[2, 2, 0.5]]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0 0 1 0\n1 2\n", ":2: the line has 2 numbers"),
        ("0 0 1 nan\n", ":1: a number is not finite"),
        ("0 0 0 0\n", ":1: the wall has no length"),
        ("0 0 -1\n", ":1: the radius of a circle must"),
        ("0 0 1 x\n", "'x' is not a number"),
        ("", "neither a wall nor a circle"),
    ],
)
def test_a_line_that_is_neither_is_named(tmp_path, text, message):
    path = tmp_path / "w.txt"
    path.write_text(text)
    with pytest.raises(WorldFileError, match=message) as refusal:
        load(path)
    assert str(path) in str(refusal.value)


def test_a_file_that_is_not_text_is_refused_by_name(tmp_path):
    (tmp_path / "w.png").write_bytes(b"\x89PNG\r\n\x1a\n\x00\xff")
    for path in (tmp_path / "w.png", tmp_path / "none.txt", tmp_path):
        with pytest.raises(WorldFileError, match=path.name):
            load(path)


@pytest.mark.parametrize("walls", [30_000, pytest.param(1_000_000, marks=pytest.mark.slow)])
def test_a_million_walls_work(tmp_path, walls):
    rng = np.random.default_rng(0)
    start = rng.uniform(-500, 500, (walls, 2)).round(3)
    path = tmp_path / "city.txt"
    rows = np.hstack([start, start + rng.uniform(0.1, 2, start.shape).round(3)])
    np.savetxt(path, rows, fmt="%.3f")
    world = load(path)
    assert len(world.walls) == walls
    assert np.isfinite(world.cast((0.0, 0.0), np.linspace(0, 6, 100))).any()
