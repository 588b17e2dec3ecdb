"""A fifth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "15-jacobians",
        "complex numbers",
        """
def jacobians(x_i, x_j, z):
    w = np.exp(-1j * (x_i[2] + z[2]))
    d = complex(x_j[0] - x_i[0], x_j[1] - x_i[1])
    B = np.array([[w.real, -w.imag, 0], [w.imag, w.real, 0], [0, 0, 1.0]])
    A = -B.copy()
    swing = -1j * w * d
    A[0, 2], A[1, 2] = swing.real, swing.imag
    return A, B
""",
    ),
]

WRONG = [
    (
        "15-range",
        "unit vector not normalised",
        """
def range_edge(x_i, x_j, r, a_i, a_j):
    rot = lambda t: np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])
    p, q = rot(x_i[2]) @ a_i, rot(x_j[2]) @ a_j
    d = x_j[:2] + q - x_i[:2] - p
    A = np.array([-d[0], -d[1], d[0] * p[1] - d[1] * p[0]])
    B = np.array([d[0], d[1], d[1] * q[0] - d[0] * q[1]])
    return np.hypot(*d) - r, A, B
""",
    ),
    (
        "15-step",
        "information forgotten",
        """
def step(poses, edges):
    n = 3 * len(poses)
    H, b = np.zeros((n, n)), np.zeros(n)
    for i, j, z, _ in edges:
        A, B = jacobians(poses[i], poses[j], z)
        J = np.zeros((3, n))
        J[:, 3 * i:3 * i + 3], J[:, 3 * j:3 * j + 3] = A, B
        H += J.T @ J
        b += J.T @ error(poses[i], poses[j], z)
    new = poses.copy()
    new[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
    ),
]
