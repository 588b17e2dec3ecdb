"""A fourth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "13-best-motion",
        "complex numbers",
        """
def best_motion(source, target):
    a = source[:, 0] + 1j * source[:, 1]
    b = target[:, 0] + 1j * target[:, 1]
    w = np.sum((b - b.mean()) * np.conj(a - a.mean()))
    w = w / abs(w)
    t = b.mean() - w * a.mean()
    return np.array([[w.real, -w.imag, t.real], [w.imag, w.real, t.imag], [0, 0, 1]])
""",
    ),
    (
        "13-line-step",
        "lstsq of whitened rows",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    L = np.linalg.cholesky(np.linalg.inv(Q)).T
    rows, right = [], []
    for a, b, n, s in zip(source, target, normals, sigma):
        m = R.T @ n
        rows.append(np.array([m[0], m[1], m[1] * a[0] - m[0] * a[1]]) / s)
        right.append(-(n @ (R @ a + t - b)) / s)
    A = np.vstack([*rows, L])
    y = np.array([*right, 0, 0, 0])
    return np.linalg.lstsq(A, y, rcond=None)[0], np.linalg.inv(A.T @ A)
""",
    ),
]

WRONG = [
    (
        "13-best-motion",
        "the mirror is kept",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    U, _, Vt = np.linalg.svd((source - a).T @ (target - b))
    R = Vt.T @ U.T
    T = np.eye(3)
    T[:2, :2], T[:2, 2] = R, b - R @ a
    return T
""",
    ),
    (
        "13-best-motion",
        "shift between centroids, not turned",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    M = (source - a).T @ (target - b)
    t = np.arctan2(M[0, 1] - M[1, 0], M[0, 0] + M[1, 1])
    c, s = np.cos(t), np.sin(t)
    return np.array([[c, -s, b[0] - a[0]], [s, c, b[1] - a[1]], [0, 0, 1]])
""",
    ),
    (
        "13-best-motion",
        "the inverse motion",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    M = (source - a).T @ (target - b)
    t = np.arctan2(M[1, 0] - M[0, 1], M[0, 0] + M[1, 1])
    c, s = np.cos(t), np.sin(t)
    R = np.array([[c, -s], [s, c]])
    T = np.eye(3)
    T[:2, :2], T[:2, 2] = R, b - R @ a
    return T
""",
    ),
    (
        "13-best-motion",
        "in place: centroids taken off the clouds",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    source -= a
    target -= b
    M = source.T @ target
    t = np.arctan2(M[0, 1] - M[1, 0], M[0, 0] + M[1, 1])
    c, s = np.cos(t), np.sin(t)
    R = np.array([[c, -s], [s, c]])
    T = np.eye(3)
    T[:2, :2], T[:2, 2] = R, b - R @ a
    return T
""",
    ),
    (
        "13-icp",
        "multiplied on the other side",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        moved = carry(T, source)
        _, rows = nearest(moved, target)
        T = T @ best_motion(moved, target[rows])
    return T
""",
    ),
    (
        "13-icp",
        "pairs found once",
        """
def icp(source, target, T, rounds):
    _, rows = nearest(carry(T, source), target)
    for _ in range(rounds):
        moved = carry(T, source)
        T = best_motion(moved, target[rows]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "a round more",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds + 1):
        moved = carry(T, source)
        _, rows = nearest(moved, target)
        T = best_motion(moved, target[rows]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "forgets the first guess",
        """
def icp(source, target, T, rounds):
    T = np.eye(3)
    for _ in range(rounds):
        moved = carry(T, source)
        _, rows = nearest(moved, target)
        T = best_motion(moved, target[rows]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "keeps the longest",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        order = np.argsort(d)[-keep:]
        T = best_motion(moved[order], target[rows[order]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "share of the target",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(target))
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        order = np.argsort(d)[:keep]
        T = best_motion(moved[order], target[rows[order]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "sorted points, unsorted partners",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        order = np.argsort(d)[:keep]
        T = best_motion(moved[order], target[rows][:keep]) @ T
    return T
""",
    ),
    (
        "13-line-step",
        "step in the target's frame",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    moved = source @ R.T + t
    e = np.sum(normals * (moved - target), axis=1)
    J = np.column_stack([normals, normals[:, 1] * moved[:, 0] - normals[:, 0] * moved[:, 1]])
    W = np.diag(1 / sigma ** 2)
    P = np.linalg.inv(J.T @ W @ J + np.linalg.inv(Q))
    return -P @ J.T @ W @ e, P
""",
    ),
    (
        "13-line-step",
        "sigma not squared",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    e = np.sum(normals * (source @ R.T + t - target), axis=1)
    m = normals @ R
    J = np.column_stack([m, m[:, 1] * source[:, 0] - m[:, 0] * source[:, 1]])
    W = np.diag(1 / sigma)
    P = np.linalg.inv(J.T @ W @ J + np.linalg.inv(Q))
    return -P @ J.T @ W @ e, P
""",
    ),
    (
        "13-line-step",
        "the odometry's information forgotten",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    e = np.sum(normals * (source @ R.T + t - target), axis=1)
    m = normals @ R
    J = np.column_stack([m, m[:, 1] * source[:, 0] - m[:, 0] * source[:, 1]])
    W = np.diag(1 / sigma ** 2)
    P = np.linalg.inv(J.T @ W @ J)
    return -P @ J.T @ W @ e, P
""",
    ),
    (
        "13-overlap",
        "trimmed ICP from the guess",
        """
def match(source, target, T):
    return trimmed_icp(source, target, T, 50, 0.6)
""",
    ),
]
