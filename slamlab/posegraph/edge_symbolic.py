"""Symbolic derivation (SymPy) of an edge's residual and Jacobians, with the names of the code.

The angle is not wrapped here: it equals the angle in the code up to a multiple of 2π.
"""

from slamlab.extras import needs

with needs("symbolic"):
    import sympy as sp
    from sympy import ImmutableMatrix as Matrix

x_i = Matrix(sp.symbols("x_i y_i theta_i", real=True))
x_j = Matrix(sp.symbols("x_j y_j theta_j", real=True))
z = Matrix(sp.symbols("x_z y_z theta_z", real=True))


def relative_pose(a, b):
    """Return pose b relative to pose a, a⁻¹ ⊕ b."""
    back = sp.rot_axis3(a[2])[:2, :2]  # R(θ)ᵀ: SymPy rotates the axes, not the vector
    return Matrix([*(back * (b - a)[:2, :]), b[2] - a[2]])


error = relative_pose(z, relative_pose(x_i, x_j))
J_i = error.jacobian(x_i)
J_j = error.jacobian(x_j)
J_z = error.jacobian(z)
