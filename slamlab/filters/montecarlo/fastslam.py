"""FastSLAM: particles (samples) of the trajectory, each with a Kalman filter per landmark.

Given the trajectory, landmarks are independent of one another, so a sample needs no covariance
between them: correlations live in how samples differ (Rao-Blackwellised particle filter).
"""

import numpy as np

from slamlab.filters.argument_checks import vector
from slamlab.filters.montecarlo.likelihood import log_gaussian
from slamlab.filters.montecarlo.motion_sampling import sample_motion
from slamlab.filters.montecarlo.observation_checks import identified_observations
from slamlab.filters.montecarlo.particle_association import ExpectedScan, expected_scan
from slamlab.filters.montecarlo.particles import RESAMPLING_THRESHOLD, ParticleSet
from slamlab.filters.montecarlo.resampling import systematic
from slamlab.geometry import wrap
from slamlab.models import jacobians, observation


class FastSLAM:
    """FastSLAM 1.0 (Montemerlo and others): proposal by odometry alone, then importance weights.

    Equation (11.11).

    Parameters
    ----------
    rng : numpy.random.Generator
    samples : int
    pose : (3,) where all samples start [m, m, rad]

    ``robot`` is the ParticleSet of poses; ``p`` (n, N, 2) and ``P`` (n, N, 2, 2) are the landmarks'
    means and covariances in each sample [m], in the order of ``ids``.
    """

    def __init__(self, rng, samples=200, pose=(0.0, 0.0, 0.0)):
        if samples < 1:
            raise ValueError(f"samples are at least one, not {samples}")
        self.rng = rng
        self.robot = ParticleSet.unweighted(np.tile(vector("pose", pose, 3), (samples, 1)))
        self.p, self.P = np.empty((samples, 0, 2)), np.empty((samples, 0, 2, 2))
        self.ids: list[int] = []

    def predict(self, odometry, robot):
        """Prediction: sample the motion model for every particle; the landmarks stay.

        Parameters
        ----------
        odometry : (3,) odometry increment in the frame of the pose before [m, m, rad]
        robot : RobotModel

        Raises
        ------
        ValueError
        """
        odometry = vector("odometry", odometry, 3)
        poses = sample_motion(self.robot.rows, odometry, robot, self.rng)
        self.robot = ParticleSet(poses, self.robot.weights)

    def add(self, ids, z, R):
        """Landmark initialisation: place new landmarks in each particle, from its own pose.

        Parameters
        ----------
        ids : (m,) int, new ones, each once
        z : (m, 2) range [m] and bearing [rad]
        R : (2, 2) measurement noise of each, or (m, 2, 2)

        Raises
        ------
        ValueError
        """
        ids, z, R = identified_observations(ids, z, R, self.ids, new=True)
        x = self.robot.rows[:, None]
        J = jacobians.J_z(x, z)
        self.p = np.concatenate([self.p, observation.g(x, z)], axis=1)
        self.P = np.concatenate([self.P, J @ R @ J.swapaxes(-1, -2)], axis=1)
        self.ids += ids

    def update(self, ids, z, R):
        """Measurement update: reweight particles by likelihood, EKF update of their landmarks.

        Parameters
        ----------
        ids : (m,) int, known ones, each once
        z : (m, 2) range [m] and bearing [rad]
        R : (2, 2) measurement noise of each, or (m, 2, 2)

        Raises
        ------
        ValueError
        """
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
        """(N, 2) landmark means over all particles [m]."""
        return np.einsum("i,ijk->jk", self.robot.weights, self.p)

    def covariances(self):
        """(N, 2, 2) landmark covariances: within particles and between them [m²]."""
        d = self.p - self.landmarks()
        w = self.robot.weights
        return np.einsum("i,ijkl->jkl", w, self.P) + np.einsum("i,ijk,ijl->jkl", w, d, d)

    def expected_scan(self):
        """Expected observations of all landmarks, for data association, from every particle's map.

        Returns
        -------
        ExpectedScan, in the order of ``ids``
        """
        x, w = self.robot.rows, self.robot.weights
        mean = expected_scan(x, self.p, w)
        H = jacobians.H_landmark(x[:, None], self.p)
        inside = np.einsum("i,ijkl->jkl", w, H @ self.P @ H.swapaxes(-1, -2))
        return ExpectedScan(mean.z, mean.S + inside)

    def _innovations(self, rows, z, R):
        """(n, m, 2) v, its (n, m, 2, 2) covariances S, and H, per particle and observation."""
        x, p, P = self.robot.rows[:, None], self.p[:, rows], self.P[:, rows]
        v = z - observation.h(x, p)
        v[..., 1] = wrap(v[..., 1])
        H = jacobians.H_landmark(x, p)
        return v, H @ P @ H.swapaxes(-1, -2) + R, H
