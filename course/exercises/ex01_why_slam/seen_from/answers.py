# %% way: complex numbers
def seen_from(a, b):
    z = (complex(*b[:2]) - complex(*a[:2])) * np.exp(-1j * a[2])
    return z.real, z.imag, np.angle(np.exp(1j * (b[2] - a[2])))

# %% way: homogeneous matrices
def seen_from(a, b):
    def T(p):
        c, s = np.cos(p[2]), np.sin(p[2])
        return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])

    M = np.linalg.inv(T(a)) @ T(b)
    return np.array([M[0, 2], M[1, 2], np.arctan2(M[1, 0], M[0, 0])])

# %% way: distance and bearing
def seen_from(a, b):
    import math

    r = math.hypot(b[0] - a[0], b[1] - a[1])
    beta = math.atan2(b[1] - a[1], b[0] - a[0]) - a[2]
    turn = b[2] - a[2]
    if turn > math.pi:
        turn -= 2 * math.pi
    if turn < -math.pi:
        turn += 2 * math.pi
    return [r * math.cos(beta), r * math.sin(beta), turn]

# %% way: a rotation back, on a copy
def seen_from(a, b):
    seen = b - a
    c, s = np.cos(a[2]), np.sin(a[2])
    R = np.array([[c, -s], [s, c]])
    seen[:2] = R.T @ seen[:2]
    seen[2] = (seen[2] + np.pi) % (2 * np.pi) - np.pi
    return seen

# %% way: equations solved
def seen_from(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    ahead, left = np.linalg.solve(np.array([[c, -s], [s, c]]), b[:2] - a[:2])
    cosine = np.cos(b[2]) * c + np.sin(b[2]) * s
    sine = np.sin(b[2]) * c - np.cos(b[2]) * s
    return np.array([ahead, left, np.arctan2(sine, cosine)])

# %% way: by the package
def seen_from(a, b):
    from slamlab.geometry import between
    return between(a, b)

# %% right: complex numbers: (b - a) divided by the direction of a
def seen_from(a, b):
    way = complex(b[0] - a[0], b[1] - a[1]) * np.exp(-1j * a[2])
    turn = np.angle(np.exp(1j * (b[2] - a[2])))
    return np.array([way.real, way.imag, turn])

# %% right: rotation matrix transposed
def seen_from(a, b):
    R = np.array([[np.cos(a[2]), -np.sin(a[2])], [np.sin(a[2]), np.cos(a[2])]])
    ahead, left = R.T @ (b[:2] - a[:2])
    turn = (b[2] - a[2] + np.pi) % (2 * np.pi) - np.pi
    return np.array([ahead, left, turn])

# %% wrong: subtracts in place, changes b
def seen_from(a, b):
    b -= a
    c, s = np.cos(a[2]), np.sin(a[2])
    return np.array([c * b[0] + s * b[1], c * b[1] - s * b[0], np.arctan2(np.sin(b[2]), np.cos(b[2]))])

# %% wrong: next_pose with minus signs
def seen_from(a, b):
    return next_pose(b, -a)
