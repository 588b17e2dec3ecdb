"""A fourth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "05-locate",
        "information form",
        """
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    v = z - h(x, p)
    v[1] = np.arctan2(np.sin(v[1]), np.cos(v[1]))
    Pn = np.linalg.inv(np.linalg.inv(P) + H.T @ np.linalg.solve(R, H))
    return x + Pn @ H.T @ np.linalg.solve(R, v), Pn
""",
    ),
    (
        "05-ranges",
        "one range after the other, all Jacobians at the first pose",
        """
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
""",
    ),
]

WRONG = [
    (
        "05-locate",
        "both components wrapped",
        """
def locate(x, P, z, p, R):
    H, v = H_robot(x, p), wrap(z - h(x, p))
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "H of the landmark",
        """
def locate(x, P, z, p, R):
    H = np.hstack([H_landmark(x, p), [[0], [-1]]])
    v = z - h(x, p)
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "expected minus measured",
        """
def locate(x, P, z, p, R):
    H, v = H_robot(x, p), h(x, p) - z
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-locate",
        "a gate that the text does not ask for",
        """
def locate(x, P, z, p, R):
    H, v = H_robot(x, p), z - h(x, p)
    v[1] = wrap(v[1])
    S = H @ P @ H.T + R
    if v @ np.linalg.inv(S) @ v > 9.21:
        return x, P
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "05-localise",
        "id 0 is taken for nothing",
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
        "looks with the last landmark where nothing was seen",
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
        "keeps beliefs only of steps with a sight",
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
        "05-map",
        "a list by id",
        """
def build_map(xs, ids, zs, R):
    marks = [None] * (max(ids) + 1)
    for x, i, z in zip(xs, ids, zs):
        if marks[i] is None:
            J = J_z(x, z)
            marks[i] = (g(x, z), J @ R @ J.T)
        else:
            marks[i] = update_landmark(*marks[i], x, z, R)
    return {i: m for i, m in enumerate(marks)}
""",
    ),
    (
        "05-map",
        "R itself for a new landmark",
        """
def build_map(xs, ids, zs, R):
    found = {}
    for x, i, z in zip(xs, ids, zs):
        i = int(i)
        found[i] = update_landmark(*found[i], x, z, R) if i in found else (g(x, z), R)
    return found
""",
    ),
    (
        "05-map",
        "mean of all places",
        """
def build_map(xs, ids, zs, R):
    found = {}
    for i in set(ids.tolist()):
        at = np.array([g(x, z) for x, k, z in zip(xs, ids, zs) if k == i])
        found[i] = (at.mean(axis=0), np.cov(at.T))
    return found
""",
    ),
    (
        "05-ranges",
        "the arm is not turned",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    d = x[:2] + a - beacons
    n = np.linalg.norm(d, axis=1)
    H = np.column_stack([d / n[:, None], (d[:, 1] * a[0] - d[:, 0] * a[1]) / n])
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - n), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "sigma in place of its square",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([[c, -s], [s, c]]) @ a
    d = x[:2] + arm - beacons
    n = np.linalg.norm(d, axis=1)
    H = np.column_stack([d / n[:, None], (d[:, 1] * arm[0] - d[:, 0] * arm[1]) / n])
    S = H @ P @ H.T + sigma * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - n), P - K @ S @ K.T
""",
    ),
    (
        "05-lost",
        "localise called with a heading from the first sight",
        """
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    k = int(np.flatnonzero(ids >= 0)[0])
    d = landmarks[ids[k]] - x[:2]
    x = np.array([x[0], x[1], np.arctan2(d[1], d[0]) - zs[k][1]])
    return localise(x, P, drives, ids, zs, landmarks, C, R)
""",
    ),
]
