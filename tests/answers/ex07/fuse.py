"""Independent answers to 07-fuse: right ones, and students' mistakes."""

RIGHT = [
    (
        "07-fuse",
        "weighted least squares on the stacked pair",
        """
def fuse(a, P_a, b, P_b, P_ab):
    joint = np.block([[P_a, P_ab], [P_ab.T, P_b]])
    A = np.vstack([np.eye(2), np.eye(2)])
    N = A.T @ np.linalg.solve(joint, A)
    P = np.linalg.inv(N)
    return P @ A.T @ np.linalg.solve(joint, np.concatenate([a, b])), P
""",
    ),
    (
        "07-fuse",
        "weights of a and b, covariance by propagation",
        """
def fuse(a, P_a, b, P_b, P_ab):
    D = P_a + P_b - (P_ab + P_ab.T)
    W_b = np.linalg.solve(D.T, (P_a - P_ab).T).T
    W_a = np.eye(2) - W_b
    x = W_a @ a + W_b @ b
    cross = W_a @ P_ab @ W_b.T
    P = W_a @ P_a @ W_a.T + W_b @ P_b @ W_b.T + cross + cross.T
    return x, P
""",
    ),
]

WRONG = [
    (
        "07-fuse",
        "P_ab ignored (information filter)",
        """
def fuse(a, P_a, b, P_b, P_ab):
    Y_a, Y_b = np.linalg.inv(P_a), np.linalg.inv(P_b)
    P = np.linalg.inv(Y_a + Y_b)
    return P @ (Y_a @ a + Y_b @ b), P
""",
    ),
    (
        "07-fuse",
        "2 P_ab instead of P_ab + P_ab'",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - 2 * P_ab
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "P_ab transposed in the gain",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a - P_ab - P_ab.T + P_b
    S_xv = P_a - P_ab.T
    K = np.linalg.solve(S, S_xv.T).T
    return a + K @ (b - a), P_a - S_xv @ np.linalg.solve(S, S_xv.T)
""",
    ),
    (
        "07-fuse",
        "shared error adds to S",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b + P_ab + P_ab.T
    K = (P_a + P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "gain P_a S^-1 although the innovation shares b's error",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = P_a @ np.linalg.inv(S)
    P = P_a - K @ S @ K.T
    return a + K @ (b - a), (P + P.T) / 2
""",
    ),
    (
        "07-fuse",
        "covariance (I - K) P_a, true only if nothing is shared",
        """
def fuse(a, P_a, b, P_b, P_ab):
    innovation = b - a
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ innovation, (np.eye(2) - K) @ P_a
""",
    ),
    (
        "07-fuse",
        "covariance intersection: careful, but not the best",
        """
def fuse(a, P_a, b, P_b, P_ab):
    A, B = np.linalg.inv(P_a), np.linalg.inv(P_b)
    best = None
    for w in np.linspace(0, 1, 101):
        P = np.linalg.inv(w * A + (1 - w) * B)
        if best is None or np.trace(P) < np.trace(best[1]):
            best = P @ (w * A @ a + (1 - w) * B @ b), P
    return best
""",
    ),
    (
        "07-fuse",
        "common part taken off and put back: needs P_ab symmetric",
        """
def fuse(a, P_a, b, P_b, P_ab):
    common = (P_ab + P_ab.T) / 2
    U, V = P_a - common, P_b - common
    K = U @ np.linalg.inv(U + V)
    return a + K @ (b - a), common + U - K @ U
""",
    ),
    (
        "07-fuse",
        "x and y fused one by one, off-diagonals ignored",
        """
def fuse(a, P_a, b, P_b, P_ab):
    x, P = np.zeros(2), np.zeros((2, 2))
    for j in range(2):
        s = P_a[j, j] + P_b[j, j] - 2 * P_ab[j, j]
        k = (P_a[j, j] - P_ab[j, j]) / s
        x[j] = a[j] + k * (b[j] - a[j])
        P[j, j] = P_a[j, j] - k * s * k
    return x, P
""",
    ),
    (
        "07-fuse",
        "innovation the wrong way round",
        """
def fuse(a, P_a, b, P_b, P_ab):
    v = a - b
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ v, P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "plain mean with its honest covariance",
        """
def fuse(a, P_a, b, P_b, P_ab):
    return (a + b) / 2, (P_a + P_b + P_ab + P_ab.T) / 4
""",
    ),
    (
        "07-fuse",
        "gain clipped to 0..1: an estimate must lie between a and b",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = np.clip((P_a - P_ab) @ np.linalg.inv(S), 0, 1)
    I = np.eye(2)
    P = (I-K) @ P_a @ (I-K).T + K @ P_b @ K.T + (I-K) @ P_ab @ K.T + K @ P_ab.T @ (I-K).T
    return a + K @ (b - a), P
""",
    ),
    (
        "07-fuse",
        "joint matrix with P_ab in both corners, not transposed",
        """
def fuse(a, P_a, b, P_b, P_ab):
    C = np.vstack([np.hstack([P_a, P_ab]), np.hstack([P_ab, P_b])])
    W = np.linalg.inv(C)
    A = np.tile(np.eye(2), (2, 1))
    P = np.linalg.inv(A.T @ W @ A)
    return P @ A.T @ W @ np.hstack([a, b]), P
""",
    ),
    (
        "07-fuse",
        "returns the information matrix, not the covariance",
        """
def fuse(a, P_a, b, P_b, P_ab):
    W = np.linalg.inv(np.block([[P_a, P_ab], [P_ab.T, P_b]]))
    A = np.vstack([np.eye(2)] * 2)
    Y = A.T @ W @ A
    return np.linalg.solve(Y, A.T @ W @ np.r_[a, b]), Y
""",
    ),
    (
        "07-fuse",
        "changes P_a in place",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    P_a -= K @ S @ K.T
    return a + K @ (b - a), P_a
""",
    ),
    (
        "07-fuse",
        "errors in opposite directions treated as sharing nothing",
        """
def fuse(a, P_a, b, P_b, P_ab):
    if np.trace(P_ab) < 0:
        P_ab = np.zeros((2, 2))
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
""",
    ),
    (
        "07-fuse",
        "best x, but the P of the filter without P_ab",
        """
def fuse(a, P_a, b, P_b, P_ab):
    S = P_a + P_b - P_ab - P_ab.T
    x = a + (P_a - P_ab) @ np.linalg.solve(S, b - a)
    P = np.linalg.inv(np.linalg.inv(P_a) + np.linalg.inv(P_b))
    return x, P
""",
    ),
    (
        "07-fuse",
        "scalar weights from the traces",
        """
def fuse(a, P_a, b, P_b, P_ab):
    t_a, t_b, t_ab = np.trace(P_a), np.trace(P_b), np.trace(P_ab)
    k = (t_a - t_ab) / (t_a + t_b - 2 * t_ab)
    P = (1 - k)**2 * P_a + k**2 * P_b + k * (1 - k) * (P_ab + P_ab.T)
    return (1 - k) * a + k * b, P
""",
    ),
]
