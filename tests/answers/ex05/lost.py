"""Independent answers to 05-lost: right ones, and students' mistakes."""

RIGHT = [
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
