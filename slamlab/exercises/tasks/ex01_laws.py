"""Laws of exercise 01: what a rigid motion preserves, in complex numbers, and simulated drives.

The plane is read as x + iy, so that a turn is a product: another way than the one asked for.
"""

import functools

import numpy as np

TOLERANCE = 1e-6  # [m] or [rad]
RUNS = 4000
RUNS_TOLERANCE = 0.05
"""Of a spread over that many runs, whose own error is 1.1 %; the draws are fixed, so no luck."""

DEGREES = (
    "Angles are in radians everywhere: np.cos and np.sin take them as they are, nothing is "
    "converted."
)
SWAPPED = (
    "Sine and cosine have changed places. A robot with heading 0 looks along +x, so x goes with "
    "the cosine of the heading."
)


def place_of(poses):
    """The position of poses as x + iy: (..., 3) -> (...) complex [m]."""
    return poses[..., 0] + 1j * poses[..., 1]


def towards(angles):
    """The unit vector in a direction [rad], as a complex number."""
    return np.exp(1j * angles)


def small(difference):
    """Whether differences vanish, for each input: (n, ...) -> (n,) bool."""
    return (np.abs(difference) < TOLERANCE).reshape(len(difference), -1).all(axis=1)


def same_angle(a, b):
    """Whether angles agree up to full turns, for each input."""
    return small(towards(a) - towards(b))


def same_direction(a, b):
    """Whether complex numbers point the same way, however long they are, for each input."""
    return small(a / np.abs(a) - b / np.abs(b))


def wrapped(angles):
    """Whether angles lie in [-π, π], for each input."""
    return (np.abs(angles) <= np.pi + TOLERANCE).reshape(len(angles), -1).all(axis=1)


def between(a, b):
    """The motion from pose a to pose b in a's frame: (..., 3) twice -> complex [m], [rad]."""
    return (place_of(b) - place_of(a)) * towards(-a[..., 2]), b[..., 2] - a[..., 2]


def on_one_line(points):
    """Whether points lie on one straight line: (n, 2) -> bool."""
    return bool(np.linalg.svd(points - points.mean(axis=0), compute_uv=False)[1] < TOLERANCE)


def all_distances(points):
    """Distances between all pairs: (n, k) complex -> (n, k, k) [m]."""
    return np.abs(points[:, :, None] - points[:, None, :])


@functools.cache
def _draws(most):
    return np.random.default_rng(20_22).standard_normal((RUNS, most))


def simulated_drift(n, d, sigma):
    """The spread, sideways, of many simulated drives straight ahead.

    Parameters
    ----------
    n : int, steps
    d : float, length of a step [m]
    sigma : float, standard deviation of the turn picked up after each step [rad]

    Returns
    -------
    float, root mean square distance from the straight line at the end [m]
    """
    headings = sigma * np.cumsum(_draws(n)[:, :-1], axis=1)
    sideways = d * np.sin(headings).sum(axis=1)
    return float(np.sqrt(np.mean(sideways**2)))
