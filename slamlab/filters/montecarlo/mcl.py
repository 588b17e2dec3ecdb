"""Monte Carlo localisation (MCL, localization): a particle filter, known map (MAK 5.3.2)."""

import numpy as np

from slamlab.filters.argument_checks import matrix, vector
from slamlab.filters.montecarlo import likelihood
from slamlab.filters.montecarlo.motion_sampling import sample_motion
from slamlab.filters.montecarlo.observation_checks import nonsingular_observations
from slamlab.filters.montecarlo.particles import RESAMPLING_THRESHOLD, ParticleSet


class MCL:
    """Particle filter of the pose in a known map: algorithm 1, its errata mended.

    Resample, sample the motion, weight by the likelihood alone, normalise: equation (11.3).
    Resampling waits until the effective sample size is below half the particles: each time some
    are lost for good.

    Parameters
    ----------
    cloud : ParticleSet of poses, the prior
    landmarks : (N, 2) the map [m]
    rng : numpy.random.Generator

    ``cloud`` is the posterior, ``unexplained`` counts scans that no particle could explain (they
    are left out), ``depleted`` those that left an effective sample size below two.
    """

    def __init__(self, cloud, landmarks, rng):
        if cloud.rows.shape[1] != 3:
            raise ValueError("a robot is localised by samples of its pose, three numbers each")
        self.landmarks = matrix("landmarks", landmarks, None, 2)
        self.cloud, self.rng = cloud, rng
        self.unexplained = self.depleted = 0

    def predict(self, odometry, robot):
        """Prediction: sample the motion model for every particle.

        Parameters
        ----------
        odometry : (3,) odometry increment in the frame of the pose before [m, m, rad]
        robot : RobotModel

        Raises
        ------
        ValueError
        """
        odometry = vector("odometry", odometry, 3)
        rows = sample_motion(self.cloud.rows, odometry, robot, self.rng)
        self.cloud = ParticleSet(rows, self.cloud.weights)

    def update(self, z, R, ids=None):
        """Measurement update: reweight particles by the likelihood of a scan, resample where due.

        Parameters
        ----------
        z : (m, 2) range [m] and bearing [rad]
        R : (2, 2) measurement noise of each, or (m, 2, 2)
        ids : (m,) int rows of the map, or None where the data association is unknown

        Returns
        -------
        float, log-likelihood of the scan given the prior (evidence), −inf when impossible

        Raises
        ------
        ValueError
        """
        z, R = nonsingular_observations(z, R, None if ids is None else len(ids))
        if ids is None:
            logs = likelihood.of_unassociated_scan(self.cloud.rows, self.landmarks, z, R)
        else:
            logs = likelihood.of_scan(self.cloud.rows, self._landmarks_of(ids), z, R)
        reweighted, evidence = self.cloud.reweighted(logs)
        self.unexplained += evidence == -np.inf
        self.depleted += reweighted.effective_sample_size < min(2, len(reweighted.rows))
        if reweighted.effective_sample_size < RESAMPLING_THRESHOLD * len(reweighted.rows):
            reweighted = reweighted.resampled(self.rng)
        self.cloud = reweighted
        return evidence

    def insert(self, injected):
        """Injection of random particles in place of as many, so that a kidnapped robot recovers.

        Parameters
        ----------
        injected : ParticleSet of fewer samples
        """
        rows, k = self.cloud.rows.copy(), len(injected.rows)
        rows[self.rng.choice(len(rows), k, replace=False)] = injected.rows
        self.cloud = ParticleSet(rows, self.cloud.weights)

    def _landmarks_of(self, ids):
        ids = np.asarray(ids, dtype=int)
        if (unknown := ids[(ids < 0) | (ids >= len(self.landmarks))]).size:
            raise ValueError(f"no landmark {unknown[0]}: the map has {len(self.landmarks)} rows")
        return self.landmarks[ids]
