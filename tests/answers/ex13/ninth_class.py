"""A ninth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "13-best-motion",
        "complex numbers: the rotation is the phase of sum conj(a) b",
        """
def best_motion(source, target):
    a = source[:, 0] + 1j * source[:, 1]
    b = target[:, 0] + 1j * target[:, 1]
    ma, mb = a.mean(), b.mean()
    q = np.sum(np.conj(a - ma) * (b - mb))
    phase = np.angle(q)
    w = np.exp(1j * phase)
    t = mb - w * ma
    return np.array([[w.real, -w.imag, t.real], [w.imag, w.real, t.imag], [0, 0, 1]])
""",
    ),
    (
        "13-icp",
        "each round fits the original source anew, so T is replaced and not multiplied",
        """
def icp(source, target, T, rounds):
    T = np.array(T, dtype=float)
    for _ in range(rounds):
        _, rows = nearest(carry(T, source), target)
        T = best_motion(source, target[rows])
    return T
""",
    ),
    (
        "13-line-step",
        "pair by pair like a Kalman filter: prior Q, one scalar measurement after the other",
        """
def line_step(source, target, normals, sigma, T, Q):
    delta, P = np.zeros(3), np.array(Q, dtype=float)
    Rot, t = T[:2, :2], T[:2, 2]
    quarter = np.array([[0.0, -1.0], [1.0, 0.0]])
    for a, b, n, s in zip(source, target, normals, sigma):
        e = n @ (Rot @ a + t - b)
        J = np.append(n @ Rot, n @ Rot @ quarter @ a)
        S = J @ P @ J + s**2
        K = P @ J / S
        delta = delta - K * (e + J @ delta)
        A = np.eye(3) - np.outer(K, J)
        P = A @ P @ A.T + s**2 * np.outer(K, K)
    return delta, P
""",
    ),
]

WRONG = [
    (
        "13-best-motion",
        "no test of the determinant: may return a mirror",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    U, _, Vt = np.linalg.svd((source - a).T @ (target - b))
    T = np.eye(3)
    T[:2, :2] = Vt.T @ U.T
    T[:2, 2] = b - T[:2, :2] @ a
    return T
""",
    ),
    (
        "13-best-motion",
        "U V^T instead of V U^T: turns the wrong way",
        """
def best_motion(source, target):
    ca, cb = np.mean(source, axis=0), np.mean(target, axis=0)
    M = np.zeros((2, 2))
    for p, q in zip(source, target):
        M += np.outer(p - ca, q - cb)
    U, _, Vt = np.linalg.svd(M)
    D = np.diag([1, np.sign(np.linalg.det(U @ Vt))])
    Rot = U @ D @ Vt
    T = np.eye(3)
    T[:2, :2] = Rot
    T[:2, 2] = cb - Rot @ ca
    return T
""",
    ),
    (
        "13-best-motion",
        "the shift is the difference of the centroids: the source's centroid is not turned first",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    p, q = source - a, target - b
    angle = np.arctan2(np.sum(p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]), np.sum(p * q))
    c, s = np.cos(angle), np.sin(angle)
    t = b - a
    return np.array([[c, -s, t[0]], [s, c, t[1]], [0, 0, 1]])
""",
    ),
    (
        "13-best-motion",
        "the angle is summed from the points as they are, not counted from their centroids",
        """
def best_motion(source, target):
    cross = np.sum(source[:, 0] * target[:, 1] - source[:, 1] * target[:, 0])
    angle = np.arctan2(cross, np.sum(source * target))
    c, s = np.cos(angle), np.sin(angle)
    Rot = np.array([[c, -s], [s, c]])
    T = np.eye(3)
    T[:2, :2] = Rot
    T[:2, 2] = (target - source @ Rot.T).mean(axis=0)
    return T
""",
    ),
    (
        "13-best-motion",
        "arctan of the quotient instead of arctan2: turns of more than a quarter come out half a turn off",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    (px, py), (qx, qy) = (source - a).T, (target - b).T
    angle = np.arctan(np.sum(px * qy - py * qx) / np.sum(px * qx + py * qy))
    c, s = np.cos(angle), np.sin(angle)
    T = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    T[:2, 2] = b - T[:2, :2] @ a
    return T
""",
    ),
    (
        "13-best-motion",
        "the mirror is mended at the wrong singular vector, that of the LARGEST singular value",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    U, _, Vt = np.linalg.svd((source - a).T @ (target - b))
    V = Vt.T
    if np.linalg.det(V @ U.T) < 0:
        V = V @ np.diag([-1, 1])
    Rot = V @ U.T
    return np.vstack([np.column_stack([Rot, b - Rot @ a]), [0, 0, 1]])
""",
    ),
    (
        "13-best-motion",
        "takes the centroids off in place: changes the caller's clouds, and fails for whole numbers",
        """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    source -= a
    target -= b
    angle = np.arctan2(
        np.sum(source[:, 0] * target[:, 1] - source[:, 1] * target[:, 0]), np.sum(source * target)
    )
    c, s = np.cos(angle), np.sin(angle)
    T = np.eye(3)
    T[:2, :2] = [[c, -s], [s, c]]
    T[:2, 2] = b - T[:2, :2] @ a
    return T
""",
    ),
    (
        "13-best-motion",
        "best affine map by least squares: not a rotation, it stretches and shears",
        """
def best_motion(source, target):
    A = np.column_stack([source, np.ones(len(source))])
    M, *_ = np.linalg.lstsq(A, target, rcond=None)
    T = np.eye(3)
    T[:2] = M.T
    return T
""",
    ),
    (
        "13-icp",
        "the new motion is multiplied on the wrong side (T @ new)",
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
        "the motion is fitted to the source as it was, and multiplied to T all the same: T counts twice",
        """
def icp(source, target, T, rounds):
    for k in range(rounds):
        pairs = nearest(carry(T, source), target)[1]
        T = best_motion(source, target[pairs]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "pairs are found once, before the first round, and kept",
        """
def icp(source, target, T, rounds):
    moved = carry(T, source)
    _, rows = nearest(moved, target)
    partners = target[rows]
    for _ in range(rounds):
        T = best_motion(carry(T, source), partners) @ T
    return T
""",
    ),
    (
        "13-icp",
        "partners are sought from where the source lay at first, not from where T has carried it",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        rows = nearest(source, target)[1]
        T = best_motion(carry(T, source), target[rows]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "stops as soon as a round moves less than a centimetre and a hundredth of a radian: not the given number of rounds",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        moved = carry(T, source)
        _, rows = nearest(moved, target)
        D = best_motion(moved, target[rows])
        T = D @ T
        if np.abs(D - np.eye(3)).max() < 1e-2:
            break
    return T
""",
    ),
    (
        "13-icp",
        "pairs the other way round: for each target point the nearest source point",
        """
def icp(source, target, T, rounds):
    T = T.copy()
    for _ in range(rounds):
        moved = source @ T[:2, :2].T + T[:2, 2]
        d, rows = cKDTree(moved).query(target)
        T = best_motion(moved[rows], target) @ T
    return T
""",
    ),
    (
        "13-icp",
        "one round too many, so 0 rounds do one",
        """
def icp(source, target, T, rounds):
    done = 0
    while True:
        moved = carry(T, source)
        dist, rows = nearest(moved, target)
        T = best_motion(moved, target[rows]) @ T
        done += 1
        if done > rounds:
            return T
""",
    ),
    (
        "13-icp",
        "returns the last round's motion alone instead of the product",
        """
def icp(source, target, T, rounds):
    moved = carry(T, source)
    for _ in range(rounds):
        _, rows = nearest(moved, target)
        T = best_motion(moved, target[rows])
        moved = carry(T, moved)
    return T
""",
    ),
    (
        "13-trimmed",
        "the share is taken of the number of target points instead of pairs",
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
        "keeps the pairs shorter than share times the longest one, not the shortest share of them",
        """
def trimmed_icp(source, target, T, rounds, share):
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        good = d <= share * d.max()
        T = best_motion(moved[good], target[rows[good]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "the pairs to keep are chosen in the first round alone; later rounds keep the same source points",
        """
def trimmed_icp(source, target, T, rounds, share):
    d, _ = nearest(carry(T, source), target)
    kept = source[np.argsort(d)[: int(round(share * len(source)))]]
    for _ in range(rounds):
        moved = carry(T, kept)
        _, rows = nearest(moved, target)
        T = best_motion(moved, target[rows]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "drops the share and keeps the rest: 1 - share of the pairs",
        """
def trimmed_icp(source, target, T, rounds, share):
    n = len(source)
    drop = int(share * n)
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        order = np.argsort(d)
        kept = order[: max(2, n - drop)]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "the longest pairs are kept (sorted the wrong way round)",
        """
def trimmed_icp(source, target, T, rounds, share):
    k = int(share * len(source))
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        best = sorted(range(len(d)), key=lambda i: -d[i])[:k]
        T = best_motion(moved[best], target[rows[best]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "the source is sorted by length, its partners are not: target[rows][:keep] goes with moved[kept], so points get the partners of others",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    for _ in range(rounds):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        kept = np.argsort(distances)[:keep]
        T = best_motion(moved[kept], target[rows][:keep]) @ T
    return T
""",
    ),
    (
        "13-line-step",
        "the lesson's step in the target's frame: normals as they are and the lever of the carried point",
        """
def line_step(source, target, normals, sigma, T, Q):
    moved = carry(T, source)
    e = np.sum(normals * (moved - target), axis=1)
    J = np.column_stack([normals, moved[:, 0] * normals[:, 1] - moved[:, 1] * normals[:, 0]])
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(J.T @ W @ J + np.linalg.inv(Q))
    return -P @ J.T @ W @ e, P
""",
    ),
    (
        "13-line-step",
        "weights 1/sigma instead of 1/sigma squared",
        """
def line_step(source, target, normals, sigma, T, Q):
    Rot, t = T[:2, :2], T[:2, 2]
    H, g = np.linalg.inv(Q), np.zeros(3)
    for a, b, n, s in zip(source, target, normals, sigma):
        m = Rot.T @ n
        J = np.array([m[0], m[1], a[0] * m[1] - a[1] * m[0]])
        e = n @ (Rot @ a + t - b)
        H = H + np.outer(J, J) / s
        g = g + J * e / s
    P = np.linalg.inv(H)
    return -P @ g, P
""",
    ),
    (
        "13-line-step",
        "odometry is forgotten: information of the walls alone, which is singular in a corridor and without pairs",
        """
def line_step(source, target, normals, sigma, T, Q):
    Rot, t = T[:2, :2], T[:2, 2]
    e = np.sum(normals * (source @ Rot.T + t - target), axis=1)
    seen = normals @ Rot
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    J, e = J / sigma[:, None], e / sigma
    P = np.linalg.pinv(J.T @ J)
    return -P @ J.T @ e, P
""",
    ),
    (
        "13-line-step",
        "Q itself is added instead of its inverse",
        """
def line_step(source, target, normals, sigma, T, Q):
    Rot, t = T[:2, :2], T[:2, 2]
    e = np.einsum("ni,ni->n", normals, source @ Rot.T + t - target)
    seen = normals @ Rot
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    w = 1 / sigma**2
    H = Q + (J.T * w) @ J
    return -np.linalg.solve(H, J.T @ (w * e)), np.linalg.inv(H)
""",
    ),
    (
        "13-line-step",
        "delta with the wrong sign: moves away from the walls",
        """
def line_step(source, target, normals, sigma, T, Q):
    Rot, t = T[:2, :2], T[:2, 2]
    resid = ((source @ Rot.T + t - target) * normals).sum(axis=1) / sigma
    m = normals @ Rot
    J = np.column_stack([m, source[:, 0] * m[:, 1] - source[:, 1] * m[:, 0]]) / sigma[:, None]
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ J)
    return P @ J.T @ resid, P
""",
    ),
    (
        "13-line-step",
        "normals are turned the wrong way (Rot n instead of Rot^T n)",
        """
def line_step(source, target, normals, sigma, T, Q):
    Rot, t = T[:2, :2], T[:2, 2]
    e = np.sum(normals * (source @ Rot.T + t - target), axis=1)
    seen = normals @ Rot.T
    lever = source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]
    J = np.column_stack([seen, lever])
    w = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ w @ J)
    return -P @ J.T @ w @ e, P
""",
    ),
    (
        "13-line-step",
        "without a pair it returns zeros as P instead of Q: nothing seen is taken for perfectly sure",
        """
def line_step(source, target, normals, sigma, T, Q):
    if len(source) == 0:
        return np.zeros(3), np.zeros((3, 3))
    Rot, t = T[:2, :2], T[:2, 2]
    e = np.sum(normals * (source @ Rot.T + t - target), axis=1)
    seen = normals @ Rot
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    w = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ w @ J)
    return -P @ J.T @ w @ e, P
""",
    ),
    (
        "13-line-step",
        "only the diagonal of Q is used: correlated errors of odometry are ignored",
        """
def line_step(source, target, normals, sigma, T, Q):
    Rot, t = T[:2, :2], T[:2, 2]
    prior = np.diag(1 / np.diag(Q))
    m = normals @ Rot
    J = np.column_stack([m, source[:, 0] * m[:, 1] - source[:, 1] * m[:, 0]])
    e = np.sum(normals * (carry(T, source) - target), axis=1)
    w = 1 / sigma**2
    P = np.linalg.inv(prior + J.T @ (J * w[:, None]))
    return -P @ (J.T @ (w * e)), P
""",
    ),
    (
        "13-overlap",
        "trimmed ICP from the given guess alone: runs into the wrong valley",
        """
def match(source, target, T):
    return trimmed_icp(source, target, T, 60, 0.6)
""",
    ),
    (
        "13-overlap",
        "many turns are tried, but the best end is chosen by the mean distance of ALL points, also of those without a partner",
        """
def match(source, target, T):
    best, winner = np.inf, T
    for k in range(12):
        start = T.copy()
        start[:2, :2] = turned(2 * np.pi * k / 12)
        end = icp(source, target, start, 15)
        d, _ = nearest(carry(end, source), target)
        if d.mean() < best:
            best, winner = d.mean(), end
    return winner
""",
    ),
    (
        "13-overlap",
        "a few turns near the guess (up to 20 degrees) only, with its shift kept: the guess is up to 90 degrees off",
        """
def match(source, target, T):
    best, winner = -1, T
    for degrees in (-20, -10, 0, 10, 20):
        start = T.copy()
        start[:2, :2] = turned(np.radians(degrees)) @ T[:2, :2]
        end = trimmed_icp(source, target, start, 25, 0.5)
        d, _ = nearest(carry(end, source), target)
        score = np.sum(d < 0.05)
        if score > best:
            best, winner = score, end
    return winner
""",
    ),
    (
        "13-overlap",
        "lays the centroids of both clouds over each other for every turn and keeps the best: half of the points have no partner, so the centroids do not belong together",
        """
def match(source, target, T):
    tree = cKDTree(target)
    best = None
    for angle in np.linspace(0, 2 * np.pi, 72, endpoint=False):
        Rot = turned(angle)
        t = target.mean(axis=0) - Rot @ source.mean(axis=0)
        d, _ = tree.query(source @ Rot.T + t)
        cost = np.median(d)
        if best is None or cost < best[0]:
            best = cost, Rot, t
    out = np.eye(3)
    out[:2, :2], out[:2, 2] = best[1], best[2]
    return out
""",
    ),
]
