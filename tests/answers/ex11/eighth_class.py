"""An eighth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = []

WRONG = [
    (
        "11-weigh",
        "all samples at once, and the bearing wrapped on the wrong axis",
        """
def log_likelihoods(rows, p, z, R):
    v = np.array([z - h(x, p) for x in rows])
    v[:, -1] = wrap(v[:, -1])
    return -0.5 * np.einsum("ijk,kl,ijl->i", v, np.linalg.inv(R), v)
""",
    ),
    (
        "11-draw",
        "copies by rounding, and the rest from the heaviest",
        """
def draw(weights, rng):
    n = len(weights)
    copies = np.rint(n * weights).astype(int)
    while copies.sum() > n:
        copies[np.argmax(copies)] -= 1
    while copies.sum() < n:
        copies[np.argmax(weights)] += 1
    return np.repeat(np.arange(n), copies)
""",
    ),
    (
        "11-localise",
        "after drawing the samples are moved once more, so that copies part",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    if effective_size(weights) < len(rows) / 2:
        rows = move(rows[draw(weights, rng)], np.zeros(2), C, rng)
        weights = np.full(len(rows), 1 / len(rows))
    return rows, weights
""",
    ),
    (
        "11-kidnapped",
        "localise, and strangers only when the likelihood was low twice in a row, kept in a global",
        """
low = {"before": False}

def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    rows = move(rows, u, C, rng)
    logs = log_likelihoods(rows, p, z, R)
    bad = logs.max() < -10
    if bad and low["before"]:
        around = rng.uniform(-np.pi, np.pi, n)
        at = p[0] - z[0, 0] * np.column_stack([np.cos(around), np.sin(around)])
        rows = np.column_stack([at, wrap(around - z[0, 1])])
        weights = np.full(n, 1 / n)
        bad = False
    elif not bad:
        weights = normalise(np.log(weights + 1e-300) + logs)
        if effective_size(weights) < n / 2:
            rows, weights = rows[draw(weights, rng)], np.full(n, 1 / n)
    low["before"] = bad
    return rows, weights
""",
    ),
]
