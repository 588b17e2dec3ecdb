"""Runs for exercise 06: one world and one way, and what can be known of them at the end.

All runs share the world; noise is their own. What a right filter knows at the end is what least
squares over the whole run knows: nothing is lost on the way, nothing counted twice.
"""

import numpy as np
from scipy.linalg import block_diag

from slamlab import models
from slamlab.exercises.tasks.ex06.beliefs import either_sign
from slamlab.filters.landmark_models import POINTS
from slamlab.geometry import wrap
from slamlab.models import jacobians

RUNS, STEPS, LANDMARKS = 20, 8, 4
# which landmarks each scan holds: all but the last are met again, no two scans in a row alike
SCANS = np.array([[1, -1], [1, 0], [0, -1], [2, 1], [0, 2], [-1, -1], [2, 0], [1, 3]])
WHEELS, EYES = np.array([0.04, 0.02]), np.array([0.06, 0.02])  # σ of d, Δθ and of r, β
START = np.array([0.04, 0.05, 0.02])  # σ of the start [m, m, rad]


def runs(rng, behind=False):
    """One world and one way, many runs of it; the last landmark is met at the end only.

    Where they lie behind, the robot drives away from all landmarks and sees them at ±π.

    The truth is in no array. Errors have the mean 0 over all runs, so that it is their middle.
    """
    start = np.array([*either_sign(rng, 0.5, 3, 2), either_sign(rng, 0.3, 2.5)])
    turns = either_sign(rng, 1, 1) * rng.uniform(0.1, 0.4, STEPS)
    drives = np.column_stack([rng.uniform(0.5, 0.8, STEPS), turns])
    if behind:
        drives[:, 1] *= 0.05
    way = driven(start, drives)
    around = rng.uniform(-np.pi, np.pi) + np.arange(LANDMARKS) * 1.6
    far = rng.uniform(3.5, 4.5, (LANDMARKS, 1))
    p = way[:, :2].mean(axis=0) + far * np.column_stack([np.cos(around), np.sin(around)])
    if behind:
        back = start[2] + np.pi + np.array([0.03, -0.02, 0.02, -0.03])
        p = start[:2] + far * np.column_stack([np.cos(back), np.sin(back)])
    return measured(rng, start, drives, p, SCANS, (START, WHEELS, EYES))


def measured(rng, start, drives, p, scans, sigmas, kind=POINTS, draw=None):
    """Many runs of one way among landmarks: what each was told of start, drives and sights.

    Parameters
    ----------
    rng : numpy.random.Generator
    start : (3,), drives : (s, 2), p : (LANDMARKS, 2), all true
    scans : (STEPS, 2) int, rows of p that each scan holds, -1 for none
    sigmas : (3,), (2,), (2,) deviations of start, drives and sights
    kind : LandmarkModel
    draw : (shape) -> errors with variance 1; None: normal ones

    Returns
    -------
    dict of arrays, the task's inputs
    """
    draw = draw or rng.standard_normal
    of_start, of_wheels, of_eyes = sigmas
    way = driven(start, drives)
    names = rng.permutation(np.arange(30, 90))[: len(p)]
    names[:2].sort()  # which are met in the order 1, 0: sorted ids are never right
    z = np.array([kind.h(pose, p[scan]) for pose, scan in zip(way, scans, strict=True)])
    z = z + of_eyes * _errors_of(draw, *z.shape)
    z[..., 1] = wrap(z[..., 1])
    return {
        "x": start + of_start * _errors_of(draw, 3),
        "P": np.diag(of_start**2),
        "u": drives + of_wheels * _errors_of(draw, *drives.shape),
        "seen": np.where(scans < 0, -1, names[scans]),
        "z": z,
        "C": np.diag(of_wheels**2),
        "R": np.diag(of_eyes**2),
    }


def _errors_of(draw, *shape):
    """(RUNS, ...) errors with variance 1 whose mean over the runs is 0."""
    errors = draw((RUNS, *shape))
    return (errors - errors.mean(axis=0)) * np.sqrt(RUNS / (RUNS - 1))


def driven(x, drives):
    """(n, 3) the poses after each of the drives (n, 2)."""
    poses = []
    for u in drives:
        x = models.f_odometry(x, u)
        poses.append(x)
    return np.array(poses)


def truth(inputs, kind=POINTS):
    """What all runs have in common.

    Returns
    -------
    start (3,), drives (n, 2), way (n, 3), landmarks as dict, id to (2,), in the order of meeting
    """
    start, drives = inputs["x"].mean(axis=0), inputs["u"].mean(axis=0)
    way, first = driven(start, drives), inputs["z"][0]
    off = inputs["z"] - first
    off[..., 1] = wrap(off[..., 1])
    z, landmarks = first + off.mean(axis=0), {}
    for pose, seen, sights in zip(way, inputs["seen"].tolist(), z, strict=True):
        for i, sight in zip(seen, sights, strict=True):
            if i >= 0 and i not in landmarks:
                landmarks[i] = kind.g(pose, sight)
    return start, drives, way, landmarks


def least_squares(inputs, kind=POINTS):
    """Least squares over whole runs: what all that was measured says of the end.

    Unknown are the start's error, those of all drives and the landmarks; a pose is a sum of them.
    Everything is linearised at the truth.

    Returns
    -------
    (r, n) estimates minus truth, (n, n) their covariance
    """
    before, drives, way, landmarks = truth(inputs, kind)
    steps, size = len(drives), 2 * len(landmarks)
    unknowns = 3 + 2 * steps + size
    sure = [np.linalg.inv(inputs["P"]), *[np.linalg.inv(inputs["C"])] * steps]
    information = block_diag(*sure, np.zeros((size, size)))
    told = np.column_stack([inputs["x"] - before, *np.swapaxes(inputs["u"] - drives, 0, 1)])
    vector = np.pad(told, ((0, 0), (0, size))) @ information
    weight, D = np.linalg.inv(inputs["R"]), np.eye(3, unknowns)
    first = {i: 3 + 2 * steps + 2 * k for k, i in enumerate(landmarks)}
    for k, (u, pose, seen) in enumerate(zip(drives, way, inputs["seen"].tolist(), strict=True)):
        D = jacobians.A_odometry(before, u) @ D
        D[:, 3 + 2 * k : 5 + 2 * k] += jacobians.W_odometry(before, u)
        for i, z in zip(seen, np.swapaxes(inputs["z"][:, k], 0, 1), strict=True):
            if i >= 0:
                H_r, H_p = kind.H(pose, landmarks[i])
                H = H_r @ D
                H[:, first[i] : first[i] + 2] += H_p
                v = z - kind.h(pose, landmarks[i])
                v[:, 1] = wrap(v[:, 1])
                information += H.T @ weight @ H
                vector += v @ weight @ H
        before = pose
    G = np.vstack([D, np.eye(size, unknowns, 3 + 2 * steps)])
    covariance = np.linalg.inv(information)
    return vector @ covariance @ G.T, G @ covariance @ G.T
