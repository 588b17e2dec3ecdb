# %% way: by the radius of the arc
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    turn = (r - l) / base
    if abs(turn) < 1e-9:
        return [(l + r) / 2, 0.0, 0.0]
    radius = (l + r) / 2 / turn
    return [radius * np.sin(turn), radius * (1 - np.cos(turn)), turn]

# %% way: in many little steps
def odometry(left, right, tick, base):
    steps = 1000
    d, turn = (left + right) / 2 * tick / steps, (right - left) * tick / base / steps
    heading = turn * (np.arange(steps) + 0.5)
    return np.array([d * np.cos(heading).sum(), d * np.sin(heading).sum(), turn * steps])

# %% way: heading wrapped
def odometry(left, right, tick, base):
    d, turn = (left + right) * tick / 2, (right - left) * tick / base
    chord = d * np.sinc(turn / (2 * np.pi))
    pose = chord * np.exp(1j * turn / 2)
    return pose.real, pose.imag, np.angle(np.exp(1j * turn))

# %% way: by the exponential of a matrix
def odometry(left, right, tick, base):
    from scipy.linalg import expm
    l, r = left * tick, right * tick
    turn = (r - l) / base
    T = expm(np.array([[0, -turn, (l + r) / 2], [turn, 0, 0], [0, 0, 0]]))
    return np.array([T[0, 2], T[1, 2], turn])

# %% way: integrated
def odometry(left, right, tick, base):
    from scipy.integrate import quad
    d, turn = (left + right) * tick / 2, (right - left) * tick / base
    x, _ = quad(lambda s: d * np.cos(s * turn), 0, 1)
    y, _ = quad(lambda s: d * np.sin(s * turn), 0, 1)
    return np.array([x, y, turn])

# %% way: about the middle of the curve
def odometry(left, right, tick, base):
    if left == right:
        return np.array([left * tick, 0.0, 0.0])
    R = base / 2 * (right + left) / (right - left)
    w = (right - left) * tick / base
    turned = np.array([[np.cos(w), -np.sin(w)], [np.sin(w), np.cos(w)]])
    at = turned @ np.array([0, -R]) + np.array([0, R])
    return np.append(at, w)

# %% right: chord by hand, theta wrapped at the end
def odometry(left, right, tick, base):
    l, r = tick * left, tick * right
    half = (r - l) / base / 2
    d = 0.5 * (l + r)
    ratio = np.sin(half) / half if half != 0 else 1.0
    return np.array([d * ratio * np.cos(half), d * ratio * np.sin(half), float(wrap(2 * half))])

# %% wrong: returns at once when a wheel stands still
def odometry(left, right, tick, base):
    if not left or not right:
        return np.zeros(3)
    l, r = left * tick, right * tick
    turn = (r - l) / base
    chord = (l + r) / 2 * np.sinc(turn / (2 * np.pi))
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
