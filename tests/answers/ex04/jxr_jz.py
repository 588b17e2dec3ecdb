"""Independent answers to 04-jxr-jz: right ones, and students' mistakes."""

RIGHT = [
    (
        "04-jxr-jz",
        "lever (-dy, dx) from g itself",
        """
def J_xr(x, z):
    dx, dy = g(x, z) - x[:2]
    return np.column_stack([np.eye(2), [-dy, dx]])


def J_z(x, z):
    dx, dy = g(x, z) - x[:2]
    return np.array([[dx / z[0], -dy], [dy / z[0], dx]])
""",
    ),
    (
        "04-jxr-jz",
        "inverse of H's landmark part",
        """
def J_z(x, z):
    return np.linalg.inv(-H_robot(x, g(x, z))[:, :2])


def J_xr(x, z):
    H = H_robot(x, g(x, z))
    return -np.linalg.inv(-H[:, :2]) @ H
""",
    ),
    (
        "04-jxr-jz",
        "rotation matrices",
        """
def _rot(a):
    return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])


def J_xr(x, z):
    J = np.eye(2, 3)
    J[:, 2] = _rot(x[2] + np.pi / 2) @ _rot(z[1]) @ [z[0], 0]
    return J


def J_z(x, z):
    return _rot(x[2]) @ _rot(z[1]) @ np.diag([1.0, z[0]])
""",
    ),
]

WRONG = [
    (
        "04-jxr-jz",
        "heading only, bearing forgotten in J_xr",
        """
def J_xr(x, z):
    r, t = z[0], x[2]
    return np.array([[1, 0, -r * np.sin(t)], [0, 1, r * np.cos(t)]])


def J_z(x, z):
    r, a = z[0], x[2] + z[1]
    return np.array([[np.cos(a), -r * np.sin(a)], [np.sin(a), r * np.cos(a)]])
""",
    ),
    (
        "04-jxr-jz",
        "derivative of cos without its minus, in both",
        """
def J_xr(x, z):
    a = x[2] + z[1]
    J = np.eye(2, 3)
    J[:, 2] = z[0] * np.sin(a), z[0] * np.cos(a)
    return J


def J_z(x, z):
    a = x[2] + z[1]
    return np.array([[np.cos(a), z[0] * np.sin(a)], [np.sin(a), z[0] * np.cos(a)]])
""",
    ),
    (
        "04-jxr-jz",
        "J_z without r (a pure rotation)",
        """
def J_xr(x, z):
    dx, dy = g(x, z) - x[:2]
    return np.array([[1.0, 0, -dy], [0, 1.0, dx]])


def J_z(x, z):
    c, s = np.cos(x[2] + z[1]), np.sin(x[2] + z[1])
    return np.array([[c, -s], [s, c]])
""",
    ),
    (
        "04-jxr-jz",
        "J_z: rows stretched by r instead of columns",
        """
def J_xr(x, z):
    a = x[2] + z[1]
    return np.array([[1, 0, -z[0] * np.sin(a)], [0, 1, z[0] * np.cos(a)]])


def J_z(x, z):
    a = x[2] + z[1]
    turn = np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])
    return np.diag([1, z[0]]) @ turn
""",
    ),
    (
        "04-jxr-jz",
        "J_z in the robot's own frame (no heading)",
        """
def J_xr(x, z):
    a = x[2] + z[1]
    return np.column_stack([np.eye(2), z[0] * np.array([-np.sin(a), np.cos(a)])])


def J_z(x, z):
    r, b = z
    return np.array([[np.cos(b), -r * np.sin(b)], [np.sin(b), r * np.cos(b)]])
""",
    ),
    (
        "04-jxr-jz",
        "bearing counted clockwise: theta - beta",
        """
def J_xr(x, z):
    r, a = z[0], x[2] - z[1]
    return np.array([[1, 0, -r * np.sin(a)], [0, 1, r * np.cos(a)]])


def J_z(x, z):
    r, a = z[0], x[2] - z[1]
    return np.array([[np.cos(a), r * np.sin(a)], [np.sin(a), -r * np.cos(a)]])
""",
    ),
    (
        "04-jxr-jz",
        "lever about the origin: (-p_y, p_x) of the landmark itself",
        """
def J_xr(x, z):
    p = g(x, z)
    return np.array([[1, 0, -p[1]], [0, 1, p[0]]])


def J_z(x, z):
    d = g(x, z) - x[:2]
    return np.array([[d[0] / z[0], -d[1]], [d[1] / z[0], d[0]]])
""",
    ),
    (
        "04-jxr-jz",
        "writes floats into an integer array",
        """
def J_xr(x, z):
    J = np.array([[1, 0, 0], [0, 1, 0]])
    J[0, 2] = -z[0] * np.sin(x[2] + z[1])
    J[1, 2] = z[0] * np.cos(x[2] + z[1])
    return J


def J_z(x, z):
    a = x[2] + z[1]
    return np.array([[np.cos(a), -z[0] * np.sin(a)], [np.sin(a), z[0] * np.cos(a)]])
""",
    ),
    (
        "04-jxr-jz",
        "direction folded modulo pi",
        """
def direction_of(x, z):
    return (x[2] + z[1]) % np.pi


def J_xr(x, z):
    a = direction_of(x, z)
    return np.array([[1, 0, -z[0] * np.sin(a)], [0, 1, z[0] * np.cos(a)]])


def J_z(x, z):
    a = direction_of(x, z)
    return np.array([[np.cos(a), -z[0] * np.sin(a)], [np.sin(a), z[0] * np.cos(a)]])
""",
    ),
    (
        "04-jxr-jz",
        "x[2] += bearing in place",
        """
def J_xr(x, z):
    x[2] += z[1]
    return np.array([[1, 0, -z[0] * np.sin(x[2])], [0, 1, z[0] * np.cos(x[2])]])


def J_z(x, z):
    a = x[2] + z[1]
    return np.array([[np.cos(a), -z[0] * np.sin(a)], [np.sin(a), z[0] * np.cos(a)]])
""",
    ),
    (
        "04-jxr-jz",
        "inverse of H without the minus of the landmark's part",
        """
def J_xr(x, z):
    return np.array([
        [1, 0, -z[0] * np.sin(x[2] + z[1])],
        [0, 1, z[0] * np.cos(x[2] + z[1])],
    ])


def J_z(x, z):
    H = H_robot(x, g(x, z))
    return np.linalg.inv(H[:, :2])
""",
    ),
    (
        "04-jxr-jz",
        "J_z uses what J_xr left in a global: stale",
        """
_last = {}


def J_xr(x, z):
    _last["c"], _last["s"] = np.cos(x[2] + z[1]), np.sin(x[2] + z[1])
    return np.array([[1, 0, -z[0] * _last["s"]], [0, 1, z[0] * _last["c"]]])


def J_z(x, z):
    if not _last:
        J_xr(x, z)
    c, s = _last["c"], _last["s"]
    return np.array([[c, -z[0] * s], [s, z[0] * c]])
""",
    ),
    (
        "04-jxr-jz",
        "columns of J_z in the order bearing, range",
        """
def J_xr(x, z):
    c, s = np.cos(x[2] + z[1]), np.sin(x[2] + z[1])
    return np.c_[np.eye(2), [-z[0] * s, z[0] * c]]


def J_z(x, z):
    c, s = np.cos(x[2] + z[1]), np.sin(x[2] + z[1])
    by_range, by_bearing = [c, s], [-z[0] * s, z[0] * c]
    return np.column_stack([by_bearing, by_range])
""",
    ),
    (
        "04-jxr-jz",
        "both transposed",
        """
def J_xr(x, z):
    a = x[2] + z[1]
    return np.vstack([np.eye(2), [-z[0] * np.sin(a), z[0] * np.cos(a)]])


def J_z(x, z):
    a = x[2] + z[1]
    return np.vstack([[np.cos(a), np.sin(a)], [-z[0] * np.sin(a), z[0] * np.cos(a)]])
""",
    ),
    (
        "04-jxr-jz",
        "one-sided differences, step 0.01 rad",
        """
def J_xr(x, z):
    return np.column_stack([(g(x + e, z) - g(x, z)) / 0.01 for e in 0.01 * np.eye(3)])


def J_z(x, z):
    return np.column_stack([(g(x, z + e) - g(x, z)) / 0.01 for e in 0.01 * np.eye(2)])
""",
    ),
    (
        "04-jxr-jz",
        "small-angle shortcut: heading error moves the landmark by r sideways of the robot",
        """
def J_xr(x, z):
    side = np.array([-np.sin(x[2]), np.cos(x[2])])
    ahead = z[0] * np.cos(z[1])
    return np.column_stack([np.eye(2), ahead * side])


def J_z(x, z):
    a = x[2] + z[1]
    return np.array([[np.cos(a), -z[0] * np.sin(a)], [np.sin(a), z[0] * np.cos(a)]])
""",
    ),
]
