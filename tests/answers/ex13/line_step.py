"""Independent answers to 13-line-step: right ones, and students' mistakes."""

RIGHT = [
    (
        "13-line-step",
        "loop over the pairs, information form",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    quarter = np.array([[0.0, -1.0], [1.0, 0.0]])
    info, y = np.linalg.inv(Q), np.zeros(3)
    for a, b, n, s in zip(source, target, normals, sigma):
        r = n @ (R @ a + t - b)
        J = np.append(n @ R, n @ R @ quarter @ a)
        info = info + np.outer(J, J) / s**2
        y = y - J * r / s**2
    P = np.linalg.inv(info)
    return P @ y, P
""",
    ),
    (
        "13-line-step",
        "Kalman form with the innovation's covariance",
        """
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
""",
    ),
]

WRONG = [
    (
        "13-line-step",
        "the lesson's step: in the target's frame",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    arm = source @ R.T
    r = np.sum(normals * (arm + t - target), axis=1)
    J = np.column_stack([normals, arm[:, 0] * normals[:, 1] - arm[:, 1] * normals[:, 0]])
    W = 1 / sigma**2
    P = np.linalg.inv(np.linalg.inv(Q) + (J.T * W) @ J)
    return -P @ (J.T * W) @ r, P
""",
    ),
    (
        "13-line-step",
        "lever with the wrong sign",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 1] * seen[:, 0] - source[:, 0] * seen[:, 1]])
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ W @ J)
    return -P @ J.T @ W @ r, P
""",
    ),
    (
        "13-line-step",
        "lever about the target's origin: t is in it",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    moved = source @ R.T + t
    r = np.einsum("ij,ij->i", normals, moved - target)
    lever = moved[:, 0] * normals[:, 1] - moved[:, 1] * normals[:, 0]
    J = np.column_stack([normals @ R, lever])
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ W @ J)
    return -P @ J.T @ W @ r, P
""",
    ),
    (
        "13-line-step",
        "normals turned the wrong way (R transposed)",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R.T
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ W @ J)
    return -P @ J.T @ W @ r, P
""",
    ),
    (
        "13-line-step",
        "weighs by 1/sigma",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    info, rhs = np.linalg.inv(Q), np.zeros(3)
    for a, b, n, s in zip(source, target, normals, sigma):
        m = R.T @ n
        J = np.array([m[0], m[1], a[0] * m[1] - a[1] * m[0]])
        info = info + np.outer(J, J) / s
        rhs = rhs - J * (n @ (R @ a + t - b)) / s
    P = np.linalg.inv(info)
    return P @ rhs, P
""",
    ),
    (
        "13-line-step",
        "all pairs alike: sigma not used",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ J)
    return -P @ J.T @ r, P
""",
    ),
    (
        "13-line-step",
        "odometry left out: singular in a corridor, or with no pair",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1) / sigma
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    J = J / sigma[:, None]
    P = np.linalg.pinv(J.T @ J)
    return -P @ J.T @ r, P
""",
    ),
    (
        "13-line-step",
        "adds Q, not its inverse",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    W = np.diag(sigma**-2.0)
    A = Q + J.T @ W @ J
    return np.linalg.solve(A, -J.T @ W @ r), np.linalg.inv(A)
""",
    ),
    (
        "13-line-step",
        "step in the direction that makes it worse",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ W @ J)
    return P @ J.T @ W @ r, P
""",
    ),
    (
        "13-line-step",
        "correlations of Q are dropped",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.diag(1 / np.diag(Q)) + J.T @ W @ J)
    return -P @ J.T @ W @ r, P
""",
    ),
    (
        "13-line-step",
        "no pair: says zero and certain",
        """
def line_step(source, target, normals, sigma, T, Q):
    if len(source) == 0:
        return np.zeros(3), np.zeros((3, 3))
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ W @ J)
    return -P @ J.T @ W @ r, P
""",
    ),
    (
        "13-line-step",
        "stacks rows in a list: breaks without pairs",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    rows, res = [], []
    for a, b, n, s in zip(source, target, normals, sigma):
        m = n @ R
        rows.append(np.array([m[0], m[1], a[0] * m[1] - a[1] * m[0]]) / s)
        res.append(n @ (R @ a + t - b) / s)
    J, r = np.vstack(rows), np.array(res)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ J)
    return -P @ J.T @ r, P
""",
    ),
    (
        "13-line-step",
        "P scaled by how well the points fit",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ W @ J)
    delta = -P @ J.T @ W @ r
    left = r + J @ delta
    return delta, P * (left @ W @ left) / max(len(r) - 3, 1)
""",
    ),
    (
        "13-line-step",
        "jacobian in an array of the normals' type",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    J = np.empty((len(source), 3), dtype=normals.dtype)
    J[:, :2] = normals @ R
    J[:, 2] = source[:, 0] * J[:, 1] - source[:, 1] * J[:, 0]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    W = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ W @ J)
    return -P @ J.T @ W @ r, P
""",
    ),
    (
        "13-line-step",
        "P knows the walls only",
        """
def line_step(source, target, normals, sigma, T, Q):
    R, t = T[:2, :2], T[:2, 2]
    r = np.sum(normals * (source @ R.T + t - target), axis=1)
    seen = normals @ R
    J = np.column_stack([seen, source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]])
    W = np.diag(1 / sigma**2)
    delta = -np.linalg.solve(np.linalg.inv(Q) + J.T @ W @ J, J.T @ W @ r)
    return delta, np.linalg.pinv(J.T @ W @ J)
""",
    ),
]
