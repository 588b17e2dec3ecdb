"""Independent answers to 06-same: right ones, and students' mistakes."""

RIGHT = [
    (
        "06-same",
        "least squares over the smaller state, x = T y, weighted by P",
        """
def merge(x, P, i, j):
    n = len(x)
    keep = [k for k in range(n) if k not in (3 + 2 * j, 4 + 2 * j)]
    T = np.zeros((n, n - 2))
    for col, k in enumerate(keep):
        T[k, col] = 1
        if k in (3 + 2 * i, 4 + 2 * i):
            T[k - 3 - 2 * i + 3 + 2 * j, col] = 1
    L = np.linalg.cholesky(P)
    A, b = np.linalg.solve(L, T), np.linalg.solve(L, x)
    Q, U = np.linalg.qr(A)
    U_inv = np.linalg.inv(U)
    return U_inv @ (Q.T @ b), U_inv @ U_inv.T
""",
    ),
    (
        "06-same",
        "condition on the difference, blocks by index",
        """
def merge(x, P, i, j):
    a, b = np.array([3, 4]) + 2 * i, np.array([3, 4]) + 2 * j
    cross = P[:, a] - P[:, b]              # cov(state, p_i - p_j)
    S = cross[a] - cross[b]
    gain = np.linalg.solve(S, cross.T).T
    mean = x - gain @ (x[a] - x[b])
    cov = P - gain @ cross.T
    left = np.setdiff1d(np.arange(len(x)), b)
    return mean[left], cov[np.ix_(left, left)]
""",
    ),
]

WRONG = [
    (
        "06-same",
        "the middle of the two, the rest struck out",
        """
def merge(x, P, i, j):
    x = x.copy()
    pi, pj = slice(3 + 2 * i, 5 + 2 * i), slice(3 + 2 * j, 5 + 2 * j)
    x[pi] = (x[pi] + x[pj]) / 2
    gone = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, gone), np.delete(np.delete(P, gone, 0), gone, 1)
""",
    ),
    (
        "06-same",
        "landmark j is just struck out",
        """
def merge(x, P, i, j):
    keep = np.ones(len(x), dtype=bool)
    keep[3 + 2 * j:5 + 2 * j] = False
    return x[keep], P[keep][:, keep]
""",
    ),
    (
        "06-same",
        "fused as if independent, by their own variances",
        """
def merge(x, P, i, j):
    a, b = slice(3 + 2 * i, 5 + 2 * i), slice(3 + 2 * j, 5 + 2 * j)
    Ia, Ib = np.linalg.inv(P[a, a]), np.linalg.inv(P[b, b])
    x, P = x.copy(), P.copy()
    P[a, a] = np.linalg.inv(Ia + Ib)
    x[a] = P[a, a] @ (Ia @ x[a] + Ib @ x[b])
    keep = [k for k in range(len(x)) if not 3 + 2 * j <= k < 5 + 2 * j]
    return x[keep], P[np.ix_(keep, keep)]
""",
    ),
    (
        "06-same",
        "correlated fusion of i, nobody else learns",
        """
def merge(x, P, i, j):
    a, b = slice(3 + 2 * i, 5 + 2 * i), slice(3 + 2 * j, 5 + 2 * j)
    S = P[a, a] + P[b, b] - P[a, b] - P[b, a]
    K = (P[a, a] - P[a, b]) @ np.linalg.inv(S)
    x, P = x.copy(), P.copy()
    x[a] = x[a] - K @ (x[a] - x[b])
    P[a, a] = P[a, a] - K @ S @ K.T
    gone = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, gone), np.delete(np.delete(P, gone, 0), gone, 1)
""",
    ),
    (
        "06-same",
        "robot and bystanders get no gain",
        """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    for k in range(2):
        D[k, 3 + 2 * i + k], D[k, 3 + 2 * j + k] = 1, -1
    S = D @ P @ D.T
    K = P @ D.T @ np.linalg.inv(S)
    K[:3] = 0                              # nobody has measured anything from the robot
    x, P = x - K @ D @ x, P - K @ S @ K.T
    keep = [k for k in range(len(x)) if k not in (3 + 2 * j, 4 + 2 * j)]
    return x[keep], P[np.ix_(keep, keep)]
""",
    ),
    (
        "06-same",
        "removes i instead of j",
        """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    D[:, 3 + 2 * i : 5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j : 5 + 2 * j] = -np.eye(2)
    S = D @ P @ D.T
    K = P @ D.T @ np.linalg.inv(S)
    x, P = x - K @ D @ x, P - K @ S @ K.T
    gone = [3 + 2 * i, 4 + 2 * i]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)
""",
    ),
    (
        "06-same",
        "always keeps the earlier one",
        """
def merge(x, P, i, j):
    i, j = min(i, j), max(i, j)
    a, b = 3 + 2 * i, 3 + 2 * j
    D = np.zeros((2, len(x)))
    D[[0, 1], [a, a + 1]] = 1
    D[[0, 1], [b, b + 1]] = -1
    K = P @ D.T @ np.linalg.inv(D @ P @ D.T)
    x, P = x - K @ (D @ x), (np.eye(len(x)) - K @ D) @ P
    keep = np.r_[0:b, b + 2:len(x)]
    return x[keep], P[np.ix_(keep, keep)]
""",
    ),
    (
        "06-same",
        "the difference is added instead of taken away",
        """
def merge(x, P, i, j):
    E = np.eye(len(x))
    D = E[3 + 2 * i:5 + 2 * i] - E[3 + 2 * j:5 + 2 * j]
    S = D @ P @ D.T
    K = np.linalg.solve(S, D @ P).T
    x, P = x + K @ D @ x, P - K @ S @ K.T
    gone = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)
""",
    ),
    (
        "06-same",
        "with a noise of 3 cm, so that S is not singular",
        """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    D[:, 3 + 2 * i:5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j:5 + 2 * j] = -np.eye(2)
    S = D @ P @ D.T + 0.03**2 * np.eye(2)
    K = P @ D.T @ np.linalg.inv(S)
    v = np.zeros(2) - D @ x
    x, P = x + K @ v, P - K @ S @ K.T
    gone = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)
""",
    ),
    (
        "06-same",
        "deletes one after the other, indices moved meanwhile",
        """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    D[:, 3 + 2 * i:5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j:5 + 2 * j] = -np.eye(2)
    S = D @ P @ D.T
    K = P @ D.T @ np.linalg.inv(S)
    x, P = x - K @ D @ x, P - K @ S @ K.T
    for k in (3 + 2 * j, 4 + 2 * j):
        k = min(k, len(x) - 1)
        x = np.delete(x, k)
        P = np.delete(np.delete(P, k, 0), k, 1)
    return x, P
""",
    ),
    (
        "06-same",
        "strikes j out first, then finds i at its old number",
        """
def merge(x, P, i, j):
    xj = x[3 + 2 * j:5 + 2 * j]
    Pj = P[3 + 2 * j:5 + 2 * j, 3 + 2 * j:5 + 2 * j]
    gone = [3 + 2 * j, 4 + 2 * j]
    cross = np.delete(P[gone], gone, axis=1)
    x, P = np.delete(x, gone), np.delete(np.delete(P, gone, 0), gone, 1)
    H = np.zeros((2, len(x)))
    its = slice(3 + 2 * i, 5 + 2 * i)
    H[:, its] = np.eye(2)
    C = P @ H.T - cross.T
    S = H @ P @ H.T + Pj - H @ cross.T - cross @ H.T
    K = C @ np.linalg.inv(S)
    return x - K @ (H @ x - xj), P - K @ S @ K.T
""",
    ),
    (
        "06-same",
        "merged landmark goes to the end",
        """
def merge(x, P, i, j):
    n = len(x)
    D = np.zeros((2, n))
    D[:, 3 + 2 * i:5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j:5 + 2 * j] = -np.eye(2)
    S = D @ P @ D.T
    K = P @ D.T @ np.linalg.inv(S)
    x, P = x - K @ D @ x, P - K @ S @ K.T
    both = {3 + 2 * i, 4 + 2 * i, 3 + 2 * j, 4 + 2 * j}
    order = [k for k in range(n) if k not in both] + [3 + 2 * i, 4 + 2 * i]
    return x[order], P[np.ix_(order, order)]
""",
    ),
    (
        "06-same",
        "x is moved, P only struck out",
        """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    D[:, 3 + 2 * i:5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j:5 + 2 * j] = -np.eye(2)
    x = x - P @ D.T @ np.linalg.solve(D @ P @ D.T, D @ x)
    left = np.delete(np.arange(len(x)), [3 + 2 * j, 4 + 2 * j])
    return x[left], P[np.ix_(left, left)]
""",
    ),
    (
        "06-same",
        "robot's three numbers forgotten in the indices",
        """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    D[:, 2 * i:2 * i + 2] = np.eye(2)
    D[:, 2 * j:2 * j + 2] = -np.eye(2)
    S = D @ P @ D.T
    K = P @ D.T @ np.linalg.inv(S)
    x, P = x - K @ D @ x, P - K @ S @ K.T
    gone = [2 * j, 2 * j + 1]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)
""",
    ),
    (
        "06-same",
        "the correction is made in the caller's arrays",
        """
def merge(x, P, i, j):
    a, b = np.arange(2) + 3 + 2 * i, np.arange(2) + 3 + 2 * j
    C = P[:, a] - P[:, b]
    S = C[a] - C[b]
    K = C @ np.linalg.inv(S)
    x -= K @ (x[a] - x[b])
    P -= K @ S @ K.T
    left = np.setdiff1d(np.arange(len(x)), b)
    return x[left], P[np.ix_(left, left)]
""",
    ),
    (
        "06-same",
        "pulled together in x, then in y, with the old P both times",
        """
def merge(x, P, i, j):
    dx, less = np.zeros(len(x)), np.zeros_like(P)
    for k in range(2):
        d = np.zeros(len(x))
        d[3 + 2 * i + k], d[3 + 2 * j + k] = 1, -1
        s = d @ P @ d
        gain = P @ d / s
        dx -= gain * (d @ x)
        less += np.outer(gain, gain) * s
    x, P = x + dx, P - less
    gone = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)
""",
    ),
    (
        "06-same",
        "only the distance is made zero (linearised range)",
        """
def merge(x, P, i, j):
    a, b = slice(3 + 2 * i, 5 + 2 * i), slice(3 + 2 * j, 5 + 2 * j)
    d = x[a] - x[b]
    r = np.hypot(*d)
    H = np.zeros((1, len(x)))
    H[0, a], H[0, b] = d / r, -d / r
    S = H @ P @ H.T
    K = P @ H.T / S
    x, P = x + K @ [0 - r], P - K @ S @ K.T
    gone = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)
""",
    ),
]
