# %% way: in closed form, as lists
def moments(x, P, u, C):
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

# %% way: points of Gauss and Hermite in all directions
import itertools

def moments(x, P, u, C):
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

# %% pasted: the linearised step
moments = linearised

# %% pasted: the lesson's A P Aᵀ + Q
def moments(x, P, u, C):
    d, s, c = u[0], np.sin(x[2]), np.cos(x[2])
    A = np.array([[1, 0, -d * s], [0, 1, d * c], [0, 0, 1]])
    W = np.array([[c, 0], [s, 0], [0, 1]])
    return f_odometry(x, u), A @ P @ A.T + W @ C @ W.T

# %% pasted: slopes by differences
def moments(x, P, u, C):
    def slopes(f, v, step=1e-6):
        return np.column_stack([(f(v + e) - f(v - e)) / (2 * step) for e in step * np.eye(len(v))])
    A, W = slopes(lambda v: f_odometry(v, u), x), slopes(lambda v: f_odometry(x, v), u)
    return f_odometry(x, u), A @ P @ A.T + W @ C @ W.T

# %% pasted: new_landmark for the place
def moments(x, P, u, C):
    P_nn, P_rn = new_landmark(x, P, [u[0], 0], np.diag([C[0, 0], 0]))
    S = np.zeros((3, 3))
    S[:2, :2], S[:2, 2], S[2, :2], S[2, 2] = P_nn, P_rn[2], P_rn[2], P[2, 2] + C[1, 1]
    return np.array([*g(x, [u[0], 0]), x[2] + u[1]]), S

# %% pasted: the belief as it was
def moments(x, P, u, C):
    return f_odometry(x, u), P

# %% right: closed form (Gaussian moments of cos and sin)
def moments(x, P, u, C):
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

# %% right: Gauss-Hermite grid in five dimensions
def moments(x, P, u, C):
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

# %% wrong: ten thousand samples
def moments(x, P, u, C):
    rng = np.random.default_rng(4)
    starts = rng.multivariate_normal(x, P, 10000)
    d, turn = rng.multivariate_normal(u, C, 10000).T
    ends = np.column_stack([
        starts[:, 0] + d * np.cos(starts[:, 2]), starts[:, 1] + d * np.sin(starts[:, 2]),
        starts[:, 2] + turn,
    ])
    return ends.mean(axis=0), np.cov(ends.T)

# %% wrong: three thousand samples, each with its heading wrapped
def moments(x, P, u, C):
    rng = np.random.default_rng(0)
    a = rng.multivariate_normal(x, P, 3000)
    b = rng.multivariate_normal(u, C, 3000)
    ends = np.array([f_odometry(*pair) for pair in zip(a, b)])
    return ends.mean(axis=0), np.cov(ends.T)

# %% wrong: samples only the start, the wheels' noise C is left out
def moments(x, P, u, C):
    rng = np.random.default_rng(3)
    s = rng.multivariate_normal(x, P, 20000)
    ends = s + np.column_stack([u[0] * np.cos(s[:, 2]), u[0] * np.sin(s[:, 2]), np.full(20000, u[1])])
    return ends.mean(axis=0), np.cov(ends.T)

# %% wrong: linearised, made larger
def moments(x, P, u, C):
    m, S = linearised(x, P, u, C)
    s = P[2, 2]
    m[:2] = x[:2] + (m[:2] - x[:2]) * np.exp(-s / 2)
    S[:2, :2] += np.eye(2) * (u[0] * s / 2) ** 2
    return m, S

# %% wrong: few random samples
def moments(x, P, u, C):
    rng = np.random.default_rng(0)
    a = rng.multivariate_normal(x, P, 300)
    b = rng.multivariate_normal(u, C, 300)
    ends = np.column_stack([a[:, 0] + b[:, 0] * np.cos(a[:, 2]), a[:, 1] + b[:, 0] * np.sin(a[:, 2]), a[:, 2] + b[:, 1]])
    return ends.mean(axis=0), np.cov(ends.T)

# %% wrong: linearised, covariance doubled to be safe
def moments(x, P, u, C):
    mean, S = linearised(x, P, u, C)
    return mean, 2 * S

# %% wrong: cheat: a large constant disc
def moments(x, P, u, C):
    mean = f_odometry(x, u)
    return mean, np.diag([4.0, 4.0, 0.5])

# %% wrong: unscented (alpha 1, kappa 0), headings wrapped by f_odometry
def moments(x, P, u, C):
    m = np.concatenate([x, u])
    S = np.zeros((5, 5))
    S[:3, :3], S[3:, 3:] = P, C
    L = np.linalg.cholesky(5 * S)
    points = np.vstack([m + L.T, m - L.T])
    ends = np.array([f_odometry(q[:3], q[3:]) for q in points])
    mean = ends.mean(axis=0)
    return mean, (ends - mean).T @ (ends - mean) / 10

# %% wrong: mean from sampling, covariance still linearised
def moments(x, P, u, C):
    _, S = linearised(x, P, u, C)
    headings = np.random.default_rng(0).normal(x[2], np.sqrt(P[2, 2]), 50000)
    mean = np.array([
        x[0] + u[0] * np.cos(headings).mean(), x[1] + u[0] * np.sin(headings).mean(), x[2] + u[1]
    ])
    return mean, S

# %% wrong: variances drawn as standard deviations
def moments(x, P, u, C):
    rng = np.random.default_rng(0)
    X = rng.normal(x, np.diag(P), (20000, 3))
    D = rng.normal(u, np.diag(C), (20000, 2))
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)

# %% wrong: closed form, but place and heading taken as independent
def moments(x, P, u, C):
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

# %% wrong: closed form, wheels' distance noise only along the believed heading
def moments(x, P, u, C):
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

# %% wrong: second-order mean and covariance (Taylor)
def moments(x, P, u, C):
    mean, S = linearised(x, P, u, C)
    e = np.array([np.cos(x[2]), np.sin(x[2]), 0])
    mean = mean - u[0] * P[2, 2] / 2 * e
    return mean, S + (u[0] * P[2, 2]) ** 2 / 2 * np.outer(e, e)

# %% wrong: negative distances driven forwards (abs)
def moments(x, P, u, C):
    rng = np.random.default_rng(3)
    X, D = rng.multivariate_normal(x, P, 50000), rng.multivariate_normal(u, C, 50000)
    d = np.abs(D[:, 0])
    E = np.c_[X[:, 0] + d * np.cos(X[:, 2]), X[:, 1] + d * np.sin(X[:, 2]), X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)

# %% wrong: turn first, then drive
def moments(x, P, u, C):
    rng = np.random.default_rng(3)
    X, D = rng.multivariate_normal(x, P, 50000), rng.multivariate_normal(u, C, 50000)
    E = X.copy()
    E[:, 2] += D[:, 1]
    E[:, 0] += D[:, 0] * np.cos(E[:, 2])
    E[:, 1] += D[:, 0] * np.sin(E[:, 2])
    return E.mean(axis=0), np.cov(E.T)

# %% wrong: adds a little to P in place so that it stays positive
def moments(x, P, u, C):
    P += 1e-9 * np.eye(3)
    rng = np.random.default_rng(3)
    X, D = rng.multivariate_normal(x, P, 50000), rng.multivariate_normal(u, C, 50000)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)

# %% wrong: only the example: samples of START, BELIEVED, DRIVE, WHEELS
def moments(x, P, u, C):
    rng = np.random.default_rng(4)
    X = rng.multivariate_normal(START, BELIEVED, 20000)
    D = rng.multivariate_normal(DRIVE, WHEELS, 20000)
    E = np.c_[X[:, 0] + D[:, 0] * np.cos(X[:, 2]), X[:, 1] + D[:, 0] * np.sin(X[:, 2]),
              X[:, 2] + D[:, 1]]
    return E.mean(axis=0), np.cov(E.T)
