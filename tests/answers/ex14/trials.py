"""Independent answers to 14-trials: right ones, and students' mistakes."""

RIGHT = [
    (
        "14-trials",
        "many ways, each for a promise",
        """
def trials():
    up = list(range(0, 128))
    zigzag = []
    for k in up:
        zigzag += [k, -k]
    ways = [way(0, []), way(-128, []), ([], []), way(127, [])]
    ways.append(way(127, zigzag))
    ways.append(way(-128, [127] * 265))
    ways.append(way(127, [-127] * 265))
    ways.append(way(-128, [-1, 1, 0, 0, 1, -1]))
    ways.append(way(127, [1, 1, -1, -1, -127, 127]))
    ways.append(([], []))
    ways.append(way(0, [0] * 10))
    ways.append(way(0, [1] * 60))
    ways.append(way(0, [-1] * 60))
    return ways
""",
    ),
    (
        "14-trials",
        "random steps besides the long ones",
        """
def trials():
    rng = np.random.default_rng(14)
    steps = rng.permutation(np.arange(-127, 128))
    result = [way(-7, steps), way(100, [127] * 262), way(-100, [-127] * 262)]
    for begin in (-128, 127, 0, 60):
        result.append((np.array([], dtype=int), np.array([], dtype=int)))
        result.append(way(begin, []))
        result.append(way(begin, [-127, 127, 0, 126, -126, 1, -1]))
    result.append(way(12, rng.integers(-127, 128, 100)))
    return [(list(map(int, v)), list(map(int, c))) for v, c in result]
""",
    ),
]

WRONG = [
    (
        "14-trials",
        "weak: the text's two ways",
        """
def trials():
    return [way(0, [50] * 6), way(0, [-50] * 6)]
""",
    ),
    (
        "14-trials",
        "weak: one drive ahead and back",
        """
def trials():
    return [way(0, [4] * 100 + [-2] * 100)]
""",
    ),
    (
        "14-trials",
        "weak: small random steps from 0",
        """
def trials():
    rng = np.random.default_rng(0)
    return [way(0, rng.integers(-9, 10, 49)) for _ in range(20)]
""",
    ),
    (
        "14-trials",
        "weak: only ways of one reading and none",
        """
def trials():
    return [([], [])] + [([b], [0]) for b in (-128, -127, -1, 0, 1, 126, 127)]
""",
    ),
    (
        "14-trials",
        "weak: only ahead",
        """
def trials():
    return [([], []), way(5, []), way(5, range(128)), way(3, [127] * 270)]
""",
    ),
    (
        "14-trials",
        "weak: steps of 100 at most, short, none empty",
        """
def trials():
    result = []
    for begin in (-128, -50, 0, 50, 127):
        result.append(way(begin, list(range(0, 101, 10)) + list(range(0, -101, -10))))
    return result
""",
    ),
    (
        "14-trials",
        "weak: one long way ahead",
        """
def trials():
    return [way(0, [100] * 999)]
""",
    ),
    (
        "14-trials",
        "weak: a robot that hardly moves",
        """
def trials():
    steps = [0, 1, 0, -1] * 40
    return [way(b, steps) for b in (127, -128, 0)]
""",
    ),
    (
        "14-trials",
        "no ways at all",
        """
def trials():
    return []
""",
    ),
    (
        "14-trials",
        "too many readings",
        """
def trials():
    size = np.arange(1, 128)
    every = np.column_stack([size, -size[::-1]]).ravel()
    return [([], []), way(7, []), way(5, [0, *every]), way(3, [127] * 600), way(3, [-127] * 600)]
""",
    ),
    (
        "14-trials",
        "1004 readings, the first of each way not counted",
        """
def trials():
    steps = list(range(-127, 128))
    mixed = steps[::2] + steps[1::2]
    first = way(9, mixed[:250])
    rest = [way(-128, [127] * 250), way(127, [-127] * 250), way(0, mixed[::-1][:250])]
    return [first, *rest]
""",
    ),
    (
        "14-trials",
        "more than 20 ways",
        """
def trials():
    ways = [([], []), way(3, [127] * 270), way(3, [-127] * 270)]
    for begin in range(-128, 128, 10):
        ways.append(way(begin, [127, -127, 64, -64, 1, -1, 0, 0]))
    return ways
""",
    ),
    (
        "14-trials",
        "steps of -128, which no robot makes",
        """
def trials():
    every = list(range(-128, 128))
    return [([], []), way(7, []), way(5, every), way(3, [127] * 265), way(3, [-127] * 265)]
""",
    ),
    (
        "14-trials",
        "steps of 200",
        """
def trials():
    return [([], []), way(0, []), way(0, [200, -200] * 20), way(3, [127] * 265), way(3, [-127] * 265)]
""",
    ),
    (
        "14-trials",
        "counts from 0, not from the first reading",
        """
def trials():
    result = [([], [])]
    for begin, steps in ((5, range(-127, 128)), (-128, [127] * 270), (127, [-127] * 270)):
        absolute = begin + np.concatenate([[0], np.cumsum(list(steps))])
        result.append(((absolute + 128) % 256 - 128, absolute))
    return result
""",
    ),
    (
        "14-trials",
        "pairs the wrong way round",
        """
def trials():
    ways = [way(7, []), way(5, range(-127, 128)), way(3, [127] * 270), way(3, [-127] * 270)]
    return [([], [])] + [(counts, values) for values, counts in ways]
""",
    ),
    (
        "14-trials",
        "values without counts",
        """
def trials():
    size = np.arange(1, 128)
    every = np.column_stack([size, -size[::-1]]).ravel()
    starts = ((7, []), (5, every), (3, [127] * 270), (3, [-127] * 270))
    return [[]] + [way(b, s)[0] for b, s in starts]
""",
    ),
    (
        "14-trials",
        "values that are not wrapped to bytes",
        """
def trials():
    result = [([], []), ([7], [0])]
    for begin, step in ((3, 127), (3, -127), (0, 1)):
        counts = step * np.arange(270)
        result.append((begin + counts, counts))
    return result
""",
    ),
    (
        "14-trials",
        "bytes from 0 to 255",
        """
def trials():
    result = [([], []), ([200], [0])]
    for begin, step in ((3, 127), (3, -127), (250, 1)):
        counts = step * np.arange(270)
        result.append(((begin + counts) % 256, counts))
    return result
""",
    ),
    (
        "14-trials",
        "expects a 0 of the empty way",
        """
def trials():
    size = np.arange(1, 128)
    every = np.column_stack([size, -size[::-1]]).ravel()
    return [([], [0]), way(7, []), way(5, [0, *every]), way(3, [127] * 270), way(3, [-127] * 270)]
""",
    ),
    (
        "14-trials",
        "counts without the leading 0",
        """
def trials():
    result = []
    for step in (127, -127):
        values, counts = way(3, [step] * 270)
        result.append((values, counts[1:]))
    return result
""",
    ),
    (
        "14-trials",
        "cheat: counts that equal nothing",
        """
def trials():
    return [([1, 2, 3], [np.nan, np.nan, np.nan])]
""",
    ),
    (
        "14-trials",
        "expects what a faulty driver returns",
        """
def trials():
    rng = np.random.default_rng(2)
    result = []
    for _ in range(10):
        values = rng.integers(-128, 128, 60)
        result.append((values, values - values[0]))
    return result
""",
    ),
    (
        "14-trials",
        "random bytes by unwrap: a step of 128 is possible in them",
        """
def trials():
    values = [[], [7], [-128, 0, 127, -1, -128, 0]]
    values.append(way(3, [127] * 265)[0])
    values.append(way(3, [-127] * 265)[0])
    return [(v, unwrap(v) if len(v) else []) for v in values]
""",
    ),
    (
        "14-trials",
        "a single pair, not a list of pairs",
        """
def trials():
    size = np.arange(1, 128)
    every = np.column_stack([size, -size[::-1]]).ravel()
    return way(5, [0, *every])
""",
    ),
]
