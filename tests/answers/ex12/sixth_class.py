"""A sixth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "12-odometry",
        "numpy's sinc, in complex numbers",
        """
def odometry(left, right, tick, base):
    d, turn = (left + right) * tick / 2, (right - left) * tick / base
    end = d * np.sinc(turn / 2 / np.pi) * np.exp(0.5j * turn)
    return np.array([end.real, end.imag, turn])
""",
    ),
    (
        "12-lost",
        "from the end backwards",
        """
def lost_since(errors, limit):
    k = len(errors)
    while k > 0 and errors[k - 1] > limit:
        k -= 1
    return k if k < len(errors) else -1
""",
    ),
    (
        "12-interval",
        "Clopper and Pearson's exact interval",
        """
from scipy.stats import beta

def interval(k, n):
    low = beta.ppf(0.025, k, n - k + 1) if k > 0 else 0.0
    high = beta.ppf(0.975, k + 1, n - k) if k < n else 1.0
    return low, high
""",
    ),
    (
        "12-paired",
        "scipy's binomial and sets of drives",
        """
from scipy.stats import binom

def compare(errors_a, errors_b, limit):
    diffs = []
    for a, b in zip(errors_a, errors_b):
        good = np.logical_and.accumulate((a <= limit) & (b <= limit))
        if good.any():
            diffs.append(np.sqrt(np.mean(a[good] ** 2)) - np.sqrt(np.mean(b[good] ** 2)))
    diffs.sort()
    n = len(diffs)
    k = max(k for k in range(n) if k == 0 or binom.cdf(k - 1, n, 0.5) <= 0.025)
    return diffs[k - 1], diffs[n - k]
""",
    ),
]

WRONG = [
    (
        "12-odometry",
        "ten small steps, turn and drive",
        """
def odometry(left, right, tick, base):
    x = y = theta = 0.0
    for _ in range(10):
        sl, sr = left * tick / 10, right * tick / 10
        x += (sl + sr) / 2 * np.cos(theta)
        y += (sl + sr) / 2 * np.sin(theta)
        theta += (sr - sl) / base
    return np.array([x, y, theta])
""",
    ),
    (
        "12-odometry",
        "the radius from the turn after it was wrapped",
        """
def odometry(left, right, tick, base):
    sl, sr = left * tick, right * tick
    d, turn = (sl + sr) / 2, float(wrap((sr - sl) / base))
    if left == right:
        return np.array([d, 0.0, 0.0])
    radius = d / turn
    return np.array([radius * np.sin(turn), radius * (1 - np.cos(turn)), turn])
""",
    ),
    (
        "12-lost",
        "counted from the end by argmax, which says 0 if it never was within",
        """
def lost_since(errors, limit):
    if errors[-1] <= limit:
        return -1
    return len(errors) - int(np.argmax(np.array(errors)[::-1] <= limit))
""",
    ),
    (
        "12-interval",
        "every p of a thousandth that is possible",
        """
def interval(k, n):
    p = np.linspace(0, 1, 1001)
    possible = p[(k / n - p) ** 2 <= 1.96**2 * p * (1 - p) / n]
    return possible[0], possible[-1]
""",
    ),
    (
        "12-interval",
        "bootstrap: studies drawn from the share that was found",
        """
def interval(k, n):
    shares = np.random.default_rng(0).binomial(n, k / n, 20000) / n
    return float(np.quantile(shares, 0.025)), float(np.quantile(shares, 0.975))
""",
    ),
    (
        "12-paired",
        "each filter up to its own first straying",
        """
def compare(errors_a, errors_b, limit):
    def rms(e):
        out = np.flatnonzero(e > limit)
        end = out[0] if len(out) else len(e)
        return np.sqrt(np.mean(e[:end] ** 2)) if end > 0 else None
    diffs = []
    for a, b in zip(errors_a, errors_b):
        ra, rb = rms(a), rms(b)
        if ra is not None and rb is not None:
            diffs.append(ra - rb)
    diffs, n, k, p = sorted(diffs), len(diffs), 0, 0.0
    while p + comb(n, k) / 2**n <= 0.025:
        p += comb(n, k) / 2**n
        k += 1
    return diffs[k - 1], diffs[n - k]
""",
    ),
    (
        "12-paired",
        "quantiles of the differences themselves",
        """
def compare(errors_a, errors_b, limit):
    diffs = []
    for a, b in zip(errors_a, errors_b):
        n = 0
        while n < len(a) and max(a[n], b[n]) <= limit:
            n += 1
        if n:
            diffs.append(np.sqrt(np.mean(a[:n] ** 2)) - np.sqrt(np.mean(b[:n] ** 2)))
    low, high = np.percentile(diffs, [2.5, 97.5])
    return low, high
""",
    ),
    (
        "12-relocalise",
        "track, and where a scan fits badly the best guess from this scan alone",
        """
def relocalise(start, motions, sights, posts):
    pose, found = start, []
    for told, seen in zip(motions, sights):
        pose = corrected(compose(pose, told)[None], seen, posts)
        if len(seen) >= 2 and fit(pose, seen, posts)[0] < -4.6 * len(seen) / 2:
            options = guesses(seen, posts)
            if len(options):
                pose = options[[np.argmax(fit(options, seen, posts))]]
                pose = corrected(pose, seen, posts)
        pose = pose[0]
        found.append(pose)
    return np.array(found)
""",
    ),
]
