# %% way: all at once
def reweigh(before, after, weights, u, C, m, D):
    step = after - before
    heading = np.stack([np.cos(before[:, 2]), np.sin(before[:, 2])], axis=1)
    e = np.stack([np.sum(step[:, :2] * heading, axis=1), wrap(step[:, 2])], axis=1)
    p = -0.5 * np.einsum("na,ab,nb->n", e - u, np.linalg.inv(C), e - u)
    q = -0.5 * np.einsum("na,nab,nb->n", e - m, np.linalg.inv(D), e - m)
    logs = p - q + np.linalg.slogdet(D)[1] / 2 + np.log(weights)
    w = np.exp(logs - logs.max())
    return w / w.sum()

# %% way: two densities written out
def reweigh(before, after, weights, u, C, m, D):
    def log_density(e, mean, P):
        v = e - mean
        v[1] = wrap(v[1])
        return -v @ np.linalg.solve(P, v) / 2 - np.log(2 * np.pi * np.sqrt(np.linalg.det(P)))

    logs = []
    for a, b, w, mean, P in zip(before, after, weights, m, D):
        c, s = np.cos(a[2]), np.sin(a[2])
        x, y = np.array([[c, s], [-s, c]]) @ (b - a)[:2]
        e = np.array([x, wrap(b[2] - a[2])])
        logs.append(np.log(w) + log_density(e, u, C) - log_density(e, mean, P))
    return list(normalise(np.array(logs)))

# %% way: whitened by roots
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    length = np.hypot(step[:, 0], step[:, 1])
    d = length * np.cos(np.arctan2(step[:, 1], step[:, 0]) - theta)
    e = np.column_stack([d, (step[:, 2] + np.pi) % (2 * np.pi) - np.pi])
    L, K = np.linalg.cholesky(C), np.linalg.cholesky(D)
    p = np.linalg.solve(L, (e - u).T)
    q = np.linalg.solve(K, (e - m)[:, :, None])[:, :, 0]
    logs = (q**2).sum(axis=1) / 2 - (p**2).sum(axis=0) / 2
    logs += np.log(weights * K[:, 0, 0] * K[:, 1, 1])
    return np.exp(logs - np.logaddexp.reduce(logs))

# %% way: by the odometry's inverse, sample by sample
def reweigh(before, after, weights, u, C, m, D):
    n = len(weights)
    logs = np.zeros(n)
    for k in range(n):
        (x0, y0, t0), (x1, y1, t1) = before[k], after[k]
        turn = np.arctan2(np.sin(t1 - t0), np.cos(t1 - t0))
        e = np.array([(x1 - x0) * np.cos(t0) + (y1 - y0) * np.sin(t0), turn])
        for sign, mean, P in ((1, u, C), (-1, m[k], D[k])):
            (a, b), (_, c) = P
            det = a * c - b * b
            v, w = e - mean
            logs[k] -= sign * ((c * v * v - 2 * b * v * w + a * w * w) / det + np.log(det)) / 2
    shifted = logs - np.max(logs)
    return weights * np.exp(shifted) / np.dot(weights, np.exp(shifted))

# %% pasted: task 1 with drives for sightings
def reweigh(before, after, weights, u, C, m, D):

    step, theta = after - before, before[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    v = np.column_stack([d, wrap(step[:, 2])]) - u
    return normalise(np.log(weights) - 0.5 * np.sum(v @ np.linalg.inv(C) * v, axis=1))

# %% pasted: the lesson's normalise
def reweigh(before, after, weights, u, C, m, D):
    return normalise(np.log(weights))

# %% pasted: the thesis' weight
def reweigh(before, after, weights, u, C, m, D):

    off = after - np.array([f_odometry(x, u) for x in before])
    off[:, 2] = wrap(off[:, 2])
    logs = np.log(weights) - 0.5 * np.sum(off[:, [0, 2]] @ np.linalg.inv(C) * off[:, [0, 2]], axis=1)
    return normalise(logs)

# %% right: vectorised with slogdet and solve, complete logarithms of both densities
def reweigh(before, after, weights, u, C, m, D):
    c, s = np.cos(before[:, 2]), np.sin(before[:, 2])
    dx, dy = after[:, 0] - before[:, 0], after[:, 1] - before[:, 1]
    turn = after[:, 2] - before[:, 2]
    e = np.stack([c * dx + s * dy, np.arctan2(np.sin(turn), np.cos(turn))], axis=1)

    def log_density(v, S):
        q = np.einsum("ni,ni->n", v, np.linalg.solve(S, v[:, :, None])[:, :, 0])
        return -0.5 * (q + np.linalg.slogdet(S)[1])

    Cs = np.broadcast_to(C, D.shape)
    logs = np.log(weights) + log_density(e - u, Cs) - log_density(e - m, D)
    return normalise(logs)

# %% right: scipy's log densities in a loop
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

# %% wrong: drive from dx / cos: breaks when it heads along y
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    e = np.column_stack([step[:, 0] / np.cos(theta), wrap(step[:, 2])])
    v, w = e - u, e - m
    logs = np.log(weights) - 0.5 * np.sum(v @ np.linalg.inv(C) * v, axis=1)
    logs += 0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w)
    logs += 0.5 * np.log(np.linalg.det(D))
    return normalise(logs)

# %% wrong: given weights multiplied in place
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    e = np.column_stack([d, wrap(step[:, 2])])
    v, w = e - u, e - m
    logs = 0.5 * np.linalg.slogdet(D)[1] - 0.5 * np.sum(v @ np.linalg.inv(C) * v, axis=1)
    logs += 0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w)
    weights *= np.exp(logs - logs.max())
    return weights / weights.sum()
