"""Generated worlds: paths cross no wall, readings contain no truth, a seed determines a world."""

import dataclasses
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from classroom.project.floor_plans import draw_floor_plan
from classroom.project.routes import draw_goals, draw_route, waypoints
from classroom.project.world_generation import MAX_READINGS, generate_worlds
from classroom.project.world_parameters import LANDMARKS, WORLD_FAMILIES, WorldFamily, strata
from slamlab.geometry import compose

ALL = [*WORLD_FAMILIES.values(), LANDMARKS]
PLANS = {plan for family in ALL for plan in family.plans}


@cache
def drawn(family):
    """A world of a family, the same for all tests."""
    return next(generate_worlds(family, seed=17, count=1))


@pytest.fixture(params=ALL, ids=lambda family: family.name)
def world(request):
    """A world of each family in turn."""
    return drawn(request.param)


def crosses(a, b, walls):
    """Whether the way from a to b crosses any wall."""

    def side(p, q, r):
        return np.sign(
            (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1])
            - (q[..., 1] - p[..., 1]) * (r[..., 0] - p[..., 0])
        )

    c, d = walls[:, :2], walls[:, 2:]
    return bool(((side(a, b, c) * side(a, b, d) < 0) & (side(c, d, a) * side(c, d, b) < 0)).any())


def steps(world):
    return np.hypot(*np.diff(world.truth.poses[:, :2], axis=0).T)


def test_the_path_never_crosses_or_touches_a_wall(world):
    carried = np.flatnonzero(steps(world) > 1.5)
    for i, pose in enumerate(world.truth.poses):
        clearance = world.floor.cast(pose[:2], np.linspace(0, 2 * np.pi, 72)).min()
        assert clearance > 0.15, f"{clearance:.2f} m at reading {i}"
        # between readings the robot turns corners: by straight lines only where it drove straight
        if i and i - 1 not in carried and abs(world.odometry[i][2]) < 0.1:
            before = world.truth.poses[i - 1]
            assert not crosses(before[:2], pose[:2], world.floor.outline())
    assert len(carried) == int(world.family.kidnapped)


def test_a_path_has_20_to_100_m_and_at_most_200_readings(world):
    assert 20 < world.metres[-1] < 100
    assert len(world) <= MAX_READINGS
    assert np.all(np.diff(world.metres) >= 0)
    assert np.all(np.diff(world.truth.times) > 0)


def test_an_increment_of_odometry_is_the_true_motion_within_a_few_centimetres(world):
    distances = np.hypot(*world.odometry[1:, :2].T)
    true = steps(world)
    assert np.all(np.abs(distances - true)[true < 1.5] < 0.1)
    assert np.all(world.odometry[0] == 0)


def test_odometry_alone_is_lost():
    world = drawn(WORLD_FAMILIES["plain"])
    pose = world.truth.poses[0]
    for motion in world.odometry:
        pose = compose(pose, motion)
    assert np.hypot(*(pose - world.truth.poses[-1])[:2]) > 0.5


@pytest.mark.slow
@pytest.mark.parametrize("name", ["plain", "people", "dropouts"])
def test_a_seed_is_a_world_and_every_iteration_yields_the_same(name):
    one, two = (
        next(generate_worlds(WORLD_FAMILIES[name], seed=2**255 + 3, count=1)) for _ in range(2)
    )
    other = next(generate_worlds(WORLD_FAMILIES[name], seed=2**255 + 4, count=1))
    np.testing.assert_array_equal(one.floor.walls, two.floor.walls)
    np.testing.assert_array_equal(one.truth.poses, two.truth.poses)
    for i in (0, 7, 3):
        np.testing.assert_array_equal(one.reading(i).scan.ranges, two.reading(i).scan.ranges)
    assert not np.array_equal(other.floor.walls, one.floor.walls)


def test_a_world_does_not_change_with_the_number_of_worlds_nor_with_other_families():
    few = list(strata(WORLD_FAMILIES["plain"], 5))
    assert few == sorted(few)
    families = WORLD_FAMILIES["plain"], WorldFamily("plain")
    one, other = (next(generate_worlds(family, 3)).truth.poses for family in families)
    np.testing.assert_array_equal(one, other)


def test_a_reading_contains_no_truth_and_shares_no_data_with_the_world(world):
    reading = world.reading(5)
    given = {field.name for field in dataclasses.fields(reading)}
    assert given == {"time", "odometry", "scan", "observations", "control"}
    reading.odometry[:] = 1e6
    assert np.abs(world.reading(5).odometry).max() < 10
    assert not any(np.may_share_memory(reading.odometry, row) for row in world.truth.poses)


def test_a_reading_is_generated_only_on_request(monkeypatch):
    asked = []
    world = drawn(WORLD_FAMILIES["plain"])
    monkeypatch.setattr(type(world), "reading", lambda self, i: asked.append(i))
    readings = iter(world)
    next(readings)
    next(readings)
    assert asked == [0, 1]


def test_ranges_are_off_by_the_bias_of_the_family():
    biased = drawn(WORLD_FAMILIES["range-bias"])
    true = dataclasses.replace(biased, bias=0.0)
    ratio = biased.reading(3).scan.ranges / true.reading(3).scan.ranges
    assert abs(biased.bias) == 0.01
    np.testing.assert_allclose(ratio[np.isfinite(ratio)], 1 + biased.bias)


def test_people_hide_walls_and_keep_off_the_robot():
    world = drawn(WORLD_FAMILIES["people"])
    away = np.hypot(*(world.people - world.truth.poses[:, None, :2]).transpose(2, 0, 1))
    assert away.min() > 0.4
    empty = dataclasses.replace(world, people=world.people[:, :0])
    differ = [
        np.nanmax(np.abs(world.reading(i).scan.ranges - empty.reading(i).scan.ranges))
        for i in range(0, len(world), 10)
    ]
    assert max(differ) > 0.3


def test_landmarks_come_with_ids_instead_of_a_scan_and_only_where_no_wall_hides_them():
    world = drawn(LANDMARKS)
    seen = [world.reading(i) for i in range(0, len(world), 5)]
    assert all(reading.scan is None for reading in seen)
    assert sum(len(reading.observations.ids) for reading in seen) > len(seen)
    assert all((reading.observations.ids < len(world.landmarks)).all() for reading in seen)


@pytest.mark.parametrize("plan", sorted(PLANS), ids="-".join)
@pytest.mark.parametrize("seed", range(5))
def test_every_room_with_a_door_can_be_reached_and_paths_run_through_doors(plan, seed):
    rng = np.random.default_rng(seed)
    floor = draw_floor_plan(*plan, rng, closed=0.3)
    goals = draw_goals(floor, rng)
    cells = draw_route(floor, goals, rng, 60.0)
    assert cells[0] == cells[-1]
    assert all(pair in floor.passages for pair in pairwise(cells))
    way = waypoints(floor, cells, goals)
    for a, b in pairwise(way):
        assert not crosses(a, b, floor.walls)


def test_identical_rooms_have_one_size():
    floor = draw_floor_plan("rcr", "rcr", np.random.default_rng(0), identical=True)
    sizes = [np.subtract(c[2:], c[:2]) for k, c in floor.cells.items() if k not in floor.corridors]
    np.testing.assert_allclose(sizes, sizes[:1] * len(sizes))


@pytest.mark.parametrize(
    ("plan", "message"),
    [("rr", "at least one c"), ("rx", "must consist of r and"), ("crc", "two rooms")],
)
def test_a_plan_without_a_possible_route_is_refused(plan, message):
    with pytest.raises(ValueError, match=message):
        draw_floor_plan(plan, plan, np.random.default_rng(0))


def test_routes_that_are_too_long_are_refused():
    with pytest.raises(ValueError, match="20 to 70 m"):
        WorldFamily("endless", metres=(50.0, 500.0))
