"""A corridor seen as two long walls: what a landmark that was measured says of it, and a foot.

A foot of the perpendicular from the world's origin to a wall is not measured: it is computed
through the pose. Lesson 09 lets a robot drive with either.
"""

from dataclasses import dataclass

import numpy as np

from slamlab.evaluation import nees
from slamlab.filters.landmark_models import LINES, POINTS
from slamlab.filters.mak import MAK
from slamlab.models.jacobians import W_odometry
from slamlab.models.motion import f_odometry
from slamlab.models.observation import g_line, h, h_line

WALLS = np.array([[1.5, np.pi / 2], [1.2, -np.pi / 2]])  # ρ [m], α [rad] of the long walls
END = np.array([[12.0, 0.0]])  # of a wall across the corridor
STEP = np.array([0.1, 0.0])  # what the robot is told to do in a step [m], [rad]
R = np.diag([0.01, 0.005]) ** 2  # noise of ρ' and α'


@dataclass(frozen=True)
class Drives:
    """Drives down the corridor: the error along it after each step, and what is believed of it.

    Parameters
    ----------
    errs : (steps,) root mean square of the error of x over the drives [m]
    believes : (steps,) root of the mean variance that P says [m]
    wheels : (steps,) root mean square of odometry's error of x on the same drives [m]
    nees : float, mean NEES of the pose at the end, 3 where P is right [1]
    """

    errs: np.ndarray
    believes: np.ndarray
    wheels: np.ndarray
    nees: float


def feet(lines):
    """Feet of the perpendiculars from the origin to lines.

    Parameters
    ----------
    lines : (..., 2) ρ [m], α [rad]

    Returns
    -------
    (..., 2) points [m]
    """
    rho, alpha = np.moveaxis(np.asarray(lines), -1, 0)
    return np.stack([rho * np.cos(alpha), rho * np.sin(alpha)], axis=-1)


def drive(rng, measured=True, slip=0.01, end_wall=False, steps=100):
    """Drive down the corridor by EKF-SLAM.

    Parameters
    ----------
    rng : numpy.random.Generator
    measured : bool, the filter gets (ρ', α') as measured; without, range and bearing of each foot
    slip : float, standard deviation of the distance that a step goes [m]
    end_wall : bool, the robot also sees the wall at the corridor's end
    steps : int

    Returns
    -------
    errors : (steps, 3) of the pose [m, m, rad]
    P : (steps, 3, 3) what is believed of them
    wheels : (steps, 3) errors of odometry alone [m, m, rad]
    """
    walls, C = np.vstack([WALLS, END]) if end_wall else WALLS, np.diag([slip, 0.005]) ** 2
    kind, true, errors, P = LINES if measured else POINTS, np.zeros(3), [], []
    alone, wheels = np.zeros(3), []
    mak = MAK(np.zeros(3), np.zeros((3, 3)), kind=kind, first_estimates=True)
    for k in range(steps):
        true, told = f_odometry(true, STEP), rng.multivariate_normal(STEP, C)
        W = W_odometry(mak.pose, told)
        mak.predict(f_odometry(mak.pose, told), W @ C @ W.T)
        z = h_line(true, walls) + rng.multivariate_normal([0, 0], R, len(walls))
        if not measured:  # through the pose to the foot, and back again
            z = h(mak.pose, feet(g_line(mak.pose, z)))
        (mak.update if k else mak.add)(range(len(walls)), z, R)
        errors.append(mak.pose - true)
        P.append(mak.block([0, 1, 2]))
        alone = f_odometry(alone, told)
        wheels.append(alone - true)
    return np.array(errors), np.array(P), np.array(wheels)


def drives(count, measured=True, slip=0.01, end_wall=False):
    """Drive down the corridor many times, seeds 0 to count − 1.

    Parameters
    ----------
    count : int
    measured, slip, end_wall : see :func:`drive`

    Returns
    -------
    Drives
    """
    runs = [drive(np.random.default_rng(k), measured, slip, end_wall) for k in range(count)]
    errors, P, wheels = (np.array(each) for each in zip(*runs, strict=True))
    errs, by_wheels = (np.sqrt(np.mean(each[:, :, 0] ** 2, axis=0)) for each in (errors, wheels))
    believes = np.sqrt(P[:, :, 0, 0].mean(axis=0))
    return Drives(errs, believes, by_wheels, float(nees(errors[:, -1], P[:, -1]).mean()))
