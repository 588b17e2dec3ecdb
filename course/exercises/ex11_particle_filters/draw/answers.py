# %% way: by a loop
def draw(weights, rng):
    n = len(weights)
    u, i, end, drawn = rng.random() / n, 0, weights[0], []
    for k in range(n):
        for _ in range(n):
            if u + k / n < end or i == n - 1:
                break
            i += 1
            end += weights[i]
        drawn.append(i)
    return drawn

# %% way: the last end set to one
def draw(weights, rng):
    n = len(weights)
    ends = np.cumsum(weights)
    ends[-1] = 1
    return np.searchsorted(ends, rng.uniform(0, 1 / n) + np.linspace(0, 1, n, endpoint=False))

# %% way: by counting copies, shuffled
def draw(weights, rng):
    n, u = len(weights), rng.random()
    ends = np.ceil(n * np.cumsum(weights) - u).astype(int)
    ends[-1] = n
    return rng.permutation(np.repeat(np.arange(n), np.diff(ends, prepend=0)))

# %% way: from the right
def draw(weights, rng):
    n = len(weights)
    teeth = 1 - (rng.random() + np.arange(n)) / n
    return np.minimum(np.searchsorted(np.cumsum(weights), teeth), n - 1)

# %% way: a comb over n times the weights
def draw(weights, rng):
    ends = len(weights) * np.cumsum(weights) / np.sum(weights)
    teeth = np.arange(len(weights)) + rng.random()
    return np.clip(np.digitize(teeth, ends), 0, len(weights) - 1).tolist()

# %% way: each tooth by itself
def draw(weights, rng):
    n, ends = len(weights), np.cumsum(weights)
    ends /= ends[-1]
    u = rng.uniform()
    return np.array([int(np.argmax(ends > (u + k) / n)) for k in range(n)], dtype=int)

# %% right: last end set to one, shuffled order
def draw(weights, rng):
    ends = np.cumsum(weights)
    ends = ends / ends[-1]
    n = weights.size
    teeth = np.arange(n) / n + rng.random() / n
    rows = np.searchsorted(ends, teeth, side="right")
    return np.clip(rows, 0, n - 1)[::-1]

# %% right: np.digitize
def draw(weights, rng):
    n = len(weights)
    ends = np.cumsum(weights)
    ends[-1] = 1.0 + 1e-9
    return np.digitize((np.arange(n) + rng.uniform()) / n, ends)

# %% right: teeth walked along the rod
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

# %% right: the comb is shifted round a ring: a number from 0 to 1 plus k/n, modulo 1; pieces walked through in a loop
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

# %% wrong: teeth where the rod has ended give n
def draw(weights, rng):
    n = len(weights)
    teeth = (rng.random() + np.arange(n)) / n
    return np.searchsorted(np.cumsum(weights), teeth, side="right")

# %% wrong: argmax: a tooth past the last end picks sample 0
def draw(weights, rng):
    n = len(weights)
    ends = np.cumsum(weights)
    u = rng.random()
    return np.array([np.argmax(ends > (u + k) / n) for k in range(n)])

# %% wrong: np.random instead of rng
def draw(weights, rng):
    n = len(weights)
    teeth = (np.random.random() + np.arange(n)) / n
    return np.minimum(np.searchsorted(np.cumsum(weights), teeth, side="right"), n - 1)

# %% wrong: cumsum written into the argument
def draw(weights, rng):
    n = len(weights)
    np.cumsum(weights, out=weights)
    weights[-1] = 1.0
    return np.searchsorted(weights, (rng.random() + np.arange(n)) / n, side="right")

# %% wrong: copies by rounding, and the rest from the heaviest
def draw(weights, rng):
    n = len(weights)
    copies = np.rint(n * weights).astype(int)
    while copies.sum() > n:
        copies[np.argmax(copies)] -= 1
    while copies.sum() < n:
        copies[np.argmax(weights)] += 1
    return np.repeat(np.arange(n), copies)

# %% wrong: shift from 0 to 1
def draw(weights, rng):
    n = len(weights)
    return np.minimum(np.searchsorted(np.cumsum(weights), (np.arange(n) + rng.random()) % n / n + rng.random()), n - 1)

# %% wrong: the end of the rod is missed
def draw(weights, rng):
    n = len(weights)
    teeth = (np.arange(n) + rng.random()) / n
    return np.searchsorted(np.cumsum(weights)[:-1], teeth, side="left") - 1

# %% wrong: tournament: a sample is taken with the probability of its weight over the largest
def draw(weights, rng):
    n, picked = len(weights), []
    top = weights.max()
    while len(picked) < n:
        i = rng.integers(n)
        if rng.random() < weights[i] / top:
            picked.append(i)
    return np.array(picked)
