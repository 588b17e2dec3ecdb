"""EKF localisation (localization): the robot's pose in a known map (MAK thesis, 4.1)."""

import numpy as np
from scipy.linalg import block_diag

from slamlab.filters.argument_checks import covariance, matrix, observations, vector
from slamlab.filters.linear_kalman import Belief, correct
from slamlab.geometry import wrap
from slamlab.models import jacobians, observation


def predict(b, x, A, Q):
    """EKF prediction of the pose by the motion model: x ← f(x, u), P ← A P Aᵀ + Q.

    Equation (05.4).

    Parameters
    ----------
    b : Belief of the pose, size 3
    x : (3,) f(b.x, u) [m, m, rad]
    A : (3, 3) Jacobian ∂f/∂x at b.x
    Q : (3, 3) process noise

    Returns
    -------
    Belief

    Raises
    ------
    ValueError
    """
    x, A, Q = vector("x", x, 3), matrix("A", A, 3, 3), covariance("Q", Q, 3)
    P = A @ b.P @ A.T + Q
    return Belief(np.array([x[0], x[1], wrap(x[2])]), (P + P.T) / 2)


def update(b, z, p, R):
    """EKF measurement update by known landmarks, all observations of a scan at once (batch).

    Equation (05.5).

    Parameters
    ----------
    b : Belief of the pose, size 3
    z : (m, 2) range [m] and bearing [rad]
    p : (m, 2) the landmarks [m]
    R : (2, 2) measurement noise of each, or (m, 2, 2)

    Returns
    -------
    Belief, UpdateResult

    Raises
    ------
    ValueError
    """
    z, R = observations(z, R)
    p = matrix("p", p, len(z), 2)
    R = block_diag(*np.broadcast_to(R, (len(z), 2, 2)))
    v = z - observation.h(b.x, p)
    v[:, 1] = wrap(v[:, 1])
    H = jacobians.H_robot(b.x, p).reshape(-1, 3)
    after, step = correct(b, v.ravel(), H, R)
    return Belief(np.array([*after.x[:2], wrap(after.x[2])]), after.P), step
