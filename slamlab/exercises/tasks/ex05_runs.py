"""Runs for exercise 05: many robots drive the same way, each with errors of its own.

The errors are whitened: over all runs they have exactly the covariances that a filter is told. So
NEES is 3 on average, not by chance but up to the model's curvature, and the truth, which no run
holds, is the mean of what the runs are told.
"""

import numpy as np

from slamlab import models
from slamlab.exercises.tasks.ex05_batch import covariances, each, off_pose
from slamlab.geometry import wrap

RUNS, STEPS, LANDMARKS = 40, 8, 4
UNSEEN = (0, 3)  # steps that see nothing
LAST = LANDMARKS - 1
LATER = (0, 1, 2, LAST, LAST)  # ids after 0, which is seen first: it and the last one twice
WHEELS = np.array([0.04, 0.02])  # standard deviations of d [m] and Δθ [rad]
EYES = np.array([0.05, 0.02])  # of r [m] and β [rad]


def runs(rng):
    """One way driven by many robots, each with its own errors in start, wheels and sightings."""
    turns = rng.choice([-1.0, 1.0]) * rng.uniform(0.2, 0.5, STEPS)
    drives = np.column_stack([rng.uniform(0.4, 0.7, STEPS), turns])
    start = np.array([*rng.uniform(-5, 5, 2), rng.uniform(-3, 3)])
    path = driven(start, drives)
    landmarks, ids = _around(rng, path.mean(axis=0)), np.full(STEPS, -1)
    seen = np.isin(np.arange(STEPS), UNSEEN, invert=True)
    ids[seen] = [0, *rng.permutation(LATER)]
    P = covariances(rng, np.array([[0.1, 0.1, 0.04]]))[0]
    white = whitened(rng, RUNS, 3 + 2 * STEPS + 2 * int(seen.sum()))
    of_start, of_wheels, of_eyes = np.split(white, [3, 3 + 2 * STEPS], axis=1)
    zs = np.zeros((RUNS, STEPS, 2))
    zs[:, seen] = each(models.h, path[seen], landmarks[ids[seen]])
    zs[:, seen] += of_eyes.reshape(RUNS, -1, 2) * EYES
    zs[..., 1] = wrap(zs[..., 1])
    x = start + of_start @ np.linalg.cholesky(P).T
    x[:, 2] = wrap(x[:, 2])

    def shared(a):
        return np.repeat(a[None], RUNS, axis=0)

    return {
        "x": x,
        "P": shared(P),
        "drives": drives + of_wheels.reshape(RUNS, STEPS, 2) * WHEELS,
        "ids": shared(ids),
        "zs": zs,
        "landmarks": shared(landmarks),
        "C": shared(np.diag(WHEELS**2)),
        "R": shared(np.diag(EYES**2)),
    }


def whitened(rng, count, size):
    """Samples (count, size) whose mean is 0 and whose covariance is 1, exactly."""
    white = rng.standard_normal((count, size))
    white -= white.mean(axis=0)
    return white @ np.linalg.inv(np.linalg.cholesky(white.T @ white / count)).T


def driven(x, drives):
    """The poses (n, 3) after each of the drives (n, 2)."""
    poses = []
    for u in drives:
        x = models.f_odometry(x, u)
        poses.append(x)
    return np.array(poses)


def _around(rng, centre):
    """Landmarks 3.5 to 5 m off the middle of the way, all the way round."""
    angle = (np.arange(LANDMARKS) + 0.6 * rng.random(LANDMARKS)) * 2 * np.pi / LANDMARKS
    r = rng.uniform(3.5, 5, LANDMARKS)
    return centre[:2] + np.column_stack([r * np.cos(angle), r * np.sin(angle)])


def truth(inputs):
    """The poses (n, 3) that were driven: the errors of all runs have mean zero."""
    first = inputs["x"][0]
    start = first + off_pose(inputs["x"], first).mean(axis=0)
    return driven(start, inputs["drives"].mean(axis=0))


def errors(inputs, xs):
    """(m, n, 3) estimates minus truth, headings wrapped."""
    return off_pose(xs, truth(inputs)[None])
