# %% way: with SciPy's paired test
def compare_versions(worlds_a, errors_a, worlds_b, errors_b):
    from scipy.stats import t, ttest_rel

    of_a, of_b = (dict(zip(w, np.log(e))) for w, e in ((worlds_a, errors_a), (worlds_b, errors_b)))
    common = sorted(of_a.keys() & of_b.keys())
    x, y = [of_a[k] for k in common], [of_b[k] for k in common]
    test = ttest_rel(x, y)
    low, high = np.exp(test.confidence_interval(0.95))
    better = "cannot tell" if test.pvalue > 0.05 else ["A", "B"][int(test.statistic > 0)]
    ratio = abs(test.statistic) / len(common) ** 0.5
    for n in range(2, 1001):
        if t.sf(ratio * n**0.5, n - 1) < 0.025:
            break
    return [low, high, better, n]

# %% way: a table of quantiles
def compare_versions(worlds_a, errors_a, worlds_b, errors_b):
    from scipy.special import stdtrit

    table = {n: round(float(stdtrit(n - 1, 0.975)), 3) for n in range(2, 1001)}
    same = worlds_a[:, None] == worlds_b
    i, j = np.nonzero(same)
    d = [np.log(x / y) for x, y in zip(errors_a[i], errors_b[j])]
    n = len(d)
    mean = sum(d) / n
    s = (sum((x - mean) ** 2 for x in d) / (n - 1)) ** 0.5
    middle, factor = np.exp(mean), np.exp(table[n] * s / n**0.5)
    better = np.where(middle * factor < 1, "A", np.where(middle > factor, "B", "cannot tell"))
    needed = min((k for k in table if table[k] * s < abs(mean) * k**0.5), default=1000)
    return middle / factor, middle * factor, better, float(needed)

# %% right: sorted worlds, and a search by doubling
from scipy.stats import t as student

def compare_versions(worlds_a, errors_a, worlds_b, errors_b):
    order_a, order_b = np.argsort(worlds_a), np.argsort(worlds_b)
    keep_a = np.isin(worlds_a[order_a], worlds_b)
    keep_b = np.isin(worlds_b[order_b], worlds_a)
    ratio = errors_a[order_a][keep_a] / errors_b[order_b][keep_b]
    log = np.log10(ratio)
    low, high = student.interval(0.95, len(log) - 1, log.mean(), log.std(ddof=1) / len(log) ** 0.5)

    def decides(n):
        return abs(log.mean()) > student.isf(0.025, n - 1) * log.std(ddof=1) / n**0.5

    below, above = 1, 2
    while above < 1000 and not decides(above):
        below, above = above, 2 * above
    while above - below > 1:
        middle = (below + above) // 2
        below, above = (below, middle) if decides(middle) else (middle, above)
    verdict = "cannot tell"
    if low > 0:
        verdict = "B"
    if high < 0:
        verdict = "A"
    return 10**low, 10**high, verdict, min(above, 1000)

# %% wrong: a percentile bootstrap of the mean
def compare_versions(worlds_a, errors_a, worlds_b, errors_b):
    _, i, j = np.intersect1d(worlds_a, worlds_b, return_indices=True)
    d = np.log(errors_a[i] / errors_b[j])
    rng = np.random.default_rng(0)
    def interval(n):
        return np.quantile(rng.choice(d, (2000, n)).mean(axis=1), [0.025, 0.975])
    low, high = interval(len(d))
    better = "A" if high < 0 else "B" if low > 0 else "cannot tell"
    needed = next((n for n in range(2, 300) if np.prod(interval(n)) > 0), 300)
    return np.exp(low), np.exp(high), better, needed

# %% wrong: two separate intervals, and whether they overlap
def compare_versions(worlds_a, errors_a, worlds_b, errors_b):
    from scipy.stats import ttest_1samp, t
    x, y = np.log(errors_a), np.log(errors_b)
    a, b = (np.exp(ttest_1samp(z, 0).confidence_interval()) for z in (x, y))
    better = "A" if a[1] < b[0] else "B" if b[1] < a[0] else "cannot tell"
    n = 2
    while t.ppf(0.975, n - 1) * (x.std(ddof=1) + y.std(ddof=1)) / n**0.5 > abs(x.mean() - y.mean()) and n < 1000:
        n += 1
    return a[0] / b[1], a[1] / b[0], better, n

# %% wrong: relative differences, a normal interval, and a limit of 5 %
def compare_versions(worlds_a, errors_a, worlds_b, errors_b):
    common = [w for w in worlds_a if w in worlds_b]
    r = np.array([errors_a[list(worlds_a).index(w)] / errors_b[list(worlds_b).index(w)] for w in common])
    half = 1.96 * np.std(r) / np.sqrt(len(r))
    better = "A" if r.mean() < 0.95 else "B" if r.mean() > 1.05 else "cannot tell"
    return r.mean() - half, r.mean() + half, better, int((1.96 * np.std(r) / (r.mean() - 1)) ** 2) + 2

# %% wrong: everything right, but the logarithms replace the caller's errors
def compare_versions(worlds_a, errors_a, worlds_b, errors_b):
    from scipy import stats
    errors_a[:], errors_b[:] = np.log(errors_a), np.log(errors_b)
    _, i, j = np.intersect1d(worlds_a, worlds_b, return_indices=True)
    d = errors_a[i] - errors_b[j]
    n = np.arange(2, 1001)
    half = stats.t.ppf(0.975, n - 1) * d.std(ddof=1) / np.sqrt(n)
    low, high = d.mean() - half[len(d) - 2], d.mean() + half[len(d) - 2]
    better = "A" if high < 0 else "B" if low > 0 else "cannot tell"
    enough = [*n[half < abs(d.mean())], 1000]
    return np.exp(low), np.exp(high), better, enough[0]
