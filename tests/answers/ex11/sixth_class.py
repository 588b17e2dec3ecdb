"""A sixth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "11-weigh",
        "scipy's log density, with its constant, from a loop over samples",
        """
from scipy.stats import multivariate_normal

def log_likelihoods(rows, p, z, R):
    noise = multivariate_normal([0, 0], R)
    logs = []
    for x in np.asarray(rows, dtype=float):
        v = np.asarray(z, dtype=float) - h(x, np.asarray(p, dtype=float))
        v[:, 1] = wrap(v[:, 1])
        logs.append(np.sum(noise.logpdf(v)))
    return np.array(logs)
""",
    ),
    (
        "11-draw",
        "a comb that is shifted by anything, and comes in again on the other side",
        """
def draw(weights, rng):
    n = len(weights)
    teeth = np.sort((rng.random() + np.arange(n) / n) % 1)
    ends = np.cumsum(weights)
    picked, i = [], 0
    for tooth in teeth:
        while i < n - 1 and ends[i] <= tooth:
            i += 1
        while weights[i] == 0:
            i -= 1
        picked.append(i)
    return np.array(picked)
""",
    ),
    (
        "11-proposal",
        "scipy's log densities in a loop",
        """
from scipy.stats import multivariate_normal

def reweigh(before, after, weights, u, C, m, D):
    logs = np.log(weights)
    for i in range(len(weights)):
        a, b = before[i], after[i]
        shift = b[:2] - a[:2]
        drive = [shift @ [np.cos(a[2]), np.sin(a[2])], wrap(b[2] - a[2])]
        logs[i] += multivariate_normal.logpdf(drive, u, C)
        logs[i] -= multivariate_normal.logpdf(drive, m[i], D[i])
    return normalise(logs)
""",
    ),
]

WRONG = [
    (
        "11-weigh",
        "the mean over the sightings, so that a long scan does not weigh more",
        """
def log_likelihoods(rows, p, z, R):
    W, logs = np.linalg.inv(R), []
    for x in rows:
        v = z - h(x, p)
        v[:, 1] = wrap(v[:, 1])
        logs.append(np.mean(-0.5 * np.sum(v @ W * v, axis=1)))
    return np.array(logs)
""",
    ),
    (
        "11-weigh",
        "each sighting belongs to the landmark that it fits best",
        """
def log_likelihoods(rows, p, z, R):
    W, logs = np.linalg.inv(R), np.zeros(len(rows))
    for i, x in enumerate(rows):
        expected = h(x, p)
        for seen in z:
            v = seen - expected
            v[:, 1] = wrap(v[:, 1])
            logs[i] += np.max(-0.5 * np.einsum("ja,ab,jb->j", v, W, v))
    return logs
""",
    ),
    (
        "11-draw",
        "whole copies first, and the rest drawn by lot",
        """
def draw(weights, rng):
    n = len(weights)
    copies = np.floor(n * weights).astype(int)
    rest = n * weights - copies
    left = n - copies.sum()
    if left > 0:
        for i in rng.choice(n, left, p=rest / rest.sum()):
            copies[i] += 1
    return np.repeat(np.arange(n), copies)
""",
    ),
    (
        "11-draw",
        "the weights sorted first, and the places in the sorted list returned",
        """
def draw(weights, rng):
    n = len(weights)
    heavy = np.sort(weights)[::-1]
    ends = np.cumsum(heavy)
    ends[-1] = 1.0
    picked, i, tooth = np.zeros(n, dtype=int), 0, rng.random() / n
    for k in range(n):
        while tooth > ends[i]:
            i += 1
        picked[k] = i
        tooth += 1 / n
    return picked
""",
    ),
    (
        "11-localise",
        "first draw anew if the weights that came in ask for it, then move and weigh",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    if effective_size(weights) < len(rows) / 2:
        rows = rows[draw(weights, rng)]
        weights = np.full(len(rows), 1 / len(rows))
    rows = move(rows, u, C, rng)
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    return rows, weights
""",
    ),
    (
        "11-localise",
        "the whole cloud moves by one draw of the noise",
        """
def localise(rows, weights, u, C, p, z, R, rng):
    drive = rng.multivariate_normal(u, C)
    rows = np.array([f_odometry(x, drive) for x in rows])
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    if 1 / np.sum(weights**2) < len(rows) / 2:
        rows = rows[draw(weights, rng)]
        weights = np.ones(len(rows)) / len(rows)
    return rows, weights
""",
    ),
    (
        "11-proposal",
        "the wheels' density of the middle of each drawing, not of the drive made",
        """
def reweigh(before, after, weights, u, C, m, D):
    logs = np.log(weights)
    for i in range(len(weights)):
        S = C + D[i]
        v = m[i] - u
        logs[i] += -0.5 * v @ np.linalg.inv(S) @ v - 0.5 * np.log(np.linalg.det(S))
    return normalise(logs)
""",
    ),
    (
        "11-kidnapped",
        "a tenth of strangers from the sighting in every step, weighed as all others",
        """
def find_again(rows, weights, u, C, p, z, R, rng):
    n = len(rows)
    rows = rows[draw(weights / weights.sum(), rng)]
    rows = move(rows, u, C, rng)
    k = n // 10
    r = z[0, 0] + np.sqrt(R[0, 0]) * rng.standard_normal(k)
    around = rng.uniform(-np.pi, np.pi, k)
    at = p[0] - np.column_stack([r * np.cos(around), r * np.sin(around)])
    b = z[0, 1] + np.sqrt(R[1, 1]) * rng.standard_normal(k)
    rows[rng.choice(n, k, replace=False)] = np.column_stack([at, wrap(around - b)])
    return rows, normalise(log_likelihoods(rows, p, z, R))
""",
    ),
]
