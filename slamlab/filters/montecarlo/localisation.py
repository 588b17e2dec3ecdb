"""Monte Carlo localisation: the robot's half of the problem as a cloud (MAK thesis, 5.3.2)."""

import numpy as np

from slamlab.filters.guards import matrix, vector
from slamlab.filters.montecarlo import likelihood
from slamlab.filters.montecarlo.cloud import ENOUGH, Cloud
from slamlab.filters.montecarlo.motion import moved
from slamlab.filters.montecarlo.sightings import positive


class MCL:
    """Algorithm 1, its errata mended, in a map that is known.

    Draw by weight, move with noise, weigh by the likelihood alone, normalise. Drawing waits until
    the cloud is worth less than half its samples: each draw loses some of them for good.

    Parameters
    ----------
    cloud : Cloud of poses
    landmarks : (N, 2) the map [m]
    rng : numpy.random.Generator

    ``cloud`` is the belief, ``impossible`` counts scans that no sample could explain (they are
    left out), ``starved`` those that left the cloud worth less than two samples.
    """

    def __init__(self, cloud, landmarks, rng):
        if cloud.rows.shape[1] != 3:
            raise ValueError("a robot is localised by samples of its pose, three numbers each")
        self.landmarks = matrix("landmarks", landmarks, None, 2)
        self.cloud, self.rng = cloud, rng
        self.impossible = self.starved = 0

    def predict(self, odometry, robot):
        """Move every sample, each with its own noise.

        Parameters
        ----------
        odometry : (3,) motion in the frame of the pose before [m, m, rad]
        robot : RobotModel

        Raises
        ------
        ValueError
        """
        odometry = vector("odometry", odometry, 3)
        rows = moved(self.cloud.rows, odometry, robot, self.rng)
        self.cloud = Cloud(rows, self.cloud.weights)

    def update(self, z, R, ids=None):
        """Weigh every sample by how likely it finds a scan, then draw where that is due.

        Parameters
        ----------
        z : (m, 2) range [m] and bearing [rad]
        R : (2, 2) of each, or (m, 2, 2)
        ids : (m,) int rows of the map, or None where nobody knows which landmark is which

        Returns
        -------
        float, log likelihood of the scan given the belief before, −inf when impossible

        Raises
        ------
        ValueError
        """
        z, R = positive(z, R, None if ids is None else len(ids))
        if ids is None:
            logs = likelihood.of_nameless(self.cloud.rows, self.landmarks, z, R)
        else:
            logs = likelihood.of_scan(self.cloud.rows, self._named(ids), z, R)
        weighed, evidence = self.cloud.weighed(logs)
        self.impossible += evidence == -np.inf
        self.starved += weighed.effective < min(2, len(weighed.rows))
        if weighed.effective < ENOUGH * len(weighed.rows):
            weighed = weighed.resampled(self.rng)
        self.cloud = weighed
        return evidence

    def insert(self, strangers):
        """Put other poses in the place of as many samples, so that a robot carried off is found.

        Parameters
        ----------
        strangers : Cloud of fewer samples
        """
        rows, k = self.cloud.rows.copy(), len(strangers.rows)
        rows[self.rng.choice(len(rows), k, replace=False)] = strangers.rows
        self.cloud = Cloud(rows, self.cloud.weights)

    def _named(self, ids):
        ids = np.asarray(ids, dtype=int)
        if (strange := ids[(ids < 0) | (ids >= len(self.landmarks))]).size:
            raise ValueError(f"no landmark {strange[0]}: the map has {len(self.landmarks)} rows")
        return self.landmarks[ids]
