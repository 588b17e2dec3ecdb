"""Independent answers to 03-ghosts: right ones, and students' mistakes."""

RIGHT = [
    (
        "03-ghosts",
        "follow both cases: a sum of Gaussians, the best 40 kept",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    cases = [(1.0, x, P)]
    xs, Ps = [], []
    for u, z in zip(us, zs):
        following = []
        for weight, x, P in cases:
            x, P = F @ x + u, F @ P @ F.T + Q
            v, S = innovation(x, P, z, H, R)
            likely = np.exp(-0.5 * v[0] ** 2 / S[0, 0]) / np.sqrt(2 * np.pi * S[0, 0])
            following.append((weight * GHOSTS / REACH, x, P))
            K = P @ H.T / S[0, 0]
            following.append((weight * (1 - GHOSTS) * likely, x + K @ v, P - K @ S @ K.T))
        following.sort(key=lambda case: -case[0])
        following = following[:40]
        total = sum(case[0] for case in following)
        cases = [(weight / total, x, P) for weight, x, P in following]
        mean = sum(weight * x for weight, x, _ in cases)
        cov = sum(w * (P + np.outer(x - mean, x - mean)) for w, x, P in cases)
        xs.append(mean)
        Ps.append(cov)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "all yes/no histories of the last five readings, older ones merged",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    DEPTH = 5

    def merge(group):
        w = np.array([g[0] for g in group])
        total = w.sum()
        if total == 0:
            w, total = np.full(len(group), 1e-300), 1e-300 * len(group)
        m = sum(a * g[1] for a, g in zip(w, group)) / total
        C = sum(a * (g[2] + np.outer(g[1] - m, g[1] - m)) for a, g in zip(w, group)) / total
        return total, m, C

    beliefs = {(): (1.0, x, P)}
    xs, Ps = [], []
    for u, z in zip(us, zs):
        groups = {}
        for history, (w, m, C) in beliefs.items():
            m, C = predict(m, C, F, Q)
            m = m + u
            v, S = innovation(m, C, z, H, R)
            s = S.item()
            density = np.exp(-(v.item() ** 2) / (2 * s)) / np.sqrt(2 * np.pi * s)
            seen = update(m, C, z, H, R)
            for real, case in (
                (True, (w * (1 - GHOSTS) * density, *seen)),
                (False, (w * GHOSTS / REACH, m, C)),
            ):
                groups.setdefault((history + (real,))[-DEPTH:], []).append(case)
        merged = {key: merge(group) for key, group in groups.items()}
        total = sum(b[0] for b in merged.values())
        beliefs = {key: (b[0] / total, b[1], b[2]) for key, b in merged.items()}
        _, m, C = merge(list(beliefs.values()))
        xs.append(m)
        Ps.append(C)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "probabilistic data association, in words of log odds",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    n = len(zs)
    xs, Ps = np.zeros((n, 2)), np.zeros((n, 2, 2))
    for k in range(n):
        x, P = predict(x, P, F, Q)
        x = x + us[k]
        x_real, P_real = update(x, P, zs[k], H, R)
        v, S = innovation(x, P, zs[k], H, R)
        log_real = np.log(1 - GHOSTS) - 0.5 * (v @ np.linalg.solve(S, v))
        log_real -= 0.5 * np.log(np.linalg.det(2 * np.pi * S))
        b = 1 / (1 + np.exp(np.log(GHOSTS / REACH) - log_real))
        mean = b * x_real + (1 - b) * x
        d1, d0 = x_real - mean, x - mean
        P = b * (P_real + np.outer(d1, d1)) + (1 - b) * (P + np.outer(d0, d0))
        x = mean
        xs[k], Ps[k] = x, P
    return xs, Ps
""",
    ),
]

WRONG = [
    (
        "03-ghosts",
        "the lesson's filter, with u",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x, P = update(x + u, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "one larger R for all readings: the mixture's variance",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    R_all = (1 - GHOSTS) * R + GHOSTS * REACH**2 / 12
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x, P = update(x + u, P, z, H, R_all)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "reads nothing at all: adds up u",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u in us:
        x, P = F @ x + u, F @ P @ F.T + Q
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "gate of one sigma, P as if nothing had been chosen",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = innovation(x, P, z, H, R)
        if abs(v[0]) < np.sqrt(S[0, 0]):
            x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "both cases weighed, but P as if every reading were real",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = innovation(x, P, z, H, R)
        v, s = v[0], S[0, 0]
        a = (1 - GHOSTS) * np.exp(-0.5 * v * v / s) / np.sqrt(2 * np.pi * s)
        share = a / (a + GHOSTS / REACH)
        K = gain(P, H, R)
        x = x + share * K[:, 0] * v
        P = P - K @ S @ K.T
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "both cases weighed, u forgotten",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = predict(x, P, F, Q)
        v, S = innovation(x, P, z, H, R)
        v, S = v.item(), S.item()
        K = P @ H[0] / S
        real = (1 - GHOSTS) * np.exp(-(v**2) / S / 2) / np.sqrt(2 * np.pi * S)
        share = real / (real + GHOSTS / REACH)
        x = x + share * v * K
        P = P + (share * (1 - share) * v**2 - share * S) * np.outer(K, K)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "the readings themselves, the speed by differences",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    place = np.concatenate([[x[0]], zs[:, 0]])
    speed = np.diff(place) / F[0, 1]
    Ps = np.tile(np.diag([REACH**2 / 12, 4 * REACH**2]), (len(zs), 1, 1))
    return np.column_stack([place[1:], speed]), Ps
""",
    ),
    (
        "03-ghosts",
        "a good estimate, with a P a hundred times too large, to be on the safe side",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = innovation(x, P, z, H, R)
        if v[0] ** 2 < 9 * S[0, 0]:
            x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(100 * P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "median of the last five readings, then the lesson's filter",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for k in range(len(zs)):
        z = np.median(zs[max(0, k - 4) : k + 1], axis=0)
        x, P = predict(x, P, F, Q)
        x, P = update(x + us[k], P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "gate in units of R alone, the belief's own doubt left out",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        v = z - H @ x
        if abs(v[0]) <= np.sqrt(R[0, 0]):
            x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "refuses only what lies outside 0 to 10 m",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        if 0 < z[0] < REACH:
            x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "one reading in four refused at random",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    rng = np.random.default_rng(0)
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        if rng.random() > GHOSTS:
            x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "refused readings leave no belief: too few rows",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = innovation(x, P, z, H, R)
        if v[0] ** 2 / S[0, 0] > 9:
            continue
        x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "a constant share of every innovation, no look at how likely it is",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = innovation(x, P, z, H, R)
        K = (1 - GHOSTS) * gain(P, H, R)
        x = x + K @ v
        A = np.eye(2) - K @ H
        P = A @ P @ A.T + K @ R @ K.T
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "cheat: the path of ghost_drive, known by heart",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    k = np.arange(len(zs) + 1)
    place = 5 + 2.5 * np.sin(0.5 * k * 2 * np.pi / 15)
    way = np.stack([place, np.gradient(place, 0.5)], axis=1)
    return way[1:], np.tile(np.diag([0.1, 0.1]) ** 2, (len(zs), 1, 1))
""",
    ),
    (
        "03-ghosts",
        "a refused reading is replaced by the expected one, and P shrinks all the same",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = innovation(x, P, z, H, R)
        if abs(v[0]) > 3 * np.sqrt(S[0, 0]):
            z = H @ x
        x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "good filter that works on the caller's P and x in place",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x[:] = F @ x + u
        P[:] = F @ P @ F.T + Q
        v, S = (a.item() for a in innovation(x, P, z, H, R))
        K = P @ H[0] / S
        real = (1 - GHOSTS) * np.exp(-(v**2) / S / 2) / np.sqrt(2 * np.pi * S)
        b = real / (real + GHOSTS / REACH)
        x += b * v * K
        P += (b * (1 - b) * v**2 - b * S) * np.outer(K, K)
        xs.append(x.copy())
        Ps.append(P.copy())
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "the bell without its square: exp(-v/S) of |v|, and the ghosts' density not per metre",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = innovation(x, P, z, H, R)
        real = (1 - GHOSTS) * np.exp(-abs(v[0]) / S[0, 0])
        share = real / (real + GHOSTS)
        x_real, P_real = update(x, P, z, H, R)
        x = share * x_real + (1 - share) * x
        P = share * P_real + (1 - share) * P
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
]
