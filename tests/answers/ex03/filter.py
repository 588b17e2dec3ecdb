"""Independent answers to 03-filter: right ones, and students' mistakes."""

RIGHT = [
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
]

WRONG = [
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
]
