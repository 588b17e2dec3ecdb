"""A sixth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "07-hearsay",
        "sorted: seen first, then moments of x_o = x_o + G (x_s - x_s) + rest",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    n, k = len(x), len(seen)
    others = [i for i in range(n) if i not in set(np.asarray(seen).tolist())]
    order = np.array([*seen, *others], dtype=int)
    Q, y = P[order][:, order], x[order]
    G = np.linalg.solve(Q[:k, :k], Q[:k, k:]).T
    carry = np.vstack([np.eye(k), G])
    rest = np.zeros((n, n))
    rest[k:, k:] = Q[k:, k:] - G @ Q[:k, k:]
    back = np.argsort(order)
    new = y + carry @ (x_seen - y[:k])
    cov = carry @ P_seen @ carry.T + rest
    return new[back], cov[back][:, back]
""",
    ),
    (
        "07-fuse",
        "weighted least squares of four numbers for two unknowns",
        """
def fuse(a, P_a, b, P_b, P_ab):
    joint = np.block([[P_a, P_ab], [P_ab.T, P_b]])
    A = np.vstack([np.eye(2), np.eye(2)])
    W = np.linalg.solve(joint, A)
    P = np.linalg.inv(A.T @ W)
    return P @ W.T @ np.concatenate([a, b]), P
""",
    ),
    (
        "07-mornings",
        "generalised least squares, the variance by maximum likelihood over a grid",
        """
def survey(morning, door, z, sigma):
    A = np.eye(door.max() + 1)[door]
    same = (morning[:, None] == morning[None, :]).astype(float)
    best = None
    for tau in sigma * np.geomspace(0.3, 30, 120):
        V = sigma**2 * np.eye(len(z)) + tau**2 * same
        W = np.linalg.inv(V)
        N = A.T @ W @ A
        p = np.linalg.solve(N, A.T @ W @ z)
        e = z - A @ p
        cost = np.linalg.slogdet(V)[1] + np.linalg.slogdet(N)[1] + e @ W @ e
        if best is None or cost < best[0]:
            best = cost, p, np.linalg.inv(N)
    return best[1], best[2]
""",
    ),
]

WRONG = [
    (
        "07-two-updates",
        "the second gain from the covariance before the first sight",
        """
def two_updates(P, H_1, H_2, R):
    out, prior = [], P
    for H in (H_1, H_2):
        S = H @ prior @ H.T + R
        K = prior @ H.T @ np.linalg.inv(S)
        P = P - K @ S @ K.T
        out.append(P)
    return out[0], out[1]
""",
    ),
    (
        "07-two-updates",
        "both sights in one, with the noise of one spread the wrong way",
        """
def two_updates(P, H_1, H_2, R):
    def update(P, H, R):
        S = H @ P @ H.T + R
        K = np.linalg.solve(S, H @ P).T
        return P - K @ S @ K.T
    return update(P, H_1, R), update(P, np.vstack([H_1, H_2]), np.kron(R, np.eye(2)))
""",
    ),
    (
        "07-hearsay",
        "the others move, and only the rows in sight get a new covariance",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    x, P = x.copy(), P.copy()
    others = np.setdiff1d(np.arange(len(x)), seen)
    G = P[np.ix_(others, seen)] @ np.linalg.inv(P[np.ix_(seen, seen)])
    x[others] += G @ (x_seen - x[seen])
    x[seen] = x_seen
    P[np.ix_(others, seen)] = G @ P_seen
    P[np.ix_(seen, others)] = (G @ P_seen).T
    P[np.ix_(seen, seen)] = P_seen
    return x, P
""",
    ),
    (
        "07-hearsay",
        "x_seen taken for a sighting of x_s with the noise P_seen",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    H = np.zeros((len(seen), len(x)))
    H[np.arange(len(seen)), seen] = 1
    S = H @ P @ H.T + P_seen
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (x_seen - H @ x), P - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "what is shared is taken off, the rests are fused, and it is put back",
        """
def fuse(a, P_a, b, P_b, P_ab):
    common = (P_ab + P_ab.T) / 2
    own_a, own_b = P_a - common, P_b - common
    K = own_a @ np.linalg.inv(own_a + own_b)
    return a + K @ (b - a), own_a - K @ own_a + common
""",
    ),
    (
        "07-fuse",
        "covariance intersection",
        """
def fuse(a, P_a, b, P_b, P_ab):
    best = None
    for w in np.linspace(0, 1, 201):
        P = np.linalg.inv(w * np.linalg.inv(P_a) + (1 - w) * np.linalg.inv(P_b))
        if best is None or np.trace(P) < np.trace(best[1]):
            best = P @ (w * np.linalg.inv(P_a) @ a + (1 - w) * np.linalg.inv(P_b) @ b), P
    return best
""",
    ),
    (
        "07-corridor",
        "the update of robot and door alone",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    part = np.array([0, i])
    small = P[np.ix_(part, part)]
    H = np.array([-1.0, 1.0])
    S = H @ small @ H + r
    K = small @ H / S
    x[part] += K * (z - (x[i] - x[0]))
    P[np.ix_(part, part)] = small - np.outer(K, K) * S
    return x, P
""",
    ),
    (
        "07-mornings",
        "offset of a morning and mean of a door in turn, fifty times, and sigma over the number",
        """
def survey(morning, door, z, sigma):
    off, count = np.zeros(morning.max() + 1), np.bincount(door)
    for _ in range(50):
        p = np.bincount(door, z - off[morning]) / count
        off = np.bincount(morning, z - p[door]) / np.bincount(morning)
    return p, np.diag(sigma**2 / count)
""",
    ),
]
