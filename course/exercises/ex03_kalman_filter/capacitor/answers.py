# %% way: by entries
def capacitor(dt, ohms, farads, sigma):
    tau = ohms * farads
    e = np.exp(-dt / tau)
    g, q = 1 - e, sigma**2 * dt
    F = [[e, g], [0, 1]]
    Q = [[q * g**2, q * g], [q * g, q]]
    H = [[1, 0], [-1 / ohms, 1 / ohms]]
    return F, Q, H

# %% way: carried by F
def capacitor(dt, ohms, farads, sigma):
    share = -np.expm1(-dt / ohms / farads)
    F = np.array([[1 - share, share], [0, 1]])
    at_first = np.diag([0, sigma**2 * dt])
    return F, F @ at_first @ F.T, np.array([[1, 0], np.array([-1, 1]) / ohms])

# %% way: matrix exponential
def capacitor(dt, ohms, farads, sigma):
    rate = 1 / (ohms * farads)
    A = np.array([[-rate, rate], [0, 0]])
    values, vectors = np.linalg.eig(A)
    F = np.real(vectors @ np.diag(np.exp(values * dt)) @ np.linalg.inv(vectors))
    g = F[:, 1:] * sigma * dt**0.5
    return F, g @ g.T, np.array([[ohms, 0], [-1, 1]]) / ohms

# %% way: by differences
def capacitor(dt, ohms, farads, sigma):
    def step(state, w):
        volts, source = state
        source = source + w
        return np.array([source + (volts - source) * np.exp(-dt / (ohms * farads)), source])

    def meters(state):
        return np.array([state[0], (state[1] - state[0]) / ohms])

    units = np.eye(2)
    F = np.column_stack([step(unit, 0) - step(units[0] * 0, 0) for unit in units])
    w = step(units[0] * 0, 1)[:, None]
    return F, sigma**2 * dt * w @ w.T, np.column_stack([meters(unit) for unit in units])

# %% pasted: the lesson's cart
def capacitor(dt, ohms, farads, sigma):
    F = np.array([[1, dt], [0, 1]])
    Q = np.diag([0.02, 0.05]) ** 2
    H = np.array([[1.0, 0.0], [0.0, 1.0]])
    return F, Q, H

# %% pasted: the cart with a random push
def capacitor(dt, ohms, farads, sigma):
    F = np.array([[1, dt], [0, 1]])
    G = np.array([[dt**2 / 2], [dt]])
    return F, sigma**2 * G @ G.T, np.array([[1.0, 0.0], [1.0, 0.0]])

# %% pasted: nothing happens
def capacitor(dt, ohms, farads, sigma):
    return np.eye(2), sigma**2 * np.eye(2), np.eye(2)

# %% wrong: a little something on Q's diagonal, so that it can be inverted
def capacitor(dt, ohms, farads, sigma):
    left = np.exp(-dt / (ohms * farads))
    F = np.array([[left, 1 - left], [0, 1]])
    g = np.array([1 - left, 1])
    Q = np.outer(g, g) * sigma**2 * dt + 1e-4 * np.eye(2)
    return F, Q, np.array([[1, 0], [-1 / ohms, 1 / ohms]])

# %% wrong: share left computed by dividing through dt: nan for a step of no time
def capacitor(dt, ohms, farads, sigma):
    tau = ohms * farads
    rate = (1 - np.exp(-dt / tau)) / np.float64(dt)      # how much per second
    F = np.array([[1 - rate * dt, rate * dt], [0, 1]])
    g = np.array([rate * dt, 1])
    return F, sigma**2 * dt * np.outer(g, g), np.array([[1, 0], [-1 / ohms, 1 / ohms]])

# %% wrong: variance sigma squared, dt forgotten; current in volts
def capacitor(dt, ohms, farads, sigma):
    a = np.exp(-dt / (ohms * farads))
    F = np.array([[a, 1 - a], [0, 1]])
    b = np.array([1 - a, 1])
    return F, sigma ** 2 * np.outer(b, b), np.array([[1, 0], [-1, 1]])

# %% wrong: the current as the mean over the step, farads times change over dt, instead of at its end; fails at dt = 0
def capacitor(dt, ohms, farads, sigma):
    left = np.exp(-dt / (ohms * farads))
    F = np.array([[left, 1 - left], [0, 1]])
    w = sigma * np.sqrt(dt) * np.array([1 - left, 1.0])
    conductance = farads * (1 - left) / dt
    H = np.array([[1.0, 0.0], [-conductance, conductance]])
    return F, np.outer(w, w), H

# %% wrong: states in the other order
def capacitor(dt, ohms, farads, sigma):
    a = np.exp(-dt / (ohms * farads))
    F = np.array([[1, 0], [1 - a, a]])
    g = np.array([1.0, 1 - a])
    return F, np.outer(g, g) * sigma**2 * dt, np.array([[0, 1], [1 / ohms, -1 / ohms]])
