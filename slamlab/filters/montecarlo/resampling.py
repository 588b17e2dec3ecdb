"""Resampling of particles by their weights: multinomial, or systematic (low-variance)."""

import numpy as np


def multinomial(weights, n, rng):
    """Multinomial resampling: n independent draws, sample i with probability w_i.

    Parameters
    ----------
    weights : (m,) that sum to one
    n : int, how many to draw
    rng : numpy.random.Generator

    Returns
    -------
    (n,) int rows drawn, in the order of the draws
    """
    cumulative = np.cumsum(weights)
    # rounding may leave the last edge below one, and a last sample of no weight is never drawn
    return np.searchsorted(cumulative, rng.random(n) * cumulative[-1], side="right")


def systematic_at(weights, n, u):
    """Systematic resampling at a given offset u: a comb of teeth (u + k)/n, k = 0 … n−1.

    Sample i gets ⌊n w_i⌋ or ⌈n w_i⌉ copies, and n w_i on average over u.

    Parameters
    ----------
    weights : (m,) that sum to one
    n : int, how many teeth
    u : float from 0 to below 1, where the first one stands between 0 and 1/n

    Returns
    -------
    (n,) int rows, ascending
    """
    cumulative = np.cumsum(weights)
    # teeth before an edge: (u + k)/n < edge
    before = np.ceil(cumulative * (n / cumulative[-1]) - u).clip(0, n).astype(int)
    before[cumulative >= cumulative[-1]] = n
    return np.repeat(np.arange(len(cumulative)), np.diff(before, prepend=0))


def systematic(weights, n, rng):
    """Systematic (low-variance) resampling: one random number for a comb of n teeth.

    Parameters
    ----------
    weights : (m,) that sum to one
    n : int, how many to draw
    rng : numpy.random.Generator

    Returns
    -------
    (n,) int rows drawn, ascending
    """
    return systematic_at(weights, n, rng.random())
