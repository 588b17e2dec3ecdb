"""Independent answers to 11-localise: right ones, and students' mistakes."""

RIGHT = [
    (
        "11-localise",
        "weights by hand, in logs",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    n = len(weights)
    moved = move(rows, u, C, rng)
    l = np.log(weights) + log_likelihoods(moved, p, z, R)
    l = l - l.max()
    w = np.exp(l)
    w = w / w.sum()
    if 1 / (w @ w) >= n / 2:
        return moved, w
    return moved[draw(w, rng)], np.ones(n) / n
""",
    ),
    (
        "11-localise",
        "likelihood scaled to its maximum before multiplying",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    new = move(rows, u, C, rng)
    logs = log_likelihoods(new, p, z, R) + np.log(weights)
    w = normalise(logs)
    if 2 * effective_size(w) < len(new):
        keep = draw(w, rng)
        new = np.take(new, keep, axis=0)
        w = np.repeat(1.0 / len(new), len(new))
    return new, w
""",
    ),
]

WRONG = [
    (
        "11-localise",
        "weights of the step before are forgotten",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    weights = normalise(log_likelihoods(rows, p, z, R))
    if effective_size(weights) < len(rows) / 2:
        rows = rows[draw(weights, rng)]
        weights = np.full(len(rows), 1 / len(rows))
    return rows, weights
""",
    ),
    (
        "11-localise",
        "weighs before the move",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    logs = np.log(weights) + log_likelihoods(rows, p, z, R)
    rows = move(rows, u, C, rng)
    weights = normalise(logs)
    n = len(rows)
    if effective_size(weights) < n / 2:
        rows, weights = rows[draw(weights, rng)], np.full(n, 1 / n)
    return rows, weights
""",
    ),
    (
        "11-localise",
        "draws when the cloud is worth more than half",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    w = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    if effective_size(w) > len(w) / 2:
        rows = rows[draw(w, rng)]
        w = np.ones(len(w)) / len(w)
    return rows, w
""",
    ),
    (
        "11-localise",
        "draws in every step",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    w = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    return rows[draw(w, rng)], np.full(len(rows), 1 / len(rows))
""",
    ),
    (
        "11-localise",
        "keeps the unequal weights after drawing",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    if effective_size(weights) < len(rows) / 2:
        picked = draw(weights, rng)
        rows, weights = rows[picked], weights[picked] / np.sum(weights[picked])
    return rows, weights
""",
    ),
    (
        "11-localise",
        "likelihoods by exp: 0/0 when all are far off",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    w = weights * np.exp(log_likelihoods(rows, p, z, R))
    w = w / w.sum()
    if effective_size(w) < len(rows) / 2:
        rows = rows[draw(w, rng)]
        w = np.full(len(rows), 1 / len(rows))
    return rows, w
""",
    ),
    (
        "11-localise",
        "weights 1 instead of 1/n after drawing",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    if effective_size(weights) < 0.5 * len(rows):
        rows = rows[draw(weights, rng)]
        weights = np.ones(len(rows))
    return rows, weights
""",
    ),
    (
        "11-localise",
        "one and the same noise for all samples",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    driven = rng.multivariate_normal(u, C)
    rows = np.array([f_odometry(x, driven) for x in rows])
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    if effective_size(weights) < len(rows) / 2:
        rows = rows[draw(weights, rng)]
        weights = np.full(len(rows), 1 / len(rows))
    return rows, weights
""",
    ),
    (
        "11-localise",
        "weights changed in place",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    logs = log_likelihoods(rows, p, z, R)
    weights *= np.exp(logs - logs.max())
    weights /= weights.sum()
    if effective_size(weights) < len(rows) / 2:
        rows = rows[draw(weights, rng)]
        weights = np.full(len(rows), 1 / len(rows))
    return rows, weights
""",
    ),
    (
        "11-localise",
        "effective size of the old weights",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    worth = effective_size(weights)
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    if worth < len(rows) / 2:
        rows = rows[draw(weights, rng)]
        weights = np.full(len(rows), 1 / len(rows))
    return rows, weights
""",
    ),
    (
        "11-localise",
        "adds the weight instead of its logarithm",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    weights = normalise(weights + log_likelihoods(rows, p, z, R))
    if effective_size(weights) < len(rows) / 2:
        rows = rows[draw(weights, rng)]
        weights = np.full(len(rows), 1 / len(rows))
    return rows, weights
""",
    ),
    (
        "11-localise",
        "multiplies by the density of the drive, too",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    new = move(rows, u, C, rng)
    d = np.hypot(new[:, 0] - rows[:, 0], new[:, 1] - rows[:, 1])
    e = np.column_stack([d, wrap(new[:, 2] - rows[:, 2])]) - u
    logs = np.log(weights) + log_likelihoods(new, p, z, R)
    logs = logs - 0.5 * np.sum(e @ np.linalg.pinv(C) * e, axis=1)
    w = normalise(logs)
    if effective_size(w) < len(w) / 2:
        return new[draw(w, rng)], np.full(len(w), 1 / len(w))
    return new, w
""",
    ),
    (
        "11-localise",
        "hard-coded number of samples",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    if effective_size(weights) < 1500:
        rows = rows[draw(weights, rng)]
        weights = np.full(len(rows), 1 / len(rows))
    return rows, weights
""",
    ),
]
