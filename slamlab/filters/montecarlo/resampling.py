"""Drawing samples by their weights: n tickets of a lottery, or one turn of a comb."""

import numpy as np


def multinomial(weights, n, rng):
    """n independent draws, sample i with probability w_i.

    Parameters
    ----------
    weights : (m,) that sum to one
    n : int, how many to draw
    rng : numpy.random.Generator

    Returns
    -------
    (n,) int rows drawn, in the order of the draws
    """
    edges = np.cumsum(weights)
    # rounding may leave the last edge below one, and a last sample of no weight is never drawn
    return np.searchsorted(edges, rng.random(n) * edges[-1], side="right")


def comb(weights, n, u):
    """The samples that the n teeth (u + k)/n of a comb fall on, k = 0 … n−1.

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
    edges = np.cumsum(weights)
    # teeth before an edge: (u + k)/n < edge
    before = np.ceil(edges * (n / edges[-1]) - u).clip(0, n).astype(int)
    before[edges >= edges[-1]] = n
    return np.repeat(np.arange(len(edges)), np.diff(before, prepend=0))


def systematic(weights, n, rng):
    """Low-variance resampling: a comb with one random number for all its teeth.

    Parameters
    ----------
    weights : (m,) that sum to one
    n : int, how many to draw
    rng : numpy.random.Generator

    Returns
    -------
    (n,) int rows drawn, ascending
    """
    return comb(weights, n, rng.random())
