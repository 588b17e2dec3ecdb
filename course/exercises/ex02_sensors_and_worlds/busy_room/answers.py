# %% way: from the densest half
def densest(scans):
    """The middle of the shortest interval with half of a beam's readings."""
    s, half = np.sort(scans, axis=0), len(scans) // 2
    at = (s[half:] - s[:-half]).argmin(axis=0)
    return np.array([s[k : k + half + 1, b].mean() for b, k in enumerate(at)])

def busy_fit(scans, step):
    r, e = densest(scans), 0.03
    for _ in range(15):
        keep = np.abs(scans - r) < 2.6 * e * r + step / 2
        n = keep.sum(axis=0)
        r = np.where(n > 1, np.where(keep, scans, 0).sum(axis=0) / np.maximum(n, 1), r)
        v = np.where(keep, (scans - r) ** 2, 0).sum() - (n - 1).sum() * step**2 / 12
        e = np.sqrt(max(v / ((n - 1) * r**2).sum(), 1e-6))
    return [e, np.mean(~keep)]

# %% way: what every step is worth
def densest(scans):
    """The middle of the shortest interval with half of a beam's readings."""
    s, half = np.sort(scans, axis=0), len(scans) // 2
    at = (s[half:] - s[:-half]).argmin(axis=0)
    return np.array([s[k : k + half + 1, b].mean() for b, k in enumerate(at)])

def busy_fit(scans, step):
    from scipy.special import ndtr

    r, e, p = densest(scans), 0.02, 0.2
    for _ in range(25):
        low, high = (np.clip((scans + side * step / 2 - r) / (e * r), -6, 6) for side in (-1, 1))
        mass = np.maximum(ndtr(high) - ndtr(low), 1e-9)
        a, b = (np.exp(-(x**2) / 2) / np.sqrt(2 * np.pi) for x in (low, high))
        wall = (1 - p) * mass / ((1 - p) * mass + p * step / r * (scans <= r) + 1e-12)
        first, second = wall * (a - b) / mass, wall * (1 + (low * a - high * b) / mass)
        n = np.maximum(wall.sum(axis=0), 1e-9)
        shift = first.sum(axis=0) / n
        r = r + e * r * shift
        e = e * np.sqrt((second.sum(axis=0) - n * shift**2).sum() / n.sum())
        p = 1 - wall.mean()
    return e * np.sqrt(n.sum() / (n.sum() - len(n))), p

# %% way: far beams only
def densest(scans):
    """The middle of the shortest interval with half of a beam's readings."""
    s, half = np.sort(scans, axis=0), len(scans) // 2
    at = (s[half:] - s[:-half]).argmin(axis=0)
    return np.array([s[k : k + half + 1, b].mean() for b, k in enumerate(at)])

def busy_fit(scans, step):
    r = densest(scans)
    far = r > np.quantile(r, 0.4)
    e = 0.03
    for _ in range(15):
        keep = abs(scans - r) <= 2.5 * e * r + step / 2
        n = np.maximum(keep.sum(axis=0), 1)
        r = np.where(keep.any(axis=0), (keep * scans).sum(axis=0) / n, r)
        v = (keep * (scans - r) ** 2).sum(axis=0)[far].sum() / (n - 1)[far].sum() - step**2 / 12
        e = np.sqrt(max(v, 1e-6) / np.average(r[far] ** 2, weights=(n - 1)[far]))
    return e, 1 - keep.sum() / keep.size

# %% way: beam by beam
def busy_fit(scans, step):
    error = 0.03
    places = [float(np.median(column)) for column in scans.T]
    for _ in range(10):
        squares, freedom, wanted, blocked = 0.0, 0, 0.0, 0
        for k, column in enumerate(scans.T):
            good = column[abs(column - places[k]) <= 2.5 * error * places[k] + step / 2]
            blocked += len(column) - len(good)
            if len(good) > 1:
                places[k] = good.mean()
                squares += good.var() * len(good)
                freedom += len(good) - 1
                wanted += (len(good) - 1) * places[k] ** 2
        error = max((squares - freedom * step**2 / 12) / wanted, 1e-6) ** 0.5
    return np.array([error, blocked / scans.size])

# %% pasted: the fit of a quiet room
def busy_fit(scans, step):
    return quiet_fit(scans), 0.2

# %% pasted: the lesson's robust spread
def busy_fit(scans, step):
    share = scans / np.median(scans, axis=0) - 1
    error = 1.4826 * np.median(abs(share))
    return error, np.mean(abs(share) > 3 * error)

# %% pasted: robust about the mean
def busy_fit(scans, step):
    share = scans / scans.mean(axis=0) - 1
    error = 1.4826 * np.nanmedian(abs(share))
    return error, (abs(share) > 0.03).mean()

# %% right: expectation maximisation: each reading's probability to be of the wall
from math import erf
_erf = np.vectorize(erf)


def busy_fit(scans, step):
    q = scans

    def cdf(x):
        return 0.5 * (1 + _erf(x / np.sqrt(2)))

    def likely(error, r):
        s = error * r
        return cdf((q + step / 2 - r) / s) - cdf((q - step / 2 - r) / s)

    r, b, error = np.median(np.sort(q, axis=0)[len(q) // 4:], axis=0), 0.2, 0.015
    for _ in range(25):
        wall = (1 - b) * likely(error, r)
        person = b * step / r * (q <= r + step / 2)
        w = wall / (wall + person + 1e-12)
        count = w.sum(axis=0)
        r = np.where(count > 0.1, (w * q).sum(axis=0) / np.maximum(count, 0.1), r)
        b = 1 - w.mean()
        # with the rounding's variance taken off, and one mean for each beam
        free = np.maximum(count - 1, 0)
        noise = np.sum(w * (q - r) ** 2) - np.sum(free) * step ** 2 / 12
        error = max(np.sqrt(max(noise, 0) / np.sum(free * r ** 2)), 0.0015)
    return error, b

# %% wrong: quiet_fit and nobody
def busy_fit(scans, step):
    return quiet_fit(scans), 0.0

# %% wrong: constants in the middle of what is possible
def busy_fit(scans, step):
    return 0.01, 0.2

# %% wrong: iterates, but does not take the rounding off
def busy_fit(scans, step):
    r, error = np.median(scans, axis=0), 0.03
    for _ in range(10):
        wall = abs(scans - r) <= 2.5 * error * r + step / 2
        count = np.maximum(wall.sum(axis=0), 1)
        r = (wall * scans).sum(axis=0) / count
        error = np.sqrt(np.sum((wall * (scans / r - 1)) ** 2) / np.sum(count - 1))
    return error, 1 - wall.mean()

# %% wrong: percentiles: the upper half only
def busy_fit(scans, step):
    r = np.percentile(scans, 60, axis=0)
    high = np.percentile(scans, 84, axis=0)
    error = np.median((high - r) / r)
    blocked = np.mean(scans < r * (1 - 3 * error))
    return max(error, 0.002), blocked

# %% wrong: changes scans: sets people to NaN in place
def busy_fit(scans, step):
    for _ in range(8):
        r = np.nanmedian(scans, axis=0)
        var = np.nanmean((scans - r) ** 2 - step ** 2 / 12) / np.mean(r ** 2)
        error = np.sqrt(max(var, 1e-6))
        scans[np.abs(scans - r) > 2.5 * error * r + step] = np.nan
    return error, np.isnan(scans).mean()
