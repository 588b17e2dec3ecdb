"""Independent answers to 11-proposal: right ones, and students' mistakes."""

RIGHT = [
    (
        "11-proposal",
        "vectorised, slogdet",
        """
def reweigh(before, after, weights, u, C, m, D):
    dx, dy = (after[:, :2] - before[:, :2]).T
    th = before[:, 2]
    e = np.stack([np.cos(th) * dx + np.sin(th) * dy, wrap(after[:, 2] - th)], axis=1)
    v, w = e - u, e - m
    target = -0.5 * np.einsum("ni,ij,nj->n", v, np.linalg.inv(C), v)
    drawn = -0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w)
    drawn = drawn - 0.5 * np.linalg.slogdet(D)[1]
    return normalise(np.log(weights) + target - drawn)
""",
    ),
    (
        "11-proposal",
        "helper for the log density, with all constants",
        """
def reweigh(before, after, weights, u, C, m, D):
    def log_gauss(e, mean, cov):
        v = e - mean
        return -0.5 * v @ np.linalg.solve(cov, v) - 0.5 * np.linalg.slogdet(2 * np.pi * cov)[1]

    logs = []
    for a, b, w, mi, Di in zip(before, after, weights, m, D):
        way = b[:2] - a[:2]
        ahead = np.array([np.cos(a[2]), np.sin(a[2])])
        e = np.array([way @ ahead, wrap(float(b[2] - a[2]))])
        logs.append(np.log(w) + log_gauss(e, u, C) - log_gauss(e, mi, Di))
    return normalise(np.array(logs))
""",
    ),
]

WRONG = [
    (
        "11-proposal",
        "the width of the hill (det D) is forgotten",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    e = np.column_stack([d, wrap(step[:, 2])])
    v, w = e - u, e - m
    logs = np.log(weights) - 0.5 * np.sum(v @ np.linalg.inv(C) * v, axis=1)
    logs = logs + 0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w)
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "ratio upside down",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    e = np.column_stack([d, wrap(step[:, 2])])
    v, w = e - u, e - m
    wheels = -0.5 * np.einsum("ni,ij,nj->n", v, np.linalg.inv(C), v)
    drawn = -0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w) - 0.5 * np.log(np.linalg.det(D))
    return normalise(np.log(weights) + drawn - wheels)
""",
    ),
    (
        "11-proposal",
        "weighs by the wheels' density only",
        """
def reweigh(before, after, weights, u, C, m, D):
    logs = np.log(weights)
    for k in range(len(before)):
        dx, dy, turn = after[k] - before[k]
        d = dx * np.cos(before[k, 2]) + dy * np.sin(before[k, 2])
        v = np.array([d - u[0], wrap(turn) - u[1]])
        logs[k] -= 0.5 * v @ np.linalg.inv(C) @ v
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "turn not wrapped",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    e = np.column_stack([d, step[:, 2]])
    logs = np.log(weights) + 0.5 * np.linalg.slogdet(D)[1]
    for k in range(len(e)):
        v, w = e[k] - u, e[k] - m[k]
        logs[k] += 0.5 * (w @ np.linalg.solve(D[k], w) - v @ np.linalg.solve(C, v))
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "distance by hypot: driving backwards becomes forwards",
        """
def reweigh(before, after, weights, u, C, m, D):
    d = np.hypot(*(after - before)[:, :2].T)
    e = np.column_stack([d, wrap(after[:, 2] - before[:, 2])])
    v, w = e - u, e - m
    logs = np.log(weights) - 0.5 * np.einsum("ni,ij,nj->n", v, np.linalg.inv(C), v)
    logs += 0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w) + 0.5 * np.linalg.slogdet(D)[1]
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "heading after the turn taken for the drive",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, after[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    e = np.column_stack([d, wrap(step[:, 2])])
    v, w = e - u, e - m
    logs = np.log(weights) - 0.5 * np.einsum("ni,ij,nj->n", v, np.linalg.inv(C), v)
    logs += 0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w) + 0.5 * np.linalg.slogdet(D)[1]
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "given weights are ignored",
        """
def reweigh(before, after, weights, u, C, m, D):
    logs = np.zeros(len(before))
    Ci = np.linalg.inv(C)
    for k in range(len(before)):
        dx, dy = after[k, :2] - before[k, :2]
        c, s = np.cos(before[k, 2]), np.sin(before[k, 2])
        e = np.array([c * dx + s * dy, wrap(after[k, 2] - before[k, 2])])
        v, w = e - u, e - m[k]
        logs[k] = 0.5 * (w @ np.linalg.inv(D[k]) @ w - v @ Ci @ v + np.log(np.linalg.det(D[k])))
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "densities, not their logarithms: 0/0 far off",
        """
def reweigh(before, after, weights, u, C, m, D):
    def density(e, mean, cov):
        v = e - mean
        return np.exp(-0.5 * v @ np.linalg.inv(cov) @ v) / np.sqrt(np.linalg.det(cov))

    out = np.zeros(len(before))
    for k in range(len(before)):
        dx, dy, turn = after[k] - before[k]
        d = dx * np.cos(before[k, 2]) + dy * np.sin(before[k, 2])
        e = np.array([d, wrap(turn)])
        out[k] = weights[k] * density(e, u, C) / density(e, m[k], D[k])
    return out / out.sum()
""",
    ),
    (
        "11-proposal",
        "det without the square root",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    e = np.column_stack([d, wrap(step[:, 2])])
    logs = np.log(weights)
    for k in range(len(e)):
        v, w = e[k] - u, e[k] - m[k]
        logs[k] += 0.5 * (w @ np.linalg.inv(D[k]) @ w - v @ np.linalg.inv(C) @ v)
        logs[k] += np.log(np.linalg.det(D[k]))
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "D of the first sample for all",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    e = np.column_stack([
        step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta), wrap(step[:, 2])])
    v, w = e - u, e - m
    logs = np.log(weights) - 0.5 * np.sum(v @ np.linalg.inv(C) * v, axis=1)
    logs += 0.5 * np.sum(w @ np.linalg.inv(D[0]) * w, axis=1)
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "drive from dx / cos: breaks when it heads along y",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    e = np.column_stack([step[:, 0] / np.cos(theta), wrap(step[:, 2])])
    v, w = e - u, e - m
    logs = np.log(weights) - 0.5 * np.sum(v @ np.linalg.inv(C) * v, axis=1)
    logs += 0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w)
    logs += 0.5 * np.log(np.linalg.det(D))
    return normalise(logs)
""",
    ),
    (
        "11-proposal",
        "given weights multiplied in place",
        """
def reweigh(before, after, weights, u, C, m, D):
    step, theta = after - before, before[:, 2]
    d = step[:, 0] * np.cos(theta) + step[:, 1] * np.sin(theta)
    e = np.column_stack([d, wrap(step[:, 2])])
    v, w = e - u, e - m
    logs = 0.5 * np.linalg.slogdet(D)[1] - 0.5 * np.sum(v @ np.linalg.inv(C) * v, axis=1)
    logs += 0.5 * np.einsum("ni,nij,nj->n", w, np.linalg.inv(D), w)
    weights *= np.exp(logs - logs.max())
    return weights / weights.sum()
""",
    ),
]
