"""A fifth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "07-hearsay",
        "a Kalman update by an invented measurement where it can be, else by the gain",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    E = np.eye(len(x))[list(seen)]
    B = E @ P @ E.T
    G = np.linalg.solve(B, E @ P).T
    L = np.eye(len(x)) - G @ E
    return x + G @ (np.asarray(x_seen) - E @ x), L @ P @ L.T + G @ P_seen @ G.T
""",
    ),
]

WRONG = [
    (
        "07-corridor",
        "sees before it drives",
        """
def step(x, P, d, q, i, z, r):
    H = np.zeros(len(x))
    H[0], H[i] = -1, 1
    s = H @ P @ H + r
    K = P @ H / s
    x, P = x + K * (z - H @ x), P - np.outer(K, K) * s
    x[0] += d
    P[0, 0] += q
    return x, P
""",
    ),
    (
        "07-fuse",
        "x right, P of the better one",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a if np.trace(P_a) < np.trace(P_b) else P_b
""",
    ),
]
