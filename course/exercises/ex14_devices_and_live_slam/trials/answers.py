# %% way: zigzag
def trials():
    def wrapped(counts):
        return [(c + 128) % 256 - 128 for c in counts]

    zigzag, far, near = [0], [0], [0]
    for k in range(128):
        zigzag.append(zigzag[-1] + k * (-1) ** k)
    for k in range(127, 0, -1):
        zigzag.append(zigzag[-1] - k * (-1) ** k)
    for k in range(260):
        far.append(far[-1] + 127)
        near.append(near[-1] - 127)
    ways = [zigzag, [0], [], far, near]
    return [([(b + 9 + 128) % 256 - 128 for b in wrapped(way)], way) for way in ways]

# %% way: at random, and the edges
def trials():
    rng = np.random.default_rng(1)
    steps = np.concatenate([rng.permutation(np.arange(-127, 128)), rng.integers(-127, 128, 150)])
    ways = [(3, [127, 127, 127, -127, -127, -127, 0, 0]), (-4, steps)]
    ways += [(90, [127] * 262), (-90, [-127] * 262), (11, [])]
    found = [(np.array([], dtype=np.int8), np.array([]))]
    for begin, each in ways:
        counts = np.append(0, np.cumsum(np.array(each, dtype=int)))
        found.append((((begin + counts + 128) % 256 - 128).astype(np.int8), counts))
    return found

# %% way: by the counter's own unwrap
def trials():
    values = [np.array([5]), (7 + 127 * np.arange(262) + 128) % 256 - 128]
    values += [(7 - 127 * np.arange(262) + 128) % 256 - 128]
    steps = np.arange(-127, 128)
    mixed = np.where(np.arange(255) % 2, steps, -steps)
    values += [(1 + np.cumsum(mixed) + 128) % 256 - 128, np.array([-128, -128, -1, -1])]
    return [((), ())] + [(v, unwrap(v)) for v in values]

# %% way: all bytes slowly
def trials():
    count = np.arange(257)
    up = [k for n in range(1, 128) for k in (n, -n)]
    ways = [(1, []), (-128, [1, 1, 0] + [s for n in range(128) for s in (127 - n, -n)])]
    ways += [(2, [127] * 260), (2, [-127] * 260)]
    pairs = [sequence(*each) for each in ways]
    return (([], []), *pairs)

# %% pasted: the lesson's drive ahead
def trials():
    values = (2 * np.arange(161) + 128) % 256 - 128
    return [(values, unwrap(values))]

# %% pasted: the corridor, ahead and back
def trials():
    steps = [4, 4, 4, 4, 5] * 20 + [-2, -2, -2, -1] * 25
    return [sequence(0, steps)]

# %% pasted: the two ways of the notebook
def trials():
    return [sequence(0, [50] * 6), sequence(0, [-50] * 6)]

# %% pasted: the answer to another task
def trials():
    values = np.array([0, 100, -56, 44, -112, -56, 20])
    return [(values, unwrap(values))]

# %% right: many ways, each for a promise
def trials():
    up = list(range(0, 128))
    zigzag = []
    for k in up:
        zigzag += [k, -k]
    ways = [sequence(0, []), sequence(-128, []), ([], []), sequence(127, [])]
    ways.append(sequence(127, zigzag))
    ways.append(sequence(-128, [127] * 265))
    ways.append(sequence(127, [-127] * 265))
    ways.append(sequence(-128, [-1, 1, 0, 0, 1, -1]))
    ways.append(sequence(127, [1, 1, -1, -1, -127, 127]))
    ways.append(([], []))
    ways.append(sequence(0, [0] * 10))
    ways.append(sequence(0, [1] * 60))
    ways.append(sequence(0, [-1] * 60))
    return ways

# %% right: random steps besides the long ones
def trials():
    rng = np.random.default_rng(14)
    steps = rng.permutation(np.arange(-127, 128))
    result = [sequence(-7, steps), sequence(100, [127] * 262), sequence(-100, [-127] * 262)]
    for begin in (-128, 127, 0, 60):
        result.append((np.array([], dtype=int), np.array([], dtype=int)))
        result.append(sequence(begin, []))
        result.append(sequence(begin, [-127, 127, 0, 126, -126, 1, -1]))
    result.append(sequence(12, rng.integers(-127, 128, 100)))
    return [(list(map(int, v)), list(map(int, c))) for v, c in result]

# %% wrong: ahead and back
def trials():
    return [sequence(0, [50] * 6), sequence(0, [-50] * 6), sequence(0, []), sequence(-128, [127, -127] * 20)]

# %% wrong: only the two ways of the example, 50 counts ahead and back: short, no edges
def trials():
    return [sequence(0, [50] * 6), sequence(0, [-50] * 6)]

# %% wrong: readings are handed over as unsigned bytes, 0 to 255
def trials():
    out = []
    for begin, steps in ((0, [127] * 100), (200, [-127] * 100), (128, [0, 1, -1, 64, -64] * 20), (7, [])):
        counts = np.concatenate([[0], np.cumsum(np.array(steps, dtype=int))])
        out.append(((begin + counts) % 256, counts))
    return out

# %% wrong: steps of 128
def trials():
    return [sequence(0, [128] * 5), sequence(0, [127] * 200), ([], [])]

# %% wrong: weak: only ways of one reading and none
def trials():
    return [([], [])] + [([b], [0]) for b in (-128, -127, -1, 0, 1, 126, 127)]

# %% wrong: weak: only ahead
def trials():
    return [([], []), sequence(5, []), sequence(5, range(128)), sequence(3, [127] * 270)]

# %% wrong: no ways at all
def trials():
    return []

# %% wrong: too many readings
def trials():
    size = np.arange(1, 128)
    every = np.column_stack([size, -size[::-1]]).ravel()
    return [([], []), sequence(7, []), sequence(5, [0, *every]), sequence(3, [127] * 600), sequence(3, [-127] * 600)]

# %% wrong: steps of 200
def trials():
    return [([], []), sequence(0, []), sequence(0, [200, -200] * 20), sequence(3, [127] * 265), sequence(3, [-127] * 265)]

# %% wrong: expects a 0 of the empty way
def trials():
    size = np.arange(1, 128)
    every = np.column_stack([size, -size[::-1]]).ravel()
    return [([], [0]), sequence(7, []), sequence(5, [0, *every]), sequence(3, [127] * 270), sequence(3, [-127] * 270)]

# %% wrong: cheat: counts that equal nothing
def trials():
    return [([1, 2, 3], [np.nan, np.nan, np.nan])]

# %% wrong: a single pair, not a list of pairs
def trials():
    size = np.arange(1, 128)
    every = np.column_stack([size, -size[::-1]]).ravel()
    return sequence(5, [0, *every])
