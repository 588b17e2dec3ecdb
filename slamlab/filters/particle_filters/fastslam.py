"""FastSLAM: a Rao-Blackwellised particle filter of the trajectory, with an EKF for each landmark.

Given the trajectory, the landmarks are conditionally independent.
"""

import numpy as np

from slamlab.filters.argument_checks import identified_observations, vector
from slamlab.filters.landmark_models import difference
from slamlab.filters.particle_filters.likelihood import log_gaussian
from slamlab.filters.particle_filters.motion_sampling import sample_motion
from slamlab.filters.particle_filters.particle_association import ExpectedScan, expected_scan
from slamlab.filters.particle_filters.particle_set import RESAMPLING_THRESHOLD, ParticleSet
from slamlab.filters.particle_filters.resampling import systematic
from slamlab.models import jacobians, observation


class FastSLAM:
    """FastSLAM 1.0 (Montemerlo et al. 2002): the proposal is the motion model. Equation (11.11).
    Raises ValueError.

    Parameters
    ----------
    rng : numpy.random.Generator
    particles : int
    pose : (3,) initial pose of all particles [m, m, rad]

    ``robot`` is the ParticleSet of poses; ``p`` (n, N, 2) and ``P`` (n, N, 2, 2) are the means and
    covariances of the landmarks of each particle.
    """

    def __init__(self, rng, particles=200, pose=(0.0, 0.0, 0.0)):
        if particles < 1:
            raise ValueError(f"particles must be at least 1, not {particles}")
        self.rng = rng
        self.robot = ParticleSet.unweighted(np.tile(vector("pose", pose, 3), (particles, 1)))
        self.p, self.P = np.empty((particles, 0, 2)), np.empty((particles, 0, 2, 2))
        self.ids: list[int] = []

    def predict(self, odometry, robot):
        """Predict: sample the motion model for each particle; odometry (3,) [m, m, rad]."""
        poses = sample_motion(self.robot.rows, odometry, robot, self.rng)
        self.robot = ParticleSet(poses, self.robot.weights)

    def add(self, ids, z, R):
        """Initialise landmarks in each particle from its pose; arguments as in :meth:`update`."""
        ids, z, R = identified_observations(ids, z, R, self.ids, new=True)
        x = self.robot.rows[:, None]
        J = jacobians.J_z(x, z)
        self.p = np.concatenate([self.p, observation.g(x, z)], axis=1)
        self.P = np.concatenate([self.P, J @ R @ J.swapaxes(-1, -2)], axis=1)
        self.ids += ids

    def update(self, ids, z, R):
        """Update: correct each particle's landmarks by an EKF, multiply the importance weights by
        the likelihood of z (m, 2), and resample."""
        ids, z, R = identified_observations(ids, z, R, self.ids, new=False)
        rows = [self.ids.index(i) for i in ids]
        v, S, H = self._innovations(rows, z, R)
        p, P = self.p[:, rows], self.P[:, rows]
        K = P @ H.swapaxes(-1, -2) @ np.linalg.inv(S)
        I_KH = np.eye(2) - K @ H
        self.p[:, rows] = p + (K @ v[..., None])[..., 0]
        self.P[:, rows] = I_KH @ P @ I_KH.swapaxes(-1, -2) + K @ R @ K.swapaxes(-1, -2)
        self.robot, _ = self.robot.reweighted(log_gaussian(v, S).sum(axis=1))
        if self.robot.effective_sample_size < RESAMPLING_THRESHOLD * len(self.robot.rows):
            drawn = systematic(self.robot.weights, len(self.robot.rows), self.rng)
            self.robot = ParticleSet.unweighted(self.robot.rows[drawn])
            self.p, self.P = self.p[drawn], self.P[drawn]

    def landmarks(self):
        """Return the weighted landmark means (N, 2) over all particles [m]."""
        return np.einsum("i,ijk->jk", self.robot.weights, self.p)

    def covariances(self):
        """Return the landmarks' covariances (N, 2, 2), within plus between particles [m²]."""
        d = self.p - self.landmarks()
        w = self.robot.weights
        return np.einsum("i,ijkl->jkl", w, self.P) + np.einsum("i,ijk,ijl->jkl", w, d, d)

    def expected_scan(self):
        """Return the ExpectedScan of all landmarks, in the order of ``ids``, over all particles."""
        x, w = self.robot.rows, self.robot.weights
        mean = expected_scan(x, self.p, w)
        H = jacobians.H_landmark(x[:, None], self.p)
        inside = np.einsum("i,ijkl->jkl", w, H @ self.P @ H.swapaxes(-1, -2))
        return ExpectedScan(mean.z, mean.S + inside)

    def _innovations(self, rows, z, R):
        """Return v (n, m, 2), S (n, m, 2, 2) and H of n particles and m observations."""
        x, p, P = self.robot.rows[:, None], self.p[:, rows], self.P[:, rows]
        H = jacobians.H_landmark(x, p)
        return difference(z, observation.h(x, p)), H @ P @ H.swapaxes(-1, -2) + R, H
