"""Resampling of particles by normalised weights: multinomial, or systematic (low-variance)."""

import numpy as np


def multinomial(weights, n, rng):
    """Multinomial resampling: draw n rows independently, each time row i with probability w_i."""
    cumulative = np.cumsum(weights)
    # the last sum may be below 1 by rounding, and a last particle of weight 0 must not be drawn
    return np.searchsorted(cumulative, rng.random(n) * cumulative[-1], side="right")


def systematic_at(weights, n, u):
    """Systematic resampling: return the ascending rows at positions (u + k)/n, u in [0, 1)."""
    cumulative = np.cumsum(weights)
    # number of positions before each cumulative weight
    before = np.ceil(cumulative * (n / cumulative[-1]) - u).clip(0, n).astype(int)
    before[cumulative >= cumulative[-1]] = n
    return np.repeat(np.arange(len(cumulative)), np.diff(before, prepend=0))


def systematic(weights, n, rng):
    """Systematic (low-variance) resampling: draw one random number for n equidistant positions."""
    return systematic_at(weights, n, rng.random())
