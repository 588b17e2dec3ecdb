"""FastSLAM: samples of the robot's way, and to each a little Kalman filter per landmark.

Given the way the landmarks are independent of one another, so that a sample needs no covariance
between them: the correlations live in the differences between samples (Rao and Blackwell).
"""

import numpy as np

from slamlab import jacobians, models
from slamlab.filters.guards import vector
from slamlab.filters.montecarlo.association import Expected, expected
from slamlab.filters.montecarlo.cloud import ENOUGH, Cloud
from slamlab.filters.montecarlo.likelihood import log_gauss
from slamlab.filters.montecarlo.motion import moved
from slamlab.filters.montecarlo.resampling import systematic
from slamlab.filters.montecarlo.sightings import named
from slamlab.geometry import wrap


class FastSLAM:
    """Version 1.0 of Montemerlo and others: samples move by odometry alone, then are weighed.

    Parameters
    ----------
    rng : numpy.random.Generator
    samples : int
    pose : (3,) where all samples start [m, m, rad]

    ``robot`` is the Cloud of poses; ``p`` (n, N, 2) and ``P`` (n, N, 2, 2) are the landmarks'
    means and covariances in each sample [m], in the order of ``ids``.
    """

    def __init__(self, rng, samples=200, pose=(0.0, 0.0, 0.0)):
        if samples < 1:
            raise ValueError(f"samples are at least one, not {samples}")
        self.rng = rng
        self.robot = Cloud.of(np.tile(vector("pose", pose, 3), (samples, 1)))
        self.p, self.P = np.empty((samples, 0, 2)), np.empty((samples, 0, 2, 2))
        self.ids: list[int] = []

    def predict(self, odometry, robot):
        """Move every sample, each with its own noise; the landmarks stay.

        Parameters
        ----------
        odometry : (3,) motion in the frame of the pose before [m, m, rad]
        robot : RobotModel

        Raises
        ------
        ValueError
        """
        odometry = vector("odometry", odometry, 3)
        self.robot = Cloud(moved(self.robot.rows, odometry, robot, self.rng), self.robot.weights)

    def add(self, ids, z, R):
        """Place new landmarks, in each sample as its pose sees them.

        Parameters
        ----------
        ids : (m,) int, new ones, each once
        z : (m, 2) range [m] and bearing [rad]
        R : (2, 2) of each, or (m, 2, 2)

        Raises
        ------
        ValueError
        """
        ids, z, R = named(ids, z, R, self.ids, new=True)
        x = self.robot.rows[:, None]
        J = jacobians.J_z(x, z)
        self.p = np.concatenate([self.p, models.g(x, z)], axis=1)
        self.P = np.concatenate([self.P, J @ R @ J.swapaxes(-1, -2)], axis=1)
        self.ids += ids

    def update(self, ids, z, R):
        """Weigh every sample by how likely it found the scan, and correct its landmarks.

        Parameters
        ----------
        ids : (m,) int, known ones, each once
        z : (m, 2) range [m] and bearing [rad]
        R : (2, 2) of each, or (m, 2, 2)

        Raises
        ------
        ValueError
        """
        ids, z, R = named(ids, z, R, self.ids, new=False)
        rows = [self.ids.index(i) for i in ids]
        v, S, H = self._innovations(rows, z, R)
        p, P = self.p[:, rows], self.P[:, rows]
        K = P @ H.swapaxes(-1, -2) @ np.linalg.inv(S)
        I_KH = np.eye(2) - K @ H
        self.p[:, rows] = p + (K @ v[..., None])[..., 0]
        self.P[:, rows] = I_KH @ P @ I_KH.swapaxes(-1, -2) + K @ R @ K.swapaxes(-1, -2)
        self.robot, _ = self.robot.weighed(log_gauss(v, S).sum(axis=1))
        if self.robot.effective < ENOUGH * len(self.robot.rows):
            drawn = systematic(self.robot.weights, len(self.robot.rows), self.rng)
            self.robot = Cloud.of(self.robot.rows[drawn])
            self.p, self.P = self.p[drawn], self.P[drawn]

    def landmarks(self):
        """(N, 2) the landmarks' means over all samples [m]."""
        return np.einsum("i,ijk->jk", self.robot.weights, self.p)

    def covariances(self):
        """(N, 2, 2) the landmarks' covariances: inside the samples and between them [m²]."""
        off = self.p - self.landmarks()
        w = self.robot.weights
        return np.einsum("i,ijkl->jkl", w, self.P) + np.einsum("i,ijk,ijl->jkl", w, off, off)

    def expected(self):
        """How every landmark would look: each sample pairs its own pose with its own landmarks.

        Returns
        -------
        Expected, in the order of ``ids``
        """
        x, w = self.robot.rows, self.robot.weights
        seen = expected(x, self.p, w)
        H = jacobians.H_landmark(x[:, None], self.p)
        inside = np.einsum("i,ijkl->jkl", w, H @ self.P @ H.swapaxes(-1, -2))
        return Expected(seen.z, seen.S + inside)

    def _innovations(self, rows, z, R):
        """(n, m, 2) v, its (n, m, 2, 2) covariances S, and H, of each sample and sighting."""
        x, p, P = self.robot.rows[:, None], self.p[:, rows], self.P[:, rows]
        v = z - models.h(x, p)
        v[..., 1] = wrap(v[..., 1])
        H = jacobians.H_landmark(x, p)
        return v, H @ P @ H.swapaxes(-1, -2) + R, H
