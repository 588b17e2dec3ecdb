"""Independent answers to 15-jacobians: right ones, and students' mistakes."""

RIGHT = [
    (
        "15-jacobians",
        "blocks, chain rule through seen = between(x_i, x_j)",
        """
def jacobians(x_i, x_j, z):
    def R(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    seen = R(x_i[2]).T @ (x_j[:2] - x_i[:2])
    A, B = np.zeros((3, 3)), np.zeros((3, 3))
    back = (R(x_i[2]) @ R(z[2])).T
    A[:2, :2] = -back
    A[:2, 2] = R(z[2]).T @ np.array([seen[1], -seen[0]])
    A[2, 2] = -1
    B[:2, :2] = back
    B[2, 2] = 1
    return A, B
""",
    ),
    (
        "15-jacobians",
        "central differences, the angle wrapped",
        """
def jacobians(x_i, x_j, z):
    x_i, x_j = np.array(x_i, dtype=float), np.array(x_j, dtype=float)
    h, A, B = 1e-5, np.empty((3, 3)), np.empty((3, 3))
    for k in range(3):
        d = np.zeros(3)
        d[k] = h
        a = error(x_i + d, x_j, z) - error(x_i - d, x_j, z)
        b = error(x_i, x_j + d, z) - error(x_i, x_j - d, z)
        a[2], b[2] = wrap(a[2]), wrap(b[2])
        A[:, k], B[:, k] = a / (2 * h), b / (2 * h)
    return A, B
""",
    ),
]

WRONG = [
    (
        "15-jacobians",
        "forgot that turning pose i swings the way",
        """
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    B = np.array([[np.cos(t), np.sin(t), 0], [-np.sin(t), np.cos(t), 0], [0, 0, 1]])
    return -B, B
""",
    ),
    (
        "15-jacobians",
        "rotation not transposed",
        """
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    c, s = np.cos(t), np.sin(t)
    B = np.eye(3)
    B[:2, :2] = [[c, -s], [s, c]]
    A = -B
    dx, dy = x_j[:2] - x_i[:2]
    A[:2, 2] = [c * dy - s * dx, -c * dx - s * dy]
    return A, B
""",
    ),
    (
        "15-jacobians",
        "turned by theta_i alone, theta_z forgotten",
        """
def jacobians(x_i, x_j, z):
    c, s = np.cos(x_i[2]), np.sin(x_i[2])
    seen = np.array([[c, s], [-s, c]]) @ (x_j - x_i)[:2]
    A = np.array([[-c, -s, seen[1]], [s, -c, -seen[0]], [0, 0, -1]])
    B = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    return A, B
""",
    ),
    (
        "15-jacobians",
        "third column left in pose i's frame",
        """
def jacobians(x_i, x_j, z):
    def Rt(a):
        return np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]])

    seen = Rt(x_i[2]) @ (x_j[:2] - x_i[:2])
    A, B = -np.eye(3), np.eye(3)
    B[:2, :2] = Rt(x_i[2] + z[2])
    A[:2, :2] = -B[:2, :2]
    A[:2, 2] = seen[1], -seen[0]
    return A, B
""",
    ),
    (
        "15-jacobians",
        "swings all of e round pose i, t_z included",
        """
def jacobians(x_i, x_j, z):
    e = error(x_i, x_j, z)
    t = x_i[2] + z[2]
    R = np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])
    B = np.block([[R.T, np.zeros((2, 1))], [np.zeros((1, 2)), np.ones((1, 1))]])
    A = -B
    A[0, 2], A[1, 2] = e[1], -e[0]
    return A, B
""",
    ),
    (
        "15-jacobians",
        "third column of A with the wrong sign",
        """
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    Rt = np.array([[np.cos(t), np.sin(t)], [-np.sin(t), np.cos(t)]])
    swing = np.array([[0, -1], [1, 0]]) @ Rt @ (x_j[:2] - x_i[:2])
    A = np.vstack([np.column_stack([-Rt, swing]), [0, 0, -1]])
    B = np.vstack([np.column_stack([Rt, np.zeros(2)]), [0, 0, 1]])
    return A, B
""",
    ),
    (
        "15-jacobians",
        "returns B, A",
        """
def jacobians(x_i, x_j, z):
    angle = x_i[2] + z[2]
    c, s = np.cos(angle), np.sin(angle)
    dx, dy = x_j[0] - x_i[0], x_j[1] - x_i[1]
    wrt_j = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    wrt_i = np.array([[-c, -s, c * dy - s * dx], [s, -c, -c * dx - s * dy], [0, 0, -1]])
    return wrt_j, wrt_i
""",
    ),
    (
        "15-jacobians",
        "takes theta_j for theta_i + theta_z (true only if e's angle is zero)",
        """
def jacobians(x_i, x_j, z):
    c, s = np.cos(x_j[2]), np.sin(x_j[2])
    d = x_j[:2] - x_i[:2]
    A, B = np.zeros((3, 3)), np.zeros((3, 3))
    B[0] = c, s, 0
    B[1] = -s, c, 0
    B[2, 2] = 1
    A[:, :2] = -B[:, :2]
    A[:, 2] = c * d[1] - s * d[0], -c * d[0] - s * d[1], -1
    return A, B
""",
    ),
    (
        "15-jacobians",
        "forward differences without wrapping: breaks at e's angle = pi",
        """
def jacobians(x_i, x_j, z):
    h = 1e-7
    e = error(x_i, x_j, z)
    A = np.column_stack([(error(x_i + d, x_j, z) - e) / h for d in h * np.eye(3)])
    B = np.column_stack([(error(x_i, x_j + d, z) - e) / h for d in h * np.eye(3)])
    return A, B
""",
    ),
    (
        "15-jacobians",
        "coarse one-sided differences of a tenth of a radian",
        """
def jacobians(x_i, x_j, z):
    A, B, h = np.zeros((3, 3)), np.zeros((3, 3)), 0.1
    for k in range(3):
        p, q = x_i.copy(), x_j.copy()
        p[k] += h
        q[k] += h
        for M, e in ((A, error(p, x_j, z)), (B, error(x_i, q, z))):
            d = e - error(x_i, x_j, z)
            d[2] = wrap(d[2])
            M[:, k] = d / h
    return A, B
""",
    ),
    (
        "15-jacobians",
        "differences that push the caller's own poses",
        """
def jacobians(x_i, x_j, z):
    h, out = 1e-6, []
    for x in (x_i, x_j):
        J = np.zeros((3, 3))
        for k in range(3):
            p = x
            before = error(x_i, x_j, z)
            p[k] += h
            d = error(x_i, x_j, z) - before
            d[2] = wrap(d[2])
            J[:, k] = d / h
        out.append(J)
    return out[0], out[1]
""",
    ),
    (
        "15-jacobians",
        "derivative by a motion in each robot's own frame",
        """
def jacobians(x_i, x_j, z):
    def R(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    seen = between(x_i, x_j)
    A, B = -np.eye(3), np.eye(3)
    A[:2, :2] = -R(z[2]).T
    A[:2, 2] = R(z[2]).T @ np.array([seen[1], -seen[0]])
    B[:2, :2] = R(seen[2] - z[2])
    return A, B
""",
    ),
    (
        "15-jacobians",
        "whole numbers: cos and sin are cut off in an int matrix",
        """
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    B = np.diag([1, 1, 1])
    B[0, :2] = np.cos(t), np.sin(t)
    B[1, :2] = -np.sin(t), np.cos(t)
    A = -1.0 * B
    d = x_j[:2] - x_i[:2]
    A[0, 2] = B[1, :2] @ d
    A[1, 2] = -B[0, :2] @ d
    return A, B
""",
    ),
    (
        "15-jacobians",
        "A and B are the same array",
        """
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    c, s = np.cos(t), np.sin(t)
    B = np.array([[c, s, 0.0], [-s, c, 0.0], [0, 0, 1]])
    A = B
    A *= -1
    A[:2, 2] = c * (x_j[1] - x_i[1]) - s * (x_j[0] - x_i[0]), -c * (x_j[0] - x_i[0]) - s * (
        x_j[1] - x_i[1]
    )
    return A, B
""",
    ),
]
