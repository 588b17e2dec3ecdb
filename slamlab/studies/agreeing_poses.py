"""Poses that agree with sights of known landmarks, as samples: what an ellipse is held against."""

import numpy as np

from slamlab.evaluation import nees
from slamlab.geometry import wrap
from slamlab.models import observation

CHI2_95 = 5.991  # 95 % of χ² with two degrees of freedom


def poses_that_agree(landmarks, z, heading, sigma, R, rng, count=4000):
    """Samples of the poses that agree with sights of known landmarks, the place being unknown.

    Parameters
    ----------
    landmarks : (m, 2), one at least [m]
    z : (m, 2) how they are seen
    heading, sigma : float, what is known of the heading beforehand [rad]
    R : (2, 2) covariance of a sight
    rng : numpy.random.Generator
    count : int, samples of which those are drawn that agree with all sights but the first

    Returns
    -------
    (k, 3) poses [m, m, rad]
    """
    headings = rng.normal(heading, sigma, count)
    looks = rng.multivariate_normal(z[0], R, count)
    turned = np.column_stack([np.zeros((count, 2)), headings])
    poses = np.column_stack([landmarks[0] - observation.g(turned, looks), headings])
    for p, seen in zip(landmarks[1:], z[1:], strict=True):
        v = seen - observation.h(poses, p)
        v[:, 1] = wrap(v[:, 1])
        likely = np.exp(-0.5 * np.einsum("ki,ij,kj->k", v, np.linalg.inv(R), v))
        poses = poses[rng.random(len(poses)) < likely]
    return poses


def share_inside(b, poses):
    """Share of poses whose place lies inside the 95 % ellipse of a belief.

    Parameters
    ----------
    b : Belief of the pose
    poses : (k, 3) [m, m, rad]

    Returns
    -------
    float [1]
    """
    return float(np.mean(nees(poses[:, :2] - b.x[:2], b.P[:2, :2]) < CHI2_95))
