"""A seventh class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "11-localise",
        "logarithms all the way, and each sample moved by itself",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    noise = rng.standard_normal((n, 2)) @ np.linalg.cholesky(C + 1e-300 * np.eye(2)).T
    rows = np.array([f_odometry(x, u + e) for x, e in zip(rows, noise)])
    rows[:, 2] = wrap(rows[:, 2])
    logs = np.log(weights) + log_likelihoods(rows, p, z, R)
    top = logs.max()
    logs = logs - top - np.log(np.exp(logs - top).sum())
    weights = np.exp(logs)
    if 2 * effective_size(weights) < n:
        return rows[draw(weights, rng)], np.full(n, 1.0 / n)
    return rows, weights
""",
    ),
    (
        "11-weigh",
        "whitened by Cholesky, one landmark at a time",
        """
def log_likelihoods(rows, p, z, R):
    L = np.linalg.cholesky(np.asarray(R, dtype=float))
    total = np.zeros(len(rows))
    for landmark, seen in zip(np.asarray(p, dtype=float), np.asarray(z, dtype=float)):
        v = seen - h(np.asarray(rows, dtype=float), landmark)
        v[:, 1] = (v[:, 1] + np.pi) % (2 * np.pi) - np.pi
        w = np.linalg.solve(L, v.T)
        total -= (w**2).sum(axis=0) / 2
    return total
""",
    ),
]

WRONG = [
    (
        "11-weigh",
        "compared as points in the robot's frame, with R as it is",
        """
def log_likelihoods(rows, p, z, R):
    W, logs = np.linalg.inv(R), []
    seen = z[:, :1] * np.column_stack([np.cos(z[:, 1]), np.sin(z[:, 1])])
    for x in rows:
        c, s = np.cos(x[2]), np.sin(x[2])
        local = (p - x[:2]) @ np.array([[c, -s], [s, c]])
        v = seen - local
        logs.append(-0.5 * np.sum((v @ W) * v))
    return np.array(logs)
""",
    ),
    (
        "11-weigh",
        "likelihoods multiplied, with a floor so that the logarithm exists",
        """
def log_likelihoods(rows, p, z, R):
    W, out = np.linalg.inv(R), []
    for x in rows:
        v = z - h(x, p)
        v[:, 1] = wrap(v[:, 1])
        q = np.exp(-0.5 * np.sum(v @ W * v, axis=1))
        out.append(np.sum(np.log(q + 1e-300)))
    return np.array(out)
""",
    ),
    (
        "11-draw",
        "tournament: a sample is taken with the probability of its weight over the largest",
        """
def draw(weights, rng):
    n, picked = len(weights), []
    top = weights.max()
    while len(picked) < n:
        i = rng.integers(n)
        if rng.random() < weights[i] / top:
            picked.append(i)
    return np.array(picked)
""",
    ),
    (
        "11-draw",
        "the wheel: random start, and each step random up to twice the largest weight",
        """
def draw(weights, rng):
    n = len(weights)
    i, beta, picked = int(rng.integers(n)), 0.0, []
    for _ in range(n):
        beta += rng.random() * 2 * weights.max()
        while beta > weights[i]:
            beta -= weights[i]
            i = (i + 1) % n
        picked.append(i)
    return np.array(picked)
""",
    ),
    (
        "11-localise",
        "drawn anew, and the old weights handed on with the drawn rows",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    if effective_size(weights) < len(rows) / 2:
        picked = draw(weights, rng)
        rows, weights = rows[picked], weights[picked]
        weights = weights / weights.sum()
    return rows, weights
""",
    ),
    (
        "11-localise",
        "weighed where the samples were before the drive",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    logs = np.log(weights) + log_likelihoods(rows, p, z, R)
    rows = move(rows, u, C, rng)
    weights = normalise(logs)
    if effective_size(weights) < 0.5 * len(weights):
        rows = rows[draw(weights, rng)]
        weights = np.full(len(rows), 1 / len(rows))
    return rows, weights
""",
    ),
    (
        "11-proposal",
        "the drive as if it turned first",
        """
def reweigh(before, after, weights, u, C, m, D):
    def log_normal(v, S):
        return -0.5 * v @ np.linalg.solve(S, v) - 0.5 * np.linalg.slogdet(S)[1]
    logs = []
    for x, y, w, mi, Di in zip(before, after, weights, m, D):
        e = y[:2] - x[:2]
        d = e @ [np.cos(y[2]), np.sin(y[2])]
        drive = np.array([d, wrap(y[2] - x[2])])
        logs.append(np.log(w) + log_normal(drive - u, C) - log_normal(drive - mi, Di))
    return normalise(np.array(logs))
""",
    ),
    (
        "11-kidnapped",
        "all samples thrown onto the ring of the sighting when none explains it",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    rows, weights = localise(rows, np.maximum(weights, 1e-12), u, C, p, z, R, rng)
    off = log_likelihoods(rows, p, z, R)
    if off.max() < -8:
        around = rng.uniform(-np.pi, np.pi, n)
        r = z[0, 0] + np.sqrt(R[0, 0]) * rng.standard_normal(n)
        rows = np.column_stack(
            [p[0, 0] - r * np.cos(around), p[0, 1] - r * np.sin(around), wrap(around - z[0, 1])]
        )
        weights = np.full(n, 1 / n)
    return rows, weights
""",
    ),
]
