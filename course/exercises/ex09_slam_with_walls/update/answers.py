# %% way: Joseph's form
def update(x, P, z, j, R):
    i = 2 * j + 3
    a = x[i + 1]
    H = np.zeros((2, x.size))
    H[0, 0], H[0, 1], H[1, 2] = -np.cos(a), -np.sin(a), -1
    H[0, i], H[0, i + 1], H[1, i + 1] = 1, x[0] * np.sin(a) - x[1] * np.cos(a), 1
    v = np.array([z[0] - x[i] + x[0] * np.cos(a) + x[1] * np.sin(a), wrap(z[1] - wrap(a - x[2]))])
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    keep = np.eye(len(x)) - K @ H
    return x + K @ v, keep @ P @ keep.T + K @ R @ K.T

# %% way: information, on copies
def update(x, P, z, j, R):
    x, P = x.copy(), P.copy()
    a = x[4 + 2 * j]
    n, t = np.array([np.cos(a), np.sin(a)]), np.array([-np.sin(a), np.cos(a)])
    H = np.zeros((2, len(x)))
    H[0, :2], H[1, 2], H[0, 3 + 2 * j], H[1, 4 + 2 * j] = -n, -1, 1, 1
    H[0, 4 + 2 * j] = -t @ x[:2]
    v = z - [x[3 + 2 * j] - n @ x[:2], a - x[2]]
    v[1] = np.arctan2(np.sin(v[1]), np.cos(v[1]))
    W = np.linalg.inv(R)
    P[:] = np.linalg.inv(np.linalg.inv(P) + H.T @ W @ H)
    x += P @ H.T @ W @ v
    x[2::2] = wrap(x[2::2])
    return x, P

# %% way: five numbers at a time
def update(x, P, z, j, R):
    at = [0, 1, 2, 3 + 2 * j, 4 + 2 * j]
    px, py, theta, rho, alpha = x[at]
    c, s = np.cos(alpha), np.sin(alpha)
    H = np.array([[-c, -s, 0, 1, px * s - py * c], [0, 0, -1, 0, 1]])
    B = P[:, at] @ H.T
    S = H @ B[at] + R
    v = np.array([z[0] - rho + px * c + py * s, wrap(z[1] - alpha + theta)])
    return x + B @ np.linalg.solve(S, v), P - B @ np.linalg.solve(S, B.T)

# %% right: Joseph form of the covariance, gain by solve, innovation angle by atan2
def update(x, P, z, j, R):
    n = len(x)
    i = 3 + 2 * j
    px, py, th, rho, al = x[0], x[1], x[2], x[i], x[i + 1]
    H = np.zeros((2, n))
    H[0, 0] = -np.cos(al)
    H[0, 1] = -np.sin(al)
    H[0, i] = 1
    H[0, i + 1] = px * np.sin(al) - py * np.cos(al)
    H[1, 2] = -1
    H[1, i + 1] = 1
    d = z[1] - (al - th)
    v = np.array([z[0] - rho + px * np.cos(al) + py * np.sin(al), np.arctan2(np.sin(d), np.cos(d))])
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    A = np.eye(n) - K @ H
    return x + K @ v, A @ P @ A.T + K @ R @ K.T

# %% right: information form
def update(x, P, z, j, R):
    k = 3 + 2 * j
    rho, alpha = x[k : k + 2]
    n = np.array([np.cos(alpha), np.sin(alpha)])
    H = np.zeros((2, len(x)))
    H[0, :2], H[0, k], H[0, k + 1] = -n, 1, x[0] * n[1] - x[1] * n[0]
    H[1, 2], H[1, k + 1] = -1, 1
    e = z - np.array([rho - n @ x[:2], alpha - x[2]])
    e[1] = np.angle(np.exp(1j * e[1]))
    K = np.linalg.solve(H @ P @ H.T + R, H @ P).T
    I_KH = np.eye(len(x)) - K @ H
    return x + K @ e, I_KH @ P @ I_KH.T + K @ R @ K.T

# %% right: a loop over the two numbers of H, Joseph's form
def update(x, P, z, j, R):
    n = len(x)
    i = 3 + 2 * j
    a = x[i + 1]
    expected = [x[i] - x[0] * np.cos(a) - x[1] * np.sin(a), a - x[2]]
    H = np.zeros((2, n))
    H[0, 0], H[0, 1] = -np.cos(a), -np.sin(a)
    H[0, i], H[0, i + 1] = 1, x[0] * np.sin(a) - x[1] * np.cos(a)
    H[1, 2], H[1, i + 1] = -1, 1
    v = np.array([z[0] - expected[0], (z[1] - expected[1] + np.pi) % (2 * np.pi) - np.pi])
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    A = np.eye(n) - K @ H
    return x + K @ v, A @ P @ A.T + K @ R @ K.T

# %% right: rho first, then alpha, by whitening R; expectation stays that of the given state
def update(x, P, z, j, R):
    k = 3 + 2 * j
    n = np.array([np.cos(x[k + 1]), np.sin(x[k + 1])])
    t = np.array([-n[1], n[0]])
    H = np.zeros((2, x.size))
    H[0, :2] = -n
    H[0, k] = 1
    H[0, k + 1] = -t @ x[:2]
    H[1, 2] = -1
    H[1, k + 1] = 1
    v = np.array([z[0] - (x[k] - n @ x[:2]), wrap(z[1] - x[k + 1] + x[2])])
    L = np.linalg.inv(np.linalg.cholesky(R))
    G, w = L @ H, L @ v
    dx, Q = np.zeros(x.size), P.copy()
    for g_row, w_row in zip(G, w):
        gain = Q @ g_row / (g_row @ Q @ g_row + 1)
        dx = dx + gain * (w_row - g_row @ dx)
        Q = Q - np.outer(gain, g_row @ Q)
    return x + dx, (Q + Q.T) / 2

# %% wrong: H by differences
def update(x, P, z, j, R):
    def seen(s):
        rho, alpha = s[3 + 2 * j], s[4 + 2 * j]
        return np.array([rho - s[0] * np.cos(alpha) - s[1] * np.sin(alpha), alpha - s[2]])
    H = np.array([(seen(x + e) - seen(x - e)) / 2e-6 for e in 1e-6 * np.eye(len(x))]).T
    v = z - seen(x)
    v[1] = (v[1] + np.pi) % (2 * np.pi) - np.pi
    K = P @ H.T @ np.linalg.pinv(H @ P @ H.T + R)
    return [x + K @ v, P - K @ H @ P]

# %% wrong: H by seven-point differences with a step of 0.05
def update(x, P, z, j, R):
    def seen(s):
        rho, alpha = s[3 + 2 * j], s[4 + 2 * j]
        return np.array([rho - s[0] * np.cos(alpha) - s[1] * np.sin(alpha), alpha - s[2]])
    H = np.zeros((2, len(x)))
    for k, e in enumerate(0.05 * np.eye(len(x))):
        for times, weight in ((1, 45), (2, -9), (3, 1)):
            H[:, k] += weight * (seen(x + times * e) - seen(x - times * e)) / 3
    v = z - seen(x)
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T

# %% wrong: wraps everything from theta on in the new state, so a rho above pi is wrapped too
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = z - np.array([rho - x[0] * c - x[1] * s, alpha - x[2]])
    v[1] = wrap(v[1])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    new = x + K @ v
    new[2:] = wrap(new[2:])
    return new, P - K @ S @ K.T

# %% wrong: j counted from 1
def update(x, P, z, j, R):
    at = 1 + 2 * j if j > 0 else 3
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = np.array([z[0] - rho + x[0] * c + x[1] * s, wrap(z[1] - alpha + x[2])])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T

# %% wrong: the map of one wall: H has five columns
def update(x, P, z, j, R):
    rho, alpha = x[3], x[4]
    c, s = np.cos(alpha), np.sin(alpha)
    v = np.array([z[0] - rho + x[0] * c + x[1] * s, wrap(z[1] - alpha + x[2])])
    H = np.array([[-c, -s, 0, 1, x[0] * s - x[1] * c], [0, 0, -1, 0, 1]])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T

# %% wrong: P - K H
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = np.array([z[0] - rho + x[0] * c + x[1] * s, wrap(z[1] - alpha + x[2])])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return x + K @ v, P - K @ H

# %% wrong: x changed in place
def update(x, P, z, j, R):
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = np.array([z[0] - rho + x[0] * c + x[1] * s, wrap(z[1] - alpha + x[2])])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    x += K @ v
    return x, P - K @ S @ K.T

# %% wrong: stale: P by H at the new state
def update(x, P, z, j, R):
    at = 3 + 2 * j

    def slopes(x):
        c, s = np.cos(x[at + 1]), np.sin(x[at + 1])
        H = np.zeros((2, len(x)))
        H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
        H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
        return H

    H = slopes(x)
    c, s = np.cos(x[at + 1]), np.sin(x[at + 1])
    v = np.array([z[0] - x[at] + x[0] * c + x[1] * s, wrap(z[1] - x[at + 1] + x[2])])
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    x = x + K @ v
    return x, (np.eye(len(x)) - K @ slopes(x)) @ P
