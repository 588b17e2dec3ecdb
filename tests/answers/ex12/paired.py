"""Independent answers to 12-paired: right ones, and students' mistakes."""

RIGHT = [
    (
        "12-paired",
        "order statistics found by walking up",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        n_good = 0
        for ea, eb in zip(a, b):
            if ea > limit or eb > limit:
                break
            n_good += 1
        if n_good:
            rms = [np.sqrt(np.sum(e[:n_good] ** 2) / n_good) for e in (a, b)]
            d.append(rms[0] - rms[1])
    d.sort()
    n, total, j = len(d), 0.0, 0
    while total + comb(n, j) / 2**n <= 0.025:
        total += comb(n, j) / 2**n
        j += 1
    return d[j - 1], d[n - j]
""",
    ),
    (
        "12-paired",
        "masks and the binomial of scipy",
        """
def compare(errors_a, errors_b, limit):
    from scipy.stats import binom
    ok = np.cumprod((errors_a <= limit) & (errors_b <= limit), axis=1).astype(bool)
    count = ok.sum(axis=1)
    use = count > 0
    rms_a = np.sqrt((errors_a**2 * ok).sum(axis=1)[use] / count[use])
    rms_b = np.sqrt((errors_b**2 * ok).sum(axis=1)[use] / count[use])
    d = np.sort(rms_a - rms_b)
    n = len(d)
    few = int(np.sum(binom.cdf(np.arange(n + 1), n, 0.5) <= 0.025))
    return d[few - 1], d[n - few]
""",
    ),
]

WRONG = [
    (
        "12-paired",
        "mean and t-like interval instead of the median",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d = np.array(d)
    half = 1.96 * d.std(ddof=1) / np.sqrt(len(d))
    return d.mean() - half, d.mean() + half
""",
    ),
    (
        "12-paired",
        "the straying reading is counted too",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] + 1 if len(bad) else len(a)
        if end > 1 or not len(bad):
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "an error equal to the limit strays",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        ok = (a < limit) & (b < limit)
        end = len(a) if ok.all() else np.argmin(ok)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "each filter up to its own first straying",
        """
def compare(errors_a, errors_b, limit):
    def rms(e):
        bad = np.flatnonzero(e > limit)
        end = bad[0] if len(bad) else len(e)
        return np.sqrt(np.mean(e[:end] ** 2)) if end else np.nan

    d = np.array([rms(a) - rms(b) for a, b in zip(errors_a, errors_b)])
    d = np.sort(d[~np.isnan(d)])
    n = len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "drives without a reading count as difference 0",
        """
def compare(errors_a, errors_b, limit):
    d = np.zeros(len(errors_a))
    for i, (a, b) in enumerate(zip(errors_a, errors_b)):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end > 0:
            d[i] = np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "B less A",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero(np.maximum(a, b) > limit)
        end = bad[0] if bad.size else a.size
        if end:
            d.append(np.sqrt(np.mean(b[:end] ** 2)) - np.sqrt(np.mean(a[:end] ** 2)))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "quantiles of the differences: how they scatter, not how sure the median is",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    return tuple(np.quantile(d, [0.025, 0.975]))
""",
    ),
    (
        "12-paired",
        "one order statistic too far in",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d, n, total = sorted(d), len(d), 0
    for k in range(n):
        total += comb(n, k) / 2**n
        if total > 0.025:
            return d[k], d[n - 1 - k]
""",
    ),
    (
        "12-paired",
        "5 % on either side",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.05)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "mean error instead of RMS",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.mean(a[:end]) - np.mean(b[:end]))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "readings after coming back count again",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        ok = (a <= limit) & (b <= limit)
        if ok[0]:
            d.append(np.sqrt(np.mean(a[ok] ** 2)) - np.sqrt(np.mean(b[ok] ** 2)))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "RMS of the difference of the errors",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean((a[:end] - b[:end]) ** 2)))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "normal approximation of the coins, rounded",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d, n = np.sort(d), len(d)
    j = max(int(round(n / 2 - 1.96 * np.sqrt(n) / 2)), 0)
    return d[j], d[n - 1 - j]
""",
    ),
    (
        "12-paired",
        "marks what comes after straying as nan in the caller's arrays",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        if len(bad):
            a[bad[0]:] = np.nan
            b[bad[0]:] = np.nan
            if bad[0] == 0:
                continue
        d.append(np.sqrt(np.nanmean(a**2)) - np.sqrt(np.nanmean(b**2)))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "coins of all drives, also those left out",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    n = len(errors_a)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    d = np.sort(d)
    return d[few - 1], d[-few]
""",
    ),
    (
        "12-paired",
        "forgets to sort",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    n = len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return min(d[few - 1], d[n - few]), max(d[few - 1], d[n - few])
""",
    ),
]
