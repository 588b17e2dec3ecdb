"""Differences (finite differences): slopes of any model, to hold its Jacobian against."""

import numpy as np


def slopes(f, x, step=1e-6):
    """Jacobian ∂f/∂x by central differences: move one component of x a little, see what f does.

    Column j is (f(x + δ e_j) − f(x − δ e_j)) / 2δ; where f holds an angle, it must not jump there.
    Equation (04.2).

    Parameters
    ----------
    f : (n,) -> (m,)
    x : (n,) where the slopes are taken
    step : float δ, in the unit of x

    Returns
    -------
    (m, n)
    """
    x = np.asarray(x, dtype=float)
    moved = step * np.eye(len(x))
    return np.column_stack([(f(x + e) - f(x - e)) / (2 * step) for e in moved])
