"""A second class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "07-two-updates",
        "Joseph's form",
        """
def two_updates(P, H_1, H_2, R):
    found = []
    for H in (H_1, H_2):
        K = np.linalg.solve(H @ P @ H.T + R, H @ P).T
        F = np.eye(7) - K @ H
        P = F @ P @ F.T + K @ R @ K.T
        found.append(P)
    return tuple(found)
""",
    ),
    (
        "07-hearsay",
        "block by block",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    n = len(x)
    rest = np.array([k for k in range(n) if k not in set(int(s) for s in seen)], dtype=int)
    y, Q = np.zeros(n), np.zeros((n, n))
    y[seen], Q[np.ix_(seen, seen)] = x_seen, P_seen
    if len(rest):
        G = np.linalg.solve(P[np.ix_(seen, seen)], P[np.ix_(seen, rest)]).T
        y[rest] = x[rest] + G @ (x_seen - x[seen])
        Q[np.ix_(rest, seen)] = G @ P_seen
        Q[np.ix_(seen, rest)] = (G @ P_seen).T
        Q[np.ix_(rest, rest)] = P[np.ix_(rest, rest)] + G @ (P_seen - P[np.ix_(seen, seen)]) @ G.T
    return y, Q
""",
    ),
    (
        "07-fuse",
        "generalised least squares",
        """
def fuse(a, P_a, b, P_b, P_ab):
    W = np.linalg.inv(np.block([[P_a, P_ab], [P_ab.T, P_b]]))
    M = np.vstack([np.eye(2), np.eye(2)])
    P = np.linalg.inv(M.T @ W @ M)
    return P @ M.T @ W @ np.append(a, b), P
""",
    ),
    (
        "07-corridor",
        "two separate Kalman lines",
        """
def step(x, P, d, q, i, z, r):
    n = len(x)
    m = np.array(x, dtype=float)
    m[0] = m[0] + d
    S = np.array(P, dtype=float)
    S[0, 0] = S[0, 0] + q
    s = S[i, i] - S[i, 0] - S[0, i] + S[0, 0] + r
    k = (S[:, i] - S[:, 0]) / s
    return m + k * (z - (m[i] - m[0])), S - np.outer(k, S[i] - S[0])
""",
    ),
]

WRONG = [
    (
        "07-two-updates",
        "the second from the first P",
        """
def two_updates(P, H_1, H_2, R):
    def up(H):
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
        return P - K @ H @ P
    return up(H_1), up(H_2)
""",
    ),
    (
        "07-two-updates",
        "R once for both",
        """
def two_updates(P, H_1, H_2, R):
    K = P @ H_1.T @ np.linalg.inv(H_1 @ P @ H_1.T + R)
    one = P - K @ H_1 @ P
    K = one @ H_2.T @ np.linalg.inv(H_2 @ one @ H_2.T)
    return one, one - K @ H_2 @ one
""",
    ),
    (
        "07-two-updates",
        "K R Kᵀ instead of K S Kᵀ",
        """
def two_updates(P, H_1, H_2, R):
    out = []
    for H in (H_1, H_2):
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
        P = P - K @ R @ K.T
        out.append(P)
    return out[0], out[1]
""",
    ),
    (
        "07-two-updates",
        "the old block-diagonal is assumed",
        """
def two_updates(P, H_1, H_2, R):
    Q = np.zeros((7, 7))
    for s in (slice(0, 3), slice(3, 5), slice(5, 7)):
        Q[s, s] = P[s, s]
    P = Q
    out = []
    for H in (H_1, H_2):
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        P = P - K @ S @ K.T
        out.append(P)
    return out[0], out[1]
""",
    ),
    (
        "07-two-updates",
        "small numbers rounded off",
        """
def two_updates(P, H_1, H_2, R):
    out = []
    for H in (H_1, H_2):
        S = H @ P @ H.T + R + 1e-9 * np.eye(2)
        K = P @ H.T @ np.linalg.inv(S)
        P = P - K @ S @ K.T
        P[np.abs(P) < 1e-6] = 0
        out.append(P)
    return out[0], out[1]
""",
    ),
    (
        "07-hearsay",
        "the others stay",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    x, P = x.copy(), P.copy()
    x[seen] = x_seen
    P[np.ix_(seen, seen)] = P_seen
    return x, P
""",
    ),
    (
        "07-hearsay",
        "as a Kalman update with R = P_seen",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    H = np.eye(len(x))[seen]
    S = H @ P @ H.T + P_seen
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (x_seen - H @ x), P - K @ S @ K.T
""",
    ),
    (
        "07-hearsay",
        "the seen block sorted",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    seen = np.sort(seen)
    G = P[:, seen] @ np.linalg.inv(P[np.ix_(seen, seen)])
    return x + G @ (x_seen - x[seen]), P - G @ (P[np.ix_(seen, seen)] - P_seen) @ G.T
""",
    ),
    (
        "07-hearsay",
        "by an inverse of P_seen",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    A = P[np.ix_(seen, seen)]
    W = np.linalg.inv(P_seen) - np.linalg.inv(A)
    H = np.eye(len(x))[seen]
    Q = np.linalg.inv(np.linalg.inv(P) + H.T @ W @ H)
    y = Q @ (np.linalg.inv(P) @ x + H.T @ (np.linalg.inv(P_seen) @ x_seen - np.linalg.inv(A) @ x[seen]))
    return y, Q
""",
    ),
    (
        "07-hearsay",
        "cross blocks left as they were",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    rest = np.setdiff1d(np.arange(len(x)), seen)
    G = P[np.ix_(rest, seen)] @ np.linalg.inv(P[np.ix_(seen, seen)])
    y, Q = x.copy(), P.copy()
    y[rest] += G @ (x_seen - x[seen])
    Q[np.ix_(rest, rest)] -= G @ (P[np.ix_(seen, seen)] - P_seen) @ G.T
    y[seen] = x_seen
    Q[np.ix_(seen, seen)] = P_seen
    return y, Q
""",
    ),
    (
        "07-hearsay",
        "sign of the difference of covariances",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    A = P[np.ix_(seen, seen)]
    G = P[:, seen] @ np.linalg.inv(A)
    return x + G @ (x_seen - x[seen]), P - G @ A @ G.T
""",
    ),
    (
        "07-fuse",
        "P_ab twice, not its transpose",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - 2 * P_ab
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "K of the independent case",
        """
def fuse(a, P_a, b, P_b, P_ab):
    K = P_a @ np.linalg.inv(P_a + P_b)
    S = P_a + P_b - P_ab - P_ab.T
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "the innovation's sign of the common part",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b + P_ab + P_ab.T
    K = (P_a + P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "covariance intersection",
        """
def fuse(a, P_a, b, P_b, P_ab):
    A, B = np.linalg.inv(P_a), np.linalg.inv(P_b)
    w = 0.5
    P = np.linalg.inv(w * A + (1 - w) * B)
    return P @ (w * A @ a + (1 - w) * B @ b), P
""",
    ),
    (
        "07-fuse",
        "common part taken off and put back",
        """
def fuse(a, P_a, b, P_b, P_ab):
    A, B = P_a - P_ab, P_b - P_ab
    W = np.linalg.inv(np.linalg.inv(A) + np.linalg.inv(B))
    return W @ (np.linalg.inv(A) @ a + np.linalg.inv(B) @ b), W + P_ab
""",
    ),
    (
        "07-corridor",
        "H with both signs +",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    H = np.zeros(len(x)); H[0] = 1; H[i] = 1
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - (x[i] - x[0])), P - S * np.outer(K, K)
""",
    ),
    (
        "07-corridor",
        "drives after the sight",
        """
def step(x, P, d, q, i, z, r):
    H = np.zeros(len(x)); H[0] = -1; H[i] = 1
    S = H @ P @ H + r
    K = P @ H / S
    x, P = x + K * (z - H @ x), P - S * np.outer(K, K)
    x[0] += d
    P[0, 0] += q
    return x, P
""",
    ),
    (
        "07-corridor",
        "the absolute distance",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    H = np.zeros(len(x)); H[0] = -1; H[i] = 1
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - abs(x[i] - x[0])), P - S * np.outer(K, K)
""",
    ),
    (
        "07-corridor",
        "q times the way",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q * abs(d)
    H = np.zeros(len(x)); H[0] = -1; H[i] = 1
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - H @ x), P - S * np.outer(K, K)
""",
    ),
    (
        "07-corridor",
        "i counts doors only",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    H = np.zeros(len(x)); H[0] = -1; H[min(i + 1, len(x) - 1)] = 1
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - H @ x), P - S * np.outer(K, K)
""",
    ),
    (
        "07-mornings",
        "mean of each door",
        """
def survey(morning, door, z, sigma):
    n = np.bincount(door)
    return np.bincount(door, z) / n, np.diag(sigma**2 / n)
""",
    ),
    (
        "07-mornings",
        "size assumed ten sigma",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning]])
    W = np.zeros((m + n, m + n))
    W[m:, m:] = np.eye(n) / (10 * sigma) ** 2
    C = np.linalg.inv(J.T @ J / sigma**2 + W)
    return (C @ J.T @ z / sigma**2)[:m], C[:m, :m]
""",
    ),
    (
        "07-mornings",
        "the first morning is right",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning][:, 1:]])
    C = np.linalg.inv(J.T @ J) * sigma**2
    return (C @ J.T @ z / sigma**2)[:m], C[:m, :m]
""",
    ),
    (
        "07-mornings",
        "size by the spread of the morning's means",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    first = np.bincount(door, z) / np.bincount(door)
    off = np.bincount(morning, z - first[door]) / np.bincount(morning)
    size2 = max(np.var(off), sigma**2 / 4)
    V = sigma**2 * np.eye(len(z)) + size2 * (morning[:, None] == morning)
    D = np.eye(m)[door]
    W = np.linalg.inv(V)
    P = np.linalg.inv(D.T @ W @ D)
    return P @ D.T @ W @ z, P
""",
    ),
    (
        "07-mornings",
        "mean, with a larger P",
        """
def survey(morning, door, z, sigma):
    n = np.bincount(door)
    p = np.bincount(door, z) / n
    s2 = np.mean((z - p[door]) ** 2)
    return p, np.diag(s2 / n)
""",
    ),
]
