"""Runs for exercise 09: a corridor, whose walls stand in one direction only, driven many times.

Nothing that is seen tells how far the robot has come: what a right filter knows along the corridor
is what the start and the wheels know. All runs share the world; noise is their own.
"""

import numpy as np
from scipy.linalg import block_diag

from slamlab import jacobians, models
from slamlab.checks.tasks.ex06_beliefs import either_sign
from slamlab.geometry import wrap

RUNS, STEPS, WALLS = 20, 8, 4
# left and right as far as a door, then beyond it; the last wall is never first in a scan
SCANS = np.array([[1, -1], [0, 1], [0, -1], [1, 2], [2, 0], [-1, -1], [2, 3], [2, 3]])
WHEELS, EYES = np.array([0.025, 0.01]), np.array([0.015, 0.008])  # σ of d, Δθ and of ρ', α'
START = np.array([0.02, 0.025, 0.01])  # σ of the start [m, m, rad]


def runs(rng):
    """One corridor and one way through it; the truth is in no array, but the middle of all runs."""
    start = np.array([*either_sign(rng, 0.5, 3, 2), either_sign(rng, 0.3, 2.5)])
    weave = 0.12 * np.array([1, -1, -1, 1, 1, -1, -1, 1]) * rng.choice([-1, 1])
    drives = np.column_stack([rng.uniform(0.5, 0.8, STEPS), weave * rng.uniform(0.5, 1, STEPS)])
    way = driven(start, drives)
    side = start[2] + np.array([1, -1, 1, -1]) * np.pi / 2
    walls = models.g_line(
        np.array([*start[:2], 0.0]), np.column_stack([rng.uniform(0.9, 1.6, WALLS), wrap(side)])
    )
    names = rng.permutation(np.arange(30, 90))[:WALLS]
    names[:2].sort()  # which are met in the order 1, 0: sorted ids are never right
    z = np.array([models.h_line(pose, walls[scan]) for pose, scan in zip(way, SCANS, strict=True)])
    z = z + EYES * _errors_of(rng, STEPS, 2, 2)
    z[..., 1] = wrap(z[..., 1])
    return {
        "x": start + START * _errors_of(rng, 3),
        "P": np.diag(START**2),
        "u": drives + WHEELS * _errors_of(rng, STEPS, 2),
        "seen": np.where(SCANS < 0, -1, names[SCANS]),
        "z": z,
        "C": np.diag(WHEELS**2),
        "R": np.diag(EYES**2),
    }


def _errors_of(rng, *shape):
    """(RUNS, ...) errors with variance 1 whose mean over the runs is 0."""
    errors = rng.standard_normal((RUNS, *shape))
    return (errors - errors.mean(axis=0)) * np.sqrt(RUNS / (RUNS - 1))


def driven(x, drives):
    """(n, 3) the poses after each of the drives (n, 2)."""
    poses = []
    for u in drives:
        x = models.f_odometry(x, u)
        poses.append(x)
    return np.array(poses)


def truth(inputs):
    """What all runs have in common.

    Returns
    -------
    start (3,), drives (n, 2), way (n, 3), walls as dict, id to (2,), in the order of meeting
    """
    start, drives = inputs["x"].mean(axis=0), inputs["u"].mean(axis=0)
    way, first = driven(start, drives), inputs["z"][0]
    off = inputs["z"] - first
    off[..., 1] = wrap(off[..., 1])
    z, walls = first + off.mean(axis=0), {}
    for pose, seen, sights in zip(way, inputs["seen"].tolist(), z, strict=True):
        for i, sight in zip(seen, sights, strict=True):
            if i >= 0 and i not in walls:
                walls[i] = models.g_line(pose, sight)
    return start, drives, way, walls


def least_squares(inputs):
    """(n, n) covariance at the end, of all that was measured, linearised at the truth."""
    before, drives, way, walls = truth(inputs)
    unknowns = 3 + 2 * STEPS + 2 * WALLS
    sure = [np.linalg.inv(inputs["P"]), *[np.linalg.inv(inputs["C"])] * STEPS]
    information = block_diag(*sure, np.zeros((2 * WALLS, 2 * WALLS)))
    weight, D = np.linalg.inv(inputs["R"]), np.eye(3, unknowns)
    first = {i: 3 + 2 * STEPS + 2 * k for k, i in enumerate(walls)}
    for k, (u, pose, seen) in enumerate(zip(drives, way, inputs["seen"].tolist(), strict=True)):
        D = jacobians.A_odometry(before, u) @ D
        D[:, 3 + 2 * k : 5 + 2 * k] += jacobians.W_odometry(before, u)
        for i in seen:
            if i >= 0:
                H = jacobians.H_robot_line(pose, walls[i]) @ D
                H[:, first[i] : first[i] + 2] += jacobians.H_line(pose, walls[i])
                information += H.T @ weight @ H
        before = pose
    G = np.vstack([D, np.eye(2 * WALLS, unknowns, 3 + 2 * STEPS)])
    return G @ np.linalg.inv(information) @ G.T
