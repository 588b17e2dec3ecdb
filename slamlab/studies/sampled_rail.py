"""A robot on a rail, for lesson 11: samples beside the Kalman filter, which is exact there."""

import numpy as np

from slamlab.filters import linear_kalman

Q, R = 0.04, 0.25  # variances of a step of 1 m, and of a measured place [m²]
RIGHT, TWICE, LARGEST = "by the likelihood", "by the drive, too", "the largest weight"


def measured(seed, steps=12):
    """Places measured on a drive of steps of one metre.

    Parameters
    ----------
    seed, steps : int

    Returns
    -------
    (steps,) [m]
    """
    rng = np.random.default_rng(seed)
    truth = rng.normal() + np.cumsum(1 + rng.normal(0, np.sqrt(Q), steps))
    return truth + rng.normal(0, np.sqrt(R), steps)


def by_samples(zs, rng, n, rule=RIGHT):
    """Mean and standard deviation of a cloud after the measurements.

    Parameters
    ----------
    zs : (k,) [m]
    rng : numpy.random.Generator
    n : int, samples
    rule : str: RIGHT; TWICE, the weight holds the density of the step, too; LARGEST, all samples go
        on from the one of the largest weight

    Returns
    -------
    float, float [m]
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
    """Mean and standard deviation by the filter of lesson 03.

    Parameters
    ----------
    zs : (k,) [m]
    Q : float, variance of a step that the filter believes in [m²]

    Returns
    -------
    float, float [m]
    """
    b, one = linear_kalman.belief([0], [[1]]), np.eye(1)
    for z in zs:
        b = linear_kalman.predict(b, one, one * Q, one, [1])
        b, _ = linear_kalman.update(b, [z], one, one * R)
    return b.x[0], np.sqrt(b.P[0, 0])
