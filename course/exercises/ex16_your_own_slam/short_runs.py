"""Short runs with wheel slip: a corridor with a bend, and a loop of corridors.

Pairs of runs have opposite odometry errors: the mean of their odometry is the true motion.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from course.exercises.ex16_your_own_slam.calls import (
    RANGE_MAX,
    RANGE_MIN,
    SHORT_RANGE,
    integrate_odometry,
    odometry_poses,
)
from slamlab.geometry import between, wrap
from slamlab.simulation.range_scanners import Scanner
from slamlab.simulation.worlds.world import World

LIDAR = Scanner(
    beams=120,
    range_min=RANGE_MIN,
    range_max=RANGE_MAX,
    range_error=0.008,
    range_sigma=0.005,
    bearing_sigma=np.radians(0.3),
    dropouts=0.01,
)
SHORT_SIGHTED = replace(LIDAR, range_max=SHORT_RANGE)
STEP = 0.5  # distance between readings [m]
WIDTH = 2.0  # of corridors [m]
LAST = 5  # number of poses at the end that are judged
BAD = 0.9  # least mean error of odometry over these poses [m]
ODOMETRY = np.array([0.03, 0.004, 0.035])  # σ of a step's error in the corridors [m, m, rad]
RADIUS = 2.0  # of the bend of a corridor [m]


def corridor(rng, steps=24, bend=2.5, lost=(), runs=2, scale=0.0, bad=BAD):
    """Return runs along a corridor with niches and a bend: odometry (runs, n, 3) [m, m, rad],
    ranges (runs, n, beams) [m], NaN: no return. bend : distance from the start [m]; lost :
    readings whose scan is lost; scale : scale error of odometry; bad : least mean error of odometry
    over the last poses [m].
    """
    length, turn = steps * STEP, rng.choice([-1, 1]) * rng.uniform(1.1, 1.35)
    sides = [_side(rng, -3.0, length + 3.0, y) for y in (-WIDTH / 2, WIDTH / 2)]
    ends = [[-3, -1, -3, 1], [length + 3, -1, length + 3, 1]]
    walls = np.concatenate([*sides, ends]).reshape(-1, 2)
    world = World(_bent(walls, bend, turn)[:, :2].reshape(-1, 4))
    x = STEP * np.arange(steps + 1)
    phase, high = rng.uniform(0, 2 * np.pi), rng.uniform(0.1, 0.3)
    truth = _bent(np.column_stack([x, high * np.sin(0.7 * x + phase)]), bend, turn)
    truth[:, 2] += np.arctan(0.7 * high * np.cos(0.7 * x + phase))
    while True:
        errors = ODOMETRY * rng.standard_normal((runs // 2, *truth.shape)) + [scale * STEP, 0, 0]
        inputs = _measured(rng, world, truth, errors, lost)
        if off_at_the_end(inputs, odometry_poses(inputs)).min() > bad:
            return inputs


def ring(rng, around=(9.0, 6.0), beyond=4.0, blind=12):
    """Return two runs round a block and past the start, in the format of :func:`corridor`.
    ``blind`` consecutive scans are lost: the scans before and after do not overlap.
    around : sides of the loop [m]; beyond : distance driven past the start [m].
    """
    a, b = around
    corners = np.array([[0, 0], [a, 0], [a, b], [0, b], [0, 0]], dtype=float)
    start = np.array([rng.uniform(2.0, 3.0), 0.0])
    way = np.concatenate([start[None], corners[1:], [[start[0] + beyond, 0.0]]])
    sides = []
    for h in (-WIDTH / 2, WIDTH / 2):  # outer and inner walls
        sides += [_side(rng, h, a - h, y) for y in (h, b - h)]
        sides += [_side(rng, h, b - h, x)[:, [1, 0, 3, 2]] for x in (h, a - h)]
    world = World(np.concatenate(sides))
    truth = _along(way)
    turns = np.flatnonzero(np.abs(wrap(np.diff(truth[:, 2]))) > 0.5)
    lost = turns[0] - blind // 2 + np.arange(blind)  # round the first corner
    turned = rng.choice([-1, 1]) * rng.uniform(0.1, 0.11)
    while True:
        errors = [0.008, 0.004, 0.014] * rng.standard_normal(truth.shape)  # [m, m, rad]
        errors[lost, 2] = turned / blind  # a heading error of either sign
        inputs = _measured(rng, world, truth, errors[None], lost, SHORT_SIGHTED)
        if off_at_the_end(inputs, odometry_poses(inputs)).min() > 0.3:
            return inputs


def route(inputs):
    """Return (n, 3) the true poses, relative to the first pose."""
    return integrate_odometry(inputs["odometry"].mean(axis=0))


def length(inputs):
    """Return the length of the true trajectory [m]."""
    return float(np.hypot(*np.diff(route(inputs)[:, :2], axis=0).T).sum())


def off_at_the_end(inputs, trajectories):
    """Return (runs,) mean errors [m] of the last :data:`LAST` poses of trajectories."""
    return offs(inputs, trajectories)[:, -LAST:].mean(axis=1)


def offs(inputs, trajectories):
    """Return (runs, n) position errors of all poses, relative to the first pose [m]."""
    seen = np.array([between(poses[0], poses) for poses in trajectories])
    return np.hypot(*np.moveaxis((seen - route(inputs))[..., :2], -1, 0))


def _measured(rng, world, truth, errors, lost, lidar=LIDAR):
    steps = between(truth[:-1], truth[1:])
    odometry = np.zeros((2 * len(errors), len(truth), 3))
    odometry[:, 1:] = np.concatenate([steps + errors[:, 1:], steps - errors[:, 1:]])
    ranges = np.array([[lidar.scan(world, pose, rng).ranges for pose in truth] for _ in odometry])
    ranges[:, list(lost)] = np.nan
    return {"odometry": odometry, "ranges": ranges}


def _along(way):
    poses = []
    for begin, end in pairwise(way):
        heading = np.arctan2(*(end - begin)[::-1])
        length = np.hypot(*(end - begin))
        if poses:
            half = poses[-1][2] + wrap(heading - poses[-1][2]) / 2
            poses.append(np.array([*begin, wrap(half)]))
        for t in np.arange(0, length - STEP / 2, STEP):
            poses.append(np.array([*(begin + (end - begin) * t / length), heading]))
    return np.array(poses)


def _bent(points, begin, turn):
    """Bend what lies along x to an arc from x = begin: return (n, 3) points and directions."""
    along, arc, sign = points[:, 0] - begin, RADIUS * abs(turn), np.sign(turn)
    angle = turn * np.clip(along / arc, 0, 1)
    straight = np.maximum(along - arc, 0)
    x = begin + np.minimum(along, 0) + sign * RADIUS * np.sin(angle) + straight * np.cos(turn)
    y = sign * RADIUS * (1 - np.cos(angle)) + straight * np.sin(turn)
    return np.column_stack(
        [x - points[:, 1] * np.sin(angle), y + points[:, 1] * np.cos(angle), angle]
    )


def _side(rng, begin, end, y):
    """Return (k, 4) a wall along x at y, with niches on the outside."""
    corners, x = [(begin, y)], begin + rng.uniform(0.5, 1.5)
    while x + 1.2 < end:
        wide, deep = rng.uniform(0.4, 0.9), np.sign(y) * rng.uniform(0.2, 0.5)
        corners += [(x, y), (x, y + deep), (x + wide, y + deep), (x + wide, y)]
        x += wide + rng.uniform(0.8, 2.0)
    corners = np.array([*corners, (end, y)])
    return np.hstack([corners[:-1], corners[1:]])
