"""Runs for exercise 06 in one world on one trajectory, and least squares over whole runs."""
# A right filter knows at the end what least squares over the whole run knows.

import numpy as np
from scipy.linalg import block_diag

from course.exercises.ex06_ekf_slam.beliefs import either_sign
from slamlab import models
from slamlab.filters.landmark_models import POINTS
from slamlab.geometry import wrap
from slamlab.models import jacobians

RUNS, STEPS, LANDMARKS = 20, 8, 4
# which landmarks each scan holds: two new ones at once, three of which one is new; all but the last
# are met again
SCANS = np.array(
    [[1, 0, -1], [0, 1, -1], [0, 2, 1], [2, 1, -1], [-1] * 3, [2, 0, -1], [-1] * 3, [1, 3, 0]]
)
# σ of d, Δθ and of r, β: a scan corrects the prediction by several σ of the corrected pose
WHEELS, EYES = np.array([0.15, 0.02]), np.array([0.06, 0.02])
START = np.array([0.04, 0.05, 0.02])  # σ of the start [m, m, rad]


def runs(rng, behind=False, eyes=EYES, wheels=WHEELS, draw=None):
    """Many runs on one trajectory; the last landmark is measured at the end only. ``behind``: the
    robot drives away from all landmarks and measures them at ±π. ``eyes`` and ``wheels``: σ of
    measurements and of drives; ``draw``: as for :func:`measured`."""
    # The truth is in no array: errors have mean 0 over all runs, so that it is the runs' mean.
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
    return measured(rng, start, drives, p, SCANS, (START, wheels, eyes), draw=draw)


def measured(rng, start, drives, p, scans, sigmas, kind=POINTS, draw=None):
    """The task's inputs for many runs of one true way. ``scans`` (STEPS, k) are rows of p, -1 for
    none; ``sigmas`` are of start, drives and measurements; ``draw`` maps a shape to errors of
    variance 1."""
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
    # their mean over the runs is 0
    errors = draw((RUNS, *shape))
    return (errors - errors.mean(axis=0)) * np.sqrt(RUNS / (RUNS - 1))


def driven(x, drives):
    """The poses (n, 3) after each of the drives (n, 2)."""
    poses = []
    for u in drives:
        x = models.f_odometry(x, u)
        poses.append(x)
    return np.array(poses)


def truth(inputs, kind=POINTS):
    """True start (3,), drives (n, 2), way (n, 3), and landmarks {id: (2,)} in the order of
    meeting."""
    start, drives = inputs["x"].mean(axis=0), inputs["u"].mean(axis=0)
    way, first = driven(start, drives), inputs["z"][0]
    off = inputs["z"] - first
    off[..., 1] = wrap(off[..., 1])
    z, landmarks = first + off.mean(axis=0), {}
    for pose, seen, observations in zip(way, inputs["seen"].tolist(), z, strict=True):
        for i, observation in zip(seen, observations, strict=True):
            if i >= 0 and i not in landmarks:
                landmarks[i] = kind.g(pose, observation)
    return start, drives, way, landmarks


def least_squares(inputs, kind=POINTS):
    """Estimates minus truth (r, n) and their covariance (n, n), linearised at the truth."""
    # Unknown are the errors of the start and of all drives, and the landmarks.
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
