"""Independent answers to 05-map: right ones, and students' mistakes."""

RIGHT = [
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
]

WRONG = [
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
]
