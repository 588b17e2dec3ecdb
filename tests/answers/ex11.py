"""Independent answers to exercise 11: right ones, and students' mistakes."""

RIGHT = [
    (
        "11-weigh",
        "one big broadcast, einsum",
        """
def log_likelihoods(rows, p, z, R):
    v = np.asarray(z, float)[None, :, :] - h(rows[:, None, :], np.asarray(p)[None, :, :])
    v[..., 1] = wrap(v[..., 1])
    return -0.5 * np.einsum("nmi,ij,nmj->n", v, np.linalg.inv(R), v)
""",
    ),
    (
        "11-weigh",
        "loop over samples, solve",
        """
def log_likelihoods(rows, p, z, R):
    out = []
    for x in rows:
        expected = h(x, p)
        dr = z[:, 0] - expected[:, 0]
        db = wrap(z[:, 1] - expected[:, 1])
        v = np.vstack([dr, db])
        out.append(-0.5 * np.sum(v * np.linalg.solve(np.asarray(R, dtype=float), v)))
    return np.array(out)
""",
    ),
    (
        "11-weigh",
        "whitened by Cholesky, arctan2 for wrapping",
        """
def log_likelihoods(rows, p, z, R):
    L = np.linalg.cholesky(R)
    total = np.zeros(rows.shape[0])
    for j in range(len(p)):
        e = h(rows, p[j])
        diff = z[j, 1] - e[:, 1]
        v = np.array([z[j, 0] - e[:, 0], np.arctan2(np.sin(diff), np.cos(diff))])
        white = np.linalg.solve(L, v)
        total = total - (white**2).sum(axis=0) / 2
    return total
""",
    ),
    (
        "11-draw",
        "pointer walking along the rod, as in the textbook",
        """
def draw(weights, rng):
    n = len(weights)
    u = rng.random()
    picked = np.zeros(n, dtype=int)
    i, end = 0, weights[0]
    for k in range(n):
        tooth = (u + k) / n
        while tooth >= end and i < n - 1:
            i += 1
            end += weights[i]
        picked[k] = i
    return picked
""",
    ),
    (
        "11-draw",
        "last end set to one, shuffled order",
        """
def draw(weights, rng):
    ends = np.cumsum(weights)
    ends = ends / ends[-1]
    n = weights.size
    teeth = np.arange(n) / n + rng.random() / n
    rows = np.searchsorted(ends, teeth, side="right")
    return np.clip(rows, 0, n - 1)[::-1]
""",
    ),
    (
        "11-draw",
        "np.digitize",
        """
def draw(weights, rng):
    n = len(weights)
    ends = np.cumsum(weights)
    ends[-1] = 1.0 + 1e-9
    return np.digitize((np.arange(n) + rng.uniform()) / n, ends)
""",
    ),
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
    (
        "11-proposal",
        "vectorised, slogdet",
        """
def reweigh(before, after, weights, u, C, m, D):
    dx, dy = (after[:, :2] - before[:, :2]).T
    th = before[:, 2]
    e = np.stack([np.cos(th) * dx + np.sin(th) * dy, wrap(after[:, 2] - th)], axis=1)
    v, w = e - u, e - m
    target = -0.5 * np.einsum("ni,ij,nj->n", v, np.linalg.inv(C), v)
    drawn = -0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w)
    drawn = drawn - 0.5 * np.linalg.slogdet(D)[1]
    return normalise(np.log(weights) + target - drawn)
""",
    ),
    (
        "11-proposal",
        "helper for the log density, with all constants",
        """
def reweigh(before, after, weights, u, C, m, D):
    def log_gauss(e, mean, cov):
        v = e - mean
        return -0.5 * v @ np.linalg.solve(cov, v) - 0.5 * np.linalg.slogdet(2 * np.pi * cov)[1]

    logs = []
    for a, b, w, mi, Di in zip(before, after, weights, m, D):
        way = b[:2] - a[:2]
        ahead = np.array([np.cos(a[2]), np.sin(a[2])])
        e = np.array([way @ ahead, wrap(float(b[2] - a[2]))])
        logs.append(np.log(w) + log_gauss(e, u, C) - log_gauss(e, mi, Di))
    return normalise(np.array(logs))
""",
    ),
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
        "11-weigh",
        "bearing difference not wrapped",
        """
def log_likelihoods(rows, p, z, R):
    Ri = np.linalg.inv(R)
    logs = np.zeros(len(rows))
    for j in range(len(p)):
        v = z[j] - h(rows, p[j])
        logs += -0.5 * np.einsum("ni,ij,nj->n", v, Ri, v)
    return logs
""",
    ),
    (
        "11-weigh",
        "the half is forgotten",
        """
def log_likelihoods(rows, p, z, R):
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z):
        v = seen - h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        logs -= np.sum(v @ np.linalg.inv(R) * v, axis=1)
    return logs
""",
    ),
    (
        "11-weigh",
        "R itself instead of its inverse",
        """
def log_likelihoods(rows, p, z, R):
    v = z[None] - h(rows[:, None], p[None])
    v[..., 1] = wrap(v[..., 1])
    return -0.5 * np.einsum("nmi,ij,nmj->n", v, R, v)
""",
    ),
    (
        "11-weigh",
        "only the diagonal of R: range and bearing taken as independent",
        """
def log_likelihoods(rows, p, z, R):
    total = np.zeros(len(rows))
    for j, landmark in enumerate(p):
        expected = h(rows, landmark)
        dr = z[j, 0] - expected[:, 0]
        db = wrap(z[j, 1] - expected[:, 1])
        total += -0.5 * (dr**2 / R[0, 0] + db**2 / R[1, 1])
    return total
""",
    ),
    (
        "11-weigh",
        "log of the product of likelihoods: zero far off, -inf",
        """
def log_likelihoods(rows, p, z, R):
    like = np.ones(len(rows))
    for place, seen in zip(p, z):
        v = seen - h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        like *= np.exp(-0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1))
    return np.log(like)
""",
    ),
    (
        "11-weigh",
        "only the last landmark counts: = instead of +=",
        """
def log_likelihoods(rows, p, z, R):
    Rinv = np.linalg.inv(R)
    for j in range(len(p)):
        v = z[j] - h(rows, p[j])
        v[:, 1] = wrap(v[:, 1])
        logs = -0.5 * np.array([vi @ Rinv @ vi for vi in v])
    return logs
""",
    ),
    (
        "11-weigh",
        "wraps the range as well",
        """
def log_likelihoods(rows, p, z, R):
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z):
        v = wrap(seen - h(rows, place))
        logs -= 0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)
    return logs
""",
    ),
    (
        "11-weigh",
        "mean over the landmarks",
        """
def log_likelihoods(rows, p, z, R):
    v = z - h(rows[:, None, :], p)
    v[:, :, 1] = wrap(v[:, :, 1])
    squares = np.einsum("nmi,ij,nmj->nm", v, np.linalg.inv(R), v)
    return -0.5 * squares.mean(axis=1)
""",
    ),
    (
        "11-weigh",
        "array of the rows' type: breaks (truncates) with whole numbers",
        """
def log_likelihoods(rows, p, z, R):
    logs = np.zeros_like(rows[:, 0])
    Ri = np.linalg.inv(R)
    for i, x in enumerate(rows):
        v = z - h(x, p)
        v[:, 1] = wrap(v[:, 1])
        logs[i] = -0.5 * np.sum((v @ Ri) * v)
    return logs
""",
    ),
    (
        "11-weigh",
        "h with all samples and all landmarks at once: pairs row i with landmark i",
        """
def log_likelihoods(rows, p, z, R):
    v = z - h(rows, p)
    v[:, 1] = wrap(v[:, 1])
    return -0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)
""",
    ),
    (
        "11-weigh",
        "Cholesky factor transposed",
        """
def log_likelihoods(rows, p, z, R):
    L = np.linalg.cholesky(R)
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z):
        v = seen - h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        white = np.linalg.solve(L.T, v.T)
        logs -= 0.5 * np.sum(white**2, axis=0)
    return logs
""",
    ),
    (
        "11-weigh",
        "returns the likelihood, not its logarithm",
        """
def log_likelihoods(rows, p, z, R):
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z):
        v = seen - h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        logs -= 0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)
    return np.exp(logs - logs.max())
""",
    ),
    (
        "11-weigh",
        "logs clipped so that exp does not become zero",
        """
def log_likelihoods(rows, p, z, R):
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z):
        v = seen - h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        logs -= 0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)
    return np.maximum(logs, -700)
""",
    ),
    (
        "11-weigh",
        "bearing wrapped into [0, 2 pi)",
        """
def log_likelihoods(rows, p, z, R):
    S = np.linalg.inv(R)
    logs = np.zeros(len(rows))
    for j in range(len(z)):
        v = z[j] - h(rows, p[j])
        v[:, 1] = v[:, 1] % (2 * np.pi)
        logs -= 0.5 * (v * (v @ S)).sum(axis=1)
    return logs
""",
    ),
    (
        "11-draw",
        "a random number for every draw",
        """
def draw(weights, rng):
    n = len(weights)
    return np.minimum(np.searchsorted(np.cumsum(weights), rng.random(n)), n - 1)
""",
    ),
    (
        "11-draw",
        "rng.choice",
        """
def draw(weights, rng):
    return rng.choice(len(weights), size=len(weights), p=weights / np.sum(weights))
""",
    ),
    (
        "11-draw",
        "shifts the comb by u instead of u/n",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = rng.random() + np.arange(n) / n
    return np.minimum(np.searchsorted(np.cumsum(weights), teeth, side="right"), n - 1)
""",
    ),
    (
        "11-draw",
        "teeth where the rod has ended give n",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = (rng.random() + np.arange(n)) / n
    return np.searchsorted(np.cumsum(weights), teeth, side="right")
""",
    ),
    (
        "11-draw",
        "argmax: a tooth past the last end picks sample 0",
        """
def draw(weights, rng):
    n = len(weights)
    ends = np.cumsum(weights)
    u = rng.random()
    return np.array([np.argmax(ends > (u + k) / n) for k in range(n)])
""",
    ),
    (
        "11-draw",
        "stratified: a new random number for each tooth",
        """
def draw(weights, rng):
    n = len(weights)
    ends = np.cumsum(weights)
    picked = []
    for k in range(n):
        tooth = (k + rng.random()) / n
        picked.append(min(np.searchsorted(ends, tooth, side="right"), n - 1))
    return np.array(picked)
""",
    ),
    (
        "11-draw",
        "np.random instead of rng",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = (np.random.random() + np.arange(n)) / n
    return np.minimum(np.searchsorted(np.cumsum(weights), teeth, side="right"), n - 1)
""",
    ),
    (
        "11-draw",
        "no randomness: comb in the middle",
        """
def draw(weights, rng):
    n = len(weights)
    ends = np.cumsum(weights)
    ends[-1] = 1.0
    return np.searchsorted(ends, (np.arange(n) + 0.5) / n, side="right")
""",
    ),
    (
        "11-draw",
        "linspace up to 1: teeth are not 1/n apart",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = np.linspace(rng.random() / n, 1, n)
    return np.clip(np.searchsorted(np.cumsum(weights), teeth, side="right"), 0, n - 1)
""",
    ),
    (
        "11-draw",
        "sorts the weights; indices belong to the sorted ones",
        """
def draw(weights, rng):
    n = len(weights)
    big_first = np.sort(weights)[::-1]
    teeth = (rng.random() + np.arange(n)) / n
    return np.minimum(np.searchsorted(np.cumsum(big_first), teeth, side="right"), n - 1)
""",
    ),
    (
        "11-draw",
        "cumsum written into the argument",
        """
def draw(weights, rng):
    n = len(weights)
    np.cumsum(weights, out=weights)
    weights[-1] = 1.0
    return np.searchsorted(weights, (rng.random() + np.arange(n)) / n, side="right")
""",
    ),
    (
        "11-draw",
        "returns how many copies, not the indices",
        """
def draw(weights, rng):
    n = len(weights)
    ends = np.cumsum(weights)
    copies = np.zeros(n, dtype=int)
    u, i = rng.random(), 0
    for k in range(n):
        while i < n - 1 and (u + k) / n >= ends[i]:
            i += 1
        copies[i] += 1
    return copies
""",
    ),
    (
        "11-draw",
        "rounds n w, fills up with the best: no chance",
        """
def draw(weights, rng):
    n = len(weights)
    copies = np.floor(n * weights).astype(int)
    rest = n - copies.sum()
    best = np.argsort(weights * n - copies)[::-1][:rest]
    copies[best] += 1
    return np.repeat(np.arange(n), copies)
""",
    ),
    (
        "11-draw",
        "off by one: the piece before",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = (rng.random() + np.arange(n)) / n
    return np.maximum(np.searchsorted(np.cumsum(weights), teeth, side="right") - 1, 0)
""",
    ),
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
    (
        "11-proposal",
        "the width of the hill (det D) is forgotten",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    e = np.column_stack([d, wrap(step[:, 2])])
    v, w = e - u, e - m
    logs = np.log(weights) - 0.5 * np.sum(v @ np.linalg.inv(C) * v, axis=1)
    logs = logs + 0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w)
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "ratio upside down",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    e = np.column_stack([d, wrap(step[:, 2])])
    v, w = e - u, e - m
    wheels = -0.5 * np.einsum("ni,ij,nj->n", v, np.linalg.inv(C), v)
    drawn = -0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w) - 0.5 * np.log(np.linalg.det(D))
    return normalise(np.log(weights) + drawn - wheels)
""",
    ),
    (
        "11-proposal",
        "weighs by the wheels' density only",
        """
def reweigh(before, after, weights, u, C, m, D):
    logs = np.log(weights)
    for k in range(len(before)):
        dx, dy, turn = after[k] - before[k]
        d = dx * np.cos(before[k, 2]) + dy * np.sin(before[k, 2])
        v = np.array([d - u[0], wrap(turn) - u[1]])
        logs[k] -= 0.5 * v @ np.linalg.inv(C) @ v
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "turn not wrapped",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    e = np.column_stack([d, step[:, 2]])
    logs = np.log(weights) + 0.5 * np.linalg.slogdet(D)[1]
    for k in range(len(e)):
        v, w = e[k] - u, e[k] - m[k]
        logs[k] += 0.5 * (w @ np.linalg.solve(D[k], w) - v @ np.linalg.solve(C, v))
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "distance by hypot: driving backwards becomes forwards",
        """
def reweigh(before, after, weights, u, C, m, D):
    d = np.hypot(*(after - before)[:, :2].T)
    e = np.column_stack([d, wrap(after[:, 2] - before[:, 2])])
    v, w = e - u, e - m
    logs = np.log(weights) - 0.5 * np.einsum("ni,ij,nj->n", v, np.linalg.inv(C), v)
    logs += 0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w) + 0.5 * np.linalg.slogdet(D)[1]
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "heading after the turn taken for the drive",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, after[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    e = np.column_stack([d, wrap(step[:, 2])])
    v, w = e - u, e - m
    logs = np.log(weights) - 0.5 * np.einsum("ni,ij,nj->n", v, np.linalg.inv(C), v)
    logs += 0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w) + 0.5 * np.linalg.slogdet(D)[1]
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "given weights are ignored",
        """
def reweigh(before, after, weights, u, C, m, D):
    logs = np.zeros(len(before))
    Ci = np.linalg.inv(C)
    for k in range(len(before)):
        dx, dy = after[k, :2] - before[k, :2]
        c, s = np.cos(before[k, 2]), np.sin(before[k, 2])
        e = np.array([c * dx + s * dy, wrap(after[k, 2] - before[k, 2])])
        v, w = e - u, e - m[k]
        logs[k] = 0.5 * (w @ np.linalg.inv(D[k]) @ w - v @ Ci @ v + np.log(np.linalg.det(D[k])))
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "densities, not their logarithms: 0/0 far off",
        """
def reweigh(before, after, weights, u, C, m, D):
    def density(e, mean, cov):
        v = e - mean
        return np.exp(-0.5 * v @ np.linalg.inv(cov) @ v) / np.sqrt(np.linalg.det(cov))

    out = np.zeros(len(before))
    for k in range(len(before)):
        dx, dy, turn = after[k] - before[k]
        d = dx * np.cos(before[k, 2]) + dy * np.sin(before[k, 2])
        e = np.array([d, wrap(turn)])
        out[k] = weights[k] * density(e, u, C) / density(e, m[k], D[k])
    return out / out.sum()
""",
    ),
    (
        "11-proposal",
        "det without the square root",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    e = np.column_stack([d, wrap(step[:, 2])])
    logs = np.log(weights)
    for k in range(len(e)):
        v, w = e[k] - u, e[k] - m[k]
        logs[k] += 0.5 * (w @ np.linalg.inv(D[k]) @ w - v @ np.linalg.inv(C) @ v)
        logs[k] += np.log(np.linalg.det(D[k]))
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "D of the first sample for all",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    e = np.column_stack([
        step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta), wrap(step[:, 2])])
    v, w = e - u, e - m
    logs = np.log(weights) - 0.5 * np.sum(v @ np.linalg.inv(C) * v, axis=1)
    logs += 0.5 * np.sum(w @ np.linalg.inv(D[0]) * w, axis=1)
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "drive from dx / cos: breaks when it heads along y",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    e = np.column_stack([step[:, 0] / np.cos(theta), wrap(step[:, 2])])
    v, w = e - u, e - m
    logs = np.log(weights) - 0.5 * np.sum(v @ np.linalg.inv(C) * v, axis=1)
    logs += 0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w)
    logs += 0.5 * np.log(np.linalg.det(D))
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "given weights multiplied in place",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    e = np.column_stack([d, wrap(step[:, 2])])
    v, w = e - u, e - m
    logs = 0.5 * np.linalg.slogdet(D)[1] - 0.5 * np.sum(v @ np.linalg.inv(C) * v, axis=1)
    logs += 0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w)
    weights *= np.exp(logs - logs.max())
    return weights / weights.sum()
""",
    ),
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
