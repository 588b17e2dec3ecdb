"""Occupancy grids: ray traversal, log-odds updates and their clamp, ROS map_server files."""

from math import ceil

import numpy as np
import pytest
import yaml
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from PIL import Image

from slamlab import views
from slamlab.gridmap import OccupancyGrid, build, map_server
from slamlab.gridmap.occupancy_grid import CLAMP, FREE, HIT, MISS, OCCUPIED, crossed_cells, log_odds
from slamlab.layers import Grid
from slamlab.readings import Scan
from slamlab.simulation.worlds import box
from slamlab.simulation.worlds.world import World
from slamlab.sources import simulation
from tests.property_testing import points, poses
from tests.slamlab.support import refuses

RESOLUTION = 0.1
BEAMS = np.linspace(-np.pi, np.pi, 400, endpoint=False)
ROOM = box((0.013, 0.017), (6, 4))  # no wall on the edge of a cell
CHAIR = box((1.295, 0.645), (0.53, 0.45))


def scan_of(walls, pose):
    """What an exact lidar sees."""
    world = World(np.concatenate(walls))
    return Scan(BEAMS, world.cast(pose[:2], pose[2] + BEAMS))


def at(grid, xy):
    """The states of the cells at places (n, 2)."""
    i, j = np.floor((np.asarray(xy) - grid.origin) / grid.resolution).astype(int).T
    return grid.states[j, i]


def share_within(start, end, cell):
    """How much of a line, as a share of it, lies within a cell; negative where it misses."""
    low, high = 0.0, 1.0
    for axis in (0, 1):
        way = end[axis] - start[axis]
        edges = np.array([cell[axis], cell[axis] + 1]) - start[axis]
        if way == 0:
            if not edges[0] <= 0 <= edges[1]:
                return -1.0
            continue
        with np.errstate(over="ignore"):
            near, far = np.sort(edges / way)
        low, high = max(low, near), min(high, far)
    return high - low


OFF_EDGES = np.array([0.1234, 0.3579])


@given(points, st.lists(points, min_size=1, max_size=4))
def test_exactly_the_cells_on_the_ray_are_crossed_and_the_last_is_not(start, ends):
    # a place on an edge may be in either cell: off the edges
    start, ends = start + OFF_EDGES, [end + OFF_EDGES for end in ends]
    for place in (start, *ends):
        assume(np.abs(place - np.round(place)).min() > 1e-6)
    found = {tuple(cell) for cell in crossed_cells(start, np.array(ends))}
    lasts = {tuple(np.floor(end).astype(int)) for end in ends}
    certain, possible = set(), set()
    for end in ends:
        low = np.floor(np.minimum(start, end)).astype(int)
        high = np.floor(np.maximum(start, end)).astype(int)
        for i in range(low[0], high[0] + 1):
            for j in range(low[1], high[1] + 1):
                if (i, j) == tuple(np.floor(end).astype(int)):
                    continue
                share = share_within(start, end, (i, j))
                if share > 1e-9:
                    certain.add((i, j))
                if share > -1e-9:
                    possible.add((i, j))
    assert certain <= found <= possible
    if len(ends) == 1:
        assert not found & lasts


@given(poses, st.floats(0.3, 8), st.floats(-3, 3))
def test_a_beam_frees_its_ray_occupies_its_end_and_touches_nothing_beyond(pose, length, bearing):
    grid = OccupancyGrid(RESOLUTION)
    grid.add(pose, Scan(np.array([bearing]), np.array([length])))
    heading = pose[2] + bearing
    beam = np.array([np.cos(heading), np.sin(heading)])
    end = pose[:2] + length * beam
    for place in (pose[:2] / RESOLUTION, end / RESOLUTION):  # one on an edge may be in either cell
        assume(np.abs(place - np.round(place)).min() > 1e-6)
    assert at(grid, [end]) == [1]
    l = grid.log_odds
    assert (l > 0).sum() == 1
    way = np.linspace(0, max(0, length - 2 * RESOLUTION), 50)[:, None] * beam
    i, j = np.floor((pose[:2] + way - grid.origin) / RESOLUTION).astype(int).T
    assert (l[j, i] < 0).mean() > 0.9  # a few lie on the edge of a cell, in either
    j, i = np.nonzero(l)
    middles = grid.origin + RESOLUTION * (np.column_stack([i, j]) + 0.5) - pose[:2]
    assert np.abs(middles @ [-beam[1], beam[0]]).max() < RESOLUTION
    assert (middles @ beam).max() < length + RESOLUTION


def test_after_some_scans_the_room_is_free_and_its_walls_are_not():
    place = np.array([-0.02, 0.03])
    pose = np.append(place, 0.0)
    scan = scan_of([ROOM, CHAIR], pose)
    grid = build([pose] * 5, [scan] * 5, RESOLUTION)
    assert (at(grid, place + scan.points()) == 1).all()
    inside = place + scan.points() * np.linspace(0.05, 0.85, 20)[:, None, None]
    states = at(grid, inside.reshape(-1, 2))
    assert set(states) <= {0, 1} and (states == 0).mean() > 0.95


def test_moved_furniture_vanishes_and_comes_back():
    pose = np.array([-0.02, 0.03, 0.4])
    with_chair, without = scan_of([ROOM, CHAIR], pose), scan_of([ROOM], pose)
    # the side that is seen
    side = np.array([[1.03, y] for y in np.linspace(0.5, 0.8, 4)])
    grid = OccupancyGrid(RESOLUTION)
    for _ in range(40):  # until the clamp holds
        grid.add(pose, with_chair)
    assert (at(grid, side) == 1).all()
    most = ceil((log_odds(CLAMP) - log_odds(FREE)) / -log_odds(MISS))
    for _ in range(most):
        grid.add(pose, without)
    assert (at(grid, side) == 0).all() and most <= 13
    for _ in range(40):
        grid.add(pose, without)
    for _ in range(ceil((log_odds(CLAMP) + log_odds(OCCUPIED)) / log_odds(HIT))):
        grid.add(pose, with_chair)
    assert (at(grid, side) == 1).all()


@pytest.mark.slow
@settings(max_examples=20)
@given(st.permutations(range(6)), st.integers(-40, 40), st.integers(-40, 40))
def test_order_and_growth_change_nothing_and_a_revised_past_moves_the_map(order, i, j):
    source = simulation("corridor", np.random.default_rng(1))
    readings = list(source)[::40]
    scans, where = [r.scan for r in readings], source.truth.poses[::40]
    grid = build(where, scans, RESOLUTION)
    other = build(where[order], [scans[k] for k in order], RESOLUTION)
    np.testing.assert_array_equal(other.origin, grid.origin)
    # in another order the clamp may cut elsewhere; six scans do not reach it
    np.testing.assert_allclose(other.log_odds, grid.log_odds, atol=1e-5)
    moved = build(where + RESOLUTION * np.array([i, j, 0]), scans, RESOLUTION)
    np.testing.assert_allclose(moved.origin, grid.origin + RESOLUTION * np.array([i, j]))
    assert (moved.states == grid.states).mean() > 0.99  # a place on a cell's edge may fall aside


def test_scans_without_a_return_report_nothing():
    grid = OccupancyGrid(RESOLUTION)
    for ranges in (np.full(3, np.nan), np.full(3, np.inf), np.full(3, 9.0), np.zeros(3)):
        grid.add(np.zeros(3), Scan(np.arange(3.0), ranges, range_max=8.0))
    grid.add(np.zeros(3), Scan(np.empty(0), np.empty(0)))
    assert grid.states.shape == (0, 0)


def test_a_map_far_from_the_origin_takes_no_more_room():
    scan = scan_of([ROOM], np.zeros(3))
    far = build([[5e6, -4e6, 0.3]], [scan], RESOLUTION)
    assert far.states.size < 4 * build([[0, 0, 0.3]], [scan], RESOLUTION).states.size


test_wrong_use_is_refused_in_words = refuses(
    lambda use: use(),
    (lambda: OccupancyGrid(0), "above 0 m"),
    (lambda: OccupancyGrid(np.nan), "above 0 m"),
    (lambda: build([[0, np.nan, 0]], [scan_of([ROOM], np.zeros(3))]), "must be finite"),
    (lambda: build([[0, 0, 0], [1e7, 1e7, 0]], [scan_of([ROOM], np.zeros(3))] * 2), "large"),
)


@pytest.fixture(scope="module")
def room():
    """A grid of a room seen from two places."""
    where = np.array([[0.5, 0.2, 0.3], [-1.0, -0.4, 2.0]])
    return build(np.tile(where, (4, 1)), [scan_of([ROOM, CHAIR], pose) for pose in where] * 4, 0.07)


def test_a_map_that_was_loaded_goes_on_being_updated(room, tmp_path):
    grid = map_server.load(map_server.save(room, tmp_path / "map"))
    pose = np.array([0.5, 0.2, 0.3])
    for _ in range(15):
        grid.add(pose, scan_of([ROOM], pose))
    assert at(grid, [[1.03, 0.6]]) == [0]
    assert (grid.states.shape, list(grid.origin)) == (room.states.shape, list(room.origin))


def test_the_files_are_what_map_server_expects(room, tmp_path):
    path = map_server.save(room, tmp_path / "a map.of ours")
    reported = yaml.safe_load(path.read_text())
    assert [reported[key] for key in ("resolution", "negate", "mode")] == [0.07, 0, "trinary"]
    with Image.open(path.parent / reported["image"]) as image:
        assert image.mode == "L" and image.height == len(room.states)
        grey = np.asarray(image)
    assert set(np.unique(grey)) == {0, 205, 254}
    # the lowest row of the picture is the lowest of the map
    x, y, yaw = reported["origin"]
    assert yaw == 0
    for place, pixel in (((0.5, 0.2), 254), ((1.03, 0.6), 0), ((-2.8, -1.0), 254)):
        i, j = int((place[0] - x) // 0.07), int((place[1] - y) // 0.07)
        assert grey[len(grey) - 1 - j, i] == pixel
    p = (255 - grey.astype(float)) / 255
    assert (p[grey == 205] < reported["occupied_thresh"]).all()
    assert (p[grey == 205] > reported["free_thresh"]).all()


def test_a_file_that_cannot_be_written_is_refused(room, tmp_path):
    with pytest.raises(ValueError, match="no cells"):
        map_server.save(OccupancyGrid(), tmp_path / "map")
    with pytest.raises(ValueError, match="cannot be written"):
        map_server.save(room, tmp_path / "missing" / "map")


def test_a_grid_is_drawn_where_it_lies_with_walls_in_its_colour():
    _, ax = views.axes()
    cells = np.array([[1.0, 0.5, 0.0]])
    image, *_ = views.draw(ax, Grid("map", cells, np.array([2.0, 3.0]), 0.5))
    assert image.get_extent() == [2, 3.5, 3, 3.5] and image.origin == "lower"
    wall, unknown, free = image.get_array()[0]
    blue = tuple(int(views.COLOURS["map"][k : k + 2], 16) / 255 for k in (1, 3, 5))
    assert tuple(wall) == pytest.approx(blue) and tuple(free) == (1, 1, 1)
    assert wall.mean() < unknown.mean() < free.mean()
    names = [text.get_text() for text in views.legend(ax).get_texts()]
    assert names == ["map", "unknown"]


def test_a_thin_wall_of_a_large_grid_is_not_lost_in_the_picture():
    _, ax = views.axes()
    cells = np.zeros((1700, 30))
    cells[1234, 17] = 1.0
    image, *_ = views.draw(ax, Grid("map", cells, np.zeros(2), 0.05))
    seen = image.get_array()
    assert seen.shape[0] <= 400 and seen.min() < 0.2
