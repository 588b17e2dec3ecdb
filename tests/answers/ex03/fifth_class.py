"""A fifth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "03-filter",
        "arrays filled, Joseph's form inside",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    n, k = len(x), len(zs)
    xs, Ps = np.empty((k, n)), np.empty((k, n, n))
    for t in range(k):
        x = F @ x
        P = F @ P @ F.T + Q
        G = np.linalg.solve((H @ P @ H.T + R).T, (P @ H.T).T).T
        A = np.eye(n) - G @ H
        x, P = x + G @ (zs[t] - H @ x), A @ P @ A.T + G @ R @ G.T
        xs[t], Ps[t] = x, P
    return xs, Ps
""",
    ),
]

WRONG = [
    (
        "03-update",
        "S from R only",
        """
def update(x, P, z, H, R):
    K = P @ H.T @ np.linalg.inv(R)
    return x + K @ (z - H @ x), P - K @ H @ P
""",
    ),
    (
        "03-capacitor",
        "columns of F for rows",
        """
def capacitor(dt, ohms, farads, sigma):
    a = np.exp(-dt / (ohms * farads))
    b = np.array([1 - a, 1])
    return np.array([[a, 0], [1 - a, 1]]), sigma ** 2 * dt * np.outer(b, b), np.array([[1, 0], [-1, 1]]) / [[1], [ohms]]
""",
    ),
]
