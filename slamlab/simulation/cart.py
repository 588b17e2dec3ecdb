"""A cart that rolls along a corridor: the linear system of lesson 03, and random drives of it.

Its state is its distance to the wall behind it [m] and its speed [m/s]; a motor pushes it, a range
finder sees its position.
"""

import numpy as np

T = 0.5
"""Time of a step [s]."""
F = np.array([[1, T], [0, 1]])
"""(2, 2) what a step makes of the state; Equation (03.6)."""
G = np.array([[T**2 / 2], [T]])
"""(2, 1) what a push [m/s²] adds to it; Equation (03.6)."""
Q = np.diag([0.02, 0.05]) ** 2
"""(2, 2) covariance of what nobody knows of a step."""
H = np.array([[1.0, 0.0]])
"""(1, 2) what the range finder sees of the state."""
R = np.array([[0.3**2]])
"""(1, 1) covariance of the range finder's noise."""
START_X, START_P = np.array([2.0, 0.0]), np.diag([0.4, 0.3]) ** 2
"""The belief before the first step: (2,) and (2, 2)."""

STEPS = 60
PUSHES = np.zeros((STEPS, 1))
"""(60, 1) the motor pushes for 3 s, the cart rolls, the motor brakes for 3 s [m/s²]."""
PUSHES[:6], PUSHES[44:50] = 0.3, -0.3


def drives(rng, runs, blocked=slice(24, 36)):
    """Simulate drives of the cart: x ← F x + G u + q and z = H x + ε; Equations (03.5) and (03.9).

    Parameters
    ----------
    rng : numpy.random.Generator
    runs : int
    blocked : slice of the steps in which somebody stands before the range finder

    Returns
    -------
    truth (runs, 60, 2), zs (runs, 60, 1) with NaN where nothing was measured
    """
    x = rng.multivariate_normal(START_X, START_P, runs)
    truth = np.empty((runs, STEPS, 2))
    for step, u in enumerate(PUSHES):
        x = x @ F.T + G @ u + rng.multivariate_normal([0, 0], Q, runs)
        truth[:, step] = x
    zs = truth @ H.T + rng.normal(0, np.sqrt(R.item()), (runs, STEPS, 1))
    zs[:, blocked] = np.nan
    return truth, zs
