"""A fourth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "11-weigh",
        "whitened by Cholesky, one landmark at a time",
        """
def log_likelihoods(rows, p, z, R):
    L = np.linalg.cholesky(R)
    total = np.zeros(len(rows))
    for mark, sight in zip(p, z):
        v = np.array([sight - h(np.asarray(x, float), mark) for x in rows])
        v[:, 1] = wrap(v[:, 1])
        total -= 0.5 * (np.linalg.solve(L, v.T) ** 2).sum(axis=0)
    return total
""",
    ),
    (
        "11-draw",
        "teeth walked along the rod",
        """
def draw(weights, rng):
    n = len(weights)
    u, i, end, out = rng.random() / n, 0, weights[0], []
    for k in range(n):
        while u + k / n >= end and i < n - 1:
            i += 1
            end += weights[i]
        out.append(i)
    out = np.array(out)
    return np.where(weights[out] > 0, out, np.argmax(weights))
""",
    ),
]

WRONG = [
    (
        "11-weigh",
        "the likelihood and then its logarithm",
        """
def log_likelihoods(rows, p, z, R):
    out = np.ones(len(rows))
    W = np.linalg.inv(R)
    for mark, sight in zip(p, z):
        v = sight - h(rows.astype(float), mark)
        v[:, 1] = wrap(v[:, 1])
        out *= np.exp(-0.5 * np.einsum("ij,jk,ik->i", v, W, v))
    return np.log(out)
""",
    ),
    (
        "11-weigh",
        "R's diagonal only",
        """
def log_likelihoods(rows, p, z, R):
    out = np.zeros(len(rows))
    for mark, sight in zip(p, z):
        v = sight - h(rows.astype(float), mark)
        v[:, 1] = wrap(v[:, 1])
        out -= 0.5 * (v[:, 0] ** 2 / R[0, 0] + v[:, 1] ** 2 / R[1, 1])
    return out
""",
    ),
    (
        "11-weigh",
        "only the first landmark",
        """
def log_likelihoods(rows, p, z, R):
    v = z[0] - h(rows.astype(float), p[0])
    v[:, 1] = wrap(v[:, 1])
    return -0.5 * np.einsum("ij,jk,ik->i", v, np.linalg.inv(R), v)
""",
    ),
    (
        "11-weigh",
        "writes into an array of whole numbers",
        """
def log_likelihoods(rows, p, z, R):
    W = np.linalg.inv(R)
    out = np.zeros(len(rows))
    for i, x in enumerate(rows):
        v = np.zeros_like(z)
        v[:] = z - h(x, p)
        v[:, 1] = wrap(v[:, 1])
        out[i] = -0.5 * np.sum(v @ W * v)
    return out
""",
    ),
    (
        "11-draw",
        "a random tooth each",
        """
def draw(weights, rng):
    return rng.choice(len(weights), len(weights), p=weights / weights.sum())
""",
    ),
    (
        "11-draw",
        "the comb begins at 0",
        """
def draw(weights, rng):
    n = len(weights)
    return np.searchsorted(np.cumsum(weights), np.arange(n) / n)
""",
    ),
    (
        "11-draw",
        "shift from 0 to 1",
        """
def draw(weights, rng):
    n = len(weights)
    return np.minimum(np.searchsorted(np.cumsum(weights), (np.arange(n) + rng.random()) % n / n + rng.random()), n - 1)
""",
    ),
    (
        "11-draw",
        "the end of the rod is missed",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = (np.arange(n) + rng.random()) / n
    return np.searchsorted(np.cumsum(weights)[:-1], teeth, side="left") - 1
""",
    ),
    (
        "11-localise",
        "weights not multiplied by the old ones",
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
        "weights survive the drawing",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    if effective_size(weights) < len(rows) / 2:
        rows = rows[draw(weights, rng)]
    return rows, weights
""",
    ),
    (
        "11-localise",
        "draws always",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    rows = rows[draw(weights, rng)]
    return rows, np.full(len(rows), 1 / len(rows))
""",
    ),
    (
        "11-proposal",
        "the ratio upside down",
        """
def reweigh(before, after, weights, u, C, m, D):
    step = after[:, :2] - before[:, :2]
    d = step[:, 0] * np.cos(before[:, 2]) + step[:, 1] * np.sin(before[:, 2])
    us = np.column_stack([d, wrap(after[:, 2] - before[:, 2])])
    def log(v, S):
        S = np.broadcast_to(S, (len(v), 2, 2))
        return -0.5 * np.einsum("ni,nij,nj->n", v, np.linalg.inv(S), v) - 0.5 * np.log(np.linalg.det(S))
    return normalise(np.log(weights) + log(us - m, D) - log(us - u, C))
""",
    ),
    (
        "11-proposal",
        "determinants forgotten",
        """
def reweigh(before, after, weights, u, C, m, D):
    step = after[:, :2] - before[:, :2]
    d = step[:, 0] * np.cos(before[:, 2]) + step[:, 1] * np.sin(before[:, 2])
    us = np.column_stack([d, wrap(after[:, 2] - before[:, 2])])
    def log(v, S):
        S = np.broadcast_to(S, (len(v), 2, 2))
        return -0.5 * np.einsum("ni,nij,nj->n", v, np.linalg.inv(S), v)
    return normalise(np.log(weights) + log(us - u, C) - log(us - m, D))
""",
    ),
    (
        "11-proposal",
        "the way's length, always ahead",
        """
def reweigh(before, after, weights, u, C, m, D):
    step = after[:, :2] - before[:, :2]
    us = np.column_stack([np.hypot(*step.T), wrap(after[:, 2] - before[:, 2])])
    def log(v, S):
        S = np.broadcast_to(S, (len(v), 2, 2))
        return -0.5 * np.einsum("ni,nij,nj->n", v, np.linalg.inv(S), v) - 0.5 * np.log(np.linalg.det(S))
    return normalise(np.log(weights) + log(us - u, C) - log(us - m, D))
""",
    ),
    (
        "11-kidnapped",
        "localise itself",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    return localise(rows, weights, u, C, p, z, R, rng)
""",
    ),
]
