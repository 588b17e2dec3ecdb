# %% way: by logarithms and tickets, half as many random_particles
def find_again(rows, weights, u, C, p, z, R, rng):

    def ring(count):
        '''Poses from which z could have been measured, and their ranges.'''
        r, beta = rng.multivariate_normal(z[0], R, count).T
        angle = rng.uniform(-np.pi, np.pi, count)
        x, y = p[0, 0] + r * np.cos(angle), p[0, 1] + r * np.sin(angle)
        return np.column_stack([x, y, wrap(angle + np.pi - beta)]), r

    n, k = len(rows), len(rows) // 2
    moved = move(rows, u, C, rng)
    random_particles, r = ring(k)
    top = np.log(1 - OUTLIERS) - np.log(2 * np.pi) - np.linalg.slogdet(R)[1] / 2
    floor = np.log(OUTLIERS / (2 * np.pi * REACH))
    known = np.log(weights) + np.logaddexp(top + log_likelihoods(moved, p, z, R), floor)
    new = np.log(0.01 * np.abs(r) / (80 * k) + 1e-300)
    new[(np.abs(random_particles[:, :2]) > ROOM / 2).any(axis=1)] = -1e3
    w = normalise(np.append(known, new))
    return np.concatenate([moved, random_particles])[rng.choice(n + k, n, p=w)], np.full(n, 1 / n)

# %% way: random_particles of one weight, evenly on the ring
def find_again(rows, weights, u, C, p, z, R, rng):

    n = len(rows)
    moved = move(rows, u, C, rng)
    noise = rng.multivariate_normal([0, 0], R, n)
    angle = 2 * np.pi * (np.arange(n) + rng.random()) / n
    r = np.abs(z[0, 0] + noise[:, 0])
    x, y = p[0, 0] + r * np.cos(angle), p[0, 1] + r * np.sin(angle)
    new = np.column_stack([x, y, wrap(angle + np.pi - z[0, 1] - noise[:, 1])])
    real = np.exp(log_likelihoods(moved, p, z, R)) / (2 * np.pi * np.sqrt(np.linalg.det(R)))
    w = np.append(weights * (0.9 * real + 0.1 / 63), np.full(n, 0.0005 / n))
    w[n:][(np.abs(x) > 5) | (np.abs(y) > 4)] = 0
    w = w / w.sum()
    picked = np.searchsorted(np.cumsum(w)[:-1], (rng.random() + np.arange(n)) / n)
    return np.vstack([moved, new])[picked], np.ones(n) / n

# %% way: twice as many random_particles
def find_again(rows, weights, u, C, p, z, R, rng):

    def ring(count):
        '''Poses from which z could have been measured, and their ranges.'''
        r, beta = rng.multivariate_normal(z[0], R, count).T
        angle = rng.uniform(-np.pi, np.pi, count)
        x, y = p[0, 0] + r * np.cos(angle), p[0, 1] + r * np.sin(angle)
        return np.column_stack([x, y, wrap(angle + np.pi - beta)]), r

    n, moved = len(rows), move(rows, u, C, rng)
    random_particles, r = ring(2 * n)
    real = np.exp(log_likelihoods(moved, p, z, R)) / (2 * np.pi * np.sqrt(np.linalg.det(R)))
    known = 0.99 * weights * (0.9 * real + 0.1 / (2 * np.pi * 10))
    new = 0.9 * 0.01 * np.abs(r) / 80 / (2 * n)
    new[(np.abs(random_particles[:, 0]) > 5) | (np.abs(random_particles[:, 1]) > 4)] = 0
    w = np.append(known, new)
    picked = draw(w / w.sum(), rng)[rng.integers(3) :: 3]
    return list(np.vstack([moved, random_particles])[picked]), [1 / n] * n

# %% way: p l / q of each stranger by its densities
def find_again(rows, weights, u, C, p, z, R, rng):

    def ring(count):
        '''Poses from which z could have been measured, and their ranges.'''
        r, beta = rng.multivariate_normal(z[0], R, count).T
        angle = rng.uniform(-np.pi, np.pi, count)
        x, y = p[0, 0] + r * np.cos(angle), p[0, 1] + r * np.sin(angle)
        return np.column_stack([x, y, wrap(angle + np.pi - beta)]), r

    n = len(rows)
    moved = move(rows, u, C, rng)
    random_particles, r = ring(n)
    peak = 1 / (2 * np.pi * np.sqrt(np.linalg.det(R)))

    def likelihood(x):
        return (1 - OUTLIERS) * peak * np.exp(log_likelihoods(x, p, z, R)) + OUTLIERS / (2 * np.pi * REACH)

    prior = np.where((np.abs(random_particles[:, :2]) < ROOM / 2).all(axis=1), 1 / (80 * 2 * np.pi), 0)
    # drawn round z, as densities of range, bearing and angle: in x, y and θ they are 1/r of that
    q = peak * np.exp(log_likelihoods(random_particles, p, z, R)) / (2 * np.pi * np.maximum(np.abs(r), 1e-6))
    q = np.maximum(q, 1e-2 * q.max())
    w = np.append(0.99 * weights * likelihood(moved), 0.01 * prior * likelihood(random_particles) / q / n)
    together = np.vstack([moved, random_particles])
    w = w / np.sum(w)
    best = rng.permutation(draw(w, rng))[:n]
    return together[best], np.full(n, 1 / n)

# %% pasted: task 3's step
def find_again(rows, weights, u, C, p, z, R, rng):
    return localise(rows, weights, u, C, p, z, R, rng)

# %% pasted: the lesson's random_particles
def find_again(rows, weights, u, C, p, z, R, rng):

    n, k = len(rows), int(0.1 * len(rows))
    rows, weights = localise(rows, weights, u, C, p, z, R, rng)
    rows = rows[draw(weights, rng)]
    rows[rng.permutation(n)[:k]] = rng.uniform([-5, -4, -np.pi], [5, 4, np.pi], (k, 3))
    return rows, np.full(n, 1 / n)

# %% pasted: the lesson's step with more random_particles
def find_again(rows, weights, u, C, p, z, R, rng):

    n, k = len(rows), int(0.25 * len(rows))
    rows, weights = localise(rows, weights, u, C, p, z, R, rng)
    rows = rows[draw(weights, rng)]
    rows[rng.permutation(n)[:k]] = rng.uniform([-5, -4, -np.pi], [5, 4, np.pi], (k, 3))
    return rows, np.full(n, 1 / n)

# %% right: random_particles on the ring as a second population, density of the ring divided out
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

# %% right: ring random_particles, multinomial draw, a little roughening
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

# %% wrong: only moves: sightings ignored
def find_again(rows, weights, u, C, p, z, R, rng):
    return move(rows, u, C, rng), weights.copy()

# %% wrong: returns more samples than it got
def find_again(rows, weights, u, C, p, z, R, rng):
    rows, weights = localise(rows, weights, u, C, p, z, R, rng)
    k = 60
    random_particles = rng.uniform([-5, -4, -np.pi], [5, 4, np.pi], (k, 3))
    n = len(rows) + k
    return np.vstack([rows, random_particles]), np.concatenate([weights * len(rows) / n, np.full(k, 1 / n)])

# %% wrong: ring with a wrong heading (half a turn forgotten)
def find_again(rows, weights, u, C, p, z, R, rng):
    n, carried = len(rows), 0.01
    rows = move(rows, u, C, rng)
    r, beta = rng.multivariate_normal(z[0], R, n).T
    angle = rng.uniform(-np.pi, np.pi, n)
    random_particles = np.column_stack(
        [p[0, 0] + r * np.cos(angle), p[0, 1] + r * np.sin(angle), wrap(angle - beta)])
    inside = np.all(np.abs(random_particles[:, :2]) < ROOM / 2, axis=1)
    real = np.exp(log_likelihoods(rows, p, z, R)) / (2 * np.pi * np.sqrt(np.linalg.det(R)))
    seen = 0.9 * real + 0.1 / (REACH * 2 * np.pi)
    odd = 0.9 * inside * np.abs(r) / np.prod(ROOM) / n
    every = np.concatenate([(1 - carried) * weights * seen, carried * odd])
    picked = draw(every / every.sum(), rng)[::2]
    return np.vstack([rows, random_particles])[picked], np.full(n, 1 / n)

# %% wrong: the middle of the room, constant
def find_again(rows, weights, u, C, p, z, R, rng):
    return np.zeros((len(rows), 3)), np.full(len(rows), 1 / len(rows))

# %% wrong: all over the room anew in each step, best ones kept
def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    anywhere = rng.uniform([-5, -4, -np.pi], [5, 4, np.pi], (20 * n, 3))
    logs = log_likelihoods(anywhere, p, z, R)
    best = np.argsort(logs)[-n:]
    return anywhere[best], normalise(logs[best])

# %% wrong: returns logarithms for weights
def find_again(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    w = np.log(np.abs(weights) + 1e-300) + log_likelihoods(rows, p, z, R)
    return rows, w - w.max()

# %% wrong: a tenth of the samples is thrown anywhere in the room each step, as in the lesson: too few to hit, and false sightings are trusted
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
