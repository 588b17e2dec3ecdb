"""A ninth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "11-weigh",
        "all at once: whitened by the Cholesky factor of R, angle by atan2, own h",
        """
def log_likelihoods(rows, p, z, R):
    rows, p, z, R = (np.asarray(a, dtype=float) for a in (rows, p, z, R))
    dx = p[None, :, 0] - rows[:, None, 0]
    dy = p[None, :, 1] - rows[:, None, 1]
    vr = z[None, :, 0] - np.sqrt(dx**2 + dy**2)
    t = z[None, :, 1] - np.arctan2(dy, dx) + rows[:, None, 2]
    vb = np.arctan2(np.sin(t), np.cos(t))
    L = np.linalg.cholesky(R)
    a = vr / L[0, 0]
    b = (vb - L[1, 0] * a) / L[1, 1]
    return -0.5 * (a * a + b * b).sum(axis=1)
""",
    ),
    (
        "11-draw",
        "the comb is shifted round a ring: a number from 0 to 1 plus k/n, modulo 1; pieces walked through in a loop",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = np.sort((rng.random() + np.arange(n) / n) % 1.0)
    ends = np.cumsum(weights)
    last = np.flatnonzero(np.asarray(weights) > 0)[-1]
    picked, i = [], 0
    for tooth in teeth:
        while i < last and tooth >= ends[i]:
            i += 1
        picked.append(i)
    return np.array(picked)
""",
    ),
    (
        "11-proposal",
        "vectorised with slogdet and solve, complete logarithms of both densities",
        """
def reweigh(before, after, weights, u, C, m, D):
    c, s = np.cos(before[:, 2]), np.sin(before[:, 2])
    dx, dy = after[:, 0] - before[:, 0], after[:, 1] - before[:, 1]
    turn = after[:, 2] - before[:, 2]
    e = np.stack([c * dx + s * dy, np.arctan2(np.sin(turn), np.cos(turn))], axis=1)

    def log_density(v, S):
        q = np.einsum("ni,ni->n", v, np.linalg.solve(S, v[:, :, None])[:, :, 0])
        return -0.5 * (q + np.linalg.slogdet(S)[1])

    Cs = np.broadcast_to(C, D.shape)
    logs = np.log(weights) + log_density(e - u, Cs) - log_density(e - m, D)
    return normalise(logs)
""",
    ),
]

WRONG = [
    (
        "11-weigh",
        "the difference of bearings is not wrapped",
        """
def log_likelihoods(rows, p, z, R):
    inverse = np.linalg.inv(R)
    out = np.zeros(len(rows))
    for i, x in enumerate(rows):
        for zj, pj in zip(z, p):
            d = pj - x[:2]
            v = zj - np.array([np.hypot(d[0], d[1]), np.arctan2(d[1], d[0]) - x[2]])
            out[i] += -0.5 * v @ inverse @ v
    return out
""",
    ),
    (
        "11-weigh",
        "likelihoods are multiplied and the logarithm is taken at the end: -inf for samples far off",
        """
def log_likelihoods(rows, p, z, R):
    like = np.ones(len(rows))
    Ri = np.linalg.inv(R)
    for place, seen in zip(p, z):
        v = seen - h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        like = like * np.exp(-0.5 * np.einsum("ni,ij,nj->n", v, Ri, v))
    return np.log(like)
""",
    ),
    (
        "11-weigh",
        "only the variances of R are used: range and bearing never err together",
        """
def log_likelihoods(rows, p, z, R):
    var_r, var_b = R[0, 0], R[1, 1]
    dx = p[:, 0] - rows[:, [0]]
    dy = p[:, 1] - rows[:, [1]]
    dr = z[:, 0] - np.hypot(dx, dy)
    db = wrap(z[:, 1] - np.arctan2(dy, dx) + rows[:, [2]])
    return -0.5 * np.sum(dr**2 / var_r + db**2 / var_b, axis=1)
""",
    ),
    (
        "11-weigh",
        "wraps the whole difference, so a range that is off by more than pi metres is wrapped too",
        """
def log_likelihoods(rows, p, z, R):
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z):
        v = wrap(seen - h(rows, place))
        logs += -0.5 * np.sum((v @ np.linalg.inv(R)) * v, axis=1)
    return logs
""",
    ),
    (
        "11-weigh",
        "the factor one half of the exponent is forgotten",
        """
def log_likelihoods(rows, p, z, R):
    total = 0
    for j in range(len(p)):
        v = z[j] - h(rows, p[j])
        v[:, 1] = wrap(v[:, 1])
        total = total - np.sum(v * np.linalg.solve(R, v.T).T, axis=1)
    return total
""",
    ),
    (
        "11-weigh",
        "mean over the landmarks instead of the sum",
        """
def log_likelihoods(rows, p, z, R):
    W = np.linalg.inv(R)

    def one(x):
        v = z - h(x, p)
        v[:, 1] = wrap(v[:, 1])
        return np.mean([-0.5 * w @ W @ w for w in v])

    return np.array([one(x) for x in rows])
""",
    ),
    (
        "11-weigh",
        "differences are stored in an array like z: whole numbers cut them off",
        """
def log_likelihoods(rows, p, z, R):
    Ri = np.linalg.inv(R)
    logs = np.empty(len(rows))
    for i in range(len(rows)):
        v = np.zeros_like(z)
        d = p - rows[i, :2]
        v[:, 0] = z[:, 0] - np.hypot(d[:, 0], d[:, 1])
        v[:, 1] = wrap(z[:, 1] - np.arctan2(d[:, 1], d[:, 0]) + rows[i, 2])
        logs[i] = -0.5 * np.sum((v @ Ri) * v)
    return logs
""",
    ),
    (
        "11-draw",
        "n independent draws (rng.choice) instead of a comb with one random number",
        """
def draw(weights, rng):
    w = weights / np.sum(weights)
    return rng.choice(len(w), size=len(w), p=w)
""",
    ),
    (
        "11-draw",
        "every tooth is shifted by a random number of its own (stratified)",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = (np.arange(n) + rng.random(n)) / n
    ends = np.cumsum(weights)
    ends[-1] = 1.0
    return np.searchsorted(ends, teeth, side="right").clip(max=n - 1)
""",
    ),
    (
        "11-draw",
        "no guard at the end of the rod: where rounding leaves it below one, index n comes out",
        """
def draw(weights, rng):
    n = len(weights)
    start = rng.uniform(0, 1 / n)
    return np.searchsorted(np.cumsum(weights), start + np.arange(n) / n, side="right")
""",
    ),
    (
        "11-draw",
        "the first tooth is shifted by a number from 0 to 1 (not 1/n); teeth beyond the end all take the last sample",
        """
def draw(weights, rng):
    n = len(weights)
    ends, picked, i = np.cumsum(weights), [], 0
    first = rng.random()
    for k in range(n):
        tooth = first + k / n
        while i < n - 1 and ends[i] < tooth:
            i += 1
        picked.append(i)
    return np.array(picked)
""",
    ),
    (
        "11-draw",
        "the teeth are 1/(n-1) apart (linspace with its end)",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = np.linspace(0, 1, n) + rng.random() / n
    return np.minimum(np.searchsorted(np.cumsum(weights), teeth), n - 1)
""",
    ),
    (
        "11-draw",
        "the comb stands fixed in the middle of its places: nothing is random",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = (np.arange(n) + 0.5) / n
    out = []
    c = np.cumsum(weights)
    for t in teeth:
        out.append(min(int(np.sum(c <= t)), n - 1))
    return np.array(out)
""",
    ),
    (
        "11-draw",
        "weights are sorted before the comb, and the places in the sorted order are returned as indices",
        """
def draw(weights, rng):
    n = len(weights)
    w = np.sort(weights)[::-1]
    teeth = (rng.random() + np.arange(n)) / n
    return np.minimum(np.searchsorted(np.cumsum(w), teeth, side="right"), n - 1)
""",
    ),
    (
        "11-localise",
        "the old weights are forgotten: only the likelihood counts",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    new = move(rows, u, C, rng)
    w = normalise(log_likelihoods(new, p, z, R))
    if effective_size(w) < n / 2:
        return new[draw(w, rng)], np.ones(n) / n
    return new, w
""",
    ),
    (
        "11-localise",
        "after drawing anew the weights are not made equal but drawn along",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    moved = move(rows, u, C, rng)
    w = normalise(np.log(weights) + log_likelihoods(moved, p, z, R))
    if 1 / np.sum(w**2) < 0.5 * len(w):
        picked = draw(w, rng)
        moved, w = moved[picked], w[picked]
        w = w / w.sum()
    return moved, w
""",
    ),
    (
        "11-localise",
        "draws anew in every step, whatever the effective size",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    logs = log_likelihoods(rows, p, z, R) + np.log(weights)
    picked = draw(normalise(logs), rng)
    return rows[picked], np.full(len(rows), 1 / len(rows))
""",
    ),
    (
        "11-localise",
        "draws anew when the cloud is worth MORE than half its samples",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    enough = effective_size(weights) < len(rows) / 2
    if not enough:
        rows = rows[draw(weights, rng)]
        weights = np.full(len(rows), 1 / len(rows))
    return rows, weights
""",
    ),
    (
        "11-localise",
        "weights by exp without taking the largest logarithm off: 0/0 where all samples are metres off",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    weights = weights * np.exp(log_likelihoods(rows, p, z, R))
    weights = weights / weights.sum()
    if effective_size(weights) < len(rows) / 2:
        rows = rows[draw(weights, rng)]
        weights = np.full(len(rows), 1 / len(rows))
    return rows, weights
""",
    ),
    (
        "11-localise",
        "all samples drive the same u without noise",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    moved = np.array([f_odometry(x, u) for x in rows])
    moved[:, 2] = wrap(moved[:, 2])
    w = normalise(np.log(weights) + log_likelihoods(moved, p, z, R))
    if effective_size(w) < len(w) / 2:
        return moved[draw(w, rng)], np.full(len(w), 1 / len(w))
    return moved, w
""",
    ),
    (
        "11-localise",
        "weighs the samples where they stood before the drive, then moves them",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    w = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    rows = move(rows, u, C, rng)
    if effective_size(w) < len(rows) / 2:
        rows = rows[draw(w, rng)]
        w = np.full(len(rows), 1 / len(rows))
    return rows, w
""",
    ),
    (
        "11-localise",
        "one draw of the wheels' noise for all samples instead of one for each",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    d, turn = rng.multivariate_normal(u, C)
    x, y, t = rows[:, 0], rows[:, 1], rows[:, 2]
    new = np.stack([x + d * np.cos(t), y + d * np.sin(t), wrap(t + turn)], axis=1)
    w = normalise(np.log(weights) + log_likelihoods(new, p, z, R))
    if effective_size(w) < len(new) / 2:
        new, w = new[draw(w, rng)], np.full(len(new), 1 / len(new))
    return new, w
""",
    ),
    (
        "11-proposal",
        "the ratio is upside down: density of the drawing over that of the wheels",
        """
def reweigh(before, after, weights, u, C, m, D):
    step = after - before
    d = step[:, 0] * np.cos(before[:, 2]) + step[:, 1] * np.sin(before[:, 2])
    e = np.column_stack([d, wrap(step[:, 2])])
    logs = np.log(weights)
    for i in range(len(e)):
        a, b = e[i] - u, e[i] - m[i]
        logs[i] += 0.5 * a @ np.linalg.solve(C, a) - 0.5 * b @ np.linalg.solve(D[i], b)
        logs[i] -= 0.5 * np.log(np.linalg.det(D[i]))
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "the determinants of D_i are left out: narrow and wide hills count alike",
        """
def reweigh(before, after, weights, u, C, m, D):
    delta = after[:, :2] - before[:, :2]
    forward = np.column_stack([np.cos(before[:, 2]), np.sin(before[:, 2])])
    e = np.column_stack([np.sum(delta * forward, axis=1), wrap(after[:, 2] - before[:, 2])])
    v, w = e - u, e - m
    top = np.einsum("ni,ij,nj->n", v, np.linalg.inv(C), v)
    bottom = np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w)
    return normalise(np.log(weights) - 0.5 * top + 0.5 * bottom)
""",
    ),
    (
        "11-proposal",
        "log of the determinant without the root: the whole of log det D_i instead of half of it",
        """
def reweigh(before, after, weights, u, C, m, D):
    theta = before[:, 2]
    dx, dy, dt = (after - before).T
    e = np.column_stack([dx * np.cos(theta) + dy * np.sin(theta), wrap(dt)])

    def log_gauss(v, S):
        return -0.5 * v @ np.linalg.inv(S) @ v - np.log(np.linalg.det(S))

    logs = [np.log(weights[i]) + log_gauss(e[i] - u, C) - log_gauss(e[i] - m[i], D[i]) for i in range(len(e))]
    return normalise(np.array(logs))
""",
    ),
    (
        "11-proposal",
        "distance as the length of the step: a drive backwards counts as one forwards",
        """
def reweigh(before, after, weights, u, C, m, D):
    step = after - before
    e = np.column_stack([np.hypot(step[:, 0], step[:, 1]), wrap(step[:, 2])])
    logs = np.log(weights)
    for k in range(len(e)):
        v, w = e[k] - u, e[k] - m[k]
        logs[k] += 0.5 * (w @ np.linalg.inv(D[k]) @ w - v @ np.linalg.inv(C) @ v)
        logs[k] += 0.5 * np.linalg.slogdet(D[k])[1]
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "densities themselves are divided: 0/0 where samples lie many sigma off",
        """
def reweigh(before, after, weights, u, C, m, D):
    def gauss(v, S):
        return np.exp(-0.5 * v @ np.linalg.solve(S, v)) / np.sqrt(np.linalg.det(2 * np.pi * S))

    new = []
    for x0, x1, w, mi, Di in zip(before, after, weights, m, D):
        d = (x1[0] - x0[0]) * np.cos(x0[2]) + (x1[1] - x0[1]) * np.sin(x0[2])
        drive = np.array([d, wrap(x1[2] - x0[2])])
        new.append(w * gauss(drive - u, C) / gauss(drive - mi, Di))
    new = np.array(new)
    return new / new.sum()
""",
    ),
    (
        "11-proposal",
        "the turn after minus before is not wrapped: wrong where it crosses pi",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    e = np.column_stack([step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta), step[:, 2]])
    Ci = np.linalg.inv(C)
    logs = np.log(weights)
    for k, drive in enumerate(e):
        a, b = drive - u, drive - m[k]
        logs[k] += -0.5 * a @ Ci @ a + 0.5 * b @ np.linalg.inv(D[k]) @ b + 0.5 * np.log(np.linalg.det(D[k]))
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "only the wheels' density is multiplied in; nothing is divided by that of the drawing",
        """
def reweigh(before, after, weights, u, C, m, D):
    c, s = np.cos(before[:, 2]), np.sin(before[:, 2])
    diff = after - before
    v = np.column_stack([c * diff[:, 0] + s * diff[:, 1], wrap(diff[:, 2])]) - u
    logs = np.log(weights) - 0.5 * np.sum(v @ np.linalg.inv(C) * v, axis=1)
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "the drive's distance is measured along the heading AFTER the turn",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, after[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    e = np.column_stack([d, wrap(step[:, 2])])
    logs = np.log(weights)
    for k in range(len(e)):
        v, w = e[k] - u, e[k] - m[k]
        logs[k] += 0.5 * (w @ np.linalg.inv(D[k]) @ w - v @ np.linalg.inv(C) @ v)
        logs[k] += 0.5 * np.log(np.linalg.det(D[k]))
    return normalise(logs)
""",
    ),
    (
        "11-kidnapped",
        "just localise: no strangers at all, the cloud never finds a robot that was carried off",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    return localise(rows, weights, u, C, p, z, R, rng)
""",
    ),
    (
        "11-kidnapped",
        "a tenth of the samples is thrown anywhere in the room each step, as in the lesson: too few to hit, and false sightings are trusted",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    rows = move(rows, u, C, rng)
    k = n // 10
    lost = rng.choice(n, k, replace=False)
    rows[lost, 0] = rng.uniform(-ROOM[0] / 2, ROOM[0] / 2, k)
    rows[lost, 1] = rng.uniform(-ROOM[1] / 2, ROOM[1] / 2, k)
    rows[lost, 2] = rng.uniform(-np.pi, np.pi, k)
    w = normalise(np.log(weights + 1e-12) + log_likelihoods(rows, p, z, R))
    return rows[draw(w, rng)], np.full(n, 1 / n)
""",
    ),
    (
        "11-kidnapped",
        "the whole cloud is thrown on the ring round the post as soon as a sighting is odd: every false sighting leads it astray",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    rows = move(rows, u, C, rng)
    logs = log_likelihoods(rows, p, z, R)
    if logs.max() < -8:
        r, b = rng.multivariate_normal(z[0], R, n).T
        a = rng.uniform(-np.pi, np.pi, n)
        x, y = p[0, 0] + r * np.cos(a), p[0, 1] + r * np.sin(a)
        return np.column_stack([x, y, wrap(a + np.pi - b)]), np.full(n, 1 / n)
    w = normalise(np.log(weights) + logs)
    if effective_size(w) < n / 2:
        return rows[draw(w, rng)], np.full(n, 1 / n)
    return rows, w
""",
    ),
    (
        "11-kidnapped",
        "false sightings are allowed for by a floor under the likelihood, but there are no strangers: a carried robot stays lost",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    rows = move(rows, u, C, rng)
    like = np.exp(log_likelihoods(rows, p, z, R)) / (2 * np.pi * np.sqrt(np.linalg.det(R)))
    w = weights * ((1 - GHOSTS) * like + GHOSTS / (REACH * 2 * np.pi))
    w = w / w.sum()
    if effective_size(w) < n / 2:
        return rows[draw(w, rng)], np.full(n, 1 / n)
    return rows, w
""",
    ),
    (
        "11-kidnapped",
        "strangers on the ring look away from the post: the heading lacks half a turn",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    k = n // 10
    rows = move(rows, u, C, rng)
    like = np.exp(log_likelihoods(rows, p, z, R)) / (2 * np.pi * np.sqrt(np.linalg.det(R)))
    w = weights * (0.9 * like + 0.1 / (2 * np.pi * REACH))
    keep = draw(w / w.sum(), rng)
    rows = rows[keep]
    who = rng.choice(n, k, replace=False)
    a = rng.uniform(-np.pi, np.pi, k)
    rows[who] = np.column_stack([
        p[0, 0] + z[0, 0] * np.cos(a), p[0, 1] + z[0, 0] * np.sin(a), wrap(a - z[0, 1]),
    ])
    return rows, np.full(n, 1 / n)
""",
    ),
]
