"""Independent answers to exercise 03: right ones, and students' mistakes."""

RIGHT = [
    (
        "03-gain",
        "solve instead of inv, transposed twice",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    return np.linalg.solve(S.T, H @ P.T).T
""",
    ),
    (
        "03-gain",
        "information form: K = P⁺ Hᵀ R⁻¹",
        """
def gain(P, H, R):
    information = np.linalg.inv(P) + H.T @ np.linalg.inv(R) @ H
    return np.linalg.inv(information) @ H.T @ np.linalg.inv(R)
""",
    ),
    (
        "03-gain",
        "one row of K per state, by least squares",
        """
def gain(P, H, R):
    n, m = P.shape[0], H.shape[0]
    cross = P @ np.transpose(H)
    S = np.dot(H, cross) + R
    K = np.empty((n, m))
    for state in range(n):
        K[state], *_ = np.linalg.lstsq(S, cross[state], rcond=None)
    return K
""",
    ),
    (
        "03-update",
        "Joseph's form, symmetrised",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    rest = np.eye(x.size) - K @ H
    new = rest @ P @ rest.T + K @ R @ K.T
    return x + K @ v, (new + new.T) / 2
""",
    ),
    (
        "03-update",
        "information adds up",
        """
def update(x, P, z, H, R):
    before = np.linalg.inv(P)
    weight = np.linalg.inv(R)
    after = np.linalg.inv(before + H.T @ weight @ H)
    return after @ (before @ x + H.T @ weight @ z), after
""",
    ),
    (
        "03-update",
        "one number at a time, after whitening with Cholesky",
        """
def update(x, P, z, H, R):
    L = np.linalg.cholesky(R)
    rows, numbers = np.linalg.solve(L, H), np.linalg.solve(L, z)
    x, P = x.astype(float), P.astype(float)
    for h, number in zip(rows, numbers):
        Ph = P @ h
        s = h @ Ph + 1.0
        x = x + Ph * (number - h @ x) / s
        P = P - np.outer(Ph, Ph) / s
    return x, P
""",
    ),
    (
        "03-filter",
        "preallocated, indices",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    steps, n = len(zs), len(x)
    xs = np.zeros((steps, n))
    Ps = np.zeros((steps, n, n))
    for k in range(steps):
        before = (x, P) if k == 0 else (xs[k - 1], Ps[k - 1])
        xs[k], Ps[k] = update(*predict(*before, F, Q), zs[k], H, R)
    return xs, Ps
""",
    ),
    (
        "03-filter",
        "itertools.accumulate, filter equations written out",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    from itertools import accumulate

    def step(belief, z):
        x, P = belief
        x, P = F @ x, F @ P @ F.T + Q
        K = np.linalg.solve(H @ P @ H.T + R, H @ P).T
        A = np.eye(len(x)) - K @ H
        return x + K @ (z - H @ x), A @ P @ A.T + K @ R @ K.T

    beliefs = list(accumulate(zs, step, initial=(x, P)))[1:]
    return np.stack([b[0] for b in beliefs]), np.stack([b[1] for b in beliefs])
""",
    ),
    (
        "03-capacitor",
        "the jump's covariance, carried along by F; expm1",
        """
def capacitor(dt, ohms, farads, sigma):
    tau = ohms * farads
    gone = -np.expm1(-dt / tau)
    F = np.array([[1.0 - gone, gone], [0.0, 1.0]])
    jump = np.array([[0.0, 0.0], [0.0, dt * sigma**2]])
    H = np.array([[1.0, 0.0], [-1.0, 1.0]]) / np.array([[1.0], [ohms]])
    return F, F @ jump @ F.T, H
""",
    ),
    (
        "03-capacitor",
        "the columns found by letting the step act on unit vectors",
        """
def capacitor(dt, ohms, farads, sigma):
    def step(state, w):
        volts, source = state
        source = source + w
        return np.array([source + (volts - source) * np.exp(-dt / ohms / farads), source])

    def meters(state):
        return np.array([state[0], (state[1] - state[0]) / ohms])

    unit = np.eye(2)
    F = np.column_stack([step(e, 0.0) for e in unit])
    H = np.column_stack([meters(e) for e in unit])
    g = step(np.zeros(2), 1.0)[:, None]
    return F, g @ g.T * sigma**2 * dt, H
""",
    ),
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
    # ------------------------------------------------------------------ gain
    (
        "03-gain",
        "divides by S number by number: right for one measured number only",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    return P @ H.T / S
""",
    ),
    (
        "03-gain",
        "solve without the last transpose: K is (m, n)",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    return np.linalg.solve(S, H @ P)
""",
    ),
    (
        "03-gain",
        "R forgotten in S (pinv hides the trouble)",
        """
def gain(P, H, R):
    PHt = P @ H.T
    return PHt @ np.linalg.pinv(H @ PHt)
""",
    ),
    (
        "03-gain",
        "takes R for a standard deviation and squares it",
        """
def gain(P, H, R):
    noise = R @ R
    return P @ H.T @ np.linalg.inv(H @ P @ H.T + noise)
""",
    ),
    (
        "03-gain",
        "information form with the old P instead of the new one",
        """
def gain(P, H, R):
    return P @ H.T @ np.linalg.inv(R)
""",
    ),
    (
        "03-gain",
        "only the diagonal of S: measured numbers taken as unrelated",
        """
def gain(P, H, R):
    PHt = P @ H.T
    variances = np.array([h @ P @ h + R[i, i] for i, h in enumerate(H)])
    return PHt / variances
""",
    ),
    (
        "03-gain",
        "information form with a hard-coded size of two states",
        """
def gain(P, H, R):
    W = np.linalg.inv(R)
    A = np.linalg.inv(np.eye(2) + P @ H.T @ W @ H)
    return A @ P @ H.T @ W
""",
    ),
    (
        "03-gain",
        "one measured number: returns (n,) instead of (n, 1)",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return K.squeeze()
""",
    ),
    (
        "03-gain",
        "adds to R in place: the caller's R is spoiled",
        """
def gain(P, H, R):
    R += H @ P @ H.T
    return np.linalg.solve(R, H @ P).T
""",
    ),
    (
        "03-gain",
        "only the states that are measured are corrected",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    seen = np.any(H != 0, axis=0)
    K = K * seen[:, None]
    return K
""",
    ),
    (
        "03-gain",
        "weighs in the state's space: P (P + HᵀRH)⁻¹ Hᵀ, R carried back by Hᵀ instead of an inverse",
        """
def gain(P, H, R):
    my_doubt, all_doubt = P, P + H.T @ R @ H
    return my_doubt @ np.linalg.inv(all_doubt) @ H.T
""",
    ),
    (
        "03-gain",
        "one measured number after the other, but each with the P from before",
        """
def gain(P, H, R):
    columns = []
    for i in range(H.shape[0]):
        h = H[i]
        columns.append(P @ h / (h @ P @ h + R[i, i]))
    return np.column_stack(columns) / H.shape[0]
""",
    ),
    (
        "03-gain",
        "gradient descent that stops much too early",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    K = np.zeros((len(P), len(H)))
    rate = 0.5 / np.trace(S)
    for _ in range(20):
        K = K - rate * 2 * (K @ S - P @ H.T)
    return K
""",
    ),
    (
        "03-gain",
        "brings the measurement back with pinv(H): wrong where H does not see all states",
        """
def gain(P, H, R):
    seen = H @ P @ H.T
    share = seen @ np.linalg.inv(seen + R)   # my doubt / all doubt
    return np.linalg.pinv(H) @ share
""",
    ),
    # ---------------------------------------------------------------- update
    (
        "03-update",
        "order of the product: P − P K H",
        """
def update(x, P, z, H, R):
    K = gain(P, H, R)
    v = z - H @ x
    return x + K @ v, P - P @ K @ H
""",
    ),
    (
        "03-update",
        "refuses what is more than three sigma off",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    if v @ np.linalg.solve(S, v) > 9:
        return x, P
    K = gain(P, H, R)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "03-update",
        "innovation with the wrong sign",
        """
def update(x, P, z, H, R):
    expected = H @ x
    K = gain(P, H, R)
    return x + K @ (expected - z), (np.eye(len(x)) - K @ H) @ P
""",
    ),
    (
        "03-update",
        "P is updated first, and the gain is taken from the new P",
        """
def update(x, P, z, H, R):
    P = P - gain(P, H, R) @ H @ P
    x = x + gain(P, H, R) @ (z - H @ x)
    return x, P
""",
    ),
    (
        "03-update",
        "Joseph's form without its second half",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    A = np.identity(len(P)) - K @ H
    return x + K @ v, A @ P @ A.T
""",
    ),
    (
        "03-update",
        "changes x and P of the caller",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    x += K @ v
    P -= K @ S @ K.T
    return x, P
""",
    ),
    (
        "03-update",
        "returns P first",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    P_new = P - K @ H @ P
    x_new = x + K @ v
    return P_new, x_new
""",
    ),
    (
        "03-update",
        "x becomes a column",
        """
def update(x, P, z, H, R):
    x = x.reshape(-1, 1)
    z = np.asarray(z).reshape(-1, 1)
    K = gain(P, H, R)
    x = x + K @ (z - H @ x)
    return x, P - K @ H @ P
""",
    ),
    (
        "03-update",
        "one number at a time, what R says between them ignored",
        """
def update(x, P, z, H, R):
    for i in range(len(z)):
        h = H[i:i + 1]
        K = gain(P, h, R[i:i + 1, i:i + 1])
        x = x + K @ (z[i:i + 1] - h @ x)
        P = P - K @ h @ P
    return x, P
""",
    ),
    (
        "03-update",
        "symmetrised without dividing by two",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    P = P - K @ S @ K.T
    return x + K @ v, P + P.T
""",
    ),
    (
        "03-update",
        "unit matrix of hard-coded size",
        """
def update(x, P, z, H, R):
    K = gain(P, H, R)
    I = np.eye(2)
    return x + K @ (z - H @ x), (I - K @ H) @ P
""",
    ),
    (
        "03-update",
        "innovation cut off at three sigma",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    limit = 3 * np.sqrt(np.diag(S))
    v = np.clip(v, -limit, limit)
    K = gain(P, H, R)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "03-update",
        "whitened with the transposed root of R",
        """
def update(x, P, z, H, R):
    W = np.linalg.inv(np.linalg.cholesky(R).T)
    h, y = W @ H, W @ z
    information = np.linalg.inv(P) + h.T @ h
    x_new = np.linalg.solve(information, np.linalg.inv(P) @ x + h.T @ y)
    return x_new, np.linalg.inv(information)
""",
    ),
    (
        "03-update",
        "Joseph's form with v vᵀ in place of R: P depends on what was measured",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    rest = np.eye(len(x)) - K @ H
    return x + K @ v, rest @ P @ rest.T + K @ np.outer(v, v) @ K.T
""",
    ),
    (
        "03-update",
        "half done: P stays as it was",
        """
def update(x, P, z, H, R):
    v, _ = innovation(x, P, z, H, R)
    return x + gain(P, H, R) @ v, P.copy()
""",
    ),
    # ---------------------------------------------------------------- filter
    (
        "03-filter",
        "updates before it predicts",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
        x, P = predict(x, P, F, Q)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "the start is returned, too",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    beliefs = [(x, P)]
    for z in zs:
        beliefs.append(update(*predict(*beliefs[-1], F, Q), z, H, R))
    xs, Ps = zip(*beliefs)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "the last measurement is left out",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs = np.zeros((len(zs), len(x)))
    Ps = np.zeros((len(zs), len(x), len(x)))
    for k in range(len(zs) - 1):
        x, P = predict(x, P, F, Q)
        x, P = update(x, P, zs[k], H, R)
        xs[k], Ps[k] = x, P
    return xs, Ps
""",
    ),
    (
        "03-filter",
        "P is not carried on: each step begins with the P of the start",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x_pred, P_pred = predict(x, P, F, Q)
        x, P_new = update(x_pred, P_pred, z, H, R)
        xs.append(x)
        Ps.append(P_new)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "returns only the last belief",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    for z in zs:
        x, P = predict(x, P, F, Q)
        x, P = update(x, P, z, H, R)
    return x, P
""",
    ),
    (
        "03-filter",
        "two states hard-coded",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = np.zeros((len(zs), 2)), np.zeros((len(zs), 2, 2))
    for i, z in enumerate(zs):
        x, P = update(*predict(x, P, F, Q), z, H, R)
        xs[i, :], Ps[i, :, :] = x, P
    return xs, Ps
""",
    ),
    (
        "03-filter",
        "the same array is appended again and again, and the caller's start changed",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x[:], P[:] = predict(x, P, F, Q)
        x[:], P[:] = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "stores the predictions, not the beliefs after the measurements",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = predict(x, P, F, Q)
        xs.append(x)
        Ps.append(P)
        x, P = update(x, P, z, H, R)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "steady state: one P for the whole drive",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    for _ in range(200):
        P = F @ P @ F.T + Q
        K = gain(P, H, R)
        P = P - K @ H @ P
    xs = []
    for z in zs:
        x = F @ x
        x = x + K @ (z - H @ x)
        xs.append(x)
    return np.array(xs), np.repeat(P[None], len(zs), axis=0)
""",
    ),
    (
        "03-filter",
        "the first measurement belongs to the start: no step before it",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for k, z in enumerate(zs):
        if k > 0:
            x, P = predict(x, P, F, Q)
        x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "ravels zs: right for one measured number only",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs.ravel():
        x, P = predict(x, P, F, Q)
        x, P = update(x, P, np.array([z]), H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "P is predicted without Q, which is added at the end of the step only for output",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = F @ x, F @ P @ F.T
        x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P + Q)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "the patient one's smoothed states: knows the future",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    n, steps = len(x), len(zs)
    size = n * (steps + 1)
    A, b = np.zeros((size, size)), np.zeros(size)

    def add(J, y, C):
        W = np.linalg.inv(C)
        A[:] += J.T @ W @ J
        b[:] += J.T @ W @ y

    pick = lambda k: np.eye(size)[n * k : n * (k + 1)]
    add(pick(0), x, P)
    for k, z in enumerate(zs):
        add(pick(k + 1) - F @ pick(k), np.zeros(n), Q)
        add(H @ pick(k + 1), z, R)
    cov = np.linalg.inv(A)
    xs = (cov @ b).reshape(steps + 1, n)[1:]
    Ps = np.array([cov[n * k : n * (k + 1), n * k : n * (k + 1)] for k in range(1, steps + 1)])
    return xs, Ps
""",
    ),
    (
        "03-filter",
        "covariances made positive with abs",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = predict(x, P, F, Q)
        x, P = update(x, P, z, H, R)
        P = np.abs(P)
        xs.append(x)
        Ps.append(P)
    return np.stack(xs), np.stack(Ps)
""",
    ),
    (
        "03-filter",
        "only the variances are returned",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = update(*predict(x, P, F, Q), z, H, R)
        xs.append(x)
        Ps.append(np.diag(P))
    return np.array(xs), np.array(Ps)
""",
    ),
    # ------------------------------------------------------------- capacitor
    (
        "03-capacitor",
        "Euler's step instead of the exponential",
        """
def capacitor(dt, ohms, farads, sigma):
    a = dt / (ohms * farads)
    F = np.array([[1 - a, a], [0, 1]])
    g = np.array([[a], [1]])
    return F, g @ g.T * sigma**2 * dt, np.array([[1, 0], [-1 / ohms, 1 / ohms]])
""",
    ),
    (
        "03-capacitor",
        "only the source jumps: Q as if at the end of the step",
        """
def capacitor(dt, ohms, farads, sigma):
    e = np.exp(-dt / (ohms * farads))
    F = np.array([[e, 1 - e], [0, 1]])
    Q = np.diag([0.0, sigma**2 * dt])
    H = np.array([[1, 0], [-1 / ohms, 1 / ohms]])
    return F, Q, H
""",
    ),
    (
        "03-capacitor",
        "Q without what relates the two errors",
        """
def capacitor(dt, ohms, farads, sigma):
    e = np.exp(-dt / (ohms * farads))
    F = np.array([[e, 1 - e], [0, 1]])
    Q = sigma**2 * dt * np.diag([(1 - e) ** 2, 1])
    H = np.array([[1, 0], [-1 / ohms, 1 / ohms]])
    return F, Q, H
""",
    ),
    (
        "03-capacitor",
        "source wanders all through the step, not at its beginning",
        """
def capacitor(dt, ohms, farads, sigma):
    tau = ohms * farads
    e = np.exp(-dt / tau)
    F = np.array([[e, 1 - e], [0, 1]])
    q12 = dt - tau * (1 - e)
    q11 = dt - 2 * tau * (1 - e) + tau / 2 * (1 - e**2)
    Q = sigma**2 * np.array([[q11, q12], [q12, dt]])
    H = np.array([[1, 0], [-1 / ohms, 1 / ohms]])
    return F, Q, H
""",
    ),
    (
        "03-capacitor",
        "sigma · dt taken as the standard deviation of the jump",
        """
def capacitor(dt, ohms, farads, sigma):
    left = np.exp(-dt / (ohms * farads))
    F = np.array([[left, 1 - left], [0, 1]])
    effect = (sigma * dt) * np.array([1 - left, 1])
    Q = np.outer(effect, effect)
    return F, Q, np.array([[1, 0], [-1 / ohms, 1 / ohms]])
""",
    ),
    (
        "03-capacitor",
        "current counted positive while discharging",
        """
def capacitor(dt, ohms, farads, sigma):
    decay = np.exp(-dt / (ohms * farads))
    F = np.array([[decay, 1 - decay], [0, 1]])
    G = F[:, 1:]
    H = np.vstack([[1, 0], np.array([1, -1]) / ohms])
    return F, sigma**2 * dt * G @ G.T, H
""",
    ),
    (
        "03-capacitor",
        "ammeter in volts: the resistance forgotten (right for 1 Ω, as in the picture)",
        """
def capacitor(dt, ohms, farads, sigma):
    left = np.exp(-dt / (ohms * farads))
    F = np.array([[left, 1 - left], [0.0, 1.0]])
    Q = sigma**2 * dt * np.array([[(1 - left) ** 2, 1 - left], [1 - left, 1]])
    H = np.array([[1.0, 0.0], [-1.0, 1.0]])
    return F, Q, H
""",
    ),
    (
        "03-capacitor",
        "-dt / ohms * farads: brackets forgotten (right for 1 F)",
        """
def capacitor(dt, ohms, farads, sigma):
    left = np.exp(-dt / ohms * farads)
    F = np.array([[left, 1 - left], [0, 1]])
    jump = np.array([1 - left, 1])
    return F, sigma**2 * dt * np.outer(jump, jump), np.array([[1, 0], [-1 / ohms, 1 / ohms]])
""",
    ),
    (
        "03-capacitor",
        "state in the other order, source first",
        """
def capacitor(dt, ohms, farads, sigma):
    k = np.exp(-dt / (ohms * farads))
    F = np.array([[1, 0], [1 - k, k]])
    b = np.array([1, 1 - k])
    H = np.array([[0, 1], [1 / ohms, -1 / ohms]])
    return F, sigma**2 * dt * np.outer(b, b), H
""",
    ),
    (
        "03-capacitor",
        "the share that is left, and the one that is gone, exchanged",
        """
def capacitor(dt, ohms, farads, sigma):
    share = np.exp(-dt / (ohms * farads))
    F = np.array([[1 - share, share], [0, 1]])
    jump = F[:, 1]
    Q = sigma**2 * dt * np.outer(jump, jump)
    H = np.array([[1, 0], [-1 / ohms, 1 / ohms]])
    return F, Q, H
""",
    ),
    (
        "03-capacitor",
        "H filled into an array of integers: the ammeter's row is cut off",
        """
def capacitor(dt, ohms, farads, sigma):
    left = np.exp(-dt / (ohms * farads))
    F = np.eye(2)
    F[0] = left, 1 - left
    Q = F @ np.diag([0, sigma**2 * dt]) @ F.T
    H = np.array([[1, 0], [0, 0]])
    H[1, 0] = -1 / ohms
    H[1, 1] = 1 / ohms
    return F, Q, H
""",
    ),
    (
        "03-capacitor",
        "returns F, H, Q",
        """
def capacitor(dt, ohms, farads, sigma):
    left = np.exp(-dt / (ohms * farads))
    F = np.array([[left, 1 - left], [0, 1]])
    H = np.array([[1, 0], [-1 / ohms, 1 / ohms]])
    g = np.array([1 - left, 1])
    Q = np.outer(g, g) * sigma**2 * dt
    return F, H, Q
""",
    ),
    (
        "03-capacitor",
        "a little something on Q's diagonal, so that it can be inverted",
        """
def capacitor(dt, ohms, farads, sigma):
    left = np.exp(-dt / (ohms * farads))
    F = np.array([[left, 1 - left], [0, 1]])
    g = np.array([1 - left, 1])
    Q = np.outer(g, g) * sigma**2 * dt + 1e-4 * np.eye(2)
    return F, Q, np.array([[1, 0], [-1 / ohms, 1 / ohms]])
""",
    ),
    (
        "03-capacitor",
        "share left computed by dividing through dt: nan for a step of no time",
        """
def capacitor(dt, ohms, farads, sigma):
    tau = ohms * farads
    rate = (1 - np.exp(-dt / tau)) / np.float64(dt)      # how much per second
    F = np.array([[1 - rate * dt, rate * dt], [0, 1]])
    g = np.array([rate * dt, 1])
    return F, sigma**2 * dt * np.outer(g, g), np.array([[1, 0], [-1 / ohms, 1 / ohms]])
""",
    ),
    (
        "03-capacitor",
        "the meters read after one more F: H F in place of H",
        """
def capacitor(dt, ohms, farads, sigma):
    left = np.exp(-dt / (ohms * farads))
    F = np.array([[left, 1 - left], [0, 1]])
    jump = F @ [0, 1]
    meters = np.array([[1, 0], [-1 / ohms, 1 / ohms]])
    return F, sigma**2 * dt * np.outer(jump, jump), meters @ F
""",
    ),
    # ---------------------------------------------------------------- ghosts
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
