"""Independent answers to 03-gain: right ones, and students' mistakes."""

RIGHT = [
    (
        "03-gain",
        "solve instead of inv, transposed twice",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    return np.linalg.solve(S.T, H @ P.T).T
""",
    ),
    (
        "03-gain",
        "information form: K = P⁺ Hᵀ R⁻¹",
        """
def gain(P, H, R):
    information = np.linalg.inv(P) + H.T @ np.linalg.inv(R) @ H
    return np.linalg.inv(information) @ H.T @ np.linalg.inv(R)
""",
    ),
    (
        "03-gain",
        "one row of K per state, by least squares",
        """
def gain(P, H, R):
    n, m = P.shape[0], H.shape[0]
    cross = P @ np.transpose(H)
    S = np.dot(H, cross) + R
    K = np.empty((n, m))
    for state in range(n):
        K[state], *_ = np.linalg.lstsq(S, cross[state], rcond=None)
    return K
""",
    ),
]

WRONG = [
    (
        "03-gain",
        "divides by S number by number: right for one measured number only",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    return P @ H.T / S
""",
    ),
    (
        "03-gain",
        "solve without the last transpose: K is (m, n)",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    return np.linalg.solve(S, H @ P)
""",
    ),
    (
        "03-gain",
        "R forgotten in S (pinv hides the trouble)",
        """
def gain(P, H, R):
    PHt = P @ H.T
    return PHt @ np.linalg.pinv(H @ PHt)
""",
    ),
    (
        "03-gain",
        "takes R for a standard deviation and squares it",
        """
def gain(P, H, R):
    noise = R @ R
    return P @ H.T @ np.linalg.inv(H @ P @ H.T + noise)
""",
    ),
    (
        "03-gain",
        "information form with the old P instead of the new one",
        """
def gain(P, H, R):
    return P @ H.T @ np.linalg.inv(R)
""",
    ),
    (
        "03-gain",
        "only the diagonal of S: measured numbers taken as unrelated",
        """
def gain(P, H, R):
    PHt = P @ H.T
    variances = np.array([h @ P @ h + R[i, i] for i, h in enumerate(H)])
    return PHt / variances
""",
    ),
    (
        "03-gain",
        "information form with a hard-coded size of two states",
        """
def gain(P, H, R):
    W = np.linalg.inv(R)
    A = np.linalg.inv(np.eye(2) + P @ H.T @ W @ H)
    return A @ P @ H.T @ W
""",
    ),
    (
        "03-gain",
        "one measured number: returns (n,) instead of (n, 1)",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return K.squeeze()
""",
    ),
    (
        "03-gain",
        "adds to R in place: the caller's R is spoiled",
        """
def gain(P, H, R):
    R += H @ P @ H.T
    return np.linalg.solve(R, H @ P).T
""",
    ),
    (
        "03-gain",
        "only the states that are measured are corrected",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    seen = np.any(H != 0, axis=0)
    K = K * seen[:, None]
    return K
""",
    ),
    (
        "03-gain",
        "weighs in the state's space: P (P + HᵀRH)⁻¹ Hᵀ, R carried back by Hᵀ instead of an inverse",
        """
def gain(P, H, R):
    my_doubt, all_doubt = P, P + H.T @ R @ H
    return my_doubt @ np.linalg.inv(all_doubt) @ H.T
""",
    ),
    (
        "03-gain",
        "one measured number after the other, but each with the P from before",
        """
def gain(P, H, R):
    columns = []
    for i in range(H.shape[0]):
        h = H[i]
        columns.append(P @ h / (h @ P @ h + R[i, i]))
    return np.column_stack(columns) / H.shape[0]
""",
    ),
    (
        "03-gain",
        "gradient descent that stops much too early",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    K = np.zeros((len(P), len(H)))
    rate = 0.5 / np.trace(S)
    for _ in range(20):
        K = K - rate * 2 * (K @ S - P @ H.T)
    return K
""",
    ),
    (
        "03-gain",
        "brings the measurement back with pinv(H): wrong where H does not see all states",
        """
def gain(P, H, R):
    seen = H @ P @ H.T
    share = seen @ np.linalg.inv(seen + R)   # my doubt / all doubt
    return np.linalg.pinv(H) @ share
""",
    ),
]
