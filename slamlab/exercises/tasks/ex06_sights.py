"""Sights of known landmarks for exercise 06, and what least squares makes of them."""

import numpy as np

from slamlab import models
from slamlab.exercises.tasks.ex06_beliefs import T, beliefs, covariances, either_sign
from slamlab.exercises.tasks.ex06_h import by_differences, seen
from slamlab.geometry import wrap

ROWS, LANDMARKS, BEHIND = 10, 3, 4  # the last BEHIND sights cross the bearing ±π


def sights(rng):
    """Beliefs, a landmark that is seen again, and how; some of them behind the robot."""
    x, P = beliefs(rng, ROWS, LANDMARKS)
    j, R = np.arange(ROWS) % LANDMARKS, covariances(rng, rng.uniform(0.03, 0.06, (ROWS, 2)))
    side = either_sign(rng, 1, 1, ROWS)
    z = np.empty((ROWS, 2))
    for k in range(ROWS):
        r = rng.uniform(2, 5)
        behind = k >= ROWS - BEHIND
        bearing = side[k] * (np.pi - rng.uniform(0.01, 0.04) if behind else rng.uniform(0.3, 2.2))
        x[k, 3 + 2 * j[k] : 5 + 2 * j[k]] = models.g(x[k], np.array([r, bearing]))
        beyond = side[k] * rng.uniform(0.06, 0.1)
        z[k] = r + either_sign(rng, 0.1, 0.2), wrap(bearing + beyond)
    return {"x": x, "P": P, "z": z, "j": j, "R": R}


def innovation(inputs):
    """(k, 2) measured minus predicted, as it comes."""
    pairs = zip(inputs["x"], inputs["j"], strict=True)
    return inputs["z"] - np.array([seen(x, j) for x, j in pairs])


def wrapped(v):
    """Innovations (k, 2) with their bearings wrapped."""
    return np.column_stack([v[:, 0], wrap(v[:, 1])])


def truth(inputs):
    """Least squares: the x that fits belief and sight best, and the inverse of its information."""
    H, v = by_differences(inputs), wrapped(innovation(inputs))
    before, weight = np.linalg.inv(inputs["P"]), np.linalg.inv(inputs["R"])
    P = np.linalg.inv(before + T(H) @ weight @ H)
    return inputs["x"] + (P @ T(H) @ weight @ v[..., None])[..., 0], P
