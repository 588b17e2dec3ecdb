"""What small errors become (lesson 04): robots drive, landmarks are placed, H has a wrong entry."""

import numpy as np

from slamlab import models
from slamlab.evaluation import nees
from slamlab.geometry import wrap
from slamlab.models import jacobians

TRUTH, START = np.array([1.0, 1.0, 0.5]), np.diag([0.3, 0.3, 0.1]) ** 2
LANDMARKS, R = np.array([[4, 1], [2, 4.5], [-2, 2.5]]), np.diag([0.05, 0.02]) ** 2


def driven(x, P, u, C, rng, count=1000):
    """Robots that start where a belief allows, and drive what their wheels make of a control.

    Parameters
    ----------
    x, P : (3,), (3, 3) believed pose and its covariance [m, m, rad]
    u, C : (2,), (2, 2) distance, turn and their covariance [m, rad]
    rng : numpy.random.Generator
    count : int, robots

    Returns
    -------
    (count, 3) the poses at the end
    """
    starts, controls = rng.multivariate_normal(x, P, count), rng.multivariate_normal(u, C, count)
    return np.array([models.f_odometry(*each) for each in zip(starts, controls, strict=True)])


def placed(x, P, z, R, rng, count=1000):
    """Landmarks that robots place from where a belief allows them to be, by noisy sights.

    Parameters
    ----------
    x, P : (3,), (3, 3) believed pose and its covariance [m, m, rad]
    z, R : (2,), (2, 2) range, bearing and their covariance [m, rad]
    rng : numpy.random.Generator
    count : int, robots

    Returns
    -------
    (count, 2) [m]
    """
    poses, sights = rng.multivariate_normal(x, P, count), rng.multivariate_normal(z, R, count)
    return np.array([models.g(*each) for each in zip(poses, sights, strict=True)])


def new_landmark(P, J_r, J_z, R):
    """Covariance of a landmark that was placed by a sight. Equation (04.17).

    Parameters
    ----------
    P : (3, 3) covariance of the pose
    J_r, J_z : (2, 3), (2, 2) Jacobians of g by the pose and by the sight
    R : (2, 2) covariance of the sight

    Returns
    -------
    (2, 2) [m²]
    """
    return J_r @ P @ J_r.T + J_z @ R @ J_z.T


def landmark_nees(x, z, R, P, J_r, J_z):
    """Mean NEES of landmarks placed by a sight, with the covariance that two Jacobians claim.

    Parameters
    ----------
    x, P : (3,), (3, 3) believed pose and its covariance [m, m, rad]
    z, R : (2,), (2, 2) range, bearing and their covariance [m, rad]
    J_r, J_z : (2, 3), (2, 2) Jacobians of g, right or wrong

    Returns
    -------
    float, 2 where they are right
    """
    errors = placed(x, P, z, R, np.random.default_rng(4)) - models.g(x, z)
    return nees(errors, new_landmark(P, J_r, J_z, R)).mean()


def localised(factor, landmarks, robots=100, steps=20):
    """Robots that stand still and correct their poses by known landmarks, with a spoiled H.

    Parameters
    ----------
    factor : float, by which ∂β/∂y in H is multiplied; 1 is right
    landmarks : int, 1 to 3, seen in turn
    robots, steps : int, how many, and how many sights each has

    Returns
    -------
    (steps,) median error of the place [m], (steps,) median σ that the filters believe [m]
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
