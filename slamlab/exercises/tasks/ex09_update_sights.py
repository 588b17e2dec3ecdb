"""Walls seen again for exercise 09, what is right of them, and how answers are compared."""

import numpy as np

from slamlab import models
from slamlab.exercises.tasks.ex06.beliefs import T, covariances, either_sign, same_block, sigmas
from slamlab.geometry import wrap

ROWS, WALLS, BEHIND = 9, 3, 3  # the last BEHIND sights cross the direction ±π
N = 3 + 2 * WALLS
CLOSE = 1e-3  # in standard deviations
DEGREES = 180 / np.pi
ANGLES = np.r_[2, 4:N:2]


def sights(rng):
    """Beliefs, a wall that is seen again, and how; some of them behind the robot."""
    x = np.empty((ROWS, N))
    x[:, :2], x[:, 2] = either_sign(rng, 1, 4, (ROWS, 2)), either_sign(rng, 0.3, 2.8, ROWS)
    sigma = rng.uniform(0.05, 0.15, x.shape)
    sigma[:, ANGLES] = rng.uniform(0.03, 0.06, (ROWS, len(ANGLES)))
    j = np.arange(ROWS) % WALLS
    seen = np.column_stack([rng.uniform(1, 4, ROWS), either_sign(rng, 0.3, 2.4, ROWS)])
    side = np.sign(seen[-BEHIND:, 1])
    seen[-BEHIND:, 1] = side * (np.pi - rng.uniform(0.01, 0.03, BEHIND))
    # α and θ have opposite signs: their difference needs no wrapping, the innovation does
    x[-BEHIND:, 2] = -side * abs(x[-BEHIND:, 2])
    for k in range(WALLS):
        around = np.column_stack([rng.uniform(1, 4, ROWS), either_sign(rng, 0.3, 2.8, ROWS)])
        mine = np.where((j == k)[:, None], seen, around)
        for row in range(ROWS):
            x[row, 3 + 2 * k : 5 + 2 * k] = models.g_line(x[row, :3], mine[row])
    beyond = either_sign(rng, 0.05, 0.1, ROWS)
    beyond[-BEHIND:] = side * abs(beyond[-BEHIND:])
    z = seen + np.column_stack([either_sign(rng, 0.1, 0.2, ROWS), beyond])
    z[:, 1] = wrap(z[:, 1])
    R = covariances(rng, rng.uniform(0.03, 0.06, (ROWS, 2)))
    return {"x": x, "P": covariances(rng, sigma), "z": z, "j": j, "R": R}


def predicted(inputs):
    """(k, 2) ρ' and α' as the beliefs would have them, α' wrapped."""
    return np.array([models.h_line(x[:3], x[3 + 2 * j : 5 + 2 * j]) for x, j in pairs_of(inputs)])


def pairs_of(inputs):
    return zip(inputs["x"], inputs["j"], strict=True)


def slopes(inputs, step=1e-6):
    """(k, 2, n) ∂h/∂x over the whole state, by differences of the model itself."""

    def seen(shift):
        return predicted(inputs | {"x": inputs["x"] + shift})

    off = np.array([seen(e) - seen(-e) for e in step * np.eye(N)])
    off[..., 1] = wrap(off[..., 1])
    return off.transpose(1, 2, 0) / (2 * step)


def innovation(inputs):
    """(k, 2) measured minus predicted, wrapped."""
    v = inputs["z"] - predicted(inputs)
    v[:, 1] = wrap(v[:, 1])
    return v


def truth(inputs):
    """Least squares: the x that fits belief and sight best, and the inverse of its information."""
    H, weight = slopes(inputs), np.linalg.inv(inputs["R"])
    P = np.linalg.inv(np.linalg.inv(inputs["P"]) + T(H) @ weight @ H)
    return inputs["x"] + (P @ T(H) @ weight @ innovation(inputs)[..., None])[..., 0], P


def same_state(got, want, P):
    off = got - want
    off[:, ANGLES] = wrap(off[:, ANGLES])
    return (np.abs(off) <= CLOSE * sigmas(P)).all(axis=1)


def mean(rows):
    def holds(inputs, outputs):
        return same_state(outputs["x"], truth(inputs)[0], inputs["P"])[rows]

    return holds


def covariance(inputs, outputs):
    return same_block(outputs["P"], truth(inputs)[1])
