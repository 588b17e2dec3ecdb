# %% way: rng.normal
def noisy(ranges, error, dropouts, rng):
    lost = rng.random(ranges.shape) < dropouts
    return np.where(lost, np.nan, rng.normal(1, error, ranges.shape) * ranges)

# %% way: beam by beam
def noisy(ranges, error, dropouts, rng):
    measured = ranges.copy()
    for k, r in enumerate(ranges):
        if not np.isnan(r):
            measured[k] = np.nan if rng.uniform() < dropouts else r + rng.normal(0, error * r)
    return measured

# %% way: rng.choice
def noisy(ranges, error, dropouts, rng):
    back = rng.choice([1.0, np.nan], size=ranges.size, p=[1 - dropouts, dropouts])
    return list(back * ranges * (1 + error * rng.standard_normal(ranges.size)))

# %% way: rng.binomial
def noisy(ranges, error, dropouts, rng):
    sigma = np.nan_to_num(error * ranges)
    measured = rng.normal(ranges, sigma)
    measured[rng.binomial(1, dropouts, len(measured)).astype(bool)] = np.nan
    return measured

# %% way: only what is there
def noisy(ranges, error, dropouts, rng):
    there = np.flatnonzero(np.isfinite(ranges))
    there = there[rng.uniform(0, 1, there.size) >= dropouts]
    measured = np.full(ranges.shape, np.nan)
    measured[there] = ranges[there] + rng.normal(scale=error * ranges[there])
    return measured

# %% right: factor and np.where
def noisy(ranges, error, dropouts, rng):
    lost = rng.uniform(size=ranges.shape) < dropouts
    factor = rng.normal(1.0, error, size=ranges.shape)
    return np.where(lost, np.nan, ranges * factor)

# %% right: beam by beam
def noisy(ranges, error, dropouts, rng):
    out = np.full(len(ranges), np.nan)
    for i, r in enumerate(ranges):
        if np.isnan(r):
            continue
        if rng.random() < dropouts:
            continue
        out[i] = r + rng.normal(0, error * r)
    return out

# %% right: binomial for the losses
def noisy(ranges, error, dropouts, rng):
    new = ranges * (1 + error * rng.standard_normal(ranges.size))
    new[rng.binomial(1, dropouts, ranges.size) == 1] = np.nan
    return new

# %% wrong: a fixed count, rounded, permutation
def noisy(ranges, error, dropouts, rng):
    n = len(ranges)
    r = ranges + rng.normal(0, 1, n) * error * ranges
    r[rng.permutation(n)[:round(dropouts * n)]] = np.nan
    return r

# %% wrong: one draw for noise and loss
def noisy(ranges, error, dropouts, rng):
    u = rng.random(len(ranges))
    out = ranges * (1 + error * (u - 0.5) * np.sqrt(12))
    out[u < dropouts] = np.nan
    return out

# %% wrong: random numbers from numpy's global generator, not from rng
def noisy(ranges, error, dropouts, rng):
    out = np.random.normal(ranges, error * np.nan_to_num(ranges))
    return np.where(np.random.rand(len(ranges)) < dropouts, np.nan, out)

# %% wrong: changes ranges in place
def noisy(ranges, error, dropouts, rng):
    ranges += error * ranges * rng.standard_normal(len(ranges))
    ranges[rng.random(len(ranges)) < dropouts] = np.nan
    return ranges

# %% wrong: all or none is lost
def noisy(ranges, error, dropouts, rng):
    if rng.random() < dropouts:
        return np.full(len(ranges), np.nan)
    return ranges + error * ranges * rng.standard_normal(len(ranges))

# %% wrong: lost beams are left out
def noisy(ranges, error, dropouts, rng):
    measured = ranges + error * ranges * rng.standard_normal(len(ranges))
    return measured[rng.random(len(ranges)) >= dropouts]

# %% wrong: NaN becomes a number
def noisy(ranges, error, dropouts, rng):
    r = np.nan_to_num(ranges)
    measured = r * (1 + error * rng.standard_normal(len(r)))
    measured[rng.random(len(r)) < dropouts] = np.nan
    return measured
