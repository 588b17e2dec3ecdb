"""A further class of answers, written from the lesson and the exercise's text alone."""

RIGHT = []

WRONG = [
    (
        "03-gain",
        "R inside with a minus",
        """
def gain(P, H, R):
    return P @ H.T @ np.linalg.inv(H @ P @ H.T - R)
""",
    ),
    (
        "03-gain",
        "solves with S on the wrong side",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    return np.linalg.solve(S, H @ P)
""",
    ),
    (
        "03-gain",
        "P.T and H for a single number, else cut",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    return P @ H.T / S
""",
    ),
    (
        "03-gain",
        "each state by its own variance only",
        """
def gain(P, H, R):
    D = np.diag(np.diag(P))
    return D @ H.T @ np.linalg.inv(H @ P @ H.T + R)
""",
    ),
    (
        "03-gain",
        "S has only a diagonal",
        """
def gain(P, H, R):
    S = np.diag(np.diag(H @ P @ H.T + R))
    return P @ H.T @ np.linalg.inv(S)
""",
    ),
    (
        "03-gain",
        "gain of a least squares without belief",
        """
def gain(P, H, R):
    W = np.linalg.inv(R)
    return np.linalg.pinv(H.T @ W @ H) @ H.T @ W
""",
    ),
    (
        "03-gain",
        "information form, P for its inverse",
        """
def gain(P, H, R):
    W = np.linalg.inv(R)
    return np.linalg.inv(P + H.T @ W @ H) @ H.T @ W
""",
    ),
    (
        "03-gain",
        "deviation in place of variance",
        """
def gain(P, H, R):
    return P @ H.T @ np.linalg.inv(H @ P @ H.T + np.sqrt(np.abs(R)))
""",
    ),
    (
        "03-gain",
        "pseudo-inverse of H",
        """
def gain(P, H, R):
    return np.linalg.pinv(H)
""",
    ),
    (
        "03-gain",
        "P after taken in place of P",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    P = P - K @ S @ K.T
    return P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
""",
    ),
    (
        "03-gain",
        "H P Hᵀ on top as well: gain in measured space",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    return H.T @ H @ P @ H.T @ np.linalg.inv(S)
""",
    ),
    (
        "03-update",
        "x by K z",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    return x + K @ z, P - K @ S @ K.T
""",
    ),
    (
        "03-update",
        "P − K S",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    return x + K @ v, P - K @ S @ K.T / 2
""",
    ),
    (
        "03-update",
        "P + K S Kᵀ",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    return x + K @ v, P + K @ S @ K.T
""",
    ),
    (
        "03-update",
        "Joseph without K R Kᵀ",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    J = np.eye(len(x)) - K @ H
    return x + K @ v, J @ P @ J.T
""",
    ),
    (
        "03-update",
        "Joseph, transpose forgotten",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    J = np.eye(len(x)) - K @ H
    return x + K @ v, J @ P @ J + K @ R @ K.T
""",
    ),
    (
        "03-update",
        "K R Kᵀ taken off",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    return x + K @ v, P - K @ R @ K.T
""",
    ),
    (
        "03-update",
        "refuses what is farther than 3 sigma",
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
        "03-update",
        "updates P first and takes the gain of the new P",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    P = P - K @ S @ K.T
    return x + gain(P, H, R) @ v, P
""",
    ),
    (
        "03-update",
        "numbers one after the other, R's diagonal only",
        """
def update(x, P, z, H, R):
    for k in range(len(z)):
        h, r = H[k : k + 1], R[k : k + 1, k : k + 1]
        K = gain(P, h, r)
        x = x + K @ (z[k : k + 1] - h @ x)
        P = P - K @ h @ P
    return x, P
""",
    ),
    (
        "03-update",
        "keeps only the diagonal of P",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    return x + K @ v, np.diag(np.diag(P - K @ S @ K.T))
""",
    ),
    (
        "03-update",
        "sums the innovation in place",
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
        "03-capacitor",
        "capacitor follows the source as it was before the jump",
        """
def capacitor(dt, ohms, farads, sigma):
    a = np.exp(-dt / (ohms * farads))
    F = np.array([[a, 1 - a], [0, 1]])
    return F, np.diag([0, sigma**2 * dt]), np.array([[1, 0], [-1 / ohms, 1 / ohms]])
""",
    ),
    (
        "03-capacitor",
        "no covariance between the two",
        """
def capacitor(dt, ohms, farads, sigma):
    a = np.exp(-dt / (ohms * farads))
    F = np.array([[a, 1 - a], [0, 1]])
    q = sigma**2 * dt
    return F, np.diag([(1 - a) ** 2 * q, q]), np.array([[1, 0], [-1 / ohms, 1 / ohms]])
""",
    ),
    (
        "03-capacitor",
        "Euler's step",
        """
def capacitor(dt, ohms, farads, sigma):
    b = dt / (ohms * farads)
    F = np.array([[1 - b, b], [0, 1]])
    g = np.array([b, 1.0])
    return F, np.outer(g, g) * sigma**2 * dt, np.array([[1, 0], [-1 / ohms, 1 / ohms]])
""",
    ),
    (
        "03-capacitor",
        "share that is left taken for the share that is gained",
        """
def capacitor(dt, ohms, farads, sigma):
    a = 1 - np.exp(-dt / (ohms * farads))
    F = np.array([[a, 1 - a], [0, 1]])
    g = np.array([1 - a, 1.0])
    return F, np.outer(g, g) * sigma**2 * dt, np.array([[1, 0], [-1 / ohms, 1 / ohms]])
""",
    ),
    (
        "03-capacitor",
        "current times resistance",
        """
def capacitor(dt, ohms, farads, sigma):
    a = np.exp(-dt / (ohms * farads))
    F = np.array([[a, 1 - a], [0, 1]])
    g = np.array([1 - a, 1.0])
    return F, np.outer(g, g) * sigma**2 * dt, np.array([[1, 0], [-ohms, ohms]])
""",
    ),
    (
        "03-capacitor",
        "current's sign",
        """
def capacitor(dt, ohms, farads, sigma):
    a = np.exp(-dt / (ohms * farads))
    F = np.array([[a, 1 - a], [0, 1]])
    g = np.array([1 - a, 1.0])
    return F, np.outer(g, g) * sigma**2 * dt, np.array([[1, 0], [1 / ohms, -1 / ohms]])
""",
    ),
    (
        "03-capacitor",
        "jump with sigma dt",
        """
def capacitor(dt, ohms, farads, sigma):
    a = np.exp(-dt / (ohms * farads))
    F = np.array([[a, 1 - a], [0, 1]])
    g = np.array([1 - a, 1.0])
    return F, np.outer(g, g) * (sigma * dt) ** 2, np.array([[1, 0], [-1 / ohms, 1 / ohms]])
""",
    ),
    (
        "03-capacitor",
        "ammeter shows the source over the resistance",
        """
def capacitor(dt, ohms, farads, sigma):
    a = np.exp(-dt / (ohms * farads))
    F = np.array([[a, 1 - a], [0, 1]])
    g = np.array([1 - a, 1.0])
    return F, np.outer(g, g) * sigma**2 * dt, np.array([[1, 0], [0, 1 / ohms]])
""",
    ),
    (
        "03-capacitor",
        "wander all along the step (white noise, continuous)",
        """
def capacitor(dt, ohms, farads, sigma):
    tau = ohms * farads
    a = np.exp(-dt / tau)
    F = np.array([[a, 1 - a], [0, 1]])
    q12 = dt - tau * (1 - a)
    q11 = dt - 2 * tau * (1 - a) + tau / 2 * (1 - a * a)
    Q = sigma**2 * np.array([[q11, q12], [q12, dt]])
    return F, Q, np.array([[1, 0], [-1 / ohms, 1 / ohms]])
""",
    ),
    (
        "03-capacitor",
        "states in the other order",
        """
def capacitor(dt, ohms, farads, sigma):
    a = np.exp(-dt / (ohms * farads))
    F = np.array([[1, 0], [1 - a, a]])
    g = np.array([1.0, 1 - a])
    return F, np.outer(g, g) * sigma**2 * dt, np.array([[0, 1], [1 / ohms, -1 / ohms]])
""",
    ),
    (
        "03-capacitor",
        "whole numbers: H of integers",
        """
def capacitor(dt, ohms, farads, sigma):
    a = np.exp(-dt / (ohms * farads))
    F = np.array([[a, 1 - a], [0, 1]])
    g = np.array([1 - a, 1.0])
    H = np.zeros((2, 2), dtype=int)
    H[0, 0] = 1
    H[1] = -1 / ohms, 1 / ohms
    return F, np.outer(g, g) * sigma**2 * dt, H
""",
    ),
    (
        "03-filter",
        "updates before it predicts",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = update(x, P, z, H, R)
        xs.append(x); Ps.append(P)
        x, P = predict(x, P, F, Q)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "appends what was predicted",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = predict(x, P, F, Q)
        xs.append(x); Ps.append(P)
        x, P = update(x, P, z, H, R)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "each step from the start",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        a, A = predict(x, P, F, Q)
        a, A = update(a, A, z, H, R)
        xs.append(a); Ps.append(A)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "P is predicted from the start's",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps, start = [], [], P
    for z in zs:
        x, P = predict(x, start, F, Q)
        x, P = update(x, P, z, H, R)
        xs.append(x); Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "predicts with R for Q",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = F @ x, F @ P @ F.T
        x, P = update(x, P, z, H, R)
        P = P + Q
        xs.append(x); Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "x is not predicted",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        _, P = predict(x, P, F, Q)
        x, P = update(x, P, z, H, R)
        xs.append(x); Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "start stands first, last is missing",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [x], [P]
    for z in zs[:-1]:
        x, P = predict(x, P, F, Q)
        x, P = update(x, P, z, H, R)
        xs.append(x); Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "one array for all beliefs, written over",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    x, P, xs, Ps = x.copy(), P.copy(), [], []
    for z in zs:
        a, A = predict(x, P, F, Q)
        a, A = update(a, A, z, H, R)
        x[:], P[:] = a, A
        xs.append(x); Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "Q twice",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = predict(x, P, F, Q)
        x, P = update(x, P + Q, z, H, R)
        xs.append(x); Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "steady gain from the first step",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps, K = [], [], None
    for z in zs:
        x, P = predict(x, P, F, Q)
        K = gain(P, H, R) if K is None else K
        x, P = x + K @ (z - H @ x), P - K @ H @ P
        xs.append(x); Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
]
