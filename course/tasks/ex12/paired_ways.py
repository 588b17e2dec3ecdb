"""Right ways of task 12-paired, and what earns a fifth at most."""

WAYS = {
    "by SciPy's quantile of coins": """
def compare(errors_a, errors_b, limit):
    from scipy.stats import binom
    beyond = np.maximum(errors_a, errors_b) > limit
    end = np.where(beyond.any(axis=1), beyond.argmax(axis=1), beyond.shape[1])
    rms = [[np.sqrt(np.mean(e[:n] ** 2)) for e, n in zip(errors, end) if n] for errors in (errors_a, errors_b)]
    d = sorted(np.subtract(*rms))
    j = int(binom.ppf(0.025, len(d), 0.5))
    return d[j - 1], d[-j]
""",
    "every count asked one by one": """
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
""",
    "the p-value between neighbours": """
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
""",
    "by drives in whole numbers": """
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
""",
}

PASTED = {
    "the share of task 3": """
def compare(errors_a, errors_b, limit):
    nearer = np.sum(np.mean(errors_a, axis=1) < np.mean(errors_b, axis=1))
    return interval(nearer, len(errors_a))
""",
    "the lesson's median by bootstrap": """
def compare(errors_a, errors_b, limit):
    from scipy.stats import bootstrap
    d = np.sqrt(np.mean(errors_a**2, axis=1)) - np.sqrt(np.mean(errors_b**2, axis=1))
    found = bootstrap((d,), np.median, method="percentile", n_resamples=500, rng=np.random.default_rng(0))
    return found.confidence_interval
""",
    "task 2 on both": """
def compare(errors_a, errors_b, limit):
    since = [[lost_since(e, limit) for e in errors] for errors in (errors_a, errors_b)]
    return np.mean(since, axis=1)
""",
}
