# %% way: anew
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = F @ x, F @ P @ F.T + Q
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        x, P = x + K @ (z - H @ x), P - K @ S @ K.T
        xs.append(x)
        Ps.append(P)
    return xs, Ps

# %% way: pairs
def kalman_filter(x, P, zs, F, Q, H, R):
    beliefs = []
    for z in zs:
        beliefs.append(update(*predict(x, P, F, Q), z, H, R))
        x, P = beliefs[-1]
    return tuple(zip(*beliefs))

# %% way: filled
def kalman_filter(x, P, zs, F, Q, H, R):
    x, P = x.copy(), P.copy()
    xs, Ps = np.zeros((len(zs), len(x))), np.zeros((len(zs), *P.shape))
    for k in range(len(zs)):
        x[:] = F @ x
        P[:] = F @ P @ F.T + Q
        K = np.linalg.solve(H @ P @ H.T + R, H @ P).T
        x += K @ (zs[k] - H @ x)
        P -= K @ H @ P
        xs[k], Ps[k] = x, P
    return xs, Ps

# %% way: columns
def kalman_filter(x, P, zs, F, Q, H, R):
    x, out = x.reshape(-1, 1), []
    for z in zs:
        x, P = F @ x, F @ P @ F.T + Q
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
        x = x + K @ (z.reshape(-1, 1) - H @ x)
        J = np.eye(len(x)) - K @ H
        P = J @ P @ J.T + K @ R @ K.T
        out.append((x.ravel(), P))
    return [x for x, _ in out], [P for _, P in out]

# %% way: information
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps, weight = [], [], H.T @ np.linalg.inv(R)
    for z in zs:
        ahead = np.linalg.inv(F @ P @ F.T + Q)
        P = np.linalg.inv(ahead + weight @ H)
        x = P @ (ahead @ F @ x + weight @ z)
        xs += [x]
        Ps += [P]
    return np.stack(xs), np.stack(Ps)

# %% way: recursive
def kalman_filter(x, P, zs, F, Q, H, R):
    if len(zs) == 0:
        return np.zeros((0, len(x))), np.zeros((0, *P.shape))
    x, P = update(*predict(x, P, F, Q), zs[0], H, R)
    xs, Ps = kalman_filter(x, P, zs[1:], F, Q, H, R)
    return np.vstack([x, xs]), np.concatenate([P[None], Ps])

# %% right: arrays filled, Joseph's form inside
def kalman_filter(x, P, zs, F, Q, H, R):
    n, k = len(x), len(zs)
    xs, Ps = np.empty((k, n)), np.empty((k, n, n))
    for t in range(k):
        x = F @ x
        P = F @ P @ F.T + Q
        G = np.linalg.solve((H @ P @ H.T + R).T, (P @ H.T).T).T
        A = np.eye(n) - G @ H
        x, P = x + G @ (zs[t] - H @ x), A @ P @ A.T + G @ R @ G.T
        xs[t], Ps[t] = x, P
    return xs, Ps

# %% right: preallocated, indices
def kalman_filter(x, P, zs, F, Q, H, R):
    steps, n = len(zs), len(x)
    xs = np.zeros((steps, n))
    Ps = np.zeros((steps, n, n))
    for k in range(steps):
        before = (x, P) if k == 0 else (xs[k - 1], Ps[k - 1])
        xs[k], Ps[k] = update(*predict(*before, F, Q), zs[k], H, R)
    return xs, Ps

# %% right: itertools.accumulate, filter equations written out
def kalman_filter(x, P, zs, F, Q, H, R):
    from itertools import accumulate

    def step(belief, z):
        x, P = belief
        x, P = F @ x, F @ P @ F.T + Q
        K = np.linalg.solve(H @ P @ H.T + R, H @ P).T
        A = np.eye(len(x)) - K @ H
        return x + K @ (z - H @ x), A @ P @ A.T + K @ R @ K.T

    beliefs = list(accumulate(zs, step, initial=(x, P)))[1:]
    return np.stack([b[0] for b in beliefs]), np.stack([b[1] for b in beliefs])

# %% wrong: the start is returned, too
def kalman_filter(x, P, zs, F, Q, H, R):
    beliefs = [(x, P)]
    for z in zs:
        beliefs.append(update(*predict(*beliefs[-1], F, Q), z, H, R))
    xs, Ps = zip(*beliefs)
    return np.array(xs), np.array(Ps)

# %% wrong: the last measurement is left out
def kalman_filter(x, P, zs, F, Q, H, R):
    xs = np.zeros((len(zs), len(x)))
    Ps = np.zeros((len(zs), len(x), len(x)))
    for k in range(len(zs) - 1):
        x, P = predict(x, P, F, Q)
        x, P = update(x, P, zs[k], H, R)
        xs[k], Ps[k] = x, P
    return xs, Ps

# %% wrong: returns only the last belief
def kalman_filter(x, P, zs, F, Q, H, R):
    for z in zs:
        x, P = predict(x, P, F, Q)
        x, P = update(x, P, z, H, R)
    return x, P

# %% wrong: two states hard-coded
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = np.zeros((len(zs), 2)), np.zeros((len(zs), 2, 2))
    for i, z in enumerate(zs):
        x, P = update(*predict(x, P, F, Q), z, H, R)
        xs[i, :], Ps[i, :, :] = x, P
    return xs, Ps

# %% wrong: P is predicted without Q, which is added at the end of the step only for output
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = F @ x, F @ P @ F.T
        x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P + Q)
    return np.array(xs), np.array(Ps)

# %% wrong: covariances made positive with abs
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = predict(x, P, F, Q)
        x, P = update(x, P, z, H, R)
        P = np.abs(P)
        xs.append(x)
        Ps.append(P)
    return np.stack(xs), np.stack(Ps)

# %% wrong: only the variances are returned
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = update(*predict(x, P, F, Q), z, H, R)
        xs.append(x)
        Ps.append(np.diag(P))
    return np.array(xs), np.array(Ps)
