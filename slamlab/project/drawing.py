"""Drawing a hidden world: its floor and tour, the drive along it, people, what the lidar loses."""

from itertools import pairwise
from zlib import crc32

import numpy as np

from slamlab.geometry import compose
from slamlab.project.floors import draw_floor
from slamlab.project.furniture import furnish
from slamlab.project.hidden_worlds import HiddenWorld
from slamlab.project.tours import draw_goals, draw_tour, length, waypoints
from slamlab.project.world_families import strata
from slamlab.readings import Trajectory
from slamlab.simulation.differential_drive import DifferentialDrive, Simulator, follow
from slamlab.worlds.world import World

MAX_READINGS, MAX_METRES = 200, 95.0  # in one world; a drive is a little longer than its tour
SPACING = 0.4  # of readings, in metres of way; a turn counts as if TURN metres went by [m]
TURN = 0.5  # what a turn of one radian counts as [m/rad]
PERIOD = 0.25  # of the simulated controller [s]
WORLDS_PER_FAMILY = 5  # their median counts
STEP, APART = 1.6, 0.45  # of people: steps of the robot's a period, least distance [1, m]
RUN_OF_LOST_SCANS = 4  # scans lost in a row


def draw_world(family, rng, metres):
    """Draw a world of a family.

    Parameters
    ----------
    family : Family
    rng : numpy.random.Generator
    metres : float, about how long the drive is [m]

    Returns
    -------
    HiddenWorld
    """
    plan, furniture, wheels, drive, sensor = rng.spawn(5)
    columns, rows = family.plans[plan.integers(len(family.plans))]
    floor = draw_floor(columns, rows, plan, family.alike, family.closed)
    goals = draw_goals(floor, plan)
    legs = _draw_legs(floor, goals, family, plan, metres)
    ways = [waypoints(floor, cells, goals) for cells in legs]
    walls, circles = furnish(floor, ways, furniture, family.alike, corridors=not family.bare)
    world = World(np.concatenate([floor.walls, walls]), circles, family.name)
    truth, metres, odometry, track = _drive(ways, family, wheels, drive)
    return HiddenWorld(
        family,
        world,
        truth,
        metres,
        odometry,
        _walk_people(track, truth, family.people, sensor),
        _scatter(floor, family.landmarks, furniture),
        _lost(len(truth), family.lost_scans, sensor),
        family.range_bias * sensor.choice([-1, 1]),
        int(sensor.integers(2**63)),
    )


def draw_family(family, seed, count=WORLDS_PER_FAMILY):
    """Draw the worlds of a family, each from a stream of its own of the seed, by the family's name.

    Parameters
    ----------
    family : Family
    seed : int, of any size
    count : int

    Yields
    ------
    HiddenWorld
    """
    for k, metres in enumerate(strata(family, count)):
        rng = np.random.default_rng([seed, crc32(family.name.encode()), k])
        yield draw_world(family, rng, metres)


def _draw_legs(floor, goals, family, rng, metres):
    """Walks to drive one after the other, carried in between; drawn again where they grew long."""
    while True:
        if family.kidnapped:
            first = draw_tour(floor, goals, rng, 0.6 * metres, back=False)
            seen = [cell for cell in dict.fromkeys(first[:-4]) if cell not in floor.corridors]
            legs = [first, draw_tour(floor, goals, rng, 0.4 * metres, seen, back=False)]
        else:
            legs = [draw_tour(floor, goals, rng, metres)]
        if sum(length(waypoints(floor, cells, goals)) for cells in legs) < MAX_METRES:
            return legs


def _drive(ways, family, wheels, rng):
    """Drive along the ways, carried from one to the next, and stop for readings.

    Returns the readings' true trajectory, metres driven and odometry; and the track (k, 2).
    """
    left, right, base = 1 + wheels.standard_normal(3) * family.wheels * np.array([1, 1, 2])
    robot = DifferentialDrive(left_scale=left, right_scale=right, base_scale=base, slip=family.slip)
    poses, motions, carried = [], [], []
    for way in ways:
        ahead = np.arctan2(*(way[1] - way[0])[::-1]) + rng.uniform(-0.5, 0.5)
        simulator = Simulator(robot, rng, [*way[0], ahead])
        carried.append(len(poses))
        poses.append(simulator.pose)
        motions.append(np.zeros(3))
        for _, motion in follow(simulator, way[1:], period=PERIOD):
            poses.append(simulator.pose)
            motions.append(motion)
    poses, motions = np.array(poses), np.array(motions)
    steps = np.hypot(*np.diff(poses[:, :2], axis=0, prepend=poses[:1, :2]).T)
    steps[carried] = 0
    gone = np.cumsum(np.hypot(*motions[:, :2].T) + TURN * np.abs(motions[:, 2]))
    count = min(int(gone[-1] / SPACING) + 1, MAX_READINGS - len(ways))
    stops = np.unique([*np.searchsorted(gone, np.linspace(0, gone[-1], count)), *carried])
    odometry = np.zeros((len(stops), 3))
    for n, (i, j) in enumerate(pairwise(stops), 1):
        for motion in motions[i + 1 : j + 1]:
            odometry[n] = compose(odometry[n], motion)
    truth = Trajectory(PERIOD * stops, poses[stops])
    return truth, np.cumsum(steps)[stops], odometry, poses[:, :2]


def _walk_people(track, truth, count, rng):
    """Where people are: they walk to and fro along the robot's way, and step aside from it."""
    starts = rng.uniform(0, 2 * len(track), count)
    places = starts + np.outer(truth.times / PERIOD, rng.choice([-1, 1], count) * STEP)
    folded = np.abs((places + len(track)) % (2 * len(track)) - len(track))
    people = track[np.minimum(folded.astype(int), len(track) - 1)]
    people = people + rng.uniform(-0.15, 0.15, (count, 2))
    robot = truth.poses[:, None, :2]
    away = people - robot
    distance = np.maximum(np.hypot(*away.transpose(2, 0, 1)), 1e-6)[..., None]
    return np.where(distance < APART, robot + away / distance * APART, people)


def _lost(count, share, rng):
    """(count,) bool: scans that are lost, some in a row; never the first ones."""
    starts = rng.random(count) < share / RUN_OF_LOST_SCANS
    lost = np.convolve(starts, np.ones(RUN_OF_LOST_SCANS))[:count] > 0
    lost[:5] = False
    return lost


def _scatter(floor, count, rng):
    """Point landmarks anywhere in the cells [m]."""
    if not count:
        return np.empty((0, 2))
    return np.concatenate(
        [rng.uniform((x1, y1), (x2, y2), (count, 2)) for x1, y1, x2, y2 in floor.cells.values()]
    )
