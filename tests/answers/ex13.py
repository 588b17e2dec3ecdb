"""Independent answers to exercise 13: right ones, and students' mistakes."""

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
    (
        "13-icp",
        "moves the cloud along and multiplies the motions up",
        """
def icp(source, target, T, rounds):
    total = np.array(T, dtype=float)
    cloud = carry(total, source)
    for _ in range(rounds):
        rows = nearest(cloud, target)[1]
        move = best_motion(cloud, target[rows])
        cloud = carry(move, cloud)
        total = move @ total
    return total
""",
    ),
    (
        "13-icp",
        "fits the source itself, not what was moved",
        """
def icp(source, target, T, rounds):
    T = T.copy()
    tree = cKDTree(target)
    k = 0
    while k < rounds:
        partners = tree.query(source @ T[:2, :2].T + T[:2, 2])[1]
        T = best_motion(source, target[partners])
        k += 1
    return T
""",
    ),
    (
        "13-trimmed",
        "argpartition, source fitted itself",
        """
def trimmed_icp(source, target, T, rounds, share):
    T = np.array(T, float)
    keep = int(np.floor(share * len(source)))
    for _ in range(rounds):
        d, rows = nearest(carry(T, source), target)
        best = np.argpartition(d, keep - 1)[:keep]
        T = best_motion(source[best], target[rows[best]])
    return T
""",
    ),
    (
        "13-trimmed",
        "sorted list of pairs, rounded up",
        """
def trimmed_icp(source, target, T, rounds, share):
    count = min(len(source), int(np.ceil(share * len(source) - 1e-9)))
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        pairs = sorted(zip(d, range(len(d)), rows))[:count]
        i = np.array([pair[1] for pair in pairs])
        j = np.array([pair[2] for pair in pairs])
        T = best_motion(moved[i], target[j]) @ T
    return T
""",
    ),
    (
        "13-line-step",
        "loop over the pairs, information form",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    quarter = np.array([[0.0, -1.0], [1.0, 0.0]])
    info, y = np.linalg.inv(Q), np.zeros(3)
    for a, b, n, s in zip(source, target, normals, sigma):
        r = n @ (R @ a + t - b)
        J = np.append(n @ R, n @ R @ quarter @ a)
        info = info + np.outer(J, J) / s**2
        y = y - J * r / s**2
    P = np.linalg.inv(info)
    return P @ y, P
""",
    ),
    (
        "13-line-step",
        "Kalman form with the innovation's covariance",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    Q = np.asarray(Q, dtype=float)
    arm = source @ R.T
    r = ((arm + t - target) * normals).sum(axis=1)
    seen = normals @ R
    J = np.c_[seen, arm[:, 0] * normals[:, 1] - arm[:, 1] * normals[:, 0]]
    S = J @ Q @ J.T + np.diag(np.asarray(sigma, float) ** 2)
    K = np.linalg.solve(S, J @ Q).T
    P = Q - K @ J @ Q
    return -K @ r, (P + P.T) / 2
""",
    ),
    (
        "13-overlap",
        "starts from many turns, votes for the shift, trimmed ICP, counts close pairs",
        """
def match(source, target, T):
    tree = cKDTree(target)
    n = normals_of(target)
    found = []
    for angle in np.radians(np.arange(0, 360, 8)):
        R = turned(angle)
        shifts = (target[None, :, :] - (source[::2] @ R.T)[:, None, :]).reshape(-1, 2)
        H, ex, ey = np.histogram2d(shifts[:, 0], shifts[:, 1], bins=(60, 60), range=((-9, 9), (-9, 9)))
        i, j = np.unravel_index(np.argmax(H), H.shape)
        found.append((H[i, j], angle, (ex[i] + ex[i + 1]) / 2, (ey[j] + ey[j + 1]) / 2))
    found.sort(reverse=True)

    def refine(R, t, gates):
        for gate in gates:
            moved = source @ R.T + t
            d, rows = tree.query(moved)
            ok = d < gate
            if ok.sum() < 6:
                break
            m, q, nn = moved[ok], target[rows[ok]], n[rows[ok]]
            arm = m - t
            r = np.sum(nn * (m - q), axis=1)
            J = np.c_[nn, arm[:, 0] * nn[:, 1] - arm[:, 1] * nn[:, 0]]
            delta = np.linalg.solve(J.T @ J + 1e-3 * np.eye(3), -J.T @ r)
            R, t = turned(delta[2]) @ R, t + delta[:2]
        return R, t

    best = None
    for votes, angle, x, y in found[:10]:
        R, t = refine(turned(angle), np.array([x, y]), (0.6, 0.5, 0.4, 0.3, 0.25, 0.2))
        good = np.sum(tree.query(source @ R.T + t)[0] < 0.1)
        if best is None or good > best[0]:
            best = good, R, t
    R, t = refine(best[1], best[2], [0.15] * 3 + [0.1] * 8)
    out = np.eye(3)
    out[:2, :2], out[:2, 2] = R, t
    return out
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
    (
        "13-icp",
        "composes on the wrong side",
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
        "partners are sought once",
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
        "seeks from where the source was, not from where it lies now",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        _, rows = nearest(source, target)
        T = best_motion(source, target[rows])
    return T
""",
    ),
    (
        "13-icp",
        "returns the last step only",
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
        "13-icp",
        "one round too many",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds + 1):
        moved = carry(T, source)
        T = best_motion(moved, target[nearest(moved, target)[1]]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "stops early when little changes",
        """
def icp(source, target, T, rounds):
    last = np.inf
    for _ in range(rounds):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        if abs(last - distances.mean()) < 1e-3:
            break
        last = distances.mean()
        T = best_motion(moved, target[rows]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "nearest source point for each target point",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        moved = carry(T, source)
        _, rows = nearest(target, moved)
        T = best_motion(moved[rows], target) @ T
    return T
""",
    ),
    (
        "13-icp",
        "pairs by row, cut to the shorter cloud",
        """
def icp(source, target, T, rounds):
    n = min(len(source), len(target))
    for _ in range(rounds):
        moved = carry(T, source)
        T = best_motion(moved[:n], target[:n]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "the first guess is ignored",
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
        "13-icp",
        "changes the guess in place",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        moved = carry(T, source)
        _, rows = nearest(moved, target)
        T[:] = best_motion(moved, target[rows]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "no target point twice: the other pairs are dropped",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        _, first = np.unique(rows, return_index=True)
        if len(first) < 2:
            break
        T = best_motion(moved[first], target[rows[first]]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "fits the raw source, but adds it to T all the same",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        _, rows = nearest(carry(T, source), target)
        T = best_motion(source, target[rows]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "no rounds: T is never set",
        """
def icp(source, target, T, rounds):
    moved = carry(T, source)
    for _ in range(rounds):
        _, rows = nearest(moved, target)
        result = best_motion(source, target[rows])
        moved = carry(result, source)
    return result
""",
    ),
    (
        "13-trimmed",
        "keeps the longest pairs",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        kept = np.argsort(d)[::-1][:keep]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "drops the share instead of keeping it",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = max(int((1 - share) * len(source)), 2)
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        kept = np.argsort(d)[:keep]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "partners by the source's row numbers",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        kept = np.argsort(d)[:keep]
        T = best_motion(moved[kept], target[rows][:keep]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "sorted once, before the first round",
        """
def trimmed_icp(source, target, T, rounds, share):
    d, _ = nearest(carry(T, source), target)
    kept = np.argsort(d)[: int(share * len(source))]
    for _ in range(rounds):
        moved = carry(T, source[kept])
        _, rows = nearest(moved, target)
        T = best_motion(moved, target[rows]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "trims what is left again in each round",
        """
def trimmed_icp(source, target, T, rounds, share):
    left = source
    for _ in range(rounds):
        moved = carry(T, left)
        d, rows = nearest(moved, target)
        kept = np.argsort(d)[: max(2, int(share * len(left)))]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
        left = left[kept]
    return T
""",
    ),
    (
        "13-trimmed",
        "share of the target's points",
        """
def trimmed_icp(source, target, T, rounds, share):
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        kept = np.argsort(d)[: int(share * len(target))]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "share of the longest distance as a gate",
        """
def trimmed_icp(source, target, T, rounds, share):
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        near = d <= share * d.max()
        if near.sum() < 2:
            near[:] = True
        T = best_motion(moved[near], target[rows[near]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "the first points of the cloud instead of the shortest pairs",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        T = best_motion(moved[:keep], target[rows[:keep]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "forgets to trim: share is not used",
        """
def trimmed_icp(source, target, T, rounds, share):
    return icp(source, target, T, rounds)
""",
    ),
    (
        "13-trimmed",
        "one pair too few: off by one",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = max(int(share * len(source)) - 1, 2)
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        order = np.argsort(d)
        T = best_motion(moved[order[:keep]], target[rows[order[:keep]]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "sorts the distances apart from the rows",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        kept = np.sort(rows)[:keep]
        order = np.argsort(d)[:keep]
        T = best_motion(moved[order], target[kept]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "distances of the untouched source decide",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    d0, _ = nearest(source, target)
    for _ in range(rounds):
        moved = carry(T, source)
        _, rows = nearest(moved, target)
        kept = np.argsort(d0)[:keep]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "composes on the wrong side",
        """
def trimmed_icp(source, target, T, rounds, share):
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        kept = np.argpartition(d, int(share * len(d)) - 1)[: int(share * len(d))]
        T = T @ best_motion(moved[kept], target[rows[kept]])
    return T
""",
    ),
    (
        "13-line-step",
        "the lesson's step: in the target's frame",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    arm = source @ R.T
    r = np.sum(normals * (arm + t - target), axis=1)
    J = np.column_stack([normals, arm[:, 0] * normals[:, 1] - arm[:, 1] * normals[:, 0]])
    W = 1 / sigma**2
    P = np.linalg.inv(np.linalg.inv(Q) + (J.T * W) @ J)
    return -P @ (J.T * W) @ r, P
""",
    ),
    (
        "13-line-step",
        "lever with the wrong sign",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 1] * seen[:, 0] - source[:, 0] * seen[:, 1]])
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ W @ J)
    return -P @ J.T @ W @ r, P
""",
    ),
    (
        "13-line-step",
        "lever about the target's origin: t is in it",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    moved = source @ R.T + t
    r = np.einsum("ij,ij->i", normals, moved - target)
    lever = moved[:, 0] * normals[:, 1] - moved[:, 1] * normals[:, 0]
    J = np.column_stack([normals @ R, lever])
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ W @ J)
    return -P @ J.T @ W @ r, P
""",
    ),
    (
        "13-line-step",
        "normals turned the wrong way (R transposed)",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R.T
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ W @ J)
    return -P @ J.T @ W @ r, P
""",
    ),
    (
        "13-line-step",
        "weighs by 1/sigma",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    info, rhs = np.linalg.inv(Q), np.zeros(3)
    for a, b, n, s in zip(source, target, normals, sigma):
        m = R.T @ n
        J = np.array([m[0], m[1], a[0] * m[1] - a[1] * m[0]])
        info = info + np.outer(J, J) / s
        rhs = rhs - J * (n @ (R @ a + t - b)) / s
    P = np.linalg.inv(info)
    return P @ rhs, P
""",
    ),
    (
        "13-line-step",
        "all pairs alike: sigma not used",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ J)
    return -P @ J.T @ r, P
""",
    ),
    (
        "13-line-step",
        "odometry left out: singular in a corridor, or with no pair",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1) / sigma
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    J = J / sigma[:, None]
    P = np.linalg.pinv(J.T @ J)
    return -P @ J.T @ r, P
""",
    ),
    (
        "13-line-step",
        "adds Q, not its inverse",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    W = np.diag(sigma**-2.0)
    A = Q + J.T @ W @ J
    return np.linalg.solve(A, -J.T @ W @ r), np.linalg.inv(A)
""",
    ),
    (
        "13-line-step",
        "step in the direction that makes it worse",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ W @ J)
    return P @ J.T @ W @ r, P
""",
    ),
    (
        "13-line-step",
        "correlations of Q are dropped",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.diag(1 / np.diag(Q)) + J.T @ W @ J)
    return -P @ J.T @ W @ r, P
""",
    ),
    (
        "13-line-step",
        "no pair: says zero and certain",
        """
def line_step(source, target, normals, sigma, T, Q):
    if len(source) == 0:
        return np.zeros(3), np.zeros((3, 3))
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ W @ J)
    return -P @ J.T @ W @ r, P
""",
    ),
    (
        "13-line-step",
        "stacks rows in a list: breaks without pairs",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    rows, res = [], []
    for a, b, n, s in zip(source, target, normals, sigma):
        m = n @ R
        rows.append(np.array([m[0], m[1], a[0] * m[1] - a[1] * m[0]]) / s)
        res.append(n @ (R @ a + t - b) / s)
    J, r = np.vstack(rows), np.array(res)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ J)
    return -P @ J.T @ r, P
""",
    ),
    (
        "13-line-step",
        "P scaled by how well the points fit",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ W @ J)
    delta = -P @ J.T @ W @ r
    left = r + J @ delta
    return delta, P * (left @ W @ left) / max(len(r) - 3, 1)
""",
    ),
    (
        "13-line-step",
        "jacobian in an array of the normals' type",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    J = np.empty((len(source), 3), dtype=normals.dtype)
    J[:, :2] = normals @ R
    J[:, 2] = source[:, 0] * J[:, 1] - source[:, 1] * J[:, 0]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ W @ J)
    return -P @ J.T @ W @ r, P
""",
    ),
    (
        "13-line-step",
        "P knows the walls only",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    W = np.diag(1 / sigma**2)
    delta = -np.linalg.solve(np.linalg.inv(Q) + J.T @ W @ J, J.T @ W @ r)
    return delta, np.linalg.pinv(J.T @ W @ J)
""",
    ),
    (
        "13-overlap",
        "trimmed ICP from the guess",
        """
def match(source, target, T):
    return trimmed_icp(source, target, T, 60, 0.6)
""",
    ),
    (
        "13-overlap",
        "returns the guess",
        """
def match(source, target, T):
    return T
""",
    ),
    (
        "13-overlap",
        "many turns; the best has the smallest mean distance of all pairs",
        """
def match(source, target, T):
    best, best_score = T, np.inf
    for angle in np.radians(np.arange(0, 360, 30)):
        S = np.eye(3)
        S[:2, :2] = turned(angle)
        S[:2, 2] = T[:2, 2]
        S = icp(source, target, S, 25)
        score = nearest(carry(S, source), target)[0].mean()
        if score < best_score:
            best, best_score = S, score
    return best
""",
    ),
    (
        "13-overlap",
        "plain ICP, more rounds",
        """
def match(source, target, T):
    return icp(source, target, T, 300)
""",
    ),
    (
        "13-overlap",
        "centroids over each other, then ICP",
        """
def match(source, target, T):
    S = T.copy()
    S[:2, 2] = target.mean(axis=0) - S[:2, :2] @ source.mean(axis=0)
    return trimmed_icp(source, target, S, 80, 0.7)
""",
    ),
    (
        "13-overlap",
        "beam k pairs with beam k",
        """
def match(source, target, T):
    n = min(len(source), len(target))
    return best_motion(source[:n], target[:n])
""",
    ),
    (
        "13-overlap",
        "many turns; the best is where few pairs lie very near (share 0.1)",
        """
def match(source, target, T):
    best, best_score = T, np.inf
    for angle in np.radians(np.arange(-180, 180, 45)):
        S = T.copy()
        S[:2, :2] = turned(angle)
        S = trimmed_icp(source, target, S, 20, 0.1)
        d = np.sort(nearest(carry(S, source), target)[0])
        score = d[: len(d) // 10].mean()
        if score < best_score:
            best, best_score = S, score
    return best
""",
    ),
    (
        "13-overlap",
        "vote for the shift, but with the guess's turn",
        """
def match(source, target, T):
    R = T[:2, :2]
    shifts = (target[:, None] - source @ R.T).reshape(-1, 2)
    cells, votes = np.unique(np.floor(shifts / 0.3), axis=0, return_counts=True)
    S = T.copy()
    S[:2, 2] = (cells[np.argmax(votes)] + 0.5) * 0.3
    return trimmed_icp(source, target, S, 60, 0.5)
""",
    ),
    (
        "13-overlap",
        "changes the guess in place",
        """
def match(source, target, T):
    for share in (0.9, 0.7, 0.5):
        T[:] = trimmed_icp(source, target, T, 20, share)
    return T
""",
    ),
    (
        "13-overlap",
        "a hundred random starts with long ICPs: far too slow",
        """
def match(source, target, T):
    rng, best, most = np.random.default_rng(0), T, -1
    for _ in range(150):
        S = np.eye(3)
        S[:2, :2] = turned(rng.uniform(-np.pi, np.pi))
        S[:2, 2] = T[:2, 2] + rng.uniform(-1.2, 1.2, 2)
        S = trimmed_icp(source, target, S, 60, 0.6)
        good = np.sum(nearest(carry(S, source), target)[0] < 0.05)
        if good > most:
            best, most = S, good
    return best
""",
    ),
    (
        "13-overlap",
        "best of the voted turns, but the inverse motion is returned",
        """
def match(source, target, T):
    best = (-1, None, None)
    for angle in np.radians(np.arange(0, 360, 6)):
        R = turned(angle)
        shifts = (target[:, None] - source[::2] @ R.T).reshape(-1, 2)
        H, ex, ey = np.histogram2d(*shifts.T, bins=60, range=((-9, 9), (-9, 9)))
        i, j = np.unravel_index(H.argmax(), H.shape)
        if H[i, j] > best[0]:
            best = (H[i, j], R, np.array([ex[i] + 0.15, ey[j] + 0.15]))
    S = np.eye(3)
    S[:2, :2], S[:2, 2] = best[1], best[2]
    return np.linalg.inv(trimmed_icp(source, target, S, 40, 0.5))
""",
    ),
    (
        "13-overlap",
        "main directions of the clouds over each other",
        """
def match(source, target, T):
    def frame(c):
        w, v = np.linalg.eigh(np.cov(c.T))
        v = v[:, ::-1]
        if np.linalg.det(v) < 0:
            v[:, 1] *= -1
        return v
    R = frame(target) @ frame(source).T
    S = np.eye(3)
    S[:2, :2], S[:2, 2] = R, target.mean(axis=0) - R @ source.mean(axis=0)
    return icp(source, target, S, 40)
""",
    ),
]
