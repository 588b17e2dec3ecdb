# %% way: odometry as three more rows
def line_step(source, target, normals, sigma, T, Q):
    e = np.einsum("ki,ki->k", normals, carry(T, source) - target)
    seen = normals @ T[:2, :2]
    J = np.column_stack([seen, np.cross(np.c_[source, 0 * e], np.c_[seen, 0 * e])[:, 2]])
    whitened = np.linalg.inv(np.linalg.cholesky(Q))
    A = np.vstack([J / sigma[:, None], whitened])
    y = np.concatenate([-e / sigma, np.zeros(3)])
    return np.linalg.lstsq(A, y, rcond=None)[0], np.linalg.inv(A.T @ A)

# %% way: pair by pair
def line_step(source, target, normals, sigma, T, Q):
    A, y = np.linalg.inv(Q), np.zeros(3)
    for a, b, n, s in zip(source, target, normals, sigma):
        p = T[:2, :2] @ a
        m = T[:2, :2].T @ n
        J = np.array([m[0], m[1], p[0] * n[1] - p[1] * n[0]])
        A += np.outer(J, J) / s**2
        y -= J * (n @ (p + T[:2, 2] - b)) / s**2
    return np.linalg.solve(A, y), np.linalg.inv(A)

# %% way: a Kalman update
def line_step(source, target, normals, sigma, T, Q):
    e = np.sum(normals * (carry(T, source) - target), axis=1)
    seen = normals @ T[:2, :2]
    J = np.column_stack([seen, np.sum(seen * source[:, ::-1] * [-1, 1], axis=1)])
    S = J @ Q @ J.T + np.diag(sigma**2)
    K = Q @ J.T @ np.linalg.inv(S)
    I_KJ = np.eye(3) - K @ J
    return -K @ e, I_KJ @ Q @ I_KJ.T + K @ np.diag(sigma**2) @ K.T

# %% way: one update a pair
def line_step(source, target, normals, sigma, T, Q):
    delta, P = np.zeros(3), Q.copy()
    for k in range(len(source)):
        seen = T[:2, :2].T @ normals[k]
        J = np.append(seen, seen @ [-source[k, 1], source[k, 0]])
        e = normals[k] @ (carry(T, source[k : k + 1])[0] - target[k]) + J @ delta
        K = P @ J / (J @ P @ J + sigma[k] ** 2)
        delta, P = delta - K * e, P - np.outer(K, J @ P)
    return delta, P

# %% way: in the target's frame first, as the lesson
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

# %% pasted: the lesson's step and covariance
def line_step(source, target, normals, sigma, T, Q):
    moved = carry(T, source)
    arm = moved - T[:2, 2]
    e = np.sum(normals * (moved - target), axis=1)
    J = np.column_stack([normals, arm[:, 0] * normals[:, 1] - arm[:, 1] * normals[:, 0]])
    P = np.mean(sigma**2) * np.linalg.pinv(J.T @ J) if len(e) else Q
    return np.linalg.lstsq(J, -e, rcond=None)[0], P

# %% pasted: the best motion of the pairs
def line_step(source, target, normals, sigma, T, Q):
    step = np.linalg.inv(T) @ best_motion(source, target) if len(source) > 1 else np.eye(3)
    return pose(step), Q

# %% right: lstsq of whitened rows
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    L = np.linalg.cholesky(np.linalg.inv(Q)).T
    rows, right = [], []
    for a, b, n, s in zip(source, target, normals, sigma):
        m = R.T @ n
        rows.append(np.array([m[0], m[1], m[1] * a[0] - m[0] * a[1]]) / s)
        right.append(-(n @ (R @ a + t - b)) / s)
    A = np.vstack([*rows, L])
    y = np.array([*right, 0, 0, 0])
    return np.linalg.lstsq(A, y, rcond=None)[0], np.linalg.inv(A.T @ A)

# %% right: Kalman form with the innovation's covariance
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    Q = np.asarray(Q, dtype=float)
    arm = source @ R.T
    r = ((arm + t - target) * normals).sum(axis=1)
    seen = normals @ R
    J = np.c_[seen, arm[:, 0] * normals[:, 1] - arm[:, 1] * normals[:, 0]]
    S = J @ Q @ J.T + np.diag(np.asarray(sigma, float) ** 2)
    K = np.linalg.solve(S, J @ Q).T
    P = Q - K @ J @ Q
    return -K @ r, (P + P.T) / 2

# %% right: a Kalman update for one wall after the other
def line_step(source, target, normals, sigma, T, Q):
    delta, P = np.zeros(3), np.array(Q, dtype=float)
    for a, b, n, s in zip(source, target, normals, sigma):
        e = n @ (T[:2, :2] @ a + T[:2, 2] - b)
        m = T[:2, :2].T @ n
        J = np.array([m[0], m[1], m @ [-a[1], a[0]]])
        S = J @ P @ J + s**2
        K = P @ J / S
        delta = delta - K * (e + J @ delta)
        P = P - np.outer(K, K) * S
    return delta, P

# %% wrong: central differences with exact steps of a power of two
def line_step(source, target, normals, sigma, T, Q):
    R = T[:2, :2]
    def e(d):
        c, s = np.cos(d[2]), np.sin(d[2])
        D = np.array([[c, -s], [s, c]])
        return np.sum(normals * ((source @ D.T + d[:2]) @ R.T), axis=1)
    h = 2.0**-17
    J = np.array([(e(d) - e(-d)) / (2 * h) for d in h * np.eye(3)]).T
    P = np.linalg.inv(np.linalg.inv(Q) + (J.T / sigma**2) @ J)
    r = np.sum(normals * ((source @ R.T) + (T[:2, 2] - target)), axis=1)
    return -P @ (J.T @ (r / sigma**2)), P

# %% wrong: five Gauss-Newton steps in a loop, T moved in between, the last δ returned
def line_step(source, target, normals, sigma, T, Q):
    for _ in range(5):
        Rot, t = T[:2, :2], T[:2, 2]
        e = np.sum(normals * (source @ Rot.T + t - target), axis=1)
        m = normals @ Rot
        J = np.column_stack([m, source[:, 0] * m[:, 1] - source[:, 1] * m[:, 0]])
        P = np.linalg.inv(np.linalg.inv(Q) + J.T @ (J / sigma[:, None] ** 2))
        delta = -P @ J.T @ (e / sigma**2)
        D = np.eye(3)
        D[:2, :2], D[:2, 2] = turned(delta[2]), delta[:2]
        T = T @ D
    return delta, P

# %% wrong: T inverted
def line_step(source, target, normals, sigma, T, Q):
    M = np.linalg.inv(T)
    R, t = M[:2, :2], M[:2, 2]
    e = np.sum(normals * (source @ R.T + t - target), axis=1)
    m = normals @ R
    J = np.column_stack([m, m[:, 1] * source[:, 0] - m[:, 0] * source[:, 1]])
    W = np.diag(1 / sigma ** 2)
    P = np.linalg.inv(J.T @ W @ J + np.linalg.inv(Q))
    return -P @ J.T @ W @ e, P

# %% wrong: jacobian in an array of the normals' type
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    J = np.empty((len(source), 3), dtype=normals.dtype)
    J[:, :2] = normals @ R
    J[:, 2] = source[:, 0] * J[:, 1] - source[:, 1] * J[:, 0]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ W @ J)
    return -P @ J.T @ W @ r, P
