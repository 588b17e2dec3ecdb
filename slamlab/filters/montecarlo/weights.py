"""Importance weights of particles: log-likelihoods, normalised; effective sample size."""

import numpy as np


def normalise(logs):
    """Normalise log weights (log-sum-exp): w_i = exp(l_i − log Σ exp l_j), sum one.

    Equation (11.7). Taking the largest out first keeps likelihoods of e⁻¹⁰⁰⁰⁰⁰ apart from zero.

    Parameters
    ----------
    logs : (n,) logarithms of weights up to one constant; −inf is a weight of zero

    Returns
    -------
    (n,) weights; equal ones where every weight is zero
    float, log Σ exp l_i: with weights of the prior and likelihoods in it, how likely the
        measurement was; −inf says that every weight is zero

    Raises
    ------
    ValueError : no samples, NaN or +inf
    """
    logs = np.asarray(logs, dtype=float)
    if logs.ndim != 1 or not len(logs):
        raise ValueError(f"log weights have shape {logs.shape}, expected (n,) with n above zero")
    top = logs.max()
    if not top < np.inf:
        raise ValueError("a log weight is NaN or +inf: a likelihood is a finite number")
    if top == -np.inf:
        return np.full(len(logs), 1 / len(logs)), -np.inf
    weights = np.exp(logs - top)
    total = weights.sum()
    return weights / total, float(top + np.log(total))


def effective_sample_size(weights):
    """Effective sample size (effective number of particles): 1 / Σ w_i², from 1 to n.

    Equation (11.6).

    Parameters
    ----------
    weights : (n,) that sum to one

    Returns
    -------
    float
    """
    weights = np.asarray(weights, dtype=float)
    return float(1 / (weights @ weights))


effective_size = effective_sample_size  # name in the first edition
