"""Symbolic derivation (SymPy) of the models and Jacobians, with the names of the code.

Angles are not wrapped here: they equal the angles in the code up to a multiple of 2π.
"""

import numpy as np

from slamlab.extras import needs

with needs("symbolic"):
    import sympy as sp
    from sympy import ImmutableMatrix as Matrix

x, y, theta = sp.symbols("x y theta", real=True)
d, dtheta, V, gamma = sp.symbols("d Δθ V gamma", real=True)
B, T = sp.symbols("B T", positive=True)
p_x, p_y = sp.symbols("p_x p_y", real=True)
r = sp.symbols("r", positive=True)
beta = sp.symbols("beta", real=True)
rho, alpha, rho_seen, alpha_seen = sp.symbols("rho alpha rho' alpha'", real=True)

pose = Matrix([x, y, theta])
u_odometry = Matrix([d, dtheta])
u_steered = Matrix([V, gamma])
p = Matrix([p_x, p_y])
z = Matrix([r, beta])
line = Matrix([rho, alpha])
z_line = Matrix([rho_seen, alpha_seen])

f_odometry = Matrix([x + d * sp.cos(theta), y + d * sp.sin(theta), theta + dtheta])

f_steered = Matrix(
    [
        x + T * V * sp.cos(theta + gamma),
        y + T * V * sp.sin(theta + gamma),
        theta + T * V / B * sp.sin(gamma),
    ]
)

h = Matrix([sp.sqrt((p_x - x) ** 2 + (p_y - y) ** 2), sp.atan2(p_y - y, p_x - x) - theta])

g = Matrix([x + r * sp.cos(theta + beta), y + r * sp.sin(theta + beta)])

A_odometry = f_odometry.jacobian(pose)
W_odometry = f_odometry.jacobian(u_odometry)
A_steered = f_steered.jacobian(pose)
W_steered = f_steered.jacobian(u_steered)
H_robot = h.jacobian(pose)
H_landmark = h.jacobian(p)
J_xr = g.jacobian(pose)
J_z = g.jacobian(z)

h_line = Matrix([rho - x * sp.cos(alpha) - y * sp.sin(alpha), alpha - theta])

_alpha = theta + alpha_seen
g_line = Matrix([rho_seen + x * sp.cos(_alpha) + y * sp.sin(_alpha), _alpha])

H_robot_line = h_line.jacobian(pose)
H_line = h_line.jacobian(line)
J_xr_line = g_line.jacobian(pose)
J_z_line = g_line.jacobian(z_line)


def numeric(expression, *arguments):
    """Lambdify a SymPy matrix: like a model, ``numeric(H_robot, pose, p)`` takes arrays."""
    names = [list(a) if isinstance(a, sp.MatrixBase) else a for a in arguments]
    values = list(expression) if expression.shape[1] == 1 else expression
    evaluate = sp.lambdify(names, values, "numpy")

    def call(*numbers):
        return np.array(evaluate(*numbers), dtype=float)

    return call
