"""Independent answers to exercise 04: RIGHT ones and students' mistakes (WRONG)."""

H, J, N, C, U = "04-h-robot", "04-jxr-jz", "04-new-landmark", "04-camera", "04-unsure-drive"

RIGHT = [
    (
        H,
        "polar form",
        """
def H_robot(x, p):
    offset = np.asarray(p, float) - np.asarray(x, float)[:2]
    r = np.linalg.norm(offset)
    phi = np.arctan2(offset[1], offset[0])
    H = np.zeros((2, 3))
    H[0, :2] = -np.cos(phi), -np.sin(phi)
    H[1, :2] = np.sin(phi) / r, -np.cos(phi) / r
    H[1, 2] = -1
    return H
""",
    ),
    (
        H,
        "central differences of h, bearing's difference wrapped",
        """
def H_robot(x, p):
    columns = []
    for i in range(3):
        e = np.zeros(3)
        e[i] = 1e-6
        change = h(x + e, p) - h(x - e, p)
        change[1] = (change[1] + np.pi) % (2 * np.pi) - np.pi
        columns.append(change / 2e-6)
    return np.array(columns).T
""",
    ),
    (
        H,
        "stacked from unit vector and its quarter turn",
        """
def H_robot(x, p):
    n = p - x[:2]
    r = np.hypot(*n)
    n = n / r
    side = np.array([-n[1], n[0]])
    return np.vstack([np.append(-n, 0), np.append(-side / r, -1)])
""",
    ),
    (
        J,
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
        J,
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
        J,
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
    (
        N,
        "one big block matrix",
        """
def new_landmark(x, P, z, R):
    big = np.zeros((5, 5))
    big[:3, :3] = P
    big[3:, 3:] = R
    G = np.eye(5)
    G[3:, :3] = J_xr(x, z)
    G[3:, 3:] = J_z(x, z)
    out = G @ big @ G.T
    return out[3:, 3:], out[:3, 3:]
""",
    ),
    (
        N,
        "einsum and own Jacobians",
        """
def new_landmark(x, P, z, R):
    a = x[2] + z[1]
    e, n = np.array([np.cos(a), np.sin(a)]), np.array([-np.sin(a), np.cos(a)])
    A = np.c_[np.eye(2), z[0] * n]
    B = np.c_[e, z[0] * n]
    P_nn = np.einsum("ik,kl,jl->ij", A, P, A) + np.einsum("ik,kl,jl->ij", B, R, B)
    return P_nn, np.einsum("ik,jk->ij", P, A)
""",
    ),
    (
        C,
        "complex step",
        """
def camera(x, p, mount, F):
    def column(v):
        c, s = np.cos(v[2]), np.sin(v[2])
        dx, dy = v[3] - v[0], v[4] - v[1]
        return -F * (-s * dx + c * dy - mount[1]) / (c * dx + s * dy - mount[0])

    v = np.concatenate([x, p]).astype(complex)
    H = np.empty(5)
    for k in range(5):
        w = v.copy()
        w[k] += 1e-30j
        H[k] = column(w).imag / 1e-30
    return float(column(v).real), H
""",
    ),
    (
        C,
        "pose of the camera, bearing and chain rule",
        """
def camera(x, p, mount, F):
    a, b = mount
    c, s = np.cos(x[2]), np.sin(x[2])
    cx, cy = x[0] + c * a - s * b, x[1] + s * a + c * b
    dx, dy = p[0] - cx, p[1] - cy
    q = dx * dx + dy * dy
    bearing = np.arctan2(dy, dx) - x[2]
    by_cam = np.array([dy / q, -dx / q])
    by_theta = by_cam @ [-s * a - c * b, c * a - s * b] - 1
    db = np.array([by_cam[0], by_cam[1], by_theta, -by_cam[0], -by_cam[1]])
    return -F * np.tan(bearing), -F / np.cos(bearing) ** 2 * db
""",
    ),
    (
        C,
        "u and matrix product",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    robot = R @ (p - x[:2])
    X, Y = robot - mount
    du = np.array([F * Y / X**2, -F / X])
    D = np.hstack([-R, [[robot[1]], [-robot[0]]], R])
    return -F * Y / X, du @ D
""",
    ),
    (
        U,
        "closed form (Gaussian moments of cos and sin)",
        """
def unsure_drive(x, P, u, C):
    s2, d = P[2, 2], u[0]
    e, n = np.array([np.cos(x[2]), np.sin(x[2])]), np.array([-np.sin(x[2]), np.cos(x[2])])
    k = np.exp(-s2 / 2)
    along = np.expm1(-s2) ** 2 / 2
    across = -np.expm1(-2 * s2) / 2
    V = along * np.outer(e, e) + across * np.outer(n, n)
    S = np.zeros((3, 3))
    cross = np.outer(P[:2, 2], d * k * n)
    S[:2, :2] = P[:2, :2] + cross + cross.T + (d**2 + C[0, 0]) * V
    S[:2, :2] += C[0, 0] * k**2 * np.outer(e, e)
    S[:2, 2] = S[2, :2] = P[:2, 2] + d * s2 * k * n + C[0, 1] * k * e
    S[2, 2] = s2 + C[1, 1]
    return np.array([*(x[:2] + d * k * e), x[2] + u[1]]), S
""",
    ),
    (
        U,
        "100 000 samples, headings never wrapped",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(1)
    X = rng.multivariate_normal(x, P, 100_000)
    D = rng.multivariate_normal(u, C, 100_000)
    ends = X.copy()
    ends[:, 0] += D[:, 0] * np.cos(X[:, 2])
    ends[:, 1] += D[:, 0] * np.sin(X[:, 2])
    ends[:, 2] += D[:, 1]
    return ends.mean(axis=0), np.cov(ends.T)
""",
    ),
    (
        U,
        "Gauss-Hermite grid in five dimensions",
        """
def unsure_drive(x, P, u, C):
    nodes, w = np.polynomial.hermite_e.hermegauss(7)
    w = w / w.sum()
    T = np.stack(np.meshgrid(*[nodes] * 5, indexing="ij"), -1).reshape(-1, 5)
    W = np.prod(np.stack(np.meshgrid(*[w] * 5, indexing="ij"), -1).reshape(-1, 5), axis=1)
    X = x + T[:, :3] @ np.linalg.cholesky(P).T
    D = u + T[:, 3:] @ np.linalg.cholesky(C).T
    E = np.column_stack([
        X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]), X[:, 2] + D[:, 1]
    ])
    m = W @ E
    return m, (E - m).T * W @ (E - m)
""",
    ),
    (
        U,
        "f_odometry on 20 000 samples, circular mean, wrapped deviations",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(7)
    pairs = zip(rng.multivariate_normal(x, P, 20000), rng.multivariate_normal(u, C, 20000))
    ends = np.array([f_odometry(a, b) for a, b in pairs])
    middle = np.angle(np.exp(1j * ends[:, 2]).mean())
    ends[:, 2] = (ends[:, 2] - middle + np.pi) % (2 * np.pi) - np.pi
    mean = ends.mean(axis=0)
    off = ends - mean
    mean[2] += middle
    return mean, off.T @ off / len(off)
""",
    ),
]

WRONG = [
    # ---------------------------------------------------------------- 04-h-robot
    (
        H,
        "sign of the bearing by y",
        """
def H_robot(x, p):
    dx, dy = p[0] - x[0], p[1] - x[1]
    q = dx**2 + dy**2
    r = np.sqrt(q)
    return np.array([[-dx / r, -dy / r, 0], [dy / q, dx / q, -1]])
""",
    ),
    (
        H,
        "derivatives by the landmark instead of by the robot",
        """
def H_robot(x, p):
    d = p - x[:2]
    r = np.linalg.norm(d)
    return np.array([[d[0] / r, d[1] / r, 0], [-d[1] / r**2, d[0] / r**2, -1]])
""",
    ),
    (
        H,
        "offset taken from the landmark to the robot, formula of the other",
        """
def H_robot(x, p):
    dx, dy = x[:2] - p
    r = np.hypot(dx, dy)
    H = np.zeros((2, 3))
    H[0] = [-dx / r, -dy / r, 0]
    H[1] = [dy / r**2, -dx / r**2, -1]
    return H
""",
    ),
    (
        H,
        "second row divided by r, not r squared",
        """
def H_robot(x, p):
    phi = np.arctan2(p[1] - x[1], p[0] - x[0])
    return np.array([[-np.cos(phi), -np.sin(phi), 0], [np.sin(phi), -np.cos(phi), -1]])
""",
    ),
    (
        H,
        "turning is forgotten: last column zero",
        """
def H_robot(x, p):
    d = p - x[:2]
    q = d @ d
    H = np.zeros((2, 3))
    H[0, :2] = -d / np.sqrt(q)
    H[1, :2] = d[1] / q, -d[0] / q
    return H
""",
    ),
    (
        H,
        "turning left makes the bearing grow",
        """
def H_robot(x, p):
    d = p - x[:2]
    q = d @ d
    top = np.append(-d / np.sqrt(q), 0)
    bottom = np.array([d[1] / q, -d[0] / q, 1.0])
    return np.stack([top, bottom])
""",
    ),
    (
        H,
        "r without the root",
        """
def H_robot(x, p):
    dx, dy = p - x[:2]
    r = dx**2 + dy**2
    return np.array([[-dx / r, -dy / r, 0], [dy / r**2, -dx / r**2, -1]])
""",
    ),
    (
        H,
        "offset turned into the robot's frame",
        """
def H_robot(x, p):
    r, beta = h(x, p)
    return np.array([
        [-np.cos(beta), -np.sin(beta), 0],
        [np.sin(beta) / r, -np.cos(beta) / r, -1],
    ])
""",
    ),
    (
        H,
        "differences of h, bearing not wrapped: fails straight behind",
        """
def H_robot(x, p):
    H, step = np.zeros((2, 3)), 1e-6
    for j in range(3):
        e = np.zeros(3)
        e[j] = step
        H[:, j] = (h(x + e, p) - h(x - e, p)) / (2 * step)
    return H
""",
    ),
    (
        H,
        "one-sided differences with a coarse step of 1 cm",
        """
def H_robot(x, p):
    H = []
    for step in 0.01 * np.eye(3):
        diff = h(x + step, p) - h(x, p)
        diff[1] = (diff[1] + np.pi) % (2 * np.pi) - np.pi
        H.append(diff / 0.01)
    return np.array(H).T
""",
    ),
    (
        H,
        "differentiates arctan of a quotient: divides by zero at dx = 0",
        """
def H_robot(x, p):
    dx, dy = p[0] - x[0], p[1] - x[1]
    r = np.sqrt(dx**2 + dy**2)
    t = dy / dx
    inner = 1 / (1 + t**2)
    return np.array([[-dx / r, -dy / r, 0], [inner * dy / dx**2, -inner / dx, -1]])
""",
    ),
    (
        H,
        "changes p in place",
        """
def H_robot(x, p):
    p -= x[:2]
    r = np.sqrt(p[0] ** 2 + p[1] ** 2)
    return np.array([[-p[0] / r, -p[1] / r, 0], [p[1] / r**2, -p[0] / r**2, -1]])
""",
    ),
    (
        H,
        "a guard against division by zero that bites near landmarks",
        """
def H_robot(x, p):
    dx, dy = p[0] - x[0], p[1] - x[1]
    r = max(np.hypot(dx, dy), 0.5)
    return np.array([[-dx / r, -dy / r, 0], [dy / r**2, -dx / r**2, -1]])
""",
    ),
    (
        H,
        "transposed: one row for x, y, theta",
        """
def H_robot(x, p):
    dx, dy = p - x[:2]
    q = dx * dx + dy * dy
    r = q**0.5
    by_x = [-dx / r, dy / q]
    by_y = [-dy / r, -dx / q]
    by_theta = [0, -1]
    return np.array([by_x, by_y, by_theta])
""",
    ),
    (
        H,
        "distances without sign (abs)",
        """
def H_robot(x, p):
    dx, dy = np.abs(np.asarray(p) - x[:2])
    r = np.sqrt(dx**2 + dy**2)
    return np.array([[-dx / r, -dy / r, 0], [dy / r**2, -dx / r**2, -1]])
""",
    ),
    (
        H,
        "folds bearings of landmarks behind the robot to the front",
        """
def H_robot(x, p):
    d = p - x[:2]
    r = np.sqrt(d @ d)
    phi = np.arctan(d[1] / d[0]) if d[0] != 0 else np.pi / 2 * np.sign(d[1])
    c, s = np.cos(phi), np.sin(phi)
    return np.array([[-c, -s, 0], [s / r, -c / r, -1]])
""",
    ),
    (
        H,
        "bearing's row in degrees",
        """
def H_robot(x, p):
    dx, dy = p - x[:2]
    q = dx**2 + dy**2
    range_row = np.array([-dx, -dy, 0]) / np.sqrt(q)
    bearing_row = np.degrees(np.array([dy / q, -dx / q, -1]))
    return np.array([range_row, bearing_row])
""",
    ),
    # ---------------------------------------------------------------- 04-jxr-jz
    (
        J,
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
        J,
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
        J,
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
        J,
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
        J,
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
        J,
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
        J,
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
        J,
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
        J,
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
        J,
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
        J,
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
        J,
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
        J,
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
        J,
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
        J,
        "one-sided differences, step 0.01 rad",
        """
def J_xr(x, z):
    return np.column_stack([(g(x + e, z) - g(x, z)) / 0.01 for e in 0.01 * np.eye(3)])


def J_z(x, z):
    return np.column_stack([(g(x, z + e) - g(x, z)) / 0.01 for e in 0.01 * np.eye(2)])
""",
    ),
    (
        J,
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
    # ---------------------------------------------------------------- 04-new-landmark
    (
        N,
        "P_rn transposed (2, 3)",
        """
def new_landmark(x, P, z, R):
    A, B = J_xr(x, z), J_z(x, z)
    P_nr = A @ P
    return P_nr @ A.T + B @ R @ B.T, P_nr
""",
    ),
    (
        N,
        "measurement's noise forgotten",
        """
def new_landmark(x, P, z, R):
    A = J_xr(x, z)
    return A @ P @ A.T, P @ A.T
""",
    ),
    (
        N,
        "pose's covariance forgotten in P_nn",
        """
def new_landmark(x, P, z, R):
    Jz = J_z(x, z)
    return Jz @ R @ Jz.T, P @ J_xr(x, z).T
""",
    ),
    (
        N,
        "Jz.T R Jz instead of Jz R Jz.T",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_nn = Jr @ P @ Jr.T
    P_nn = P_nn + Jz.T @ R @ Jz
    return P_nn, P @ Jr.T
""",
    ),
    (
        N,
        "correlations within P ignored",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    variances = np.diag(np.diag(P))
    return Jr @ variances @ Jr.T + Jz @ R @ Jz.T, variances @ Jr.T
""",
    ),
    (
        N,
        "correlation of range and bearing ignored",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_nn = Jr @ P @ Jr.T
    for k in range(2):
        P_nn = P_nn + R[k, k] * np.outer(Jz[:, k], Jz[:, k])
    return P_nn, P @ Jr.T
""",
    ),
    (
        N,
        "P_rn set to zero, 'they err independently'",
        """
def new_landmark(x, P, z, R):
    J = np.hstack([J_xr(x, z), J_z(x, z)])
    S = np.block([[P, np.zeros((3, 2))], [np.zeros((2, 3)), R]])
    return J @ S @ J.T, np.zeros((3, 2))
""",
    ),
    (
        N,
        "returned in the other order",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_rn = P @ Jr.T
    P_nn = Jr @ P_rn + Jz @ R @ Jz.T
    return P_rn, P_nn
""",
    ),
    (
        N,
        "R added as it is, in range and bearing",
        """
def new_landmark(x, P, z, R):
    Jr = J_xr(x, z)
    return Jr @ P @ Jr.T + R, P @ Jr.T
""",
    ),
    (
        N,
        "R taken for standard deviations and squared",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    return Jr @ P @ Jr.T + Jz @ (R @ R) @ Jz.T, P @ Jr.T
""",
    ),
    (
        N,
        "P_rn is the pose's own columns: the lever of the heading forgotten",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    return Jr @ P @ Jr.T + Jz @ R @ Jz.T, P[:, :2].copy()
""",
    ),
    (
        N,
        "P_rn's row for the heading left zero",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_rn = np.zeros((3, 2))
    P_rn[:2] = P[:2] @ Jr.T
    return Jr @ P @ Jr.T + Jz @ R @ Jz.T, P_rn
""",
    ),
    (
        N,
        "adds the bearing's variance to the heading's in P, in place",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_rn = P @ Jr.T
    cross = R[0, 1] * (np.outer(Jz[:, 0], Jz[:, 1]) + np.outer(Jz[:, 1], Jz[:, 0]))
    P[2, 2] += R[1, 1]
    P_nn = Jr @ P @ Jr.T + R[0, 0] * np.outer(Jz[:, 0], Jz[:, 0]) + cross
    return P_nn, P_rn
""",
    ),
    (
        N,
        "400 samples",
        """
def new_landmark(x, P, z, R):
    rng = np.random.default_rng(0)
    poses = rng.multivariate_normal(x, P, 400)
    seen = rng.multivariate_normal(z, R, 400)
    both = np.hstack([poses, np.array([g(a, b) for a, b in zip(poses, seen)])])
    S = np.cov(both.T)
    return S[3:, 3:], S[:3, 3:]
""",
    ),
    (
        N,
        "Jacobians at the origin instead of at x",
        """
def new_landmark(x, P, z, R):
    home = np.zeros(3)
    Jr, Jz = J_xr(home, z), J_z(home, z)
    return Jr @ P @ Jr.T + Jz @ R @ Jz.T, P @ Jr.T
""",
    ),
    (
        N,
        "symmetrised without the half",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_nn = Jr @ P @ Jr.T + Jz @ R @ Jz.T
    return P_nn + P_nn.T, P @ Jr.T
""",
    ),
    (
        N,
        "elementwise product for the measurement's part",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    return Jr @ P @ Jr.T + Jz * R * Jz.T, P @ Jr.T
""",
    ),
    (
        N,
        "minus: the landmark lies the other way, so P_rn negative",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    P_nn = Jr @ P @ Jr.T + Jz @ R @ Jz.T
    return P_nn, -P @ Jr.T
""",
    ),
    (
        N,
        "counts P through the measurement as well (H P H^T added to R)",
        """
def new_landmark(x, P, z, R):
    Jr, Jz = J_xr(x, z), J_z(x, z)
    H = H_robot(x, g(x, z))
    S = H @ P @ H.T + R
    return Jr @ P @ Jr.T + Jz @ S @ Jz.T, P @ Jr.T
""",
    ),
    # ---------------------------------------------------------------- 04-camera
    (
        C,
        "mount ignored",
        """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    dx, dy = p - x[:2]
    X, Y = c * dx + s * dy, -s * dx + c * dy
    H = -F / X**2 * (X * np.array([s, -c, -X, -s, c]) - Y * np.array([-c, -s, Y, c, s]))
    return -F * Y / X, H
""",
    ),
    (
        C,
        "mount subtracted in the world's frame",
        """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    dx, dy = p - x[:2] - mount
    X, Y = c * dx + s * dy, -s * dx + c * dy
    H = -F / X**2 * (X * np.array([s, -c, -X, -s, c]) - Y * np.array([-c, -s, Y, c, s]))
    return -F * Y / X, H
""",
    ),
    (
        C,
        "turn about the camera, not about the robot's centre",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    X, Y = R @ (p - x[:2]) - mount
    D = np.column_stack([-R, [Y, -X], R])
    return -F * Y / X, np.array([F * Y / X**2, -F / X]) @ D
""",
    ),
    (
        C,
        "column counted to the left (sign of u)",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    D = np.column_stack([-R, [body[1], -body[0]], R])
    return F * Y / X, np.array([-F * Y / X**2, F / X]) @ D
""",
    ),
    (
        C,
        "landmark's derivatives first",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    D = np.column_stack([R, -R, [body[1], -body[0]]])
    return -F * Y / X, np.array([F * Y / X**2, -F / X]) @ D
""",
    ),
    (
        C,
        "plus in the quotient rule",
        """
def camera(x, p, mount, F):
    dx, dy = p[0] - x[0], p[1] - x[1]
    c, s = np.cos(x[2]), np.sin(x[2])
    ahead, left = c * dx + s * dy, c * dy - s * dx
    X, Y = ahead - mount[0], left - mount[1]
    X_by = np.array([-c, -s, left, c, s])
    Y_by = np.array([s, -c, -ahead, -s, c])
    return -F * Y / X, -F * (Y_by * X + Y * X_by) / X**2
""",
    ),
    (
        C,
        "only the derivative of Y: X taken as constant",
        """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    dx, dy = p - x[:2]
    ahead, left = c * dx + s * dy, c * dy - s * dx
    X, Y = ahead - mount[0], left - mount[1]
    return -F * Y / X, -F / X * np.array([s, -c, -ahead, -s, c])
""",
    ),
    (
        C,
        "rotates by theta instead of -theta",
        """
def camera(x, p, mount, F):
    def column(v):
        c, s = np.cos(v[2]), np.sin(v[2])
        dx, dy = v[3] - v[0], v[4] - v[1]
        return -F * (s * dx + c * dy - mount[1]) / (c * dx - s * dy - mount[0])

    v = np.r_[x, p].astype(complex)
    H = np.array([column(v + 1e-20j * e).imag / 1e-20 for e in np.eye(5)])
    return column(v).real, H
""",
    ),
    (
        C,
        "mount read as [left, ahead]",
        """
def camera(x, p, mount, F):
    b, a = mount
    c, s = np.cos(x[2]), np.sin(x[2])
    ahead, left = c * (p[0] - x[0]) + s * (p[1] - x[1]), c * (p[1] - x[1]) - s * (p[0] - x[0])
    X, Y = ahead - a, left - b
    dX, dY = F * Y / X**2, -F / X
    return -F * Y / X, np.array([
        -dX * c + dY * s, -dX * s - dY * c, dX * left - dY * ahead, dX * c - dY * s, dX * s + dY * c
    ])
""",
    ),
    (
        C,
        "mount added instead of subtracted",
        """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    dx, dy = p - x[:2]
    ahead, left = c * dx + s * dy, c * dy - s * dx
    X, Y = ahead + mount[0], left + mount[1]
    X_by, Y_by = np.array([-c, -s, left, c, s]), np.array([s, -c, -ahead, -s, c])
    return -F * Y / X, -F * (Y_by * X - Y * X_by) / X**2
""",
    ),
    (
        C,
        "only the pose's three derivatives, zeros for the landmark",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    by = np.array([F * Y / X**2, -F / X])
    H = np.zeros(5)
    H[:2] = -by @ R
    H[2] = by @ [body[1], -body[0]]
    return -F * Y / X, H
""",
    ),
    (
        C,
        "F as in the picture: hard-coded 500 in H",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    D = np.column_stack([-R, [body[1], -body[0]], R])
    return -F * Y / X, 500 * np.array([Y / X**2, -1 / X]) @ D
""",
    ),
    (
        C,
        "column rounded to a whole pixel",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    D = np.column_stack([-R, [body[1], -body[0]], R])
    return round(-F * Y / X), np.array([F * Y / X**2, -F / X]) @ D
""",
    ),
    (
        C,
        "proportional to the bearing (small angles) instead of Y / X",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    q = X**2 + Y**2
    D = np.column_stack([-R, [body[1], -body[0]], R])
    return -F * np.arctan2(Y, X), -F * np.array([-Y / q, X / q]) @ D
""",
    ),
    (
        C,
        "differences with a step so small that rounding eats them",
        """
def camera(x, p, mount, F):
    def column(v):
        c, s = np.cos(v[2]), np.sin(v[2])
        dx, dy = v[3] - v[0], v[4] - v[1]
        return -F * (c * dy - s * dx - mount[1]) / (c * dx + s * dy - mount[0])

    v = np.concatenate([x, p])
    u = column(v)
    return u, np.array([(column(v + e) - u) / 1e-13 for e in 1e-13 * np.eye(5)])
""",
    ),
    (
        C,
        "H as a (1, 5) matrix",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    D = np.column_stack([-R, [body[1], -body[0]], R])
    return -F * Y / X, np.array([[F * Y / X**2, -F / X]]) @ D
""",
    ),
    (
        C,
        "p made relative in place",
        """
def camera(x, p, mount, F):
    p -= x[:2]
    c, s = np.cos(x[2]), np.sin(x[2])
    ahead, left = c * p[0] + s * p[1], c * p[1] - s * p[0]
    X, Y = ahead - mount[0], left - mount[1]
    X_by, Y_by = np.array([-c, -s, left, c, s]), np.array([s, -c, -ahead, -s, c])
    return -F * Y / X, -F * (Y_by * X - Y * X_by) / X**2
""",
    ),
    (
        C,
        "u cut at the image's border",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    D = np.column_stack([-R, [body[1], -body[0]], R])
    return float(np.clip(-F * Y / X, -F, F)), np.array([F * Y / X**2, -F / X]) @ D
""",
    ),
    # ---------------------------------------------------------------- 04-unsure-drive
    (
        U,
        "returns the linearised",
        """
def unsure_drive(x, P, u, C):
    return linearised(x, P, u, C)
""",
    ),
    (
        U,
        "linearised, covariance doubled to be safe",
        """
def unsure_drive(x, P, u, C):
    mean, S = linearised(x, P, u, C)
    return mean, 2 * S
""",
    ),
    (
        U,
        "cheat: a large constant disc",
        """
def unsure_drive(x, P, u, C):
    mean = f_odometry(x, u)
    return mean, np.diag([4.0, 4.0, 0.5])
""",
    ),
    (
        U,
        "samples through f_odometry, wrapped headings averaged as numbers",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(0)
    starts = rng.multivariate_normal(x, P, 5000)
    drives = rng.multivariate_normal(u, C, 5000)
    ends = np.array([f_odometry(a, b) for a, b in zip(starts, drives)])
    return ends.mean(axis=0), np.cov(ends, rowvar=False)
""",
    ),
    (
        U,
        "12 samples",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(2)
    X, D = rng.multivariate_normal(x, P, 12), rng.multivariate_normal(u, C, 12)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        U,
        "100 samples",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(4)
    X, D = rng.multivariate_normal(x, P, 100), rng.multivariate_normal(u, C, 100)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        U,
        "unscented (alpha 1, kappa 0), headings wrapped by f_odometry",
        """
def unsure_drive(x, P, u, C):
    m = np.concatenate([x, u])
    S = np.zeros((5, 5))
    S[:3, :3], S[3:, 3:] = P, C
    L = np.linalg.cholesky(5 * S)
    points = np.vstack([m + L.T, m - L.T])
    ends = np.array([f_odometry(q[:3], q[3:]) for q in points])
    mean = ends.mean(axis=0)
    return mean, (ends - mean).T @ (ends - mean) / 10
""",
    ),
    (
        U,
        "unscented, no wrapping, scaled by n = 5: far points",
        """
def unsure_drive(x, P, u, C):
    L = np.zeros((5, 5))
    L[:3, :3], L[3:, 3:] = np.linalg.cholesky(P), np.linalg.cholesky(C)
    m = np.concatenate([x, u])
    q = np.vstack([m + np.sqrt(5) * L.T, m - np.sqrt(5) * L.T])
    ends = np.c_[q[:, 0] + q[:, 3] * np.cos(q[:, 2]), q[:, 1] + q[:, 3] * np.sin(q[:, 2]),
                 q[:, 2] + q[:, 4]]
    mean = ends.mean(axis=0)
    return mean, np.cov(ends.T, bias=True)
""",
    ),
    (
        U,
        "mean from sampling, covariance still linearised",
        """
def unsure_drive(x, P, u, C):
    _, S = linearised(x, P, u, C)
    headings = np.random.default_rng(0).normal(x[2], np.sqrt(P[2, 2]), 50000)
    mean = np.array([
        x[0] + u[0] * np.cos(headings).mean(), x[1] + u[0] * np.sin(headings).mean(), x[2] + u[1]
    ])
    return mean, S
""",
    ),
    (
        U,
        "samples drawn without the correlations of P",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(0)
    n = 50000
    X = x + rng.normal(size=(n, 3)) * np.sqrt(np.diag(P))
    D = rng.multivariate_normal(u, C, n)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        U,
        "samples drawn without the correlation of C",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(0)
    n = 50000
    X = rng.multivariate_normal(x, P, n)
    d = rng.normal(u[0], np.sqrt(C[0, 0]), n)
    t = rng.normal(u[1], np.sqrt(C[1, 1]), n)
    E = np.c_[X[:, 0] + d * np.cos(X[:, 2]), X[:, 1] + d * np.sin(X[:, 2]), X[:, 2] + t]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        U,
        "the wheels' noise forgotten",
        """
def unsure_drive(x, P, u, C):
    X = np.random.default_rng(0).multivariate_normal(x, P, 50000)
    d, turn = u
    E = X + np.c_[d * np.cos(X[:, 2]), d * np.sin(X[:, 2]), np.full(len(X), turn)]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        U,
        "variances drawn as standard deviations",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(0)
    X = rng.normal(x, np.diag(P), (20000, 3))
    D = rng.normal(u, np.diag(C), (20000, 2))
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        U,
        "Cholesky factor transposed when sampling",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(0)
    X = x + rng.normal(size=(50000, 3)) @ np.linalg.cholesky(P)
    D = u + rng.normal(size=(50000, 2)) @ np.linalg.cholesky(C)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        U,
        "closed form with exp(-s2) for exp(-s2/2)",
        """
def unsure_drive(x, P, u, C):
    s2, d, th = P[2, 2], u[0], x[2]
    e, n = np.array([np.cos(th), np.sin(th)]), np.array([-np.sin(th), np.cos(th)])
    k = np.exp(-s2)
    EE = (np.eye(2) + np.exp(-2 * s2) * np.array(
        [[np.cos(2 * th), np.sin(2 * th)], [np.sin(2 * th), -np.cos(2 * th)]])) / 2
    cross = np.outer(P[:2, 2], d * k * n)
    S = np.zeros((3, 3))
    S[:2, :2] = P[:2, :2] + cross + cross.T + (d**2 + C[0, 0]) * EE - (d * k) ** 2 * np.outer(e, e)
    S[:2, 2] = S[2, :2] = P[:2, 2] + d * s2 * k * n + C[0, 1] * k * e
    S[2, 2] = s2 + C[1, 1]
    return np.array([x[0] + d * k * e[0], x[1] + d * k * e[1], th + u[1]]), S
""",
    ),
    (
        U,
        "closed form, but place and heading taken as independent",
        """
def unsure_drive(x, P, u, C):
    s2, d, th = P[2, 2], u[0], x[2]
    e, n = np.array([np.cos(th), np.sin(th)]), np.array([-np.sin(th), np.cos(th)])
    k = np.exp(-s2 / 2)
    EE = (np.eye(2) + np.exp(-2 * s2) * np.array(
        [[np.cos(2 * th), np.sin(2 * th)], [np.sin(2 * th), -np.cos(2 * th)]])) / 2
    S = np.zeros((3, 3))
    S[:2, :2] = P[:2, :2] + (d**2 + C[0, 0]) * EE - (d * k) ** 2 * np.outer(e, e)
    S[:2, 2] = S[2, :2] = P[:2, 2] + d * s2 * k * n + C[0, 1] * k * e
    S[2, 2] = s2 + C[1, 1]
    return np.array([x[0] + d * k * e[0], x[1] + d * k * e[1], th + u[1]]), S
""",
    ),
    (
        U,
        "closed form, wheels' distance noise only along the believed heading",
        """
def unsure_drive(x, P, u, C):
    s2, d, th = P[2, 2], u[0], x[2]
    e, n = np.array([np.cos(th), np.sin(th)]), np.array([-np.sin(th), np.cos(th)])
    k = np.exp(-s2 / 2)
    V = (1 - np.exp(-s2)) ** 2 / 2 * np.outer(e, e) + (1 - np.exp(-2 * s2)) / 2 * np.outer(n, n)
    cross = np.outer(P[:2, 2], d * k * n)
    S = np.zeros((3, 3))
    S[:2, :2] = P[:2, :2] + cross + cross.T + d**2 * V
    S[:2, 2] = S[2, :2] = P[:2, 2] + d * s2 * k * n
    S[2, 2] = s2
    W = np.array([[e[0], 0], [e[1], 0], [0, 1]])
    return np.array([x[0] + d * k * e[0], x[1] + d * k * e[1], th + u[1]]), S + W @ C @ W.T
""",
    ),
    (
        U,
        "second-order mean and covariance (Taylor)",
        """
def unsure_drive(x, P, u, C):
    mean, S = linearised(x, P, u, C)
    e = np.array([np.cos(x[2]), np.sin(x[2]), 0])
    mean = mean - u[0] * P[2, 2] / 2 * e
    return mean, S + (u[0] * P[2, 2]) ** 2 / 2 * np.outer(e, e)
""",
    ),
    (
        U,
        "three headings: -1, 0 and +1 sigma, equal weights",
        """
def unsure_drive(x, P, u, C):
    sigma = np.sqrt(P[2, 2])
    means, spreads = [], []
    for k in (-1, 0, 1):
        start = x + k * P[:, 2] / sigma
        rest = P - np.outer(P[:, 2], P[:, 2]) / P[2, 2]
        m, S = linearised(start, rest, u, C)
        means.append(m)
        spreads.append(S)
    mean = np.mean(means, axis=0)
    off = np.array(means) - mean
    return mean, np.mean(spreads, axis=0) + off.T @ off / 3
""",
    ),
    (
        U,
        "fan of headings, spread of the ends only: P's rest and C forgotten",
        """
def unsure_drive(x, P, u, C):
    t, w = np.polynomial.hermite_e.hermegauss(15)
    w = w / w.sum()
    heading = x[2] + np.sqrt(P[2, 2]) * t
    ends = np.c_[x[0] + u[0] * np.cos(heading), x[1] + u[0] * np.sin(heading), heading + u[1]]
    mean = w @ ends
    S = (ends - mean).T @ np.diag(w) @ (ends - mean)
    S[:2, :2] += P[:2, :2]
    S[2, 2] += C[1, 1]
    return mean, S
""",
    ),
    (
        U,
        "robot that does not drive is returned as it was (d <= 0)",
        """
def unsure_drive(x, P, u, C):
    if u[0] <= 0:
        return x.copy(), P.copy()
    rng = np.random.default_rng(3)
    X, D = rng.multivariate_normal(x, P, 50000), rng.multivariate_normal(u, C, 50000)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        U,
        "negative distances driven forwards (abs)",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(3)
    X, D = rng.multivariate_normal(x, P, 50000), rng.multivariate_normal(u, C, 50000)
    d = np.abs(D[:, 0])
    E = np.c_[X[:, 0] + d * np.cos(X[:, 2]), X[:, 1] + d * np.sin(X[:, 2]), X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        U,
        "turn first, then drive",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(3)
    X, D = rng.multivariate_normal(x, P, 50000), rng.multivariate_normal(u, C, 50000)
    E = X.copy()
    E[:, 2] += D[:, 1]
    E[:, 0] += D[:, 0] * np.cos(E[:, 2])
    E[:, 1] += D[:, 0] * np.sin(E[:, 2])
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        U,
        "adds a little to P in place so that it stays positive",
        """
def unsure_drive(x, P, u, C):
    P += 1e-9 * np.eye(3)
    rng = np.random.default_rng(3)
    X, D = rng.multivariate_normal(x, P, 50000), rng.multivariate_normal(u, C, 50000)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        U,
        "only the example: samples of START, BELIEVED, DRIVE, WHEELS",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(4)
    X = rng.multivariate_normal(START, BELIEVED, 20000)
    D = rng.multivariate_normal(DRIVE, WHEELS, 20000)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        U,
        "drive cut into ten small linearised steps",
        """
def unsure_drive(x, P, u, C):
    mean, S = x, P
    for _ in range(10):
        mean, S = linearised(mean, S, np.array([u[0] / 10, 0]), C / 10)
    mean = mean + np.array([0, 0, u[1]])
    return mean, S
""",
    ),
    (
        U,
        "covariance about the linearised end instead of about the mean",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(5)
    X, D = rng.multivariate_normal(x, P, 50000), rng.multivariate_normal(u, C, 50000)
    E = X.copy()
    E[:, :2] += D[:, :1] * np.c_[np.cos(X[:, 2]), np.sin(X[:, 2])]
    E[:, 2] += D[:, 1]
    off = E - linearised(x, P, u, C)[0]
    return E.mean(axis=0), off.T @ off / len(off)
""",
    ),
    (
        U,
        "grid of headings cut at 2 sigma",
        """
def unsure_drive(x, P, u, C):
    t = np.linspace(-2, 2, 41)
    w = np.exp(-(t**2) / 2)
    w /= w.sum()
    sigma = np.sqrt(P[2, 2])
    mean, second = np.zeros(3), np.zeros((3, 3))
    rest = P - np.outer(P[:, 2], P[:, 2]) / P[2, 2]
    for tk, wk in zip(t, w):
        m, S = linearised(x + tk * P[:, 2] / sigma, rest, u, C)
        mean = mean + wk * m
        second = second + wk * (S + np.outer(m, m))
    return mean, second - np.outer(mean, mean)
""",
    ),
]
