"""A ninth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "06-augment",
        "one big Jacobian of the old state and the sight: F [P 0; 0 R] F'",
        """
def augment(x, P, z, R):
    n = len(x)
    big = np.zeros((n + 2, n + 2))
    big[:n, :n], big[n:, n:] = P, R
    F = np.eye(n + 2)
    F[n:, :3] = J_xr(x[:3], z)
    F[n:, n:] = J_z(x[:3], z)
    return np.concatenate([x, g(x[:3], z)]), F @ big @ F.T
""",
    ),
    (
        "06-same",
        "changes to the coordinates (all without j, difference) and conditions the Gaussian on difference 0",
        """
def merge(x, P, i, j):
    n = len(x)
    keep = [k for k in range(n) if k not in (3 + 2 * j, 4 + 2 * j)]
    T = np.vstack([np.eye(n)[keep], np.zeros((2, n))])
    for k in range(2):
        T[n - 2 + k, 3 + 2 * i + k] = 1
        T[n - 2 + k, 3 + 2 * j + k] = -1
    y, Q = T @ x, T @ P @ T.T
    m = n - 2
    G = np.linalg.solve(Q[m:, m:], Q[m:, :m]).T
    return y[:m] - G @ y[m:], Q[:m, :m] - G @ Q[m:, :m]
""",
    ),
]

WRONG = [
    (
        "06-augment",
        "new landmark shares its error with the robot only: blocks with the other landmarks are zero",
        """
def augment(x, P, z, R):
    n = len(x)
    Gx, Gz = J_xr(x[:3], z), J_z(x[:3], z)
    big = np.zeros((n + 2, n + 2))
    big[:n, :n] = P
    big[n:, n:] = Gx @ P[:3, :3] @ Gx.T + Gz @ R @ Gz.T
    big[n:, :3] = Gx @ P[:3, :3]
    big[:3, n:] = big[n:, :3].T
    return np.append(x, g(x[:3], z)), big
""",
    ),
    (
        "06-augment",
        "R added as it is, in range and bearing, without J_z",
        """
def augment(x, P, z, R):
    J = J_xr(x[:3], z)
    row = J @ P[:3, :]
    corner = J @ P[:3, :3] @ J.T + R
    return np.hstack([x, g(x[:3], z)]), np.vstack([np.hstack([P, row.T]), np.hstack([row, corner])])
""",
    ),
    (
        "06-augment",
        "new landmark's covariance is the sensor's alone, the robot's doubt is left out of P_nn",
        """
def augment(x, P, z, R):
    Jx, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    cross = P[:, :3] @ Jx.T
    return np.r_[x, g(x[:3], z)], np.block([[P, cross], [cross.T, Jz @ R @ Jz.T]])
""",
    ),
    (
        "06-augment",
        "block-diagonal: the new landmark shares nothing with anything",
        """
def augment(x, P, z, R):
    size = P.shape[0]
    G = np.column_stack([J_xr(x[:3], z), J_z(x[:3], z)])
    both = np.zeros((5, 5))
    both[:3, :3] = P[:3, :3]
    both[3:, 3:] = R
    new = np.zeros((size + 2, size + 2))
    new[:size, :size] = P
    new[size:, size:] = G @ both @ G.T
    return np.concatenate((x, g(x[:3], z))), new
""",
    ),
    (
        "06-update",
        "only robot and landmark j are corrected, the rest of the map keeps its place and covariance",
        """
def update(x, P, z, j, R):
    its = np.array([0, 1, 2, 3 + 2 * j, 4 + 2 * j])
    v = z - h(x[:3], x[its[3:]])
    v[1] = wrap(v[1])
    H = np.hstack([H_robot(x[:3], x[its[3:]]), H_landmark(x[:3], x[its[3:]])])
    part = P[np.ix_(its, its)]
    S = H @ part @ H.T + R
    K = part @ H.T @ np.linalg.inv(S)
    x, P = x.copy(), P.copy()
    x[its] += K @ v
    P[np.ix_(its, its)] = part - K @ S @ K.T
    return x, P
""",
    ),
    (
        "06-update",
        "bearing difference not wrapped",
        """
def update(x, P, z, j, R):
    p = x[3:].reshape(-1, 2)[j]
    H = H_full(x, j)
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    return x + K @ (z - h(x[:3], p)), (np.eye(len(x)) - K @ H) @ P
""",
    ),
    (
        "06-update",
        "changes P and x of the caller in place",
        """
def update(x, P, z, j, R):
    v = z - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
    v[1] = wrap(v[1])
    H = H_full(x, j)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    x += K @ v
    P -= K @ S @ K.T
    return x, P
""",
    ),
    (
        "06-update",
        "S without the correlation of robot and landmark: sum of H_r P_rr H_r' and H_p P_pp H_p' and R",
        """
def update(x, P, z, j, R):
    a, b = 3 + 2 * j, 5 + 2 * j
    Hr, Hp = H_robot(x[:3], x[a:b]), H_landmark(x[:3], x[a:b])
    S = Hr @ P[:3, :3] @ Hr.T + Hp @ P[a:b, a:b] @ Hp.T + R
    K = (P[:, :3] @ Hr.T + P[:, a:b] @ Hp.T) @ np.linalg.inv(S)
    v = z - h(x[:3], x[a:b])
    v[1] = wrap(v[1])
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "06-slam",
        "id used as the place in the state instead of ids.index(id)",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for k in range(len(seen)):
        if seen[k] in ids:
            x, P = update(x, P, z[k], seen[k], R)
        else:
            x, P = augment(x, P, z[k], R)
            ids.append(seen[k])
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "a new landmark is augmented and at once updated with the same sight",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = ids.copy()
    for name, sight in zip(seen, z):
        if name not in ids:
            x, P = augment(x, P, sight, R)
            ids.append(name)
        x, P = update(x, P, sight, ids.index(name), R)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "appends to the caller's list of ids",
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
        "drives after it has seen instead of before",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids = ids + [i]
    x, P = predict(x, P, u, C)
    return x, P, ids
""",
    ),
    (
        "06-same",
        "fuses the two places as independent estimates; the rest of the state learns nothing",
        """
def merge(x, P, i, j):
    a, b = slice(3 + 2 * i, 5 + 2 * i), slice(3 + 2 * j, 5 + 2 * j)
    x, P = x.copy(), P.copy()
    Wa, Wb = np.linalg.inv(P[a, a]), np.linalg.inv(P[b, b])
    both = np.linalg.inv(Wa + Wb)
    x[a] = both @ (Wa @ x[a] + Wb @ x[b])
    P[a, a] = both
    keep = np.ones(len(x), dtype=bool)
    keep[b] = False
    return x[keep], P[keep][:, keep]
""",
    ),
    (
        "06-same",
        "landmark j is only struck out, nothing is learned from its being i",
        """
def merge(x, P, i, j):
    keep = [k for k in range(len(x)) if k not in (3 + 2 * j, 4 + 2 * j)]
    return x[keep], P[np.ix_(keep, keep)]
""",
    ),
    (
        "06-same",
        "plain mean of the two places (half of each) whatever P says: no weights, and the rest of the state learns nothing",
        """
def merge(x, P, i, j):
    T = np.eye(len(x))
    ri, rj = [3 + 2 * i, 4 + 2 * i], [3 + 2 * j, 4 + 2 * j]
    T[ri, ri] = 0.5
    T[ri, rj] = 0.5
    T = np.delete(T, rj, axis=0)
    return T @ x, T @ P @ T.T
""",
    ),
    (
        "06-same",
        "strikes out landmark i instead of j: the post keeps j's place in the order",
        """
def merge(x, P, i, j):
    H = np.zeros((2, len(x)))
    for k in range(2):
        H[k, 3 + 2 * i + k], H[k, 3 + 2 * j + k] = 1.0, -1.0
    S = H @ P @ H.T
    K = np.linalg.solve(S, H @ P).T
    x = x - K @ (H @ x)
    P = P - K @ H @ P
    rest = np.setdiff1d(np.arange(len(x)), [3 + 2 * i, 4 + 2 * i])
    return x[rest], P[np.ix_(rest, rest)]
""",
    ),
    (
        "06-false-sights",
        "the ordinary step, every false sight is believed",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    return slam_step(x, P, ids, u, seen, z, C, R)
""",
    ),
    (
        "06-false-sights",
        "refuses by the sensor's noise R alone: after the turn on the spot all true sights are refused",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids, W = list(ids), np.linalg.inv(R)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
        else:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
            v[1] = wrap(v[1])
            if v @ W @ v < 9.2:
                x, P = update(x, P, one, j, R)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "fixed limits of 0.4 m and 0.3 rad whatever P says",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            expected = h(x[:3], x[3:].reshape(-1, 2)[j])
            if abs(one[0] - expected[0]) > 0.4 or abs(wrap(one[1] - expected[1])) > 0.3:
                continue
            x, P = update(x, P, one, j, R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "gate the wrong way round: takes in only what is far off",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids = [*ids, i]
            continue
        j = ids.index(i)
        v = one - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
        v[1] = wrap(v[1])
        H = H_full(x, j)
        d2 = v @ np.linalg.inv(H @ P @ H.T + R) @ v
        if d2 > 9.21:
            x, P = update(x, P, one, j, R)
    return x, P, ids
""",
    ),
    (
        "06-augment",
        "works with the inverse of P, which does not exist when the pose is known exactly",
        """
def augment(x, P, z, R):
    n = len(x)
    p = g(x[:3], z)
    L = np.linalg.inv(J_z(x[:3], z) @ R @ J_z(x[:3], z).T)
    G = np.zeros((2, n + 2))
    G[:, :3], G[:, n:] = -J_xr(x[:3], z), np.eye(2)
    info = np.zeros((n + 2, n + 2))
    info[:n, :n] = np.linalg.inv(P)
    info += G.T @ L @ G
    return np.append(x, p), np.linalg.inv(info)
""",
    ),
    (
        "06-slam",
        "predicts once for each sight: the drive is made m times, and not at all when nothing is seen",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    ids = list(ids)
    for i, one in zip(seen, z):
        x, P = predict(x, P, u, C)
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-same",
        "takes the difference for a measurement with noise of 10 cm instead of none",
        """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    for k in (0, 1):
        D[k, 3 + 2 * i + k], D[k, 3 + 2 * j + k] = 1, -1
    S = D @ P @ D.T + 0.1**2 * np.eye(2)
    K = P @ D.T @ np.linalg.inv(S)
    x, P = x - K @ D @ x, P - K @ S @ K.T
    keep = [k for k in range(len(x)) if k not in (3 + 2 * j, 4 + 2 * j)]
    return x[keep], P[np.ix_(keep, keep)]
""",
    ),
]
