"""Independent answers to 02-busy-room: right ones, and students' mistakes."""

RIGHT = [
    (
        "02-busy-room",
        "expectation maximisation: each reading's probability to be of the wall",
        """
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
        r = (w * q).sum(axis=0) / np.maximum(count, 1e-9)
        b = 1 - w.mean()
        # with the rounding's variance taken off, and one mean for each beam
        free = np.maximum(count - 1, 0)
        noise = np.sum(w * (q - r) ** 2) - np.sum(free) * step ** 2 / 12
        error = max(np.sqrt(max(noise, 0) / np.sum(free * r ** 2)), 0.0015)
    return error, b
""",
    ),
]

WRONG = [
    (
        "02-busy-room",
        "quiet_fit and nobody",
        """
def busy_fit(scans, step):
    return quiet_fit(scans), 0.0
""",
    ),
    (
        "02-busy-room",
        "constants in the middle of what is possible",
        """
def busy_fit(scans, step):
    return 0.01, 0.2
""",
    ),
    (
        "02-busy-room",
        "median absolute deviation, no rounding",
        """
def busy_fit(scans, step):
    r = np.median(scans, axis=0)
    error = 1.4826 * np.median(np.abs(scans - r) / r)
    blocked = np.mean(np.abs(scans - r) > 3 * error * r)
    return error, blocked
""",
    ),
    (
        "02-busy-room",
        "cuts the people off once, at a fixed 10 %, forgets the rounding",
        """
def busy_fit(scans, step):
    r = np.median(scans, axis=0)
    wall = np.abs(scans / r - 1) < 0.1
    return np.std((scans / r)[wall]), 1 - wall.mean()
""",
    ),
    (
        "02-busy-room",
        "iterates, but does not take the rounding off",
        """
def busy_fit(scans, step):
    r, error = np.median(scans, axis=0), 0.03
    for _ in range(10):
        wall = abs(scans - r) <= 2.5 * error * r + step / 2
        count = np.maximum(wall.sum(axis=0), 1)
        r = (wall * scans).sum(axis=0) / count
        error = np.sqrt(np.sum((wall * (scans / r - 1)) ** 2) / np.sum(count - 1))
    return error, 1 - wall.mean()
""",
    ),
    (
        "02-busy-room",
        "takes off step^2 instead of step^2/12",
        """
def busy_fit(scans, step):
    r, error = np.median(scans, axis=0), 0.03
    for _ in range(12):
        wall = abs(scans - r) <= 2.5 * error * r + step / 2
        count = np.maximum(wall.sum(axis=0), 1)
        r = (wall * scans).sum(axis=0) / count
        noise = np.sum(wall * (scans - r) ** 2) - np.sum(count - 1) * step ** 2
        error = max(np.sqrt(max(noise, 0) / np.sum((count - 1) * r ** 2)), 0.001)
    return error, 1 - wall.mean()
""",
    ),
    (
        "02-busy-room",
        "returns blocked first",
        """
def busy_fit(scans, step):
    r, error = np.median(scans, axis=0), 0.03
    for _ in range(12):
        wall = abs(scans - r) <= 2.5 * error * r + step / 2
        count = wall.sum(axis=0)
        r = np.where(count > 0, (wall * scans).sum(axis=0) / np.maximum(count, 1), r)
        free = np.maximum(count - 1, 0)
        noise = np.sum(wall * (scans - r) ** 2) - np.sum(free) * step ** 2 / 12
        error = max(np.sqrt(max(noise, 0) / np.sum(free * r ** 2)), 0.001)
    return 1 - wall.mean(), error
""",
    ),
    (
        "02-busy-room",
        "the error in metres",
        """
def busy_fit(scans, step):
    r, sigma = np.median(scans, axis=0), 0.1
    for _ in range(12):
        wall = abs(scans - r) <= 2.5 * sigma + step / 2
        count = np.maximum(wall.sum(axis=0), 1)
        r = (wall * scans).sum(axis=0) / count
        noise = np.sum(wall * (scans - r) ** 2) / np.sum(count - 1) - step ** 2 / 12
        sigma = np.sqrt(max(noise, 1e-5))
    return sigma, 1 - wall.mean()
""",
    ),
    (
        "02-busy-room",
        "the mean of all readings for the wall",
        """
def busy_fit(scans, step):
    r = scans.mean(axis=0)
    off = scans / r - 1
    keep = np.abs(off) < 2 * off.std()
    var = np.var(off[keep]) - np.mean((step / r) ** 2) / 12
    return np.sqrt(max(var, 1e-6)), 1 - keep.mean()
""",
    ),
    (
        "02-busy-room",
        "the largest reading for the wall",
        """
def busy_fit(scans, step):
    r = scans.max(axis=0)
    wall = scans > 0.9 * r
    share = np.where(wall, scans / r, np.nan)
    var = np.nanvar(share) - np.mean((step / r) ** 2) / 12
    return np.sqrt(max(var, 4e-6)), 1 - wall.mean()
""",
    ),
    (
        "02-busy-room",
        "averages the errors of the beams with equal weight, clips at zero each",
        """
def busy_fit(scans, step):
    errors, people = [], 0
    for column in scans.T:
        r = np.median(column)
        wall = column[np.abs(column - r) < 0.08 * r + step / 2]
        people += len(column) - len(wall)
        var = max(np.var(wall, ddof=1) - step ** 2 / 12, 0) if len(wall) > 1 else 0
        errors.append(np.sqrt(var) / r)
    return max(np.mean(errors), 0.001), people / scans.size
""",
    ),
    (
        "02-busy-room",
        "percentiles: the upper half only",
        """
def busy_fit(scans, step):
    r = np.percentile(scans, 60, axis=0)
    high = np.percentile(scans, 84, axis=0)
    error = np.median((high - r) / r)
    blocked = np.mean(scans < r * (1 - 3 * error))
    return max(error, 0.002), blocked
""",
    ),
    (
        "02-busy-room",
        "changes scans: sets people to NaN in place",
        """
def busy_fit(scans, step):
    for _ in range(8):
        r = np.nanmedian(scans, axis=0)
        var = np.nanmean((scans - r) ** 2 - step ** 2 / 12) / np.mean(r ** 2)
        error = np.sqrt(max(var, 1e-6))
        scans[np.abs(scans - r) > 2.5 * error * r + step] = np.nan
    return error, np.isnan(scans).mean()
""",
    ),
    (
        "02-busy-room",
        "cuts at 1 sigma without correcting for it",
        """
def busy_fit(scans, step):
    r, error = np.median(scans, axis=0), 0.03
    for _ in range(12):
        wall = abs(scans - r) <= 1.2 * error * r + step / 2
        count = np.maximum(wall.sum(axis=0), 1)
        r = (wall * scans).sum(axis=0) / count
        noise = np.sum(wall * (scans - r) ** 2) - np.sum(count - 1) * step ** 2 / 12
        error = max(np.sqrt(max(noise, 0) / np.sum((count - 1) * r ** 2)), 0.001)
    return error, 1 - wall.mean()
""",
    ),
]
