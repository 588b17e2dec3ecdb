# %% way: joseph
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    P[0, 0] += q
    x[0] += d
    H = np.zeros((1, len(x)))
    H[0, 0], H[0, i] = -1, 1
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + r)
    L = np.eye(len(x)) - K @ H
    return x + (K * (z - x[i] + x[0])).ravel(), L @ P @ L.T + K * r @ K.T

# %% way: entry by entry
def step(x, P, d, q, i, z, r):
    n = len(x)
    x, P = list(x), [list(row) for row in P]
    x[0], P[0][0] = x[0] + d, P[0][0] + q
    c = [P[k][i] - P[k][0] for k in range(n)]
    S = c[i] - c[0] + r
    v = z - (x[i] - x[0])
    x = [x[k] + c[k] * v / S for k in range(n)]
    return x, [[P[k][l] - c[k] * c[l] / S for l in range(n)] for k in range(n)]

# %% way: with A and Q
def step(x, P, d, q, i, z, r):
    A, Q, u = np.eye(len(x)), np.zeros_like(P), np.zeros_like(x)
    Q[0, 0], u[0] = q, d
    x, P = A @ x + u, A @ P @ A.T + Q
    H = np.eye(len(x))[i] - np.eye(len(x))[0]
    S = float(H @ P @ H) + r
    return [x + P @ H * (z - H @ x) / S, P - np.outer(P @ H, H @ P) / S]

# %% way: short
def step(x, P, d, q, i, z, r):
    first = np.arange(len(x)) == 0
    x, P = x + d * first, P + q * np.outer(first, first)
    shared = P[:, i] - P[:, 0]
    K = shared / (shared[i] - shared[0] + r)
    return x + K * (z + x[0] - x[i]), P - np.outer(K, shared)

# %% way: the sight as an entry
def step(x, P, d, q, i, z, r):
    n = len(x)
    F = np.vstack([np.eye(n), np.eye(n)[i] - np.eye(n)[0]])
    x = x + d * np.eye(n)[0]
    joint = F @ (P + np.diag(np.r_[q, np.zeros(n - 1)])) @ F.T
    joint[n, n] += r
    K = joint[:n, n] / joint[n, n]
    return x + K * (z - F[n] @ x), joint[:n, :n] - np.outer(K, joint[n, :n])

# %% right: text-book matrices and Joseph's form
def step(x, P, d, q, i, z, r):
    n = x.size
    u = np.zeros(n)
    u[0] = d
    Q = np.zeros((n, n))
    Q[0, 0] = q
    x_bar, P_bar = x + u, P + Q
    H = np.zeros((1, n))
    H[0, 0] = -1.0
    H[0, i] = 1.0
    S = H @ P_bar @ H.T + r
    K = P_bar @ H.T / S
    A = np.eye(n) - K @ H
    return x_bar + K[:, 0] * (z - (x_bar[i] - x_bar[0])), A @ P_bar @ A.T + r * K @ K.T

# %% right: columns of P, loops
def step(x, P, d, q, i, z, r):
    n = len(x)
    new_x = [float(v) for v in x]
    new_x[0] += d
    C = [[float(P[a, b]) for b in range(n)] for a in range(n)]
    C[0][0] += q
    col = [C[a][i] - C[a][0] for a in range(n)]
    S = col[i] - col[0] + r
    nu = z - (new_x[i] - new_x[0])
    for a in range(n):
        new_x[a] += col[a] / S * nu
        for b in range(n):
            C[a][b] -= col[a] * col[b] / S
    return np.array(new_x), np.array(C)

# %% right: two separate Kalman lines
def step(x, P, d, q, i, z, r):
    n = len(x)
    m = np.array(x, dtype=float)
    m[0] = m[0] + d
    S = np.array(P, dtype=float)
    S[0, 0] = S[0, 0] + q
    s = S[i, i] - S[i, 0] - S[0, i] + S[0, 0] + r
    k = (S[:, i] - S[:, 0]) / s
    return m + k * (z - (m[i] - m[0])), S - np.outer(k, S[i] - S[0])

# %% right: as the conditional of a joint normal
def step(x, P, d, q, i, z, r):
    n = len(x)
    x, P = x.astype(float), P.astype(float)
    x[0] += d
    P[0, 0] += q
    M = np.vstack([np.eye(n), np.eye(n)[i] - np.eye(n)[0]])
    joint = M @ P @ M.T
    joint[n, n] += r
    gain = joint[:n, n] / joint[n, n]
    return x + gain * (z - x[i] + x[0]), joint[:n, :n] - np.outer(gain, joint[n, :n])

# %% wrong: forgets the correlations: diagonal only
def step(x, P, d, q, i, z, r):
    v = np.diag(P).copy()
    v[0] += q
    y = x.copy()
    y[0] += d
    s = v[0] + v[i] + r
    nu = z - (y[i] - y[0])
    k0, ki = -v[0] / s, v[i] / s
    y[0] += k0 * nu
    y[i] += ki * nu
    v[0] -= k0 * k0 * s
    v[i] -= ki * ki * s
    return y, np.diag(v)

# %% wrong: the caller's x and P are driven in place
def step(x, P, d, q, i, z, r):
    x[0] += d
    P[0, 0] += q
    H = np.zeros(x.size)
    H[0], H[i] = -1, 1
    K = P @ H / (H @ P @ H + r)
    return x + K * (z - x[i] + x[0]), P - np.outer(K, H @ P)

# %% wrong: information form: a variance of 0 cannot be inverted
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    Y = np.linalg.inv(P)
    H = np.zeros(len(x))
    H[0], H[i] = -1, 1
    P_new = np.linalg.inv(Y + np.outer(H, H) / r)
    return P_new @ (Y @ x + H * z / r), P_new

# %% wrong: the drive carries the doors along
def step(x, P, d, q, i, z, r):
    x = x + d
    P = P + q
    H = np.zeros(len(x))
    H[0], H[i] = -1.0, 1.0
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - H @ x), P - np.outer(K, H @ P)

# %% wrong: H with both signs +
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    H = np.zeros(len(x)); H[0] = 1; H[i] = 1
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - (x[i] - x[0])), P - S * np.outer(K, K)

# %% wrong: i counted among doors from 0
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    h = np.zeros(len(x)); h[0], h[(i + 1) % len(x)] = -1, 1
    k = P @ h / (h @ P @ h + r)
    return x + k * (z - h @ x), P - np.outer(k, h @ P)
