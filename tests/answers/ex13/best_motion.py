"""Independent answers to 13-best-motion: right ones, and students' mistakes."""

RIGHT = [
    (
        "13-best-motion",
        "angle by arctan2 of dot and cross products",
        """
def best_motion(source, target):
    ca, cb = np.mean(source, axis=0), np.mean(target, axis=0)
    a, b = source - ca, target - cb
    dot = np.sum(a * b)
    cross = np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    angle = np.arctan2(cross, dot)
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([[c, -s], [s, c]])
    T = np.eye(3)
    T[:2, :2] = R
    T[:2, 2] = cb - R @ ca
    return T
""",
    ),
    (
        "13-best-motion",
        "complex numbers",
        """
def best_motion(source, target):
    a = source[:, 0] + 1j * source[:, 1]
    b = target[:, 0] + 1j * target[:, 1]
    turn = np.sum(np.conj(a - a.mean()) * (b - b.mean()))
    turn /= abs(turn)
    t = b.mean() - turn * a.mean()
    return np.array([[turn.real, -turn.imag, t.real], [turn.imag, turn.real, t.imag], [0, 0, 1]])
""",
    ),
    (
        "13-best-motion",
        "SVD with diag(1, det)",
        """
def best_motion(source, target):
    n = len(source)
    a, b = source.sum(axis=0) / n, target.sum(axis=0) / n
    H = np.zeros((2, 2))
    for p, q in zip(source, target):
        H += np.outer(p - a, q - b)
    U, S, Vt = np.linalg.svd(H)
    V = Vt.T
    R = V @ np.diag([1.0, np.sign(np.linalg.det(V @ U.T))]) @ U.T
    return np.block([[R, (b - R @ a)[:, None]], [np.zeros((1, 2)), np.ones((1, 1))]])
""",
    ),
]

WRONG = [
    (
        "13-best-motion",
        "may be a mirror",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    U, S, Vt = np.linalg.svd((source - a).T @ (target - b))
    R = Vt.T @ U.T
    T = np.eye(3)
    T[:2, :2], T[:2, 2] = R, b - R @ a
    return T
""",
    ),
    (
        "13-best-motion",
        "U V' instead of V U'",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    U, _, Vt = np.linalg.svd((source - a).T @ (target - b))
    if np.linalg.det(U @ Vt) < 0:
        Vt[1] *= -1
    T = np.eye(3)
    T[:2, :2] = U @ Vt
    T[:2, 2] = b - T[:2, :2] @ a
    return T
""",
    ),
    (
        "13-best-motion",
        "numpy's Vt taken for V",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    U, S, V = np.linalg.svd((source - a).T @ (target - b))
    R = V @ U.T
    if np.linalg.det(R) < 0:
        V[:, 1] = -V[:, 1]
        R = V @ U.T
    T = np.eye(3)
    T[:2, :2] = R
    T[:2, 2] = b - R @ a
    return T
""",
    ),
    (
        "13-best-motion",
        "shift is the difference of the centroids",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    d, e = source - a, target - b
    angle = np.arctan2(np.sum(d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0]), np.sum(d * e))
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, b[0] - a[0]], [s, c, b[1] - a[1]], [0, 0, 1]])
""",
    ),
    (
        "13-best-motion",
        "a mirror is mended by turning the wrong (first) direction over",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    U, _, Vt = np.linalg.svd((source - a).T @ (target - b))
    R = Vt.T @ U.T
    if np.linalg.det(R) < 0:
        R = Vt.T @ np.diag([-1, 1]) @ U.T
    T = np.eye(3)
    T[:2, :2], T[:2, 2] = R, b - R @ a
    return T
""",
    ),
    (
        "13-best-motion",
        "a mirror is mended by -R (its determinant stays)",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    U, _, Vt = np.linalg.svd((source - a).T @ (target - b))
    R = Vt.T @ U.T
    if np.linalg.det(R) < 0:
        R = -R
    T = np.eye(3)
    T[:2, :2], T[:2, 2] = R, b - R @ a
    return T
""",
    ),
    (
        "13-best-motion",
        "a column of R turned over afterwards",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    U, _, Vt = np.linalg.svd((source - a).T @ (target - b))
    R = (U @ Vt).T
    if np.linalg.det(R) < 0:
        R[:, 1] *= -1
    T = np.eye(3)
    T[:2, :2], T[:2, 2] = R, b - R @ a
    return T
""",
    ),
    (
        "13-best-motion",
        "centroids not taken off",
        """
def best_motion(source, target):
    U, _, Vt = np.linalg.svd(source.T @ target)
    if np.linalg.det(Vt.T @ U.T) < 0:
        Vt[1] *= -1
    R = Vt.T @ U.T
    T = np.eye(3)
    T[:2, :2] = R
    T[:2, 2] = target.mean(axis=0) - R @ source.mean(axis=0)
    return T
""",
    ),
    (
        "13-best-motion",
        "one number as centroid: mean without the axis",
        """
def best_motion(source, target):
    a, b = source.mean(), target.mean()
    U, _, Vt = np.linalg.svd((source - a).T @ (target - b))
    if np.linalg.det(Vt.T @ U.T) < 0:
        Vt[1] *= -1
    R = Vt.T @ U.T
    T = np.eye(3)
    T[:2, :2] = R
    T[:2, 2] = target.mean(axis=0) - R @ source.mean(axis=0)
    return T
""",
    ),
    (
        "13-best-motion",
        "takes the centroids off in place",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    source -= a
    target -= b
    U, _, Vt = np.linalg.svd(source.T @ target)
    if np.linalg.det(Vt.T @ U.T) < 0:
        Vt[1] *= -1
    T = np.eye(3)
    T[:2, :2] = Vt.T @ U.T
    T[:2, 2] = b - T[:2, :2] @ a
    return T
""",
    ),
    (
        "13-best-motion",
        "carries the target to the source",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    H = (target - b).T @ (source - a)
    U, _, Vt = np.linalg.svd(H)
    if np.linalg.det(Vt.T @ U.T) < 0:
        Vt[1] *= -1
    T = np.eye(3)
    T[:2, :2] = Vt.T @ U.T
    T[:2, 2] = a - T[:2, :2] @ b
    return T
""",
    ),
    (
        "13-best-motion",
        "arctan instead of arctan2",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    d, e = source - a, target - b
    angle = np.arctan((d[:, 0] @ e[:, 1] - d[:, 1] @ e[:, 0]) / (d[:, 0] @ e[:, 0] + d[:, 1] @ e[:, 1]))
    T = np.eye(3)
    T[0, 0] = T[1, 1] = np.cos(angle)
    T[1, 0], T[0, 1] = np.sin(angle), -np.sin(angle)
    T[:2, 2] = b - T[:2, :2] @ a
    return T
""",
    ),
    (
        "13-best-motion",
        "only the first and the last pair",
        """
def best_motion(source, target):
    d, e = source[-1] - source[0], target[-1] - target[0]
    angle = np.arctan2(e[1], e[0]) - np.arctan2(d[1], d[0])
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([[c, -s], [s, c]])
    T = np.eye(3)
    T[:2, :2], T[:2, 2] = R, target.mean(axis=0) - R @ source.mean(axis=0)
    return T
""",
    ),
    (
        "13-best-motion",
        "matrix of the clouds' type: whole numbers cut it off",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    U, _, Vt = np.linalg.svd((source - a).T @ (target - b))
    if np.linalg.det(Vt.T @ U.T) < 0:
        Vt[1] *= -1
    R = Vt.T @ U.T
    T = np.zeros((3, 3), dtype=source.dtype)
    T[:2, :2], T[:2, 2], T[2, 2] = R, b - R @ a, 1
    return T
""",
    ),
]
