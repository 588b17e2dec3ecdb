"""SLAM by sets of samples: one for the robot, one for each object (MAK thesis, algorithm 2)."""

from math import log

import numpy as np
from scipy.special import logsumexp

from slamlab.filters.guards import vector
from slamlab.filters.montecarlo import likelihood
from slamlab.filters.montecarlo.association import expected
from slamlab.filters.montecarlo.cloud import ENOUGH, Cloud
from slamlab.filters.montecarlo.motion import moved
from slamlab.filters.montecarlo.sightings import named
from slamlab.models import g


class SampleSets:
    """A set V_r of poses and a set V_L of places for every object, each updated by algorithm 1.

    The sets know nothing of one another: where the update of one needs the place of another, a
    random sample of it is taken. So whatever is known of two of them together, their correlation,
    is lost, and the sets shrink more than they should.

    What the thesis leaves open is our choice:

    - the robot starts at the origin for certain, as the map's frame is laid there;
    - an object starts where random poses of the robot would have seen it, had the noise been
      another one, so its set holds the robot's doubt and the sensor's;
    - a likelihood is the mean over ``partners`` random samples (the thesis: one);
    - a scan updates the seen sets only, every one from what the others were before the scan;
    - a set is drawn anew when it is worth less than half its samples, and where it has not moved
      it is roughened then, without a change of its mean and covariance;
    - which object is seen is for the caller to say.

    Parameters
    ----------
    rng : numpy.random.Generator
    samples : int, of the robot
    object_samples : int, of each object
    partners : int
    close : float, an object is frozen when all its samples lie this close to their mean, 0 for
        never (5.3.4) [m]
    shake : float, share of its spread by which a set is roughened

    ``robot`` is V_r, ``objects`` the others by id; that of a frozen object is a single sample.
    ``starved`` counts updates that left a set worth less than two samples.
    """

    def __init__(self, rng, samples=1000, object_samples=300, partners=10, close=0.05, shake=0.2):
        if min(samples, object_samples, partners) < 1:
            raise ValueError("samples, object_samples and partners are at least one")
        self.rng, self.object_samples, self.partners = rng, object_samples, partners
        self.close, self.shake = close, shake
        self.robot = Cloud.of(np.zeros((samples, 3)))
        self.objects: dict[int, Cloud] = {}
        self.starved = 0
        self._moved = False

    @property
    def ids(self):
        """list of the objects' ids, in the order of first sight."""
        return list(self.objects)

    @property
    def frozen(self):
        """set of the ids of objects that stay where they are."""
        return {i for i, cloud in self.objects.items() if len(cloud.rows) == 1}

    def predict(self, odometry, robot):
        """Move the robot's samples, each with its own noise.

        Parameters
        ----------
        odometry : (3,) motion in the frame of the pose before [m, m, rad]
        robot : RobotModel

        Raises
        ------
        ValueError
        """
        odometry = vector("odometry", odometry, 3)
        self._moved = bool(odometry.any())
        self.robot = Cloud(moved(self.robot.rows, odometry, robot, self.rng), self.robot.weights)

    def add(self, ids, z, R):
        """Make a set for each object seen for the first time.

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
        n = self.object_samples
        for i, one, noise in zip(ids, z, R, strict=True):
            sightings = one + self.rng.standard_normal((n, 2)) @ np.linalg.cholesky(noise).T
            self._keep(i, Cloud.of(g(self.robot.draw((n,), self.rng), sightings)))

    def update(self, ids, z, R):
        """Weigh the robot's set and those of the objects seen, each by random samples of others.

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
        before, logs = self.robot, np.zeros(len(self.robot.rows))
        for i, one, noise in zip(ids, z, R, strict=True):
            seen = self.objects[i]
            partners = self._partners(seen, len(logs))
            logs += _mean(likelihood.of_pairs(before.rows, partners, one, noise))
            if i not in self.frozen:
                partners = self._partners(before, len(seen.rows))
                own = _mean(likelihood.of_pairs(partners, seen.rows, one, noise))
                self._keep(i, self._weighed(seen, own, still=True))
        self.robot = self._weighed(before, logs, still=not self._moved)

    def landmarks(self):
        """(N, 2) the means of the objects' sets [m], in the order of first sight."""
        return np.array([cloud.moments.x for cloud in self.objects.values()]).reshape(-1, 2)

    def expected(self, n=100):
        """How every object would look, by pairs of random samples: wide, as nobody knows how a
        pose and a place go together.

        Parameters
        ----------
        n : int, pairs

        Returns
        -------
        Expected, in the order of ``ids``
        """
        p = [cloud.draw((n,), self.rng) for cloud in self.objects.values()]
        p = np.stack(p, axis=1) if p else np.empty((n, 0, 2))
        return expected(self.robot.draw((n,), self.rng), p, np.full(n, 1 / n))

    def _partners(self, others, n):
        """(k, n, ·) random samples of a set; of a single sample one is as good as many."""
        return others.draw((self.partners if len(others.rows) > 1 else 1, n), self.rng)

    def _weighed(self, cloud, logs, still):
        weighed, _ = cloud.weighed(logs)
        self.starved += weighed.effective < min(2, len(weighed.rows))
        if weighed.effective >= ENOUGH * len(weighed.rows):
            return weighed
        drawn = weighed.resampled(self.rng)
        return drawn.roughened(self.shake, self.rng) if still else drawn

    def _keep(self, i, cloud):
        """Take a set in; one that lies close together becomes a point (5.3.4)."""
        mean = cloud.moments.x
        if len(cloud.rows) > 1 and np.hypot(*cloud.off(mean).T).max() < self.close:
            cloud = Cloud.of(mean[None])
        self.objects[i] = cloud


def _mean(logs):
    """Logarithm of the mean likelihood over partners: (k, n) to (n,)."""
    return logsumexp(logs, axis=0) - log(len(logs))
