# %% way: both sides by hand
def unwrap(values):
    steps = np.diff(values)
    steps = steps + 256 * (steps < -127) - 256 * (steps > 127)
    return np.concatenate([[0], np.cumsum(steps)])

# %% way: numpy's unwrap
def unwrap(values):
    return np.unwrap(values, period=256) - values[0]

# %% way: as int8
def unwrap(values):
    steps = np.diff(values.astype(np.int8)).astype(int)
    return np.append(0, steps).cumsum()

# %% way: a loop
def unwrap(values):
    total, totals = 0, [0]
    for a, b in zip(values, values[1:]):
        total += (b - a + 128) % 256 - 128
        totals.append(total)
    return totals

# %% way: rounds counted
def unwrap(values):
    rounds, counts = 0, np.zeros(len(values))
    for k in range(1, len(values)):
        step = values[k] - values[k - 1]
        if step > 127:
            rounds -= 1
        elif step < -127:
            rounds += 1
        counts[k] = values[k] + 256 * rounds - values[0]
    return counts

# %% way: nearest
def unwrap(values):
    counts = np.array(values) - values[0]
    for k in range(1, len(counts)):
        counts[k] += 256 * np.round((counts[k - 1] - counts[k]) / 256)
    return counts

# %% right: differences brought to a signed byte by numpy
def unwrap(values):
    steps = np.diff(np.asarray(values).astype(np.int64)).astype(np.int8)
    return np.r_[0, np.cumsum(steps.astype(np.int64))]

# %% right: differences in eight-bit arithmetic, which wraps by itself, then summed as int
def unwrap(values):
    eight = np.array(values, dtype=np.int8)
    steps = eight[1:] - eight[:-1]
    return np.concatenate([[0], np.cumsum(steps.astype(int))])

# %% right: np.unwrap with a period
def unwrap(values):
    values = np.array(values, dtype=int)
    return np.unwrap(values, period=256) - values[0]

# %% wrong: one value too few: the zero of the first reading is missing
def unwrap(values):
    steps = (np.diff(values) + 128) % 256 - 128
    return np.cumsum(steps)

# %% wrong: np.unwrap in radians
def unwrap(values):
    v = np.asarray(values, float)
    w = np.unwrap(v / 128 * np.pi) / np.pi * 128
    return np.rint(w - w[0]) + 1

# %% wrong: one side of the edge off by one, -127
def unwrap(values):
    steps = (np.diff(values) + 126) % 256 - 126
    return np.concatenate([[0], np.cumsum(steps)])

# %% wrong: the first subtracted in place
def unwrap(values):
    values -= values[0]
    steps = (np.diff(values) + 128) % 256 - 128
    return np.concatenate([[0], np.cumsum(steps)])

# %% wrong: made unsigned only
def unwrap(values):
    unsigned = np.asarray(values) % 256
    return unsigned - unsigned[0]

# %% wrong: np.unwrap in radians, cut to int
def unwrap(values):
    angle = np.unwrap(np.asarray(values) / 128 * np.pi)
    return ((angle - angle[0]) / np.pi * 128).astype(int)

# %% wrong: only the last count
def unwrap(values):
    total = 0
    for k in range(1, len(values)):
        total += (values[k] - values[k - 1] + 128) % 256 - 128
    return total
