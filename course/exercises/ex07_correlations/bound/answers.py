# %% way: augmented without noise
def lower_bound(x, P, p, sigma, share):
    blocks = []
    for landmark in p:
        dx, dy = landmark - x[:2]
        blocks.append(np.array([[1, 0, -dy], [0, 1, dx]]))
    L = np.block([[A @ P @ B.T for B in blocks] for A in blocks])
    n = []
    for i, s in enumerate(sigma):
        least = L[2 * i, 2 * i] + L[2 * i + 1, 2 * i + 1]
        n.append(max(1, int(np.ceil((s**2 + s**2) / least / share))))
    return L, n

# %% way: by the root of P
def lower_bound(x, P, p, sigma, share):
    root = np.linalg.cholesky(P)
    off = p - x[:2]
    across = np.stack([-off[:, 1], off[:, 0]], axis=1)
    moved = root[:2] + across[:, :, None] * root[2]
    L = np.einsum("iak,jbk->iajb", moved, moved).reshape(2 * len(p), 2 * len(p))
    n = np.ceil(2 * sigma**2 / (moved**2).sum(axis=(1, 2)) / share)
    return L, n

# %% right: the number found by trying
def lower_bound(x, P, p, sigma, share):
    m = len(p)
    J = np.tile(np.eye(2, 3), (m, 1))
    for i in range(m):
        J[2 * i : 2 * i + 2, 2] = [x[1] - p[i, 1], p[i, 0] - x[0]]
    L = J @ P @ J.T
    counts = np.zeros(m)
    for i in range(m):
        least, n = np.trace(L[2 * i : 2 * i + 2, 2 * i : 2 * i + 2]), 1
        high = 1
        while least + 2 * sigma[i] ** 2 / high > (1 + share) * least:
            high *= 2
        low = high // 2
        while high - low > 1:
            n = (low + high) // 2
            if least + 2 * sigma[i] ** 2 / n > (1 + share) * least:
                low = n
            else:
                high = n
        counts[i] = high
    return L, counts

# %% right: the map as an information matrix of the start, polar vectors
def lower_bound(x, P, p, sigma, share):
    r = np.hypot(p[:, 0] - x[0], p[:, 1] - x[1])
    a = np.arctan2(p[:, 1] - x[1], p[:, 0] - x[0])
    J = np.zeros((len(p), 2, 3))
    J[:, :, :2] = np.eye(2)
    J[:, 0, 2], J[:, 1, 2] = -r * np.sin(a), r * np.cos(a)
    own = np.trace(J @ P @ J.transpose(0, 2, 1), axis1=1, axis2=2)
    J = J.reshape(-1, 3)
    return J @ np.linalg.solve(np.linalg.inv(P), J.T), np.ceil(2 * sigma**2 / own / share)

# %% pasted: the start's position for each landmark, as with a compass
def lower_bound(x, P, p, sigma, share):
    L = np.tile(P[:2, :2], (len(p), len(p)))
    return L, np.ceil(2 * sigma**2 / (share * np.trace(P[:2, :2])))

# %% wrong: sampled starts, turned by compose
def lower_bound(x, P, p, sigma, share):
    rng = np.random.default_rng(0)
    starts = rng.multivariate_normal(np.zeros(3), P, 20000)
    errors = []
    for landmark in p:
        dx, dy = landmark - x[:2]
        errors.append(compose(starts, np.array([dx, dy, 0]))[:, :2] - [dx, dy])
    L = np.cov(np.hstack(errors).T)
    trace = np.diag(L).reshape(-1, 2).sum(axis=1)
    return L, np.maximum(1, np.ceil(2 * sigma**2 / (share * trace)))

# %% wrong: J by differences
def lower_bound(x, P, p, sigma, share):
    def mapped(start):
        c, s = np.cos(start[2] - x[2]), np.sin(start[2] - x[2])
        return (start[:2] + (p - x[:2]) @ np.array([[c, s], [-s, c]])).ravel()
    J = np.array([(mapped(x + e) - mapped(x - e)) / 2e-4 for e in 1e-4 * np.eye(3)]).T
    L = J @ P @ J.T
    trace = np.diag(L).reshape(-1, 2).sum(axis=1)
    return L, np.ceil(2 * sigma**2 / (share * trace))

# %% wrong: the trace of a measurement is sigma squared, and the heading turns the vectors
def lower_bound(x, P, p, sigma, share):
    c, s = np.cos(x[2]), np.sin(x[2])
    local = (p - x[:2]) @ np.array([[c, -s], [s, c]])
    J = np.zeros((len(p), 2, 3))
    J[:, :, :2] = np.eye(2)
    J[:, 0, 2], J[:, 1, 2] = -local[:, 1], local[:, 0]
    own = np.trace(J @ P @ J.transpose(0, 2, 1), axis1=1, axis2=2)
    J = J.reshape(-1, 3)
    return J @ P @ J.T, np.ceil(sigma**2 / own / share)
