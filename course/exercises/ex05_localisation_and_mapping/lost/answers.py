# %% way: a bank of filters for the first steps
def surprise(x, P, z, p, R):
    """NIS of a measurement: χ² with two degrees of freedom."""
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = H_robot(x, p)
    return v @ np.linalg.solve(H @ P @ H.T + R, v)


def gated(x, P, us, ids, zs, landmarks, C, R, gate=11):
    """Beliefs after every step, and the sum of all surprises, each as large as the gate at most."""
    xs, Ps, cost = [], [], 0.0
    for u, id, z in zip(us, ids, zs):
        x, P = predict(x, P, u, C)
        if id >= 0:
            d2 = surprise(x, P, z, landmarks[id], R)
            cost += min(d2, gate)
            if d2 < gate:
                x, P = locate(x, P, z, landmarks[id], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps), cost


def headed(x, P, heading, sigma=0.15):
    """The start's belief with a heading of one's own."""
    P = P.copy()
    P[2], P[:, 2], P[2, 2] = 0, 0, sigma**2
    return np.array([x[0], x[1], heading]), P

def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    def cost(heading):
        return gated(*headed(x, P, heading), us[:14], ids[:14], zs[:14], landmarks, C, R)[2]

    best = min(np.arange(20) * np.pi / 10, key=cost)
    return gated(*headed(x, P, best), us, ids, zs, landmarks, C, R)[:2]

# %% way: the heading of most measurements
def surprise(x, P, z, p, R):
    """NIS of a measurement: χ² with two degrees of freedom."""
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = H_robot(x, p)
    return v @ np.linalg.solve(H @ P @ H.T + R, v)


def gated(x, P, us, ids, zs, landmarks, C, R, gate=11):
    """Beliefs after every step, and the sum of all surprises, each as large as the gate at most."""
    xs, Ps, cost = [], [], 0.0
    for u, id, z in zip(us, ids, zs):
        x, P = predict(x, P, u, C)
        if id >= 0:
            d2 = surprise(x, P, z, landmarks[id], R)
            cost += min(d2, gate)
            if d2 < gate:
                x, P = locate(x, P, z, landmarks[id], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps), cost


def headed(x, P, heading, sigma=0.15):
    """The start's belief with a heading of one's own."""
    P = P.copy()
    P[2], P[:, 2], P[2, 2] = 0, 0, sigma**2
    return np.array([x[0], x[1], heading]), P

def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    turned, place, votes = 0.0, [0j], []
    for u, id, z in list(zip(us, ids, zs))[:24]:
        place.append(place[-1] + u[0] * np.exp(1j * turned))
        turned += u[1]
        if id >= 0:
            # as seen with heading 0 at the start, and where it is: the angle between them
            seen = place[-1] + z[0] * np.exp(1j * (turned + z[1]))
            there = complex(*(landmarks[id] - x[:2]))
            if abs(abs(seen) - abs(there)) < 0.7:
                votes.append(np.angle(there / seen))
    votes = np.array(votes)
    near = np.abs(wrap(votes[:, None] - votes)) < 0.25
    best = near.sum(axis=1).argmax()
    heading = votes[best] + wrap(votes[near[best]] - votes[best]).mean()
    return gated(*headed(x, P, heading), us, ids, zs, landmarks, C, R, 9.5)[:2]

# %% way: the best of many trajectories, position and heading
def surprise(x, P, z, p, R):
    """NIS of a measurement: χ² with two degrees of freedom."""
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = H_robot(x, p)
    return v @ np.linalg.solve(H @ P @ H.T + R, v)


def gated(x, P, us, ids, zs, landmarks, C, R, gate=11):
    """Beliefs after every step, and the sum of all surprises, each as large as the gate at most."""
    xs, Ps, cost = [], [], 0.0
    for u, id, z in zip(us, ids, zs):
        x, P = predict(x, P, u, C)
        if id >= 0:
            d2 = surprise(x, P, z, landmarks[id], R)
            cost += min(d2, gate)
            if d2 < gate:
                x, P = locate(x, P, z, landmarks[id], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps), cost


def headed(x, P, heading, sigma=0.15):
    """The start's belief with a heading of one's own."""
    P = P.copy()
    P[2], P[:, 2], P[2, 2] = 0, 0, sigma**2
    return np.array([x[0], x[1], heading]), P

def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    off = np.array([(i, j) for i in (-0.2, 0, 0.2) for j in (-0.2, 0, 0.2)])
    headings = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    start = np.array([[x[0] + i, x[1] + j, t] for t in headings for i, j in off])
    at, cost = start, 0.0
    for u, id, z in list(zip(us, ids, zs))[:18]:
        at = f_odometry(at.T, u).T
        if id >= 0:
            v = z - h(at, landmarks[id])
            cost = cost + np.minimum((v[:, 0] / 0.3) ** 2 + (wrap(v[:, 1]) / 0.1) ** 2, 8)
    return gated(*headed(x, P, start[np.argmin(cost)][2]), us, ids, zs, landmarks, C, R)[:2]

# %% pasted: the lesson's filter
def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    return localise(x, P, us, ids, zs, landmarks, C, R)

# %% pasted: the lesson's filter with a tenfold R
def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    return localise(x, P, us, ids, zs, landmarks, C, 10 * R)

# %% right: sixteen headings, the one whose observations agree most often within the gate, P of the winner
def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    best = (-1, None, None)
    for heading in np.arange(16) * np.pi / 8:
        y, Q, hits, xs, Ps = np.array([x[0], x[1], heading]), np.diag([P[0, 0], P[1, 1], 0.04]), 0, [], []
        for u, i, z in zip(us, ids, zs):
            y, Q = predict(y, Q, u, C)
            if i >= 0:
                v = z - h(y, landmarks[i])
                v[1] = wrap(v[1])
                H = H_robot(y, landmarks[i])
                if np.all(v**2 < 9 * np.diag(H @ Q @ H.T + R)):
                    hits += 1
                    y, Q = locate(y, Q, z, landmarks[i], R)
            xs.append(y)
            Ps.append(Q)
        if hits > best[0]:
            best = hits, xs, Ps
    return np.array(best[1]), np.array(best[2])

# %% right: a bank of filters, one for each heading, each sight true or false by likelihood
def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    M = 36
    headings = np.linspace(-np.pi, np.pi, M, endpoint=False)
    P0 = P.copy()
    P0[2, :] = P0[:, 2] = 0
    P0[2, 2] = 0.1 ** 2
    runs = []
    for heading in headings:
        y, Q, score, xs, Ps = np.array([x[0], x[1], heading]), P0, 0.0, [], []
        for u, i, z in zip(us, ids, zs):
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

# %% right: 24 headings, each its filter with a gate; the one that most observations agree with
def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    best, most = None, -1
    for heading in np.arange(24) * np.pi / 12:
        y, Q = np.array([x[0], x[1], heading]), np.diag([P[0, 0], P[1, 1], 0.15 ** 2])
        xs, Ps, agreed = [], [], 0
        for u, i, z in zip(us, ids, zs):
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

# %% right: a filter for each of 48 headings, and the one that gates least
def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    best = None
    for heading in np.linspace(-np.pi, np.pi, 48, endpoint=False):
        y, Q = np.array([x[0], x[1], heading]), P.copy()
        Q[2, :] = Q[:, 2] = 0
        Q[2, 2] = 0.15**2
        xs, Ps, score = [], [], 0.0
        for u, i, z in zip(us, ids, zs):
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

# %% wrong: the wheels alone
def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u in us:
        x, P = predict(x, P, u, C)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)

# %% wrong: inflates R tenfold so that lies weigh less
def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    return localise(x, P, us, ids, zs, landmarks, C, 10 * R)

# %% wrong: good means, but P without its correlations
def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    headings = np.linspace(-np.pi, np.pi, 72, endpoint=False)
    poses = np.column_stack([np.tile(x[:2], (72, 1)), headings])
    cost = np.zeros(72)
    for u, i, z in list(zip(us, ids, zs))[:20]:
        poses = f_odometry(poses.T, u).T
        if i >= 0:
            v = z - h(poses, landmarks[i])
            cost += np.minimum((v[:, 0] / 0.4) ** 2 + (wrap(v[:, 1]) / 0.15) ** 2, 9)
    x = np.array([x[0], x[1], headings[np.argmin(cost)]])
    P = np.diag([P[0, 0], P[1, 1], 0.12 ** 2])
    xs, Ps = [], []
    for u, i, z in zip(us, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            v = z - h(x, landmarks[i])
            v[1] = wrap(v[1])
            H = H_robot(x, landmarks[i])
            if v @ np.linalg.solve(H @ P @ H.T + R, v) < 9.2:
                x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P * np.eye(3))
    return np.array(xs), np.array(Ps)

# %% wrong: changes x and P in place, and is right otherwise
def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    headings = np.linspace(-np.pi, np.pi, 72, endpoint=False)
    poses = np.column_stack([np.tile(x[:2], (72, 1)), headings])
    cost = np.zeros(72)
    for u, i, z in list(zip(us, ids, zs))[:20]:
        poses = f_odometry(poses.T, u).T
        if i >= 0:
            v = z - h(poses, landmarks[i])
            cost += np.minimum((v[:, 0] / 0.4) ** 2 + (wrap(v[:, 1]) / 0.15) ** 2, 9)
    x[2] = headings[np.argmin(cost)]
    P[2] = P[:, 2] = 0
    P[2, 2] = 0.12 ** 2
    xs, Ps = [], []
    for u, i, z in zip(us, ids, zs):
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

# %% wrong: room for forty steps, whatever the run
def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    best, most = None, -1
    for heading in np.arange(24) * np.pi / 12:
        y, Q = np.array([x[0], x[1], heading]), np.diag([P[0, 0], P[1, 1], 0.1 ** 2])
        xs, Ps, agreed = np.zeros((40, 3)), np.zeros((40, 3, 3)), 0
        for k in range(40):
            y, Q = predict(y, Q, us[k], C)
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

# %% wrong: median of nine, wide start, wide gate
def run(x, P, us, ids, zs, landmarks, C, R, gate):
    xs, Ps = [], []
    for u, id, z in zip(us, ids, zs):
        x, P = predict(x, P, u, C)
        if id >= 0:
            v = z - h(x, landmarks[id])
            v[1] = wrap(v[1])
            H = H_robot(x, landmarks[id])
            if v @ np.linalg.solve(H @ P @ H.T + R, v) < gate:
                x, P = locate(x, P, z, landmarks[id], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)


def implied(x, us, ids, zs, landmarks):
    turned, place, found = 0.0, 0j, []
    for u, id, z in zip(us, ids, zs):
        place += u[0] * np.exp(1j * turned)
        turned += u[1]
        if id >= 0:
            there = complex(*(landmarks[id] - x[:2]))
            found.append(np.angle(there / (place + z[0] * np.exp(1j * (turned + z[1])))))
    return np.array(found)

def find_yourself(x, P, us, ids, zs, landmarks, C, R):

    a = implied(x, us, ids, zs, landmarks)[:9]
    t = a[np.argmin(np.abs(wrap(a[:, None] - a)).sum(axis=1))]
    P = P.copy()
    P[2] = P[:, 2] = 0
    P[2, 2] = 0.8**2
    return run(np.array([x[0], x[1], t]), P, us, ids, zs, landmarks, C, R, 50)

# %% wrong: the heading from the first sight, then a gate
def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    xs, Ps, known = [], [], False
    for u, i, z in zip(us, ids, zs):
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
