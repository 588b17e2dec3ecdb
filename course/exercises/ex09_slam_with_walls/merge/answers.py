# %% way: wall j in the form of wall i first
def merge(x, P, i, j):
    a, b, n = 3 + 2 * i, 3 + 2 * j, len(x)
    F, y = np.eye(n), x.copy()
    if np.cos(x[a + 1] - x[b + 1]) < 0:
        F[b, b] = -1
        y[b] = -x[b]
        y[b + 1] = x[b + 1] - np.pi
    Q = F @ P @ F
    D = Q[a : a + 2] - Q[b : b + 2]
    S = D[:, a : a + 2] - D[:, b : b + 2]
    gap = y[a : a + 2] - y[b : b + 2]
    gap[1] = wrap(gap[1])
    y = y - D.T @ np.linalg.solve(S, gap)
    Q = Q - D.T @ np.linalg.solve(S, D)
    keep = [k for k in range(n) if k not in (b, b + 1)]
    return gap @ np.linalg.inv(S) @ gap, y[keep], Q[keep][:, keep]

# %% way: least squares over the merged state
def merge(x, P, i, j):
    n, a, b = len(x), 3 + 2 * i, 3 + 2 * j
    M, start = np.eye(n), np.zeros(n)
    M[b : b + 2] = M[a : a + 2]
    if abs(wrap(x[a + 1] - x[b + 1])) > np.pi / 2:
        M[b] = -M[b]
        start[b + 1] = np.pi
    M = np.delete(M, [b, b + 1], axis=1)
    y = x - start
    y[b + 1] = x[a + 1] + wrap(y[b + 1] - x[a + 1])
    W = np.linalg.inv(P)
    Q = np.linalg.inv(M.T @ W @ M)
    m = Q @ M.T @ W @ y
    rest = y - M @ m
    return rest @ W @ rest, m, Q

# %% right: the form is the one with the smaller d2
def merge(x, P, i, j):
    n, best = len(x), None
    ri, rj = 3 + 2 * i, 3 + 2 * j
    for s in (1.0, -1.0):
        G = np.zeros((2, n))
        G[0, ri], G[1, ri + 1], G[0, rj], G[1, rj + 1] = 1, 1, -s, -1
        e = x[rj + 1] + (np.pi if s < 0 else 0) - x[ri + 1]
        v = np.array([s * x[rj] - x[ri], np.arctan2(np.sin(e), np.cos(e))])
        S = G @ P @ G.T
        d2 = v @ np.linalg.inv(S) @ v
        if best is None or d2 < best[0]:
            best = d2, G, v, S
    d2, G, v, S = best
    K = np.linalg.solve(S, G @ P).T
    A = np.eye(n) - K @ G
    x, P = x + K @ v, A @ P @ A.T
    out = np.r_[rj, rj + 1]
    return float(d2), np.delete(x, out), np.delete(np.delete(P, out, 0), out, 1)

# %% right: one number after the other, without noise
def merge(x, P, i, j):
    x, P = np.array(x), np.array(P)
    ri, rj = 3 + 2 * i, 3 + 2 * j
    same = np.cos(x[ri + 1] - x[rj + 1]) > 0
    if not same:
        x[rj], x[rj + 1] = -x[rj], x[rj + 1] + np.pi
        P[rj] *= -1
        P[:, rj] *= -1
    x[rj + 1] = x[ri + 1] + wrap(x[rj + 1] - x[ri + 1])
    d2 = 0
    for k in (0, 1):
        v = x[rj + k] - x[ri + k]
        c = P[:, rj + k] - P[:, ri + k]
        s = c[rj + k] - c[ri + k]
        d2 += v**2 / s
        x, P = x - c * v / s, P - np.outer(c, c) / s
    keep = np.ones(len(x), bool)
    keep[rj : rj + 2] = False
    return d2, x[keep], P[keep][:, keep]

# %% right: lines as unit normals, compared by sine and dot product; Lagrange multipliers
def merge(x, P, i, j):
    n = len(x)
    a, b = 3 + 2 * i, 3 + 2 * j
    u, w = (np.array([np.cos(t), np.sin(t)]) for t in (x[a + 1], x[b + 1]))
    s = np.sign(u @ w)
    w = s * w
    angle = np.arctan2(u[0] * w[1] - u[1] * w[0], u @ w)
    c = np.array([s * x[b] - x[a], angle])
    A = np.zeros((2, n))
    A[0, a], A[1, a + 1], A[0, b], A[1, b + 1] = -1, -1, s, 1
    W = np.linalg.inv(P)
    KKT = np.block([[W, A.T], [A, np.zeros((2, 2))]])
    step = np.linalg.solve(KKT, np.concatenate([np.zeros(n), -c]))[:n]
    Q = np.linalg.inv(KKT)[:n, :n]
    keep = [k for k in range(n) if k != b and k != b + 1]
    return step @ W @ step, (x + step)[keep], Q[np.ix_(keep, keep)]

# %% wrong: by 100 000 samples of the state
def merge(x, P, i, j):
    rng = np.random.default_rng(1)
    X = rng.multivariate_normal(x, P, 100_000)
    a, b = 3 + 2 * i, 3 + 2 * j
    s = 1 if np.cos(x[a + 1] - x[b + 1]) > 0 else -1
    D = np.column_stack([s * X[:, b] - X[:, a], wrap(X[:, b + 1] - X[:, a + 1] + (np.pi if s < 0 else 0))])
    S, d = np.cov(D.T), D.mean(axis=0)
    K = (X - x).T @ (D - d) / len(X) @ np.linalg.inv(S)
    X = X - D @ K.T
    keep = np.delete(np.arange(len(x)), [b, b + 1])
    return d @ np.linalg.inv(S) @ d, X.mean(axis=0)[keep], np.cov(X.T)[np.ix_(keep, keep)]
