"""A second class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "06-augment",
        "by a large Jacobian",
        """
def augment(x, P, z, R):
    n = len(x)
    G = np.zeros((n + 2, n + 2))
    G[:n, :n] = np.eye(n)
    G[n:, :3] = J_xr(x[:3], z)
    G[n:, n:] = J_z(x[:3], z)
    big = np.zeros((n + 2, n + 2))
    big[:n, :n] = P
    big[n:, n:] = R
    return np.concatenate([x, g(x[:3], z)]), G @ big @ G.T
""",
    ),
    (
        "06-update",
        "information form",
        """
def update(x, P, z, j, R):
    H = H_full(x, j)
    d = z - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
    d = np.array([d[0], (d[1] + np.pi) % (2 * np.pi) - np.pi])
    W = np.linalg.inv(R)
    after = np.linalg.inv(np.linalg.inv(P) + H.T @ W @ H)
    return x + after @ H.T @ W @ d, after
""",
    ),
    (
        "06-same",
        "as a difference variable that is conditioned on",
        """
def merge(x, P, i, j):
    n = len(x)
    T = np.eye(n)
    T[3 + 2 * j, 3 + 2 * i] = T[4 + 2 * j, 4 + 2 * i] = -1
    y, Q = T @ x, T @ P @ T.T
    d = [3 + 2 * j, 4 + 2 * j]
    o = [k for k in range(n) if k not in d]
    G = np.linalg.solve(Q[np.ix_(d, d)], Q[np.ix_(d, o)]).T
    return y[o] - G @ y[d], Q[np.ix_(o, o)] - G @ Q[np.ix_(d, o)]
""",
    ),
]

WRONG = [
    (
        "06-false-sights",
        "half a metre as a gate",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            if abs(one[0] - h(x[:3], x[3 + 2 * j : 5 + 2 * j])[0]) < 0.5:
                x, P = update(x, P, one, j, R)
        else:
            x, P = augment(x, P, one, R)
            ids = ids + [i]
    return x, P, ids
""",
    ),
    (
        "06-augment",
        "no correlation with the old map",
        """
def augment(x, P, z, R):
    n = len(x)
    A, B = J_xr(x[:3], z), J_z(x[:3], z)
    Q = np.zeros((n + 2, n + 2))
    Q[:n, :n] = P
    Q[n:, :3] = A @ P[:3, :3]
    Q[:3, n:] = Q[n:, :3].T
    Q[n:, n:] = A @ P[:3, :3] @ A.T + B @ R @ B.T
    return np.append(x, g(x[:3], z)), Q
""",
    ),
    (
        "06-augment",
        "only rows, not columns",
        """
def augment(x, P, z, R):
    n = len(x)
    A, B = J_xr(x[:3], z), J_z(x[:3], z)
    Q = np.zeros((n + 2, n + 2))
    Q[:n, :n] = P
    Q[n:, :n] = A @ P[:3]
    Q[n:, n:] = A @ P[:3, :3] @ A.T + B @ R @ B.T
    return np.append(x, g(x[:3], z)), Q
""",
    ),
    (
        "06-augment",
        "R as noise in metres",
        """
def augment(x, P, z, R):
    A = J_xr(x[:3], z)
    row = A @ P[:3]
    return np.append(x, g(x[:3], z)), np.block([[P, row.T], [row, A @ P[:3, :3] @ A.T + R]])
""",
    ),
    (
        "06-augment",
        "map of landmarks needed",
        """
def augment(x, P, z, R):
    A, B = J_xr(x[:3], z), J_z(x[:3], z)
    cross = np.vstack([A @ P[:3, k : k + 1] for k in range(0, 0)]) if len(x) == 3 else A @ P[:3]
    row = cross if len(x) > 3 else A @ P
    new = A @ P[:3, :3] @ A.T + B @ R @ B.T
    new = new + 1e-3 * np.eye(2)
    return np.append(x, g(x[:3], z)), np.block([[P, row.T], [row, new]])
""",
    ),
    (
        "06-augment",
        "landmark in front of the list",
        """
def augment(x, P, z, R):
    A, B = J_xr(x[:3], z), J_z(x[:3], z)
    row = A @ P[:3]
    n = len(x)
    Q = np.block([[P, row.T], [row, A @ P[:3, :3] @ A.T + B @ R @ B.T]])
    y = np.append(x, g(x[:3], z))
    order = [0, 1, 2, n, n + 1, *range(3, n)]
    return y[order], Q[np.ix_(order, order)]
""",
    ),
    (
        "06-update",
        "innovation not wrapped",
        """
def update(x, P, z, j, R):
    H = H_full(x, j)
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    x = x + K @ (z - h(x[:3], x[2 * j + 3 : 2 * j + 5]))
    x[2] = wrap(x[2])
    return x, (np.eye(len(x)) - K @ H) @ P
""",
    ),
    (
        "06-update",
        "only robot and the seen landmark",
        """
def update(x, P, z, j, R):
    a = 3 + 2 * j
    H = H_full(x, j)
    v = z - h(x[:3], x[a : a + 2])
    v[1] = wrap(v[1])
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    for k in range(3, len(x)):
        if k not in (a, a + 1):
            K[k] = 0
    F = np.eye(len(x)) - K @ H
    return x + K @ v, F @ P @ F.T + K @ R @ K.T
""",
    ),
    (
        "06-update",
        "P from the new x",
        """
def update(x, P, z, j, R):
    a = 3 + 2 * j
    H = H_full(x, j)
    v = z - h(x[:3], x[a : a + 2])
    v[1] = wrap(v[1])
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    x = x + K @ v
    H = H_full(x, j)
    return x, (np.eye(len(x)) - K @ H) @ P
""",
    ),
    (
        "06-update",
        "in place",
        """
def update(x, P, z, j, R):
    a = 3 + 2 * j
    H = H_full(x, j)
    v = z - h(x[:3], x[a : a + 2])
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    x += K @ v
    P -= K @ S @ K.T
    return x, P
""",
    ),
    (
        "06-update",
        "iterated twice with the same sight",
        """
def update(x, P, z, j, R):
    a = 3 + 2 * j
    for _ in range(2):
        H = H_full(x, j)
        v = z - h(x[:3], x[a : a + 2])
        v[1] = wrap(v[1])
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        x, P = x + K @ v, P - K @ S @ K.T
    return x, P
""",
    ),
    (
        "06-update",
        "v = h − z",
        """
def update(x, P, z, j, R):
    a = 3 + 2 * j
    H = H_full(x, j)
    v = h(x[:3], x[a : a + 2]) - z
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "06-update",
        "S without R in the gain only",
        """
def update(x, P, z, j, R):
    a = 3 + 2 * j
    H = H_full(x, j)
    v = z - h(x[:3], x[a : a + 2])
    v[1] = wrap(v[1])
    S = H @ P @ H.T
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ (S + R) @ K.T
""",
    ),
    (
        "06-slam",
        "augments before it predicts",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    ids = list(ids)
    new = [k for k, i in enumerate(seen) if i not in ids]
    for k in new:
        x, P = augment(x, P, z[k], R)
        ids.append(seen[k])
    x, P = predict(x, P, u, C)
    for k, i in enumerate(seen):
        if k not in new:
            x, P = update(x, P, z[k], ids.index(i), R)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "a new landmark is also updated",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
        x, P = update(x, P, one, ids.index(i), R)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "ids is changed",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            ids.append(i)
            x, P = augment(x, P, one, R)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "the id as the index",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, min(i, len(ids) - 1), R)
        else:
            x, P = augment(x, P, one, R)
            ids = ids + [i]
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "predicts only when something is seen",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    if len(seen) == 0:
        x = x.copy()
        x[:3] = f_odometry(x[:3], u)
        return x, P, ids
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids = ids + [i]
    return x, P, ids
""",
    ),
    (
        "06-same",
        "the middle of both",
        """
def merge(x, P, i, j):
    a, b = 3 + 2 * i, 3 + 2 * j
    x, P = x.copy(), P.copy()
    x[a : a + 2] = (x[a : a + 2] + x[b : b + 2]) / 2
    keep = [k for k in range(len(x)) if k not in (b, b + 1)]
    return x[keep], P[np.ix_(keep, keep)]
""",
    ),
    (
        "06-same",
        "fused as if independent",
        """
def merge(x, P, i, j):
    a, b = slice(3 + 2 * i, 5 + 2 * i), slice(3 + 2 * j, 5 + 2 * j)
    x, P = x.copy(), P.copy()
    K = P[a, a] @ np.linalg.inv(P[a, a] + P[b, b])
    x[a] = x[a] + K @ (x[b] - x[a])
    P[a, a] = P[a, a] - K @ P[a, a]
    keep = np.delete(np.arange(len(x)), [3 + 2 * j, 4 + 2 * j])
    return x[keep], P[np.ix_(keep, keep)]
""",
    ),
    (
        "06-same",
        "the smaller one stays",
        """
def merge(x, P, i, j):
    i, j = min(i, j), max(i, j)
    D = np.zeros((2, len(x)))
    D[0, 3 + 2 * i] = D[1, 4 + 2 * i] = 1
    D[0, 3 + 2 * j] = D[1, 4 + 2 * j] = -1
    K = P @ D.T @ np.linalg.inv(D @ P @ D.T)
    x, P = x - K @ D @ x, P - K @ D @ P
    keep = np.delete(np.arange(len(x)), [3 + 2 * j, 4 + 2 * j])
    return x[keep], P[np.ix_(keep, keep)]
""",
    ),
    (
        "06-same",
        "with a noise of 1 cm",
        """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    D[:, 3 + 2 * i : 5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j : 5 + 2 * j] = -np.eye(2)
    S = D @ P @ D.T + 1e-4 * np.eye(2)
    K = P @ D.T @ np.linalg.inv(S)
    x, P = x - K @ D @ x, P - K @ S @ K.T
    keep = np.delete(np.arange(len(x)), [3 + 2 * j, 4 + 2 * j])
    return x[keep], P[np.ix_(keep, keep)]
""",
    ),
    (
        "06-same",
        "x alone, P only cut",
        """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    D[:, 3 + 2 * i : 5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j : 5 + 2 * j] = -np.eye(2)
    x = x - P @ D.T @ np.linalg.inv(D @ P @ D.T) @ D @ x
    keep = np.delete(np.arange(len(x)), [3 + 2 * j, 4 + 2 * j])
    return x[keep], P[np.ix_(keep, keep)]
""",
    ),
    (
        "06-false-sights",
        "slam_step with R times ten",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    return slam_step(x, P, ids, u, seen, z, C, 10 * R)
""",
    ),
    (
        "06-false-sights",
        "every known landmark is ignored",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    keep = [k for k, i in enumerate(seen) if i not in ids]
    return slam_step(x, P, ids, u, [seen[k] for k in keep], z[keep], C, R)
""",
    ),
    (
        "06-false-sights",
        "gate by R alone",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
            v[1] = wrap(v[1])
            if v @ np.linalg.inv(R) @ v < 9:
                x, P = update(x, P, one, j, R)
        else:
            x, P = augment(x, P, one, R)
            ids = ids + [i]
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "never believes a second sight in a step",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    done = False
    for i, one in zip(seen, z):
        if i in ids:
            if not done:
                x, P = update(x, P, one, ids.index(i), R)
            done = True
        else:
            x, P = augment(x, P, one, R)
            ids = ids + [i]
    return x, P, ids
""",
    ),
]
