# %% way: beam by beam
def log_likelihood(ranges, expected, weights, error, rate, range_max):
    total = 0.0
    logs = [np.log(w) if w > 0 else -np.inf for w in weights]
    for r, wall in zip(ranges, expected):
        if np.isnan(r):
            total += logs[2]
            continue
        s = error * wall
        part = ndtr((range_max - wall) / s) - ndtr((0 - wall) / s)
        causes = [logs[0] - (r - wall) ** 2 / (2 * s**2) - np.log(s) - np.log(2 * np.pi) / 2 - np.log(part)]
        causes.append(logs[3] - np.log(range_max))
        if r <= wall:
            causes.append(logs[1] + np.log(rate / -np.expm1(-rate * wall)) - rate * r)
        total += np.logaddexp.reduce(causes)
    return total

# %% way: the largest logarithm subtracted
def log_likelihood(ranges, expected, weights, error, rate, range_max):
    lost = np.isnan(ranges)
    if np.any(lost) and weights[2] == 0:
        return -np.inf
    r, e = ranges[~lost], expected[~lost]
    v, n = (r - e) / (error * e), len(r)
    logs = np.full((3, n), -np.inf)
    if weights[0] > 0:
        outside = ndtr(-1 / error) + ndtr((e - range_max) / (error * e))
        logs[0] = np.log(weights[0] / np.sqrt(2 * np.pi)) - np.log(error * e) - v * v / 2 - np.log1p(-outside)
    if weights[1] > 0:
        near = r < e
        logs[1, near] = np.log(weights[1] * rate / (1 - np.exp(-rate * e[near]))) - rate * r[near]
    if weights[3] > 0:
        logs[2] = np.log(weights[3] / range_max)
    top = logs.max(axis=0)
    if not np.all(np.isfinite(top)):
        return -np.inf
    total = np.sum(top + np.log(np.exp(logs - top).sum(axis=0)))
    return total + np.sum(lost) * np.log(weights[2]) if np.any(lost) else total

# %% pasted: the squared innovations of hits alone
def log_likelihood(ranges, expected, weights, error, rate, range_max):
    v = (ranges - expected) / (error * expected)
    return -0.5 * np.nansum(v**2)

# %% right: scipy's distributions
from scipy import stats
from scipy.special import logsumexp

def log_likelihood(ranges, expected, weights, error, rate, range_max):
    lost = np.isnan(ranges)
    r, e = ranges[~lost], expected[~lost]
    s = error * e
    parts = np.array([
        stats.truncnorm.logpdf(r, -e / s, (range_max - e) / s, e, s),
        stats.truncexpon.logpdf(r, rate * e, 0, 1 / rate),
        stats.uniform.logpdf(r, 0, range_max),
    ])
    with np.errstate(divide="ignore"):
        log_w = np.log(weights)
    total = logsumexp(parts + log_w[[0, 1, 3], None], axis=0).sum()
    return total + (lost.sum() * log_w[2] if lost.sum() else 0.0)

# %% right: erf, and a list of logarithms
from math import erf, exp, inf, log, pi, sqrt

def log_likelihood(ranges, expected, weights, error, rate, range_max):
    def add(a, b):
        a, b = max(a, b), min(a, b)
        return a if b == -inf else a + log(1 + exp(b - a))

    def safe(w):
        return log(w) if w > 0 else -inf

    out = []
    for k in range(len(ranges)):
        r, e = ranges[k], expected[k]
        if r != r:
            out.append(safe(weights[2]))
            continue
        s = error * e
        mass = 0.5 * (erf((range_max - e) / s / sqrt(2)) + erf(e / s / sqrt(2)))
        p = add(safe(weights[0]) - 0.5 * ((r - e) / s) ** 2 - log(s * sqrt(2 * pi) * mass), safe(weights[3] / range_max))
        if r < e:
            p = add(p, safe(weights[1]) + log(rate) - rate * r - log(1 - exp(-rate * e)))
        out.append(p)
    return sum(out)

# %% wrong: the integrals are computed by sums over a coarse grid
def log_likelihood(ranges, expected, weights, error, rate, range_max):
    lost = np.isnan(ranges)
    r, e = ranges[~lost], expected[~lost]
    grid = np.linspace(0, range_max, 201)
    total = 0.0
    with np.errstate(divide="ignore"):
        lw = np.log(weights)
    for a, b in zip(r, e):
        hit, short = -0.5 * ((grid - b) / (error * b)) ** 2, np.where(grid < b, np.exp(-rate * grid), 0)
        logs = [lw[0] - 0.5 * ((a - b) / (error * b)) ** 2 - np.log(np.trapezoid(np.exp(hit), grid)), lw[3] - np.log(range_max)]
        if a < b:
            logs.append(lw[1] - rate * a - np.log(np.trapezoid(short, grid)))
        total += np.logaddexp.reduce(logs)
    return total + (lost.sum() * lw[2] if lost.any() else 0)

# %% wrong: readings of a hit beyond an end are clipped to it, so its ends hold the rest of the Gaussian
def log_likelihood(ranges, expected, weights, error, rate, range_max):
    lost = np.isnan(ranges)
    r, e = ranges[~lost], expected[~lost]
    s = error * e
    with np.errstate(divide="ignore"):
        a, b, c, d = np.log(weights)
    hit = a - 0.5 * ((r - e) / s) ** 2 - np.log(s * np.sqrt(2 * np.pi))
    c = np.logaddexp(c, a + np.log(ndtr((expected - range_max) / (error * expected))))
    short = np.where(r < e, b + np.log(rate) - rate * r - np.log(1 - np.exp(-rate * e)), -np.inf)
    beams = np.logaddexp(np.logaddexp(hit, short), d - np.log(range_max))
    return beams.sum() + c[lost].sum()

# %% wrong: densities in plain numbers, with a floor
def log_likelihood(ranges, expected, weights, error, rate, range_max):
    lost = np.isnan(ranges)
    r, e = ranges[~lost], expected[~lost]
    s = error * e
    p = weights[0] * np.exp(-0.5 * ((r - e) / s) ** 2) / (np.sqrt(2 * np.pi) * s)
    p = p / (ndtr((range_max - e) / s) - ndtr(-e / s)) + weights[3] / range_max
    p = p + weights[1] * np.where(r < e, rate * np.exp(-rate * r) / (1 - np.exp(-rate * e)), 0)
    return np.sum(np.log(np.maximum(p, 1e-12))) + lost.sum() * np.log(max(weights[2], 1e-12))
