"""Particle filter in one dimension, compared with the Kalman filter, which is exact (lesson 11)."""

import numpy as np

from slamlab.filters import kalman_filter

Q, R = 0.04, 0.25  # variances of a step of 1 m, and of a measured position [m²]
RIGHT, TWICE, LARGEST = "by the likelihood", "with the motion, too", "the largest weight"


def measured(seed, steps=12):
    """Simulate the measured positions (steps,) [m] of a run with steps of one metre."""
    rng = np.random.default_rng(seed)
    truth = rng.normal() + np.cumsum(1 + rng.normal(0, np.sqrt(Q), steps))
    return truth + rng.normal(0, np.sqrt(R), steps)


def by_samples(zs, rng, n, rule=RIGHT):
    """Return the mean and standard deviation [m] of n particles after measurements zs (k,).

    Two rules are wrong: with TWICE, weights also contain the density of the motion; with LARGEST,
    all particles continue from the one with the largest weight.
    """
    x, w = rng.normal(0, 1, n), np.full(n, 1 / n)
    for z in zs:
        before = np.full(n, x[w.argmax()]) if rule == LARGEST else rng.choice(x, n, p=w)
        x = before + 1 + rng.normal(0, np.sqrt(Q), n)
        w = np.exp(-((z - x) ** 2) / (2 * R))
        if rule == TWICE:
            w *= np.exp(-((x - before - 1) ** 2) / (2 * Q))
        w /= w.sum()
    return w @ x, np.sqrt(w @ (x - w @ x) ** 2)


def by_kalman(zs, Q=Q):
    """Return the mean and standard deviation [m] by the Kalman filter of lesson 03, with Q [m²] per
    step."""
    b, one = kalman_filter.belief([0], [[1]]), np.eye(1)
    for z in zs:
        b = kalman_filter.predict(b, one, one * Q, one, [1])
        b, _ = kalman_filter.update(b, [z], one, one * R)
    return b.x[0], np.sqrt(b.P[0, 0])
