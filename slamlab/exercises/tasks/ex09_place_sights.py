"""Walls seen for the first time in exercise 09, what is right of them, and how that is compared."""

import numpy as np

from slamlab.exercises.tasks.ex06.beliefs import covariances, either_sign, moments, sigmas
from slamlab.geometry import wrap

ROWS, BEYOND = 8, 2  # the last BEYOND walls stand between the robot and the world's origin
CLOSE = 1e-3  # in standard deviations, and of covariances in two of them
DEGREES = 180 / np.pi


def sights(rng):
    """Poses with their covariance, and walls seen from there; nothing stands at a right angle."""
    z = np.column_stack([rng.uniform(1, 4, ROWS), either_sign(rng, 0.4, 2.6, ROWS)])
    theta = either_sign(rng, 0.3, 2.8, ROWS)
    ahead = rng.uniform(0.5, 3, ROWS)
    ahead[-BEYOND:] = -z[-BEYOND:, 0] - rng.uniform(0.5, 2, BEYOND)
    aside, alpha = either_sign(rng, 0.8, 3, ROWS), theta + z[:, 1]
    c, s = np.cos(alpha), np.sin(alpha)
    x = np.column_stack([ahead * c - aside * s, ahead * s + aside * c, theta])
    pose_sigma = np.column_stack(
        [rng.uniform(0.05, 0.15, (ROWS, 2)), rng.uniform(0.03, 0.06, ROWS)]
    )
    wall_sigma = np.column_stack([rng.uniform(0.15, 0.3, ROWS), rng.uniform(0.08, 0.15, ROWS)])
    return {"x": x, "P": covariances(rng, pose_sigma), "z": z, "R": covariances(rng, wall_sigma)}


def on_the_wall(states, z):
    """Pose and line, the line from a point on it and its normal: no formula of ρ is consulted."""
    (x, y, theta), (rho, alpha) = states, z
    normal = np.cos(theta + alpha), np.sin(theta + alpha)
    a, b = x + rho * normal[0], y + rho * normal[1]
    return np.vstack([states, a * normal[0] + b * normal[1], theta + alpha])


def truth(inputs):
    """(k, 2) lines and (k, 5, 5) covariances of pose and line together."""
    found = [
        moments(on_the_wall, (x, z), P, R) for x, P, z, R in zip(*inputs.values(), strict=True)
    ]
    return np.array([x[3:] for x, _ in found]), np.array([P for _, P in found])


def same_line(got, want, s):
    off = got - want
    off[:, 1] = wrap(off[:, 1])
    return (np.abs(off) <= CLOSE * s).all(axis=1)


def line_holds(inputs, outputs):
    want, P = truth(inputs)
    return same_line(outputs["line"], want, sigmas(P)[:, 3:])


def same_part(got, want, rows, columns, s):
    scale = s[:, rows, None] * s[:, None, columns]
    return (np.abs(got - want) <= CLOSE * scale).all(axis=(1, 2))


PARTS = {"C": (slice(3, 5), slice(3, 5)), "X": (slice(3, 5), slice(0, 3))}


def block_holds(name):
    rows, columns = PARTS[name]

    def holds(inputs, outputs):
        _, P = truth(inputs)
        return same_part(outputs[name], P[:, rows, columns], rows, columns, sigmas(P))

    return holds
