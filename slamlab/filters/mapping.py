"""Mapping with known poses: N independent little filters (MAK thesis, 4.2)."""

import numpy as np

from slamlab import jacobians, models
from slamlab.filters.guards import covariance, observations, vector
from slamlab.filters.linear import Belief, correct
from slamlab.geometry import wrap


class KnownPoseMap:
    """Landmarks seen from poses that are known: no correlations, O(1) per observation."""

    def __init__(self):
        self.landmarks: dict[int, Belief] = {}

    def see(self, x, id, z, R):
        """Take one observation in: a new landmark is placed, a known one corrected.

        Parameters
        ----------
        x : (3,) the pose, known [m, m, rad]
        id : int
        z : (2,) range [m], bearing [rad]
        R : (2, 2)

        Returns
        -------
        Step, or None for a new landmark

        Raises
        ------
        ValueError
        """
        x, R = vector("x", x, 3), covariance("R", R, 2)
        (z,), _ = observations([z], R)
        known = self.landmarks.get(id)
        if known is None:
            J_z = jacobians.J_z(x, z)
            self.landmarks[id] = Belief(models.g(x, z), J_z @ R @ J_z.T)
            return None
        v = z - models.h(x, known.x)
        v[1] = wrap(v[1])
        self.landmarks[id], step = correct(known, v, jacobians.H_landmark(x, known.x), R)
        return step

    def points(self):
        """(n, 2) the landmarks' means [m], in the order of first sight."""
        return np.array([b.x for b in self.landmarks.values()]).reshape(-1, 2)
