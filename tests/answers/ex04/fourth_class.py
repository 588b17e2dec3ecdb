"""A fourth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "04-h-robot",
        "complex: the derivative of a logarithm",
        """
def H_robot(x, p):
    w = complex(p[0] - x[0], p[1] - x[1])
    q = 1 / w
    r = abs(w)
    return [[-w.real / r, -w.imag / r, 0.0], [-q.imag, -q.real, -1.0]]
""",
    ),
    (
        "04-new-landmark",
        "one big Jacobian and a block covariance",
        """
def new_landmark(x, P, z, R):
    J = np.hstack([J_xr(x, z), J_z(x, z)])
    B = np.zeros((5, 5))
    B[:3, :3] = P
    B[3:, 3:] = R
    return J @ B @ J.T, (B @ J.T)[:3]
""",
    ),
]

WRONG = [
    (
        "04-h-robot",
        "signs of the landmark's Jacobian",
        """
def H_robot(x, p):
    dx, dy = p[0] - x[0], p[1] - x[1]
    q = dx ** 2 + dy ** 2
    r = np.sqrt(q)
    return np.array([[dx / r, dy / r, 0], [-dy / q, dx / q, -1]])
""",
    ),
    (
        "04-h-robot",
        "bearing's row divided by r once",
        """
def H_robot(x, p):
    dx, dy = p[0] - x[0], p[1] - x[1]
    r = np.hypot(dx, dy)
    return np.array([[-dx / r, -dy / r, 0], [dy / r, -dx / r, -1]])
""",
    ),
    (
        "04-h-robot",
        "the derivative by θ is +1",
        """
def H_robot(x, p):
    d = p - x[:2]
    r = np.linalg.norm(d)
    return np.array([[-d[0] / r, -d[1] / r, 0], [d[1] / r**2, -d[0] / r**2, 1]])
""",
    ),
    (
        "04-h-robot",
        "finite difference with too large a step",
        """
def H_robot(x, p):
    H = np.zeros((2, 3))
    for k in range(3):
        e = np.zeros(3)
        e[k] = 0.1
        H[:, k] = (h(x + e, p) - h(x, p)) / 0.1
    return H
""",
    ),
    (
        "04-h-robot",
        "finite differences whose bearing jumps",
        """
def H_robot(x, p):
    H = np.zeros((2, 3))
    for k in range(3):
        e = np.zeros(3)
        e[k] = 1e-6
        H[:, k] = (h(x + e, p) - h(x - e, p)) / 2e-6
    return H
""",
    ),
    (
        "04-jxr-jz",
        "the heading alone in J_z",
        """
def J_xr(x, z):
    r, b = z
    t = x[2] + b
    return np.array([[1, 0, -r * np.sin(t)], [0, 1, r * np.cos(t)]])
def J_z(x, z):
    t = x[2]
    return np.array([[np.cos(t), -z[0] * np.sin(t)], [np.sin(t), z[0] * np.cos(t)]])
""",
    ),
    (
        "04-jxr-jz",
        "columns of J_z exchanged",
        """
def J_xr(x, z):
    t = x[2] + z[1]
    return np.array([[1, 0, -z[0] * np.sin(t)], [0, 1, z[0] * np.cos(t)]])
def J_z(x, z):
    t = x[2] + z[1]
    return np.array([[-z[0] * np.sin(t), np.cos(t)], [z[0] * np.cos(t), np.sin(t)]])
""",
    ),
    (
        "04-jxr-jz",
        "J_xr has the same r-column in the wrong sign for both rows",
        """
def J_xr(x, z):
    t = x[2] + z[1]
    return np.array([[1, 0, z[0] * np.sin(t)], [0, 1, -z[0] * np.cos(t)]])
def J_z(x, z):
    t = x[2] + z[1]
    return np.array([[np.cos(t), -z[0] * np.sin(t)], [np.sin(t), z[0] * np.cos(t)]])
""",
    ),
    (
        "04-new-landmark",
        "P_rn transposed",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    return Jr @ P @ Jr.T + Jz @ R @ Jz.T, Jr @ P
""",
    ),
    (
        "04-new-landmark",
        "R forgotten",
        """
def new_landmark(x, P, z, R):
    Jr = J_xr(x, z)
    return Jr @ P @ Jr.T, P @ Jr.T
""",
    ),
    (
        "04-camera",
        "mount subtracted in the world",
        """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    dx, dy = p[0] - x[0] - mount[0], p[1] - x[1] - mount[1]
    X, Y = c * dx + s * dy, -s * dx + c * dy
    dX = np.array([-c, -s, Y, c, s])
    dY = np.array([s, -c, -X, -s, c])
    return -F * Y / X, -F * (dY * X - Y * dX) / X ** 2
""",
    ),
    (
        "04-camera",
        "the swing about the camera, not the centre",
        """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    dx, dy = p[0] - x[0], p[1] - x[1]
    X, Y = c * dx + s * dy - mount[0], -s * dx + c * dy - mount[1]
    dX = np.array([-c, -s, Y, c, s])
    dY = np.array([s, -c, -X, -s, c])
    return -F * Y / X, -F * (dY * X - Y * dX) / X ** 2
""",
    ),
    (
        "04-camera",
        "quotient rule with a plus",
        """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    dx, dy = p[0] - x[0], p[1] - x[1]
    X, Y = c * dx + s * dy - mount[0], -s * dx + c * dy - mount[1]
    dX = np.array([-c, -s, Y + mount[1], c, s])
    dY = np.array([s, -c, -X - mount[0], -s, c])
    return -F * Y / X, -F * (dY * X + Y * dX) / X ** 2
""",
    ),
    (
        "04-unsure-drive",
        "three thousand samples, each with its heading wrapped",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(0)
    a = rng.multivariate_normal(x, P, 3000)
    b = rng.multivariate_normal(u, C, 3000)
    ends = np.array([f_odometry(*pair) for pair in zip(a, b)])
    return ends.mean(axis=0), np.cov(ends.T)
""",
    ),
]
