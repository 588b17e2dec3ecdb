# %% way: Joseph's form
def update(x, P, z, j, R):
    v = z - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
    v[1] = wrap(v[1])
    H = H_full(x, j)
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    keep = np.eye(len(x)) - K @ H
    return x + K @ v, keep @ P @ keep.T + K @ R @ K.T

# %% way: information
def update(x, P, z, j, R):
    v = z - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
    v[1] = (v[1] + np.pi) % (2 * np.pi) - np.pi
    H, Y, W = H_full(x, j), np.linalg.inv(P), np.linalg.inv(R)
    P = np.linalg.inv(Y + H.T @ W @ H)
    return x + P @ H.T @ W @ v, P

# %% way: Cholesky
def update(x, P, z, j, R):
    x, P = x.copy(), P.copy()
    v = z - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
    v[1] = np.arctan2(np.sin(v[1]), np.cos(v[1]))
    H = H_full(x, j)
    root = np.linalg.cholesky(H @ P @ H.T + R)
    B = np.linalg.solve(root, H @ P).T
    x += B @ np.linalg.solve(root, v)
    P -= B @ B.T
    x[2] = np.arctan2(np.sin(x[2]), np.cos(x[2]))
    return [x, P]

# %% way: (I − K H) P
def update(x, P, z, j, R):
    v = z - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
    v[1] = wrap(v[1])
    H = H_full(x, j)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return x + K @ v, (np.eye(len(x)) - K @ H) @ P

# %% way: H by differences
def update(x, P, z, j, R):
    at = 3 + 2 * j
    seen = lambda s: h(s[:3], s[at : at + 2])
    columns = []
    for e in 1e-6 * np.eye(len(x)):
        d = seen(x + e) - seen(x - e)
        columns.append([d[0] / 2e-6, wrap(d[1]) / 2e-6])
    H = np.array(columns).T
    v = z - seen(x)
    v = np.array([v[0], wrap(v[1])])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.pinv(S)
    return x + K @ v, P - K @ H @ P

# %% right: Cholesky of S, no gain formed, heading left unwrapped
def update(x, P, z, j, R):
    where = 3 + 2 * j
    H = H_full(x, j)
    predicted = h(x[:3], x[where:where + 2])
    turn = z[1] - predicted[1]
    v = np.array([z[0] - predicted[0], np.arctan2(np.sin(turn), np.cos(turn))])
    L = np.linalg.cholesky(H @ P @ H.T + R)
    B = np.linalg.solve(L, H @ P)          # (2, n)
    return x + B.T @ np.linalg.solve(L, v), P - B.T @ B

# %% right: five columns only, solve, (I - K H) P, made symmetric
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

# %% wrong: only robot and the seen landmark
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

# %% wrong: S without R in the gain only
def update(x, P, z, j, R):
    a = 3 + 2 * j
    H = H_full(x, j)
    v = z - h(x[:3], x[a : a + 2])
    v[1] = wrap(v[1])
    S = H @ P @ H.T
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ (S + R) @ K.T

# %% wrong: wraps on one side only
def update(x, P, z, j, R):
    v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
    if v[1] > np.pi:
        v[1] -= 2 * np.pi
    H = H_full(x, j)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T

# %% wrong: wraps the whole state
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return wrap(x + K @ v), P - K @ S @ K.T

# %% wrong: innovation overwrites z
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = z
    v -= h(x[:3], x[3 + 2 * j:5 + 2 * j])
    v[1] = wrap(v[1])
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return x + K @ v, P - K @ H @ P

# %% wrong: P - K H
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
    v[1] = wrap(v[1])
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return x + K @ v, P - K @ H

# %% wrong: S taken for diagonal
def update(x, P, z, j, R):
    H = H_full(x, j)
    v = z - h(x[:3], x[3 + 2 * j:5 + 2 * j])
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T / np.diag(S)
    return x + K @ v, P - K @ S @ K.T
