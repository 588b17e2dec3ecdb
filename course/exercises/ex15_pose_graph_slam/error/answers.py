# %% way: matrices
def error(x_i, x_j, z):
    def R(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    ti, tj, tz = x_i[:2], x_j[:2], z[:2]
    way = R(z[2]).T @ (R(x_i[2]).T @ (tj - ti) - tz)
    turn = wrap(float(x_j[2] - x_i[2] - z[2]))
    return np.array([way[0], way[1], turn])

# %% way: by the package's ⊕
def error(x_i, x_j, z):
    from slamlab.geometry import between
    return between(z, between(x_i, x_j))

# %% way: inverse and compose
def error(x_i, x_j, z):
    from slamlab.geometry import compose, inverse
    return compose(inverse(z), compose(inverse(x_i), x_j))

# %% way: from where z leads to
def error(x_i, x_j, z):
    from slamlab.geometry import between, compose
    there = compose(x_i, z)
    return between(there, x_j)

# %% way: as a list, atan2 for wrap
def error(x_i, x_j, z):
    angle = x_i[2] + z[2]
    dx = x_j[0] - x_i[0] - z[0] * np.cos(x_i[2]) + z[1] * np.sin(x_i[2])
    dy = x_j[1] - x_i[1] - z[0] * np.sin(x_i[2]) - z[1] * np.cos(x_i[2])
    turn = x_j[2] - angle
    e_x = np.cos(angle) * dx + np.sin(angle) * dy
    e_y = np.cos(angle) * dy - np.sin(angle) * dx
    return [e_x, e_y, np.arctan2(np.sin(turn), np.cos(turn))]

# %% way: homogeneous matrices
def error(x_i, x_j, z):
    def T(p):
        c, s = np.cos(p[2]), np.sin(p[2])
        return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])

    E = np.linalg.inv(T(z)) @ np.linalg.inv(T(x_i)) @ T(x_j)
    return np.array([E[0, 2], E[1, 2], np.arctan2(E[1, 0], E[0, 0])])

# %% way: complex numbers
def error(x_i, x_j, z):
    seen = complex(*(x_j - x_i)[:2]) * np.exp(-1j * x_i[2])
    way = (seen - complex(z[0], z[1])) * np.exp(-1j * z[2])
    turn = np.angle(np.exp(1j * (x_j[2] - x_i[2] - z[2])))
    return np.array([way.real, way.imag, turn])

# %% way: a copy is changed
def error(x_i, x_j, z):
    e = np.array(x_j, dtype=float)
    for pose in (x_i, z):
        e -= pose
        c, s = np.cos(pose[2]), np.sin(pose[2])
        e[:2] = np.array([[c, s], [-s, c]]) @ e[:2]
    while e[2] > np.pi:
        e[2] -= 2 * np.pi
    while e[2] < -np.pi:
        e[2] += 2 * np.pi
    return e

# %% right: between twice
def error(x_i, x_j, z):
    return between(z, between(x_i, x_j))

# %% right: complex numbers
def error(x_i, x_j, z):
    p_i, p_j, p_z = (complex(p[0], p[1]) for p in (x_i, x_j, z))
    seen = (p_j - p_i) * np.exp(-1j * x_i[2])
    way = (seen - p_z) * np.exp(-1j * z[2])
    turn = np.angle(np.exp(1j * (x_j[2] - x_i[2] - z[2])))
    return np.array([way.real, way.imag, turn])

# %% right: homogeneous matrices
def error(x_i, x_j, z):
    def T(p):
        c, s = np.cos(p[2]), np.sin(p[2])
        return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])
    M = np.linalg.solve(T(x_i) @ T(z), T(x_j))
    return [M[0, 2], M[1, 2], np.arctan2(M[1, 0], M[0, 0])]

# %% right: pose j seen from compose(x_i, z), by homogeneous matrices
def error(x_i, x_j, z):
    def matrix(p):
        c, s = np.cos(p[2]), np.sin(p[2])
        return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])

    E = np.linalg.inv(matrix(x_i) @ matrix(z)) @ matrix(x_j)
    return np.array([E[0, 2], E[1, 2], np.arctan2(E[1, 0], E[0, 0])])

# %% wrong: wraps by hand on one side only
def error(x_i, x_j, z):
    e = between(z, between(x_i, x_j))
    turn = x_j[2] - x_i[2] - z[2]
    if turn > np.pi:
        turn -= 2 * np.pi
    return np.array([e[0], e[1], turn])

# %% wrong: x_j is changed in place
def error(x_i, x_j, z):
    x_j -= [x_i[0], x_i[1], 0]
    c, s = np.cos(x_i[2]), np.sin(x_i[2])
    seen = np.array([[c, s], [-s, c]]) @ x_j[:2]
    c, s = np.cos(z[2]), np.sin(z[2])
    way = np.array([[c, s], [-s, c]]) @ (seen - z[:2])
    return np.array([way[0], way[1], wrap(x_j[2] - x_i[2] - z[2])])

# %% wrong: two poses in one place: no error, says a special case
def error(x_i, x_j, z):
    if np.allclose(x_i[:2], x_j[:2]):
        return np.zeros(3)
    return between(z, between(x_i, x_j))
