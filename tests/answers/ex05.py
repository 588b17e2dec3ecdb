"""Independent answers to exercise 05: right ones, and students' mistakes."""

RIGHT = [
    (
        "05-locate",
        "information form",
        """
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    W = np.linalg.inv(R)
    P_new = np.linalg.inv(np.linalg.inv(P) + H.T @ W @ H)
    dr, db = z - h(x, p)
    v = np.array([dr, wrap(db)])
    return x + P_new @ H.T @ W @ v, P_new
""",
    ),
    (
        "05-locate",
        "Joseph's form, solve, Jacobian by hand",
        """
def locate(x, P, z, p, R):
    dx, dy = p[0] - x[0], p[1] - x[1]
    q = dx ** 2 + dy ** 2
    r = q ** 0.5
    H = np.array([[-dx / r, -dy / r, 0.0], [dy / q, -dx / q, -1.0]])
    beta = np.arctan2(dy, dx) - x[2]
    db = (z[1] - beta + np.pi) % (2 * np.pi) - np.pi
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    I_KH = np.eye(3) - K @ H
    return x + K @ np.array([z[0] - r, db]), I_KH @ P @ I_KH.T + K @ R @ K.T
""",
    ),
    (
        "05-locate",
        "(I - KH) P, heading wrapped at the end",
        """
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    v = z - h(x, p)
    v[1] = np.arctan2(np.sin(v[1]), np.cos(v[1]))
    new = x + K @ v
    new[2] = wrap(new[2])
    return new, (np.eye(3) - K @ H) @ P
""",
    ),
    (
        "05-localise",
        "index loop into arrays",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    n = len(drives)
    xs, Ps = np.zeros((n, 3)), np.zeros((n, 3, 3))
    for k in range(n):
        x, P = predict(x, P, drives[k], C)
        if ids[k] != -1:
            x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
        xs[k], Ps[k] = x, P
    return xs, Ps
""",
    ),
    (
        "05-localise",
        "a generator of beliefs",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    def beliefs(x, P):
        for k, i in enumerate(ids):
            x, P = predict(x, P, drives[k], C)
            yield (x, P) if i < 0 else locate(x, P, zs[k], landmarks[i], R)
            if i >= 0:
                x, P = locate(x, P, zs[k], landmarks[i], R)

    xs, Ps = zip(*beliefs(x, P))
    return np.stack(xs), np.stack(Ps)
""",
    ),
    (
        "05-map",
        "landmark by landmark",
        """
def build_map(xs, ids, zs, R):
    found = {}
    for i in np.unique(ids):
        rows = np.flatnonzero(ids == i)
        first = rows[0]
        J = J_z(xs[first], zs[first])
        p, P = g(xs[first], zs[first]), J @ R @ J.T
        for k in rows[1:]:
            p, P = update_landmark(p, P, xs[k], zs[k], R)
        found[int(i)] = (p, P)
    return found
""",
    ),
    (
        "05-map",
        "index loop, Jacobian by hand",
        """
def build_map(xs, ids, zs, R):
    m = dict()
    for k in range(len(ids)):
        i = int(ids[k])
        if i not in m:
            r, a = zs[k][0], xs[k][2] + zs[k][1]
            J = np.array([[np.cos(a), -r * np.sin(a)], [np.sin(a), r * np.cos(a)]])
            m[i] = (xs[k][:2] + r * np.array([np.cos(a), np.sin(a)]), J @ R @ J.T)
        else:
            p, P = m[i]
            m[i] = update_landmark(p, P, xs[k], zs[k], R)
    return m
""",
    ),
    (
        "05-ranges",
        "information form, loop over beacons",
        """
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
""",
    ),
    (
        "05-ranges",
        "one range after the other, H and expectation at the given pose",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    t = x[2]
    R = np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])
    dR = np.array([[-np.sin(t), -np.cos(t)], [np.cos(t), -np.sin(t)]])
    antenna = x[:2] + R @ a
    m, S_x = x.copy(), P.copy()
    for r, b in zip(rs, beacons):
        d = antenna - b
        dist = np.sqrt(d @ d)
        H = np.append(d, d @ (dR @ a)) / dist
        expected = dist + H @ (m - x)
        k = S_x @ H / (H @ S_x @ H + sigma ** 2)
        m = m + k * (r - expected)
        S_x = S_x - np.outer(k, H @ S_x)
    return m, S_x
""",
    ),
    (
        "05-lost",
        "a bank of filters, one for each heading, each sight true or false by likelihood",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    M = 36
    headings = np.linspace(-np.pi, np.pi, M, endpoint=False)
    P0 = P.copy()
    P0[2, :] = P0[:, 2] = 0
    P0[2, 2] = 0.1 ** 2
    runs = []
    for heading in headings:
        y, Q, score, xs, Ps = np.array([x[0], x[1], heading]), P0, 0.0, [], []
        for u, i, z in zip(drives, ids, zs):
            y, Q = predict(y, Q, u, C)
            if i >= 0:
                v = z - h(y, landmarks[i])
                v[1] = wrap(v[1])
                H = H_robot(y, landmarks[i])
                S = H @ Q @ H.T + R
                d2 = v @ np.linalg.solve(S, v)
                true = 0.7 * np.exp(-d2 / 2) / (2 * np.pi * np.sqrt(np.linalg.det(S)))
                score += np.log(true + 0.3 / (6 * 2 * np.pi))
                if d2 < 9.2:
                    y, Q = locate(y, Q, z, landmarks[i], R)
            xs.append(y)
            Ps.append(Q)
        runs.append((score, np.array(xs), np.array(Ps)))
    best = max(runs, key=lambda r: r[0])
    return best[1], best[2]
""",
    ),
    (
        "05-lost",
        "eight headings only, each its filter with a gate; the one that most sights agree with",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    best, most = None, -1
    for heading in np.arange(8) * np.pi / 4:
        y, Q = np.array([x[0], x[1], heading]), np.diag([P[0, 0], P[1, 1], 0.05 ** 2])
        xs, Ps, agreed = [], [], 0
        for u, i, z in zip(drives, ids, zs):
            y, Q = predict(y, Q, u, C)
            if i >= 0:
                v = z - h(y, landmarks[i])
                v[1] = wrap(v[1])
                H = H_robot(y, landmarks[i])
                if v @ np.linalg.solve(H @ Q @ H.T + R, v) < 9.2:
                    y, Q = locate(y, Q, z, landmarks[i], R)
                    agreed += 1
            xs.append(y)
            Ps.append(Q)
        if agreed > most:
            best, most = (np.array(xs), np.array(Ps)), agreed
    return best
""",
    ),
]

WRONG = [
    (
        "05-locate",
        "bearing not wrapped",
        """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "both of v wrapped, also the range",
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
        "v is expected minus measured",
        """
def locate(x, P, z, p, R):
    v = h(x, p) - z
    v[1] = wrap(v[1])
    H = H_robot(x, p)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    return x + K @ v, (np.eye(3) - K @ H) @ P
""",
    ),
    (
        "05-locate",
        "R is forgotten",
        """
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    dr, db = z - h(x, p)
    S = H @ P @ H.T
    K = P @ H.T @ np.linalg.pinv(S)
    return x + K @ [dr, wrap(db)], P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "only R's diagonal",
        """
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    v = z - h(x, p)
    v[1] = wrap(v[1])
    S = H @ P @ H.T + np.diag(np.diag(R))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "P is not updated",
        """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = H_robot(x, p)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    x = x + K @ v
    return x, P
""",
    ),
    (
        "05-locate",
        "divides by S[0, 0] instead of the inverse",
        """
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T / S[0, 0]
    v = z - h(x, p)
    v[1] = wrap(v[1])
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "elementwise 1 / S",
        """
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ (1 / S)
    v = z - h(x, p)
    v[1] = wrap(v[1])
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "the Jacobian at the new pose for P",
        """
def locate(x, P, z, p, R):
    def gain(at):
        H = H_robot(at, p)
        S = H @ P @ H.T + R
        return P @ H.T @ np.linalg.inv(S), S

    v = z - h(x, p)
    v[1] = wrap(v[1])
    K, S = gain(x)
    x = x + K @ v
    K, S = gain(x)
    return x, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "a gate: a sight that contradicts the belief is thrown away",
        """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    if v @ np.linalg.solve(S, v) > 9.21:
        return x, P
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "x changed in place with +=",
        """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    x += K @ v
    P -= K @ S @ K.T
    return x, P
""",
    ),
    (
        "05-locate",
        "the landmark's Jacobian with a zero column for the heading",
        """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = np.column_stack([H_landmark(x, p), [0, -1]])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "the heading column of H is zero",
        """
def locate(x, P, z, p, R):
    d = p - x[:2]
    r = np.hypot(*d)
    H = np.zeros((2, 3))
    H[0, :2] = -d / r
    H[1, :2] = d[1] / r ** 2, -d[0] / r ** 2
    v = z - h(x, p)
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "wraps once by hand: with pi instead of 2 pi",
        """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    if v[1] > np.pi:
        v[1] -= np.pi
    elif v[1] < -np.pi:
        v[1] += np.pi
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "v[1] wrapped to 0..2pi",
        """
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] %= 2 * np.pi
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-localise",
        "looks first, then drives",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
        x, P = predict(x, P, u, C)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "the start is in the list: n + 1 beliefs",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [x], [P]
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "the start instead of the last",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        xs.append(x)
        Ps.append(P)
        x, P = predict(x, P, u, C)
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "landmark 0 counts as nothing",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i > 0:
            x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "-1 is the last landmark",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for k in range(len(drives)):
        x, P = predict(x, P, drives[k], C)
        x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "nothing seen: asks the id for truth",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i:
            x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "skips steps where nothing is seen",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        if i < 0:
            continue
        x, P = predict(x, P, u, C)
        x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "keeps no belief where nothing is seen",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
            xs.append(x)
            Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "stale P: locate gets the covariance before the drive",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x_new, P_new = predict(x, P, u, C)
        if i >= 0:
            x_new, P_new = locate(x_new, P, z, landmarks[i], R)
        x, P = x_new, P_new
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "the corrected belief is reported, but not driven on from",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        best = (x, P)
        if i >= 0:
            best = locate(x, P, z, landmarks[i], R)
        xs.append(best[0])
        Ps.append(best[1])
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "the predicted belief is reported",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        xs.append(x)
        Ps.append(P)
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "the sights are counted: zs is read as a list of what was seen",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps, seen = [], [], 0
    for u, i in zip(drives, ids):
        x, P = predict(x, P, u, C)
        if i >= 0:
            x, P = locate(x, P, zs[seen], landmarks[i], R)
            seen += 1
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "landmarks by step, not by id",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for k, u in enumerate(drives):
        x, P = predict(x, P, u, C)
        if ids[k] >= 0:
            x, P = locate(x, P, zs[k], landmarks[k % len(landmarks)], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "a standing robot does not predict (and so adds no noise of the turn)",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        if u[0] > 0:
            x, P = predict(x, P, u, C)
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "a zero sight is nothing: looks at zs instead of ids",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if np.any(z != 0):
            x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "only the last belief",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
    return x, P
""",
    ),
    (
        "05-map",
        "a new landmark's covariance is R",
        """
def build_map(xs, ids, zs, R):
    m = {}
    for x, i, z in zip(xs, ids, zs):
        m[i] = update_landmark(*m[i], x, z, R) if i in m else (g(x, z), R)
    return m
""",
    ),
    (
        "05-map",
        "each sight places the landmark anew",
        """
def build_map(xs, ids, zs, R):
    m = {}
    for x, i, z in zip(xs, ids, zs):
        J = J_z(x, z)
        m[i] = g(x, z), J @ R @ J.T
    return m
""",
    ),
    (
        "05-map",
        "only the first sight counts",
        """
def build_map(xs, ids, zs, R):
    m = {}
    for x, i, z in zip(xs, ids, zs):
        if i not in m:
            J = J_z(x, z)
            m[i] = g(x, z), J @ R @ J.T
    return m
""",
    ),
    (
        "05-map",
        "J' R J",
        """
def build_map(xs, ids, zs, R):
    m = {}
    for k, i in enumerate(ids):
        if i in m:
            m[i] = update_landmark(*m[i], xs[k], zs[k], R)
        else:
            J = J_z(xs[k], zs[k])
            m[i] = (g(xs[k], zs[k]), J.T @ R @ J)
    return m
""",
    ),
    (
        "05-map",
        "placed, and at once updated with the same sight",
        """
def build_map(xs, ids, zs, R):
    m = {}
    for x, i, z in zip(xs, ids, zs):
        if i not in m:
            J = J_z(x, z)
            m[i] = (g(x, z), J @ R @ J.T)
        m[i] = update_landmark(*m[i], x, z, R)
    return m
""",
    ),
    (
        "05-map",
        "starts with a vague belief, a huge covariance at the origin",
        """
def build_map(xs, ids, zs, R):
    m = {}
    for x, i, z in zip(xs, ids, zs):
        p, P = m.get(i, (np.array([0.1, 0.1]), 1e6 * np.eye(2)))
        m[i] = update_landmark(p, P, x, z, R)
    return m
""",
    ),
    (
        "05-map",
        "R turned to the line of sight, but the bearing's error not times the range",
        """
def build_map(xs, ids, zs, R):
    m = {}
    for x, i, z in zip(xs, ids, zs):
        if i in m:
            m[i] = update_landmark(*m[i], x, z, R)
        else:
            a = x[2] + z[1]
            T = np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])
            m[i] = g(x, z), T @ R @ T.T
    return m
""",
    ),
    (
        "05-map",
        "a list for as many landmarks as the largest id: others in it as well",
        """
def build_map(xs, ids, zs, R):
    N = max(ids) + 1 if len(ids) else 0
    m = {i: (np.zeros(2), np.zeros((2, 2))) for i in range(N)}
    new = [True] * N
    for x, i, z in zip(xs, ids, zs):
        if new[i]:
            J = J_z(x, z)
            m[i] = (g(x, z), J @ R @ J.T)
            new[i] = False
        else:
            m[i] = update_landmark(*m[i], x, z, R)
    return m
""",
    ),
    (
        "05-map",
        "landmark 0 is nothing seen",
        """
def build_map(xs, ids, zs, R):
    m = {}
    for x, i, z in zip(xs, ids, zs):
        if i <= 0:
            continue
        if i in m:
            m[i] = update_landmark(m[i][0], m[i][1], x, z, R)
        else:
            J = J_z(x, z)
            m[i] = g(x, z), J @ R @ J.T
    return m
""",
    ),
    (
        "05-map",
        "sets of values: the mean of all placed points and R / n",
        """
def build_map(xs, ids, zs, R):
    points = {}
    for x, i, z in zip(xs, ids, zs):
        J = J_z(x, z)
        points.setdefault(i, []).append((g(x, z), J @ R @ J.T))
    return {i: (np.mean([p for p, _ in l], axis=0), np.mean([P for _, P in l], axis=0) / len(l))
            for i, l in points.items()}
""",
    ),
    (
        "05-map",
        "in the robot's frame: heading left out",
        """
def build_map(xs, ids, zs, R):
    m = {}
    for x, i, z in zip(xs, ids, zs):
        if i in m:
            m[i] = update_landmark(*m[i], x, z, R)
        else:
            J = J_z(np.zeros(3), z)
            m[i] = x[:2] + z[0] * np.array([np.cos(z[1]), np.sin(z[1])]), J @ R @ J.T
    return m
""",
    ),
    (
        "05-map",
        "the covariance by J_z without the heading",
        """
def build_map(xs, ids, zs, R):
    m = {}
    for x, i, z in zip(xs, ids, zs):
        if i in m:
            m[i] = update_landmark(*m[i], x, z, R)
        else:
            J = J_z(np.zeros(3), z)
            m[i] = g(x, z), J @ R @ J.T
    return m
""",
    ),
    (
        "05-map",
        "one belief for all landmarks: compares with the last id only",
        """
def build_map(xs, ids, zs, R):
    m, last = {}, None
    for x, i, z in zip(xs, ids, zs):
        if i == last:
            m[i] = update_landmark(*m[i], x, z, R)
        else:
            J = J_z(x, z)
            m[i] = g(x, z), J @ R @ J.T
        last = i
    return m
""",
    ),
    (
        "05-map",
        "covariances weighed right, but of linear sights: fused points",
        """
def build_map(xs, ids, zs, R):
    info = {}
    for x, i, z in zip(xs, ids, zs):
        J = J_z(x, z)
        A = np.linalg.inv(J @ R @ J.T)
        S, s = info.get(i, (np.zeros((2, 2)), np.zeros(2)))
        info[i] = (S + A, s + g(x, z))
    return {i: (s / len(info), np.linalg.inv(S)) for i, (S, s) in info.items()}
""",
    ),
    (
        "05-map",
        "returns lists instead of a dict",
        """
def build_map(xs, ids, zs, R):
    m = {}
    for x, i, z in zip(xs, ids, zs):
        if i in m:
            m[i] = update_landmark(*m[i], x, z, R)
        else:
            J = J_z(x, z)
            m[i] = g(x, z), J @ R @ J.T
    return list(m.values())
""",
    ),
    (
        "05-map",
        "only p of the update is kept",
        """
def build_map(xs, ids, zs, R):
    m = {}
    for x, i, z in zip(xs, ids, zs):
        if i in m:
            p, P = m[i]
            p, _ = update_landmark(p, P, x, z, R)
            m[i] = (p, P)
        else:
            J = J_z(x, z)
            m[i] = g(x, z), J @ R @ J.T
    return m
""",
    ),
    (
        "05-ranges",
        "the antenna sits on the axle",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    d = x[:2] - beacons
    r = np.hypot(d[:, 0], d[:, 1])
    H = np.column_stack([d[:, 0] / r, d[:, 1] / r, np.zeros(len(r))])
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(r))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "the antenna is expected rightly, but the heading column is zero",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    at = x[:2] + np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = at - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.zeros((len(rs), 3))
    H[:, :2] = d / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "the arm is not turned with the robot",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    d = x[:2] + a - beacons
    r = np.linalg.norm(d, axis=1)
    swing = np.array([-a[1], a[0]])
    H = np.column_stack([d, d @ swing]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "the arm is turned the wrong way",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = a @ np.array([[c, -s], [s, c]])
    d = x[:2] + arm - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "sigma instead of sigma squared",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = x[:2] + arm - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "one after the other, H anew at each new pose",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    for z, b in zip(rs, beacons):
        c, s = np.cos(x[2]), np.sin(x[2])
        arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
        d = x[:2] + arm - b
        r = np.hypot(*d)
        H = np.array([[d[0], d[1], d @ [-arm[1], arm[0]]]]) / r
        S = H @ P @ H.T + sigma ** 2
        K = P @ H.T / S
        x = x + K[:, 0] * (z - r)
        P = P - K @ S @ K.T
    return x, P
""",
    ),
    (
        "05-ranges",
        "sign of the swing",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = x[:2] + arm - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d @ [arm[1], -arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "the heading column from the unturned arm",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    d = x[:2] + np.array([[c, -s], [s, c]]) @ a - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.empty((len(rs), 3))
    for i in range(len(rs)):
        H[i] = d[i, 0] / r[i], d[i, 1] / r[i], (-a[1] * d[i, 0] + a[0] * d[i, 1]) / r[i]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "the sign of d: from antenna to beacon, without the minus",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = beacons - x[:2] - arm
    r = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "for exactly three beacons",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    H, e = np.zeros((3, 3)), np.zeros(3)
    for i in range(min(3, len(rs))):
        d = x[:2] + arm - beacons[i]
        r = np.hypot(*d)
        H[i] = d[0] / r, d[1] / r, d @ [-arm[1], arm[0]] / r
        e[i] = rs[i] - r
    S = H @ P @ H.T + sigma ** 2 * np.eye(3)
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ e, P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "a beacon that is heard twice counts once",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    _, first = np.unique(beacons, axis=0, return_index=True)
    rs, beacons = rs[first], beacons[first]
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = x[:2] + arm - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "distances below half a metre are set to half a metre, against division by zero",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = x[:2] + arm - beacons
    r = np.maximum(np.linalg.norm(d, axis=1), 0.5)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "H by the pose's distance, expectation by the antenna's",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    expected = np.linalg.norm(x[:2] + arm - beacons, axis=1)
    d = x[:2] - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - expected), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "S without the matrix: sigma^2 added everywhere",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = x[:2] + arm - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2
    K = P @ H.T @ np.linalg.pinv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "fails when nothing is heard",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    rows, v = [], []
    for r, b in zip(rs, beacons):
        d = x[:2] + arm - b
        e = np.hypot(*d)
        rows.append([d[0] / e, d[1] / e, (arm[0] * d[1] - arm[1] * d[0]) / e])
        v.append(r - e)
    H = np.vstack(rows)
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(v))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ np.array(v), P - K @ S @ K.T
""",
    ),
    (
        "05-lost",
        "localise as it is",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    return localise(x, P, drives, ids, zs, landmarks, C, R)
""",
    ),
    (
        "05-lost",
        "a gate, but the heading as given",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            v = z - h(x, landmarks[i])
            v[1] = wrap(v[1])
            H = H_robot(x, landmarks[i])
            if v @ np.linalg.solve(H @ P @ H.T + R, v) < 9.2:
                x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-lost",
        "the heading from the first sight, which may be false",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    k = int(np.argmax(ids >= 0))
    y = x.copy()
    for u in drives[:k + 1]:
        y = f_odometry(y, u)
    x = x.copy()
    x[2] += h(y, landmarks[ids[k]])[1] - zs[k][1]
    P = P.copy()
    P[2, :] = P[:, 2] = 0
    P[2, 2] = 0.15 ** 2
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            v = z - h(x, landmarks[i])
            v[1] = wrap(v[1])
            H = H_robot(x, landmarks[i])
            if v @ np.linalg.solve(H @ P @ H.T + R, v) < 9.2:
                x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-lost",
        "many headings, but squared errors without a limit, no gate",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    best = None
    for heading in np.linspace(-np.pi, np.pi, 36, endpoint=False):
        y = np.array([x[0], x[1], heading])
        cost = 0
        for u, i, z in zip(drives[:20], ids, zs):
            y = f_odometry(y, u)
            if i >= 0:
                v = z - h(y, landmarks[i])
                cost += v[0] ** 2 + wrap(v[1]) ** 2
        if best is None or cost < best[0]:
            best = (cost, heading)
    P = P.copy()
    P[2, 2] = 0.2 ** 2
    return localise(np.array([x[0], x[1], best[1]]), P, drives, ids, zs, landmarks, C, R)
""",
    ),
    (
        "05-lost",
        "finds the heading robustly, but believes every sight",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    headings = np.linspace(-np.pi, np.pi, 72, endpoint=False)
    votes = np.zeros(72)
    for n, heading in enumerate(headings):
        y = np.array([x[0], x[1], heading])
        for u, i, z in zip(drives[:20], ids, zs):
            y = f_odometry(y, u)
            if i >= 0:
                v = z - h(y, landmarks[i])
                votes[n] += abs(v[0]) < 0.7 and abs(wrap(v[1])) < 0.25
    P = P * [[1, 1, 0], [1, 1, 0], [0, 0, 0]] + np.diag([0, 0, 0.15 ** 2])
    start = np.array([x[0], x[1], headings[np.argmax(votes)]])
    return localise(start, P, drives, ids, zs, landmarks, C, R)
""",
    ),
    (
        "05-lost",
        "the wheels alone",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u in drives:
        x, P = predict(x, P, u, C)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-lost",
        "inflates R tenfold so that lies weigh less",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    return localise(x, P, drives, ids, zs, landmarks, C, 10 * R)
""",
    ),
    (
        "05-lost",
        "heading and gate right, but P shrunk to look sure",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    headings = np.linspace(-np.pi, np.pi, 72, endpoint=False)
    poses = np.column_stack([np.tile(x[:2], (72, 1)), headings])
    cost = np.zeros(72)
    for u, i, z in list(zip(drives, ids, zs))[:20]:
        poses = f_odometry(poses.T, u).T
        if i >= 0:
            v = z - h(poses, landmarks[i])
            cost += np.minimum((v[:, 0] / 0.4) ** 2 + (wrap(v[:, 1]) / 0.15) ** 2, 9)
    x = np.array([x[0], x[1], headings[np.argmin(cost)]])
    P = np.diag([P[0, 0], P[1, 1], 0.12 ** 2])
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            v = z - h(x, landmarks[i])
            v[1] = wrap(v[1])
            H = H_robot(x, landmarks[i])
            if v @ np.linalg.solve(H @ P @ H.T + R, v) < 9.2:
                x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(0.1 * P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-lost",
        "good means, but a constant P for all steps",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    headings = np.linspace(-np.pi, np.pi, 72, endpoint=False)
    poses = np.column_stack([np.tile(x[:2], (72, 1)), headings])
    cost = np.zeros(72)
    for u, i, z in list(zip(drives, ids, zs))[:20]:
        poses = f_odometry(poses.T, u).T
        if i >= 0:
            v = z - h(poses, landmarks[i])
            cost += np.minimum((v[:, 0] / 0.4) ** 2 + (wrap(v[:, 1]) / 0.15) ** 2, 9)
    x = np.array([x[0], x[1], headings[np.argmin(cost)]])
    P = np.diag([P[0, 0], P[1, 1], 0.12 ** 2])
    xs = []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            v = z - h(x, landmarks[i])
            v[1] = wrap(v[1])
            H = H_robot(x, landmarks[i])
            if v @ np.linalg.solve(H @ P @ H.T + R, v) < 9.2:
                x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
    return np.array(xs), np.tile(np.diag([0.3, 0.3, 0.3]) ** 2, (len(xs), 1, 1))
""",
    ),
    (
        "05-lost",
        "a gate that closes on everything: fixed at one metre and 0.1 rad, heading given",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            v = z - h(x, landmarks[i])
            if abs(v[0]) < 1 and abs(wrap(v[1])) < 0.1:
                x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-lost",
        "heading by the mean of all sights' angles",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    y, e = x.copy(), []
    y[2] = 0
    for u, i, z in zip(drives, ids, zs):
        y = f_odometry(y, u)
        if i >= 0:
            e.append(np.exp(1j * (h(y, landmarks[i])[1] - z[1])))
    x = np.array([x[0], x[1], np.angle(np.mean(e))])
    P = np.diag([P[0, 0], P[1, 1], 0.3 ** 2])
    return localise(x, P, drives, ids, zs, landmarks, C, R)
""",
    ),
    (
        "05-lost",
        "changes x and P in place, and is right otherwise",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    headings = np.linspace(-np.pi, np.pi, 72, endpoint=False)
    poses = np.column_stack([np.tile(x[:2], (72, 1)), headings])
    cost = np.zeros(72)
    for u, i, z in list(zip(drives, ids, zs))[:20]:
        poses = f_odometry(poses.T, u).T
        if i >= 0:
            v = z - h(poses, landmarks[i])
            cost += np.minimum((v[:, 0] / 0.4) ** 2 + (wrap(v[:, 1]) / 0.15) ** 2, 9)
    x[2] = headings[np.argmin(cost)]
    P[2] = P[:, 2] = 0
    P[2, 2] = 0.12 ** 2
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            v = z - h(x, landmarks[i])
            v[1] = wrap(v[1])
            H = H_robot(x, landmarks[i])
            if v @ np.linalg.solve(H @ P @ H.T + R, v) < 9.2:
                x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-lost",
        "room for forty steps, whatever the run",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    best, most = None, -1
    for heading in np.arange(24) * np.pi / 12:
        y, Q = np.array([x[0], x[1], heading]), np.diag([P[0, 0], P[1, 1], 0.1 ** 2])
        xs, Ps, agreed = np.zeros((40, 3)), np.zeros((40, 3, 3)), 0
        for k in range(40):
            y, Q = predict(y, Q, drives[k], C)
            if ids[k] >= 0:
                v = zs[k] - h(y, landmarks[ids[k]])
                v[1] = wrap(v[1])
                H = H_robot(y, landmarks[ids[k]])
                if v @ np.linalg.solve(H @ Q @ H.T + R, v) < 9.2:
                    y, Q = locate(y, Q, zs[k], landmarks[ids[k]], R)
                    agreed += 1
            xs[k], Ps[k] = y, Q
        if agreed > most:
            best, most = (xs, Ps), agreed
    return best
""",
    ),
]
