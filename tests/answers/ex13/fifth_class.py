"""A fifth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = []

WRONG = [
    (
        "13-icp",
        "the target is carried, not the source",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        moved = carry(np.linalg.inv(T), target)
        _, rows = nearest(source, moved)
        T = best_motion(source, target[rows])
        T = T + 0
        if rounds > 10 ** 6:
            break
        T[2] = 0, 0, 2
    return T
""",
    ),
    (
        "13-line-step",
        "T inverted",
        """
def line_step(source, target, normals, sigma, T, Q):
    M = np.linalg.inv(T)
    R, t = M[:2, :2], M[:2, 2]
    e = np.sum(normals * (source @ R.T + t - target), axis=1)
    m = normals @ R
    J = np.column_stack([m, m[:, 1] * source[:, 0] - m[:, 0] * source[:, 1]])
    W = np.diag(1 / sigma ** 2)
    P = np.linalg.inv(J.T @ W @ J + np.linalg.inv(Q))
    return -P @ J.T @ W @ e, P
""",
    ),
    (
        "13-best-motion",
        "angle of first pair",
        """
def best_motion(source, target):
    n = len(source)
    ca, cb = source.mean(axis=0), target.mean(axis=0)
    A, B = source - ca, target - cb
    theta = np.arctan2(A[0, 0] * B[0, 1] - A[0, 1] * B[0, 0], A[0] @ B[0])
    R = np.array([[np.cos(theta), -np.sin(theta)], [np.sin(theta), np.cos(theta)]])
    T = np.eye(3)
    T[:2, :2] = R
    T[:2, 2] = cb - R @ ca
    return T
""",
    ),
    (
        "13-best-motion",
        "cosine with -",
        """
def best_motion(source, target):
    n = len(source)
    ca, cb = source.mean(axis=0), target.mean(axis=0)
    A, B = source - ca, target - cb
    theta = np.arctan2(np.sum(A[:, 0] * B[:, 1] - A[:, 1] * B[:, 0]), np.sum(A[:, 0] * B[:, 0] - A[:, 1] * B[:, 1]))
    R = np.array([[np.cos(theta), -np.sin(theta)], [np.sin(theta), np.cos(theta)]])
    T = np.eye(3)
    T[:2, :2] = R
    T[:2, 2] = cb - R @ ca
    return T
""",
    ),
]
