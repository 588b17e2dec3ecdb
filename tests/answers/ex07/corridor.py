"""Independent answers to 07-corridor: right ones, and students' mistakes."""

RIGHT = [
    (
        "07-corridor",
        "text-book matrices and Joseph's form",
        """
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
""",
    ),
    (
        "07-corridor",
        "columns of P, loops",
        """
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
""",
    ),
]

WRONG = [
    (
        "07-corridor",
        "sign of H against that of the innovation",
        """
def step(x, P, d, q, i, z, r):
    x = x.copy(); P = P.copy()
    x[0] = x[0] + d
    P[0, 0] = P[0, 0] + q
    h = np.zeros(len(x)); h[0] = 1; h[i] = -1
    s = h @ P @ h + r
    k = P @ h / s
    nu = z - (x[i] - x[0])
    return x + k * nu, P - np.outer(k, k) * s
""",
    ),
    (
        "07-corridor",
        "only robot and seen door are updated, the others' correlations kept stale",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    idx = [0, i]
    sub = P[np.ix_(idx, idx)]
    h = np.array([-1.0, 1.0])
    s = h @ sub @ h + r
    k = sub @ h / s
    x[idx] += k * (z - x[i] + x[0])
    P[np.ix_(idx, idx)] = sub - s * np.outer(k, k)
    return x, P
""",
    ),
    (
        "07-corridor",
        "forgets the correlations: diagonal only",
        """
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
""",
    ),
    (
        "07-corridor",
        "S without the -2 P_0i",
        """
def step(x, P, d, q, i, z, r):
    F = P.copy()
    F[0, 0] += q
    y = x.copy()
    y[0] += d
    S = F[0, 0] + F[i, i] + r
    K = (F[:, i] - F[:, 0]) / S
    return y + K * (z - y[i] + y[0]), F - np.outer(K, K) * S
""",
    ),
    (
        "07-corridor",
        "r taken for a standard deviation",
        """
def step(x, P, d, q, i, z, r):
    n = len(x)
    H = np.zeros((1, n)); H[0, [0, i]] = -1, 1
    x1 = x + d * np.eye(n)[0]
    P1 = P + q * np.outer(np.eye(n)[0], np.eye(n)[0])
    S = H @ P1 @ H.T + r**2
    K = P1 @ H.T @ np.linalg.inv(S)
    return x1 + (K @ (z - H @ x1)), (np.eye(n) - K @ H) @ P1
""",
    ),
    (
        "07-corridor",
        "q taken for a standard deviation",
        """
def step(x, P, d, q, i, z, r):
    x, P = np.array(x, float), np.array(P, float)
    x[0] += d
    P[0, 0] += q**2
    c = P[:, i] - P[:, 0]
    S = c[i] - c[0] + r
    return x + c / S * (z - x[i] + x[0]), P - np.outer(c, c) / S
""",
    ),
    (
        "07-corridor",
        "the drive is added after the sight",
        """
def step(x, P, d, q, i, z, r):
    H = np.zeros(len(x))
    H[0], H[i] = -1, 1
    S = H @ P @ H + r
    K = P @ H / S
    x = x + K * (z - H @ x)
    P = P - np.outer(K, K) * S
    x[0] += d
    P[0, 0] += q
    return x, P
""",
    ),
    (
        "07-corridor",
        "the caller's x and P are driven in place",
        """
def step(x, P, d, q, i, z, r):
    x[0] += d
    P[0, 0] += q
    H = np.zeros(x.size)
    H[0], H[i] = -1, 1
    K = P @ H / (H @ P @ H + r)
    return x + K * (z - x[i] + x[0]), P - np.outer(K, H @ P)
""",
    ),
    (
        "07-corridor",
        "hard-coded for three doors",
        """
def step(x, P, d, q, i, z, r):
    Q = np.diag([q, 0, 0, 0])
    H = np.array([-1, 0, 0, 0])
    H[i] = 1
    x = x + np.array([d, 0, 0, 0])
    P = P + Q
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - H @ x), P - np.outer(K, K) * S
""",
    ),
    (
        "07-corridor",
        "distance taken as positive always",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    H = np.zeros(len(x))
    sign = 1 if x[i] >= x[0] else -1
    H[0], H[i] = -sign, sign
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - abs(x[i] - x[0])), P - S * np.outer(K, K)
""",
    ),
    (
        "07-corridor",
        "doors numbered from 0: entry i + 1",
        """
def step(x, P, d, q, i, z, r):
    j = (i + 1) if i + 1 < len(x) else i
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    col = P[:, j] - P[:, 0]
    S = col[j] - col[0] + r
    K = col / S
    return x + K * (z - (x[j] - x[0])), P - S * np.outer(K, K)
""",
    ),
    (
        "07-corridor",
        "no drive, no noise: q skipped where d is 0",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    if d:
        x[0] += d
        P[0, 0] += q
    H = np.zeros(len(x))
    H[0], H[i] = -1, 1
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - H @ x), P - S * np.outer(K, K)
""",
    ),
    (
        "07-corridor",
        "only the robot is corrected, doors count as fixed marks",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    k = P[0, 0] / (P[0, 0] + r)
    x[0] += k * ((x[i] - z) - x[0])
    P[0, :] *= 1 - k
    P[:, 0] *= 1 - k
    P[0, 0] /= 1 - k
    return x, P
""",
    ),
    (
        "07-corridor",
        "a door that shares nothing yet is set anew, its prior thrown away",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    if np.all(P[i, np.arange(len(x)) != i] == 0):      # first time in sight
        x[i] = x[0] + z
        P[i, :] = P[0, :]
        P[:, i] = P[:, 0]
        P[i, i] = P[0, 0] + r
        return x, P
    H = np.zeros(len(x))
    H[0], H[i] = -1, 1
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - H @ x), P - S * np.outer(K, K)
""",
    ),
    (
        "07-corridor",
        "information form: a variance of 0 cannot be inverted",
        """
def step(x, P, d, q, i, z, r):
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    Y = np.linalg.inv(P)
    H = np.zeros(len(x))
    H[0], H[i] = -1, 1
    P_new = np.linalg.inv(Y + np.outer(H, H) / r)
    return P_new @ (Y @ x + H * z / r), P_new
""",
    ),
    (
        "07-corridor",
        "the drive carries the doors along",
        """
def step(x, P, d, q, i, z, r):
    x = x + d
    P = P + q
    H = np.zeros(len(x))
    H[0], H[i] = -1.0, 1.0
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - H @ x), P - np.outer(K, H @ P)
""",
    ),
]
