"""Independent answers to 11-kidnapped: right ones, and students' mistakes."""

RIGHT = [
    (
        "11-kidnapped",
        "strangers on the ring as a second population, density of the ring divided out",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    rate = 0.01
    old = move(rows, u, C, rng)
    k = n // 2
    # poses that could have made the sighting
    reading = rng.multivariate_normal(z[0], R, k)
    phi = rng.uniform(0, 2 * np.pi, k)
    new = np.empty((k, 3))
    new[:, 0] = p[0, 0] + reading[:, 0] * np.cos(phi)
    new[:, 1] = p[0, 1] + reading[:, 0] * np.sin(phi)
    new[:, 2] = wrap(phi + np.pi - reading[:, 1])
    ok = (np.abs(new[:, 0]) <= ROOM[0] / 2) & (np.abs(new[:, 1]) <= ROOM[1] / 2)
    norm = 1 / (2 * np.pi * np.sqrt(np.linalg.det(R)))
    like = 0.9 * norm * np.exp(log_likelihoods(old, p, z, R)) + 0.1 / (10 * 2 * np.pi)
    w_old = (1 - rate) * weights / np.sum(weights) * like
    prior = 1 / (10 * 8 * 2 * np.pi)
    # importance: prior * likelihood / ring density, ring density = likelihood / (2 pi r)
    w_new = rate * 0.9 * prior * 2 * np.pi * np.abs(reading[:, 0]) * ok / k
    w = np.concatenate([w_old, w_new])
    w = w / w.sum()
    every = np.concatenate([old, new])
    teeth = (rng.random() + np.arange(n)) / n
    rows_picked = np.minimum(np.searchsorted(np.cumsum(w), teeth, side="right"), len(w) - 1)
    return every[rows_picked], np.full(n, 1 / n)
""",
    ),
    (
        "11-kidnapped",
        "ring strangers, multinomial draw, a little roughening",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    moved = move(rows, u, C, rng)
    r, b = rng.multivariate_normal(z[0], R, n).T
    a = rng.uniform(-np.pi, np.pi, n)
    ring = np.column_stack([p[0, 0] + r * np.cos(a), p[0, 1] + r * np.sin(a), wrap(a + np.pi - b)])
    in_room = (np.abs(ring[:, 0]) < 5) & (np.abs(ring[:, 1]) < 4) & (r > 0)
    peak = 1 / (2 * np.pi * np.sqrt(np.linalg.det(R)))
    w_cloud = weights * (0.9 * peak * np.exp(log_likelihoods(moved, p, z, R)) + 0.1 / 20 / np.pi)
    w_ring = 0.02 * 0.9 * in_room * r / 80 / n
    w = np.concatenate([w_cloud, w_ring])
    picked = rng.choice(2 * n, n, p=w / w.sum())
    out = np.concatenate([moved, ring])[picked]
    out[:, :2] += rng.normal(0, 0.01, (n, 2))
    return out, np.full(n, 1 / n)
""",
    ),
]

WRONG = [
    (
        "11-kidnapped",
        "localise and nothing else",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    return localise(rows, weights, u, C, p, z, R, rng)
""",
    ),
    (
        "11-kidnapped",
        "only moves: sightings ignored",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    return move(rows, u, C, rng), weights.copy()
""",
    ),
    (
        "11-kidnapped",
        "all samples onto the ring in every step",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    r, b = rng.multivariate_normal(z[0], R, n).T
    a = rng.uniform(-np.pi, np.pi, n)
    ring = np.column_stack([p[0, 0] + r * np.cos(a), p[0, 1] + r * np.sin(a), wrap(a + np.pi - b)])
    return ring, np.full(n, 1 / n)
""",
    ),
    (
        "11-kidnapped",
        "the lesson's strangers, anywhere, five in a hundred",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    rows, weights = localise(rows, weights, u, C, p, z, R, rng)
    k = len(rows) // 20
    new = rows.copy()
    some = rng.choice(len(rows), k, replace=False)
    new[some] = rng.uniform([-5, -4, -np.pi], [5, 4, np.pi], (k, 3))
    return new, weights
""",
    ),
    (
        "11-kidnapped",
        "one odd sighting throws the whole cloud onto the ring",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    moved = move(rows, u, C, rng)
    logs = log_likelihoods(moved, p, z, R)
    if logs.max() < -10:
        r, b = rng.multivariate_normal(z[0], R, n).T
        a = rng.uniform(-np.pi, np.pi, n)
        ring = np.column_stack(
            [p[0, 0] + r * np.cos(a), p[0, 1] + r * np.sin(a), wrap(a + np.pi - b)])
        return ring, np.full(n, 1 / n)
    w = normalise(np.log(weights) + logs)
    if effective_size(w) < n / 2:
        moved, w = moved[draw(w, rng)], np.full(n, 1 / n)
    return moved, w
""",
    ),
    (
        "11-kidnapped",
        "ghosts in the likelihood, but no strangers",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    rows = move(rows, u, C, rng)
    norm = 1 / (2 * np.pi * np.sqrt(np.linalg.det(R)))
    like = 0.9 * norm * np.exp(log_likelihoods(rows, p, z, R)) + 0.1 / (REACH * 2 * np.pi)
    w = weights * like
    w = w / w.sum()
    if effective_size(w) < n / 2:
        rows, w = rows[draw(w, rng)], np.full(n, 1 / n)
    return rows, w
""",
    ),
    (
        "11-kidnapped",
        "returns more samples than it got",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    rows, weights = localise(rows, weights, u, C, p, z, R, rng)
    k = 60
    strangers = rng.uniform([-5, -4, -np.pi], [5, 4, np.pi], (k, 3))
    n = len(rows) + k
    return np.vstack([rows, strangers]), np.concatenate([weights * len(rows) / n, np.full(k, 1 / n)])
""",
    ),
    (
        "11-kidnapped",
        "ring with a wrong heading (half a turn forgotten)",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    n, carried = len(rows), 0.01
    rows = move(rows, u, C, rng)
    r, beta = rng.multivariate_normal(z[0], R, n).T
    angle = rng.uniform(-np.pi, np.pi, n)
    strangers = np.column_stack(
        [p[0, 0] + r * np.cos(angle), p[0, 1] + r * np.sin(angle), wrap(angle - beta)])
    inside = np.all(np.abs(strangers[:, :2]) < ROOM / 2, axis=1)
    real = np.exp(log_likelihoods(rows, p, z, R)) / (2 * np.pi * np.sqrt(np.linalg.det(R)))
    seen = 0.9 * real + 0.1 / (REACH * 2 * np.pi)
    odd = 0.9 * inside * np.abs(r) / np.prod(ROOM) / n
    every = np.concatenate([(1 - carried) * weights * seen, carried * odd])
    picked = draw(every / every.sum(), rng)[::2]
    return np.vstack([rows, strangers])[picked], np.full(n, 1 / n)
""",
    ),
    (
        "11-kidnapped",
        "a fifth of the cloud onto the ring, always, with equal weights",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    rows, weights = localise(rows, weights, u, C, p, z, R, rng)
    k = n // 5
    r, b = rng.multivariate_normal(z[0], R, k).T
    a = rng.uniform(-np.pi, np.pi, k)
    ring = np.column_stack([p[0, 0] + r * np.cos(a), p[0, 1] + r * np.sin(a), wrap(a + np.pi - b)])
    keep = draw(weights, rng)[rng.permutation(n)[: n - k]]
    return np.vstack([rows[keep], ring]), np.full(n, 1 / n)
""",
    ),
    (
        "11-kidnapped",
        "puts strangers into the array it was given",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    k = n // 10
    rows[:] = move(rows, u, C, rng)
    rows[:k] = rng.uniform([-5, -4, -np.pi], [5, 4, np.pi], (k, 3))
    w = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    return rows[draw(w, rng)], np.full(n, 1 / n)
""",
    ),
    (
        "11-kidnapped",
        "the middle of the room, constant",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    return np.zeros((len(rows), 3)), np.full(len(rows), 1 / len(rows))
""",
    ),
    (
        "11-kidnapped",
        "all over the room anew in each step, best ones kept",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    anywhere = rng.uniform([-5, -4, -np.pi], [5, 4, np.pi], (20 * n, 3))
    logs = log_likelihoods(anywhere, p, z, R)
    best = np.argsort(logs)[-n:]
    return anywhere[best], normalise(logs[best])
""",
    ),
    (
        "11-kidnapped",
        "returns logarithms for weights",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    w = np.log(np.abs(weights) + 1e-300) + log_likelihoods(rows, p, z, R)
    return rows, w - w.max()
""",
    ),
]
