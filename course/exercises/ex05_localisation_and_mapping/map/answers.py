# %% way: by landmark, not by time
def build_map(xs, ids, zs, R):
    beliefs = {}
    for id in set(ids.tolist()):
        first, *later = np.flatnonzero(ids == id)
        J = J_z(xs[first], zs[first])
        belief = g(xs[first], zs[first]), J @ R @ J.T
        for k in later:
            belief = update_landmark(*belief, xs[k], zs[k], R)
        beliefs[id] = belief
    return beliefs

# %% way: from vague beginnings
def build_map(xs, ids, zs, R):
    beliefs = {}
    for x, id, z in zip(xs, ids, zs):
        if id not in beliefs:
            beliefs[id] = g(x, z), 1e4 * np.eye(2)
        beliefs[id] = update_landmark(*beliefs[id], x, z, R)
    return beliefs

# %% way: positions fused
def build_map(xs, ids, zs, R):
    beliefs = {}
    for k in range(len(ids)):
        id = int(ids[k])
        J = J_z(xs[k], zs[k])
        p, P = g(xs[k], zs[k]), J @ R @ J.T
        if id in beliefs:
            q, Q = beliefs[id]
            both = np.linalg.inv(np.linalg.inv(P) + np.linalg.inv(Q))
            p, P = both @ (np.linalg.solve(P, p) + np.linalg.solve(Q, q)), both
        beliefs[id] = [p.tolist(), P.tolist()]
    return beliefs

# %% way: gains
def build_map(xs, ids, zs, R):
    from collections import defaultdict
    beliefs = defaultdict(lambda: None)
    for x, id, z in zip(xs, ids, zs):
        if beliefs[id] is None:
            Hi = np.linalg.inv(H_landmark(x, g(x, z)))
            beliefs[id] = g(x, z), Hi @ R @ Hi.T
            continue
        p, P = beliefs[id]
        v = z - h(x, p)
        v[1] = (v[1] + np.pi) % (2 * np.pi) - np.pi
        H = H_landmark(x, p)
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
        beliefs[id] = p + K @ v, (np.eye(2) - K @ H) @ P
    return dict(beliefs)

# %% way: all measurements of a landmark at once
def build_map(xs, ids, zs, R):
    beliefs = {}
    for id in np.unique(ids):
        rows = np.flatnonzero(ids == id)
        p = np.mean([g(xs[k], zs[k]) for k in rows], axis=0)
        for _ in range(3):
            Y, y = np.zeros((2, 2)), np.zeros(2)
            for k in rows:
                H, v = H_landmark(xs[k], p), zs[k] - h(xs[k], p)
                v[1] = wrap(v[1])
                Y, y = Y + H.T @ np.linalg.inv(R) @ H, y + H.T @ np.linalg.inv(R) @ v
            p = p + np.linalg.solve(Y, y)
        beliefs[id] = p, np.linalg.inv(Y)
    return beliefs

# %% right: classes and setdefault
class Mark:
    def __init__(self, x, z, R):
        J = J_z(x, z)
        self.p, self.P = g(x, z), J @ R @ J.T
    def again(self, x, z, R):
        self.p, self.P = update_landmark(self.p, self.P, x, z, R)
def build_map(xs, ids, zs, R):
    marks = {}
    for k in range(len(ids)):
        if ids[k] in marks:
            marks[ids[k]].again(xs[k], zs[k], R)
        else:
            marks[ids[k]] = Mark(xs[k], zs[k], R)
    return {int(i): (m.p, m.P) for i, m in marks.items()}

# %% right: landmark by landmark
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

# %% right: index loop, Jacobian by hand
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

# %% right: all sights of a landmark fused by their information
def build_map(xs, ids, zs, R):
    sums = {}
    for x, i, z in zip(xs, ids, zs):
        J = J_z(x, z)
        W = np.linalg.inv(J @ R @ J.T)
        L, b = sums.get(int(i), (np.zeros((2, 2)), np.zeros(2)))
        sums[int(i)] = L + W, b + W @ g(x, z)
    return {i: (np.linalg.solve(L, b), np.linalg.inv(L)) for i, (L, b) in sums.items()}

# %% wrong: a list by id
def build_map(xs, ids, zs, R):
    marks = [None] * (max(ids) + 1)
    for x, i, z in zip(xs, ids, zs):
        if marks[i] is None:
            J = J_z(x, z)
            marks[i] = (g(x, z), J @ R @ J.T)
        else:
            marks[i] = update_landmark(*marks[i], x, z, R)
    return {i: m for i, m in enumerate(marks)}

# %% wrong: mean of all places
def build_map(xs, ids, zs, R):
    found = {}
    for i in set(ids.tolist()):
        at = np.array([g(x, z) for x, k, z in zip(xs, ids, zs) if k == i])
        found[i] = (at.mean(axis=0), np.cov(at.T))
    return found

# %% wrong: starts with a vague belief, a huge covariance at the origin
def build_map(xs, ids, zs, R):
    m = {}
    for x, i, z in zip(xs, ids, zs):
        p, P = m.get(i, (np.array([0.1, 0.1]), 1e6 * np.eye(2)))
        m[i] = update_landmark(p, P, x, z, R)
    return m

# %% wrong: landmark 0 is nothing seen
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

# %% wrong: sets of values: the mean of all placed points and R / n
def build_map(xs, ids, zs, R):
    points = {}
    for x, i, z in zip(xs, ids, zs):
        J = J_z(x, z)
        points.setdefault(i, []).append((g(x, z), J @ R @ J.T))
    return {i: (np.mean([p for p, _ in l], axis=0), np.mean([P for _, P in l], axis=0) / len(l))
            for i, l in points.items()}

# %% wrong: in the robot's frame: heading left out
def build_map(xs, ids, zs, R):
    m = {}
    for x, i, z in zip(xs, ids, zs):
        if i in m:
            m[i] = update_landmark(*m[i], x, z, R)
        else:
            J = J_z(np.zeros(3), z)
            m[i] = x[:2] + z[0] * np.array([np.cos(z[1]), np.sin(z[1])]), J @ R @ J.T
    return m

# %% wrong: returns lists instead of a dict
def build_map(xs, ids, zs, R):
    m = {}
    for x, i, z in zip(xs, ids, zs):
        if i in m:
            m[i] = update_landmark(*m[i], x, z, R)
        else:
            J = J_z(x, z)
            m[i] = g(x, z), J @ R @ J.T
    return list(m.values())
