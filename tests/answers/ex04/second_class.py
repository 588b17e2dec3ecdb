"""A second class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "04-h-robot",
        "by the unit vector",
        """
def H_robot(x, p):
    d = np.asarray(p, float) - np.asarray(x, float)[:2]
    r = np.hypot(*d)
    e = d / r
    H = np.zeros((2, 3))
    H[0, :2] = -e
    H[1, :2] = [e[1] / r, -e[0] / r]
    H[1, 2] = -1
    return H
""",
    ),
    (
        "04-new-landmark",
        "one big Jacobian",
        """
def new_landmark(x, P, z, R):
    both = np.zeros((5, 5))
    both[:3, :3], both[3:, 3:] = P, R
    J = np.hstack([J_xr(x, z), J_z(x, z)])
    whole = np.vstack([np.eye(3, 5), J])
    S = whole @ both @ whole.T
    return S[3:, 3:], S[:3, 3:]
""",
    ),
    (
        "04-camera",
        "central differences of complex numbers",
        """
def camera(x, p, mount, F):
    def u(q):
        w = ((q[3] - q[0]) + 1j * (q[4] - q[1])) * np.exp(-1j * q[2]) - complex(*mount)
        return -F * w.imag / w.real
    q = np.array([*x, *p], dtype=float)
    e = 1e-5
    H = np.array([(8 * (u(q + e * k) - u(q - e * k)) - (u(q + 2 * e * k) - u(q - 2 * e * k))) / (12 * e) for k in np.eye(5)])
    return u(q), H
""",
    ),
    (
        "04-unsure-drive",
        "exact formulas",
        """
def unsure_drive(x, P, u, C):
    t, s2 = x[2], P[2, 2]
    d, turn = u
    a, b = np.exp(-s2 / 2), np.exp(-2 * s2)
    c, s = np.cos(t), np.sin(t)
    m = np.array([x[0] + d * a * c, x[1] + d * a * s, t + turn])
    S = np.zeros((3, 3))
    dd = d * d + C[0, 0]
    cc = (1 + b * np.cos(2 * t)) / 2
    ss = (1 - b * np.cos(2 * t)) / 2
    sc = b * np.sin(2 * t) / 2
    S[0, 0] = P[0, 0] + dd * cc - d * d * a * a * c * c - 2 * d * P[0, 2] * a * s
    S[1, 1] = P[1, 1] + dd * ss - d * d * a * a * s * s + 2 * d * P[1, 2] * a * c
    S[0, 1] = P[0, 1] + dd * sc - d * d * a * a * c * s + d * a * (c * P[0, 2] - s * P[1, 2])
    S[0, 2] = P[0, 2] - d * a * s * s2 + C[0, 1] * a * c
    S[1, 2] = P[1, 2] + d * a * c * s2 + C[0, 1] * a * s
    S[2, 2] = s2 + C[1, 1]
    S[1, 0], S[2, 0], S[2, 1] = S[0, 1], S[0, 2], S[1, 2]
    return m, S
""",
    ),
]

WRONG = [
    (
        "04-h-robot",
        "bearing row divided by r, not r²",
        """
def H_robot(x, p):
    d = p - x[:2]
    r = np.hypot(*d)
    return np.array([[-d[0] / r, -d[1] / r, 0], [d[1] / r, -d[0] / r, -1]])
""",
    ),
    (
        "04-h-robot",
        "derivative by the landmark",
        """
def H_robot(x, p):
    d = p - x[:2]
    q = d @ d
    r = q ** 0.5
    return np.array([[d[0] / r, d[1] / r, 0], [-d[1] / q, d[0] / q, -1]])
""",
    ),
    (
        "04-h-robot",
        "in the robot's frame",
        """
def H_robot(x, p):
    z = h(x, p)
    return np.array([[-np.cos(z[1]), -np.sin(z[1]), 0], [np.sin(z[1]) / z[0], -np.cos(z[1]) / z[0], -1]])
""",
    ),
    (
        "04-h-robot",
        "difference quotient without wrapping",
        """
def H_robot(x, p):
    e = 1e-6
    H = np.zeros((2, 3))
    for k in range(3):
        y = np.array(x, dtype=float)
        y[k] += e
        H[:, k] = (h(y, p) - h(x, p)) / e
    return H
""",
    ),
    (
        "04-h-robot",
        "slope dy/dx instead of atan2",
        """
def H_robot(x, p):
    dx, dy = p[0] - x[0], p[1] - x[1]
    r = np.sqrt(dx**2 + dy**2)
    slope = dy / dx
    by_x = slope / dx / (1 + slope**2) if dx > 0 else -slope / dx / (1 + slope**2)
    return np.array([[-dx / r, -dy / r, 0], [by_x, -1 / dx / (1 + slope**2), -1]])
""",
    ),
    (
        "04-jxr-jz",
        "J_xr without the bearing",
        """
def J_xr(x, z):
    r = z[0]
    return np.array([[1, 0, -r * np.sin(x[2])], [0, 1, r * np.cos(x[2])]])
""",
    ),
    (
        "04-jxr-jz",
        "J_z with the columns swapped",
        """
def J_z(x, z):
    a = x[2] + z[1]
    return np.array([[-z[0] * np.sin(a), np.cos(a)], [z[0] * np.cos(a), np.sin(a)]])
""",
    ),
    (
        "04-jxr-jz",
        "J_xr as integers",
        """
def J_xr(x, z):
    J = np.array([[1, 0, 0], [0, 1, 0]])
    J[0, 2] = -z[0] * np.sin(x[2] + z[1])
    J[1, 2] = z[0] * np.cos(x[2] + z[1])
    return J
""",
    ),
    (
        "04-jxr-jz",
        "J_z only by the bearing's rotation",
        """
def J_z(x, z):
    a = x[2] + z[1]
    return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])
""",
    ),
    (
        "04-new-landmark",
        "P_rn transposed",
        """
def new_landmark(x, P, z, R):
    A, B = J_xr(x, z), J_z(x, z)
    return A @ P @ A.T + B @ R @ B.T, (A @ P)
""",
    ),
    (
        "04-new-landmark",
        "only the variances of R",
        """
def new_landmark(x, P, z, R):
    A, B = J_xr(x, z), J_z(x, z)
    R = np.diag(np.diag(R))
    return A @ P @ A.T + B @ R @ B.T, P @ A.T
""",
    ),
    (
        "04-new-landmark",
        "the position's block only",
        """
def new_landmark(x, P, z, R):
    A, B = J_xr(x, z), J_z(x, z)
    Q = np.zeros((3, 3))
    Q[:2, :2] = P[:2, :2]
    Q[2, 2] = P[2, 2]
    return A @ Q @ A.T + B @ R @ B.T, Q @ A.T
""",
    ),
    (
        "04-new-landmark",
        "the landmark as sure as the sight",
        """
def new_landmark(x, P, z, R):
    B = J_z(x, z)
    return B @ R @ B.T, P @ J_xr(x, z).T
""",
    ),
    (
        "04-new-landmark",
        "R not turned",
        """
def new_landmark(x, P, z, R):
    A = J_xr(x, z)
    return A @ P @ A.T + R, P @ A.T
""",
    ),
    (
        "04-camera",
        "mount as a place in the world",
        """
def camera(x, p, mount, F):
    dx, dy = p[0] - x[0] - mount[0], p[1] - x[1] - mount[1]
    c, s = np.cos(x[2]), np.sin(x[2])
    X, Y = c * dx + s * dy, -s * dx + c * dy
    dX = np.array([-c, -s, Y, c, s])
    dY = np.array([s, -c, -X, -s, c])
    return -F * Y / X, -F * (dY * X - Y * dX) / X**2
""",
    ),
    (
        "04-camera",
        "turning: the camera's own X and Y",
        """
def camera(x, p, mount, F):
    dx, dy = p[0] - x[0], p[1] - x[1]
    c, s = np.cos(x[2]), np.sin(x[2])
    X, Y = c * dx + s * dy - mount[0], -s * dx + c * dy - mount[1]
    dX = np.array([-c, -s, Y, c, s])
    dY = np.array([s, -c, -X, -s, c])
    return -F * Y / X, -F * (dY * X - Y * dX) / X**2
""",
    ),
    (
        "04-camera",
        "u to the left",
        """
def camera(x, p, mount, F):
    dx, dy = p[0] - x[0], p[1] - x[1]
    c, s = np.cos(x[2]), np.sin(x[2])
    ahead, left = c * dx + s * dy, -s * dx + c * dy
    X, Y = ahead - mount[0], left - mount[1]
    dX = np.array([-c, -s, left, c, s])
    dY = np.array([s, -c, -ahead, -s, c])
    return F * Y / X, F * (dY * X - Y * dX) / X**2
""",
    ),
    (
        "04-camera",
        "quotient rule with the denominator not squared",
        """
def camera(x, p, mount, F):
    dx, dy = p[0] - x[0], p[1] - x[1]
    c, s = np.cos(x[2]), np.sin(x[2])
    ahead, left = c * dx + s * dy, -s * dx + c * dy
    X, Y = ahead - mount[0], left - mount[1]
    dX = np.array([-c, -s, left, c, s])
    dY = np.array([s, -c, -ahead, -s, c])
    return -F * Y / X, -F * (dY * X - Y * dX) / X
""",
    ),
    (
        "04-camera",
        "only three derivatives, rest zero",
        """
def camera(x, p, mount, F):
    def u(x):
        c, s = np.cos(x[2]), np.sin(x[2])
        d = p - x[:2]
        return -F * (c * d[1] - s * d[0] - mount[1]) / (c * d[0] + s * d[1] - mount[0])
    H = np.zeros(5)
    for k in range(3):
        e = np.zeros(3); e[k] = 1e-6
        H[k] = (u(x + e) - u(x - e)) / 2e-6
    return u(x), H
""",
    ),
    (
        "04-camera",
        "rotated the wrong way",
        """
def camera(x, p, mount, F):
    dx, dy = p[0] - x[0], p[1] - x[1]
    c, s = np.cos(x[2]), np.sin(x[2])
    ahead, left = c * dx - s * dy, s * dx + c * dy
    X, Y = ahead - mount[0], left - mount[1]
    dX = np.array([-c, s, -left, c, -s])
    dY = np.array([-s, -c, ahead, s, c])
    return -F * Y / X, -F * (dY * X - Y * dX) / X**2
""",
    ),
    (
        "04-unsure-drive",
        "the linearised one",
        """
def unsure_drive(x, P, u, C):
    return linearised(x, P, u, C)
""",
    ),
    (
        "04-unsure-drive",
        "linearised, made larger",
        """
def unsure_drive(x, P, u, C):
    m, S = linearised(x, P, u, C)
    s = P[2, 2]
    m[:2] = x[:2] + (m[:2] - x[:2]) * np.exp(-s / 2)
    S[:2, :2] += np.eye(2) * (u[0] * s / 2) ** 2
    return m, S
""",
    ),
    (
        "04-unsure-drive",
        "few random samples",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(0)
    a = rng.multivariate_normal(x, P, 300)
    b = rng.multivariate_normal(u, C, 300)
    ends = np.column_stack([a[:, 0] + b[:, 0] * np.cos(a[:, 2]), a[:, 1] + b[:, 0] * np.sin(a[:, 2]), a[:, 2] + b[:, 1]])
    return ends.mean(axis=0), np.cov(ends.T)
""",
    ),
    (
        "04-unsure-drive",
        "samples with wrapped headings",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(0)
    a = rng.multivariate_normal(x, P, 4000)
    b = rng.multivariate_normal(u, C, 4000)
    ends = np.array([f_odometry(p, q) for p, q in zip(a, b)])
    return ends.mean(axis=0), np.cov(ends.T)
""",
    ),
    (
        "04-unsure-drive",
        "unscented, wheels linear",
        """
def unsure_drive(x, P, u, C):
    n = 3
    L = np.linalg.cholesky(n * P)
    pts = [x + s * L[:, k] for k in range(3) for s in (1, -1)]
    ends = np.array([[q[0] + u[0] * np.cos(q[2]), q[1] + u[0] * np.sin(q[2]), q[2] + u[1]] for q in pts])
    m = ends.mean(axis=0)
    W = np.array([[np.cos(x[2]), 0], [np.sin(x[2]), 0], [0, 1]])
    return m, (ends - m).T @ (ends - m) / 6 + W @ C @ W.T
""",
    ),
    (
        "04-unsure-drive",
        "exact mean, linearised covariance",
        """
def unsure_drive(x, P, u, C):
    m, S = linearised(x, P, u, C)
    k = np.exp(-P[2, 2] / 2)
    return np.array([x[0] + u[0] * k * np.cos(x[2]), x[1] + u[0] * k * np.sin(x[2]), m[2]]), S
""",
    ),
]
