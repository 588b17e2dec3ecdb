"""Mapping with known poses: an independent EKF for each landmark (MAK thesis, 4.2)."""

import numpy as np

from slamlab.filters.argument_checks import covariance, observations, vector
from slamlab.filters.kalman_filter import Belief, correct
from slamlab.filters.landmark_models import difference
from slamlab.models import jacobians, observation


class KnownPoseMap:
    """Feature map from known poses: an uncorrelated EKF for each landmark; ``landmarks`` by id."""

    def __init__(self):
        self.landmarks: dict[int, Belief] = {}

    def update(self, x, id, z, R):
        """Initialise or update landmarks from a known pose. Equations (05.8), (05.5)."""
        x, R = vector("x", x, 3), covariance("R", R, 2)
        (z,), _ = observations([z], R)
        known = self.landmarks.get(id)
        if known is None:
            J_z = jacobians.J_z(x, z)
            self.landmarks[id] = Belief(observation.g(x, z), J_z @ R @ J_z.T)
            return None
        v = difference(z, observation.h(x, known.x))
        self.landmarks[id], step = correct(known, v, jacobians.H_landmark(x, known.x), R)
        return step

    def points(self):
        """Return the landmark means (n, 2) [m], in the order of the first observations."""
        return np.array([b.x for b in self.landmarks.values()]).reshape(-1, 2)
