"""EKF localisation (localization): estimates the robot's pose in a known map (MAK thesis, 4.1)."""

import numpy as np
from scipy.linalg import block_diag

from slamlab.filters.argument_checks import covariance, matrix, observations, vector
from slamlab.filters.kalman_filter import Belief, correct
from slamlab.filters.landmark_models import difference
from slamlab.geometry import wrap
from slamlab.models import jacobians, observation


def predict(b, x, A, Q):
    """Predict by the EKF (covariance propagation): x ← f(x, u), P ← A P Aᵀ + Q. Equation (05.4)."""
    x, A, Q = vector("x", x, 3), matrix("A", A, 3, 3), covariance("Q", Q, 3)
    P = A @ b.P @ A.T + Q
    return Belief(np.array([x[0], x[1], wrap(x[2])]), (P + P.T) / 2)


def update(b, z, p, R):
    """Update the pose by one scan z (m, 2) of known landmarks p (m, 2). Equation (05.5)."""
    z, R = observations(z, R)
    p = matrix("p", p, len(z), 2)
    R = block_diag(*np.broadcast_to(R, (len(z), 2, 2)))
    v = difference(z, observation.h(b.x, p))
    H = jacobians.H_robot(b.x, p).reshape(-1, 3)
    after, step = correct(b, v.ravel(), H, R)
    return Belief(np.array([*after.x[:2], wrap(after.x[2])]), after.P), step
