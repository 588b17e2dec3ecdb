# %% way: by SciPy's quantile of coins
def compare(errors_a, errors_b, limit):
    from scipy.stats import binom
    beyond = np.maximum(errors_a, errors_b) > limit
    end = np.where(beyond.any(axis=1), beyond.argmax(axis=1), beyond.shape[1])
    rms = [[np.sqrt(np.mean(e[:n] ** 2)) for e, n in zip(errors, end) if n] for errors in (errors_a, errors_b)]
    d = sorted(np.subtract(*rms))
    j = int(binom.ppf(0.025, len(d), 0.5))
    return d[j - 1], d[-j]

# %% way: every count asked one by one
def compare(errors_a, errors_b, limit):
    from scipy.stats import binom
    found = []
    for a, b in zip(errors_a, errors_b):
        kept = np.cumprod((a <= limit) & (b <= limit)).astype(bool)
        if kept.any():
            found.append(np.linalg.norm(a[kept]) / kept.sum() ** 0.5 - np.linalg.norm(b[kept]) / kept.sum() ** 0.5)
    d, n = np.sort(found), len(found)
    k = np.arange(n + 1)
    possible = k[(binom.cdf(k, n, 0.5) > 0.025) & (binom.sf(k - 1, n, 0.5) > 0.025)]
    edges = np.concatenate([[-np.inf], d, [np.inf]])
    return np.array([edges[possible[0]], edges[possible[-1] + 1]])

# %% way: the p-value between neighbours
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a.tolist(), errors_b.tolist()):
        x = y = n = 0
        for e, f in zip(a, b):
            if e > limit or f > limit:
                break
            x, y, n = x + e * e, y + f * f, n + 1
        if n:
            d.append((x / n) ** 0.5 - (y / n) ** 0.5)
    d.sort()
    from scipy.stats import binom
    below = np.arange(1, len(d))
    p = 2 * binom.cdf(np.minimum(below, len(d) - below), len(d), 0.5)
    right = [(low, high) for low, high, each in zip(d, d[1:], p) if each > 0.05]
    return [right[0][0], right[-1][1]]

# %% way: by drives in whole numbers
def compare(errors_a, errors_b, limit):
    near = np.logical_and.accumulate((errors_a <= limit) & (errors_b <= limit), axis=1)
    count = near.sum(axis=1)
    some = count > 0
    mean = [(near * errors**2.0).sum(axis=1)[some] / count[some] for errors in (errors_a, errors_b)]
    d = np.sort(np.sqrt(mean[0]) - np.sqrt(mean[1]))
    heads, total, j = 1, 1, 0
    for k in range(1, len(d)):
        if 40 * total > 2 ** len(d):
            break
        j = k
        heads = heads * (len(d) - k + 1) // k
        total += heads
    return d[j - 1], d[len(d) - j]

# %% pasted: the share of task 3
def compare(errors_a, errors_b, limit):
    nearer = np.sum(np.mean(errors_a, axis=1) < np.mean(errors_b, axis=1))
    return interval(nearer, len(errors_a))

# %% pasted: the lesson's median by bootstrap
def compare(errors_a, errors_b, limit):
    from scipy.stats import bootstrap
    d = np.sqrt(np.mean(errors_a**2, axis=1)) - np.sqrt(np.mean(errors_b**2, axis=1))
    found = bootstrap((d,), np.median, method="percentile", n_resamples=500, rng=np.random.default_rng(0))
    return found.confidence_interval

# %% pasted: the mean errors of both
def compare(errors_a, errors_b, limit):
    return np.mean(errors_a), np.mean(errors_b)

# %% right: order statistics found by walking up
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

# %% right: masks and the binomial of scipy
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

# %% right: each possible median tried between two neighbours
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

# %% wrong: the readings of all drives in one, and the median over these
def compare(errors_a, errors_b, limit):
    diffs = []
    for a, b in zip(errors_a, errors_b):
        for ea, eb in zip(a, b):
            if ea > limit or eb > limit:
                break
            diffs.append(ea - eb)
    diffs.sort()
    n = len(diffs)
    half = 0.98 * n**0.5
    return diffs[max(0, int(n / 2 - half))], diffs[min(n - 1, int(n / 2 + half))]

# %% wrong: normal approximation of the coins, rounded
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

# %% wrong: marks what comes after straying as nan in the caller's arrays
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
