"""EKF-SLAM in a corridor of two long walls, whose direction is unobservable (lesson 09).

The filter uses lines as measured, or their foot points (closest points to the world's origin),
which depend on the estimated pose.
"""

from dataclasses import dataclass

import numpy as np

from slamlab.evaluation import nees
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.landmark_models import LINES, POINTS
from slamlab.models.jacobians import W_odometry
from slamlab.models.motion import f_odometry
from slamlab.models.observation import g_line, h, h_line

WALLS = np.array([[1.5, np.pi / 2], [1.2, -np.pi / 2]])  # ρ [m], α [rad] of the long walls
END = np.array([[12.0, 0.0]])  # of a wall across the corridor
STEP = np.array([0.1, 0.0])  # control input of a step [m], [rad]
R = np.diag([0.01, 0.005]) ** 2  # noise of ρ' and α'


@dataclass(frozen=True)
class CorridorRuns:
    """Results of Monte Carlo runs after each step, (steps,) [m]: the RMS error along the corridor,
    the standard deviation ``claimed`` by P, and the RMS error of odometry (``wheels``). The mean
    NEES at the end is 3 if P is right."""

    errors: np.ndarray
    claimed: np.ndarray
    wheels: np.ndarray
    nees: float


def foot_points(lines):
    """Return the foot points (..., 2) [m] of lines (..., 2) ρ, α: closest points to the origin."""
    rho, alpha = np.moveaxis(np.asarray(lines), -1, 0)
    return np.stack([rho * np.cos(alpha), rho * np.sin(alpha)], axis=-1)


def simulate_run(rng, measured=True, slip=0.01, end_wall=False, steps=100):
    """Simulate one run of EKF-SLAM with (ρ', α') as measured, or with foot points.

    ``slip`` is the standard deviation per step [m]. Returns errors (steps, 3) [m, m, rad], P
    (steps, 3, 3), and errors of odometry.
    """
    walls, C = np.vstack([WALLS, END]) if end_wall else WALLS, np.diag([slip, 0.005]) ** 2
    kind, true, errors, P = LINES if measured else POINTS, np.zeros(3), [], []
    alone, wheels = np.zeros(3), []
    mak = MAK(np.zeros(3), np.zeros((3, 3)), kind=kind, first_estimates=True)
    for k in range(steps):
        true, u = f_odometry(true, STEP), rng.multivariate_normal(STEP, C)
        W = W_odometry(mak.pose, u)
        mak.predict(f_odometry(mak.pose, u), W @ C @ W.T)
        z = h_line(true, walls) + rng.multivariate_normal([0, 0], R, len(walls))
        if not measured:  # through the pose to the foot point, and back again
            z = h(mak.pose, foot_points(g_line(mak.pose, z)))
        (mak.update if k else mak.add)(range(len(walls)), z, R)
        errors.append(mak.pose - true)
        P.append(mak.block([0, 1, 2]))
        alone = f_odometry(alone, u)
        wheels.append(alone - true)
    return np.array(errors), np.array(P), np.array(wheels)


def simulate_runs(count, measured=True, slip=0.01, end_wall=False):
    """Simulate runs with seeds 0 to count − 1."""
    runs = [simulate_run(np.random.default_rng(k), measured, slip, end_wall) for k in range(count)]
    errors, P, wheels = (np.array(each) for each in zip(*runs, strict=True))
    rms, odometry_rms = (np.sqrt(np.mean(each[:, :, 0] ** 2, axis=0)) for each in (errors, wheels))
    claimed = np.sqrt(P[:, :, 0, 0].mean(axis=0))
    return CorridorRuns(rms, claimed, odometry_rms, float(nees(errors[:, -1], P[:, -1]).mean()))
