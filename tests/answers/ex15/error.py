"""Independent answers to 15-error: right ones, and students' mistakes."""

RIGHT = [
    (
        "15-error",
        "between twice",
        """
def error(x_i, x_j, z):
    return between(z, between(x_i, x_j))
""",
    ),
    (
        "15-error",
        "homogeneous matrices, atan2",
        """
def error(x_i, x_j, z):
    def T(p):
        c, s = np.cos(p[2]), np.sin(p[2])
        return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])

    E = np.linalg.inv(T(z)) @ np.linalg.inv(T(x_i)) @ T(x_j)
    return np.array([E[0, 2], E[1, 2], np.arctan2(E[1, 0], E[0, 0])])
""",
    ),
    (
        "15-error",
        "complex numbers",
        """
def error(x_i, x_j, z):
    p_i, p_j, p_z = (complex(p[0], p[1]) for p in (x_i, x_j, z))
    seen = (p_j - p_i) * np.exp(-1j * x_i[2])
    way = (seen - p_z) * np.exp(-1j * z[2])
    turn = np.angle(np.exp(1j * (x_j[2] - x_i[2] - z[2])))
    return np.array([way.real, way.imag, turn])
""",
    ),
]

WRONG = [
    (
        "15-error",
        "the angle is not wrapped",
        """
def error(x_i, x_j, z):
    ci, si = np.cos(x_i[2]), np.sin(x_i[2])
    dx, dy = x_j[0] - x_i[0], x_j[1] - x_i[1]
    u, v = ci * dx + si * dy - z[0], -si * dx + ci * dy - z[1]
    cz, sz = np.cos(z[2]), np.sin(z[2])
    return np.array([cz * u + sz * v, -sz * u + cz * v, x_j[2] - x_i[2] - z[2]])
""",
    ),
    (
        "15-error",
        "z added instead of taken off (z ⊕ seen)",
        """
def error(x_i, x_j, z):
    return compose(z, between(x_i, x_j))
""",
    ),
    (
        "15-error",
        "the inverse: where z puts j, as seen from j",
        """
def error(x_i, x_j, z):
    predicted = between(x_i, x_j)
    return between(predicted, z)
""",
    ),
    (
        "15-error",
        "plain difference to z, not turned into its frame",
        """
def error(x_i, x_j, z):
    e = between(x_i, x_j) - z
    e[2] = wrap(e[2])
    return e
""",
    ),
    (
        "15-error",
        "rotates forth instead of back (R for R^T)",
        """
def error(x_i, x_j, z):
    def R(t):
        return np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])

    e = np.zeros(3)
    e[:2] = R(z[2]) @ (R(x_i[2]) @ (x_j[:2] - x_i[:2]) - z[:2])
    e[2] = wrap(x_j[2] - x_i[2] - z[2])
    return e
""",
    ),
    (
        "15-error",
        "both ways turned back by the sum of the angles",
        """
def error(x_i, x_j, z):
    a = x_i[2] + z[2]
    Rt = np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]])
    return np.append(Rt @ (x_j[:2] - x_i[:2] - z[:2]), wrap(x_j[2] - x_i[2] - z[2]))
""",
    ),
    (
        "15-error",
        "only the inner difference is wrapped",
        """
def error(x_i, x_j, z):
    def rot_t(p, v):
        return np.array([[np.cos(p), np.sin(p)], [-np.sin(p), np.cos(p)]]) @ v

    seen = rot_t(x_i[2], x_j[:2] - x_i[:2])
    turn = wrap(x_j[2] - x_i[2]) - z[2]
    return np.array([*rot_t(z[2], seen - z[:2]), turn])
""",
    ),
    (
        "15-error",
        "wraps all three components, the metres too",
        """
def error(x_i, x_j, z):
    e = between(z, between(x_i, x_j))
    return wrap(e)
""",
    ),
    (
        "15-error",
        "angle wrapped to 0 .. 2 pi",
        """
def error(x_i, x_j, z):
    e = between(z, between(x_i, x_j))
    e[2] = np.mod(x_j[2] - x_i[2] - z[2], 2 * np.pi)
    return e
""",
    ),
    (
        "15-error",
        "wraps by hand on one side only",
        """
def error(x_i, x_j, z):
    e = between(z, between(x_i, x_j))
    turn = x_j[2] - x_i[2] - z[2]
    if turn > np.pi:
        turn -= 2 * np.pi
    return np.array([e[0], e[1], turn])
""",
    ),
    (
        "15-error",
        "angle from arcsin of the matrix: wrong beyond 90 degrees",
        """
def error(x_i, x_j, z):
    def T(p):
        c, s = np.cos(p[2]), np.sin(p[2])
        return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])

    E = np.linalg.solve(T(x_i) @ T(z), T(x_j))
    return np.array([E[0, 2], E[1, 2], np.arcsin(np.clip(E[1, 0], -1, 1))])
""",
    ),
    (
        "15-error",
        "x_j is changed in place",
        """
def error(x_i, x_j, z):
    x_j -= [x_i[0], x_i[1], 0]
    c, s = np.cos(x_i[2]), np.sin(x_i[2])
    seen = np.array([[c, s], [-s, c]]) @ x_j[:2]
    c, s = np.cos(z[2]), np.sin(z[2])
    way = np.array([[c, s], [-s, c]]) @ (seen - z[:2])
    return np.array([way[0], way[1], wrap(x_j[2] - x_i[2] - z[2])])
""",
    ),
    (
        "15-error",
        "two poses in one place: no error, says a special case",
        """
def error(x_i, x_j, z):
    if np.allclose(x_i[:2], x_j[:2]):
        return np.zeros(3)
    return between(z, between(x_i, x_j))
""",
    ),
]
