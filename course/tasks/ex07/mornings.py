"""Programs of task 07-mornings."""

from course.tasks import Slip, Stumble

TASK = "07-mornings"
MUTANTS = 150

WAYS = {
    "likelihood": """
def survey(morning, door, z, sigma):
    on = np.eye(morning.max() + 1)[morning]
    J = np.eye(door.max() + 1)[door]
    found = []
    for size in sigma * np.geomspace(0.5, 20, 9):
        V = sigma**2 * np.eye(len(z)) + size**2 * on @ on.T
        W = np.linalg.inv(V)
        P = np.linalg.inv(J.T @ W @ J)
        p = P @ J.T @ W @ z
        r = z - J @ p
        L = r @ W @ r + np.linalg.slogdet(V)[1] - np.linalg.slogdet(P)[1]
        found.append((L, p, P))
    L, p, P = (np.array(list(parts)) for parts in zip(*found))
    share = np.exp(-(L - L.min()) / 2)
    share /= share.sum()
    mean = share @ p
    off = p - mean
    return mean, np.einsum("g,gij->ij", share, P + off[:, :, None] * off[:, None, :])
""",
    "two rounds": """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1

    def fit(size):
        W = np.zeros((m + n, m + n))
        for i, j in zip(door, m + morning):
            for a in (i, j):
                for b in (i, j):
                    W[a, b] += 1 / sigma**2
        W[range(m, m + n), range(m, m + n)] += 1 / size**2
        C = np.linalg.inv(W)
        told = np.r_[np.bincount(door, z), np.bincount(morning, z)] / sigma**2
        return C @ told, C

    x, C = fit(1000 * sigma)  # first as if they could be anything
    M = np.eye(n) - 1 / n
    known = np.trace(M @ C[m:, m:] @ M)
    square = (x[m:] @ M @ x[m:] - known) / (n - 1)
    x, C = fit(np.sqrt(max(square, sigma**2 / 4)))
    return x[:m], C[:m, :m]
""",
    "differences and means": """
def survey(morning, door, z, sigma):
    # the mornings' means are taken off: what is left knows no shift, but only the ways
    m, n = door.max() + 1, morning.max() + 1
    J, on = np.eye(m)[door], np.eye(n)[morning]
    inside = on / on.sum(axis=0) @ on.T
    least = np.linalg.pinv(J.T @ (J - inside @ J)) @ J.T @ (z - inside @ z)
    shifts = np.array([np.mean((z - least[door])[morning == k]) for k in range(n)])
    counts = on.sum(axis=0)
    square = max(np.var(shifts, ddof=1) - np.mean(sigma**2 / counts), sigma**2 / 4)
    V = sigma**2 * np.eye(len(z)) + square * on @ on.T
    P = np.linalg.inv(J.T @ np.linalg.solve(V, J))
    return P @ J.T @ np.linalg.solve(V, z), P
""",
    "a filter over the mornings": """
def survey(morning, door, z, sigma):
    m, n = door.max() + 1, morning.max() + 1

    def filtered(size):
        x, P = np.zeros(m + n), np.diag(np.r_[np.full(m, 1e4), np.full(n, size**2)])
        for k in range(len(z)):
            H = np.zeros(m + n)
            H[door[k]] = H[m + morning[k]] = 1
            K = P @ H / (H @ P @ H + sigma**2)
            x = x + K * (z[k] - H @ x)
            P = P - np.outer(K, H @ P)
        return x, P

    size = 5 * sigma
    for _ in range(3):
        x, P = filtered(size)
        size = np.sqrt(np.mean(x[m:] ** 2 + np.diag(P)[m:]))
    return x[:m].tolist(), P[:m, :m].tolist()
""",
}

_MEAN = """
def survey(morning, door, z, sigma):
    n = np.bincount(door)
    p = np.bincount(door, z) / n
    return p, {P}
"""
_STEPS = """
def survey(morning, door, z, sigma):
    m = door.max() + 1
    x, P = np.zeros(1 + m), np.diag(np.r_[{start}, np.full(m, 1e4)])
    for k in range(len(z)):
        if k and morning[k] != morning[k - 1]:
            {between}
        H = np.zeros(1 + m)
        H[0], H[1 + door[k]] = -1, 1
        K = P @ H / (H @ P @ H + sigma**2)
        x, P = x + K * (z[k] - H @ x), P - np.outer(K, H @ P)
    return x[1:], P[1:, 1:]
"""
_SIZE = "size = np.sqrt(np.mean(state[m:] ** 2 + np.diag(C)[m:]))"
_OUT = "return state[:m], C[:m, :m]"

SLIPS = (
    Slip(
        "independent",
        "All readings are taken for independent, but those of one morning are off together: their "
        "common error does not average out, and it makes neighbours err alike.",
        _MEAN.format(P="np.diag(sigma**2 / n)"),
        _STEPS.format(start="0.0", between="pass"),
    ),
    Slip(
        "spread-but-not-shared",
        "The readings' spread tells how large the errors are, but not that those of a morning are "
        "one and the same. The map could be far better, and neighbouring doors err together.",
        _MEAN.format(P="np.diag(np.sum((z - p[door]) ** 2) / (len(z) - len(n)) / n)"),
    ),
    Slip(
        "free",
        "The mornings' errors may be anything here. The ways between doors are well known then, but "
        "where all of it lies is not known at all: the readings tell how large these errors are.",
        [("size = 10 * sigma", "size = 1000 * sigma"), (_SIZE, "pass")],
        _STEPS.format(
            start="1e6", between="P[0], P[:, 0] = 0, 0\n            P[0, 0], x[0] = 1e6, 0"
        ),
    ),
    Slip(
        "guessed",
        "The size of the mornings' errors is a fixed number of sigmas. It differs from corridor to "
        "corridor, and the readings tell it.",
        (_SIZE, "pass"),
        [("size = 10 * sigma", "size = 3 * sigma"), (_SIZE, "pass")],
        [("size = 10 * sigma", "size = sigma"), (_SIZE, "pass")],
    ),
    Slip(
        "square-of-the-size",
        "A variance stands where its root should, or the other way round.",
        (_SIZE, "size = np.mean(state[m:] ** 2 + np.diag(C)[m:])"),
        ("1 / size**2", "1 / size"),
        ("J.T @ J / sigma**2", "J.T @ J / sigma"),
    ),
    Slip(
        "cross-terms-dropped",
        "P holds variances only. Doors passed on one morning err together, and P has to say so: the way "
        "between two of them is surer than both are by themselves.",
        (_OUT, "return state[:m], np.diag(np.diag(C)[:m])"),
    ),
    Slip(
        "inverse-for-covariance",
        "P is the inverse of a covariance: the surer a door, the larger it is here.",
        (_OUT, "return state[:m], np.linalg.inv(C[:m, :m])"),
    ),
    Slip(
        "conditional",
        "P is what would be left if the mornings' errors were known: the doors' block was cut out "
        "before the matrix was inverted, not after.",
        (_OUT, "return state[:m], np.linalg.inv(np.linalg.inv(C)[:m, :m])"),
    ),
    Slip(
        "standard-deviations",
        "P should hold variances; these are roots of them.",
        (_OUT, "return state[:m], np.sqrt(np.abs(C[:m, :m]))"),
    ),
    Slip(
        "half-of-the-readings",
        "σ² is off by a constant: each reading counts once, with the information 1/σ².",
        ("C @ J.T @ z / sigma**2", "C @ J.T @ z / sigma**2 / 2"),
        ("J.T @ J / sigma**2", "2 * J.T @ J / sigma**2"),
        (_OUT, "return state[:m], C[:m, :m] / 4"),
        (_OUT, "return state[:m], 4 * C[:m, :m]"),
    ),
    Slip(
        "sum-for-mean",
        "The size is that of the sum of the mornings' squared errors, not of their mean.",
        ("np.sqrt(np.mean(", "np.sqrt(np.sum("),
    ),
)

PASTED = {
    "each door fused by itself": """
def survey(morning, door, z, sigma):
    m = door.max() + 1
    p, P = np.zeros(m), np.full(m, np.inf)
    for k, i in enumerate(door):
        K = 1 if np.isinf(P[i]) else P[i] / (P[i] + sigma**2)
        p[i], P[i] = p[i] + K * (z[k] - p[i]), sigma**2 if K == 1 else P[i] - K * P[i]
    return p, np.diag(P)
""",
    "the corridor's step, a robot that stays": _STEPS.format(start="0.0", between="pass"),
    "the corridor's step, forgetting": _STEPS.format(
        start="0.0", between="P = np.diag(np.diag(P))"
    ),
    "covariance intersection": """
def survey(morning, door, z, sigma):
    p = np.bincount(door, z) / np.bincount(door)
    return p, sigma**2 * np.eye(len(p))
""",
}

STUMBLES = (
    Stumble("raised", ("np.eye(m)[door]", "np.eye(m)[z]")),
    Stumble(
        "malformed",
        (_OUT, "return state[:m]"),
        (_OUT, "return state, C"),
        (_OUT, "return state[:m], np.diag(C)[:m]"),
        (_OUT, "pass"),
    ),
)

EQUIVALENT = {
    "size = 10": "another first guess of the size: the rounds forget it",
    "size = 5": "another first guess of the size: the rounds forget it",
    "fit(1000": "another size that leaves the mornings' errors free in the first round",
    "range(8)": "a round more or less: they have converged",
    "range(3)": "a round more or less: they have nearly converged",
    "morning.max() + 1": "mornings without readings: they are as unsure as any, and change nothing",
    "geomspace": "other sizes to weigh, as close to each other",
    "off[:": "the maps of likely sizes differ by far less than P says",
    "/ 4": "another floor of the size: it matters only where mornings hardly err",
    "10000": "another P of what is not known at all",
    "on.sum(axis=0)": "how unsure the mornings' means are, which matters only where mornings hardly err",
}
