"""Propagation of small errors, compared with its linearisation: sampled motions, sampled landmarks,
and an EKF with a wrong entry in H (lesson 04)."""

import numpy as np

from slamlab import models
from slamlab.evaluation import nees
from slamlab.geometry import wrap
from slamlab.models import jacobians

TRUTH, START = np.array([1.0, 1.0, 0.5]), np.diag([0.3, 0.3, 0.1]) ** 2
LANDMARKS, R = np.array([[4, 1], [2, 4.5], [-2, 2.5]]), np.diag([0.05, 0.02]) ** 2


def sample_end_poses(x, P, u, C, rng, count=1000):
    """Sample end poses (count, 3) of robots whose start pose has mean x and covariance P, and whose
    control input has mean u (2,) and covariance C [m, rad]."""
    starts, controls = rng.multivariate_normal(x, P, count), rng.multivariate_normal(u, C, count)
    return np.array([models.f_odometry(*each) for each in zip(starts, controls, strict=True)])


def sample_landmarks(x, P, z, R, rng, count=1000):
    """Sample landmarks (count, 2) [m] from poses with mean x and covariance P, and observations
    with mean z (2,) and covariance R [m, rad]."""
    poses, seen = rng.multivariate_normal(x, P, count), rng.multivariate_normal(z, R, count)
    return np.array([models.g(*each) for each in zip(poses, seen, strict=True)])


def new_landmark(P, J_r, J_z, R):
    """Return the covariance (2, 2) [m²] of a new landmark. Equation (04.17)."""
    return J_r @ P @ J_r.T + J_z @ R @ J_z.T


def landmark_nees(x, z, R, P, J_r, J_z):
    """Return the mean NEES of sampled landmarks for Jacobians J_r, J_z: 2 if they are right."""
    errors = sample_landmarks(x, P, z, R, np.random.default_rng(4)) - models.g(x, z)
    return nees(errors, new_landmark(P, J_r, J_z, R)).mean()


def localisation_errors(factor, landmarks, robots=100, steps=20):
    """Localise stationary robots by known landmarks, with ∂β/∂y in H multiplied by ``factor``.

    Returns the median position error and the median estimated σ, (steps,) [m].
    """
    rng = np.random.default_rng(4)
    x, P = rng.multivariate_normal(TRUTH, START, robots), np.tile(START, (robots, 1, 1))
    found = []
    for k in range(steps):
        p = LANDMARKS[k % landmarks]
        v = rng.multivariate_normal(models.h(TRUTH, p), R, robots) - models.h(x, p)
        v[:, 1] = wrap(v[:, 1])
        H = jacobians.H_robot(x, p)
        H[:, 1, 1] *= factor
        S = H @ P @ H.swapaxes(1, 2) + R
        K = P @ H.swapaxes(1, 2) @ np.linalg.inv(S)
        x, P = x + np.einsum("nij,nj->ni", K, v), P - K @ S @ K.swapaxes(1, 2)
        sigmas = np.sqrt(np.trace(P[:, :2, :2], axis1=1, axis2=2))
        found.append([np.median(np.hypot(*(x - TRUTH)[:, :2].T)), np.median(sigmas)])
    return tuple(np.transpose(found))
