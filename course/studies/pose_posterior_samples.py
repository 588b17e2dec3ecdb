"""Samples of the posterior of a pose, given observations of known landmarks, without linearisation,
by rejection sampling. The samples are compared with an EKF's ellipse."""

import numpy as np

from slamlab.evaluation import nees
from slamlab.geometry import wrap
from slamlab.models import observation

CHI2_95 = 5.991  # 95 % of χ² with two degrees of freedom


def sample_posterior(landmarks, z, heading, sigma, R, rng, count=4000):
    """Sample poses (k, 3) from the posterior given a heading ± sigma [rad] and observations z
    (m, 2), covariance R, of landmarks (m, 2).

    ``count`` poses are drawn from the first observation, which stands for a prior that is uniform
    in the range and bearing of the first landmark; the other observations accept or reject them.
    """
    headings = rng.normal(heading, sigma, count)
    first = rng.multivariate_normal(z[0], R, count)
    turned = np.column_stack([np.zeros((count, 2)), headings])
    poses = np.column_stack([landmarks[0] - observation.g(turned, first), headings])
    for p, seen in zip(landmarks[1:], z[1:], strict=True):
        v = seen - observation.h(poses, p)
        v[:, 1] = wrap(v[:, 1])
        likely = np.exp(-0.5 * np.einsum("ki,ij,kj->k", v, np.linalg.inv(R), v))
        poses = poses[rng.random(len(poses)) < likely]
    return poses


def share_in_ellipse(b, poses):
    """Return the share of poses (k, 3) whose position is in a belief's 95 % ellipse."""
    return float(np.mean(nees(poses[:, :2] - b.x[:2], b.P[:2, :2]) < CHI2_95))
