"""A sixth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "13-best-motion",
        "complex numbers",
        """
def best_motion(source, target):
    a, b = source @ [1, 1j], target @ [1, 1j]
    turn = np.vdot(a - a.mean(), b - b.mean())
    turn /= abs(turn)
    t = b.mean() - turn * a.mean()
    return np.array([[turn.real, -turn.imag, t.real], [turn.imag, turn.real, t.imag], [0, 0, 1]])
""",
    ),
    (
        "13-trimmed",
        "argpartition in place of a sort",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = max(2, int(np.ceil(share * len(source) - 1e-9)))
    for _ in range(rounds):
        at = carry(T, source)
        d, row = nearest(at, target)
        best = np.argpartition(d, keep - 1)[:keep]
        T = best_motion(source[best], target[row[best]])
    return T
""",
    ),
    (
        "13-line-step",
        "least squares with odometry as three more rows",
        """
def line_step(source, target, normals, sigma, T, Q):
    Rot, t = T[:2, :2], T[:2, 2]
    e = np.einsum("ij,ij->i", normals, source @ Rot.T + t - target)
    m = normals @ Rot
    J = np.column_stack([m, source[:, 0] * m[:, 1] - source[:, 1] * m[:, 0]])
    odometry = np.linalg.inv(np.linalg.cholesky(Q))
    A = np.vstack([J / sigma[:, None], odometry])
    b = np.concatenate([-e / sigma, np.zeros(3)])
    Qr, Rr = np.linalg.qr(A)
    half = np.linalg.inv(Rr)
    return half @ (Qr.T @ b), half @ half.T
""",
    ),
]

WRONG = [
    (
        "13-best-motion",
        "any linear map by least squares, and the rotation that is nearest to it",
        """
def best_motion(source, target):
    A = np.column_stack([source, np.ones(len(source))])
    M = np.linalg.lstsq(A, target, rcond=None)[0].T
    U, _, Vt = np.linalg.svd(M[:, :2])
    Rot = U @ np.diag([1, np.linalg.det(U @ Vt)]) @ Vt
    T = np.eye(3)
    T[:2, :2] = Rot
    T[:2, 2] = target.mean(axis=0) - Rot @ source.mean(axis=0)
    return T
""",
    ),
    (
        "13-best-motion",
        "the mean of the turns of all points about the centroid",
        """
def best_motion(source, target):
    a, b = source - source.mean(axis=0), target - target.mean(axis=0)
    turns = np.arctan2(b[:, 1], b[:, 0]) - np.arctan2(a[:, 1], a[:, 0])
    angle = np.arctan2(np.sin(turns).mean(), np.cos(turns).mean())
    c, s = np.cos(angle), np.sin(angle)
    T = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    T[:2, 2] = target.mean(axis=0) - T[:2, :2] @ source.mean(axis=0)
    return T
""",
    ),
    (
        "13-icp",
        "only pairs that choose each other",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        at = carry(T, source)
        _, there = nearest(at, target)
        _, back = nearest(target, at)
        both = back[there] == np.arange(len(source))
        if both.sum() < 2:
            break
        T = best_motion(source[both], target[there[both]])
    return T
""",
    ),
    (
        "13-icp",
        "the cloud that was carried is carried again by the whole motion",
        """
def icp(source, target, T, rounds):
    at = carry(T, source)
    for _ in range(rounds):
        _, row = nearest(at, target)
        T = best_motion(at, target[row]) @ T
        at = carry(T, at)
    return T
""",
    ),
    (
        "13-trimmed",
        "pairs shorter than a share of the longest",
        """
def trimmed_icp(source, target, T, rounds, share):
    for _ in range(rounds):
        at = carry(T, source)
        d, row = nearest(at, target)
        short = d <= share * d.max()
        if short.sum() < 2:
            short = np.argsort(d)[:2]
        T = best_motion(at[short], target[row[short]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "the points far from any partner at the guess are dropped for good",
        """
def trimmed_icp(source, target, T, rounds, share):
    d, _ = nearest(carry(T, source), target)
    kept = source[np.argsort(d)[: int(round(share * len(source)))]]
    return icp(kept, target, T, rounds)
""",
    ),
    (
        "13-line-step",
        "first the walls alone by the pseudoinverse, then fused with odometry as a filter does",
        """
def line_step(source, target, normals, sigma, T, Q):
    Rot, t = T[:2, :2], T[:2, 2]
    e = np.sum(normals * (source @ Rot.T + t - target), axis=1)
    m = normals @ Rot
    J = np.column_stack([m, source[:, 0] * m[:, 1] - source[:, 1] * m[:, 0]])
    W = np.diag(1 / sigma**2)
    C = np.linalg.pinv(J.T @ W @ J)
    seen = -C @ J.T @ W @ e
    K = Q @ np.linalg.inv(Q + C)
    return K @ seen, Q - K @ Q
""",
    ),
    (
        "13-overlap",
        "trimmed ICP from twelve turns, and the end whose points are nearest on average",
        """
def match(source, target, T):
    best = None
    for angle in np.linspace(-np.pi, np.pi, 12, endpoint=False):
        start = T.copy()
        start[:2, :2] = turned(angle)
        end = trimmed_icp(source, target, start, 20, 0.7)
        cost = nearest(carry(end, source), target)[0].mean()
        if best is None or cost < best[0]:
            best = cost, end
    return best[1]
""",
    ),
]
