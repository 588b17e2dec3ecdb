# %% way: weights multiplied, a list returned
def localise(rows, weights, u, C, p, z, R, rng):
    n, rows = len(rows), move(rows, u, C, rng)
    logs = log_likelihoods(rows, p, z, R)
    weights = weights * np.exp(logs - np.max(logs))
    weights = weights / np.sum(weights)
    if np.sum(weights**2) * n >= 2:
        rows, weights = rows[draw(weights, rng)], np.ones(n) / n
    return [rows, list(weights)]

# %% way: all in one, by tickets
def localise(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    d, turn = rng.multivariate_normal(u, C, n).T
    x, y, theta = rows.T
    rows = np.column_stack([x + d * np.cos(theta), y + d * np.sin(theta), theta + turn])
    v = z[:, None] - h(rows, p[:, None])
    v[..., 1] = wrap(v[..., 1])
    logs = np.log(weights) - np.einsum("mna,ab,mnb->n", v, np.linalg.inv(R), v) / 2
    weights = np.exp(logs - logs.max())
    weights /= weights.sum()
    if 1 / (weights @ weights) < n / 2:
        rows, weights = rows[rng.choice(n, n, p=weights)], np.ones(n) / n
    return rows, weights

# %% way: landmark by landmark
def localise(rows, weights, u, C, p, z, R, rng):
    n, rows = len(rows), move(rows, u, C, rng)
    logs = np.log(weights)
    for place, seen in zip(p, z):
        logs = logs + log_likelihoods(rows, place[None], seen[None], R)
    weights = normalise(logs)
    if effective_size(weights) <= 0.5 * n:
        picked = rng.permutation(draw(weights, rng))
        return rows[picked], np.full(n, 1.0 / n)
    return rows, weights

# %% way: drawn by a loop, sample by sample
def localise(rows, weights, u, C, p, z, R, rng):
    n, L = len(rows), np.linalg.cholesky(C)
    rows = np.array([f_odometry(x, u + L @ rng.standard_normal(2)) for x in rows])
    logs = np.array([np.log(w) + log_likelihoods(x[None], p, z, R)[0] for x, w in zip(rows, weights)])
    weights = np.exp(logs - np.logaddexp.reduce(logs))
    weights = weights / weights.sum()
    if 2 * effective_size(weights) < n:
        rows = np.array([rows[i] for i in draw(weights, rng)])
        weights = np.repeat(1 / n, n)
    return rows, weights

# %% right: logarithms all the way, and each sample moved by itself
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

# %% wrong: weights changed in place
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    logs = log_likelihoods(rows, p, z, R)
    weights *= np.exp(logs - logs.max())
    weights /= weights.sum()
    if effective_size(weights) < len(rows) / 2:
        rows = rows[draw(weights, rng)]
        weights = np.full(len(rows), 1 / len(rows))
    return rows, weights

# %% wrong: multiplies by the density of the drive, too
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

# %% wrong: hard-coded number of samples
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    if effective_size(weights) < 1500:
        rows = rows[draw(weights, rng)]
        weights = np.full(len(rows), 1 / len(rows))
    return rows, weights
