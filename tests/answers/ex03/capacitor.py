"""Independent answers to 03-capacitor: right ones, and students' mistakes."""

RIGHT = [
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
]

WRONG = [
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
]
