"""Independent answers to exercise 06, right and wrong ones, as students would type them."""

RIGHT = []
WRONG = []


def right(task, name, source):
    RIGHT.append((task, name, source.strip("\n") + "\n"))


def wrong(task, name, source):
    WRONG.append((task, name, source.strip("\n") + "\n"))


# ---------------------------------------------------------------------------------------------
# 06-augment
# ---------------------------------------------------------------------------------------------
right(
    "06-augment",
    "one big Jacobian, G P G' + J R J'",
    """
def augment(x, P, z, R):
    n = len(x)
    G = np.vstack([np.eye(n), np.zeros((2, n))])
    G[n:, :3] = J_xr(x[:3], z)
    N = np.zeros((n + 2, 2))
    N[n:] = J_z(x[:3], z)
    return np.concatenate([x, g(x[:3], z)]), G @ P @ G.T + N @ R @ N.T
""",
)
right(
    "06-augment",
    "block after block, landmarks in a loop, by hand",
    """
def augment(x, P, z, R):
    r, a = z[0], x[2] + z[1]
    c, s = np.cos(a), np.sin(a)
    n = x.size
    Jx = np.array([[1.0, 0.0, -r * s], [0.0, 1.0, r * c]])
    Jm = np.array([[c, -r * s], [s, r * c]])
    x_new = np.empty(n + 2)
    x_new[:n] = x
    x_new[n], x_new[n + 1] = x[0] + r * c, x[1] + r * s
    P_new = np.zeros((n + 2, n + 2))
    P_new[:n, :n] = P
    P_new[n:, n:] = Jx @ P[:3, :3] @ Jx.T + Jm @ R @ Jm.T
    P_new[n:, :3] = Jx @ P[:3, :3]
    for k in range(3, n, 2):
        P_new[n:, k:k + 2] = Jx @ P[:3, k:k + 2]
    for k in range(n):
        P_new[k, n:] = P_new[n:, k]
    return x_new, P_new
""",
)
right(
    "06-augment",
    "state [x, z] with block-diagonal covariance, mapped",
    """
def augment(x, P, z, R):
    n = x.shape[0]
    big = np.pad(P, (0, 2))
    big[n:, n:] = R
    T = np.eye(n + 2)
    T[n:, n:] = J_z(x[:3], z)
    T[n:, 0:3] = J_xr(x[:3], z)
    return np.r_[x, g(x[:3], z)], T @ big @ T.T
""",
)

wrong(
    "06-augment",
    "no covariance with the old landmarks",
    """
def augment(x, P, z, R):
    n = len(x)
    Jx, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    Pn = np.zeros((n + 2, n + 2))
    Pn[:n, :n] = P
    Pn[n:, n:] = Jx @ P[:3, :3] @ Jx.T + Jz @ R @ Jz.T
    Pn[n:, :3] = Jx @ P[:3, :3]
    Pn[:3, n:] = Pn[n:, :3].T
    return np.append(x, g(x[:3], z)), Pn
""",
)
wrong(
    "06-augment",
    "block diagonal: related to nobody",
    """
def augment(x, P, z, R):
    Jx, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    n = len(x)
    new = Jx @ P[:3, :3] @ Jx.T + Jz @ R @ Jz.T
    return (
        np.hstack([x, g(x[:3], z)]),
        np.block([[P, np.zeros((n, 2))], [np.zeros((2, n)), new]]),
    )
""",
)
wrong(
    "06-augment",
    "only the sensor's noise in P_nn",
    """
def augment(x, P, z, R):
    Jx, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    cross = P[:, :3] @ Jx.T
    return np.append(x, g(x[:3], z)), np.block([[P, cross], [cross.T, Jz @ R @ Jz.T]])
""",
)
wrong(
    "06-augment",
    "R added as it is, in range and bearing",
    """
def augment(x, P, z, R):
    n = len(x)
    G = np.zeros((n + 2, n))
    G[:n, :n] = np.eye(n)
    G[n:, :3] = J_xr(x[:3], z)
    P = G @ P @ G.T
    P[n:, n:] += R
    return np.append(x, g(x[:3], z)), P
""",
)
wrong(
    "06-augment",
    "J_z transposed",
    """
def augment(x, P, z, R):
    Jxr, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    row = Jxr @ P[:3]
    P_nn = Jxr @ P[:3, :3] @ Jxr.T + Jz.T @ R @ Jz
    return np.append(x, g(x[:3], z)), np.block([[P, row.T], [row, P_nn]])
""",
)
wrong(
    "06-augment",
    "new landmark is put in front of the others",
    """
def augment(x, P, z, R):
    Jxr, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    n = len(x)
    G = np.zeros((n + 2, n))
    G[:3, :3] = np.eye(3)
    G[3:5, :3] = Jxr
    G[5:, 3:] = np.eye(n - 3)
    Q = np.zeros((n + 2, n + 2))
    Q[3:5, 3:5] = Jz @ R @ Jz.T
    return np.concatenate([x[:3], g(x[:3], z), x[3:]]), G @ P @ G.T + Q
""",
)
wrong(
    "06-augment",
    "a little jitter written into the caller's P so that it is not singular",
    """
def augment(x, P, z, R):
    if np.linalg.det(P[:3, :3]) == 0:
        P[:3, :3] += 1e-6 * np.eye(3)
    Jxr, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    row = Jxr @ P[:3]
    P_nn = row[:, :3] @ Jxr.T + Jz @ R @ Jz.T
    return np.append(x, g(x[:3], z)), np.block([[P, row.T], [row, P_nn]])
""",
)
wrong(
    "06-augment",
    "forgets the heading when placing the landmark",
    """
def augment(x, P, z, R):
    r, b = z
    p = x[:2] + r * np.array([np.cos(b), np.sin(b)])
    Jx = np.array([[1, 0, -r * np.sin(b)], [0, 1, r * np.cos(b)]])
    Jz = np.array([[np.cos(b), -r * np.sin(b)], [np.sin(b), r * np.cos(b)]])
    row = Jx @ P[:3]
    return np.append(x, p), np.block([[P, row.T], [row, row[:, :3] @ Jx.T + Jz @ R @ Jz.T]])
""",
)
wrong(
    "06-augment",
    "bearing taken as degrees",
    """
def augment(x, P, z, R):
    z = np.array([z[0], np.deg2rad(z[1])])
    A, B = J_xr(x[:3], z), J_z(x[:3], z)
    top = P[:, :3] @ A.T
    corner = A @ P[:3, :3] @ A.T + B @ R @ B.T
    return np.append(x, g(x[:3], z)), np.vstack([np.hstack([P, top]), np.hstack([top.T, corner])])
""",
)
wrong(
    "06-augment",
    "lower left filled, upper right forgotten",
    """
def augment(x, P, z, R):
    n = len(x)
    Jx, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    big = np.zeros((n + 2, n + 2))
    big[:n, :n] = P
    big[n:, :n] = Jx @ P[:3, :]
    big[n:, n:] = Jx @ P[:3, :3] @ Jx.T + Jz @ R @ Jz.T
    return np.append(x, g(x[:3], z)), big
""",
)
wrong(
    "06-augment",
    "empty map treated as exactly known pose",
    """
def augment(x, P, z, R):
    Jz = J_z(x[:3], z)
    p = g(x[:3], z)
    if len(x) == 3:                       # first landmark: nothing to be related to
        Pn = np.zeros((5, 5))
        Pn[:3, :3] = P
        Pn[3:, 3:] = Jz @ R @ Jz.T
        return np.append(x, p), Pn
    Jx = J_xr(x[:3], z)
    row = Jx @ P[:3]
    return np.append(x, p), np.block([[P, row.T], [row, Jx @ P[:3, :3] @ Jx.T + Jz @ R @ Jz.T]])
""",
)
wrong(
    "06-augment",
    "only the place of the robot, not its heading, hands on doubt",
    """
def augment(x, P, z, R):
    Jz = J_z(x[:3], z)
    row = P[:2]
    P_nn = P[:2, :2] + Jz @ R @ Jz.T
    return np.append(x, g(x[:3], z)), np.block([[P, row.T], [row, P_nn]])
""",
)
wrong(
    "06-augment",
    "sampled covariance instead of Jacobians",
    """
def augment(x, P, z, R):
    rng = np.random.default_rng(0)
    states = rng.multivariate_normal(x, P, 2000)
    sights = rng.multivariate_normal(z, R, 2000)
    marks = np.array([g(s[:3], w) for s, w in zip(states, sights)])
    return np.append(x, g(x[:3], z)), np.cov(np.hstack([states, marks]).T)
""",
)
wrong(
    "06-augment",
    "returned in the wrong order",
    """
def augment(x, P, z, R):
    n = len(x)
    T = np.eye(n + 2)
    T[n:, :3], T[n:, n:] = J_xr(x[:3], z), J_z(x[:3], z)
    full = np.zeros((n + 2, n + 2))
    full[:n, :n], full[n:, n:] = P, R
    return T @ full @ T.T, np.append(x, g(x[:3], z))
""",
)
wrong(
    "06-augment",
    "minus on the row (as if H were used instead of J_xr)",
    """
def augment(x, P, z, R):
    p = g(x[:3], z)
    Hp_inv = np.linalg.inv(H_landmark(x[:3], p))
    J = Hp_inv @ H_robot(x[:3], p)        # chain rule, sign forgotten
    row = J @ P[:3]
    P_nn = J @ P[:3, :3] @ J.T + Hp_inv @ R @ Hp_inv.T
    return np.append(x, p), np.block([[P, row.T], [row, P_nn]])
""",
)

# ---------------------------------------------------------------------------------------------
# 06-update
# ---------------------------------------------------------------------------------------------
right(
    "06-update",
    "Joseph's form",
    """
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = np.array(z, dtype=float) - h(x[:3], x[2 * j + 3: 2 * j + 5])
    v[1] = wrap(v[1])
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    I_KH = np.eye(len(x)) - K @ H
    return x + K @ v, I_KH @ P @ I_KH.T + K @ R @ K.T
""",
)
right(
    "06-update",
    "Cholesky of S, no gain formed, heading left unwrapped",
    """
def update(x, P, z, j, R):
    where = 3 + 2 * j
    H = H_full(x, j)
    predicted = h(x[:3], x[where:where + 2])
    turn = z[1] - predicted[1]
    v = np.array([z[0] - predicted[0], np.arctan2(np.sin(turn), np.cos(turn))])
    L = np.linalg.cholesky(H @ P @ H.T + R)
    B = np.linalg.solve(L, H @ P)          # (2, n)
    return x + B.T @ np.linalg.solve(L, v), P - B.T @ B
""",
)
right(
    "06-update",
    "five columns only, solve, (I - K H) P, made symmetric",
    """
def update(x, P, z, j, R):
    cols = [0, 1, 2, 3 + 2 * j, 4 + 2 * j]
    p = x[cols[3:]]
    Hs = np.hstack([H_robot(x[:3], p), H_landmark(x[:3], p)])
    PHt = P[:, cols] @ Hs.T
    S = Hs @ PHt[cols] + R
    K = np.linalg.solve(S.T, PHt.T).T
    v = z - h(x[:3], p)
    v[1] = (v[1] + np.pi) % (2 * np.pi) - np.pi
    new = x + K @ v
    new[2] = wrap(new[2])
    P_new = P - K @ PHt.T
    return new, (P_new + P_new.T) / 2
""",
)

wrong(
    "06-update",
    "bearing's difference is not wrapped",
    """
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    x = x + K @ v
    x[2] = wrap(x[2])
    return x, P - K @ S @ K.T
""",
)
wrong(
    "06-update",
    "wraps both bearings, not their difference",
    """
def update(x, P, z, j, R):
    seen, expected = np.array(z), h(x[:3], x[3 + 2 * j:5 + 2 * j])
    seen[1], expected[1] = wrap(seen[1]), wrap(expected[1])
    H = H_full(x, j)
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    return x + K @ (seen - expected), P - K @ S @ K.T
""",
)
wrong(
    "06-update",
    "wraps the range's difference, too",
    """
def update(x, P, z, j, R):
    v = wrap(z - h(x[:3], x[3 + 2 * j:5 + 2 * j]))
    H = H_full(x, j)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return x + K @ v, (np.eye(len(x)) - K @ H) @ P
""",
)
wrong(
    "06-update",
    "wraps on one side only",
    """
def update(x, P, z, j, R):
    v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
    if v[1] > np.pi:
        v[1] -= 2 * np.pi
    H = H_full(x, j)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
)
wrong(
    "06-update",
    "wraps the whole state",
    """
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return wrap(x + K @ v), P - K @ S @ K.T
""",
)
wrong(
    "06-update",
    "gain for robot and seen landmark only",
    """
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    mask = np.zeros(len(x), bool)
    mask[:3] = mask[3 + 2 * j:5 + 2 * j] = True
    K[~mask] = 0
    x = x + K @ v
    x[2] = wrap(x[2])
    return x, P - K @ S @ K.T
""",
)
wrong(
    "06-update",
    "landmarks counted from 1 in the innovation",
    """
def update(x, P, z, j, R):
    marks = x[3:].reshape(-1, 2)
    v = z - h(x[:3], marks[j - 1])
    v[1] = wrap(v[1])
    H = H_full(x, j)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
)
wrong(
    "06-update",
    "x is corrected in place",
    """
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    x += K @ v
    x[2] = wrap(x[2])
    return x, P - K @ S @ K.T
""",
)
wrong(
    "06-update",
    "innovation overwrites z",
    """
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = z
    v -= h(x[:3], x[3 + 2 * j:5 + 2 * j])
    v[1] = wrap(v[1])
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return x + K @ v, P - K @ H @ P
""",
)
wrong(
    "06-update",
    "P - K H",
    """
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
    v[1] = wrap(v[1])
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return x + K @ v, P - K @ H
""",
)
wrong(
    "06-update",
    "half of Joseph's form, without K R K'",
    """
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
    v[1] = wrap(v[1])
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    M = np.eye(x.size) - K @ H
    return x + K @ v, M @ P @ M.T
""",
)
wrong(
    "06-update",
    "S taken for diagonal",
    """
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T / np.diag(S)
    return x + K @ v, P - K @ S @ K.T
""",
)
wrong(
    "06-update",
    "range and bearing one after the other, R's off-diagonal lost",
    """
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
    v[1] = wrap(v[1])
    dx, P = np.zeros(len(x)), P.copy()
    for k in range(2):
        row = H[k]
        s = row @ P @ row + R[k, k]
        gain = P @ row / s
        dx = dx + gain * (v[k] - row @ dx)
        P = P - np.outer(gain, gain) * s
    return x + dx, P
""",
)
wrong(
    "06-update",
    "relinearises once and counts the sight twice",
    """
def update(x, P, z, j, R):
    for _ in range(2):
        H = H_full(x, j)
        v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
        v[1] = wrap(v[1])
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        x, P = x + K @ v, P - K @ S @ K.T
    return x, P
""",
)
wrong(
    "06-update",
    "S without what robot and landmark share",
    """
def update(x, P, z, j, R):
    its = slice(3 + 2 * j, 5 + 2 * j)
    Hr, Hp = H_robot(x[:3], x[its]), H_landmark(x[:3], x[its])
    S = Hr @ P[:3, :3] @ Hr.T + Hp @ P[its, its] @ Hp.T + R
    v = z - h(x[:3], x[its])
    v[1] = wrap(v[1])
    K = (P[:, :3] @ Hr.T + P[:, its] @ Hp.T) @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
)
wrong(
    "06-update",
    "innovation the wrong way round",
    """
def update(x, P, z, j, R):
    at = 3 + 2 * j
    v = h(x[:3], x[at : at + 2]) - z
    v[1] = wrap(v[1])
    H = H_full(x, j)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    x = x + K @ v
    x[2] = wrap(x[2])
    return x, P - K @ S @ K.T
""",
)
wrong(
    "06-update",
    "only the diagonal of P is lowered",
    """
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    less = np.diag(np.diag(K @ S @ K.T))
    return x + K @ v, P - less
""",
)
wrong(
    "06-update",
    "H hard-coded for one landmark map",
    """
def update(x, P, z, j, R):
    p = x[3:5]
    H = np.zeros((2, len(x)))
    H[:, :5] = np.hstack([H_robot(x[:3], p), H_landmark(x[:3], p)])
    v = z - h(x[:3], p)
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
)

# ---------------------------------------------------------------------------------------------
# 06-slam
# ---------------------------------------------------------------------------------------------
right(
    "06-slam",
    "known ones first, then the rest, index kept in a dict",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    where = {name: k for k, name in enumerate(ids)}
    late = []
    for k in range(len(seen)):
        if seen[k] in where:
            x, P = update(x, P, z[k], where[seen[k]], R)
        else:
            late.append(k)
    for k in late:
        if seen[k] in where:
            x, P = update(x, P, z[k], where[seen[k]], R)
        else:
            x, P = augment(x, P, z[k], R)
            where[seen[k]] = len(ids)
            ids.append(seen[k])
    return x, P, ids
""",
)
right(
    "06-slam",
    "all known sights in one stacked update",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    new_ids = ids.copy()
    known = [k for k, i in enumerate(seen) if i in new_ids]
    if known:
        js = [new_ids.index(seen[k]) for k in known]
        H = np.vstack([H_full(x, j) for j in js])
        v = np.array([z[k] - h(x[:3], x[3 + 2 * j:5 + 2 * j]) for k, j in zip(known, js)])
        v[:, 1] = wrap(v[:, 1])
        S = H @ P @ H.T + np.kron(np.eye(len(js)), R)
        K = np.linalg.solve(S, H @ P).T
        x, P = x + K @ v.ravel(), P - K @ S @ K.T
        x[2] = wrap(x[2])
    for k, i in enumerate(seen):
        if k in known:
            continue
        if i in new_ids:
            x, P = update(x, P, z[k], new_ids.index(i), R)
        else:
            x, P = augment(x, P, z[k], R)
            new_ids.append(i)
    return x, P, new_ids
""",
)

wrong(
    "06-slam",
    "sees first, drives afterwards",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    x, P = predict(x, P, u, C)
    return x, P, ids
""",
)
wrong(
    "06-slam",
    "places new landmarks before predicting",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    old = list(ids)
    names = list(ids)
    for k, i in enumerate(seen):
        if i not in names:
            x, P = augment(x, P, z[k], R)
            names.append(i)
    x, P = predict(x, P, u, C)
    for k, i in enumerate(seen):
        if i in old:
            x, P = update(x, P, z[k], old.index(i), R)
    return x, P, names
""",
)
wrong(
    "06-slam",
    "appends to the caller's ids",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for k in range(len(seen)):
        if seen[k] in ids:
            x, P = update(x, P, z[k], ids.index(seen[k]), R)
        else:
            x, P = augment(x, P, z[k], R)
            ids.append(seen[k])
    return x, P, ids
""",
)
wrong(
    "06-slam",
    "id used as index of the landmark",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z, strict=True):
        if i in ids:
            x, P = update(x, P, one, i, R)
        else:
            x, P = augment(x, P, one, R)
            ids = [*ids, i]
    return x, P, ids
""",
)
wrong(
    "06-slam",
    "predicts once for each sight",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    ids = list(ids)
    for i, one in zip(seen, z, strict=True):
        x, P = predict(x, P, u, C)
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
)
wrong(
    "06-slam",
    "nothing seen: returns without having driven",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    if len(seen) == 0:
        return x, P, ids
    x, P = predict(x, P, u, C)
    ids = ids[:]
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids += [i]
        else:
            x, P = update(x, P, one, ids.index(i), R)
    return x, P, ids
""",
)
wrong(
    "06-slam",
    "a new landmark is updated at once with the same sight",
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
)
wrong(
    "06-slam",
    "return inside the loop",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
        return x, P, ids
    return x, P, ids
""",
)
wrong(
    "06-slam",
    "each update starts from the prediction, only the last counts",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    x0, P0 = predict(x, P, u, C)
    x, P = x0, P0
    known = [(ids.index(i), one) for i, one in zip(seen, z) if i in ids]
    for j, one in known:
        x, P = update(x0, P0, one, j, R)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
)
wrong(
    "06-slam",
    "ids kept sorted, the state is not",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids = sorted([*ids, i])
    return x, P, ids
""",
)
wrong(
    "06-slam",
    "known means id below the number of landmarks",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for k, i in enumerate(seen):
        if i < (len(x) - 3) // 2:
            x, P = update(x, P, z[k], i, R)
        else:
            x, P = augment(x, P, z[k], R)
            ids.append(i)
    return x, P, ids
""",
)
wrong(
    "06-slam",
    "new ids not returned",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    known = list(ids)
    for i, one in zip(seen, z):
        if i in known:
            x, P = update(x, P, one, known.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            known.append(i)
    return x, P, ids
""",
)
wrong(
    "06-slam",
    "an array of ids comes back, and floats at that",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = np.array(ids, dtype=float)
    for i, one in zip(seen, z):
        at = np.flatnonzero(ids == i)
        if at.size:
            x, P = update(x, P, one, int(at[0]), R)
        else:
            x, P = augment(x, P, one, R)
            ids = np.append(ids, i)
    return x, P, ids
""",
)
wrong(
    "06-slam",
    "correlation thrown away after predicting",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P_moved = predict(x, P, u, C)
    P = P.copy()
    P[:3, :3] = P_moved[:3, :3]       # the robot moved, the landmarks did not
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
)
wrong(
    "06-slam",
    "known landmarks are never updated, half finished",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for k, i in enumerate(seen):
        if i in ids:
            continue
        x, P = augment(x, P, z[k], R)
        ids.append(i)
    return x, P, ids
""",
)
wrong(
    "06-slam",
    "stacked update forgets to wrap the bearings",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    pairs = [(ids.index(i), one) for i, one in zip(seen, z) if i in ids]
    if pairs:
        H = np.vstack([H_full(x, j) for j, _ in pairs])
        v = np.concatenate([one - h(x[:3], x[3 + 2 * j:5 + 2 * j]) for j, one in pairs])
        S = H @ P @ H.T + np.kron(np.eye(len(pairs)), R)
        K = P @ H.T @ np.linalg.inv(S)
        x, P = x + K @ v, P - K @ S @ K.T
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
)
wrong(
    "06-slam",
    "stacked R in the wrong Kronecker order",
    """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    pairs = [(ids.index(i), one) for i, one in zip(seen, z) if i in ids]
    if pairs:
        H = np.vstack([H_full(x, j) for j, _ in pairs])
        v = np.array([one - h(x[:3], x[3 + 2 * j:5 + 2 * j]) for j, one in pairs])
        v[:, 1] = wrap(v[:, 1])
        S = H @ P @ H.T + np.kron(R, np.eye(len(pairs)))
        K = P @ H.T @ np.linalg.inv(S)
        x, P = x + K @ v.ravel(), P - K @ S @ K.T
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
)

# ---------------------------------------------------------------------------------------------
# 06-same
# ---------------------------------------------------------------------------------------------
right(
    "06-same",
    "least squares over the smaller state, x = T y, weighted by P",
    """
def merge(x, P, i, j):
    n = len(x)
    keep = [k for k in range(n) if k not in (3 + 2 * j, 4 + 2 * j)]
    T = np.zeros((n, n - 2))
    for col, k in enumerate(keep):
        T[k, col] = 1
        if k in (3 + 2 * i, 4 + 2 * i):
            T[k - 3 - 2 * i + 3 + 2 * j, col] = 1
    L = np.linalg.cholesky(P)
    A, b = np.linalg.solve(L, T), np.linalg.solve(L, x)
    Q, U = np.linalg.qr(A)
    U_inv = np.linalg.inv(U)
    return U_inv @ (Q.T @ b), U_inv @ U_inv.T
""",
)
right(
    "06-same",
    "condition on the difference, blocks by index",
    """
def merge(x, P, i, j):
    a, b = np.array([3, 4]) + 2 * i, np.array([3, 4]) + 2 * j
    cross = P[:, a] - P[:, b]              # cov(state, p_i - p_j)
    S = cross[a] - cross[b]
    gain = np.linalg.solve(S, cross.T).T
    mean = x - gain @ (x[a] - x[b])
    cov = P - gain @ cross.T
    left = np.setdiff1d(np.arange(len(x)), b)
    return mean[left], cov[np.ix_(left, left)]
""",
)

wrong(
    "06-same",
    "the middle of the two, the rest struck out",
    """
def merge(x, P, i, j):
    x = x.copy()
    pi, pj = slice(3 + 2 * i, 5 + 2 * i), slice(3 + 2 * j, 5 + 2 * j)
    x[pi] = (x[pi] + x[pj]) / 2
    gone = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, gone), np.delete(np.delete(P, gone, 0), gone, 1)
""",
)
wrong(
    "06-same",
    "landmark j is just struck out",
    """
def merge(x, P, i, j):
    keep = np.ones(len(x), dtype=bool)
    keep[3 + 2 * j:5 + 2 * j] = False
    return x[keep], P[keep][:, keep]
""",
)
wrong(
    "06-same",
    "fused as if independent, by their own variances",
    """
def merge(x, P, i, j):
    a, b = slice(3 + 2 * i, 5 + 2 * i), slice(3 + 2 * j, 5 + 2 * j)
    Ia, Ib = np.linalg.inv(P[a, a]), np.linalg.inv(P[b, b])
    x, P = x.copy(), P.copy()
    P[a, a] = np.linalg.inv(Ia + Ib)
    x[a] = P[a, a] @ (Ia @ x[a] + Ib @ x[b])
    keep = [k for k in range(len(x)) if not 3 + 2 * j <= k < 5 + 2 * j]
    return x[keep], P[np.ix_(keep, keep)]
""",
)
wrong(
    "06-same",
    "correlated fusion of i, nobody else learns",
    """
def merge(x, P, i, j):
    a, b = slice(3 + 2 * i, 5 + 2 * i), slice(3 + 2 * j, 5 + 2 * j)
    S = P[a, a] + P[b, b] - P[a, b] - P[b, a]
    K = (P[a, a] - P[a, b]) @ np.linalg.inv(S)
    x, P = x.copy(), P.copy()
    x[a] = x[a] - K @ (x[a] - x[b])
    P[a, a] = P[a, a] - K @ S @ K.T
    gone = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, gone), np.delete(np.delete(P, gone, 0), gone, 1)
""",
)
wrong(
    "06-same",
    "robot and bystanders get no gain",
    """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    for k in range(2):
        D[k, 3 + 2 * i + k], D[k, 3 + 2 * j + k] = 1, -1
    S = D @ P @ D.T
    K = P @ D.T @ np.linalg.inv(S)
    K[:3] = 0                              # nobody has measured anything from the robot
    x, P = x - K @ D @ x, P - K @ S @ K.T
    keep = [k for k in range(len(x)) if k not in (3 + 2 * j, 4 + 2 * j)]
    return x[keep], P[np.ix_(keep, keep)]
""",
)
wrong(
    "06-same",
    "removes i instead of j",
    """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    D[:, 3 + 2 * i : 5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j : 5 + 2 * j] = -np.eye(2)
    S = D @ P @ D.T
    K = P @ D.T @ np.linalg.inv(S)
    x, P = x - K @ D @ x, P - K @ S @ K.T
    gone = [3 + 2 * i, 4 + 2 * i]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)
""",
)
wrong(
    "06-same",
    "always keeps the earlier one",
    """
def merge(x, P, i, j):
    i, j = min(i, j), max(i, j)
    a, b = 3 + 2 * i, 3 + 2 * j
    D = np.zeros((2, len(x)))
    D[[0, 1], [a, a + 1]] = 1
    D[[0, 1], [b, b + 1]] = -1
    K = P @ D.T @ np.linalg.inv(D @ P @ D.T)
    x, P = x - K @ (D @ x), (np.eye(len(x)) - K @ D) @ P
    keep = np.r_[0:b, b + 2:len(x)]
    return x[keep], P[np.ix_(keep, keep)]
""",
)
wrong(
    "06-same",
    "the difference is added instead of taken away",
    """
def merge(x, P, i, j):
    E = np.eye(len(x))
    D = E[3 + 2 * i:5 + 2 * i] - E[3 + 2 * j:5 + 2 * j]
    S = D @ P @ D.T
    K = np.linalg.solve(S, D @ P).T
    x, P = x + K @ D @ x, P - K @ S @ K.T
    gone = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)
""",
)
wrong(
    "06-same",
    "with a noise of 3 cm, so that S is not singular",
    """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    D[:, 3 + 2 * i:5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j:5 + 2 * j] = -np.eye(2)
    S = D @ P @ D.T + 0.03**2 * np.eye(2)
    K = P @ D.T @ np.linalg.inv(S)
    v = np.zeros(2) - D @ x
    x, P = x + K @ v, P - K @ S @ K.T
    gone = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)
""",
)
wrong(
    "06-same",
    "deletes one after the other, indices moved meanwhile",
    """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    D[:, 3 + 2 * i:5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j:5 + 2 * j] = -np.eye(2)
    S = D @ P @ D.T
    K = P @ D.T @ np.linalg.inv(S)
    x, P = x - K @ D @ x, P - K @ S @ K.T
    for k in (3 + 2 * j, 4 + 2 * j):
        k = min(k, len(x) - 1)
        x = np.delete(x, k)
        P = np.delete(np.delete(P, k, 0), k, 1)
    return x, P
""",
)
wrong(
    "06-same",
    "strikes j out first, then finds i at its old number",
    """
def merge(x, P, i, j):
    xj = x[3 + 2 * j:5 + 2 * j]
    Pj = P[3 + 2 * j:5 + 2 * j, 3 + 2 * j:5 + 2 * j]
    gone = [3 + 2 * j, 4 + 2 * j]
    cross = np.delete(P[gone], gone, axis=1)
    x, P = np.delete(x, gone), np.delete(np.delete(P, gone, 0), gone, 1)
    H = np.zeros((2, len(x)))
    its = slice(3 + 2 * i, 5 + 2 * i)
    H[:, its] = np.eye(2)
    C = P @ H.T - cross.T
    S = H @ P @ H.T + Pj - H @ cross.T - cross @ H.T
    K = C @ np.linalg.inv(S)
    return x - K @ (H @ x - xj), P - K @ S @ K.T
""",
)
wrong(
    "06-same",
    "merged landmark goes to the end",
    """
def merge(x, P, i, j):
    n = len(x)
    D = np.zeros((2, n))
    D[:, 3 + 2 * i:5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j:5 + 2 * j] = -np.eye(2)
    S = D @ P @ D.T
    K = P @ D.T @ np.linalg.inv(S)
    x, P = x - K @ D @ x, P - K @ S @ K.T
    both = {3 + 2 * i, 4 + 2 * i, 3 + 2 * j, 4 + 2 * j}
    order = [k for k in range(n) if k not in both] + [3 + 2 * i, 4 + 2 * i]
    return x[order], P[np.ix_(order, order)]
""",
)
wrong(
    "06-same",
    "x is moved, P only struck out",
    """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    D[:, 3 + 2 * i:5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j:5 + 2 * j] = -np.eye(2)
    x = x - P @ D.T @ np.linalg.solve(D @ P @ D.T, D @ x)
    left = np.delete(np.arange(len(x)), [3 + 2 * j, 4 + 2 * j])
    return x[left], P[np.ix_(left, left)]
""",
)
wrong(
    "06-same",
    "robot's three numbers forgotten in the indices",
    """
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    D[:, 2 * i:2 * i + 2] = np.eye(2)
    D[:, 2 * j:2 * j + 2] = -np.eye(2)
    S = D @ P @ D.T
    K = P @ D.T @ np.linalg.inv(S)
    x, P = x - K @ D @ x, P - K @ S @ K.T
    gone = [2 * j, 2 * j + 1]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)
""",
)
wrong(
    "06-same",
    "the correction is made in the caller's arrays",
    """
def merge(x, P, i, j):
    a, b = np.arange(2) + 3 + 2 * i, np.arange(2) + 3 + 2 * j
    C = P[:, a] - P[:, b]
    S = C[a] - C[b]
    K = C @ np.linalg.inv(S)
    x -= K @ (x[a] - x[b])
    P -= K @ S @ K.T
    left = np.setdiff1d(np.arange(len(x)), b)
    return x[left], P[np.ix_(left, left)]
""",
)
wrong(
    "06-same",
    "pulled together in x, then in y, with the old P both times",
    """
def merge(x, P, i, j):
    dx, less = np.zeros(len(x)), np.zeros_like(P)
    for k in range(2):
        d = np.zeros(len(x))
        d[3 + 2 * i + k], d[3 + 2 * j + k] = 1, -1
        s = d @ P @ d
        gain = P @ d / s
        dx -= gain * (d @ x)
        less += np.outer(gain, gain) * s
    x, P = x + dx, P - less
    gone = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)
""",
)
wrong(
    "06-same",
    "only the distance is made zero (linearised range)",
    """
def merge(x, P, i, j):
    a, b = slice(3 + 2 * i, 5 + 2 * i), slice(3 + 2 * j, 5 + 2 * j)
    d = x[a] - x[b]
    r = np.hypot(*d)
    H = np.zeros((1, len(x)))
    H[0, a], H[0, b] = d / r, -d / r
    S = H @ P @ H.T
    K = P @ H.T / S
    x, P = x + K @ [0 - r], P - K @ S @ K.T
    gone = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)
""",
)

# ---------------------------------------------------------------------------------------------
# 06-false-sights
# ---------------------------------------------------------------------------------------------
right(
    "06-false-sights",
    "nearest first: best sight taken, all gated anew",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)

    def distance(k):
        j = ids.index(seen[k])
        v = z[k] - h(x[:3], x[3 + 2 * j:5 + 2 * j])
        v[1] = wrap(v[1])
        H = H_full(x, j)
        return v @ np.linalg.inv(H @ P @ H.T + R) @ v

    todo = [k for k, i in enumerate(seen) if i in ids]
    fresh = [k for k, i in enumerate(seen) if i not in ids]
    while todo:
        best = min(todo, key=distance)
        if distance(best) > 12:
            break
        x, P = update(x, P, z[best], ids.index(seen[best]), R)
        todo.remove(best)
    for k in fresh:
        if seen[k] in ids:
            continue
        x, P = augment(x, P, z[k], R)
        ids.append(seen[k])
    return x, P, ids
""",
)
right(
    "06-false-sights",
    "gate at 99 %, whitened by Cholesky, own update inline",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = ids.copy()
    for k in range(len(seen)):
        if seen[k] not in ids:
            x, P = augment(x, P, z[k], R)
            ids.append(seen[k])
            continue
        j = ids.index(seen[k])
        H = H_full(x, j)
        L = np.linalg.cholesky(H @ P @ H.T + R)
        v = z[k] - h(x[:3], x[3 + 2 * j:5 + 2 * j])
        v[1] = wrap(v[1])
        w = np.linalg.solve(L, v)
        if w @ w > -2 * np.log(0.005):
            continue
        B = np.linalg.solve(L, H @ P)
        x, P = x + B.T @ w, P - B.T @ B
        x[2] = wrap(x[2])
    return x, P, ids
""",
)

wrong(
    "06-false-sights",
    "slam_step itself",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    return slam_step(x, P, ids, u, seen, z, C, R)
""",
)
wrong(
    "06-false-sights",
    "eyes shut: wheels only",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "first sights only, since those are never false",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "everything trusted less: R ten times as large",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), 10 * R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "gate by the sensor's noise alone",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    sigma = np.sqrt(np.diag(R))
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
            continue
        j = ids.index(i)
        v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
        v[1] = wrap(v[1])
        if np.all(np.abs(v) < 2 * sigma):
            x, P = update(x, P, one, j, R)
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "gate far too tight (d^2 < 1)",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v[1] = wrap(v[1])
            H = H_full(x, j)
            if v @ np.linalg.solve(H @ P @ H.T + R, v) < 1:
                x, P = update(x, P, one, j, R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "bound on the distance, its square forgotten: never rejects",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v[1] = wrap(v[1])
            H = H_full(x, j)
            d = np.sqrt(v @ np.linalg.solve(H @ P @ H.T + R, v))
            if d < 13.8:
                x, P = update(x, P, one, j, R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "gate with S instead of its inverse",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v[1] = wrap(v[1])
            H = H_full(x, j)
            if v @ (H @ P @ H.T + R) @ v < 9.21:
                x, P = update(x, P, one, j, R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "false sight is taken for a landmark that moved: placed anew, the old one forgotten",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        ok = False
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v[1] = wrap(v[1])
            H = H_full(x, j)
            ok = v @ np.linalg.inv(H @ P @ H.T + R) @ v < 9.21
        if ok:
            x, P = update(x, P, one, j, R)
        else:
            if i in ids:
                ids[ids.index(i)] = -1
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "looks at the range only",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            r = h(x[:3], x[3 + 2 * j:5 + 2 * j])[0]
            if abs(one[0] - r) < 1.0:
                x, P = update(x, P, one, j, R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "rejected sight also leaves the whole step undriven",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x0, P0, ids0 = x, P, list(ids)
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v[1] = wrap(v[1])
            H = H_full(x, j)
            if v @ np.linalg.inv(H @ P @ H.T + R) @ v > 13.8:
                return x0, P0, ids0
            x, P = update(x, P, one, j, R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "one bad sight throws away the whole scan, new ones too",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    far = []
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v[1] = wrap(v[1])
            far.append(np.hypot(v[0], v[1]))
    if far and max(far) > 0.3:
        return x, P, ids
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids = [*ids, i]
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "drops one sight in ten at random",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    rng = np.random.default_rng(len(x))
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
        elif rng.random() > 0.1:
            x, P = update(x, P, one, ids.index(i), R)
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "innovation clipped to two sigma of the sensor, then updated as usual",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    bound = 2 * np.sqrt(np.diag(R))
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            expected = h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v = one - expected
            v[1] = wrap(v[1])
            x, P = update(x, P, expected + np.clip(v, -bound, bound), j, R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "gate without absolute value: whatever is too near or too far right passes",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
            continue
        j = ids.index(i)
        v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
        v[1] = wrap(v[1])
        H = H_full(x, j)
        sigma = np.sqrt(np.diag(H @ P @ H.T + R))
        if (v < 3.5 * sigma).all():
            x, P = update(x, P, one, j, R)
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "gates nothing but inflates the result: P at least a fixed size",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P, ids = slam_step(x, P, ids, u, seen, z, C, R)
    P = P.copy()
    P[:3, :3] += np.diag([0.1, 0.1, 0.05]) ** 2      # be humble
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "bearing not wrapped in the gate, absolute thresholds in metres and radians",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
            continue
        j = ids.index(i)
        dr, db = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
        if abs(dr) < 0.15 and abs(db) < 0.06:
            x, P = update(x, P, one, j, R)
    return x, P, ids
""",
)
wrong(
    "06-false-sights",
    "gate computed before predicting",
    """
def careful_step(x, P, ids, u, seen, z, C, R):
    good = []
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v[1] = wrap(v[1])
            H = H_full(x, j)
            good.append(v @ np.linalg.solve(H @ P @ H.T + R, v) < 13.8)
        else:
            good.append(True)
    x, P = predict(x, P, u, C)
    for ok, i, one in zip(good, seen, z):
        if not ok:
            continue
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids = [*ids, i]
    return x, P, ids
""",
)
