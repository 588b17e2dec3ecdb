"""NEES of poses along arcs: the error as the twist that leads from the estimate to the truth, log.

A heading in error bends the spread of places into an arc (a "banana"), which no ellipse in x and y
holds, though the noise be right. In the coordinates of the twist the spread stays straight (Long,
Wolfe, Mashner, Chirikjian 2012, "The banana distribution is Gaussian").
"""

import numpy as np

from slamlab.evaluation.consistency import nees
from slamlab.geometry import between


def twist(motion):
    """Logarithm of SE(2): the twist that in unit time makes a motion, along one arc.

    [v_x, v_y] = (θ/2) [[cot(θ/2), 1], [−1, cot(θ/2)]] [x, y], and θ as it is.

    Parameters
    ----------
    motion : (..., 3) [m, m, rad]

    Returns
    -------
    (..., 3) [m, m, rad]
    """
    x, y, theta = np.moveaxis(np.asarray(motion, dtype=float), -1, 0)
    half = theta / 2
    along = np.cos(half) / np.sinc(half / np.pi)  # (θ/2) cot(θ/2), which is 1 at 0
    return np.stack([along * x + half * y, along * y - half * x, theta], axis=-1)


def pose_nees(poses, P, truth):
    """NEES of poses along arcs: of the twist from each estimate to the truth.

    To first order the twist is the error turned into the robot's frame, and so is its covariance.

    Parameters
    ----------
    poses, truth : (..., 3) [m, m, rad]
    P : (..., 3, 3) covariance of the poses, in the frame of the map

    Returns
    -------
    (...,)

    Raises
    ------
    ValueError : shapes that do not fit, or a P that is not positive definite
    """
    poses = np.asarray(poses, dtype=float)
    c, s = np.cos(poses[..., 2]), np.sin(poses[..., 2])
    turned = np.zeros((*poses.shape, 3))  # into the robot's frame
    turned[..., 0, 0], turned[..., 0, 1], turned[..., 1, 0], turned[..., 1, 1] = c, s, -s, c
    turned[..., 2, 2] = 1
    return nees(twist(between(poses, truth)), turned @ P @ np.swapaxes(turned, -1, -2))
