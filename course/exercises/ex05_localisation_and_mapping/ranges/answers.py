# %% way: one after the other, H of the first pose
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    q = np.array([x[0] + c * a[0] - s * a[1], x[1] + s * a[0] + c * a[1]])
    here = x
    for r, b in zip(rs, beacons):
        far = np.hypot(*(q - b))
        ex, ey = (q - b) / far
        h_row = np.array([ex, ey, ey * (q - x[:2])[0] - ex * (q - x[:2])[1]])
        K = P @ h_row / (h_row @ P @ h_row + sigma**2)
        here = here + K * (r - far - h_row @ (here - x))
        P = P - np.outer(K, h_row @ P)
    return here, P

# %% way: information, summed
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    q = np.array([x[0] + c * a[0] - s * a[1], x[1] + s * a[0] + c * a[1]])
    Y, y = np.linalg.inv(P), np.zeros(3)
    for r, b in zip(rs, beacons):
        far = np.linalg.norm(q - b)
        angle = np.arctan2(*(q - b)[::-1])
        arm = a[0] * np.sin(angle - x[2]) - a[1] * np.cos(angle - x[2])
        H = np.array([np.cos(angle), np.sin(angle), arm])
        Y, y = Y + np.outer(H, H) / sigma**2, y + H * (r - far) / sigma**2
    return x + np.linalg.solve(Y, y), np.linalg.inv(Y)

# %% way: by the antenna's polar models
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    if len(rs) == 0:
        return x.copy(), P.copy()
    q = g(x, np.array([np.hypot(*a), np.arctan2(a[1], a[0])]))
    at = np.array([q[0], q[1], x[2]])
    arm = np.eye(3)
    arm[:2, 2] = [-(q - x[:2])[1], (q - x[:2])[0]]
    H = np.vstack([H_robot(at, b)[:1] @ arm for b in beacons])
    v = rs - h(at, beacons)[:, 0]
    S = H @ P @ H.T + np.diag([sigma**2] * len(v))
    K = np.linalg.solve(S, H @ P).T
    x = x + K @ v
    x[2] = wrap(x[2])
    return [x, P - K @ S @ K.T]

# %% way: least squares by QR
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    q = np.array([x[0] + c * a[0] - s * a[1], x[1] + s * a[0] + c * a[1]])
    d = q - beacons
    r = np.sqrt((d**2).sum(axis=1))
    H = np.stack([d[:, 0] / r, d[:, 1] / r, (d[:, 1] * (q - x[:2])[0] - d[:, 0] * (q - x[:2])[1]) / r], 1)
    root = np.linalg.cholesky(np.linalg.inv(P)).T
    M = np.vstack([root, H / sigma])
    Q, U = np.linalg.qr(M)
    step = np.linalg.solve(U, Q.T @ np.append(np.zeros(3), (rs - r) / sigma))
    return x + step, np.linalg.inv(U.T @ U)

# %% pasted: the lesson's update with the range alone
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    for r, p in zip(rs, beacons):
        v = np.array([r - h(x, p)[0]])
        H = H_robot(x, p)[:1]
        S = H @ P @ H.T + sigma**2
        K = P @ H.T @ np.linalg.inv(S)
        x, P = x + K @ v, P - K @ S @ K.T
    return x, P

# %% pasted: locate, its bearing with a large R
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    for r, p in zip(rs, beacons):
        x, P = locate(x, P, np.array([r, h(x, p)[1]]), p, np.diag([sigma**2, 1e6]))
    return x, P

# %% right: one range after the other, all Jacobians at the first pose
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    new, C = np.array(x, float), np.array(P, float)
    for r, b in zip(rs, beacons):
        d = x[:2] + arm - b
        n = np.sqrt(d @ d)
        H = np.array([d[0], d[1], d[1] * arm[0] - d[0] * arm[1]]) / n
        S = H @ C @ H + sigma ** 2
        K = C @ H / S
        new = new + K * (r - n - H @ (new - x))
        C = C - np.outer(K, K) * S
    return new, C

# %% right: information form, loop over beacons
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    ax = x[0] + c * a[0] - s * a[1]
    ay = x[1] + s * a[0] + c * a[1]
    info, vector = np.linalg.inv(P), np.zeros(3)
    for r, b in zip(rs, beacons):
        dx, dy = ax - b[0], ay - b[1]
        e = np.hypot(dx, dy)
        row = np.array([dx, dy, dx * (-s * a[0] - c * a[1]) + dy * (c * a[0] - s * a[1])]) / e
        info = info + np.outer(row, row) / sigma ** 2
        vector = vector + row * (r - e) / sigma ** 2
    P_new = np.linalg.inv(info)
    return x + P_new @ vector, P_new

# %% right: information form, H by a complex step
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    if len(rs) == 0:
        return x.copy(), P.copy()
    def ranges(y):
        c, s = np.cos(y[2]), np.sin(y[2])
        dx = y[0] + c * a[0] - s * a[1] - beacons[:, 0]
        dy = y[1] + s * a[0] + c * a[1] - beacons[:, 1]
        return np.sqrt(dx * dx + dy * dy)
    H = np.column_stack([ranges(x + 1e-30j * e).imag / 1e-30 for e in np.eye(3)])
    after = np.linalg.inv(np.linalg.inv(P) + H.T @ H / sigma**2)
    return x + after @ H.T @ (rs - ranges(x)) / sigma**2, after

# %% wrong: H by differences
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    def expected(x):
        c, s = np.cos(x[2]), np.sin(x[2])
        at = x[:2] + np.array([[c, -s], [s, c]]) @ a
        return np.array([np.sqrt((at - b) @ (at - b)) for b in beacons])

    H = np.array([(expected(x + e) - expected(x - e)) / 2e-6 for e in 1e-6 * np.eye(3)]).T
    H = H.reshape(len(rs), 3)
    R = np.diag(np.full(len(rs), sigma**2))
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    keep = np.eye(3) - K @ H
    return x + K @ (rs - expected(x)), keep @ P @ keep.T + K @ R @ K.T

# %% wrong: distances below half a metre are set to half a metre, against division by zero
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = x[:2] + arm - beacons
    r = np.maximum(np.linalg.norm(d, axis=1), 0.5)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T

# %% wrong: S without the matrix: sigma^2 added everywhere
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = x[:2] + arm - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2
    K = P @ H.T @ np.linalg.pinv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
