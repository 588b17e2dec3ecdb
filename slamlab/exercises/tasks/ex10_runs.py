"""Exercise 10, runs: a robot that stands still among objects, and what only the judge can tell.

The truth is in no array. Errors of the sights have the mean 0 for each object, and the middles of
the objects' boxes are off such that the best motion of what was seen onto them is the true pose.
"""

import numpy as np

from slamlab.geometry import wrap

RUNS, OBJECTS, ROUNDS = 10, 4, 3
SIGHTS = OBJECTS * ROUNDS
LOST = slice(0, 4)  # runs that begin with hardly any heading
BOUNDS = np.array([0.1, 0.05])  # [m], [rad]


def runs(rng):
    """Robots somewhere in their boxes, among objects somewhere in theirs, each seen in turn."""
    pose = np.column_stack([rng.uniform(-3, 3, (RUNS, 2)), rng.uniform(-np.pi, np.pi, RUNS)])
    around = np.arange(OBJECTS) * np.pi / 2 + rng.uniform(-0.5, 0.5, (RUNS, OBJECTS))
    r = rng.uniform(2, 4, (RUNS, OBJECTS))
    seen = np.stack([r, around], axis=-1)
    z = (seen[:, None] + _errors(rng)).reshape(RUNS, SIGHTS, 2)
    half = rng.uniform(0.15, 0.4, RUNS)
    half[LOST] = rng.uniform(1.7, 2.4, 4)
    # near an end of its interval: a heading in its middle forgives much
    share = np.where(np.arange(RUNS) % 2, 0.0, 1.7) + rng.uniform(0.1, 0.2, RUNS)
    right = wrap(pose[:, 2] - half * share)
    of_robot = rng.uniform(0.3, 0.6, (RUNS, 2))
    stands = pose[:, :2] + of_robot * rng.uniform(-0.8, 0.8, (RUNS, 2))
    places = carried(pose, seen)
    size = rng.uniform(0.05, 0.2, (RUNS, OBJECTS, 2))
    size[:, -1] = rng.uniform(1.8, 2.4, (RUNS, 2))  # one that is hardly known
    return {
        "robot": boxes(stands, of_robot),
        "heading": np.column_stack([right, right + 2 * half]),
        "objects": boxes(places + _offsets(rng, places, size), size),
        "which": np.tile(np.arange(OBJECTS), (RUNS, ROUNDS)),
        "z": np.stack([z[..., 0], wrap(z[..., 1])], axis=-1),
        "bounds": np.tile(BOUNDS, (RUNS, 1)),
    }


def boxes(middle, half):
    """(..., 4) x_min, x_max, y_min, y_max from middles and half-widths (..., 2)."""
    ends = np.stack([middle - half, middle + half], axis=-1)
    return ends.reshape(*ends.shape[:-2], 4)


def carried(pose, seen):
    """(n, m, 2) places in the world of what n poses (n, 3) see at (n, m, 2) range and bearing."""
    angle = pose[:, None, 2] + seen[..., 1]
    u = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return pose[:, None, :2] + seen[..., :1] * u


def truth(given):
    """Pose (n, 3) and objects (n, m, 2) of each run.

    Parameters
    ----------
    given : of :func:`runs`
    """
    z = given["z"].reshape(RUNS, ROUNDS, OBJECTS, 2)
    off = wrap(z[..., 1] - z[:, :1, :, 1])
    seen = np.stack([z[..., 0].mean(axis=1), z[:, 0, :, 1] + off.mean(axis=1)], axis=-1)
    q = carried(np.zeros((RUNS, 3)), seen)
    m = given["objects"].reshape(RUNS, OBJECTS, 2, 2).mean(axis=3)
    a, b = q - q.mean(axis=1, keepdims=True), m - m.mean(axis=1, keepdims=True)
    turn = np.arctan2(_cross(a, b).sum(axis=1), (a * b).sum(axis=(1, 2)))
    without = np.column_stack([np.zeros((RUNS, 2)), turn])
    shift = m.mean(axis=1) - carried(without, seen).mean(axis=1)
    pose = np.column_stack([shift, turn])
    return pose, carried(pose, seen)


def _errors(rng):
    """(RUNS, ROUNDS, OBJECTS, 2) within the bounds, their mean over the rounds 0."""
    errors = rng.uniform(-1, 1, (RUNS, ROUNDS, OBJECTS, 2))
    errors -= errors.mean(axis=1, keepdims=True)
    return errors / np.maximum(1, np.abs(errors).max(axis=1, keepdims=True)) * BOUNDS


def _offsets(rng, places, size):
    """(RUNS, OBJECTS, 2) within 0.85 of the sizes, none of it a shift or a turn of the whole."""
    off = rng.uniform(-1, 1, places.shape) * size
    off -= off.mean(axis=1, keepdims=True)
    about = places - places.mean(axis=1, keepdims=True)
    turn = np.stack([-about[..., 1], about[..., 0]], axis=-1)
    share = (turn * off).sum(axis=(1, 2)) / (turn**2).sum(axis=(1, 2))
    off -= share[:, None, None] * turn
    return off * (0.85 / np.abs(off / size).max(axis=(1, 2)))[:, None, None]


def _cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
