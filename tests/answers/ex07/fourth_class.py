"""A fourth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "07-two-updates",
        "Joseph's form",
        """
def two_updates(P, H_1, H_2, R):
    out = []
    for H in (H_1, H_2):
        K = np.linalg.solve(H @ P @ H.T + R, H @ P).T
        A = np.eye(7) - K @ H
        P = A @ P @ A.T + K @ R @ K.T
        out.append(P)
    return tuple(out)
""",
    ),
    (
        "07-fuse",
        "generalised least squares of both",
        """
def fuse(a, P_a, b, P_b, P_ab):
    W = np.linalg.inv(np.block([[P_a, P_ab], [P_ab.T, P_b]]))
    E = np.vstack([np.eye(2), np.eye(2)])
    P = np.linalg.inv(E.T @ W @ E)
    return P @ E.T @ W @ np.concatenate([a, b]), P
""",
    ),
]

WRONG = [
    (
        "07-two-updates",
        "the second starts from the first P",
        """
def two_updates(P, H_1, H_2, R):
    def up(H):
        S = H @ P @ H.T + R
        return P - P @ H.T @ np.linalg.inv(S) @ H @ P
    return up(H_1), up(H_2)
""",
    ),
    (
        "07-two-updates",
        "R is forgotten the second time",
        """
def two_updates(P, H_1, H_2, R):
    S = H_1 @ P @ H_1.T + R
    P1 = P - P @ H_1.T @ np.linalg.inv(S) @ H_1 @ P
    S = H_2 @ P1 @ H_2.T
    return P1, P1 - P1 @ H_2.T @ np.linalg.inv(S) @ H_2 @ P1
""",
    ),
    (
        "07-two-updates",
        "only P_both",
        """
def two_updates(P, H_1, H_2, R):
    for H in (H_1, H_2):
        S = H @ P @ H.T + R
        P = P - P @ H.T @ np.linalg.inv(S) @ H @ P
    return P
""",
    ),
    (
        "07-hearsay",
        "the others' covariance is left",
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
        "P is multiplied, its rest forgotten",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    G = P[:, seen] @ np.linalg.inv(P[np.ix_(seen, seen)])
    return x + G @ (x_seen - x[seen]), G @ P_seen @ G.T
""",
    ),
    (
        "07-hearsay",
        "the order of seen is thrown away",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    seen = np.sort(seen)
    A = P[np.ix_(seen, seen)]
    G = P[:, seen] @ np.linalg.inv(A)
    return x + G @ (x_seen - x[seen]), P - G @ (A - P_seen) @ G.T
""",
    ),
    (
        "07-fuse",
        "P_ab is not transposed the second time",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - 2 * P_ab
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "the plain mean by information",
        """
def fuse(a, P_a, b, P_b, P_ab):
    A, B = np.linalg.inv(P_a), np.linalg.inv(P_b)
    P = np.linalg.inv(A + B)
    return P @ (A @ a + B @ b), P
""",
    ),
    (
        "07-fuse",
        "K from b's side",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_b - P_ab.T) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-corridor",
        "q is added to all",
        """
def step(x, P, d, q, i, z, r):
    x = x.copy()
    x[0] += d
    P = P + q
    H = np.zeros(len(x))
    H[0], H[i] = -1, 1
    s = H @ P @ H + r
    K = P @ H / s
    return x + K * (z - (x[i] - x[0])), P - np.outer(K, K) * s
""",
    ),
    (
        "07-corridor",
        "four entries, as in the picture",
        """
def step(x, P, d, q, i, z, r):
    F = np.array([d, 0, 0, 0])
    Q = np.diag([q, 0, 0, 0])
    x, P = x + F, P + Q
    H = np.zeros(4)
    H[0], H[i] = -1, 1
    s = H @ P @ H + r
    K = P @ H / s
    return x + K * (z - (x[i] - x[0])), P - np.outer(K, K) * s
""",
    ),
    (
        "07-corridor",
        "sees door i from 0, so x[i + 1]",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    H = np.zeros(len(x))
    H[0], H[min(i + 1, len(x) - 1)] = -1, 1
    s = H @ P @ H + r
    K = P @ H / s
    return x + K * (z - H @ x), P - np.outer(K, K) * s
""",
    ),
    (
        "07-mornings",
        "the mean of each door",
        """
def survey(morning, door, z, sigma):
    n = np.bincount(door)
    p = np.bincount(door, z) / n
    return p, np.diag(sigma ** 2 / n)
""",
    ),
]
