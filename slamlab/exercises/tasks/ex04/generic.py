"""What the tasks of exercise 04 share: random poses and covariances, and differences."""

import numpy as np

from slamlab.geometry import wrap

STEP = 1e-6  # [m] or [rad]
DIFFERENCED = 1e-4
"""Share of a matrix's largest entry: one-sided differences with a step of 1e-5 err by less."""


def poses(rng, n):
    """Random poses, (n, 3)."""
    return np.column_stack([rng.uniform(-5, 5, (n, 2)), rng.uniform(-np.pi, np.pi, n)])


def polar(rng, n, near=1.2, far=8.0):
    """Random ranges and bearings all round, (n, 2)."""
    return np.column_stack([rng.uniform(near, far, n), rng.uniform(-np.pi, np.pi, n)])


def covariances(rng, sigmas):
    """Random full covariances with given standard deviations.

    Parameters
    ----------
    rng : numpy.random.Generator
    sigmas : (n, k)

    Returns
    -------
    (n, k, k) ; the twice as many random vectors as numbers keep them well away from singular
    """
    n, k = np.shape(sigmas)
    roots = rng.standard_normal((n, k, 2 * k))
    P = roots @ roots.swapaxes(1, 2)
    scale = sigmas / np.sqrt(np.diagonal(P, axis1=1, axis2=2))
    return P * scale[:, :, None] * scale[:, None, :]


def diagonal(sigmas):
    """Covariances of independent errors, (n, k, k), from standard deviations (n, k)."""
    sigmas = np.asarray(sigmas, dtype=float)
    return sigmas[:, :, None] ** 2 * np.eye(sigmas.shape[1])


def differences(f, x, angle=None):
    """∂f/∂x by central differences, at all points at once.

    Parameters
    ----------
    f : (..., k, k) -> (..., k, m), row by row
    x : (..., k)
    angle : int or None, the component of f that is one: it may jump by a turn between the two

    Returns
    -------
    (..., m, k)
    """
    x, steps = x[..., None, :], STEP * np.eye(x.shape[-1])
    found = (f(x + steps) - f(x - steps)).swapaxes(-1, -2)
    if angle is not None:
        found[..., angle, :] = wrap(found[..., angle, :])
    return found / (2 * STEP)
