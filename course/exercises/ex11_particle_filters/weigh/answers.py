# %% way: sample by sample
def log_likelihoods(rows, p, z, R):
    logs = []
    for x in rows:
        v = z - h(x, p)
        v[:, 1] = wrap(v[:, 1])
        logs.append(sum(-0.5 * e @ np.linalg.solve(R, e) for e in v))
    return logs

# %% way: all at once, with the constant
def log_likelihoods(rows, p, z, R):
    v = z - h(rows[:, None], p)
    v[..., 1] = np.arctan2(np.sin(v[..., 1]), np.cos(v[..., 1]))
    logs = -0.5 * np.einsum("nma,ab,nmb->n", v, np.linalg.inv(R), v)
    return logs - len(p) * np.log(2 * np.pi * np.sqrt(np.linalg.det(R)))

# %% way: h − z, the largest taken off
def log_likelihoods(rows, p, z, R):
    logs = 0
    for j in range(len(p)):
        v = h(rows, p[j]) - z[j]
        v[:, 1] = (v[:, 1] + np.pi) % (2 * np.pi) - np.pi
        logs = logs - (v.T * np.linalg.solve(R, v.T)).sum(axis=0) / 2
    return logs - logs.max()

# %% way: whitened by a root of R
def log_likelihoods(rows, p, z, R):
    L = np.linalg.inv(np.linalg.cholesky(R))
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z):
        v = seen - h(rows, place)
        v[:, 1] = np.remainder(v[:, 1] + np.pi, 2 * np.pi) - np.pi
        logs -= np.linalg.norm(v @ L.T, axis=1) ** 2 / 2
    return logs

# %% way: h written out, R⁻¹ by hand
def log_likelihoods(rows, p, z, R):
    (a, b), (_, c) = R
    det = a * c - b * b
    d = p[:, None] - rows[:, :2]
    r = z[:, :1] - np.hypot(d[..., 0], d[..., 1])
    beta = wrap(z[:, 1:] - np.arctan2(d[..., 1], d[..., 0]) + rows[:, 2])
    return -np.sum(c * r**2 - 2 * b * r * beta + a * beta**2, axis=0) / det / 2

# %% right: whitened by Cholesky, one landmark at a time
def log_likelihoods(rows, p, z, R):
    L = np.linalg.cholesky(R)
    total = np.zeros(len(rows))
    for mark, sight in zip(p, z):
        v = np.array([sight - h(np.asarray(x, float), mark) for x in rows])
        v[:, 1] = wrap(v[:, 1])
        total -= 0.5 * (np.linalg.solve(L, v.T) ** 2).sum(axis=0)
    return total

# %% right: whitened by Cholesky, one landmark at a time
def log_likelihoods(rows, p, z, R):
    L = np.linalg.cholesky(np.asarray(R, dtype=float))
    total = np.zeros(len(rows))
    for landmark, seen in zip(np.asarray(p, dtype=float), np.asarray(z, dtype=float)):
        v = seen - h(np.asarray(rows, dtype=float), landmark)
        v[:, 1] = (v[:, 1] + np.pi) % (2 * np.pi) - np.pi
        w = np.linalg.solve(L, v.T)
        total -= (w**2).sum(axis=0) / 2
    return total

# %% right: one big broadcast, einsum
def log_likelihoods(rows, p, z, R):
    v = np.asarray(z, float)[None, :, :] - h(rows[:, None, :], np.asarray(p)[None, :, :])
    v[..., 1] = wrap(v[..., 1])
    return -0.5 * np.einsum("nmi,ij,nmj->n", v, np.linalg.inv(R), v)

# %% right: loop over samples, solve
def log_likelihoods(rows, p, z, R):
    out = []
    for x in rows:
        expected = h(x, p)
        dr = z[:, 0] - expected[:, 0]
        db = wrap(z[:, 1] - expected[:, 1])
        v = np.vstack([dr, db])
        out.append(-0.5 * np.sum(v * np.linalg.solve(np.asarray(R, dtype=float), v)))
    return np.array(out)

# %% wrong: the difference of bearings is not wrapped
def log_likelihoods(rows, p, z, R):
    inverse = np.linalg.inv(R)
    out = np.zeros(len(rows))
    for i, x in enumerate(rows):
        for zj, pj in zip(z, p):
            d = pj - x[:2]
            v = zj - np.array([np.hypot(d[0], d[1]), np.arctan2(d[1], d[0]) - x[2]])
            out[i] += -0.5 * v @ inverse @ v
    return out

# %% wrong: array of the rows' type: breaks (truncates) with whole numbers
def log_likelihoods(rows, p, z, R):
    logs = np.zeros_like(rows[:, 0])
    Ri = np.linalg.inv(R)
    for i, x in enumerate(rows):
        v = z - h(x, p)
        v[:, 1] = wrap(v[:, 1])
        logs[i] = -0.5 * np.sum((v @ Ri) * v)
    return logs

# %% wrong: h with all samples and all landmarks at once: pairs row i with landmark i
def log_likelihoods(rows, p, z, R):
    v = z - h(rows, p)
    v[:, 1] = wrap(v[:, 1])
    return -0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)

# %% wrong: Cholesky factor transposed
def log_likelihoods(rows, p, z, R):
    L = np.linalg.cholesky(R)
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z):
        v = seen - h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        white = np.linalg.solve(L.T, v.T)
        logs -= 0.5 * np.sum(white**2, axis=0)
    return logs

# %% wrong: returns the likelihood, not its logarithm
def log_likelihoods(rows, p, z, R):
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z):
        v = seen - h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        logs -= 0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)
    return np.exp(logs - logs.max())
