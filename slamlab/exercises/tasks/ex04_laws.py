"""Laws of exercise 04: derivatives are differences of the models, covariances those of samples."""

import numpy as np

from slamlab import models
from slamlab.geometry import wrap

TOLERANCE = 1e-4
"""Share of a matrix's largest entry: one-sided differences pass, no classic mistake does."""

STEP = 1e-6  # [m] or [rad]
SAMPLE_PAIRS = 128
SAMPLE_TOLERANCE = 0.01
"""Of a covariance, as a share of the two standard deviations."""

NARROW = 0.1
"""Samples lie this much closer to their mean than the belief says: there the model is straight."""


def close(got, want):
    """Whether matrices agree, for each input.

    Parameters
    ----------
    got, want : (n, ...)

    Returns
    -------
    (n,) bool
    """
    error, size = (np.abs(a).reshape(len(got), -1).max(axis=1) for a in (got - want, want))
    return error <= TOLERANCE * size


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


def by_robot(inputs):
    """∂h/∂x by differences, (n, 2, 3)."""
    p = inputs["p"][:, None]
    return differences(lambda x: models.h(x, p), inputs["x"], 1)


def by_landmark(inputs):
    """∂h/∂p by differences, (n, 2, 2)."""
    x = inputs["x"][:, None]
    return differences(lambda p: models.h(x, p), inputs["p"], 1)


def by_pose(inputs):
    """∂f/∂x of the odometry model by differences, (n, 3, 3)."""
    u = inputs["u"].T
    return differences(lambda x: models.f_odometry(x.T, u).T, inputs["x"], 2)


def new_by_robot(inputs):
    """∂g/∂x by differences, (n, 2, 3)."""
    z = inputs["z"][:, None]
    return differences(lambda x: models.g(x, z), inputs["x"])


def new_by_measurement(inputs):
    """∂g/∂z by differences, (n, 2, 2)."""
    x = inputs["x"][:, None]
    return differences(lambda z: models.g(x, z), inputs["z"])


def sampled(inputs):
    """Joint covariance of pose and new landmark, from samples of the pose and of the measurement.

    Parameters
    ----------
    inputs : x (n, 3), P (n, 3, 3), z (n, 2), R (n, 2, 2)

    Returns
    -------
    (n, 5, 5) : pose first, landmark last
    """
    x, z = inputs["x"][:, None], inputs["z"][:, None]
    x_errors = NARROW * WHITE[:, :3] @ np.linalg.cholesky(inputs["P"]).swapaxes(1, 2)
    z_errors = NARROW * WHITE[:, 3:] @ np.linalg.cholesky(inputs["R"]).swapaxes(1, 2)
    joint = np.concatenate([x_errors, models.g(x + x_errors, z + z_errors)], axis=2)
    joint -= joint.mean(axis=1, keepdims=True)
    return joint.swapaxes(1, 2) @ joint / (len(WHITE) * NARROW**2)


def agree(got, block, inputs):
    """Whether a block of the covariance agrees with the samples', in units of standard deviations.

    Parameters
    ----------
    got : (n, a, b)
    block : two slices of the joint covariance's rows and columns
    inputs : of :func:`sampled`

    Returns
    -------
    (n,) bool
    """
    covariance = sampled(inputs)
    sigma = np.sqrt(np.diagonal(covariance, axis1=1, axis2=2))
    scale = (sigma[:, :, None] * sigma[:, None, :])[:, *block]
    error = np.abs(got - covariance[:, *block]) / scale
    return (error <= SAMPLE_TOLERANCE).all(axis=(1, 2))


def _white(rng, pairs, k):
    """Samples with mean 0 and covariance 1, both exact: mirrored, then scaled."""
    half = rng.standard_normal((pairs, k))
    half = half @ np.linalg.inv(np.linalg.cholesky(half.T @ half / pairs)).T
    return np.vstack([half, -half])


WHITE = _white(np.random.default_rng(4), SAMPLE_PAIRS, 5)
"""The same for everyone: a right answer differs by the model's curvature, never by chance."""
