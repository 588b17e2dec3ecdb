"""Particle filter's belief: weighted samples (a cloud), reweighted, resampled, roughened."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from slamlab.filters.linear_kalman import Belief
from slamlab.filters.montecarlo.resampling import multinomial, systematic
from slamlab.filters.montecarlo.weights import effective_sample_size, normalise
from slamlab.geometry import wrap

RESAMPLING_THRESHOLD = 0.5  # resample below this share: effective sample size / particles


@dataclass(frozen=True)
class ParticleSet:
    """A belief as weighted particles (samples): poses of three numbers or positions of two.

    Parameters
    ----------
    rows : (n, 2) [m] or (n, 3) [m, m, rad]
    weights : (n,) that sum to one
    """

    rows: np.ndarray
    weights: np.ndarray

    @classmethod
    def unweighted(cls, rows):
        """A particle set of equal weights.

        Parameters
        ----------
        rows : (n, 2) or (n, 3), n above zero

        Returns
        -------
        ParticleSet

        Raises
        ------
        ValueError
        """
        rows = np.array(rows, dtype=float)
        if rows.ndim != 2 or rows.shape[1] not in (2, 3) or not len(rows):
            raise ValueError(f"samples have shape {rows.shape}, expected (n, 2) or (n, 3), n > 0")
        if not np.isfinite(rows).all():
            raise ValueError("samples hold NaN or infinity")
        return cls(rows, np.full(len(rows), 1 / len(rows)))

    @cached_property
    def effective_sample_size(self):
        """float, effective sample size (ESS, effective number of particles), from 1 to n."""
        return effective_sample_size(self.weights)

    @cached_property
    def moments(self):
        """Mean and covariance of the particles, as a Gaussian belief (of headings the circular
        mean)."""
        mean = self.weights @ self.rows
        if len(mean) == 3:
            c, s = self.weights @ np.cos(self.rows[:, 2]), self.weights @ np.sin(self.rows[:, 2])
            mean[2] = np.arctan2(s, c)
        off = self.deviations(mean)
        return Belief(mean, (off * self.weights[:, None]).T @ off)

    def deviations(self, point):
        """(n, k) deviations of the particles from a point, heading differences wrapped."""
        difference = self.rows - point
        if difference.shape[1] == 3:
            difference[:, 2] = wrap(difference[:, 2])
        return difference

    def reweighted(self, logs):
        """Reweight by a measurement (importance weights): w_i ← w_i exp l_i, normalised.

        Equation (11.5).

        Where no particle can explain the measurement (every l_i is −inf) the weights stay.

        Parameters
        ----------
        logs : (n,) log-likelihoods of the measurement, given each particle

        Returns
        -------
        ParticleSet
        float, log-likelihood of the measurement given the set (evidence), −inf when impossible
        """
        with np.errstate(divide="ignore"):
            weights, evidence = normalise(np.log(self.weights) + logs)
        return (self if evidence == -np.inf else ParticleSet(self.rows, weights)), evidence

    def draw(self, shape, rng):
        """Draw particles independently by their weights (multinomial sampling).

        Parameters
        ----------
        shape : tuple of int
        rng : numpy.random.Generator

        Returns
        -------
        (*shape, k)
        """
        drawn = multinomial(self.weights, int(np.prod(shape)), rng)
        return self.rows[drawn].reshape(*shape, -1)

    def resampled(self, rng):
        """Systematic (low-variance) resampling: as many particles, of equal weight.

        Parameters
        ----------
        rng : numpy.random.Generator

        Returns
        -------
        ParticleSet
        """
        return ParticleSet.unweighted(self.rows[systematic(self.weights, len(self.rows), rng)])

    def roughened(self, share, rng):
        """Roughening (jitter) of the particles that keeps their mean and covariance.

        x ← m + √(1 − s²)(x − m) + s L ε,  L Lᵀ the particles' covariance

        Where particles never move, resampling leaves ever fewer (sample impoverishment); this makes
        new ones (Liu and West's kernel; plain noise would widen the set with each step).

        Parameters
        ----------
        share : float s, from 0 (as it is) to 1 (drawn anew from a Gaussian)
        rng : numpy.random.Generator

        Returns
        -------
        ParticleSet
        """
        mean, P = self.moments.x, self.moments.P
        variances, directions = np.linalg.eigh(P)
        L = directions * np.sqrt(np.maximum(variances, 0.0))
        noise = rng.standard_normal(self.rows.shape) @ L.T
        rows = mean + np.sqrt(1 - share**2) * self.deviations(mean) + share * noise
        if len(mean) == 3:
            rows[:, 2] = wrap(rows[:, 2])
        return ParticleSet(rows, self.weights)


def uniform(n, low, high, rng):
    """Particles of uniform poses in a rectangle, for global localisation (localization).

    Parameters
    ----------
    n : int
    low, high : (2,) its corners [m]
    rng : numpy.random.Generator

    Returns
    -------
    ParticleSet of poses
    """
    return ParticleSet.unweighted(rng.uniform([*low, -np.pi], [*high, np.pi], (n, 3)))
