# %% way: by logarithms
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = F @ x + u, F @ P @ F.T + Q
        v, S = z - H @ x, H @ P @ H.T + R
        K = np.linalg.solve(S, H @ P).T
        odds = np.log((1 - OUTLIERS) / OUTLIERS * REACH) - v @ np.linalg.solve(S, v) / 2
        odds = odds - np.linalg.slogdet(2 * np.pi * S)[1] / 2
        share = 1 / (1 + np.exp(-odds))
        rest = np.eye(2) - K @ H
        taken = rest @ P @ rest.T + K @ R @ K.T
        a, b = x, x + K @ v
        x = (1 - share) * a + share * b
        P = (1 - share) * (P + np.outer(a - x, a - x)) + share * (taken + np.outer(b - x, b - x))
        xs.append(x)
        Ps.append(P)
    return xs, Ps

# %% way: number by number
def wary_filter(x, P, us, zs, F, Q, H, R):
    noise = R[0, 0]
    xs, Ps = np.zeros_like(us), np.zeros((len(us), 2, 2))
    for k in range(len(us)):
        x = F @ x + us[k]
        P = F @ P @ F.T + Q
        S = P[0, 0] + noise
        v = zs[k, 0] - x[0]
        real = 0.75 * np.exp(-0.5 * v**2 / S) / np.sqrt(2 * np.pi * S)
        w = real / (real + 0.25 / 10)
        K = P[:, 0] / S
        P = P - (w - w * (1 - w) * v**2 / S) * S * np.outer(K, K)
        x = x + w * v * K
        xs[k], Ps[k] = x, P
    return xs, Ps

# %% way: several cases
def wary_filter(x, P, us, zs, F, Q, H, R):
    weights, means, doubts, xs, Ps = np.ones(1), x[None], P[None], [], []
    for u, z in zip(us, zs):
        means, doubts = means @ F.T + u, F @ doubts @ F.T + Q
        v, S = z[0] - means[:, 0], doubts[:, 0, 0] + R[0, 0]
        K = doubts[:, :, 0] / S[:, None]
        real = (1 - OUTLIERS) * np.exp(-v * v / S / 2) / np.sqrt(2 * np.pi * S)
        weights = np.append(weights * OUTLIERS / REACH, weights * real)
        doubts = np.append(doubts, doubts - np.einsum("c,ci,cj->cij", S, K, K), axis=0)
        means = np.append(means, means + K * v[:, None], axis=0)
        best = np.argsort(weights)[-4:]
        weights, means, doubts = weights[best] / weights[best].sum(), means[best], doubts[best]
        xs.append(weights @ means)
        off = means - xs[-1]
        Ps.append(np.einsum("c,cij->ij", weights, doubts) + (weights * off.T) @ off)
    return xs, Ps

# %% way: a guess of one third
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = innovation(x, P, z, H, R)
        K = P @ H.T @ np.linalg.inv(S)
        outlier = np.sqrt(S[0, 0]) / 8
        share = 1 / (1 + outlier * np.exp(min(v[0] ** 2 / S[0, 0] / 2, 700)))
        P = P - share * K @ H @ P + share * (1 - share) * np.outer(K @ v, K @ v)
        x = x + share * K @ v
        xs.append(x)
        Ps.append(P)
    return xs, Ps

# %% pasted: the lesson's filter
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x, P = update(x + u, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)

# %% pasted: Joseph's form
def wary_filter(x, P, us, zs, F, Q, H, R):
    beliefs = []
    for u, z in zip(us, zs):
        x, P = F @ x + u, F @ P @ F.T + Q
        v = z - H @ x
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        rest = np.eye(len(P)) - K @ H
        x, P = x + K @ v, rest @ P @ rest.T + K @ R @ K.T
        beliefs.append((x, P))
    return [np.array(values) for values in zip(*beliefs, strict=True)]

# %% pasted: task 3 with the pushes left out
def wary_filter(x, P, us, zs, F, Q, H, R):
    return kalman_filter(x, P, zs, F, Q, H, R)

# %% right: follow both cases: a sum of Gaussians, the best 40 kept
def wary_filter(x, P, us, zs, F, Q, H, R):
    cases = [(1.0, x, P)]
    xs, Ps = [], []
    for u, z in zip(us, zs):
        following = []
        for weight, x, P in cases:
            x, P = F @ x + u, F @ P @ F.T + Q
            v, S = innovation(x, P, z, H, R)
            likely = np.exp(-0.5 * v[0] ** 2 / S[0, 0]) / np.sqrt(2 * np.pi * S[0, 0])
            following.append((weight * OUTLIERS / REACH, x, P))
            K = P @ H.T / S[0, 0]
            following.append((weight * (1 - OUTLIERS) * likely, x + K @ v, P - K @ S @ K.T))
        following.sort(key=lambda case: -case[0])
        following = following[:40]
        total = sum(case[0] for case in following)
        cases = [(weight / total, x, P) for weight, x, P in following]
        mean = sum(weight * x for weight, x, _ in cases)
        cov = sum(w * (P + np.outer(x - mean, x - mean)) for w, x, P in cases)
        xs.append(mean)
        Ps.append(cov)
    return np.array(xs), np.array(Ps)

# %% right: probabilistic data association, in words of log odds
def wary_filter(x, P, us, zs, F, Q, H, R):
    n = len(zs)
    xs, Ps = np.zeros((n, 2)), np.zeros((n, 2, 2))
    for k in range(n):
        x, P = predict(x, P, F, Q)
        x = x + us[k]
        x_real, P_real = update(x, P, zs[k], H, R)
        v, S = innovation(x, P, zs[k], H, R)
        log_real = np.log(1 - OUTLIERS) - 0.5 * (v @ np.linalg.solve(S, v))
        log_real -= 0.5 * np.log(np.linalg.det(2 * np.pi * S))
        b = 1 / (1 + np.exp(np.log(OUTLIERS / REACH) - log_real))
        mean = b * x_real + (1 - b) * x
        d1, d0 = x_real - mean, x - mean
        P = b * (P_real + np.outer(d1, d1)) + (1 - b) * (P + np.outer(d0, d0))
        x = mean
        xs[k], Ps[k] = x, P
    return xs, Ps

# %% wrong: the readings themselves, the speed by differences
def wary_filter(x, P, us, zs, F, Q, H, R):
    place = np.concatenate([[x[0]], zs[:, 0]])
    speed = np.diff(place) / F[0, 1]
    Ps = np.tile(np.diag([REACH**2 / 12, 4 * REACH**2]), (len(zs), 1, 1))
    return np.column_stack([place[1:], speed]), Ps

# %% wrong: a gate, and a P 1.6 times as large, so that NEES is 2 over all steps
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = innovation(x, P, z, H, R)
        if v[0] ** 2 < 9 * S[0, 0]:
            x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(1.6 * P)
    return np.array(xs), np.array(Ps)

# %% wrong: median of the last five readings, then the lesson's filter
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for k in range(len(zs)):
        z = np.median(zs[max(0, k - 4) : k + 1], axis=0)
        x, P = predict(x, P, F, Q)
        x, P = update(x + us[k], P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)

# %% wrong: one reading in four refused at random
def wary_filter(x, P, us, zs, F, Q, H, R):
    rng = np.random.default_rng(0)
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        if rng.random() > OUTLIERS:
            x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)

# %% wrong: refused readings leave no belief: too few rows
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = innovation(x, P, z, H, R)
        if v[0] ** 2 / S[0, 0] > 9:
            continue
        x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)

# %% wrong: a refused reading is replaced by the expected one, and P shrinks all the same
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = innovation(x, P, z, H, R)
        if abs(v[0]) > 3 * np.sqrt(S[0, 0]):
            z = H @ x
        x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)

# %% wrong: good filter that works on the caller's P and x in place
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x[:] = F @ x + u
        P[:] = F @ P @ F.T + Q
        v, S = (a.item() for a in innovation(x, P, z, H, R))
        K = P @ H[0] / S
        real = (1 - OUTLIERS) * np.exp(-(v**2) / S / 2) / np.sqrt(2 * np.pi * S)
        b = real / (real + OUTLIERS / REACH)
        x += b * v * K
        P += (b * (1 - b) * v**2 - b * S) * np.outer(K, K)
        xs.append(x.copy())
        Ps.append(P.copy())
    return np.array(xs), np.array(Ps)

# %% wrong: the gate the wrong way round: refuses what fits and takes in what is far off
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = F @ x + u, F @ P @ F.T + Q
        v, S = innovation(x, P, z, H, R)
        if v[0] ** 2 > 9 * S[0, 0]:
            x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)

# %% wrong: gate with R alone, without the doubt of the prediction: refuses true readings when unsure
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps, sigma = [], [], np.sqrt(R[0, 0])
    for k in range(len(zs)):
        x, P = predict(x, P, F, Q)
        x = x + us[k]
        if abs(zs[k, 0] - x[0]) < 1.5 * sigma:
            x, P = update(x, P, zs[k], H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)

# %% wrong: a mean noise for all readings (mixture's variance as R): every outlier still pulls
def wary_filter(x, P, us, zs, F, Q, H, R):
    R_all = (1 - OUTLIERS) * R + OUTLIERS * np.array([[REACH**2 / 12]])
    xs, Ps = np.zeros((len(zs), 2)), np.zeros((len(zs), 2, 2))
    for k, z in enumerate(zs):
        x, P = predict(x, P, F, Q)
        x, P = update(x + us[k], P, z, H, R_all)
        xs[k], Ps[k] = x, P
    return xs, Ps
