"""A fifth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = []

WRONG = [
    (
        "06-same",
        "j is corrected for its own row shift",
        """
def merge(x, P, i, j):
    H = np.zeros((2, len(x)))
    H[:, 2 * i:2 * i + 2], H[:, 2 * j:2 * j + 2] = np.eye(2), -np.eye(2)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T)
    x, P = x - K @ H @ x, P - K @ H @ P
    d = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, d), np.delete(np.delete(P, d, 0), d, 1)
""",
    ),
    (
        "06-update",
        "K v with v as (range, range)",
        """
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = wrap(z - h(x[:3], x[3 + 2 * j:5 + 2 * j]))
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, (np.eye(len(x)) - K @ H) @ P
""",
    ),
]
