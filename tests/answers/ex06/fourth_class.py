"""A fourth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "06-augment",
        "one Jacobian of the whole new state",
        """
def augment(x, P, z, R):
    n = len(x)
    G = np.vstack([np.eye(n), np.hstack([J_xr(x[:3], z), np.zeros((2, n - 3))])])
    B = np.zeros((n + 2, 2))
    B[n:] = J_z(x[:3], z)
    return np.concatenate([x, g(x[:3], z)]), G @ P @ G.T + B @ R @ B.T
""",
    ),
    (
        "06-same",
        "the information of a certain difference, by an orthogonal projection",
        """
def merge(x, P, i, j):
    n = len(x)
    H = np.zeros((2, n))
    H[:, 3 + 2 * i:5 + 2 * i] = np.eye(2)
    H[:, 3 + 2 * j:5 + 2 * j] -= np.eye(2)
    K = np.linalg.solve(H @ P @ H.T, H @ P).T
    A = np.eye(n) - K @ H
    x, P = A @ x, A @ P @ A.T
    keep = [k for k in range(n) if k not in (3 + 2 * j, 4 + 2 * j)]
    return x[keep], P[np.ix_(keep, keep)]
""",
    ),
]

WRONG = [
    (
        "06-augment",
        "cross terms with the robot only",
        """
def augment(x, P, z, R):
    n = len(x)
    A, B = J_xr(x[:3], z), J_z(x[:3], z)
    Q = np.zeros((n + 2, n + 2))
    Q[:n, :n] = P
    Q[n:, n:] = A @ P[:3, :3] @ A.T + B @ R @ B.T
    Q[n:, :3] = A @ P[:3, :3]
    Q[:3, n:] = Q[n:, :3].T
    return np.append(x, g(x[:3], z)), Q
""",
    ),
    (
        "06-augment",
        "for a map of two landmarks: sizes fixed at seven",
        """
def augment(x, P, z, R):
    A, B = J_xr(x[:3], z), J_z(x[:3], z)
    Q = np.zeros((7, 7))
    n = len(x)
    Q[:n, :n] = P
    Q[n:, n:] = A @ P[:3, :3] @ A.T + B @ R @ B.T
    Q[n:, :n] = A @ P[:3]
    Q[:n, n:] = Q[n:, :n].T
    return np.append(x, g(x[:3], z)), Q
""",
    ),
    (
        "06-augment",
        "the landmark in front of the pose",
        """
def augment(x, P, z, R):
    n = len(x)
    A, B = J_xr(x[:3], z), J_z(x[:3], z)
    Q = np.block([[P, P[:, :3] @ A.T], [A @ P[:3], A @ P[:3, :3] @ A.T + B @ R @ B.T]])
    order = [n, n + 1, *range(n)]
    return np.append(x, g(x[:3], z))[order], Q[np.ix_(order, order)]
""",
    ),
    (
        "06-update",
        "wrap forgotten",
        """
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "06-update",
        "only the robot and this landmark are corrected",
        """
def update(x, P, z, j, R):
    its = [0, 1, 2, 3 + 2 * j, 4 + 2 * j]
    H = H_full(x, j)
    v = z - h(x[:3], x[its[3:]])
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    x, Q = x.copy(), P.copy()
    x[its] += (K @ v)[its]
    Q[np.ix_(its, its)] -= (K @ S @ K.T)[np.ix_(its, its)]
    return x, Q
""",
    ),
    (
        "06-update",
        "landmark counted from 1",
        """
def update(x, P, z, j, R):
    H = H_full(x, j - 1)
    v = z - h(x[:3], x[1 + 2 * j:3 + 2 * j])
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "06-slam",
        "new landmarks are put in and updated at once",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    ids = list(ids)
    x, P = predict(x, P, u, C)
    for i, sight in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, sight, R)
            ids.append(i)
        x, P = update(x, P, sight, ids.index(i), R)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "the id is taken for the place in the state",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    ids = list(ids)
    x, P = predict(x, P, u, C)
    for i, sight in zip(seen, z):
        if i in ids:
            x, P = update(x, P, sight, i, R)
        else:
            x, P = augment(x, P, sight, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "ids in place",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, sight in zip(seen, z):
        if i in ids:
            x, P = update(x, P, sight, ids.index(i), R)
        else:
            x, P = augment(x, P, sight, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "drives after it has seen",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    ids = list(ids)
    for i, sight in zip(seen, z):
        if i in ids:
            x, P = update(x, P, sight, ids.index(i), R)
        else:
            x, P = augment(x, P, sight, R)
            ids.append(i)
    x, P = predict(x, P, u, C)
    return x, P, ids
""",
    ),
    (
        "06-same",
        "the mean of both, and the smaller covariance",
        """
def merge(x, P, i, j):
    a, b = slice(3 + 2 * i, 5 + 2 * i), slice(3 + 2 * j, 5 + 2 * j)
    x = x.copy()
    x[a] = (x[a] + x[b]) / 2
    keep = [k for k in range(len(x)) if k not in range(3 + 2 * j, 5 + 2 * j)]
    return x[keep], P[np.ix_(keep, keep)]
""",
    ),
    (
        "06-same",
        "P is corrected after the rows are gone",
        """
def merge(x, P, i, j):
    H = np.zeros((2, len(x)))
    H[:, 3 + 2 * i:5 + 2 * i] = np.eye(2)
    H[:, 3 + 2 * j:5 + 2 * j] = -np.eye(2)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T)
    x = x + K @ (H @ x)
    P = P - K @ H @ P
    return np.delete(x, [3 + 2 * j, 4 + 2 * j]), np.delete(np.delete(P, [3 + 2 * j, 4 + 2 * j], 0), [3 + 2 * j, 4 + 2 * j], 1)
""",
    ),
    (
        "06-same",
        "deletes landmark i",
        """
def merge(x, P, i, j):
    H = np.zeros((2, len(x)))
    H[:, 3 + 2 * i:5 + 2 * i] = np.eye(2)
    H[:, 3 + 2 * j:5 + 2 * j] = -np.eye(2)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T)
    x, P = x - K @ (H @ x), P - K @ H @ P
    d = [3 + 2 * i, 4 + 2 * i]
    return np.delete(x, d), np.delete(np.delete(P, d, 0), d, 1)
""",
    ),
    (
        "06-false-sights",
        "gates by 3 m of range only",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    ids = list(ids)
    x, P = predict(x, P, u, C)
    for i, sight in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            if abs(sight[0] - h(x[:3], x[3 + 2 * j:5 + 2 * j])[0]) < 3:
                x, P = update(x, P, sight, j, R)
        else:
            x, P = augment(x, P, sight, R)
            ids.append(i)
    return x, P, ids
""",
    ),
]
