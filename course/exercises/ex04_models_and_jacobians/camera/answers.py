# %% way: chain rule over the camera's pose
def camera(x, p, mount, F):
    (a, b), c, s = mount, np.cos(x[2]), np.sin(x[2])
    place = np.array([x[0] + c * a - s * b, x[1] + s * a + c * b, x[2]])
    by_robot = np.array([[1, 0, -s * a - c * b], [0, 1, c * a - s * b], [0, 0, 1]])
    r, bearing = h(place, p)
    row = H_robot(place, p)[1]
    slope = -F / np.cos(bearing) ** 2
    return -F * np.tan(bearing), slope * np.concatenate([row @ by_robot, -row[:2]])

# %% way: complex numbers
def camera(x, p, mount, F):
    turn = np.exp(-1j * x[2])
    seen = (complex(*p) - complex(*x[:2])) * turn
    w = seen - complex(*mount)
    by = np.array([-turn, -1j * turn, -1j * seen, turn, 1j * turn])
    H = -F * (by.imag * w.real - w.imag * by.real) / w.real**2
    return -F * w.imag / w.real, H

# %% way: complex step, one row
def camera(x, p, mount, F):
    def column(v):
        c, s = np.cos(v[2]), np.sin(v[2])
        dx, dy = v[3] - v[0], v[4] - v[1]
        return -F * (c * dy - s * dx - mount[1]) / (c * dx + s * dy - mount[0])
    v = np.concatenate([x, p])
    H = [column(v + 1e-30j * one).imag / 1e-30 for one in np.eye(5)]
    return np.array([column(v)]), np.array([H])

# %% way: entry by entry
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    R = np.array([[c, s], [-s, c]])
    X, Y = R @ (p - x[:2]) - mount
    at = np.array([F * Y, -F * X]) / X**2
    H = np.zeros(5)
    H[3:] = at @ R
    H[:2] = -H[3:]
    H[2] = at @ [Y + mount[1], -X - mount[0]]
    return -F * Y / X, H

# %% pasted: the lesson's bearing row
def camera(x, p, mount, F):
    dx, dy = p[0] - x[0], p[1] - x[1]
    q = dx**2 + dy**2
    u = np.arctan2(dy, dx) - x[2]
    return u, np.array([dy / q, -dx / q, -1, -dy / q, dx / q])

# %% pasted: h and H of the exercise, times F
def camera(x, p, mount, F):
    row = H_robot(x, p)[1]
    return -F * h(x, p)[1], -F * np.concatenate([row, -row[:2]])

# %% pasted: h and H at the camera's place
def camera(x, p, mount, F):
    place = np.array([*g(x, [np.hypot(*mount), np.arctan2(mount[1], mount[0])]), x[2]])
    row = H_robot(place, p)[1]
    return -F * h(place, p)[1], -F * np.concatenate([row, -row[:2]])

# %% pasted: the lesson's slopes of h
def camera(x, p, mount, F):
    def slopes(f, x, step=1e-6):
        return np.array([(f(x + e) - f(x - e)) / (2 * step) for e in step * np.eye(len(x))])
    H = slopes(lambda v: h(v[:3], v[3:])[1], np.concatenate([x, p]))
    return F * h(x, p)[1], F * H

# %% pasted: the tangent of the lesson's bearing
def camera(x, p, mount, F):
    row, bearing = H_robot(x, p)[1], h(x, p)[1]
    H = -F / np.cos(bearing) ** 2 * np.concatenate([row, -row[:2]])
    return -F * np.tan(bearing), H

# %% right: u and matrix product
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    robot = R @ (p - x[:2])
    X, Y = robot - mount
    du = np.array([F * Y / X**2, -F / X])
    D = np.hstack([-R, [[robot[1]], [-robot[0]]], R])
    return -F * Y / X, du @ D

# %% right: H as a (1, 5) matrix
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    D = np.column_stack([-R, [body[1], -body[0]], R])
    return -F * Y / X, np.array([[F * Y / X**2, -F / X]]) @ D

# %% right: by the chain rule, rotation and its derivative as matrices
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    Rt, dRt = np.array([[c, s], [-s, c]]), np.array([[-s, c], [-c, -s]])
    d = np.asarray(p) - x[:2]
    X, Y = Rt @ d - mount
    D = np.column_stack([-Rt, dRt @ d, Rt])
    q = np.array([F * Y / X ** 2, -F / X])
    return float(-F * Y / X), (q @ D).ravel()

# %% wrong: differences over five points
def camera(x, p, mount, F):
    def u(q):
        w = ((q[3] - q[0]) + 1j * (q[4] - q[1])) * np.exp(-1j * q[2]) - complex(*mount)
        return -F * w.imag / w.real
    q = np.array([*x, *p], dtype=float)
    e = 1e-5
    H = np.array([(8 * (u(q + e * k) - u(q - e * k)) - (u(q + 2 * e * k) - u(q - 2 * e * k))) / (12 * e) for k in np.eye(5)])
    return u(q), H

# %% wrong: only the pose's three derivatives, zeros for the landmark
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    by = np.array([F * Y / X**2, -F / X])
    H = np.zeros(5)
    H[:2] = -by @ R
    H[2] = by @ [body[1], -body[0]]
    return -F * Y / X, H

# %% wrong: F as in the picture: hard-coded 500 in H
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    D = np.column_stack([-R, [body[1], -body[0]], R])
    return -F * Y / X, 500 * np.array([Y / X**2, -1 / X]) @ D

# %% wrong: differences with a step so small that rounding eats them
def camera(x, p, mount, F):
    def column(v):
        c, s = np.cos(v[2]), np.sin(v[2])
        dx, dy = v[3] - v[0], v[4] - v[1]
        return -F * (c * dy - s * dx - mount[1]) / (c * dx + s * dy - mount[0])

    v = np.concatenate([x, p])
    u = column(v)
    return u, np.array([(column(v + e) - u) / 1e-13 for e in 1e-13 * np.eye(5)])

# %% wrong: p made relative in place
def camera(x, p, mount, F):
    p -= x[:2]
    c, s = np.cos(x[2]), np.sin(x[2])
    ahead, left = c * p[0] + s * p[1], c * p[1] - s * p[0]
    X, Y = ahead - mount[0], left - mount[1]
    X_by, Y_by = np.array([-c, -s, left, c, s]), np.array([s, -c, -ahead, -s, c])
    return -F * Y / X, -F * (Y_by * X - Y * X_by) / X**2

# %% wrong: u cut at the image's border
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    D = np.column_stack([-R, [body[1], -body[0]], R])
    return float(np.clip(-F * Y / X, -F, F)), np.array([F * Y / X**2, -F / X]) @ D

# %% wrong: rotated the wrong way
def camera(x, p, mount, F):
    dx, dy = p[0] - x[0], p[1] - x[1]
    c, s = np.cos(x[2]), np.sin(x[2])
    ahead, left = c * dx - s * dy, s * dx + c * dy
    X, Y = ahead - mount[0], left - mount[1]
    dX = np.array([-c, s, -left, c, -s])
    dY = np.array([-s, -c, ahead, s, c])
    return -F * Y / X, -F * (dY * X - Y * dX) / X**2
