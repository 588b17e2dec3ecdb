"""SLAM by particle sets: one for the robot, one a landmark (MAK thesis, algorithm 2)."""

from math import log

import numpy as np
from scipy.special import logsumexp

from slamlab.filters.argument_checks import vector
from slamlab.filters.montecarlo import likelihood
from slamlab.filters.montecarlo.motion_sampling import sample_motion
from slamlab.filters.montecarlo.observation_checks import identified_observations
from slamlab.filters.montecarlo.particle_association import expected_scan
from slamlab.filters.montecarlo.particles import RESAMPLING_THRESHOLD, ParticleSet
from slamlab.models.observation import g


class SampleSets:
    """Particle-filter SLAM: sets V_r of poses, V_L of positions for each landmark (object).

    Each is updated by algorithm 1. The sets are independent: where the update of one needs another,
    random samples of that are taken. So the correlation of any two is lost, and the sets shrink
    more than they should (overconfidence).

    What the thesis leaves open is our choice:

    - the robot starts at the origin for certain, as the map's frame is laid there;
    - an object starts where random poses of the robot would have seen it, had the noise been
      another one, so its set holds the robot's uncertainty and the sensor's;
    - a likelihood is the mean over ``partners`` random samples (the thesis: one), equation (11.9);
    - a scan updates the observed sets only, every one from the others' priors;
    - a set is resampled when its effective sample size is below half its samples, and where it has
      not moved it is roughened then, without a change of its mean and covariance;
    - data association is for the caller.

    Parameters
    ----------
    rng : numpy.random.Generator
    samples : int, of the robot
    object_samples : int, of each object
    partners : int, random samples of the other set for each likelihood
    close : float, an object is frozen when all its samples lie this close to their mean, 0 for
        never (5.3.4) [m]
    shake : float, roughening: share of its spread by which a set is jittered

    ``robot`` is V_r, ``objects`` the others by id; that of a frozen object is a single sample.
    ``depleted`` counts updates that left an effective sample size below two (degeneracy).
    """

    def __init__(self, rng, samples=1000, object_samples=300, partners=10, close=0.05, shake=0.2):
        if min(samples, object_samples, partners) < 1:
            raise ValueError("samples, object_samples and partners are at least one")
        self.rng, self.object_samples, self.partners = rng, object_samples, partners
        self.close, self.shake = close, shake
        self.robot = ParticleSet.unweighted(np.zeros((samples, 3)))
        self.objects: dict[int, ParticleSet] = {}
        self.depleted = 0
        self._moved = False

    @property
    def ids(self):
        """list of the landmark (object) ids, in the order of first observation."""
        return list(self.objects)

    @property
    def frozen(self):
        """set of the ids of frozen landmarks, which are points and stay."""
        return {i for i, cloud in self.objects.items() if len(cloud.rows) == 1}

    def predict(self, odometry, robot):
        """Prediction: sample the motion model for the robot's particles.

        Parameters
        ----------
        odometry : (3,) odometry increment in the frame of the pose before [m, m, rad]
        robot : RobotModel

        Raises
        ------
        ValueError
        """
        odometry = vector("odometry", odometry, 3)
        self._moved = bool(odometry.any())
        poses = sample_motion(self.robot.rows, odometry, robot, self.rng)
        self.robot = ParticleSet(poses, self.robot.weights)

    def add(self, ids, z, R):
        """Landmark initialisation: a particle set for each new landmark.

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
        n = self.object_samples
        for i, one, noise in zip(ids, z, R, strict=True):
            noisy = one + self.rng.standard_normal((n, 2)) @ np.linalg.cholesky(noise).T
            places = g(self.robot.draw((n,), self.rng), noisy)
            self._store_or_freeze(i, ParticleSet.unweighted(places))

    def update(self, ids, z, R):
        """Measurement update: reweight the sets of the robot and the observed landmarks.

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
        before, logs = self.robot, np.zeros(len(self.robot.rows))
        for i, one, noise in zip(ids, z, R, strict=True):
            landmark = self.objects[i]
            partners = self._partners(landmark, len(logs))
            logs += _log_mean(likelihood.of_observation(before.rows, partners, one, noise))
            if i not in self.frozen:
                partners = self._partners(before, len(landmark.rows))
                own = _log_mean(likelihood.of_observation(partners, landmark.rows, one, noise))
                self._store_or_freeze(i, self._reweighted(landmark, own, still=True))
        self.robot = self._reweighted(before, logs, still=not self._moved)

    def landmarks(self):
        """(N, 2) landmark means [m], in the order of first observation."""
        return np.array([cloud.moments.x for cloud in self.objects.values()]).reshape(-1, 2)

    def expected_scan(self, n=100):
        """Expected observations of all landmarks, from random pairs of samples: wide, as the
        correlation of pose and landmark is lost.

        Parameters
        ----------
        n : int, pairs

        Returns
        -------
        ExpectedScan, in the order of ``ids``
        """
        p = [cloud.draw((n,), self.rng) for cloud in self.objects.values()]
        p = np.stack(p, axis=1) if p else np.empty((n, 0, 2))
        return expected_scan(self.robot.draw((n,), self.rng), p, np.full(n, 1 / n))

    def _partners(self, others, n):
        """(k, n, ·) random partner samples of a set; of a single sample one is enough."""
        return others.draw((self.partners if len(others.rows) > 1 else 1, n), self.rng)

    def _reweighted(self, cloud, logs, still):
        reweighted, _ = cloud.reweighted(logs)
        self.depleted += reweighted.effective_sample_size < min(2, len(reweighted.rows))
        if reweighted.effective_sample_size >= RESAMPLING_THRESHOLD * len(reweighted.rows):
            return reweighted
        resampled = reweighted.resampled(self.rng)
        return resampled.roughened(self.shake, self.rng) if still else resampled

    def _store_or_freeze(self, i, cloud):
        """Store a landmark's set; one that lies close together is frozen to a point (5.3.4)."""
        mean = cloud.moments.x
        if len(cloud.rows) > 1 and np.hypot(*cloud.deviations(mean).T).max() < self.close:
            cloud = ParticleSet.unweighted(mean[None])
        self.objects[i] = cloud


def _log_mean(logs):
    """Log of the mean likelihood over partners (log-sum-exp): (k, n) to (n,)."""
    return logsumexp(logs, axis=0) - log(len(logs))
