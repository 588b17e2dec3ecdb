"""Short drives for the milestones: a corridor and a ring of corridors, on wheels that slip.

The two drives of a set follow one way. The truth is in no array: what the wheels of one say too
much, those of the other say too little, so the mean of both is where they drove.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from slamlab.exercises.drives.ex16 import RANGE_MAX, RANGE_MIN, SHORT_RANGE, by_wheels
from slamlab.geometry import between, wrap
from slamlab.simulation.range_scanners import Scanner
from slamlab.worlds.world import World

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
STEP = 0.5  # of way between readings [m]
WIDTH = 2.0  # of corridors [m]
LAST = 5  # poses at the end that are judged
BAD = 0.5  # by so much the wheels are off there, at least [m]
WHEELS = np.array([0.008, 0.004, 0.035])  # σ of what a step's odometry is off [m, m, rad]


def corridor(rng, steps=18, lost=()):
    """Two drives along a corridor with niches on both sides.

    Parameters
    ----------
    rng : numpy.random.Generator
    steps : int, between readings
    lost : ints, readings whose scan is lost

    Returns
    -------
    dict of odometry (2, n, 3) [m, m, rad] and ranges (2, n, beams) [m], NaN where nothing came back
    """
    length = steps * STEP
    sides = [_side(rng, -3.0, length + 3.0, y) for y in (-WIDTH / 2, WIDTH / 2)]
    ends = [[-3, -1, -3, 1], [length + 3, -1, length + 3, 1]]
    world = World(np.concatenate([*sides, np.array(ends, dtype=float)]))
    x = STEP * np.arange(steps + 1)
    phase, high = rng.uniform(0, 2 * np.pi), rng.uniform(0.1, 0.3)
    y = high * np.sin(0.7 * x + phase)
    truth = np.column_stack([x, y, np.arctan(0.7 * high * np.cos(0.7 * x + phase))])
    while True:
        errors = WHEELS * rng.standard_normal(truth.shape)
        inputs = _measured(rng, world, truth, errors, lost)
        if off_at_the_end(inputs, [by_wheels(u) for u in inputs["odometry"]]).min() > BAD:
            return inputs


def ring(rng, around=(5.5, 4.0), beyond=3.0, blind=10):
    """Two drives round a block, until the way's beginning is seen again; blind on a stretch of it.

    What is seen before that stretch and what is seen after it have next to nothing in common.

    Parameters
    ----------
    rng : numpy.random.Generator
    around : (2,) sides of the way round [m]
    beyond : float, how far it goes on behind its start [m]
    blind : int, readings in a row whose scans are lost

    Returns
    -------
    as :func:`corridor`
    """
    a, b = around
    corners = np.array([[0, 0], [a, 0], [a, b], [0, b], [0, 0]], dtype=float)
    start = np.array([rng.uniform(1.5, 2.5), 0.0])
    way = np.concatenate([start[None], corners[1:], [[start[0] + beyond, 0.0]]])
    h = WIDTH / 2
    sides = [_side(rng, -h, a + h, y) for y in (-h, b + h)]
    sides += [_side(rng, -h, b + h, x)[:, [1, 0, 3, 2]] for x in (-h, a + h)]
    inner = np.array([[h, h, a - h, h], [a - h, h, a - h, b - h], [a - h, b - h, h, b - h],
                      [h, b - h, h, h]])  # fmt: skip
    world = World(np.concatenate([*sides, inner]))
    truth = _along(way)
    turns = np.flatnonzero(np.abs(wrap(np.diff(truth[:, 2]))) > 0.5)
    lost = turns[2] - blind // 2 + np.arange(blind)  # round the second corner
    turned = rng.choice([-1, 1]) * rng.uniform(0.09, 0.1)
    while True:
        errors = WHEELS * [1, 1, 0.4] * rng.standard_normal(truth.shape)
        errors[lost, 2] = turned / blind  # there it turns by too much, or by too little
        inputs = _measured(rng, world, truth, errors, lost, SHORT_SIGHTED)
        if off_at_the_end(inputs, [by_wheels(u) for u in inputs["odometry"]]).min() > BAD:
            return inputs


def route(inputs):
    """(n, 3) the poses as they were in truth, as seen from the first."""
    return by_wheels(inputs["odometry"].mean(axis=0))


def length(inputs):
    """The way that was driven [m]."""
    return float(np.hypot(*np.diff(route(inputs)[:, :2], axis=0).T).sum())


def off_at_the_end(inputs, trajectories):
    """How far the last poses of each drive are off, seen from the first.

    Parameters
    ----------
    inputs : as of :func:`corridor`
    trajectories : (2, n, 3) [m, m, rad]

    Returns
    -------
    (2,) mean over the last :data:`LAST` poses [m]
    """
    return offs(inputs, trajectories)[:, -LAST:].mean(axis=1)


def offs(inputs, trajectories):
    """How far each pose is off, seen from the first: (2, n) [m]."""
    seen = np.array([between(poses[0], poses) for poses in trajectories])
    return np.hypot(*np.moveaxis((seen - route(inputs))[..., :2], -1, 0))


def _measured(rng, world, truth, errors, lost, lidar=LIDAR):
    steps = between(truth[:-1], truth[1:])
    odometry = np.zeros((2, len(truth), 3))
    odometry[:, 1:] = steps + errors[1:], steps - errors[1:]
    ranges = np.array([[lidar.scan(world, pose, rng).ranges for pose in truth] for _ in range(2)])
    ranges[:, list(lost)] = np.nan
    return {"odometry": odometry, "ranges": ranges}


def _along(way):
    """Poses along a way of straight legs: a step apart, with a stop to turn at each corner."""
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


def _side(rng, begin, end, y):
    """A wall along x at y with niches to the outside: (k, 4)."""
    corners, x = [(begin, y)], begin + rng.uniform(0.5, 1.5)
    while x + 1.2 < end:
        wide, deep = rng.uniform(0.4, 0.9), np.sign(y) * rng.uniform(0.2, 0.5)
        corners += [(x, y), (x, y + deep), (x + wide, y + deep), (x + wide, y)]
        x += wide + rng.uniform(0.8, 2.0)
    corners = np.array([*corners, (end, y)])
    return np.hstack([corners[:-1], corners[1:]])
