"""Two laps round a building: odometry edges and loop closures, some of them false. Odometry errors
have mean 0 over all runs, so their mean is the true route."""

import numpy as np

from course.exercises.ex15_pose_graph_slam.edges import sized
from slamlab.geometry import between, compose, wrap
from slamlab.posegraph.edge_error import information

DRIVES, LAP = 16, 12  # drives of a set, poses of a lap
WHEELS = np.array([0.1, 0.06, np.radians(5)])  # σ of a step: ahead, sideways, turn
EYES = np.array([0.05, 0.05, 0.015])  # σ of a true loop [m, m, rad]
GOOD, GANG, STRAY = 10, 6, 2  # true loops, false ones that agree with each other, and others
SLIP = 2.5  # distance of two places that look alike [m]


def laps(rng, drives=DRIVES, poses=2 * LAP, good=GOOD, gang=GANG, stray=STRAY):
    """Runs on one route, with loop closures that are true, false but consistent (gang), or false
    and independent. Odometry: poses (d, n, 3), measured (d, n - 1, 3), information (d, n - 1, 3,
    3); loops: pairs (d, m, 2), seen (d, m, 3), trust (d, m, 3, 3)."""
    steps = _corridors(rng, poses)
    errors = rng.standard_normal((drives, *steps.shape))
    errors = (errors - errors.mean(axis=0)) * np.sqrt(drives / (drives - 1))
    measured = steps + WHEELS * errors
    start = np.append(rng.uniform(-3, 3, 2), rng.uniform(-3, 3))
    true = driven(start, steps)
    found = [_loops(rng, true, good, gang, stray) for _ in range(drives)]
    pairs, seen = (np.array(arrays) for arrays in zip(*found, strict=True))
    return {
        "poses": np.array([driven(start, z) for z in measured]),
        "measured": measured,
        "information": information(measured, np.diag(WHEELS**2)),
        "pairs": pairs,
        "seen": seen,
        "trust": information(seen, np.diag(EYES**2)),
    }


def route(inputs):
    """(n, 3) the true poses."""
    return driven(inputs["poses"][0, 0], inputs["measured"].mean(axis=0))


def driven(start, steps):
    """The poses of a run, step by step."""
    poses = [start]
    for step in steps:
        poses.append(compose(poses[-1], step))
    return np.array(poses)


def _corridors(rng, poses):
    straight = np.tile([2.0, 0.0, 0.0], (poses - 1, 1))
    straight[2::3, 2] = np.pi / 2
    return straight + rng.uniform(-1, 1, (poses - 1, 3)) * [0.3, 0.3, 0.25]


def _loops(rng, true, good, gang, stray):
    kinds = [_gang(rng, true, gang), _true_loops(rng, true, good), _strays(rng, true, stray)]
    pairs, seen = (np.concatenate(arrays) for arrays in zip(*kinds, strict=True))
    # who accepts loops one by one in the given order begins with the gang
    order = np.append(rng.permutation(gang), gang + rng.permutation(len(pairs) - gang))
    seen = seen + EYES * rng.standard_normal(seen.shape)
    seen[:, 2] = wrap(seen[:, 2])
    return pairs[order], seen[order]


def _earlier(rng, later):
    return np.maximum(later - LAP + rng.integers(-1, 2, len(later)), 0)


def _true_loops(rng, true, count):
    first = LAP - 1
    later = first + (np.arange(count) + rng.uniform(0, 1, count)) * (len(true) - first) / max(
        count, 1
    )
    later = later.astype(int)
    earlier = _earlier(rng, later)
    return np.column_stack([earlier, later]), between(true[earlier], true[later])


def _gang(rng, true, count):
    """Consecutive loops that confuse one place with another: all with the same error."""
    later = rng.integers(LAP - 1, len(true) - count + 1) + np.arange(count)
    earlier = _earlier(rng, later)
    slip = np.array([sized(rng, SLIP, SLIP), rng.uniform(-0.3, 0.3), rng.uniform(-0.1, 0.1)])
    first = true[later[:1]]
    believed = compose(compose(first, slip), between(first, true[later]))
    return np.column_stack([earlier, later]), between(true[earlier], believed)


def _strays(rng, true, count):
    later = rng.integers(LAP - 1, len(true), count)
    earlier = _earlier(rng, later)
    slip = np.column_stack([sized(rng, 1, 2.5, (count, 2)), rng.uniform(-0.5, 0.5, count)])
    return np.column_stack([earlier, later]), between(true[earlier], compose(true[later], slip))
