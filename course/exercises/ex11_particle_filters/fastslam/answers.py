# %% way: information form, and the landmark's density by completing the square
def fast_slam(rows, weights, p, P, u, C, z, R, rng):
    rows, n = move(rows, u, C, rng), len(rows)
    logs, means, covariances = np.zeros(n), p * 1.0, P * 1.0
    W = np.linalg.inv(R)
    for i in range(n):
        x, y, theta = rows[i]
        a, b = p[i] - [x, y]
        r = np.hypot(a, b)
        H = np.array([[a / r, b / r], [-b / r / r, a / r / r]])
        v = np.array([z[0] - r, wrap(z[1] - (np.arctan2(b, a) - theta))])
        Y = np.linalg.inv(P[i])
        after = np.linalg.inv(Y + H.T @ W @ H)
        e = after @ H.T @ W @ v
        means[i], covariances[i] = p[i] + e, after
        squares = v @ W @ v - e @ np.linalg.inv(after) @ e
        logs[i] = np.log(weights[i]) - squares / 2 + np.log(np.linalg.det(after @ Y)) / 2
    return rows, normalise(logs), means, covariances

# %% way: Joseph form, own samples of the motion
def fast_slam(rows, weights, p, P, u, C, z, R, rng):
    L, moved, out = np.linalg.cholesky(C), [], []
    for x, w, m, Q in zip(rows, weights, p, P):
        moved.append(f_odometry(x, u + L @ rng.standard_normal(2)))
        x = moved[-1]
        a, b = m - x[:2]
        q = a * a + b * b
        H = np.array([[a / q**0.5, b / q**0.5], [-b / q, a / q]])
        v = z - h(x, m)
        v[1] = (v[1] + np.pi) % (2 * np.pi) - np.pi
        S = R + H @ Q @ H.T
        K = np.linalg.solve(S, H @ Q).T
        G = np.eye(2) - K @ H
        log = np.log(w) - (v @ np.linalg.solve(S, v) + np.linalg.slogdet(2 * np.pi * S)[1]) / 2
        out.append((log, m + K @ v, G @ Q @ G.T + K @ R @ K.T))
    logs, means, covariances = map(np.array, zip(*out))
    return np.array(moved), np.exp(logs - np.logaddexp.reduce(logs)), means, covariances

# %% pasted: localisation in a known map
def fast_slam(rows, weights, p, P, u, C, z, R, rng):
    rows = move(rows, u, C, rng)
    v = z - h(rows, p.mean(axis=0))
    v[:, 1] = wrap(v[:, 1])
    logs = np.log(weights) - 0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)
    return rows, normalise(logs), p, P

# %% right: numerical derivatives
def fast_slam(rows, weights, p, P, u, C, z, R, rng):
    rows = move(rows, u, C, rng)
    eps, n = 1e-5, len(rows)
    logs, p2, P2 = np.log(weights), p.copy(), P.copy()
    for i in range(n):
        def model(m):
            return h(rows[i], m)
        columns = []
        for k in range(2):
            e = np.eye(2)[k] * eps
            diff = model(p[i] + e) - model(p[i] - e)
            columns.append([diff[0] / (2 * eps), wrap(diff[1]) / (2 * eps)])
        H = np.array(columns).T
        v = z - model(p[i])
        v[1] = wrap(v[1])
        S = H @ P[i] @ H.T + R
        Si = np.linalg.inv(S)
        p2[i] = p[i] + P[i] @ H.T @ Si @ v
        P2[i] = P[i] - P[i] @ H.T @ Si @ H @ P[i]
        logs[i] += -0.5 * v @ Si @ v - 0.5 * np.log(np.linalg.det(S))
    logs -= logs.max()
    w = np.exp(logs)
    return [rows, w / w.sum(), p2, P2]

# %% right: in the frame along and across the line of sight
def fast_slam(rows, weights, p, P, u, C, z, R, rng):
    rows = move(rows, u, C, rng)
    logs, ps, Ps = [], [], []
    for (x, y, t), w, (px, py), Q in zip(rows, weights, p, P):
        r, phi = np.hypot(px - x, py - y), np.arctan2(py - y, px - x)
        A = np.array([[np.cos(phi), np.sin(phi)], [-np.sin(phi), np.cos(phi)]])
        D = np.diag([1, r])  # range and bearing errors in metres
        v = np.array([z[0] - r, r * wrap(z[1] - wrap(phi - t))])
        B, N = A @ Q @ A.T, D @ R @ D
        S = B + N
        K = B @ np.linalg.inv(S)
        ps.append(np.array([px, py]) + A.T @ K @ v)
        Ps.append(A.T @ (B - K @ B) @ A)
        logs.append(np.log(w) - 0.5 * v @ np.linalg.solve(S, v) - 0.5 * np.log(np.linalg.det(S)) + np.log(r))
    return rows, normalise(np.array(logs)), np.array(ps), np.array(Ps)

# %% wrong: in metres along and across the line of sight, without the change of the density
def fast_slam(rows, weights, p, P, u, C, z, R, rng):
    rows = move(rows, u, C, rng)
    logs, ps, Ps = [], [], []
    for (x, y, t), w, (px, py), Q in zip(rows, weights, p, P):
        r, phi = np.hypot(px - x, py - y), np.arctan2(py - y, px - x)
        A = np.array([[np.cos(phi), np.sin(phi)], [-np.sin(phi), np.cos(phi)]])
        D = np.diag([1, r])
        v = np.array([z[0] - r, r * wrap(z[1] - wrap(phi - t))])
        B, N = A @ Q @ A.T, D @ R @ D
        S = B + N
        K = B @ np.linalg.inv(S)
        ps.append(np.array([px, py]) + A.T @ K @ v)
        Ps.append(A.T @ (B - K @ B) @ A)
        logs.append(np.log(w) - 0.5 * v @ np.linalg.solve(S, v) - 0.5 * np.log(np.linalg.det(S)))
    return rows, normalise(np.array(logs)), np.array(ps), np.array(Ps)

# %% wrong: weights updated in place
def fast_slam(rows, weights, p, P, u, C, z, R, rng):
    rows = move(rows, u, C, rng)
    for i in range(len(rows)):
        d = p[i] - rows[i, :2]
        q = d @ d
        H = np.array([[d[0] / q**0.5, d[1] / q**0.5], [-d[1] / q, d[0] / q]])
        v = z - h(rows[i], p[i])
        v[1] = wrap(v[1])
        S = H @ P[i] @ H.T + R
        K = P[i] @ H.T @ np.linalg.inv(S)
        p[i] = p[i] + K @ v
        P[i] = P[i] - K @ S @ K.T
        weights[i] *= np.exp(-0.5 * v @ np.linalg.inv(S) @ v) / np.sqrt(np.linalg.det(S))
    return rows, weights / weights.sum(), p, P

# %% wrong: the pose's uncertainty is added to S, as in EKF-SLAM
def fast_slam(rows, weights, p, P, u, C, z, R, rng):
    rows = move(rows, u, C, rng)
    mean = weights @ rows
    spread = (rows - mean).T @ ((rows - mean) * weights[:, None])
    logs, p, P = np.log(weights), p.copy(), P.copy()
    for i, x in enumerate(rows):
        d = p[i] - x[:2]
        q = d @ d
        Hp = np.array([d / np.sqrt(q), [-d[1] / q, d[0] / q]])
        Hx = np.column_stack([-Hp, [0, -1]])
        v = z - h(x, p[i])
        v[1] = wrap(v[1])
        S = Hp @ P[i] @ Hp.T + Hx @ spread @ Hx.T + R
        K = P[i] @ Hp.T @ np.linalg.inv(S)
        p[i] += K @ v
        P[i] -= K @ S @ K.T
        logs[i] -= 0.5 * (v @ np.linalg.inv(S) @ v + np.log(np.linalg.det(S)))
    return rows, normalise(logs), p, P
