"""Generate a hidden world at random: floor plan, route, robot motion, people, lost scans."""

from itertools import pairwise
from zlib import crc32

import numpy as np

from classroom.project.floor_plans import draw_floor_plan
from classroom.project.furniture_placement import place_furniture
from classroom.project.hidden_worlds import HiddenWorld
from classroom.project.routes import draw_goals, draw_route, length, waypoints
from classroom.project.world_parameters import strata
from slamlab.geometry import compose
from slamlab.readings import Trajectory
from slamlab.simulation.differential_drive import DifferentialDrive, Simulator, follow_waypoints
from slamlab.simulation.worlds.world import World

MAX_READINGS, MAX_METRES = 200, 95.0  # in one world; the path is a little longer than its route
SPACING = 0.4  # distance travelled between readings, rotation included [m]
TURN = 0.5  # distance that a rotation by one radian counts as [m/rad]
PERIOD = 0.25  # of the simulated controller [s]
WORLDS_PER_FAMILY = 5  # the median of their points counts
STEP, APART = 1.6, 0.45  # of people: speed relative to the robot, distance kept from it [1, m]
RUN_OF_LOST_SCANS = 4  # number of consecutive scans that are lost


def generate_world(family, rng, metres):
    """Generate a HiddenWorld of a family with a path of about ``metres`` [m]."""
    plan, furniture, wheels, motion, sensor = rng.spawn(5)
    columns, rows = family.plans[plan.integers(len(family.plans))]
    floor = draw_floor_plan(columns, rows, plan, family.identical_rooms, family.closed)
    goals = draw_goals(floor, plan)
    legs = _draw_legs(floor, goals, family, plan, metres)
    paths = [waypoints(floor, cells, goals) for cells in legs]
    walls, circles = place_furniture(
        floor, paths, furniture, family.identical_rooms, corridors=not family.bare
    )
    world = World(np.concatenate([floor.walls, walls]), circles, family.name)
    truth, metres, odometry, track = _simulate_motion(paths, family, wheels, motion)
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


def generate_worlds(family, seed, count=WORLDS_PER_FAMILY):
    """Yield the worlds of a family, each from a separate random stream of the seed."""
    for k, metres in enumerate(strata(family, count)):
        rng = np.random.default_rng([seed, crc32(family.name.encode()), k])
        yield generate_world(family, rng, metres)


def _draw_legs(floor, goals, family, rng, metres):
    """Draw routes between which the robot is carried; if they are too long, draw again."""
    while True:
        if family.kidnapped:
            first = draw_route(floor, goals, rng, 0.6 * metres, back=False)
            seen = [cell for cell in dict.fromkeys(first[:-4]) if cell not in floor.corridors]
            legs = [first, draw_route(floor, goals, rng, 0.4 * metres, seen, back=False)]
        else:
            legs = [draw_route(floor, goals, rng, metres)]
        if sum(length(waypoints(floor, cells, goals)) for cells in legs) < MAX_METRES:
            return legs


def _simulate_motion(paths, family, wheels, rng):
    """Follow the paths; return truth, distance and odometry of the readings, and all positions."""
    left, right, base = 1 + wheels.standard_normal(3) * family.wheels * np.array([1, 1, 2])
    robot = DifferentialDrive(left_scale=left, right_scale=right, base_scale=base, slip=family.slip)
    poses, motions, carried = [], [], []
    for path in paths:
        ahead = np.arctan2(*(path[1] - path[0])[::-1]) + rng.uniform(-0.5, 0.5)
        simulator = Simulator(robot, rng, [*path[0], ahead])
        carried.append(len(poses))
        poses.append(simulator.pose)
        motions.append(np.zeros(3))
        for _, motion in follow_waypoints(simulator, path[1:], period=PERIOD):
            poses.append(simulator.pose)
            motions.append(motion)
    poses, motions = np.array(poses), np.array(motions)
    steps = np.hypot(*np.diff(poses[:, :2], axis=0, prepend=poses[:1, :2]).T)
    steps[carried] = 0
    gone = np.cumsum(np.hypot(*motions[:, :2].T) + TURN * np.abs(motions[:, 2]))
    count = min(int(gone[-1] / SPACING) + 1, MAX_READINGS - len(paths))
    stops = np.unique([*np.searchsorted(gone, np.linspace(0, gone[-1], count)), *carried])
    odometry = np.zeros((len(stops), 3))
    for n, (i, j) in enumerate(pairwise(stops), 1):
        for motion in motions[i + 1 : j + 1]:
            odometry[n] = compose(odometry[n], motion)
    truth = Trajectory(PERIOD * stops, poses[stops])
    return truth, np.cumsum(steps)[stops], odometry, poses[:, :2]


def _walk_people(track, truth, count, rng):
    """Move people along the robot's path in both directions, at a distance from the robot."""
    starts = rng.uniform(0, 2 * len(track), count)
    positions = starts + np.outer(truth.times / PERIOD, rng.choice([-1, 1], count) * STEP)
    folded = np.abs((positions + len(track)) % (2 * len(track)) - len(track))
    people = track[np.minimum(folded.astype(int), len(track) - 1)]
    people = people + rng.uniform(-0.15, 0.15, (count, 2))
    robot = truth.poses[:, None, :2]
    away = people - robot
    distance = np.maximum(np.hypot(*away.transpose(2, 0, 1)), 1e-6)[..., None]
    return np.where(distance < APART, robot + away / distance * APART, people)


def _lost(count, share, rng):
    """Draw lost scans in groups, but none of the first five scans: (count,) bool."""
    starts = rng.random(count) < share / RUN_OF_LOST_SCANS
    lost = np.convolve(starts, np.ones(RUN_OF_LOST_SCANS))[:count] > 0
    lost[:5] = False
    return lost


def _scatter(floor, count, rng):
    if not count:
        return np.empty((0, 2))
    return np.concatenate(
        [rng.uniform((x1, y1), (x2, y2), (count, 2)) for x1, y1, x2, y2 in floor.cells.values()]
    )
