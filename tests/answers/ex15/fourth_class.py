"""A fourth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "15-error",
        "homogeneous matrices",
        """
def error(x_i, x_j, z):
    def T(p):
        c, s = np.cos(p[2]), np.sin(p[2])
        return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])
    M = np.linalg.solve(T(x_i) @ T(z), T(x_j))
    return [M[0, 2], M[1, 2], np.arctan2(M[1, 0], M[0, 0])]
""",
    ),
    (
        "15-step",
        "one tall least squares problem",
        """
def step(poses, edges):
    n = len(poses)
    rows, right = [], []
    for i, j, z, L in edges:
        U = np.linalg.cholesky(L).T
        A, B = jacobians(poses[i], poses[j], z)
        J = np.zeros((3, 3 * n))
        J[:, 3 * i:3 * i + 3] += A
        J[:, 3 * j:3 * j + 3] += B
        rows.append(U @ J)
        right.append(-U @ error(poses[i], poses[j], z))
    d = np.linalg.lstsq(np.vstack(rows)[:, 3:], np.concatenate(right), rcond=None)[0]
    new = poses + np.vstack([np.zeros(3), d.reshape(-1, 3)])
    new[:, 2] = wrap(new[:, 2])
    return new
""",
    ),
]

WRONG = [
    (
        "15-error",
        "rotation by θ_z forgotten",
        """
def error(x_i, x_j, z):
    e = between(x_i, x_j) - z
    e[2] = wrap(e[2])
    return e
""",
    ),
    (
        "15-error",
        "the other way round",
        """
def error(x_i, x_j, z):
    return between(between(x_i, x_j), z)
""",
    ),
    (
        "15-error",
        "degrees in the last",
        """
def error(x_i, x_j, z):
    e = between(z, between(x_i, x_j))
    e[2] = np.degrees(e[2])
    return e
""",
    ),
    (
        "15-jacobians",
        "the swing without θ_z",
        """
def jacobians(x_i, x_j, z):
    c, s = np.cos(x_i[2] + z[2]), np.sin(x_i[2] + z[2])
    R = np.array([[c, s], [-s, c]])
    ci, si = np.cos(x_i[2]), np.sin(x_i[2])
    d = x_j[:2] - x_i[:2]
    A, B = np.zeros((3, 3)), np.eye(3)
    A[:2, :2], B[:2, :2] = -R, R
    A[:2, 2] = [-si * d[0] + ci * d[1], -ci * d[0] - si * d[1]]
    A[2, 2] = -1
    return A, B
""",
    ),
    (
        "15-jacobians",
        "rotations not transposed",
        """
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    c, s = np.cos(t), np.sin(t)
    R = np.array([[c, -s], [s, c]])
    d = x_j[:2] - x_i[:2]
    A, B = np.zeros((3, 3)), np.eye(3)
    A[:2, :2], B[:2, :2] = -R, R
    A[:2, 2] = R @ [d[1], -d[0]]
    A[2, 2] = -1
    return A, B
""",
    ),
    (
        "15-jacobians",
        "B with the identity for its rotation",
        """
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    c, s = np.cos(t), np.sin(t)
    R = np.array([[c, s], [-s, c]])
    d = x_j[:2] - x_i[:2]
    A = np.zeros((3, 3))
    A[:2, :2], A[:2, 2], A[2, 2] = -R, R @ [d[1], -d[0]], -1
    return A, np.eye(3)
""",
    ),
    (
        "15-step",
        "plus in place of minus",
        """
def step(poses, edges):
    n = 3 * len(poses)
    H, b = np.zeros((n, n)), np.zeros(n)
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        J = np.zeros((3, n))
        J[:, 3 * i:3 * i + 3], J[:, 3 * j:3 * j + 3] = A, B
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    new = poses.copy()
    new[1:] += np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
    ),
    (
        "15-step",
        "overwrites blocks in place of adding",
        """
def step(poses, edges):
    n = 3 * len(poses)
    H, b = np.zeros((n, n)), np.zeros(n)
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        e = error(poses[i], poses[j], z)
        si, sj = slice(3 * i, 3 * i + 3), slice(3 * j, 3 * j + 3)
        H[si, si] += A.T @ L @ A
        H[sj, sj] += B.T @ L @ B
        H[si, sj] = A.T @ L @ B
        H[sj, si] = B.T @ L @ A
        b[si] += A.T @ L @ e
        b[sj] += B.T @ L @ e
    new = poses.copy()
    new[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
    ),
    (
        "15-step",
        "pose 0 held by a soft prior of one",
        """
def step(poses, edges):
    n = 3 * len(poses)
    H, b = np.zeros((n, n)), np.zeros(n)
    H[:3, :3] = np.eye(3)
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        J = np.zeros((3, n))
        J[:, 3 * i:3 * i + 3], J[:, 3 * j:3 * j + 3] = A, B
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    new = poses + np.linalg.solve(H, -b).reshape(-1, 3)
    return new
""",
    ),
    (
        "15-step",
        "poses changed in place",
        """
def step(poses, edges):
    n = 3 * len(poses)
    H, b = np.zeros((n, n)), np.zeros(n)
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        J = np.zeros((3, n))
        J[:, 3 * i:3 * i + 3], J[:, 3 * j:3 * j + 3] = A, B
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    poses[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    poses[:, 2] = wrap(poses[:, 2])
    return poses
""",
    ),
    (
        "15-range",
        "radios at the centres",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    d = x_j[:2] - x_i[:2]
    n = np.hypot(*d)
    return n - r, np.array([-d[0] / n, -d[1] / n, 0]), np.array([d[0] / n, d[1] / n, 0])
""",
    ),
    (
        "15-range",
        "the swing by the arm in the robot's frame",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    rot = lambda t: np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])
    d = x_j[:2] + rot(x_j[2]) @ a_j - x_i[:2] - rot(x_i[2]) @ a_i
    n = np.hypot(*d)
    u = d / n
    A = np.array([-u[0], -u[1], -(u @ [-a_i[1], a_i[0]])])
    B = np.array([u[0], u[1], u @ [-a_j[1], a_j[0]]])
    return n - r, A, B
""",
    ),
    (
        "15-range",
        "squared distances",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    rot = lambda t: np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])
    p, q = rot(x_i[2]) @ a_i, rot(x_j[2]) @ a_j
    d = x_j[:2] + q - x_i[:2] - p
    A = 2 * np.array([-d[0], -d[1], d[0] * p[1] - d[1] * p[0]])
    B = 2 * np.array([d[0], d[1], -d[0] * q[1] + d[1] * q[0]])
    return d @ d - r ** 2, A, B
""",
    ),
    (
        "15-range",
        "e and Jacobians in another order",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    rot = lambda t: np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])
    p, q = rot(x_i[2]) @ a_i, rot(x_j[2]) @ a_j
    d = x_j[:2] + q - x_i[:2] - p
    n = np.hypot(*d)
    A = np.array([-d[0], -d[1], d[0] * p[1] - d[1] * p[0]]) / n
    B = np.array([d[0], d[1], -d[0] * q[1] + d[1] * q[0]]) / n
    return A, B, n - r
""",
    ),
    (
        "15-liars",
        "all loops trusted",
        """
def close_loops(poses, edges, loops):
    for _ in range(10):
        poses = step(poses, edges + loops)
    return poses
""",
    ),
]
