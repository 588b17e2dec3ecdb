"""A further class of answers, written from the lesson and the exercise's text alone."""

RIGHT = []

WRONG = [
    (
        "07-hearsay",
        "only the entries in sight are put in",
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
        "P not mended outside, x is",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    G = P[:, seen] @ np.linalg.inv(P[np.ix_(seen, seen)])
    new = P.copy()
    new[np.ix_(seen, seen)] = P_seen
    return x + G @ (x_seen - x[seen]), new
""",
    ),
    (
        "07-hearsay",
        "takes x_seen for a measurement with R = P_seen",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    S = P[np.ix_(seen, seen)] + P_seen
    K = P[:, seen] @ np.linalg.inv(S)
    return x + K @ (x_seen - x[seen]), P - K @ S @ K.T
""",
    ),
    (
        "07-hearsay",
        "adds P_seen where it should put it in place",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    G = P[:, seen] @ np.linalg.inv(P[np.ix_(seen, seen)])
    return x + G @ (x_seen - x[seen]), P + G @ P_seen @ G.T
""",
    ),
    (
        "07-hearsay",
        "forgets the rest: P = G P_seen Gᵀ",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    G = P[:, seen] @ np.linalg.inv(P[np.ix_(seen, seen)])
    return x + G @ (x_seen - x[seen]), G @ P_seen @ G.T
""",
    ),
    (
        "07-hearsay",
        "each entry in sight by itself",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    G = P[:, seen] / np.diag(P)[seen]
    D = P[np.ix_(seen, seen)] - P_seen
    return x + G @ (x_seen - x[seen]), P - G @ D @ G.T
""",
    ),
    (
        "07-hearsay",
        "seen is sorted first",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    s = np.sort(seen)
    G = P[:, s] @ np.linalg.inv(P[np.ix_(s, s)])
    return x + G @ (x_seen - x[s]), P - G @ (P[np.ix_(s, s)] - P_seen) @ G.T
""",
    ),
    (
        "07-hearsay",
        "takes the first k entries for those in sight",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    k = len(seen)
    G = P[:, :k] @ np.linalg.inv(P[:k, :k])
    return x + G @ (x_seen - x[:k]), P - G @ (P[:k, :k] - P_seen) @ G.T
""",
    ),
    (
        "07-hearsay",
        "inverts P_seen",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    A = P[np.ix_(seen, seen)]
    W = np.linalg.inv(P_seen) - np.linalg.inv(A)
    V = np.linalg.inv(P)
    V[np.ix_(seen, seen)] += W
    new = np.linalg.inv(V)
    G = P[:, seen] @ np.linalg.inv(A)
    return x + G @ (x_seen - x[seen]), new
""",
    ),
    (
        "07-hearsay",
        "cross-covariances stay",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    A = P[np.ix_(seen, seen)]
    G = P[:, seen] @ np.linalg.inv(A)
    new = P - G @ (A - P_seen) @ G.T
    rest = np.setdiff1d(np.arange(len(x)), seen)
    new[np.ix_(rest, seen)] = P[np.ix_(rest, seen)]
    new[np.ix_(seen, rest)] = P[np.ix_(seen, rest)]
    return x + G @ (x_seen - x[seen]), new
""",
    ),
    (
        "07-fuse",
        "K of the second only",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = P_a @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "P_ab for its transpose in the gain",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab.T) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "twice P_ab",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - 2 * P_ab
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "shared error added",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b + P_ab + P_ab.T
    K = (P_a + P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "covariance intersection, half and half",
        """
def fuse(a, P_a, b, P_b, P_ab):
    A, B = np.linalg.inv(P_a), np.linalg.inv(P_b)
    P = np.linalg.inv((A + B) / 2)
    return P @ (A @ a + B @ b) / 2, P
""",
    ),
    (
        "07-fuse",
        "independent, plus what is shared",
        """
def fuse(a, P_a, b, P_b, P_ab):
    C = (P_ab + P_ab.T) / 2
    A, B = np.linalg.inv(P_a - C), np.linalg.inv(P_b - C)
    P = np.linalg.inv(A + B)
    return P @ (A @ a + B @ b), P + C
""",
    ),
    (
        "07-fuse",
        "right x, P of independent errors",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), np.linalg.inv(np.linalg.inv(P_a) + np.linalg.inv(P_b))
""",
    ),
    (
        "07-fuse",
        "P by (I − K) P_a",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), (np.eye(2) - K) @ P_a
""",
    ),
    (
        "07-fuse",
        "starts at b",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return b + K @ (a - b), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "each coordinate by itself",
        """
def fuse(a, P_a, b, P_b, P_ab):
    va, vb, c = np.diag(P_a), np.diag(P_b), np.diag(P_ab)
    k = (va - c) / (va + vb - 2 * c)
    return a + k * (b - a), np.diag(va - k * (va - c))
""",
    ),
    (
        "07-corridor",
        "robot's variance grows only",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    s = P[0, 0] + P[i, i] + r
    k = (P[:, i] - P[:, 0]) / s
    x = x + k * (z - (x[i] - x[0]))
    return x, P - np.outer(k, k) * s
""",
    ),
    (
        "07-corridor",
        "only robot and door are corrected",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    h = np.zeros(len(x)); h[0], h[i] = -1, 1
    k = P @ h / (h @ P @ h + r)
    k[(np.arange(len(x)) != 0) & (np.arange(len(x)) != i)] = 0
    x = x + k * (z - h @ x)
    return x, (np.eye(len(x)) - np.outer(k, h)) @ P
""",
    ),
    (
        "07-corridor",
        "predicts the distance before the drive",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    v = z - (x[i] - x[0])
    x[0] += d
    P[0, 0] += q
    h = np.zeros(len(x)); h[0], h[i] = -1, 1
    k = P @ h / (h @ P @ h + r)
    return x + k * v, P - np.outer(k, h @ P)
""",
    ),
    (
        "07-corridor",
        "doors get q as well",
        """
def step(x, P, d, q, i, z, r):
    x = x.copy()
    x[0] += d
    P = P + q * np.eye(len(x))
    h = np.zeros(len(x)); h[0], h[i] = -1, 1
    k = P @ h / (h @ P @ h + r)
    return x + k * (z - h @ x), P - np.outer(k, h @ P)
""",
    ),
    (
        "07-corridor",
        "q is taken for a deviation",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q**2
    h = np.zeros(len(x)); h[0], h[i] = -1, 1
    k = P @ h / (h @ P @ h + r**2)
    return x + k * (z - h @ x), P - np.outer(k, h @ P)
""",
    ),
    (
        "07-corridor",
        "sign of h: door behind",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    h = np.zeros(len(x)); h[0], h[i] = 1, -1
    k = P @ h / (h @ P @ h + r)
    return x + k * (z - h @ x), P - np.outer(k, h @ P)
""",
    ),
    (
        "07-corridor",
        "distance has no sign",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    h = np.zeros(len(x)); h[0], h[i] = -1, 1
    k = P @ h / (h @ P @ h + r)
    return x + k * (abs(z) - abs(h @ x)), P - np.outer(k, h @ P)
""",
    ),
    (
        "07-corridor",
        "door is put where it was seen, robot trusted",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    h = np.zeros(len(x)); h[i] = 1
    k = P @ h / (h @ P @ h + r)
    return x + k * (z + x[0] - x[i]), P - np.outer(k, h @ P)
""",
    ),
    (
        "07-corridor",
        "i counted among doors from 0",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    h = np.zeros(len(x)); h[0], h[(i + 1) % len(x)] = -1, 1
    k = P @ h / (h @ P @ h + r)
    return x + k * (z - h @ x), P - np.outer(k, h @ P)
""",
    ),
    (
        "07-corridor",
        "P after with r forgotten",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    h = np.zeros(len(x)); h[0], h[i] = -1, 1
    k = P @ h / (h @ P @ h + r)
    J = np.eye(len(x)) - np.outer(k, h)
    return x + k * (z - h @ x), J @ P @ J.T
""",
    ),
]
