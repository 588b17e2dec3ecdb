# %% way: columns
def J_xr(x, z):
    r, phi = z[0], x[2] + z[1]
    return np.column_stack([[1, 0], [0, 1], [-r * np.sin(phi), r * np.cos(phi)]])

def J_z(x, z):
    c, s, r = np.cos(x[2] + z[1]), np.sin(x[2] + z[1]), z[0]
    return np.column_stack([[c, s], [-r * s, r * c]])

# %% way: complex step
def place(x, z):
    phi = x[2] + z[1]
    return np.array([x[0] + z[0] * np.cos(phi), x[1] + z[0] * np.sin(phi)])

def J_xr(x, z):
    return np.column_stack([place(x + 1e-30j * one, z).imag / 1e-30 for one in np.eye(3)])

def J_z(x, z):
    return np.column_stack([place(x, z + 1e-30j * one).imag / 1e-30 for one in np.eye(2)])

# %% way: from the place itself
def J_xr(x, z):
    dx, dy = g(x, z) - x[:2]
    return [[1, 0, -dy], [0, 1, dx]]

def J_z(x, z):
    dx, dy = g(x, z) - x[:2]
    return [[dx / z[0], -dy], [dy / z[0], dx]]

# %% way: a turn that is stretched
def J_z(x, z):
    c, s = np.cos(x[2] + z[1]), np.sin(x[2] + z[1])
    return np.array([[c, -s], [s, c]]) @ np.diag([1, z[0]])

def J_xr(x, z):
    return np.hstack([np.eye(2), J_z(x, z)[:, 1:]])

# %% way: complex numbers
def J_xr(x, z):
    beam = z[0] * np.exp(1j * (x[2] + z[1]))
    columns = np.array([1, 1j, 1j * beam])
    return np.array([columns.real, columns.imag])

def J_z(x, z):
    turn = np.exp(1j * (x[2] + z[1]))
    columns = np.array([turn, 1j * z[0] * turn])
    return np.array([columns.real, columns.imag])

# %% way: sympy
import functools
import sympy as sp

@functools.cache
def derived():
    x, y, t, r, b = sp.symbols("x y t r b", real=True)
    model = sp.Matrix([x + r * sp.cos(t + b), y + r * sp.sin(t + b)])
    arguments = [(x, y, t), (r, b)]
    return [sp.lambdify(arguments, model.jacobian(sp.Matrix(by))) for by in arguments]

def J_xr(x, z):
    return derived()[0](x, z)

def J_z(x, z):
    return derived()[1](x, z)

# %% right: lever (-dy, dx) from g itself
def J_xr(x, z):
    dx, dy = g(x, z) - x[:2]
    return np.column_stack([np.eye(2), [-dy, dx]])


def J_z(x, z):
    dx, dy = g(x, z) - x[:2]
    return np.array([[dx / z[0], -dy], [dy / z[0], dx]])

# %% right: inverse of H's landmark part
def J_z(x, z):
    return np.linalg.inv(-H_robot(x, g(x, z))[:, :2])


def J_xr(x, z):
    H = H_robot(x, g(x, z))
    return -np.linalg.inv(-H[:, :2]) @ H

# %% right: rotation matrices
def _rot(a):
    return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])


def J_xr(x, z):
    J = np.eye(2, 3)
    J[:, 2] = _rot(x[2] + np.pi / 2) @ _rot(z[1]) @ [z[0], 0]
    return J


def J_z(x, z):
    return _rot(x[2]) @ _rot(z[1]) @ np.diag([1.0, z[0]])

# %% wrong: central differences of g
def slopes(f, x):
    steps = 1e-6 * np.eye(len(x))
    return np.column_stack([(f(x + step) - f(x - step)) / 2e-6 for step in steps])

def J_xr(x, z):
    return slopes(lambda v: g(v, z), x)

def J_z(x, z):
    return slopes(lambda v: g(x, v), z)

# %% wrong: J_z: rows stretched by r instead of columns
def J_xr(x, z):
    a = x[2] + z[1]
    return np.array([[1, 0, -z[0] * np.sin(a)], [0, 1, z[0] * np.cos(a)]])


def J_z(x, z):
    a = x[2] + z[1]
    turn = np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])
    return np.diag([1, z[0]]) @ turn

# %% wrong: bearing counted clockwise: theta - beta
def J_xr(x, z):
    r, a = z[0], x[2] - z[1]
    return np.array([[1, 0, -r * np.sin(a)], [0, 1, r * np.cos(a)]])


def J_z(x, z):
    r, a = z[0], x[2] - z[1]
    return np.array([[np.cos(a), r * np.sin(a)], [np.sin(a), -r * np.cos(a)]])

# %% wrong: x[2] += bearing in place
def J_xr(x, z):
    x[2] += z[1]
    return np.array([[1, 0, -z[0] * np.sin(x[2])], [0, 1, z[0] * np.cos(x[2])]])


def J_z(x, z):
    a = x[2] + z[1]
    return np.array([[np.cos(a), -z[0] * np.sin(a)], [np.sin(a), z[0] * np.cos(a)]])

# %% wrong: inverse of H without the minus of the landmark's part
def J_xr(x, z):
    return np.array([
        [1, 0, -z[0] * np.sin(x[2] + z[1])],
        [0, 1, z[0] * np.cos(x[2] + z[1])],
    ])


def J_z(x, z):
    H = H_robot(x, g(x, z))
    return np.linalg.inv(H[:, :2])

# %% wrong: J_z uses what J_xr left in a global: stale
_last = {}


def J_xr(x, z):
    _last["c"], _last["s"] = np.cos(x[2] + z[1]), np.sin(x[2] + z[1])
    return np.array([[1, 0, -z[0] * _last["s"]], [0, 1, z[0] * _last["c"]]])


def J_z(x, z):
    if not _last:
        J_xr(x, z)
    c, s = _last["c"], _last["s"]
    return np.array([[c, -z[0] * s], [s, z[0] * c]])

# %% wrong: one-sided differences, step 0.01 rad
def J_xr(x, z):
    return np.column_stack([(g(x + e, z) - g(x, z)) / 0.01 for e in 0.01 * np.eye(3)])


def J_z(x, z):
    return np.column_stack([(g(x, z + e) - g(x, z)) / 0.01 for e in 0.01 * np.eye(2)])

# %% wrong: small-angle shortcut: heading error moves the landmark by r sideways of the robot
def J_xr(x, z):
    side = np.array([-np.sin(x[2]), np.cos(x[2])])
    ahead = z[0] * np.cos(z[1])
    return np.column_stack([np.eye(2), ahead * side])


def J_z(x, z):
    a = x[2] + z[1]
    return np.array([[np.cos(a), -z[0] * np.sin(a)], [np.sin(a), z[0] * np.cos(a)]])
