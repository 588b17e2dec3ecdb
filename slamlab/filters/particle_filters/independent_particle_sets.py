"""SLAM by independent particle sets of the robot and of each landmark (MAK thesis, algorithm 2)."""

from math import log

import numpy as np
from scipy.special import logsumexp

from slamlab.filters.argument_checks import identified_observations
from slamlab.filters.particle_filters import likelihood
from slamlab.filters.particle_filters.motion_sampling import sample_motion
from slamlab.filters.particle_filters.particle_association import expected_scan
from slamlab.filters.particle_filters.particle_set import RESAMPLING_THRESHOLD, ParticleSet
from slamlab.models.observation import g


class IndependentParticleSets:
    """Particle-filter SLAM: a set V_r of poses and, for each landmark, a set V_L of positions.

    Each set is updated with random particles of the others, so correlations are lost and the filter
    is overconfident. Unlike in the thesis, the likelihood is a mean over ``partners`` particles,
    equation (11.9), a scan updates only observed landmarks, and roughening follows the resampling
    of a set that has not moved. Raises ValueError.

    Parameters
    ----------
    rng : numpy.random.Generator
    particles, landmark_particles : int, of the robot, of each landmark
    partners : int, random particles of the other set
    freeze_distance : float, a landmark whose particles are all closer to their mean becomes a fixed
        point; 0: never (5.3.4) [m]
    roughening : float, share of the standard deviation [1]

    ``robot`` is V_r, ``landmark_sets`` the V_L by id. ``depleted`` counts updates after which the
    effective sample size was below two (particle degeneracy).
    """

    def __init__(
        self,
        rng,
        particles=1000,
        landmark_particles=300,
        partners=10,
        freeze_distance=0.05,
        roughening=0.2,
    ):
        if min(particles, landmark_particles, partners) < 1:
            raise ValueError("particles, landmark_particles and partners must be at least 1")
        self.rng, self.landmark_particles, self.partners = rng, landmark_particles, partners
        self.freeze_distance, self.roughening = freeze_distance, roughening
        self.robot = ParticleSet.unweighted(np.zeros((particles, 3)))
        self.landmark_sets: dict[int, ParticleSet] = {}
        self.depleted = 0
        self._moved = False

    @property
    def ids(self):
        """The landmark ids, in the order of the landmarks' first observations."""
        return list(self.landmark_sets)

    @property
    def frozen(self):
        """Ids of frozen landmarks, which are fixed points."""
        return {i for i, particles in self.landmark_sets.items() if len(particles.rows) == 1}

    def predict(self, odometry, robot):
        """Predict: sample the motion model for the robot's particles; odometry (3,)."""
        poses = sample_motion(self.robot.rows, odometry, robot, self.rng)
        self._moved = bool(np.any(odometry))
        self.robot = ParticleSet(poses, self.robot.weights)

    def add(self, ids, z, R):
        """Initialise landmarks, each with its own particle set; arguments as in :meth:`update`."""
        ids, z, R = identified_observations(ids, z, R, self.ids, new=True)
        n = self.landmark_particles
        for i, one, noise in zip(ids, z, R, strict=True):
            noisy = one + self.rng.standard_normal((n, 2)) @ np.linalg.cholesky(noise).T
            positions = g(self.robot.draw((n,), self.rng), noisy)
            self._store_or_freeze(i, ParticleSet.unweighted(positions))

    def update(self, ids, z, R):
        """Update the robot's set and the sets of the observed landmarks by a measurement."""
        ids, z, R = identified_observations(ids, z, R, self.ids, new=False)
        before, logs = self.robot, np.zeros(len(self.robot.rows))
        for i, one, noise in zip(ids, z, R, strict=True):
            landmark = self.landmark_sets[i]
            partners = self._partners(landmark, len(logs))
            logs += _log_mean(likelihood.of_observation(before.rows, partners, one, noise))
            if i not in self.frozen:
                partners = self._partners(before, len(landmark.rows))
                own = _log_mean(likelihood.of_observation(partners, landmark.rows, one, noise))
                self._store_or_freeze(i, self._reweighted(landmark, own, still=True))
        self.robot = self._reweighted(before, logs, still=not self._moved)

    def landmarks(self):
        """Return the landmark means (N, 2) [m], in the order of the first observations."""
        return np.array([particles.moments.x for particles in self.landmark_sets.values()]).reshape(
            -1, 2
        )

    def expected_scan(self, n=100):
        """Return the ExpectedScan of all landmarks from n random pairs of particles. The covariance
        in it is too large, because correlations are lost."""
        p = [particles.draw((n,), self.rng) for particles in self.landmark_sets.values()]
        p = np.stack(p, axis=1) if p else np.empty((n, 0, 2))
        return expected_scan(self.robot.draw((n,), self.rng), p, np.full(n, 1 / n))

    def _partners(self, others, n):
        """Draw random partner particles (k, n, ·) from a set; a frozen landmark has one partner."""
        return others.draw((self.partners if len(others.rows) > 1 else 1, n), self.rng)

    def _reweighted(self, particles, logs, still):
        reweighted, _ = particles.reweighted(logs)
        self.depleted += reweighted.effective_sample_size < min(2, len(reweighted.rows))
        if reweighted.effective_sample_size >= RESAMPLING_THRESHOLD * len(reweighted.rows):
            return reweighted
        resampled = reweighted.resampled(self.rng)
        return resampled.roughened(self.roughening, self.rng) if still else resampled

    def _store_or_freeze(self, i, particles):
        """Store a landmark's set; freeze it to a point if all its particles are close (5.3.4)."""
        mean = particles.moments.x
        if (
            len(particles.rows) > 1
            and np.hypot(*particles.deviations(mean).T).max() < self.freeze_distance
        ):
            particles = ParticleSet.unweighted(mean[None])
        self.landmark_sets[i] = particles


def _log_mean(logs):
    """Return the log of the mean likelihood over the partners (log-sum-exp): (k, n) to (n,)."""
    return logsumexp(logs, axis=0) - log(len(logs))
