"""Right ways of 13-line-step."""

WAYS = {
    "odometry as three more rows": """
def line_step(source, target, normals, sigma, T, Q):
    e = np.einsum("ki,ki->k", normals, carry(T, source) - target)
    seen = normals @ T[:2, :2]
    J = np.column_stack([seen, np.cross(np.c_[source, 0 * e], np.c_[seen, 0 * e])[:, 2]])
    whitened = np.linalg.inv(np.linalg.cholesky(Q))
    A = np.vstack([J / sigma[:, None], whitened])
    y = np.concatenate([-e / sigma, np.zeros(3)])
    return np.linalg.lstsq(A, y, rcond=None)[0], np.linalg.inv(A.T @ A)
""",
    "pair by pair": """
def line_step(source, target, normals, sigma, T, Q):
    A, y = np.linalg.inv(Q), np.zeros(3)
    for a, b, n, s in zip(source, target, normals, sigma):
        p = T[:2, :2] @ a
        m = T[:2, :2].T @ n
        J = np.array([m[0], m[1], p[0] * n[1] - p[1] * n[0]])
        A += np.outer(J, J) / s**2
        y -= J * (n @ (p + T[:2, 2] - b)) / s**2
    return np.linalg.solve(A, y), np.linalg.inv(A)
""",
    "a Kalman update": """
def line_step(source, target, normals, sigma, T, Q):
    e = np.sum(normals * (carry(T, source) - target), axis=1)
    seen = normals @ T[:2, :2]
    J = np.column_stack([seen, np.sum(seen * source[:, ::-1] * [-1, 1], axis=1)])
    S = J @ Q @ J.T + np.diag(sigma**2)
    K = Q @ J.T @ np.linalg.inv(S)
    I_KJ = np.eye(3) - K @ J
    return -K @ e, I_KJ @ Q @ I_KJ.T + K @ np.diag(sigma**2) @ K.T
""",
    "one update a pair": """
def line_step(source, target, normals, sigma, T, Q):
    delta, P = np.zeros(3), Q.copy()
    for k in range(len(source)):
        seen = T[:2, :2].T @ normals[k]
        J = np.append(seen, seen @ [-source[k, 1], source[k, 0]])
        e = normals[k] @ (carry(T, source[k : k + 1])[0] - target[k]) + J @ delta
        K = P @ J / (J @ P @ J + sigma[k] ** 2)
        delta, P = delta - K * e, P - np.outer(K, J @ P)
    return delta, P
""",
    "finite differences": """
def line_step(source, target, normals, sigma, T, Q):
    def distances(delta):
        c, s = np.cos(delta[2]), np.sin(delta[2])
        D = np.array([[c, -s, delta[0]], [s, c, delta[1]], [0, 0, 1]])
        return np.sum(normals * (carry(T @ D, source) - target), axis=1)

    steps = 1e-5 * np.eye(3)
    J = np.column_stack([(distances(d) - distances(-d)) / 2e-5 for d in steps])
    A = np.linalg.inv(Q) + (J / sigma[:, None] ** 2).T @ J
    delta = np.linalg.solve(A, -J.T @ (distances(np.zeros(3)) / sigma**2))
    return delta.tolist(), np.linalg.inv(A).tolist()
""",
    "in the target's frame first, as the lesson": """
def line_step(source, target, normals, sigma, T, Q):
    G = np.eye(3)
    G[:2, :2] = T[:2, :2]  # a shift as the robot sees it, seen from the target
    moved = carry(T, source)
    arm = moved - T[:2, 2]
    e = np.sum(normals * (moved - target), axis=1) / sigma
    J = np.column_stack([normals, arm[:, 0] * normals[:, 1] - arm[:, 1] * normals[:, 0]])
    J = J / sigma[:, None]
    A = J.T @ J + np.linalg.inv(G @ Q @ G.T)
    step = np.linalg.solve(A, -J.T @ e)
    return (G.T @ step, G.T @ np.linalg.inv(A) @ G)
""",
}

PASTED = {
    "the lesson's step and covariance": """
def line_step(source, target, normals, sigma, T, Q):
    moved = carry(T, source)
    arm = moved - T[:2, 2]
    e = np.sum(normals * (moved - target), axis=1)
    J = np.column_stack([normals, arm[:, 0] * normals[:, 1] - arm[:, 1] * normals[:, 0]])
    P = np.mean(sigma**2) * np.linalg.pinv(J.T @ J) if len(e) else Q
    return np.linalg.lstsq(J, -e, rcond=None)[0], P
""",
    "the best motion of the pairs": """
def line_step(source, target, normals, sigma, T, Q):
    step = np.linalg.inv(T) @ best_motion(source, target) if len(source) > 1 else np.eye(3)
    return pose(step), Q
""",
}
