"""Motion model sampling (proposal distribution): each particle gets its own noise."""

import numpy as np

from slamlab.filters.argument_checks import vector
from slamlab.geometry import compose
from slamlab.models import noise


def sample_motion(x, odometry, robot, rng):
    """Sample p(x_t | x_{t−1}, u): an arc with noisy length and turn; to first order, Q = W C Wᵀ."""
    odometry = vector("odometry", odometry, 3)
    d, turn = np.hypot(odometry[0], odometry[1]), odometry[2]
    # wheel slip during a turn on the spot moves the robot along the chord
    direction = np.arctan2(odometry[1], odometry[0]) if d > 0 else turn / 2
    C = noise.C_odometry((d, turn), robot.distance_error, robot.turn_error, robot.turn_per_metre)
    C += noise.C_wheels((d, turn), robot.slip, robot.base)
    distance_error, turn_error = _cholesky(C) @ rng.standard_normal((2, len(x)))
    along = direction + turn_error / 2  # an error of the turn rotates the chord by half of it
    length = d + distance_error
    steps = length * np.cos(along), length * np.sin(along), turn + turn_error
    return compose(x, np.stack(steps, axis=-1))


def _cholesky(C):
    """Return the lower Cholesky factor L (2, 2) with L Lᵀ = C, which may be singular."""
    first = np.sqrt(C[0, 0])
    across = C[0, 1] / first if first > 0 else 0.0
    return np.array([[first, 0.0], [across, np.sqrt(max(C[1, 1] - across**2, 0.0))]])
