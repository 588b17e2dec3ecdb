"""Independent answers to 06-update: right ones, and students' mistakes."""

RIGHT = [
    (
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
    ),
    (
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
    ),
    (
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
    ),
]

WRONG = [
    (
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
    ),
    (
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
    ),
    (
        "06-update",
        "wraps the range's difference, too",
        """
def update(x, P, z, j, R):
    v = wrap(z - h(x[:3], x[3 + 2 * j:5 + 2 * j]))
    H = H_full(x, j)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return x + K @ v, (np.eye(len(x)) - K @ H) @ P
""",
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
]
