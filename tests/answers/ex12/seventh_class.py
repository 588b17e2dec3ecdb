"""A seventh class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "12-odometry",
        "exponential of a twist by scipy",
        """
from scipy.linalg import expm

def odometry(left, right, tick, base):
    d, turn = (left + right) * tick / 2, (right - left) * tick / base
    E = expm(np.array([[0, -turn, d], [turn, 0, 0], [0, 0, 0]], dtype=float))
    return np.array([E[0, 2], E[1, 2], turn])
""",
    ),
    (
        "12-paired",
        "each possible median tried between two neighbours",
        """
def compare(errors_a, errors_b, limit):
    diffs = []
    for a, b in zip(errors_a.tolist(), errors_b.tolist()):
        sa = sb = n = 0
        for ea, eb in zip(a, b):
            if ea > limit or eb > limit:
                break
            sa, sb, n = sa + ea * ea, sb + eb * eb, n + 1
        if n:
            diffs.append((sa / n) ** 0.5 - (sb / n) ** 0.5)
    diffs = sorted(diffs)
    n = len(diffs)
    def possible(below):
        few = sum(comb(n, k) for k in range(below + 1))
        many = sum(comb(n, k) for k in range(below, n + 1))
        return 40 * few > 2**n and 40 * many > 2**n
    good = [below for below in range(n + 1) if possible(below)]
    return diffs[good[0] - 1], diffs[good[-1]]
""",
    ),
]

WRONG = [
    (
        "12-odometry",
        "runge-kutta with four stages over the whole step",
        """
def odometry(left, right, tick, base):
    d, turn = (left + right) * tick / 2, (right - left) * tick / base
    def f(theta):
        return np.array([d * np.cos(theta), d * np.sin(theta), turn])
    k1, k2, k4 = f(0.0), f(turn / 2), f(turn)
    return (k1 + 4 * k2 + k4) / 6
""",
    ),
    (
        "12-odometry",
        "straight if the turn is small, below a thousandth",
        """
def odometry(left, right, tick, base):
    sl, sr = left * tick, right * tick
    turn = (sr - sl) / base
    if abs(turn) < 1e-3:
        return np.array([(sl + sr) / 2, 0.0, turn])
    R = base / 2 * (sl + sr) / (sr - sl)
    return np.array([R * np.sin(turn), R - R * np.cos(turn), turn])
""",
    ),
    (
        "12-lost",
        "a state machine that forgets to reset when it comes back",
        """
def lost_since(errors, limit):
    since = -1
    for k in range(len(errors)):
        if errors[k] > limit and since == -1:
            since = k
    if errors[-1] <= limit:
        return -1
    return since
""",
    ),
    (
        "12-lost",
        "the last crossing by diff, with one missing",
        """
def lost_since(errors, limit):
    beyond = (np.asarray(errors) > limit).astype(int)
    if not beyond[-1]:
        return -1
    up = np.flatnonzero(np.diff(beyond) == 1)
    return int(up[-1]) if len(up) else 0
""",
    ),
    (
        "12-interval",
        "add two losses and two successes (Agresti)",
        """
def interval(k, n):
    p = (k + 2) / (n + 4)
    half = 1.96 * (p * (1 - p) / (n + 4)) ** 0.5
    return p - half, p + half
""",
    ),
    (
        "12-paired",
        "mean of the differences and 1.96 standard errors",
        """
def compare(errors_a, errors_b, limit):
    diffs = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if bad.size else len(a)
        if end == 0:
            continue
        diffs.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    diffs = np.array(diffs)
    half = 1.96 * diffs.std(ddof=1) / np.sqrt(len(diffs))
    return np.median(diffs) - half, np.median(diffs) + half
""",
    ),
    (
        "12-paired",
        "stray readings are masked, and those after count again",
        """
def compare(errors_a, errors_b, limit):
    diffs = []
    for a, b in zip(errors_a, errors_b):
        fine = (a <= limit) & (b <= limit)
        if fine[0]:
            diffs.append(np.sqrt(np.mean(a[fine] ** 2)) - np.sqrt(np.mean(b[fine] ** 2)))
    diffs.sort()
    n, total, k = len(diffs), 0.0, 0
    while True:
        total += comb(n, k) / 2**n
        if total > 0.025:
            break
        k += 1
    return diffs[k - 1], diffs[n - k]
""",
    ),
    (
        "12-relocalise",
        "a particle filter with fifty strangers in each step, and its weighted mean",
        """
def relocalise(start, motions, sights, posts):
    rng, n = np.random.default_rng(1), 600
    rows, found = np.tile(start, (n, 1)), []
    for told, seen in zip(motions, sights):
        noise = rng.normal(0, [0.03, 0.03, 0.03], (n, 3))
        rows = compose(rows, told + noise)
        rows[:50] = np.column_stack([rng.uniform([0, 0], HALL, (50, 2)), rng.uniform(-3.14, 3.14, 50)])
        weights = np.ones(n) / n
        if len(seen):
            logs = fit(rows, seen, posts)
            weights = np.exp(logs - logs.max())
            weights /= weights.sum()
        mean = weights @ rows
        found.append(mean)
        rows = rows[rng.choice(n, n, p=weights)]
    return np.array(found)
""",
    ),
]
