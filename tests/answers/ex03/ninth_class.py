"""A ninth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "03-gain",
        "information form: (P^-1 + H' R^-1 H)^-1 H' R^-1",
        """
def gain(P, H, R):
    weight = np.linalg.inv(R)
    after = np.linalg.inv(np.linalg.inv(P) + H.T @ weight @ H)
    return after @ H.T @ weight
""",
    ),
    (
        "03-update",
        "whitens the measurement with Cholesky of R and takes it in number by number",
        """
def update(x, P, z, H, R):
    L = np.linalg.cholesky(R)
    Hw, zw = np.linalg.solve(L, H), np.linalg.solve(L, z)
    for row, value in zip(Hw, zw):
        Pr = P @ row
        s = row @ Pr + 1.0
        x = x + Pr * (value - row @ x) / s
        P = P - np.outer(Pr, Pr) / s
    return x, P
""",
    ),
]

WRONG = [
    (
        "03-gain",
        "weight R^-1 in place of S^-1: the doubt of the prediction is missing in the innovation's covariance",
        """
def gain(P, H, R):
    return np.linalg.solve(R, H @ P).T
""",
    ),
    (
        "03-gain",
        "takes R for standard deviations and squares it",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R @ R
    return np.linalg.solve(S, H @ P).T
""",
    ),
    (
        "03-gain",
        "weighs in the measured numbers only and goes back with the pseudo-inverse of H: states that are not measured learn nothing through P",
        """
def gain(P, H, R):
    seen = H @ P @ H.T
    share = seen @ np.linalg.inv(seen + R)
    return np.linalg.pinv(H) @ share
""",
    ),
    (
        "03-gain",
        "divides by S entry by entry instead of multiplying by its inverse",
        """
def gain(P, H, R):
    PHt = P @ H.T
    S = H @ PHt + R
    K = np.zeros(PHt.shape)
    for i in range(K.shape[0]):
        for j in range(K.shape[1]):
            K[i, j] = PHt[i, j] / S[j, j]
    return K
""",
    ),
    (
        "03-update",
        "innovation the wrong way round (expected minus measured)",
        """
def update(x, P, z, H, R):
    K = gain(P, H, R)
    expected = H @ x
    x_new = x + K @ (expected - z)
    return x_new, (np.eye(len(x)) - K @ H) @ P
""",
    ),
    (
        "03-update",
        "Joseph form without its second half, K R K' is left out",
        """
def update(x, P, z, H, R):
    K = gain(P, H, R)
    left = np.eye(P.shape[0]) - K @ H
    return x + K @ (z - H @ x), left @ P @ left.T
""",
    ),
    (
        "03-update",
        "takes the numbers in one by one with the diagonal of R: their common noise is ignored",
        """
def update(x, P, z, H, R):
    for k in range(len(z)):
        row = H[k]
        s = row @ P @ row + R[k, k]
        K = P @ row / s
        x = x + K * (z[k] - row @ x)
        P = P - s * np.outer(K, K)
    return x, P
""",
    ),
    (
        "03-update",
        "leaves out measurements that are more than 3 sigma off",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    if v @ np.linalg.solve(S, v) > 9 * len(v):
        return x, P
    K = gain(P, H, R)
    return x + K @ v, P - K @ S @ K.T
""",
    ),
    (
        "03-filter",
        "updates first and predicts afterwards: the first measurement is taken for one before the first step",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    out_x, out_P = [], []
    for k in range(len(zs)):
        x, P = update(x, P, zs[k], H, R)
        out_x.append(x)
        out_P.append(P)
        x, P = predict(x, P, F, Q)
    return np.stack(out_x), np.stack(out_P)
""",
    ),
    (
        "03-filter",
        "returns the predictions, before each measurement",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    n, steps = len(x), len(zs)
    xs, Ps = np.empty((steps, n)), np.empty((steps, n, n))
    for k, z in enumerate(zs):
        xs[k], Ps[k] = predict(x, P, F, Q)
        x, P = update(xs[k], Ps[k], z, H, R)
    return xs, Ps
""",
    ),
    (
        "03-filter",
        "gain computed once in the first step and kept for the whole drive, and P with it",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    P_before = F @ P @ F.T + Q
    S = H @ P_before @ H.T + R
    K = P_before @ H.T @ np.linalg.inv(S)
    P_after = P_before - K @ S @ K.T
    xs = []
    for z in zs:
        x = F @ x
        x = x + K @ (z - H @ x)
        xs.append(x)
    return np.array(xs), np.array([P_after] * len(zs))
""",
    ),
    (
        "03-filter",
        "the covariance is predicted with the P of the start in every step (P is never carried on)",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P_pred = predict(x, P, F, Q)
        x, P_new = update(x, P_pred, z, H, R)
        xs.append(x)
        Ps.append(P_new)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-capacitor",
        "Q only for the source: the jump does not reach the capacitor in the same step",
        """
def capacitor(dt, ohms, farads, sigma):
    a = np.exp(-dt / (ohms * farads))
    F = np.array([[a, 1 - a], [0.0, 1.0]])
    Q = np.array([[0.0, 0.0], [0.0, sigma**2 * dt]])
    H = np.array([[1.0, 0.0], [-1 / ohms, 1 / ohms]])
    return F, Q, H
""",
    ),
    (
        "03-capacitor",
        "Q diagonal: that both voltages have the error of one and the same jump is lost",
        """
def capacitor(dt, ohms, farads, sigma):
    tau = ohms * farads
    share = 1 - np.exp(-dt / tau)
    F = np.eye(2) + share * np.array([[-1, 1], [0, 0]])
    Q = np.diag([share**2, 1]) * sigma**2 * dt
    H = np.array([[1, 0], [-1, 1]]) / np.array([[1], [ohms]])
    return F, Q, H
""",
    ),
    (
        "03-capacitor",
        "first order instead of the exponential: share dt/tau, only good for short steps",
        """
def capacitor(dt, ohms, farads, sigma):
    k = dt / (ohms * farads)
    F = np.array([[1 - k, k], [0, 1]])
    G = np.array([[k], [1]])
    Q = G @ G.T * sigma**2 * dt
    H = np.array([[1, 0], [-1 / ohms, 1 / ohms]])
    return F, Q, H
""",
    ),
    (
        "03-capacitor",
        "source wanders all through the step (integral of the noise) instead of a jump at its beginning",
        """
def capacitor(dt, ohms, farads, sigma):
    tau = ohms * farads
    F = np.array([[np.exp(-dt / tau), 1 - np.exp(-dt / tau)], [0, 1]])
    H = np.array([[1, 0], [-1 / ohms, 1 / ohms]])
    parts, Q = 400, np.zeros((2, 2))
    for k in range(parts):
        rest = dt * (k + 0.5) / parts
        b = np.array([1 - np.exp(-rest / tau), 1])
        Q += sigma**2 * dt / parts * np.outer(b, b)
    return F, Q, H
""",
    ),
    (
        "03-capacitor",
        "current with the wrong sign: positive while the capacitor is discharged",
        """
def capacitor(dt, ohms, farads, sigma):
    left = np.exp(-dt / ohms / farads)
    F = np.array([[left, 1 - left], [0, 1]])
    J = np.array([1 - left, 1])
    H = np.array([[1, 0], [1 / ohms, -1 / ohms]])
    return F, sigma**2 * dt * np.outer(J, J), H
""",
    ),
    (
        "03-ghosts",
        "the plain filter, takes in every ghost",
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
        "the gate the wrong way round: refuses what fits and takes in what is far off",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = F @ x + u, F @ P @ F.T + Q
        v, S = innovation(x, P, z, H, R)
        if v[0] ** 2 > 9 * S[0, 0]:
            x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "gate with R alone, without the doubt of the prediction: refuses true readings when unsure",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps, sigma = [], [], np.sqrt(R[0, 0])
    for k in range(len(zs)):
        x, P = predict(x, P, F, Q)
        x = x + us[k]
        if abs(zs[k, 0] - x[0]) < 1.5 * sigma:
            x, P = update(x, P, zs[k], H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-ghosts",
        "a mean noise for all readings (mixture's variance as R): every ghost still pulls",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    R_all = (1 - GHOSTS) * R + GHOSTS * np.array([[REACH**2 / 12]])
    xs, Ps = np.zeros((len(zs), 2)), np.zeros((len(zs), 2, 2))
    for k, z in enumerate(zs):
        x, P = predict(x, P, F, Q)
        x, P = update(x + us[k], P, z, H, R_all)
        xs[k], Ps[k] = x, P
    return xs, Ps
""",
    ),
    (
        "03-ghosts",
        "gates well but leaves out the u that was told of the step",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = predict(x, P, F, Q)
        v, S = innovation(x, P, z, H, R)
        if v @ np.linalg.inv(S) @ v < 6.6:
            x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-update",
        "changes the belief it was given (+= and -=)",
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
        "03-filter",
        "gives the start along as the first belief and leaves out the last",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [x], [P]
    for z in zs:
        x, P = predict(xs[-1], Ps[-1], F, Q)
        x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs[:-1]), np.array(Ps[:-1])
""",
    ),
    (
        "03-capacitor",
        "the current as the mean over the step, farads times change over dt, instead of at its end; fails at dt = 0",
        """
def capacitor(dt, ohms, farads, sigma):
    left = np.exp(-dt / (ohms * farads))
    F = np.array([[left, 1 - left], [0, 1]])
    w = sigma * np.sqrt(dt) * np.array([1 - left, 1.0])
    conductance = farads * (1 - left) / dt
    H = np.array([[1.0, 0.0], [-conductance, conductance]])
    return F, np.outer(w, w), H
""",
    ),
]
