"""A lidar carried by hand: the walk is a person's, the truth is where each beam was measured."""

from dataclasses import replace

import numpy as np
import pytest

from slamlab.devices.clock import SimulatedClock
from slamlab.files import SourceError
from slamlab.geometry import compose
from slamlab.simulation import worlds
from slamlab.simulation.pedestrian_gait import Walk
from slamlab.simulation.pedestrians import BODY, WALKS, Carrier, Pedestrians, carrier
from slamlab.simulation.range_scanners import RPLIDARS
from slamlab.simulation.worlds.world import World
from slamlab.sources import open as open_source
from slamlab.sources.emulated_devices import EmulatedDevices
from slamlab.sources.handheld_lidar import HandheldLidar
from tests.slamlab.formats.room_runs import distances_to_walls

SILENT = {"range_error": 0.0, "range_curvature": 0.0, "range_sigma": 0.0, "bearing_sigma": 0.0}
NOISELESS = replace(RPLIDARS["C1"], **SILENT, dropouts=0.0)
CARRIER_REACH = 0.8  # of the lidar's own carrier [m]


def rng(seed=0):
    return np.random.default_rng(seed)


def every(seconds, walk):
    times = np.arange(0, walk.duration, seconds)
    return times, walk.pose_at(times)


def off_the_walls(world, points):
    """Distances (n,) of points (n, 2) to the nearest wall or circle [m]."""
    rims = np.hypot(*np.moveaxis(points[:, None] - world.circles[:, :2], 2, 0))
    to_circles = np.abs(rims - world.circles[:, 2]).min(axis=1)
    return np.minimum(distances_to_walls(points, world.walls), to_circles)


def placed(reading, body):
    """The points (k, 2) of a scan, each from where the body was when it was measured."""
    scan = reading.scan
    seen = scan.valid & ~own(scan)
    poses = body.pose_at(reading.time + scan.times[seen])
    r, a = scan.ranges[seen], scan.angles[seen]
    return compose(poses, np.column_stack([r * np.cos(a), r * np.sin(a), 0 * a]))[:, :2]


def own(scan):
    """(n,) mask of the beams that may meet who carries the lidar."""
    with np.errstate(invalid="ignore"):
        return (np.abs(np.abs(scan.angles) - np.pi) < 0.5) & (scan.ranges < CARRIER_REACH)


@pytest.mark.parametrize("flat", WALKS)
@pytest.mark.parametrize("speed", [0.6, 0.85, 1.1])
def test_a_person_walks_no_faster_and_turns_no_quicker_than_people_do(flat, speed):
    for seed in range(3):
        walk = Walk(WALKS[flat], rng(seed), speed=speed)
        times, poses = every(0.01, walk)
        steps = np.diff(poses, axis=0) / 0.01
        step_lengths = np.hypot(*steps[:, :2].T)
        assert step_lengths.max() < 1.4
        assert np.abs(steps[:, 2]).max() < 1.6
        assert np.abs(np.diff(step_lengths)).max() / 0.01 < 6  # nothing jumps [m/s²]
        assert 0.4 < walk.length / walk.duration < 1.1
        assert 40 < walk.length < 80
        assert np.hypot(*walk.tilt_at(times).T).max() <= np.radians(6) + 1e-12


@pytest.mark.parametrize("flat", WALKS)
def test_the_walk_begins_standing_at_the_origin_and_touches_nothing(flat):
    world = worlds.by_name(flat)
    for seed in range(3):
        walk = Walk(WALKS[flat], rng(seed))
        np.testing.assert_allclose(walk.pose_at(np.array([0.0, 0.2])), 0, atol=1e-9)
        assert off_the_walls(world, every(0.05, walk)[1][:, :2]).min() > 0.2


@pytest.mark.parametrize("flat", WALKS)
def test_every_room_is_entered(flat):
    """From somewhere on the walk every piece of floor is seen."""
    world, walk = worlds.by_name(flat), Walk(WALKS[flat], rng())
    places = every(1.0, walk)[1][:, :2]
    low, high = world.walls[:, :2].min(axis=0), world.walls[:, :2].max(axis=0)
    floor = rng().uniform(low, high, (300, 2))
    seen = np.zeros(len(floor), dtype=bool)
    for place in places:
        way = floor - place
        ranges = world.cast(place, np.arctan2(*way.T[::-1]))
        seen |= ranges > np.hypot(*way.T)
    assert seen.mean() > 0.75  # the rest is within furniture, or behind it


@pytest.mark.parametrize("flat", WALKS)
def test_pedestrians_keep_their_distance_and_move_continuously(flat):
    for seed in range(3):
        body = carrier(flat, rng(seed))
        times, poses = every(0.05, body.walk)
        people = body._pedestrians.at(times)[..., :2]
        assert np.hypot(*np.moveaxis(people - poses[:, None, :2], 2, 0)).min() > 0.6
        assert np.hypot(*np.moveaxis(np.diff(people, axis=0), 2, 0)).max() / 0.05 <= 1.6


def test_readings_have_no_odometry_and_the_truth_begins_at_the_origin():
    source = HandheldLidar("flat", rng())
    reading = next(iter(source))
    assert not source.has_odometry
    assert reading.odometry is None
    np.testing.assert_array_equal(source.truth.poses[0], np.zeros(3))
    assert len(source) == len(source.truth)
    assert reading.time == source.truth.times[0]


@pytest.mark.parametrize("name", RPLIDARS)
def test_the_beams_of_successive_revolutions_are_contiguous(name):
    source = HandheldLidar("flat-3", rng(), lidar=RPLIDARS[name])
    step = 1 / (source.lidar.beams * source.lidar.rate)
    turns = [source._reading(i) for i in (4, 5)]
    times = np.concatenate([turn.time + turn.scan.times for turn in turns])
    np.testing.assert_allclose(np.diff(times), step, rtol=1e-6)
    scan = turns[1].scan
    assert scan.times[-1] == 0
    np.testing.assert_allclose(np.diff(np.unwrap(scan.angles)), -2 * np.pi / source.lidar.beams)
    assert np.mean(scan.valid) > 0.9


@pytest.mark.parametrize("flat", WALKS)
def test_without_noise_each_point_lies_on_a_wall_from_where_it_was_measured(flat):
    source = HandheldLidar(flat, rng(1), lidar=NOISELESS, tilt=0.0, people=0)
    for i in range(0, len(source), 40):
        points = placed(source._reading(i), source.walk)
        assert len(points) > 300
        assert off_the_walls(source.world, points).max() < 1e-6


@pytest.mark.parametrize(("name", "sigma"), [("A1", 0.03), ("A2", 0.004), ("C1", 0.015)])
def test_with_a_models_noise_the_points_lie_about_the_walls(name, sigma):
    source = HandheldLidar("flat", rng(2), lidar=RPLIDARS[name], tilt=0.0, people=0)
    off = np.concatenate(
        [off_the_walls(source.world, placed(source._reading(i), source.walk)) for i in (50, 200)]
    )
    assert 0.1 * sigma < np.median(off) < sigma


def test_a_tilted_lidar_measures_longer_ranges_and_only_a_little():
    cylinder = World(circles=[(0.0, 0.0, 5.0)])
    walk = Walk([(0.0, 0.0), (1.0, 0.0)], rng(), stops=0)
    body = Carrier(cylinder, walk, Pedestrians([], walk, rng()), begin=0.0)
    bearings = np.linspace(-2.5, 2.5, 200)  # not where the carrier is
    longest = []
    for time in np.linspace(0, 0.9, 40):  # it stands
        ranges = body.cast(np.full(200, time), np.zeros((200, 3)), bearings)
        assert ranges.min() >= 5 - 1e-9
        longest.append(ranges.max())
    assert 5.001 < max(longest) <= 5 / np.cos(np.radians(6)) + 1e-9


def test_the_carrier_stands_behind_the_lidar():
    source = HandheldLidar("flat", rng(), lidar=NOISELESS, people=0)
    for i in range(0, len(source), 100):
        scan = source._reading(i).scan
        behind = np.argmax(np.abs(scan.angles))
        assert 0.25 < scan.ranges[behind] < -BODY[0]


def test_pedestrians_are_measured_at_their_positions():
    alone, among = (
        HandheldLidar("flat", rng(3), lidar=NOISELESS, tilt=0.0, people=people) for people in (0, 2)
    )
    met = 0
    for i in range(0, len(among), 20):
        reading = among._reading(i)
        scan = reading.scan
        other = np.abs(scan.ranges - alone._reading(i).scan.ranges) > 1e-6
        met += other.sum()
        circles = among.body._pedestrians.at(reading.time + scan.times[other])
        seen = replace(reading, scan=replace(scan, ranges=np.where(other, scan.ranges, np.nan)))
        points = placed(seen, among.walk)
        off = np.hypot(*np.moveaxis(points[:, None] - circles[..., :2], 2, 0)) - circles[..., 2]
        np.testing.assert_allclose(np.abs(off).min(axis=1), 0, atol=1e-6)
    assert met > 100


@pytest.mark.parametrize("flat", WALKS)
def test_the_same_seed_gives_the_same_run_whatever_was_read_before(flat):
    first, second, another = (open_source(f"sim:{flat}-carried", rng(s)) for s in (4, 4, 5))
    second._reading(7)
    a, b, c = (source._reading(3).scan.ranges for source in (first, second, another))
    np.testing.assert_array_equal(a, b)
    assert not np.array_equal(a, c, equal_nan=True)
    np.testing.assert_array_equal(first.truth.poses, second.truth.poses)
    assert not np.array_equal(first.truth.poses[-100], another.truth.poses[-100])


def test_the_emulated_lidar_is_carried_on_the_same_walk_without_a_robot():
    world = worlds.by_name("flat-2")
    with EmulatedDevices(world, rng(), clock=SimulatedClock(), carried=True) as source:
        readings = [reading for reading, _ in zip(source, range(30), strict=False)]
        truth = source.truth
        assert not source.drivable
        with pytest.raises(SourceError, match="cannot be driven"):
            source.drive((0.1, 0.0))
    np.testing.assert_array_equal(truth.poses[0], np.zeros(3))
    assert 1.0 < np.hypot(*truth.poses[-1, :2]) < 6.0
    assert len(readings[-1].scan.ranges) > 700


def test_the_emulated_walk_ends(monkeypatch):
    monkeypatch.setitem(WALKS, "flat", [(0.0, 0.0), (0.3, 0.0)])
    world = worlds.flat()
    with EmulatedDevices(world, rng(), clock=SimulatedClock(), carried=True) as source:
        readings = list(source)
    assert readings[-1].time == pytest.approx(source.bench.body.walk.duration, abs=0.3)
