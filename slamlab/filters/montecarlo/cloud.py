"""A cloud of weighted samples, and what can be done with any of them."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from slamlab.filters.linear import Belief
from slamlab.filters.montecarlo.resampling import multinomial, systematic
from slamlab.filters.montecarlo.weights import effective_size, normalise
from slamlab.geometry import wrap

ENOUGH = 0.5  # resample when the cloud is worth less than this share of its samples


@dataclass(frozen=True)
class Cloud:
    """A belief as samples: of poses where a row has three numbers, else of places.

    Parameters
    ----------
    rows : (n, 2) [m] or (n, 3) [m, m, rad]
    weights : (n,) that sum to one
    """

    rows: np.ndarray
    weights: np.ndarray

    @classmethod
    def of(cls, rows):
        """A cloud of equal weights.

        Parameters
        ----------
        rows : (n, 2) or (n, 3), n above zero

        Returns
        -------
        Cloud

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
    def effective(self):
        """float, how many equal samples the cloud is worth, from 1 to n."""
        return effective_size(self.weights)

    @cached_property
    def moments(self):
        """Belief with the cloud's weighted mean (of headings: the direction of their mean
        arrow) and covariance round it."""
        mean = self.weights @ self.rows
        if len(mean) == 3:
            c, s = self.weights @ np.cos(self.rows[:, 2]), self.weights @ np.sin(self.rows[:, 2])
            mean[2] = np.arctan2(s, c)
        off = self.off(mean)
        return Belief(mean, (off * self.weights[:, None]).T @ off)

    def off(self, place):
        """(n, k) the rows less a place, headings by the shorter way."""
        off = self.rows - place
        if off.shape[1] == 3:
            off[:, 2] = wrap(off[:, 2])
        return off

    def weighed(self, logs):
        """The cloud after a measurement: w_i ← w_i exp l_i, normalised.

        Where no sample can explain the measurement (every l_i is −inf) the weights stay.

        Parameters
        ----------
        logs : (n,) log likelihoods of the measurement, given each sample

        Returns
        -------
        Cloud
        float, log likelihood of the measurement given the whole cloud, −inf when impossible
        """
        with np.errstate(divide="ignore"):
            weights, evidence = normalise(np.log(self.weights) + logs)
        return (self if evidence == -np.inf else Cloud(self.rows, weights)), evidence

    def draw(self, shape, rng):
        """Rows drawn at random by their weights, each on its own.

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
        """As many samples, of equal weight, drawn by the weights with a comb.

        Parameters
        ----------
        rng : numpy.random.Generator

        Returns
        -------
        Cloud
        """
        return Cloud.of(self.rows[systematic(self.weights, len(self.rows), rng)])

    def roughened(self, share, rng):
        """The samples shaken without a change of their mean and covariance.

        x ← m + √(1 − s²)(x − m) + s L ε,  L Lᵀ the cloud's covariance

        Where samples never move, resampling leaves ever fewer places among them; this makes new
        ones (Liu and West's kernel; plain noise would widen the cloud with each step).

        Parameters
        ----------
        share : float s, from 0 (as it is) to 1 (drawn anew from a Gaussian)
        rng : numpy.random.Generator

        Returns
        -------
        Cloud
        """
        mean, P = self.moments.x, self.moments.P
        variances, directions = np.linalg.eigh(P)
        L = directions * np.sqrt(np.maximum(variances, 0.0))
        noise = rng.standard_normal(self.rows.shape) @ L.T
        rows = mean + np.sqrt(1 - share**2) * self.off(mean) + share * noise
        if len(mean) == 3:
            rows[:, 2] = wrap(rows[:, 2])
        return Cloud(rows, self.weights)


def uniform(n, low, high, rng):
    """Poses anywhere in a rectangle, in any direction: knowing nothing.

    Parameters
    ----------
    n : int
    low, high : (2,) its corners [m]
    rng : numpy.random.Generator

    Returns
    -------
    Cloud of poses
    """
    return Cloud.of(rng.uniform([*low, -np.pi], [*high, np.pi], (n, 3)))
