"""A fourth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "03-gain",
        "least squares by the joint covariance, lstsq of the transpose",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    Kt, *_ = np.linalg.lstsq(S, H @ P, rcond=None)
    return Kt.T
""",
    ),
    (
        "03-update",
        "information form",
        """
def update(x, P, z, H, R):
    I = np.linalg.inv(P) + H.T @ np.linalg.inv(R) @ H
    i = np.linalg.solve(P, x) + H.T @ np.linalg.solve(R, z)
    C = np.linalg.inv(I)
    return C @ i, C
""",
    ),
]

WRONG = [
    (
        "03-gain",
        "R times two dimensions: H P Hᵀ inverted without R",
        """
def gain(P, H, R):
    return P @ H.T @ np.linalg.inv(H @ P @ H.T)
""",
    ),
    (
        "03-gain",
        "elementwise division by S",
        """
def gain(P, H, R):
    S = H @ P @ H.T + R
    return P @ H.T / S
""",
    ),
    (
        "03-gain",
        "for one measured number only",
        """
def gain(P, H, R):
    S = (H @ P @ H.T + R)[0, 0]
    return P @ H.T / S
""",
    ),
    (
        "03-gain",
        "pinv of H plus",
        """
def gain(P, H, R):
    return np.linalg.pinv(H)
""",
    ),
    (
        "03-update",
        "P by K S without transpose of K",
        """
def update(x, P, z, H, R):
    K = gain(P, H, R)
    v, S = innovation(x, P, z, H, R)
    return x + K @ v, P - K @ S @ K
""",
    ),
    (
        "03-update",
        "x in place",
        """
def update(x, P, z, H, R):
    K = gain(P, H, R)
    v, S = innovation(x, P, z, H, R)
    x += K @ v
    P -= K @ S @ K.T
    return x, P
""",
    ),
    (
        "03-update",
        "P first, the gain from the new P",
        """
def update(x, P, z, H, R):
    v, S = innovation(x, P, z, H, R)
    P = P - gain(P, H, R) @ S @ gain(P, H, R).T
    return x + gain(P, H, R) @ v, P
""",
    ),
    (
        "03-update",
        "returned the other way round",
        """
def update(x, P, z, H, R):
    K = gain(P, H, R)
    v, S = innovation(x, P, z, H, R)
    return P - K @ S @ K.T, x + K @ v
""",
    ),
    (
        "03-filter",
        "update before predict",
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
        "returns after the first step",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = predict(x, P, F, Q)
        x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
        return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-filter",
        "the start belongs to the list",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [x], [P]
    for z in zs:
        x, P = predict(x, P, F, Q)
        x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "03-capacitor",
        "the jump does not reach the capacitor",
        """
def capacitor(dt, ohms, farads, sigma):
    a = np.exp(-dt / (ohms * farads))
    F = np.array([[a, 1 - a], [0, 1]])
    Q = np.diag([0, sigma ** 2 * dt])
    H = np.array([[1, 0], [-1 / ohms, 1 / ohms]])
    return F, Q, H
""",
    ),
    (
        "03-capacitor",
        "Euler in place of the exponential",
        """
def capacitor(dt, ohms, farads, sigma):
    k = dt / (ohms * farads)
    F = np.array([[1 - k, k], [0, 1]])
    b = np.array([k, 1])
    return F, sigma ** 2 * dt * np.outer(b, b), np.array([[1, 0], [-1 / ohms, 1 / ohms]])
""",
    ),
    (
        "03-capacitor",
        "variance sigma squared, dt forgotten; current in volts",
        """
def capacitor(dt, ohms, farads, sigma):
    a = np.exp(-dt / (ohms * farads))
    F = np.array([[a, 1 - a], [0, 1]])
    b = np.array([1 - a, 1])
    return F, sigma ** 2 * np.outer(b, b), np.array([[1, 0], [-1, 1]])
""",
    ),
    (
        "03-ghosts",
        "us forgotten",
        """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = predict(x, P, F, Q)
        v, S = innovation(x, P, z, H, R)
        if v[0] ** 2 < 9 * S[0, 0]:
            x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
]
