"""A ninth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "05-locate",
        "information form: adds H' R^-1 H to the inverse of P",
        """
def locate(x, P, z, p, R):
    H, W = H_robot(x, p), np.linalg.inv(R)
    expected = h(x, p)
    v = np.array([z[0] - expected[0], wrap(z[1] - expected[1])])
    after = np.linalg.inv(np.linalg.inv(P) + H.T @ W @ H)
    return x + after @ H.T @ W @ v, after
""",
    ),
    (
        "05-ranges",
        "stacked square-root least squares: prior rows and range rows, solved at once",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    antenna = np.array([x[0] + c * a[0] - s * a[1], x[1] + s * a[0] + c * a[1]])
    L = np.linalg.inv(np.linalg.cholesky(P))
    rows, rights = [*L], [0.0, 0.0, 0.0]
    for r, b in zip(rs, beacons):
        d = antenna - b
        far = np.hypot(d[0], d[1])
        swing = d[0] * (-s * a[0] - c * a[1]) + d[1] * (c * a[0] - s * a[1])
        rows.append(np.array([d[0], d[1], swing]) / far / sigma)
        rights.append((r - far) / sigma)
    A, y = np.array(rows), np.array(rights)
    after = np.linalg.inv(A.T @ A)
    return x + after @ A.T @ y, after
""",
    ),
]

WRONG = [
    (
        "05-locate",
        "bearing difference not wrapped",
        """
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    v = z - h(x, p)
    return x + K @ v, (np.eye(3) - K @ H) @ P
""",
    ),
    (
        "05-locate",
        "wraps the whole innovation, the range too (range errors beyond pi metres fold over)",
        """
def locate(x, P, z, p, R):
    v = wrap(z - h(x, p))
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "changes the sight z in place",
        """
def locate(x, P, z, p, R):
    z -= h(x, p)
    z[1] = wrap(z[1])
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ z, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "repeats the update three times with the same sight and shrinking P: counts it thrice",
        """
def locate(x, P, z, p, R):
    for _ in range(3):
        v = z - h(x, p)
        v[1] = wrap(v[1])
        H = H_robot(x, p)
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        x, P = x + K @ v, P - K @ S @ K.T
    return x, P
""",
    ),
    (
        "05-localise",
        "id > 0: landmark number 0 is taken for nothing seen",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for k in range(len(drives)):
        x, P = predict(x, P, drives[k], C)
        if ids[k] > 0:
            x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "does not ask for -1: nothing seen counts as a sight of the last landmark",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    n = len(drives)
    xs, Ps = np.zeros((n, 3)), np.zeros((n, 3, 3))
    for k, (u, j) in enumerate(zip(drives, ids)):
        x, P = predict(x, P, u, C)
        x, P = locate(x, P, zs[k], landmarks[j], R)
        xs[k], Ps[k] = x, P
    return xs, Ps
""",
    ),
    (
        "05-localise",
        "looks before it drives: the sight is taken in at the pose before the drive",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    beliefs = []
    for u, j, z in zip(drives, ids, zs):
        if j != -1:
            x, P = locate(x, P, z, landmarks[j], R)
        x, P = predict(x, P, u, C)
        beliefs.append((x, P))
    return np.array([b[0] for b in beliefs]), np.array([b[1] for b in beliefs])
""",
    ),
    (
        "05-localise",
        "gives a belief only for the steps in which something was seen",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, id, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if id == -1:
            continue
        x, P = locate(x, P, z, landmarks[id], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs).reshape(-1, 3), np.array(Ps).reshape(-1, 3, 3)
""",
    ),
    (
        "05-map",
        "a new landmark is placed and then updated by the same sight: counted twice",
        """
def build_map(xs, ids, zs, R):
    m = {}
    for x, j, z in zip(xs, ids, zs):
        j = int(j)
        if j not in m:
            J = J_z(x, z)
            m[j] = (g(x, z), J @ R @ J.T)
        m[j] = update_landmark(*m[j], x, z, R)
    return m
""",
    ),
    (
        "05-map",
        "covariance of a new landmark is R itself, range and bearing not carried into x and y",
        """
def build_map(xs, ids, zs, R):
    found = {}
    for k in range(len(ids)):
        if ids[k] in found:
            p, P = found[ids[k]]
            found[ids[k]] = update_landmark(p, P, xs[k], zs[k], R)
        else:
            found[ids[k]] = (g(xs[k], zs[k]), R.copy())
    return found
""",
    ),
    (
        "05-map",
        "plain mean of all places at which it was seen, P divided by their number: no weights",
        """
def build_map(xs, ids, zs, R):
    out = {}
    for j in np.unique(ids):
        rows = np.flatnonzero(ids == j)
        places = np.array([g(xs[k], zs[k]) for k in rows])
        covs = [J_z(xs[k], zs[k]) @ R @ J_z(xs[k], zs[k]).T for k in rows]
        out[int(j)] = places.mean(axis=0), np.mean(covs, axis=0) / len(rows)
    return out
""",
    ),
    (
        "05-map",
        "a landmark seen again is placed anew: only its last sight counts",
        """
def build_map(xs, ids, zs, R):
    return {
        int(j): (g(x, z), J_z(x, z) @ R @ J_z(x, z).T) for x, j, z in zip(xs, ids, zs)
    }
""",
    ),
    (
        "05-ranges",
        "column of the heading is zero: that the antenna swings is forgotten in H",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    place = x[:2] + np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = place - beacons
    r = np.sqrt((d**2).sum(axis=1))
    H = np.column_stack([d[:, 0] / r, d[:, 1] / r, np.zeros(len(r))])
    S = H @ P @ H.T + sigma**2 * np.eye(len(r))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "antenna not turned with the robot: a added as it is in the world",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    d = x[:2] + a - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.zeros((len(rs), 3))
    for k in range(len(rs)):
        H[k] = d[k, 0] / r[k], d[k, 1] / r[k], (d[k, 1] * a[0] - d[k, 0] * a[1]) / r[k]
    S = H @ P @ H.T + np.eye(len(rs)) * sigma**2
    K = np.linalg.solve(S, H @ P).T
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "takes the ranges one after the other, with a new H at the pose corrected so far",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    for r, b in zip(rs, beacons):
        c, s = np.cos(x[2]), np.sin(x[2])
        arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
        d = x[:2] + arm - b
        far = np.hypot(*d)
        H = np.array([d[0], d[1], d[1] * arm[0] - d[0] * arm[1]]) / far
        s2 = H @ P @ H + sigma**2
        K = P @ H / s2
        x, P = x + K * (r - far), P - s2 * np.outer(K, K)
    return x, P
""",
    ),
    (
        "05-ranges",
        "sigma put into S without its square",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    e = np.array([np.cos(x[2]), np.sin(x[2])])
    n = np.array([-e[1], e[0]])
    d = x[:2] + a[0] * e + a[1] * n - beacons
    r = np.hypot(d[:, 0], d[:, 1])
    H = np.c_[d, d @ (a[0] * n - a[1] * e)] / r[:, None]
    S = H @ P @ H.T + np.diag(np.full(len(rs), sigma))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-lost",
        "just the ordinary localise: any heading and false sights are not dealt with",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    return localise(x, P, drives, ids, zs, landmarks, C, R)
""",
    ),
    (
        "05-lost",
        "gates sights but starts from the told heading and lets P of 1.8 rad be linearised",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, j, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if j >= 0:
            v = z - h(x, landmarks[j])
            v[1] = wrap(v[1])
            H = H_robot(x, landmarks[j])
            if v @ np.linalg.inv(H @ P @ H.T + R) @ v < 5.99:
                x, P = locate(x, P, z, landmarks[j], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-lost",
        "heading from the first sight alone (which may be false), no gate afterwards",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    k = int(np.argmax(ids >= 0))
    turned = drives[:k + 1, 1].sum()
    to = landmarks[ids[k]] - x[:2]
    x, P = x.copy(), P.copy()
    x[2] = wrap(np.arctan2(to[1], to[0]) - zs[k, 1] - turned)
    P[2, :2] = P[:2, 2] = 0
    P[2, 2] = 0.3**2
    return localise(x, P, drives, ids, zs, landmarks, C, R)
""",
    ),
    (
        "05-lost",
        "tries 36 headings and keeps the one that fits best by squared errors, but all false sights are taken in",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    best, cost = None, np.inf
    for heading in np.linspace(0, 2 * np.pi, 36, endpoint=False):
        start, P0 = np.array([x[0], x[1], heading]), P.copy()
        P0[2, :] = P0[:, 2] = 0
        P0[2, 2] = 0.2**2
        xs, Ps = localise(start, P0, drives, ids, zs, landmarks, C, R)
        c = 0.0
        for a, j, z in zip(xs, ids, zs):
            if j >= 0:
                v = z - h(a, landmarks[j])
                v[1] = wrap(v[1])
                c += v @ np.linalg.solve(R, v)
        if c < cost:
            best, cost = (xs, Ps), c
    return best
""",
    ),
    (
        "05-locate",
        "P with the R-less half of Joseph's form: (I - KH) P (I - KH)'",
        """
def locate(x, P, z, p, R):
    e = h(x, p)
    H = H_robot(x, p)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    left = np.eye(3) - K @ H
    return x + K @ np.array([z[0] - e[0], wrap(z[1] - e[1])]), left @ P @ left.T
""",
    ),
    (
        "05-map",
        "gives an entry to every id up to the largest, also to those never seen, and fails when nothing was seen",
        """
def build_map(xs, ids, zs, R):
    table = {j: None for j in range(max(ids) + 1)}
    for x, j, z in zip(xs, ids, zs):
        if table[j] is None:
            J = J_z(x, z)
            table[j] = (g(x, z), J @ R @ J.T)
        else:
            table[j] = update_landmark(table[j][0], table[j][1], x, z, R)
    return table
""",
    ),
    (
        "05-ranges",
        "fails when no beacon is heard (H of an empty list has no columns)",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    H, v = [], []
    for r, b in zip(rs, beacons):
        d = x[:2] + arm - b
        far = np.hypot(d[0], d[1])
        H.append([d[0] / far, d[1] / far, (-d[0] * arm[1] + d[1] * arm[0]) / far])
        v.append(r - far)
    H, v = np.array(H), np.array(v)
    S = H @ P @ H.T + sigma**2 * np.eye(len(v))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
]
