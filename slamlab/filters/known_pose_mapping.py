"""Mapping with known poses: N independent Kalman filters, one a landmark (MAK thesis, 4.2)."""

import numpy as np

from slamlab.filters.argument_checks import covariance, observations, vector
from slamlab.filters.linear_kalman import Belief, correct
from slamlab.geometry import wrap
from slamlab.models import jacobians, observation


class KnownPoseMap:
    """Landmark map from known poses: one EKF a landmark, uncorrelated; O(1) an observation."""

    def __init__(self):
        self.landmarks: dict[int, Belief] = {}

    def see(self, x, id, z, R):
        """Process one observation: initialise a new landmark, or EKF update of a known one.

        Equation (05.8) places it, (05.5) corrects it.

        Parameters
        ----------
        x : (3,) the pose, known [m, m, rad]
        id : int
        z : (2,) range [m], bearing [rad]
        R : (2, 2) measurement noise

        Returns
        -------
        UpdateResult, or None for a new landmark

        Raises
        ------
        ValueError
        """
        x, R = vector("x", x, 3), covariance("R", R, 2)
        (z,), _ = observations([z], R)
        known = self.landmarks.get(id)
        if known is None:
            J_z = jacobians.J_z(x, z)
            self.landmarks[id] = Belief(observation.g(x, z), J_z @ R @ J_z.T)
            return None
        v = z - observation.h(x, known.x)
        v[1] = wrap(v[1])
        self.landmarks[id], step = correct(known, v, jacobians.H_landmark(x, known.x), R)
        return step

    def points(self):
        """(n, 2) landmark means [m], in the order of their first observation."""
        return np.array([b.x for b in self.landmarks.values()]).reshape(-1, 2)
