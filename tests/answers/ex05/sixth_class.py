"""A sixth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "05-locate",
        "least squares with whitened rows",
        """
def locate(x, P, z, p, R):
    off = z - h(x, p)
    off[1] = wrap(off[1])
    prior = np.linalg.inv(np.linalg.cholesky(P))
    sight = np.linalg.inv(np.linalg.cholesky(R))
    A = np.vstack([prior, sight @ H_robot(x, p)])
    b = np.concatenate([np.zeros(3), sight @ off])
    dx = np.linalg.lstsq(A, b, rcond=None)[0]
    return x + dx, np.linalg.inv(A.T @ A)
""",
    ),
    (
        "05-ranges",
        "one range after the other, all linearised at the start",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    start, c, s = x, np.cos(x[2]), np.sin(x[2])
    antenna = x[:2] + np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    swing = np.array([-s * a[0] - c * a[1], c * a[0] - s * a[1]])
    for r, b in zip(rs, beacons):
        away = antenna - b
        expected = np.sqrt(away @ away)
        H = np.append(away, away @ swing) / expected
        v = r - expected - H @ (x - start)
        S = H @ P @ H + sigma**2
        K = P @ H / S
        x, P = x + K * v, P - np.outer(K, K) * S
    return x.copy(), P.copy()
""",
    ),
    (
        "05-lost",
        "a filter for each of 48 headings, and the one that gates least",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    best = None
    for heading in np.linspace(-np.pi, np.pi, 48, endpoint=False):
        y, Q = np.array([x[0], x[1], heading]), P.copy()
        Q[2, :] = Q[:, 2] = 0
        Q[2, 2] = 0.15**2
        xs, Ps, score = [], [], 0.0
        for u, i, z in zip(drives, ids, zs):
            y, Q = predict(y, Q, u, C)
            if i >= 0:
                H = H_robot(y, landmarks[i])
                v = z - h(y, landmarks[i])
                v[1] = wrap(v[1])
                S = H @ Q @ H.T + R
                d2 = v @ np.linalg.solve(S, v)
                score += min(d2 + np.log(np.linalg.det(S)), 9.2)
                if d2 < 9.2:
                    y, Q = locate(y, Q, z, landmarks[i], R)
            xs.append(y)
            Ps.append(Q)
        if best is None or score < best[0]:
            best = score, np.array(xs), np.array(Ps)
    return best[1], best[2]
""",
    ),
]

WRONG = [
    (
        "05-locate",
        "iterated: linearised anew at the corrected pose, three times",
        """
def locate(x, P, z, p, R):
    y = x.copy()
    for _ in range(3):
        H = H_robot(y, p)
        v = z - h(y, p)
        v[1] = wrap(v[1])
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        y = x + K @ (v - H @ (x - y))
    return y, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "the sight is turned into a place in the world, and the pose moved by what that is off",
        """
def locate(x, P, z, p, R):
    place = g(x, z)
    J = J_z(x, z)
    a = x[2] + z[1]
    H = np.array([[1, 0, -z[0] * np.sin(a)], [0, 1, z[0] * np.cos(a)]])
    S = H @ P @ H.T + J @ R @ J.T
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (p - place), P - K @ S @ K.T
""",
    ),
    (
        "05-localise",
        "continue before the belief is stored where nothing was seen",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    n = len(drives)
    xs, Ps = np.zeros((n, 3)), np.zeros((n, 3, 3))
    for k in range(n):
        x, P = predict(x, P, drives[k], C)
        if ids[k] == -1:
            continue
        x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
        xs[k], Ps[k] = x, P
    return xs, Ps
""",
    ),
    (
        "05-map",
        "a new landmark is placed, and then corrected by the same sight",
        """
def build_map(xs, ids, zs, R):
    found = {}
    for x, i, z in zip(xs, ids, zs):
        if i not in found:
            J = J_z(x, z)
            found[i] = g(x, z), J @ R @ J.T
        p, P = found[i]
        found[i] = update_landmark(p, P, x, z, R)
    return found
""",
    ),
    (
        "05-map",
        "the mean of all places where it was seen",
        """
def build_map(xs, ids, zs, R):
    found = {}
    for i in set(ids.tolist()):
        rows = np.flatnonzero(ids == i)
        places = np.array([g(xs[k], zs[k]) for k in rows])
        Ps = np.array([J_z(xs[k], zs[k]) @ R @ J_z(xs[k], zs[k]).T for k in rows])
        found[i] = places.mean(axis=0), Ps.mean(axis=0) / len(rows)
    return found
""",
    ),
    (
        "05-ranges",
        "one after the other, and every innovation from the pose before the first",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    Rot = np.array([[c, -s], [s, c]])
    antenna = x[:2] + Rot @ a
    new = x.copy()
    for r, b in zip(rs, beacons):
        d = antenna - b
        n = np.linalg.norm(d)
        H = np.array([[d[0] / n, d[1] / n, d @ (Rot @ [-a[1], a[0]]) / n]])
        S = H @ P @ H.T + sigma**2
        K = P @ H.T / S
        new = new + K[:, 0] * (r - n)
        P = P - K @ S @ K.T
    return new, P
""",
    ),
    (
        "05-ranges",
        "a beacon that is heard twice counts once",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    beacons, first = np.unique(beacons, axis=0, return_index=True)
    rs = rs[first]
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([[c, -s], [s, c]]) @ a
    d = x[:2] + arm - beacons
    n = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d[:, 1] * arm[0] - d[:, 0] * arm[1]]) / n[:, None]
    S = H @ P @ H.T + sigma**2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - n), P - K @ S @ K.T
""",
    ),
    (
        "05-lost",
        "the heading from the first sight, then a gate",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps, known = [], [], False
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            p = landmarks[i]
            if not known:
                d = p - x[:2]
                x = np.array([x[0], x[1], wrap(np.arctan2(d[1], d[0]) - z[1])])
                P = np.diag([P[0, 0], P[1, 1], 0.1**2])
                known = True
            H, v = H_robot(x, p), z - h(x, p)
            v[1] = wrap(v[1])
            if v @ np.linalg.inv(H @ P @ H.T + R) @ v < 9.21:
                x, P = locate(x, P, z, p, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
]
