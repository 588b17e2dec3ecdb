"""Numerical Jacobian of any model by finite differences, to check an analytical Jacobian."""

import numpy as np


def numerical_jacobian(f, x, step=1e-6):
    """Compute the Jacobian (m, n) ∂f/∂x by central differences of f: (n,) → (m,). Equation (04.2).

    Column j is (f(x + δ e_j) − f(x − δ e_j)) / 2δ with δ = step; angles must not wrap in between.
    """
    x = np.asarray(x, dtype=float)
    moved = step * np.eye(len(x))
    return np.column_stack([(f(x + e) - f(x - e)) / (2 * step) for e in moved])
