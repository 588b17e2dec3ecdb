"""Whole methods of 04-unsure-drive: the right ways, and two that fall short of the top."""

_SAMPLES = """
def unsure_drive(x, P, u, C):
    rng = np.random.default_rng(4)
    starts = rng.multivariate_normal(x, P, {count})
    d, turn = rng.multivariate_normal(u, C, {count}).T
    ends = np.column_stack([
        starts[:, 0] + d * np.cos(starts[:, 2]), starts[:, 1] + d * np.sin(starts[:, 2]),
        starts[:, 2] + turn,
    ])
    return ends.mean(axis=0), np.cov(ends.T)
"""

WAYS = {
    "in closed form, as lists": """
def unsure_drive(x, P, u, C):
    d, v, e = u[0], P[2, 2], np.array([np.cos(x[2]), np.sin(x[2])])
    along = np.exp(-v / 2) * e
    across = np.array([-along[1], along[0]])
    mean = np.array([*(x[:2] + d * along), x[2] + u[1]])
    c, s = np.exp(-2 * v) * np.array([np.cos(2 * x[2]), np.sin(2 * x[2])])
    lean = np.outer(P[:2, 2], d * across)
    S = P.copy()
    S[:2, :2] += lean + lean.T - d**2 * np.outer(along, along)
    S[:2, :2] += (d**2 + C[0, 0]) / 2 * np.array([[1 + c, s], [s, 1 - c]])
    S[:2, 2] += d * v * across + C[0, 1] * along
    S[2, :2] = S[:2, 2]
    S[2, 2] += C[1, 1]
    return mean.tolist(), S.tolist()
""",
    "ten thousand samples": _SAMPLES.format(count=10000),
    "points of Gauss and Hermite in all directions": """
import itertools

def unsure_drive(x, P, u, C):
    t, w = np.polynomial.hermite_e.hermegauss(10)
    w = w / w.sum()
    order = [2, 0, 1, 3, 4]  # the heading first: it alone needs many points
    joint = np.zeros((5, 5))
    joint[:3, :3], joint[3:, 3:] = P, C
    root = np.linalg.cholesky(joint[np.ix_(order, order)])
    signs = np.array(list(itertools.product([-1, 1], repeat=4)))
    points = np.column_stack([np.repeat(t, len(signs)), np.tile(signs, (len(t), 1))])
    weights = np.repeat(w / len(signs), len(signs))
    theta, a, b, d, turn = (np.concatenate([x, u])[order] + points @ root.T).T
    ends = np.array([a + d * np.cos(theta), b + d * np.sin(theta), theta + turn])
    mean = ends @ weights
    return mean, np.cov(ends, aweights=weights, bias=True)
""",
}

SECOND_ORDER = """
def unsure_drive(x, P, u, C):
    c, s, d = np.cos(x[2]), np.sin(x[2]), u[0]
    joint = np.zeros((5, 5))
    joint[:3, :3], joint[3:, 3:] = P, C
    G = np.array([[1, 0, -d * s, c, 0], [0, 1, d * c, s, 0], [0, 0, 1, 0, 1]])
    bends = np.zeros((3, 5, 5))
    bends[0, 2, 2], bends[1, 2, 2] = -d * c, -d * s
    bends[0, 2, 3] = bends[0, 3, 2] = -s
    bends[1, 2, 3] = bends[1, 3, 2] = c
    mean = np.array([x[0] + d * c, x[1] + d * s, x[2] + u[1]])
    mean = mean + np.array([np.trace(B @ joint) for B in bends]) / 2
    more = [[np.trace(A @ joint @ B @ joint) for A in bends] for B in bends]
    return mean, G @ joint @ G.T + np.array(more) / 2
"""

SIGMA_POINTS = """
def unsure_drive(x, P, u, C):
    n, k = 5, KAPPA
    joint = np.zeros((n, n))
    joint[:3, :3], joint[3:, 3:] = P, C
    mu, root = np.concatenate([x, u]), np.linalg.cholesky((n + k) * joint).T
    points = np.vstack([mu, mu + root, mu - root])
    w = np.full(2 * n + 1, 0.5 / (n + k))
    w[0] = k / (n + k)
    a, b, theta, d, turn = points.T
    ends = np.array([a + d * np.cos(theta), b + d * np.sin(theta), theta + turn])
    mean = ends @ w
    off = ends.T - mean
    return mean, off.T @ (w[:, None] * off)
"""
