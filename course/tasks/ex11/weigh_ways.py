"""Right ways of 11-weigh."""

WAYS = {
    "sample by sample": """
def log_likelihoods(rows, p, z, R):
    logs = []
    for x in rows:
        v = z - h(x, p)
        v[:, 1] = wrap(v[:, 1])
        logs.append(sum(-0.5 * e @ np.linalg.solve(R, e) for e in v))
    return logs
""",
    "all at once, with the constant": """
def log_likelihoods(rows, p, z, R):
    v = z - h(rows[:, None], p)
    v[..., 1] = np.arctan2(np.sin(v[..., 1]), np.cos(v[..., 1]))
    logs = -0.5 * np.einsum("nma,ab,nmb->n", v, np.linalg.inv(R), v)
    return logs - len(p) * np.log(2 * np.pi * np.sqrt(np.linalg.det(R)))
""",
    "h − z, the largest taken off": """
def log_likelihoods(rows, p, z, R):
    logs = 0
    for j in range(len(p)):
        v = h(rows, p[j]) - z[j]
        v[:, 1] = (v[:, 1] + np.pi) % (2 * np.pi) - np.pi
        logs = logs - (v.T * np.linalg.solve(R, v.T)).sum(axis=0) / 2
    return logs - logs.max()
""",
    "whitened by a root of R": """
def log_likelihoods(rows, p, z, R):
    L = np.linalg.inv(np.linalg.cholesky(R))
    logs = np.zeros(len(rows))
    for place, seen in zip(p, z):
        v = seen - h(rows, place)
        v[:, 1] = np.remainder(v[:, 1] + np.pi, 2 * np.pi) - np.pi
        logs -= np.linalg.norm(v @ L.T, axis=1) ** 2 / 2
    return logs
""",
    "h written out, R⁻¹ by hand": """
def log_likelihoods(rows, p, z, R):
    (a, b), (_, c) = R
    det = a * c - b * b
    d = p[:, None] - rows[:, :2]
    r = z[:, :1] - np.hypot(d[..., 0], d[..., 1])
    beta = wrap(z[:, 1:] - np.arctan2(d[..., 1], d[..., 0]) + rows[:, 2])
    return -np.sum(c * r**2 - 2 * b * r * beta + a * beta**2, axis=0) / det / 2
""",
}
