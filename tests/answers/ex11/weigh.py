"""Independent answers to 11-weigh: right ones, and students' mistakes."""

RIGHT = [
    (
        "11-weigh",
        "one big broadcast, einsum",
        """
def log_likelihoods(rows, p, z, R):
    v = np.asarray(z, float)[None, :, :] - h(rows[:, None, :], np.asarray(p)[None, :, :])
    v[..., 1] = wrap(v[..., 1])
    return -0.5 * np.einsum("nmi,ij,nmj->n", v, np.linalg.inv(R), v)
""",
    ),
    (
        "11-weigh",
        "loop over samples, solve",
        """
def log_likelihoods(rows, p, z, R):
    out = []
    for x in rows:
        expected = h(x, p)
        dr = z[:, 0] - expected[:, 0]
        db = wrap(z[:, 1] - expected[:, 1])
        v = np.vstack([dr, db])
        out.append(-0.5 * np.sum(v * np.linalg.solve(np.asarray(R, dtype=float), v)))
    return np.array(out)
""",
    ),
    (
        "11-weigh",
        "whitened by Cholesky, arctan2 for wrapping",
        """
def log_likelihoods(rows, p, z, R):
    L = np.linalg.cholesky(R)
    total = np.zeros(rows.shape[0])
    for j in range(len(p)):
        e = h(rows, p[j])
        diff = z[j, 1] - e[:, 1]
        v = np.array([z[j, 0] - e[:, 0], np.arctan2(np.sin(diff), np.cos(diff))])
        white = np.linalg.solve(L, v)
        total = total - (white**2).sum(axis=0) / 2
    return total
""",
    ),
]

WRONG = [
    (
        "11-weigh",
        "bearing difference not wrapped",
        """
def log_likelihoods(rows, p, z, R):
    Ri = np.linalg.inv(R)
    logs = np.zeros(len(rows))
    for j in range(len(p)):
        v = z[j] - h(rows, p[j])
        logs += -0.5 * np.einsum("ni,ij,nj->n", v, Ri, v)
    return logs
""",
    ),
    (
        "11-weigh",
        "the half is forgotten",
        """
def log_likelihoods(rows, p, z, R):
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z):
        v = seen - h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        logs -= np.sum(v @ np.linalg.inv(R) * v, axis=1)
    return logs
""",
    ),
    (
        "11-weigh",
        "R itself instead of its inverse",
        """
def log_likelihoods(rows, p, z, R):
    v = z[None] - h(rows[:, None], p[None])
    v[..., 1] = wrap(v[..., 1])
    return -0.5 * np.einsum("nmi,ij,nmj->n", v, R, v)
""",
    ),
    (
        "11-weigh",
        "only the diagonal of R: range and bearing taken as independent",
        """
def log_likelihoods(rows, p, z, R):
    total = np.zeros(len(rows))
    for j, landmark in enumerate(p):
        expected = h(rows, landmark)
        dr = z[j, 0] - expected[:, 0]
        db = wrap(z[j, 1] - expected[:, 1])
        total += -0.5 * (dr**2 / R[0, 0] + db**2 / R[1, 1])
    return total
""",
    ),
    (
        "11-weigh",
        "log of the product of likelihoods: zero far off, -inf",
        """
def log_likelihoods(rows, p, z, R):
    like = np.ones(len(rows))
    for place, seen in zip(p, z):
        v = seen - h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        like *= np.exp(-0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1))
    return np.log(like)
""",
    ),
    (
        "11-weigh",
        "only the last landmark counts: = instead of +=",
        """
def log_likelihoods(rows, p, z, R):
    Rinv = np.linalg.inv(R)
    for j in range(len(p)):
        v = z[j] - h(rows, p[j])
        v[:, 1] = wrap(v[:, 1])
        logs = -0.5 * np.array([vi @ Rinv @ vi for vi in v])
    return logs
""",
    ),
    (
        "11-weigh",
        "wraps the range as well",
        """
def log_likelihoods(rows, p, z, R):
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z):
        v = wrap(seen - h(rows, place))
        logs -= 0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)
    return logs
""",
    ),
    (
        "11-weigh",
        "mean over the landmarks",
        """
def log_likelihoods(rows, p, z, R):
    v = z - h(rows[:, None, :], p)
    v[:, :, 1] = wrap(v[:, :, 1])
    squares = np.einsum("nmi,ij,nmj->nm", v, np.linalg.inv(R), v)
    return -0.5 * squares.mean(axis=1)
""",
    ),
    (
        "11-weigh",
        "array of the rows' type: breaks (truncates) with whole numbers",
        """
def log_likelihoods(rows, p, z, R):
    logs = np.zeros_like(rows[:, 0])
    Ri = np.linalg.inv(R)
    for i, x in enumerate(rows):
        v = z - h(x, p)
        v[:, 1] = wrap(v[:, 1])
        logs[i] = -0.5 * np.sum((v @ Ri) * v)
    return logs
""",
    ),
    (
        "11-weigh",
        "h with all samples and all landmarks at once: pairs row i with landmark i",
        """
def log_likelihoods(rows, p, z, R):
    v = z - h(rows, p)
    v[:, 1] = wrap(v[:, 1])
    return -0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)
""",
    ),
    (
        "11-weigh",
        "Cholesky factor transposed",
        """
def log_likelihoods(rows, p, z, R):
    L = np.linalg.cholesky(R)
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z):
        v = seen - h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        white = np.linalg.solve(L.T, v.T)
        logs -= 0.5 * np.sum(white**2, axis=0)
    return logs
""",
    ),
    (
        "11-weigh",
        "returns the likelihood, not its logarithm",
        """
def log_likelihoods(rows, p, z, R):
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z):
        v = seen - h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        logs -= 0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)
    return np.exp(logs - logs.max())
""",
    ),
    (
        "11-weigh",
        "logs clipped so that exp does not become zero",
        """
def log_likelihoods(rows, p, z, R):
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z):
        v = seen - h(rows, place)
        v[:, 1] = wrap(v[:, 1])
        logs -= 0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)
    return np.maximum(logs, -700)
""",
    ),
    (
        "11-weigh",
        "bearing wrapped into [0, 2 pi)",
        """
def log_likelihoods(rows, p, z, R):
    S = np.linalg.inv(R)
    logs = np.zeros(len(rows))
    for j in range(len(z)):
        v = z[j] - h(rows, p[j])
        v[:, 1] = v[:, 1] % (2 * np.pi)
        logs -= 0.5 * (v * (v @ S)).sum(axis=1)
    return logs
""",
    ),
]
