"""Importance weights of particles (importance sampling): normalisation, effective sample size."""

import numpy as np


def normalise(logs):
    """Normalise log-weights (log-sum-exp): w_i = exp(l_i − log Σ exp l_j). Equation (11.7).

    Returns the weights (equal if all l are −inf) and log Σ exp l_i. ValueError: empty, NaN or +inf.
    """
    logs = np.asarray(logs, dtype=float)
    if logs.ndim != 1 or not len(logs):
        raise ValueError(f"log-weights have shape {logs.shape}, expected (n,) with n > 0")
    top = logs.max()
    if not top < np.inf:
        raise ValueError("a log-weight is NaN or +inf: a likelihood must be finite")
    if top == -np.inf:
        return np.full(len(logs), 1 / len(logs)), -np.inf
    weights = np.exp(logs - top)
    total = weights.sum()
    return weights / total, float(top + np.log(total))


def effective_sample_size(weights):
    """Effective sample size (effective number of particles): 1 / Σ w_i². Equation (11.6)."""
    weights = np.asarray(weights, dtype=float)
    return float(1 / (weights @ weights))
