"""Particle set: weighted particles, their importance weights, resampling and roughening."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from slamlab.filters.kalman_filter import Belief
from slamlab.filters.particle_filters.importance_weights import effective_sample_size, normalise
from slamlab.filters.particle_filters.resampling import multinomial, systematic
from slamlab.geometry import wrap

RESAMPLING_THRESHOLD = 0.5  # resample below this share: effective sample size / particles


@dataclass(frozen=True)
class ParticleSet:
    """Weighted particles (samples) of a posterior, possibly multimodal: poses or positions.

    Parameters
    ----------
    rows : (n, 2) [m] or (n, 3) [m, m, rad]
    weights : (n,) that sum to one
    """

    rows: np.ndarray
    weights: np.ndarray

    @classmethod
    def unweighted(cls, rows):
        """Create a particle set of n > 0 rows with equal weights. Raises ValueError."""
        rows = np.array(rows, dtype=float)
        if rows.ndim != 2 or rows.shape[1] not in (2, 3) or not len(rows):
            raise ValueError(f"particles have shape {rows.shape}, expected (n, 2) or (n, 3), n > 0")
        if not np.isfinite(rows).all():
            raise ValueError("particles contain NaN or infinity")
        return cls(rows, np.full(len(rows), 1 / len(rows)))

    @cached_property
    def effective_sample_size(self):
        """Effective sample size (ESS, effective number of particles), from 1 to n."""
        return effective_sample_size(self.weights)

    @cached_property
    def moments(self):
        """Weighted mean (circular mean of headings) and covariance, as a Gaussian Belief."""
        mean = self.weights @ self.rows
        if len(mean) == 3:
            c, s = self.weights @ np.cos(self.rows[:, 2]), self.weights @ np.sin(self.rows[:, 2])
            mean[2] = np.arctan2(s, c)
        off = self.deviations(mean)
        return Belief(mean, (off * self.weights[:, None]).T @ off)

    def deviations(self, point):
        """Return the particles' deviations (n, k) from a point, heading differences wrapped."""
        difference = self.rows - point
        if difference.shape[1] == 3:
            difference[:, 2] = wrap(difference[:, 2])
        return difference

    def reweighted(self, logs):
        """Update the importance weights by log-likelihoods l (n,): w_i ← w_i exp l_i, normalised.
        Equation (11.5).

        Returns ParticleSet and log-evidence. If every l_i is −inf, the log-evidence is −inf and the
        weights are unchanged.
        """
        with np.errstate(divide="ignore"):
            weights, evidence = normalise(np.log(self.weights) + logs)
        return (self if evidence == -np.inf else ParticleSet(self.rows, weights)), evidence

    def draw(self, shape, rng):
        """Draw particles (*shape, k) independently by their weights (multinomial sampling)."""
        drawn = multinomial(self.weights, int(np.prod(shape)), rng)
        return self.rows[drawn].reshape(*shape, -1)

    def resampled(self, rng):
        """Resample (systematic, low-variance) to the same number of equally weighted particles."""
        return ParticleSet.unweighted(self.rows[systematic(self.weights, len(self.rows), rng)])

    def roughened(self, share, rng):
        """Roughen (jitter) by a share s, keeping mean and covariance (Liu, West 2001).

        x ← m + √(1 − s²)(x − m) + s L ε,  L Lᵀ the covariance. Against sample impoverishment.
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
    """Draw n poses uniformly in a rectangle, for global localisation (localization)."""
    return ParticleSet.unweighted(rng.uniform([*low, -np.pi], [*high, np.pi], (n, 3)))
