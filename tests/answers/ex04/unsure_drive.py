"""Independent answers to 04-unsure-drive: right ones, and students' mistakes."""

RIGHT = [
    (
        "04-unsure-drive",
        "closed form (Gaussian moments of cos and sin)",
        """
def unsure_drive(x, P, u, C):
    s2, d = P[2, 2], u[0]
    e, n = np.array([np.cos(x[2]), np.sin(x[2])]), np.array([-np.sin(x[2]), np.cos(x[2])])
    k = np.exp(-s2 / 2)
    along = np.expm1(-s2) ** 2 / 2
    across = -np.expm1(-2 * s2) / 2
    V = along * np.outer(e, e) + across * np.outer(n, n)
    S = np.zeros((3, 3))
    cross = np.outer(P[:2, 2], d * k * n)
    S[:2, :2] = P[:2, :2] + cross + cross.T + (d**2 + C[0, 0]) * V
    S[:2, :2] += C[0, 0] * k**2 * np.outer(e, e)
    S[:2, 2] = S[2, :2] = P[:2, 2] + d * s2 * k * n + C[0, 1] * k * e
    S[2, 2] = s2 + C[1, 1]
    return np.array([*(x[:2] + d * k * e), x[2] + u[1]]), S
""",
    ),
    (
        "04-unsure-drive",
        "100 000 samples, headings never wrapped",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(1)
    X = rng.multivariate_normal(x, P, 100_000)
    D = rng.multivariate_normal(u, C, 100_000)
    ends = X.copy()
    ends[:, 0] += D[:, 0] * np.cos(X[:, 2])
    ends[:, 1] += D[:, 0] * np.sin(X[:, 2])
    ends[:, 2] += D[:, 1]
    return ends.mean(axis=0), np.cov(ends.T)
""",
    ),
    (
        "04-unsure-drive",
        "Gauss-Hermite grid in five dimensions",
        """
def unsure_drive(x, P, u, C):
    nodes, w = np.polynomial.hermite_e.hermegauss(7)
    w = w / w.sum()
    T = np.stack(np.meshgrid(*[nodes] * 5, indexing="ij"), -1).reshape(-1, 5)
    W = np.prod(np.stack(np.meshgrid(*[w] * 5, indexing="ij"), -1).reshape(-1, 5), axis=1)
    X = x + T[:, :3] @ np.linalg.cholesky(P).T
    D = u + T[:, 3:] @ np.linalg.cholesky(C).T
    E = np.column_stack([
        X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]), X[:, 2] + D[:, 1]
    ])
    m = W @ E
    return m, (E - m).T * W @ (E - m)
""",
    ),
    (
        "04-unsure-drive",
        "f_odometry on 20 000 samples, circular mean, wrapped deviations",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(7)
    pairs = zip(rng.multivariate_normal(x, P, 20000), rng.multivariate_normal(u, C, 20000))
    ends = np.array([f_odometry(a, b) for a, b in pairs])
    middle = np.angle(np.exp(1j * ends[:, 2]).mean())
    ends[:, 2] = (ends[:, 2] - middle + np.pi) % (2 * np.pi) - np.pi
    mean = ends.mean(axis=0)
    off = ends - mean
    mean[2] += middle
    return mean, off.T @ off / len(off)
""",
    ),
]

WRONG = [
    (
        "04-unsure-drive",
        "returns the linearised",
        """
def unsure_drive(x, P, u, C):
    return linearised(x, P, u, C)
""",
    ),
    (
        "04-unsure-drive",
        "linearised, covariance doubled to be safe",
        """
def unsure_drive(x, P, u, C):
    mean, S = linearised(x, P, u, C)
    return mean, 2 * S
""",
    ),
    (
        "04-unsure-drive",
        "cheat: a large constant disc",
        """
def unsure_drive(x, P, u, C):
    mean = f_odometry(x, u)
    return mean, np.diag([4.0, 4.0, 0.5])
""",
    ),
    (
        "04-unsure-drive",
        "samples through f_odometry, wrapped headings averaged as numbers",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(0)
    starts = rng.multivariate_normal(x, P, 5000)
    drives = rng.multivariate_normal(u, C, 5000)
    ends = np.array([f_odometry(a, b) for a, b in zip(starts, drives)])
    return ends.mean(axis=0), np.cov(ends, rowvar=False)
""",
    ),
    (
        "04-unsure-drive",
        "12 samples",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(2)
    X, D = rng.multivariate_normal(x, P, 12), rng.multivariate_normal(u, C, 12)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        "04-unsure-drive",
        "100 samples",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(4)
    X, D = rng.multivariate_normal(x, P, 100), rng.multivariate_normal(u, C, 100)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        "04-unsure-drive",
        "unscented (alpha 1, kappa 0), headings wrapped by f_odometry",
        """
def unsure_drive(x, P, u, C):
    m = np.concatenate([x, u])
    S = np.zeros((5, 5))
    S[:3, :3], S[3:, 3:] = P, C
    L = np.linalg.cholesky(5 * S)
    points = np.vstack([m + L.T, m - L.T])
    ends = np.array([f_odometry(q[:3], q[3:]) for q in points])
    mean = ends.mean(axis=0)
    return mean, (ends - mean).T @ (ends - mean) / 10
""",
    ),
    (
        "04-unsure-drive",
        "unscented, no wrapping, scaled by n = 5: far points",
        """
def unsure_drive(x, P, u, C):
    L = np.zeros((5, 5))
    L[:3, :3], L[3:, 3:] = np.linalg.cholesky(P), np.linalg.cholesky(C)
    m = np.concatenate([x, u])
    q = np.vstack([m + np.sqrt(5) * L.T, m - np.sqrt(5) * L.T])
    ends = np.c_[q[:, 0] + q[:, 3] * np.cos(q[:, 2]), q[:, 1] + q[:, 3] * np.sin(q[:, 2]),
                 q[:, 2] + q[:, 4]]
    mean = ends.mean(axis=0)
    return mean, np.cov(ends.T, bias=True)
""",
    ),
    (
        "04-unsure-drive",
        "mean from sampling, covariance still linearised",
        """
def unsure_drive(x, P, u, C):
    _, S = linearised(x, P, u, C)
    headings = np.random.default_rng(0).normal(x[2], np.sqrt(P[2, 2]), 50000)
    mean = np.array([
        x[0] + u[0] * np.cos(headings).mean(), x[1] + u[0] * np.sin(headings).mean(), x[2] + u[1]
    ])
    return mean, S
""",
    ),
    (
        "04-unsure-drive",
        "samples drawn without the correlations of P",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(0)
    n = 50000
    X = x + rng.normal(size=(n, 3)) * np.sqrt(np.diag(P))
    D = rng.multivariate_normal(u, C, n)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        "04-unsure-drive",
        "samples drawn without the correlation of C",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(0)
    n = 50000
    X = rng.multivariate_normal(x, P, n)
    d = rng.normal(u[0], np.sqrt(C[0, 0]), n)
    t = rng.normal(u[1], np.sqrt(C[1, 1]), n)
    E = np.c_[X[:, 0] + d * np.cos(X[:, 2]), X[:, 1] + d * np.sin(X[:, 2]), X[:, 2] + t]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        "04-unsure-drive",
        "the wheels' noise forgotten",
        """
def unsure_drive(x, P, u, C):
    X = np.random.default_rng(0).multivariate_normal(x, P, 50000)
    d, turn = u
    E = X + np.c_[d * np.cos(X[:, 2]), d * np.sin(X[:, 2]), np.full(len(X), turn)]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        "04-unsure-drive",
        "variances drawn as standard deviations",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(0)
    X = rng.normal(x, np.diag(P), (20000, 3))
    D = rng.normal(u, np.diag(C), (20000, 2))
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        "04-unsure-drive",
        "Cholesky factor transposed when sampling",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(0)
    X = x + rng.normal(size=(50000, 3)) @ np.linalg.cholesky(P)
    D = u + rng.normal(size=(50000, 2)) @ np.linalg.cholesky(C)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        "04-unsure-drive",
        "closed form with exp(-s2) for exp(-s2/2)",
        """
def unsure_drive(x, P, u, C):
    s2, d, th = P[2, 2], u[0], x[2]
    e, n = np.array([np.cos(th), np.sin(th)]), np.array([-np.sin(th), np.cos(th)])
    k = np.exp(-s2)
    EE = (np.eye(2) + np.exp(-2 * s2) * np.array(
        [[np.cos(2 * th), np.sin(2 * th)], [np.sin(2 * th), -np.cos(2 * th)]])) / 2
    cross = np.outer(P[:2, 2], d * k * n)
    S = np.zeros((3, 3))
    S[:2, :2] = P[:2, :2] + cross + cross.T + (d**2 + C[0, 0]) * EE - (d * k) ** 2 * np.outer(e, e)
    S[:2, 2] = S[2, :2] = P[:2, 2] + d * s2 * k * n + C[0, 1] * k * e
    S[2, 2] = s2 + C[1, 1]
    return np.array([x[0] + d * k * e[0], x[1] + d * k * e[1], th + u[1]]), S
""",
    ),
    (
        "04-unsure-drive",
        "closed form, but place and heading taken as independent",
        """
def unsure_drive(x, P, u, C):
    s2, d, th = P[2, 2], u[0], x[2]
    e, n = np.array([np.cos(th), np.sin(th)]), np.array([-np.sin(th), np.cos(th)])
    k = np.exp(-s2 / 2)
    EE = (np.eye(2) + np.exp(-2 * s2) * np.array(
        [[np.cos(2 * th), np.sin(2 * th)], [np.sin(2 * th), -np.cos(2 * th)]])) / 2
    S = np.zeros((3, 3))
    S[:2, :2] = P[:2, :2] + (d**2 + C[0, 0]) * EE - (d * k) ** 2 * np.outer(e, e)
    S[:2, 2] = S[2, :2] = P[:2, 2] + d * s2 * k * n + C[0, 1] * k * e
    S[2, 2] = s2 + C[1, 1]
    return np.array([x[0] + d * k * e[0], x[1] + d * k * e[1], th + u[1]]), S
""",
    ),
    (
        "04-unsure-drive",
        "closed form, wheels' distance noise only along the believed heading",
        """
def unsure_drive(x, P, u, C):
    s2, d, th = P[2, 2], u[0], x[2]
    e, n = np.array([np.cos(th), np.sin(th)]), np.array([-np.sin(th), np.cos(th)])
    k = np.exp(-s2 / 2)
    V = (1 - np.exp(-s2)) ** 2 / 2 * np.outer(e, e) + (1 - np.exp(-2 * s2)) / 2 * np.outer(n, n)
    cross = np.outer(P[:2, 2], d * k * n)
    S = np.zeros((3, 3))
    S[:2, :2] = P[:2, :2] + cross + cross.T + d**2 * V
    S[:2, 2] = S[2, :2] = P[:2, 2] + d * s2 * k * n
    S[2, 2] = s2
    W = np.array([[e[0], 0], [e[1], 0], [0, 1]])
    return np.array([x[0] + d * k * e[0], x[1] + d * k * e[1], th + u[1]]), S + W @ C @ W.T
""",
    ),
    (
        "04-unsure-drive",
        "second-order mean and covariance (Taylor)",
        """
def unsure_drive(x, P, u, C):
    mean, S = linearised(x, P, u, C)
    e = np.array([np.cos(x[2]), np.sin(x[2]), 0])
    mean = mean - u[0] * P[2, 2] / 2 * e
    return mean, S + (u[0] * P[2, 2]) ** 2 / 2 * np.outer(e, e)
""",
    ),
    (
        "04-unsure-drive",
        "three headings: -1, 0 and +1 sigma, equal weights",
        """
def unsure_drive(x, P, u, C):
    sigma = np.sqrt(P[2, 2])
    means, spreads = [], []
    for k in (-1, 0, 1):
        start = x + k * P[:, 2] / sigma
        rest = P - np.outer(P[:, 2], P[:, 2]) / P[2, 2]
        m, S = linearised(start, rest, u, C)
        means.append(m)
        spreads.append(S)
    mean = np.mean(means, axis=0)
    off = np.array(means) - mean
    return mean, np.mean(spreads, axis=0) + off.T @ off / 3
""",
    ),
    (
        "04-unsure-drive",
        "fan of headings, spread of the ends only: P's rest and C forgotten",
        """
def unsure_drive(x, P, u, C):
    t, w = np.polynomial.hermite_e.hermegauss(15)
    w = w / w.sum()
    heading = x[2] + np.sqrt(P[2, 2]) * t
    ends = np.c_[x[0] + u[0] * np.cos(heading), x[1] + u[0] * np.sin(heading), heading + u[1]]
    mean = w @ ends
    S = (ends - mean).T @ np.diag(w) @ (ends - mean)
    S[:2, :2] += P[:2, :2]
    S[2, 2] += C[1, 1]
    return mean, S
""",
    ),
    (
        "04-unsure-drive",
        "robot that does not drive is returned as it was (d <= 0)",
        """
def unsure_drive(x, P, u, C):
    if u[0] <= 0:
        return x.copy(), P.copy()
    rng = np.random.default_rng(3)
    X, D = rng.multivariate_normal(x, P, 50000), rng.multivariate_normal(u, C, 50000)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        "04-unsure-drive",
        "negative distances driven forwards (abs)",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(3)
    X, D = rng.multivariate_normal(x, P, 50000), rng.multivariate_normal(u, C, 50000)
    d = np.abs(D[:, 0])
    E = np.c_[X[:, 0] + d * np.cos(X[:, 2]), X[:, 1] + d * np.sin(X[:, 2]), X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        "04-unsure-drive",
        "turn first, then drive",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(3)
    X, D = rng.multivariate_normal(x, P, 50000), rng.multivariate_normal(u, C, 50000)
    E = X.copy()
    E[:, 2] += D[:, 1]
    E[:, 0] += D[:, 0] * np.cos(E[:, 2])
    E[:, 1] += D[:, 0] * np.sin(E[:, 2])
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        "04-unsure-drive",
        "adds a little to P in place so that it stays positive",
        """
def unsure_drive(x, P, u, C):
    P += 1e-9 * np.eye(3)
    rng = np.random.default_rng(3)
    X, D = rng.multivariate_normal(x, P, 50000), rng.multivariate_normal(u, C, 50000)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        "04-unsure-drive",
        "only the example: samples of START, BELIEVED, DRIVE, WHEELS",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(4)
    X = rng.multivariate_normal(START, BELIEVED, 20000)
    D = rng.multivariate_normal(DRIVE, WHEELS, 20000)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
""",
    ),
    (
        "04-unsure-drive",
        "drive cut into ten small linearised steps",
        """
def unsure_drive(x, P, u, C):
    mean, S = x, P
    for _ in range(10):
        mean, S = linearised(mean, S, np.array([u[0] / 10, 0]), C / 10)
    mean = mean + np.array([0, 0, u[1]])
    return mean, S
""",
    ),
    (
        "04-unsure-drive",
        "covariance about the linearised end instead of about the mean",
        """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(5)
    X, D = rng.multivariate_normal(x, P, 50000), rng.multivariate_normal(u, C, 50000)
    E = X.copy()
    E[:, :2] += D[:, :1] * np.c_[np.cos(X[:, 2]), np.sin(X[:, 2])]
    E[:, 2] += D[:, 1]
    off = E - linearised(x, P, u, C)[0]
    return E.mean(axis=0), off.T @ off / len(off)
""",
    ),
    (
        "04-unsure-drive",
        "grid of headings cut at 2 sigma",
        """
def unsure_drive(x, P, u, C):
    t = np.linspace(-2, 2, 41)
    w = np.exp(-(t**2) / 2)
    w /= w.sum()
    sigma = np.sqrt(P[2, 2])
    mean, second = np.zeros(3), np.zeros((3, 3))
    rest = P - np.outer(P[:, 2], P[:, 2]) / P[2, 2]
    for tk, wk in zip(t, w):
        m, S = linearised(x + tk * P[:, 2] / sigma, rest, u, C)
        mean = mean + wk * m
        second = second + wk * (S + np.outer(m, m))
    return mean, second - np.outer(mean, mean)
""",
    ),
]
