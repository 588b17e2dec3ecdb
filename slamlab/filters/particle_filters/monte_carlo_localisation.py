"""Monte Carlo localisation (MCL, localization): a particle filter in a known map (MAK 5.3.2)."""

import numpy as np

from slamlab.filters.argument_checks import matrix, nonsingular_observations
from slamlab.filters.particle_filters import likelihood
from slamlab.filters.particle_filters.motion_sampling import sample_motion
from slamlab.filters.particle_filters.particle_set import RESAMPLING_THRESHOLD, ParticleSet


class MCL:
    """Particle filter of the pose in a known map: corrected algorithm 1 (MAK). Equation (11.3).
    Raises ValueError.

    Parameters
    ----------
    particles : ParticleSet of poses, the prior, then the posterior
    landmarks : (N, 2) the map [m]
    rng : numpy.random.Generator

    ``unexplained`` counts scans of likelihood 0, which are ignored. ``depleted`` counts scans after
    which the effective sample size was below two (particle degeneracy).
    """

    def __init__(self, particles, landmarks, rng):
        if particles.rows.shape[1] != 3:
            raise ValueError("the particles must be poses, three numbers each")
        self.landmarks = matrix("landmarks", landmarks, None, 2)
        self.particles, self.rng = particles, rng
        self.unexplained = self.depleted = 0

    def predict(self, odometry, robot):
        """Predict: sample the motion model for each particle; odometry (3,) [m, m, rad]."""
        rows = sample_motion(self.particles.rows, odometry, robot, self.rng)
        self.particles = ParticleSet(rows, self.particles.weights)

    def update(self, z, R, ids=None):
        """Update: weight the particles by a scan, and resample if the ESS is below the threshold.

        ids : rows of the map, or None (unknown data association). Returns the log-evidence.
        """
        z, R = nonsingular_observations(z, R, None if ids is None else len(ids))
        if ids is None:
            logs = likelihood.of_unassociated_scan(self.particles.rows, self.landmarks, z, R)
        else:
            logs = likelihood.of_scan(self.particles.rows, self._landmarks_of(ids), z, R)
        reweighted, evidence = self.particles.reweighted(logs)
        self.unexplained += evidence == -np.inf
        self.depleted += reweighted.effective_sample_size < min(2, len(reweighted.rows))
        if reweighted.effective_sample_size < RESAMPLING_THRESHOLD * len(reweighted.rows):
            reweighted = reweighted.resampled(self.rng)
        self.particles = reweighted
        return evidence

    def insert(self, injected):
        """Inject random particles, as in augmented MCL, so that a kidnapped robot is localised."""
        rows, k = self.particles.rows.copy(), len(injected.rows)
        rows[self.rng.choice(len(rows), k, replace=False)] = injected.rows
        self.particles = ParticleSet(rows, self.particles.weights)

    def _landmarks_of(self, ids):
        ids = np.asarray(ids, dtype=int)
        if (unknown := ids[(ids < 0) | (ids >= len(self.landmarks))]).size:
            raise ValueError(f"landmark {unknown[0]} is not one of the {len(self.landmarks)} rows")
        return self.landmarks[ids]
