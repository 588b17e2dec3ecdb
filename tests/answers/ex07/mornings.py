"""Independent answers to 07-mornings: right ones, and students' mistakes."""

RIGHT = [
    (
        "07-mornings",
        "restricted likelihood on a grid of sizes",
        """
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
""",
    ),
    (
        "07-mornings",
        "average over the grid of sizes, by their likelihood",
        """
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
""",
    ),
]

WRONG = [
    (
        "07-mornings",
        "the plain way: mean and sigma^2 / count",
        """
def survey(morning, door, z, sigma):
    n = np.bincount(door)
    return np.bincount(door, z) / n, np.diag(sigma**2 / n)
""",
    ),
    (
        "07-mornings",
        "size of the shared error fixed at 10 sigma",
        """
def survey(morning, door, z, sigma):
    A = np.eye(door.max() + 1)[door]
    V = sigma**2 * (np.eye(len(z)) + 100.0 * (morning[:, None] == morning))
    W = np.linalg.inv(V)
    P = np.linalg.inv(A.T @ W @ A)
    return P @ A.T @ W @ z, P
""",
    ),
    (
        "07-mornings",
        "size of the shared error fixed at sigma",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning]])
    prior = np.diag(np.r_[np.zeros(m), np.ones(n)]) / sigma**2
    C = np.linalg.inv(J.T @ J / sigma**2 + prior)
    return (C @ J.T @ z / sigma**2)[:m], C[:m, :m]
""",
    ),
    (
        "07-mornings",
        "mornings' errors free but summing to zero: absolute place too sure",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.zeros((len(z) + 1, m + n))
    J[np.arange(len(z)), door] = 1
    J[np.arange(len(z)), m + morning] = 1
    J[-1, m:] = 1
    N = np.linalg.inv(J.T @ J)
    state = N @ J.T @ np.append(z, 0)
    return state[:m], sigma**2 * N[:m, :m]
""",
    ),
    (
        "07-mornings",
        "first morning taken as exact",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning][:, 1:]])
    C = np.linalg.inv(J.T @ J)
    return (C @ J.T @ z)[:m], sigma**2 * C[:m, :m]
""",
    ),
    (
        "07-mornings",
        "good p, but P cut down to its diagonal",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning]])
    size = 10 * sigma
    for _ in range(10):
        C = np.linalg.inv(J.T @ J / sigma**2 + np.diag([0.0] * m + [size**-2] * n))
        s = C @ J.T @ z / sigma**2
        size = np.sqrt(np.mean(s[m:] ** 2 + np.diag(C)[m:]))
    return s[:m], np.diag(np.diag(C)[:m])
""",
    ),
    (
        "07-mornings",
        "shared error taken as more noise of each reading",
        """
def survey(morning, door, z, sigma):
    n = np.bincount(door)
    p = np.bincount(door, z) / n
    rest = z - p[door]
    free = max(len(z) - len(n), 1)
    total = max(np.sum(rest**2) / free, sigma**2)
    return p, np.diag(total / n)
""",
    ),
    (
        "07-mornings",
        "size from the estimated errors alone, their doubt forgotten: it shrinks",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning]])
    var = (3 * sigma) ** 2
    for _ in range(30):
        Y = J.T @ J / sigma**2
        Y[m:, m:] += np.eye(n) / var
        C = np.linalg.inv(Y)
        s = C @ (J.T @ z) / sigma**2
        var = max(np.mean(s[m:] ** 2), 1e-6 * sigma**2)
    return s[:m], C[:m, :m]
""",
    ),
    (
        "07-mornings",
        "mornings aligned one after the other to the map so far, sigma^2 / count",
        """
def survey(morning, door, z, sigma):
    m = door.max() + 1
    total, count = np.zeros(m), np.zeros(m)
    waiting = list(range(morning.max() + 1))
    k = waiting.pop(0)
    sel = morning == k
    total[door[sel]] += z[sel]
    count[door[sel]] += 1
    while waiting:
        k = next(w for w in waiting if np.any(count[door[morning == w]] > 0))
        waiting.remove(k)
        sel = morning == k
        dd, zz = door[sel], z[sel]
        known = count[dd] > 0
        off = np.mean(zz[known] - total[dd[known]] / count[dd[known]])
        total[dd] += zz - off
        count[dd] += 1
    return total / count, np.diag(sigma**2 / count)
""",
    ),
    (
        "07-mornings",
        "sigma taken for a variance",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning]])
    v = 100 * sigma
    for _ in range(8):
        C = np.linalg.inv(J.T @ J / sigma + np.diag(np.r_[np.zeros(m), np.full(n, 1 / v)]))
        s = C @ J.T @ z / sigma
        v = np.mean(s[m:] ** 2 + np.diag(C)[m:])
    return s[:m], C[:m, :m]
""",
    ),
    (
        "07-mornings",
        "the doors get a prior at 0 as well",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning]])
    size = 10 * sigma
    for _ in range(8):
        C = np.linalg.inv(J.T @ J / sigma**2 + np.eye(m + n) / size**2)
        state = C @ J.T @ z / sigma**2
        size = np.sqrt(np.mean(state[m:] ** 2 + np.diag(C)[m:]))
    return state[:m], C[:m, :m]
""",
    ),
    (
        "07-mornings",
        "works for the example only: 3 readings each morning, 8 doors",
        """
def survey(morning, door, z, sigma):
    A = np.eye(8)[door]
    best = (np.inf,)
    for size in np.geomspace(0.5, 20, 40) * sigma:
        block = sigma**2 * np.eye(3) + size**2 * np.ones((3, 3))
        V = np.kron(np.eye(len(z) // 3), block)
        W = np.linalg.inv(V)
        P = np.linalg.inv(A.T @ W @ A)
        p = P @ A.T @ W @ z
        e = z - A @ p
        cost = e @ W @ e + np.linalg.slogdet(V)[1] - np.linalg.slogdet(P)[1]
        if cost < best[0]:
            best = cost, p, P
    return best[1:]
""",
    ),
    (
        "07-mornings",
        "means of the readings, with a huge covariance to be safe",
        """
def survey(morning, door, z, sigma):
    m = door.max() + 1
    p = np.array([z[door == j].mean() for j in range(m)])
    return p, (20 * sigma) ** 2 * np.eye(m)
""",
    ),
    (
        "07-mornings",
        "each morning's mean subtracted, then the doors' means",
        """
def survey(morning, door, z, sigma):
    off = np.array([z[morning == k].mean() for k in range(morning.max() + 1)])
    centred = z - off[morning] + z.mean()
    n = np.bincount(door)
    return np.bincount(door, centred) / n, np.diag(sigma**2 / n)
""",
    ),
    (
        "07-mornings",
        "one pass: size from residuals against plain means, doors' part not taken out",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    p0 = np.bincount(door, z) / np.bincount(door)
    off = np.bincount(morning, z - p0[door]) / np.bincount(morning)
    size = max(np.std(off), 0.5 * sigma)
    A = np.eye(m)[door]
    V = sigma**2 * np.eye(len(z)) + size**2 * (morning[:, None] == morning[None])
    P = np.linalg.inv(A.T @ np.linalg.solve(V, A))
    return P @ A.T @ np.linalg.solve(V, z), P
""",
    ),
    (
        "07-mornings",
        "filter with the correlations between doors dropped after each morning",
        """
def survey(morning, door, z, sigma):
    m = door.max() + 1
    size = 5 * sigma
    p, v = np.zeros(m), np.full(m, 1e6)
    for k in range(morning.max() + 1):
        d = door[morning == k]
        R = sigma**2 * np.eye(len(d)) + size**2
        Pd = np.diag(v[d])
        K = Pd @ np.linalg.inv(Pd + R)
        p[d] = p[d] + K @ (z[morning == k] - p[d])
        v[d] = np.diag(Pd - K @ Pd)
    return p, np.diag(v)
""",
    ),
    (
        "07-mornings",
        "wrong block of C returned (the mornings' when their number fits)",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(n)[morning], np.eye(m)[door]])
    size = 10 * sigma
    for _ in range(8):
        known = np.r_[np.full(n, 1 / size**2), np.zeros(m)]
        C = np.linalg.inv(J.T @ J / sigma**2 + np.diag(known))
        s = C @ J.T @ z / sigma**2
        size = np.sqrt(np.mean(s[:n] ** 2 + np.diag(C)[:n]))
    return s[-m:], C[:m, :m]
""",
    ),
    (
        "07-mornings",
        "cheat: says that it knows nothing",
        """
def survey(morning, door, z, sigma):
    m = door.max() + 1
    return np.full(m, z.mean()), np.eye(m) * 1e6
""",
    ),
    (
        "07-mornings",
        "good ways between doors, size treated as infinite (tiny prior): absolute claims useless",
        """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning]])
    weak = np.r_[np.zeros(m), np.full(n, 1 / (1000 * sigma) ** 2)]
    C = np.linalg.inv(J.T @ J / sigma**2 + np.diag(weak))
    return (C @ J.T @ z / sigma**2)[:m], C[:m, :m]
""",
    ),
]
