"""NEES of poses by the twist (logarithm of SE(2)). The density of the twist is closer to a Gaussian
than the density of the positions, the "banana" (Long et al. 2012)."""

import numpy as np

from slamlab.evaluation.consistency import nees
from slamlab.geometry import between


def twist(motion):
    """Compute the logarithm of SE(2): [v_x, v_y] = (θ/2) [[cot(θ/2), 1], [−1, cot(θ/2)]] [x, y].

    motion : (..., 3) [m, m, rad]. Returns (..., 3) [m, m, rad], the twist of the motion in unit
    time.
    """
    x, y, theta = np.moveaxis(np.asarray(motion, dtype=float), -1, 0)
    half = theta / 2
    along = np.cos(half) / np.sinc(half / np.pi)  # (θ/2) cot(θ/2), which is 1 at 0
    return np.stack([along * x + half * y, along * y - half * x, theta], axis=-1)


def pose_nees(poses, P, truth):
    """Compute the NEES of the twist from each estimate to the truth; to first order, the twist is
    the error in the robot's frame. Returns (...,). Raises ValueError as :func:`nees`.

    Parameters
    ----------
    poses, truth : (..., 3) [m, m, rad]
    P : (..., 3, 3) covariance of the poses, in the map's frame
    """
    poses = np.asarray(poses, dtype=float)
    c, s = np.cos(poses[..., 2]), np.sin(poses[..., 2])
    turned = np.zeros((*poses.shape, 3))  # into the robot's frame
    turned[..., 0, 0], turned[..., 0, 1], turned[..., 1, 0], turned[..., 1, 1] = c, s, -s, c
    turned[..., 2, 2] = 1
    return nees(twist(between(poses, truth)), turned @ P @ np.swapaxes(turned, -1, -2))
