"""Graph SLAM: true loop closures and no false ones, relocalisation, robustness to odd input."""

from dataclasses import replace

import numpy as np
import pytest

from slamlab import sources
from slamlab.estimators.graph_slam import GraphSlam
from slamlab.estimators.loop_closure import match_information
from slamlab.geometry import between, compose
from slamlab.models.parameters import RobotModel
from slamlab.posegraph import edge_error
from slamlab.readings import Reading, Scan
from slamlab.scanmatching import match, preprocess
from slamlab.scanmatching.submap import build_submap
from slamlab.simulation import worlds
from slamlab.simulation.range_scanners import RPLIDAR_A2, Scanner
from slamlab.simulation.worlds import ring
from slamlab.simulation.worlds.world import World
from tests.slamlab.formats.room_runs import distances_to_walls

EMPTY = Scan(np.linspace(-3, 3, 400), np.full(400, np.nan))


def toured(name, seed=0, change=None):
    """The estimator after a tour, its readings changed if asked for, and the true poses."""
    source = sources.open(f"sim:{name}", np.random.default_rng(seed))
    readings, truth = list(source), source.truth.poses
    if change is not None:
        readings, truth = change(readings, truth)
    slam = GraphSlam(source.robot)
    for reading in readings:
        slam.step(reading)
    return slam, truth


def errors(slam, truth):
    """(n,) how far each pose is from the true one, both seen from the first [m]."""
    poses = slam.trajectory().poses
    e = between(between(truth[0], truth), between(poses[0], poses))
    return np.hypot(e[:, 0], e[:, 1])


def false_loops(slam, truth):
    """Count the loops that disagree with the true poses."""
    true = truth[np.flatnonzero(np.diff(slam.anchors, prepend=-1) > 0)]
    loops = [e for e in slam.graph.edges if e.robust]
    off = [between(between(true[e.i], true[e.j]), e.measured) for e in loops]
    return sum(np.hypot(x, y) > 0.15 or abs(turn) > 0.1 for x, y, turn in off), len(loops)


def test_the_corridor_closes():
    slam, truth = toured("corridor")
    end = errors(slam, truth)[-1]
    false, loops = false_loops(slam, truth)
    assert end < 0.02
    assert errors(slam, truth).max() < 0.1
    assert false == 0
    assert loops > 0


@pytest.mark.slow
def test_without_loops_it_drifts_more():
    with_loops, truth = toured("corridor", 3)
    alone = GraphSlam(with_loops.robot, loops=False)
    for reading in sources.open("sim:corridor", np.random.default_rng(3)):
        alone.step(reading)
    assert errors(with_loops, truth)[-1] < errors(alone, truth)[-1]
    assert not any(edge.robust for edge in alone.graph.edges)


def test_two_similar_rooms_are_not_confused():
    slam, truth = toured("twins")
    false, loops = false_loops(slam, truth)
    assert false == 0
    assert loops > 5
    assert errors(slam, truth).max() < 0.05


@pytest.mark.slow
@pytest.mark.parametrize("name", ["room", "situation-1", "situation-2"])
def test_a_tour_ends_near_the_truth_with_the_same_parameters(name):
    slam, truth = toured(name, 1)
    assert errors(slam, truth).max() < 0.06
    assert slam.counts["scans not matched"] == 0


def test_the_grid_shows_walls_where_they_are():
    slam, _ = toured("room")
    grid = slam.grid(0.05)
    cells = np.argwhere(grid.states == 1)[:, ::-1]
    centres = grid.origin + grid.resolution * (cells + 0.5)
    assert len(cells) > 300
    assert np.mean(distances_to_walls(centres, worlds.room().outline()) < 0.1) > 0.95


def test_nothing_but_empty_scans_is_odometry():
    slam, poses = GraphSlam(RobotModel()), [np.zeros(3)]
    for i in range(5):
        slam.step(Reading(float(i), np.array([0.1, 0.0, 0.1]), EMPTY))
        poses.append(compose(poses[-1], [0.1, 0.0, 0.1]))
    assert np.allclose(slam.trajectory().poses, poses[1:])
    assert slam.skipped == 5
    assert slam.layers()


def kidnapped(readings, truth):
    """A change of a tour: the robot is carried back to where it was before."""
    away, back = int(0.7 * len(readings)), int(0.3 * len(readings))
    order = [*range(away), *range(back, len(readings))]
    moved = [replace(readings[i], time=0.5 * k) for k, i in enumerate(order)]
    moved[away] = replace(moved[away], odometry=np.zeros(3))
    return moved, truth[order]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["room", "situation-1"])
def test_a_kidnapped_robot_is_relocalised(name):
    slam, truth = toured(name, 0, kidnapped)
    assert slam.counts["relocalisations"] == 1
    assert "relocalisation" in slam.status
    assert np.median(errors(slam, truth)[-20:]) < 0.1


def test_every_edge_of_a_graph_has_the_information_of_its_own_error(monkeypatch):
    made, information = [], edge_error.information

    def watched(z, covariance):
        made.append((z, information(z, covariance)))
        return made[-1][1]

    monkeypatch.setattr(edge_error, "information", watched)
    slam, _ = toured("room", 0, kidnapped)
    assert {edge.robust for edge in slam.graph.edges} == {True, False}
    assert slam.counts["relocalisations"] == 1
    strange = [
        edge
        for edge in slam.graph.edges
        if not any(
            np.array_equal(edge.measured, z) and np.array_equal(edge.information, Lam)
            for z, Lam in made
        )
    ]
    # but for one: where the robot was carried nobody knows, in no direction
    assert len(strange) == 1
    x, y = np.diag(strange[0].information)[:2]
    assert x == y < 1e-3


def test_a_loops_information_is_that_of_its_match_seen_from_where_it_leads():
    world, rng, turn = worlds.corridor(), np.random.default_rng(2), np.array([0.2, 0.1, np.pi / 2])
    place = np.array([4.0, 0.0, 0.0])
    new, old = (
        preprocess(RPLIDAR_A2.scan(world, p, rng).points()) for p in (compose(place, turn), place)
    )
    matched = match(new, old, turn)
    along, across = np.diag(matched.covariance)[:2]
    assert along > 20 * across
    x, y = np.diag(match_information(matched))[:2]
    assert x > 2 * y  # the one that looks across the corridor is sure of what lies ahead


def test_a_robot_without_odometry_is_led_by_its_scans():
    def still(readings, truth):
        return [replace(r, odometry=np.zeros(3)) for r in readings[:25]], truth[:25]

    slam, truth = toured("room", 0, still)
    assert errors(slam, truth).max() < 0.05


@pytest.mark.parametrize(
    ("beams", "field", "scale", "far"),
    [
        (180, 180, 4.0, 80.0),
        (682, 240, 0.7, 80.0),
        (3600, 360, 1.0, 80.0),
        (90, 90, 1.0, 8.0),
        (90, 360, 0.25, 1.0),
        (1000, 90, 10.0, 80.0),
    ],
)
def test_other_scanners_and_sizes_need_no_other_parameters(beams, field, scale, far):
    room = worlds.room()
    world = World(room.walls * scale, room.circles * scale)
    lidar = Scanner(
        beams, 0.005, far, np.radians(field), range_error=0.003, range_sigma=0.002 * scale
    )
    rng, pose, slam, truth = np.random.default_rng(0), np.zeros(3), GraphSlam(RobotModel()), []
    for i in range(16):
        motion = np.array([0.12 * scale, 0.0, 0.12 if i > 4 else -0.1]) * (i > 0)
        pose = compose(pose, motion)
        truth.append(pose)
        measured = motion * (1 + 0.04 * rng.standard_normal(3))
        slam.step(Reading(0.1 * i, measured, lidar.scan(world, pose, rng)))
    assert slam.counts["scans not matched"] == 0
    assert errors(slam, np.array(truth)).max() < 0.03 * scale


def test_scans_merged_show_each_wall_once_and_both_its_sides():
    # a wall 5 cm thick is seen from either side; what is matched lies on the side it was seen from
    rooms = [(-3, -2), (0, -2), (0, 2), (-3, 2)], [(0.05, -2), (4, -2), (4, 2), (0.05, 2)]
    rooms = np.vstack([ring(corners) for corners in rooms])
    world, places = World(rooms), np.array([[-1.5, 0.2, 0.0], [2.0, 0.1, 0.4]])
    rng = np.random.default_rng(1)
    scans = [preprocess(RPLIDAR_A2.scan(world, p, rng).points()) for p in places]
    both = build_submap(scans, places)
    assert len(both) < len(scans[0]) + len(scans[1])
    true = np.array([1.8, -0.1, 0.3])
    found = match(RPLIDAR_A2.scan(world, true, rng).points(), both, true + 0.03)
    assert found.good
    assert np.abs(found.pose - true).max() < 0.01
