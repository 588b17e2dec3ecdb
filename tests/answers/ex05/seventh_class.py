"""A seventh class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "05-localise",
        "recursion over the steps",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    def rest(x, P, k):
        if k == len(drives):
            return []
        x, P = predict(x, P, drives[k], C)
        if ids[k] != -1:
            x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
        return [(x, P), *rest(x, P, k + 1)]
    xs, Ps = zip(*rest(x, P, 0))
    return np.stack(xs), np.stack(Ps)
""",
    ),
    (
        "05-ranges",
        "information form, H by a complex step",
        """
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
""",
    ),
    (
        "05-map",
        "all sights of a landmark fused by their information",
        """
def build_map(xs, ids, zs, R):
    sums = {}
    for x, i, z in zip(xs, ids, zs):
        J = J_z(x, z)
        W = np.linalg.inv(J @ R @ J.T)
        L, b = sums.get(int(i), (np.zeros((2, 2)), np.zeros(2)))
        sums[int(i)] = L + W, b + W @ g(x, z)
    return {i: (np.linalg.solve(L, b), np.linalg.inv(L)) for i, (L, b) in sums.items()}
""",
    ),
]

WRONG = [
    (
        "05-locate",
        "the two numbers of the sight one after the other, as if they did not err together",
        """
def locate(x, P, z, p, R):
    H, v = H_robot(x, p), z - h(x, p)
    v[1] = wrap(v[1])
    start = x
    for k in range(2):
        S = H[k] @ P @ H[k] + R[k, k]
        K = P @ H[k] / S
        x = x + K * (v[k] - H[k] @ (x - start))
        P = P - np.outer(K, K) * S
    return x, P
""",
    ),
    (
        "05-locate",
        "range first, then the bearing from where the range has moved it",
        """
def locate(x, P, z, p, R):
    for k in range(2):
        H = H_robot(x, p)[k : k + 1]
        v = z[k] - h(x, p)[k]
        if k == 1:
            v = wrap(v)
        S = H @ P @ H.T + R[k, k]
        K = P @ H.T / S
        x, P = x + K[:, 0] * v, P - K @ S @ K.T
    return x, P
""",
    ),
    (
        "05-localise",
        "each time from the start: P is predicted, x is summed up by the wheels",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    wheels = x
    for u, i, z in zip(drives, ids, zs):
        _, P = predict(wheels, P, u, C)
        wheels = f_odometry(wheels, u)
        y = wheels
        if i != -1:
            y, P = locate(wheels, P, z, landmarks[i], R)
        xs.append(y)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "if ids: 0 is taken for nothing, too",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for k, u in enumerate(drives):
        x, P = predict(x, P, u, C)
        if ids[k] > 0:
            x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-map",
        "an array by id, as large as the largest, and all rows returned",
        """
def build_map(xs, ids, zs, R):
    size = int(max(ids, default=-1)) + 1
    p, P = np.zeros((size, 2)), np.zeros((size, 2, 2))
    seen = np.zeros(size, dtype=bool)
    for x, i, z in zip(xs, ids, zs):
        if seen[i]:
            p[i], P[i] = update_landmark(p[i], P[i], x, z, R)
        else:
            p[i], P[i] = g(x, z), J_z(x, z) @ R @ J_z(x, z).T
            seen[i] = True
    return {i: (p[i], P[i]) for i in range(size)}
""",
    ),
    (
        "05-ranges",
        "the pose is moved to the antenna, located there, and moved back with the old heading",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1], 0])
    y = x + arm
    d = y[:2] - beacons
    n = np.hypot(d[:, 0], d[:, 1])
    H = np.column_stack([d[:, 0] / n, d[:, 1] / n, np.zeros(len(n))])
    S = H @ P @ H.T + sigma**2 * np.eye(len(n))
    K = P @ H.T @ np.linalg.inv(S)
    return y + K @ (rs - n) - arm, P - K @ S @ K.T
""",
    ),
    (
        "05-lost",
        "the whole run twice: the second time from the heading that the first one ended with",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = localise(x, P, drives, ids, zs, landmarks, C, R)
    turned = np.sum(drives[:, 1])
    again = np.array([x[0], x[1], wrap(xs[-1][2] - turned)])
    Q = P.copy()
    Q[2, 2] = 0.3**2
    return localise(again, Q, drives, ids, zs, landmarks, C, R)
""",
    ),
]
