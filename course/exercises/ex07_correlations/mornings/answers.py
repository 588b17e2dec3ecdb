# %% way: likelihood
def survey(morning, door, z, sigma):
    on = np.eye(morning.max() + 1)[morning]
    J = np.eye(door.max() + 1)[door]
    found = []
    for size in sigma * np.geomspace(0.5, 20, 9):
        V = sigma**2 * np.eye(len(z)) + size**2 * on @ on.T
        W = np.linalg.inv(V)
        P = np.linalg.inv(J.T @ W @ J)
        p = P @ J.T @ W @ z
        r = z - J @ p
        L = r @ W @ r + np.linalg.slogdet(V)[1] - np.linalg.slogdet(P)[1]
        found.append((L, p, P))
    L, p, P = (np.array(list(parts)) for parts in zip(*found))
    share = np.exp(-(L - L.min()) / 2)
    share /= share.sum()
    mean = share @ p
    off = p - mean
    return mean, np.einsum("g,gij->ij", share, P + off[:, :, None] * off[:, None, :])

# %% way: two rounds
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1

    def fit(size):
        W = np.zeros((m + n, m + n))
        for i, j in zip(door, m + morning):
            for a in (i, j):
                for b in (i, j):
                    W[a, b] += 1 / sigma**2
        W[range(m, m + n), range(m, m + n)] += 1 / size**2
        C = np.linalg.inv(W)
        told = np.r_[np.bincount(door, z), np.bincount(morning, z)] / sigma**2
        return C @ told, C

    x, C = fit(1000 * sigma)  # first as if they could be anything
    M = np.eye(n) - 1 / n
    known = np.trace(M @ C[m:, m:] @ M)
    square = (x[m:] @ M @ x[m:] - known) / (n - 1)
    x, C = fit(np.sqrt(max(square, sigma**2 / 4)))
    return x[:m], C[:m, :m]

# %% way: differences and means
def survey(morning, door, z, sigma):
    # the mornings' means are taken off: what is left knows no shift, but only the ways
    m, n = door.max() + 1, morning.max() + 1
    J, on = np.eye(m)[door], np.eye(n)[morning]
    inside = on / on.sum(axis=0) @ on.T
    least = np.linalg.pinv(J.T @ (J - inside @ J)) @ J.T @ (z - inside @ z)
    shifts = np.array([np.mean((z - least[door])[morning == k]) for k in range(n)])
    counts = on.sum(axis=0)
    square = max(np.var(shifts, ddof=1) - np.mean(sigma**2 / counts), sigma**2 / 4)
    V = sigma**2 * np.eye(len(z)) + square * on @ on.T
    P = np.linalg.inv(J.T @ np.linalg.solve(V, J))
    return P @ J.T @ np.linalg.solve(V, z), P

# %% way: a filter over the mornings
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1

    def filtered(size):
        x, P = np.zeros(m + n), np.diag(np.r_[np.full(m, 1e4), np.full(n, size**2)])
        for k in range(len(z)):
            H = np.zeros(m + n)
            H[door[k]] = H[m + morning[k]] = 1
            K = P @ H / (H @ P @ H + sigma**2)
            x = x + K * (z[k] - H @ x)
            P = P - np.outer(K, H @ P)
        return x, P

    size = 5 * sigma
    for _ in range(3):
        x, P = filtered(size)
        size = np.sqrt(np.mean(x[m:] ** 2 + np.diag(P)[m:]))
    return x[:m].tolist(), P[:m, :m].tolist()

# %% pasted: each door fused by itself
def survey(morning, door, z, sigma):
    m = door.max() + 1
    p, P = np.zeros(m), np.full(m, np.inf)
    for k, i in enumerate(door):
        K = 1 if np.isinf(P[i]) else P[i] / (P[i] + sigma**2)
        p[i], P[i] = p[i] + K * (z[k] - p[i]), sigma**2 if K == 1 else P[i] - K * P[i]
    return p, np.diag(P)

# %% pasted: a filter in one dimension, a robot that stays
def survey(morning, door, z, sigma):
    m = door.max() + 1
    x, P = np.zeros(1 + m), np.diag(np.r_[0.0, np.full(m, 1e4)])
    for k in range(len(z)):
        if k and morning[k] != morning[k - 1]:
            pass
        H = np.zeros(1 + m)
        H[0], H[1 + door[k]] = -1, 1
        K = P @ H / (H @ P @ H + sigma**2)
        x, P = x + K * (z[k] - H @ x), P - np.outer(K, H @ P)
    return x[1:], P[1:, 1:]

# %% pasted: a filter in one dimension, forgetting
def survey(morning, door, z, sigma):
    m = door.max() + 1
    x, P = np.zeros(1 + m), np.diag(np.r_[0.0, np.full(m, 1e4)])
    for k in range(len(z)):
        if k and morning[k] != morning[k - 1]:
            P = np.diag(np.diag(P))
        H = np.zeros(1 + m)
        H[0], H[1 + door[k]] = -1, 1
        K = P @ H / (H @ P @ H + sigma**2)
        x, P = x + K * (z[k] - H @ x), P - np.outer(K, H @ P)
    return x[1:], P[1:, 1:]

# %% pasted: covariance intersection
def survey(morning, door, z, sigma):
    p = np.bincount(door, z) / np.bincount(door)
    return p, sigma**2 * np.eye(len(p))

# %% right: restricted likelihood on a grid of sizes
def survey(morning, door, z, sigma):
    A = np.eye(door.max() + 1)[door]
    same = (morning[:, None] == morning[None, :]).astype(float)
    best = None
    for size in sigma * np.geomspace(0.5, 20, 60):
        V = sigma**2 * np.eye(len(z)) + size**2 * same
        V_inv = np.linalg.inv(V)
        N = A.T @ V_inv @ A
        P = np.linalg.inv(N)
        p = P @ A.T @ V_inv @ z
        e = z - A @ p
        cost = np.linalg.slogdet(V)[1] + np.linalg.slogdet(N)[1] + e @ V_inv @ e
        if best is None or cost < best[0]:
            best = cost, p, P
    return best[1], best[2]

# %% right: average over the grid of sizes, by their likelihood
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    A, B = np.eye(m)[door], np.eye(n)[morning]
    logs, means, covs = [], [], []
    for size in sigma * np.geomspace(0.5, 20, 50):
        V = sigma**2 * np.eye(len(z)) + size**2 * B @ B.T
        N = A.T @ np.linalg.solve(V, A)
        P = np.linalg.inv(N)
        p = P @ (A.T @ np.linalg.solve(V, z))
        e = z - A @ p
        logs.append(-0.5 * (np.linalg.slogdet(V)[1] + np.linalg.slogdet(N)[1] + e @ np.linalg.solve(V, e)))
        means.append(p)
        covs.append(P)
    w = np.exp(np.array(logs) - max(logs))
    w /= w.sum()
    means = np.array(means)
    p = w @ means
    P = np.einsum("g,gij->ij", w, np.array(covs))
    spread = means - p
    return p, P + np.einsum("g,gi,gj->ij", w, spread, spread)

# %% right: generalised least squares, the variance by maximum likelihood over a grid
def survey(morning, door, z, sigma):
    A = np.eye(door.max() + 1)[door]
    same = (morning[:, None] == morning[None, :]).astype(float)
    best = None
    for tau in sigma * np.geomspace(0.3, 30, 120):
        V = sigma**2 * np.eye(len(z)) + tau**2 * same
        W = np.linalg.inv(V)
        N = A.T @ W @ A
        p = np.linalg.solve(N, A.T @ W @ z)
        e = z - A @ p
        cost = np.linalg.slogdet(V)[1] + np.linalg.slogdet(N)[1] + e @ W @ e
        if best is None or cost < best[0]:
            best = cost, p, np.linalg.inv(N)
    return best[1], best[2]

# %% wrong: mornings' errors free but summing to zero: absolute place too sure
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.zeros((len(z) + 1, m + n))
    J[np.arange(len(z)), door] = 1
    J[np.arange(len(z)), m + morning] = 1
    J[-1, m:] = 1
    N = np.linalg.inv(J.T @ J)
    state = N @ J.T @ np.append(z, 0)
    return state[:m], sigma**2 * N[:m, :m]

# %% wrong: common errors of eight sigma in every corridor
def survey(morning, door, z, sigma):
    A = np.eye(door.max() + 1)[door]
    same = morning[:, None] == morning[None, :]
    W = np.linalg.inv(sigma**2 * np.eye(len(z)) + (8 * sigma) ** 2 * same)
    P = np.linalg.inv(A.T @ W @ A)
    return P @ A.T @ W @ z, P

# %% wrong: cheat: says that it knows nothing
def survey(morning, door, z, sigma):
    m = door.max() + 1
    return np.full(m, z.mean()), np.eye(m) * 1e6
