"""Right ways of 11-localise."""

WAYS = {
    "weights multiplied, a list returned": """
def localise(rows, weights, u, C, p, z, R, rng):
    n, rows = len(rows), move(rows, u, C, rng)
    logs = log_likelihoods(rows, p, z, R)
    weights = weights * np.exp(logs - np.max(logs))
    weights = weights / np.sum(weights)
    if np.sum(weights**2) * n >= 2:
        rows, weights = rows[draw(weights, rng)], np.ones(n) / n
    return [rows, list(weights)]
""",
    "all in one, by tickets": """
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
""",
    "landmark by landmark": """
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
""",
    "drawn by a loop, sample by sample": """
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
""",
}
