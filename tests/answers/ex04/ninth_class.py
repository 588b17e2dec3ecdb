"""A ninth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "04-h-robot",
        "central differences of h, bearing difference wrapped",
        """
def H_robot(x, p):
    x = np.asarray(x, dtype=float)
    reach = np.hypot(p[0] - x[0], p[1] - x[1])
    J = np.zeros((2, 3))
    for k in range(3):
        e = np.zeros(3)
        e[k] = 1e-5 * (reach if k < 2 else 1.0)
        d = h(x + e, p) - h(x - e, p)
        d[1] = np.arctan2(np.sin(d[1]), np.cos(d[1]))
        J[:, k] = d / (2 * e[k])
    return J
""",
    ),
    (
        "04-camera",
        "by the bearing from the camera's place: u = -F tan(bearing), chain rule",
        """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    R = np.array([[c, -s], [s, c]])
    arm = R @ np.asarray(mount)
    d = p - (x[:2] + arm)
    X, Y = R.T @ d
    q = X**2 + Y**2
    du = -F * q / X**2  # d u / d bearing in the camera's frame
    by_place = np.array([d[1], -d[0]]) / q  # of the bearing, by the camera's place
    swing = np.array([-arm[1], arm[0]])
    H = du * np.array([*by_place, by_place @ swing - 1, *-by_place])
    return -F * Y / X, H
""",
    ),
]

WRONG = [
    (
        "04-h-robot",
        "signs of the landmark's Jacobian: all four derivatives by x and y turned round",
        """
def H_robot(x, p):
    d = p - x[:2]
    r = np.hypot(*d)
    return np.array([[d[0] / r, d[1] / r, 0.0], [-d[1] / r**2, d[0] / r**2, -1.0]])
""",
    ),
    (
        "04-h-robot",
        "bearing row divided by r instead of r squared",
        """
def H_robot(x, p):
    bearing = np.arctan2(p[1] - x[1], p[0] - x[0])
    r = np.linalg.norm(p - x[:2])
    c, s = np.cos(bearing), np.sin(bearing)
    return np.array([[-c, -s, 0], [s, -c, -1]])
""",
    ),
    (
        "04-h-robot",
        "forgets that the bearing counts from the heading: 0 in place of -1",
        """
def H_robot(x, p):
    dx, dy = p - x[:2]
    q = dx * dx + dy * dy
    H = np.zeros((2, 3))
    H[0, :2] = -dx / np.sqrt(q), -dy / np.sqrt(q)
    H[1, :2] = dy / q, -dx / q
    return H
""",
    ),
    (
        "04-h-robot",
        "numerical derivative that does not wrap the bearing: huge where it jumps behind the robot",
        """
def H_robot(x, p):
    def bearing(a):
        return np.arctan2(np.sin(np.arctan2(p[1] - a[1], p[0] - a[0]) - a[2]),
                          np.cos(np.arctan2(p[1] - a[1], p[0] - a[0]) - a[2]))
    eps, H = 1e-6, np.zeros((2, 3))
    for k in range(3):
        plus, minus = np.array(x, dtype=float), np.array(x, dtype=float)
        plus[k] += eps
        minus[k] -= eps
        H[0, k] = (np.hypot(*(p - plus[:2])) - np.hypot(*(p - minus[:2]))) / (2 * eps)
        H[1, k] = (bearing(plus) - bearing(minus)) / (2 * eps)
    return H
""",
    ),
    (
        "04-jxr-jz",
        "direction is the bearing alone, the heading is left out",
        """
def J_xr(x, z):
    r, b = z
    return np.array([[1, 0, -r * np.sin(b)], [0, 1, r * np.cos(b)]])


def J_z(x, z):
    r, b = z
    return np.array([[np.cos(b), -r * np.sin(b)], [np.sin(b), r * np.cos(b)]])
""",
    ),
    (
        "04-jxr-jz",
        "J_z with the range missing in the column of the bearing",
        """
def J_xr(x, z):
    out = np.eye(2, 3)
    out[:, 2] = z[0] * -np.sin(x[2] + z[1]), z[0] * np.cos(x[2] + z[1])
    return out


def J_z(x, z):
    a = x[2] + z[1]
    return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])
""",
    ),
    (
        "04-jxr-jz",
        "wrong sign of the heading's column in J_xr (landmark swings to the right)",
        """
def J_xr(x, z):
    far = g(x, z) - x[:2]
    return np.column_stack([np.eye(2), [far[1], -far[0]]])


def J_z(x, z):
    far = g(x, z) - x[:2]
    return np.column_stack([far / z[0], [-far[1], far[0]]])
""",
    ),
    (
        "04-jxr-jz",
        "columns of J_z in the order bearing, range",
        """
def J_xr(x, z):
    t = x[2] + z[1]
    return np.array([[1.0, 0.0, -z[0] * np.sin(t)], [0.0, 1.0, z[0] * np.cos(t)]])


def J_z(x, z):
    e = 1e-6
    by_r = (g(x, z + [e, 0]) - g(x, z - [e, 0])) / (2 * e)
    by_b = (g(x, z + [0, e]) - g(x, z - [0, e])) / (2 * e)
    return np.column_stack([by_b, by_r])
""",
    ),
    (
        "04-new-landmark",
        "leaves out the sensor's noise in P_nn",
        """
def new_landmark(x, P, z, R):
    J = J_xr(x, z)
    return J @ P @ J.T, P @ J.T
""",
    ),
    (
        "04-new-landmark",
        "only the variances of P and R, what goes together in them is dropped",
        """
def new_landmark(x, P, z, R):
    Jx, Jz = J_xr(x, z), J_z(x, z)
    P_nn = np.zeros((2, 2))
    for k in range(3):
        P_nn += P[k, k] * np.outer(Jx[:, k], Jx[:, k])
    for k in range(2):
        P_nn += R[k, k] * np.outer(Jz[:, k], Jz[:, k])
    return P_nn, np.diag(np.diag(P)) @ Jx.T
""",
    ),
    (
        "04-new-landmark",
        "P_rn is the pose's own covariance with x and y: the landmark's swing with the heading is missing",
        """
def new_landmark(x, P, z, R):
    G, L = J_xr(x, z), J_z(x, z)
    whole = np.hstack([G, L])
    joint = np.zeros((5, 5))
    joint[:3, :3], joint[3:, 3:] = P, R
    return whole @ joint @ whole.T, P[:, :2].copy()
""",
    ),
    (
        "04-new-landmark",
        "from a thousand samples, so only right to some per cent",
        """
def new_landmark(x, P, z, R):
    rng = np.random.default_rng(0)
    poses = rng.multivariate_normal(x, P, 1000)
    sights = rng.multivariate_normal(z, R, 1000)
    places = np.array([g(a, b) for a, b in zip(poses, sights)])
    joint = np.cov(np.hstack([poses, places]).T)
    return joint[3:, 3:], joint[:3, 3:]
""",
    ),
    (
        "04-camera",
        "mount subtracted in the world's frame, not turned with the robot",
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
        "derivative by the heading as if the camera stood at the robot's centre (Y and -X of the camera's frame)",
        """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    X = c * (p[0] - x[0]) + s * (p[1] - x[1]) - mount[0]
    Y = -s * (p[0] - x[0]) + c * (p[1] - x[1]) - mount[1]
    u = -F * Y / X
    du_dX, du_dY = F * Y / X**2, -F / X
    H = np.array([
        -c * du_dX + s * du_dY,
        -s * du_dX - c * du_dY,
        Y * du_dX - X * du_dY,
        c * du_dX - s * du_dY,
        s * du_dX + c * du_dY,
    ])
    return u, H
""",
    ),
    (
        "04-camera",
        "column counted to the left: minus sign of u forgotten, in u and H",
        """
def camera(x, p, mount, F):
    def column(v):
        c, s = np.cos(v[2]), np.sin(v[2])
        dx, dy = v[3] - v[0], v[4] - v[1]
        return F * (-s * dx + c * dy - mount[1]) / (c * dx + s * dy - mount[0])
    v = np.concatenate([x, p]).astype(float)
    H = np.array([(column(v + e) - column(v - e)) / 2e-6 for e in 1e-6 * np.eye(5)])
    return column(v), H
""",
    ),
    (
        "04-camera",
        "quotient rule with a plus between its two terms",
        """
def camera(x, p, mount, F):
    dx, dy = p[0] - x[0], p[1] - x[1]
    c, s = np.cos(x[2]), np.sin(x[2])
    ahead, left = c * dx + s * dy, c * dy - s * dx
    X, Y = ahead - mount[0], left - mount[1]
    Xd = np.array([-c, -s, left, c, s])
    Yd = np.array([s, -c, -ahead, -s, c])
    return -F * Y / X, -F * (Yd * X + Y * Xd) / X**2
""",
    ),
    (
        "04-unsure-drive",
        "the linearised ellipse, made larger to be on the safe side; mean still on the circle",
        """
def unsure_drive(x, P, u, C):
    mean, covariance = linearised(x, P, u, C)
    covariance = covariance + np.diag([(0.3 * u[0]) ** 2, (0.3 * u[0]) ** 2, 0])
    return mean, covariance
""",
    ),
    (
        "04-unsure-drive",
        "5000 samples with wrapped headings averaged as numbers: wrong where headings lie on both sides of pi",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(1)
    starts = rng.multivariate_normal(x, P, 5000)
    drives = rng.multivariate_normal(u, C, 5000)
    ends = np.array([f_odometry(a, b) for a, b in zip(starts, drives)])
    return ends.mean(axis=0), np.cov(ends.T)
""",
    ),
    (
        "04-unsure-drive",
        "30 samples are too few",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(2)
    s = rng.multivariate_normal(x, P, 30)
    w = rng.multivariate_normal(u, C, 30)
    ends = np.column_stack([
        s[:, 0] + w[:, 0] * np.cos(s[:, 2]), s[:, 1] + w[:, 0] * np.sin(s[:, 2]), s[:, 2] + w[:, 1]
    ])
    return ends.mean(axis=0), np.cov(ends, rowvar=False)
""",
    ),
    (
        "04-unsure-drive",
        "samples only the start, the wheels' noise C is left out",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(3)
    s = rng.multivariate_normal(x, P, 20000)
    ends = s + np.column_stack([u[0] * np.cos(s[:, 2]), u[0] * np.sin(s[:, 2]), np.full(20000, u[1])])
    return ends.mean(axis=0), np.cov(ends.T)
""",
    ),
    (
        "04-unsure-drive",
        "mean shortened by exp(-var/2), but the covariance is still the linearised one",
        """
def unsure_drive(x, P, u, C):
    mean, cov = linearised(x, P, u, C)
    short = np.exp(-P[2, 2] / 2)
    mean[0] = x[0] + short * u[0] * np.cos(x[2])
    mean[1] = x[1] + short * u[0] * np.sin(x[2])
    return mean, cov
""",
    ),
    (
        "04-h-robot",
        "range row by the bearing in the robot's frame (heading subtracted): derivatives along the robot's axes, not the world's",
        """
def H_robot(x, p):
    r, beta = h(x, p)
    return np.array([[-np.cos(beta), -np.sin(beta), 0], [np.sin(beta) / r, -np.cos(beta) / r, -1]])
""",
    ),
    (
        "04-camera",
        "one-sided differences with a step of a centimetre: too coarse",
        """
def camera(x, p, mount, F):
    def column(v):
        c, s = np.cos(v[2]), np.sin(v[2])
        ahead = c * (v[3] - v[0]) + s * (v[4] - v[1]) - mount[0]
        left = c * (v[4] - v[1]) - s * (v[3] - v[0]) - mount[1]
        return -F * left / ahead
    v = np.concatenate([x, p])
    u = column(v)
    return u, np.array([(column(v + e) - u) / 0.01 for e in 0.01 * np.eye(5)])
""",
    ),
]
