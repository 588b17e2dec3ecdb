"""Independent answers to 09-end: right ones, and students' mistakes."""

RIGHT = [
    (
        "09-end",
        "the slopes of r by hand",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = b * dr[2] + r * db
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "complex-step differentiation",
        """
def end_point(x, P, j, beta, sigma):
    at = 3 + 2 * j

    def meet(y):
        x_, b = y[:-1], y[-1]
        c, s = np.cos(x_[at + 1]), np.sin(x_[at + 1])
        u = np.array([np.cos(x_[2] + b), np.sin(x_[2] + b)])
        r = (x_[at] - c * x_[0] - s * x_[1]) / (c * u[0] + s * u[1])
        return x_[:2] + r * u

    y = np.append(x, beta)
    J = np.zeros((2, len(y)))
    for i in range(len(y)):
        step = y.astype(complex)
        step[i] += 1e-30j
        J[:, i] = meet(step).imag / 1e-30
    A, b = J[:, :-1], J[:, -1:]
    return meet(y), A @ P @ A.T + sigma ** 2 * b @ b.T, A @ P
""",
    ),
]

WRONG = [
    (
        "09-end",
        "beta counted from the world's x",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "r does not depend on the heading",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = 0
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "the wall's direction: slope by the robot's place instead of the end's",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ x[:2]) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "the wall's direction is taken as known",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = 0
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "the beam's error across the beam only, not along the wall",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = r * db
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "sigma not squared",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "the beam's error is forgotten",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T, J @ P
""",
    ),
    (
        "09-end",
        "X is (n, 2)",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), P @ J.T
""",
    ),
    (
        "09-end",
        "X holds only the pose",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J[:, :3] @ P[:3, :3]
""",
    ),
    (
        "09-end",
        "divides by the cosine of beta instead of that between beam and normal",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / np.cos(beta)
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "wall j begins at 3 + j",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "slope of rho is 1",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + sigma ** 2 * np.outer(along, along), J @ P
""",
    ),
    (
        "09-end",
        "r is a reading and held fixed: as for a point landmark",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    c, s = np.cos(x[k + 1]), np.sin(x[k + 1])
    f = x[2] + beta
    u = np.array([np.cos(f), np.sin(f)])
    r = (x[k] - c * x[0] - s * x[1]) / (c * u[0] + s * u[1])
    J = np.zeros((2, len(x)))
    J[:, :2] = np.eye(2)
    J[:, 2] = r * np.array([-u[1], u[0]])
    return x[:2] + r * u, J @ P @ J.T + sigma ** 2 * np.outer(J[:, 2], J[:, 2]), J @ P
""",
    ),
    (
        "09-end",
        "the wall is exact: its columns of J are zero",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    n = np.array([np.cos(x[k + 1]), np.sin(x[k + 1])])
    t = np.array([-n[1], n[0]])
    f = x[2] + beta
    u = np.array([np.cos(f), np.sin(f)])
    v = np.array([-u[1], u[0]])
    r = (x[k] - n @ x[:2]) / (n @ u)
    J = np.zeros((2, len(x)))
    J[:, :2] = np.outer(t, v) / (t @ v)
    J[:, 2] = t * r / (t @ v)
    return x[:2] + r * u, J @ P @ J.T + sigma ** 2 * np.outer(J[:, 2], J[:, 2]), J @ P
""",
    ),
    (
        "09-end",
        "pose and wall as if independent of each other",
        """
def end_point(x, P, j, beta, sigma):
    at = 3 + 2 * j
    Q = np.zeros_like(P)
    Q[:3, :3] = P[:3, :3]
    Q[at:at + 2, at:at + 2] = P[at:at + 2, at:at + 2]
    n = np.array([np.cos(x[at + 1]), np.sin(x[at + 1])])
    u = np.array([np.cos(x[2] + beta), np.sin(x[2] + beta)])
    t, v = np.array([-n[1], n[0]]), np.array([-u[1], u[0]])
    r = (x[at] - n @ x[:2]) / (n @ u)
    p = x[:2] + r * u
    A = np.array([n, v])
    B = np.zeros((2, len(x)))
    B[0, at], B[0, at + 1] = 1, -t @ p
    B[1, :2], B[1, 2] = v, r
    J = np.linalg.inv(A) @ B
    g = np.linalg.inv(A) @ [0, r]
    return p, J @ Q @ J.T + sigma ** 2 * np.outer(g, g), J @ P
""",
    ),
    (
        "09-end",
        "half-finished: a round ellipse of r sigma, X zero",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    c, s = np.cos(x[k + 1]), np.sin(x[k + 1])
    u = np.array([np.cos(x[2] + beta), np.sin(x[2] + beta)])
    r = (x[k] - c * x[0] - s * x[1]) / (c * u[0] + s * u[1])
    return x[:2] + r * u, P[:2, :2] + (r * sigma) ** 2 * np.eye(2), np.zeros((2, len(x)))
""",
    ),
    (
        "09-end",
        "differences with a far too large step",
        """
def end_point(x, P, j, beta, sigma):
    at = 3 + 2 * j

    def meet(x, beta):
        c, s = np.cos(x[at + 1]), np.sin(x[at + 1])
        u = np.array([np.cos(x[2] + beta), np.sin(x[2] + beta)])
        return x[:2] + (x[at] - c * x[0] - s * x[1]) / (c * u[0] + s * u[1]) * u

    p, e = meet(x, beta), 0.01
    J = np.column_stack([(meet(x + e * row, beta) - p) / e for row in np.eye(len(x))])
    b = (meet(x, beta + e) - p) / e
    return p, J @ P @ J.T + sigma ** 2 * np.outer(b, b), J @ P
""",
    ),
    (
        "09-end",
        "sigma taken for degrees",
        """
def end_point(x, P, j, beta, sigma):
    k = 3 + 2 * j
    rho, alpha = x[k], x[k + 1]
    n, dn = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
    f = x[2] + beta
    b, db = np.array([np.cos(f), np.sin(f)]), np.array([-np.sin(f), np.cos(f)])
    nb = n @ b
    r = (rho - n @ x[:2]) / nb
    p = x[:2] + r * b
    dr = np.zeros(len(x))
    dr[:2] = -n / nb
    dr[2] = -r * (n @ db) / nb
    dr[k] = 1 / nb
    dr[k + 1] = -(dn @ p) / nb
    J = np.outer(b, dr)
    J[:, :2] += np.eye(2)
    J[:, 2] += r * db
    along = J[:, 2]
    return p, J @ P @ J.T + np.radians(sigma) ** 2 * np.outer(along, along), J @ P
""",
    ),
]
