"""Independent answers to 12-odometry: right ones, and students' mistakes."""

RIGHT = [
    (
        "12-odometry",
        "radius of the arc, straight apart",
        """
def odometry(left, right, tick, base):
    d = (left + right) * tick / 2
    turn = (right - left) * tick / base
    if left == right:
        return np.array([d, 0.0, 0.0])
    radius = d / turn
    return np.array([radius * np.sin(turn), radius * (1 - np.cos(turn)), turn])
""",
    ),
    (
        "12-odometry",
        "chord by hand, theta wrapped at the end",
        """
def odometry(left, right, tick, base):
    l, r = tick * left, tick * right
    half = (r - l) / base / 2
    d = 0.5 * (l + r)
    ratio = np.sin(half) / half if half != 0 else 1.0
    return np.array([d * ratio * np.cos(half), d * ratio * np.sin(half), float(wrap(2 * half))])
""",
    ),
]

WRONG = [
    (
        "12-odometry",
        "drives d straight along the new heading",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    d, turn = (l + r) / 2, (r - l) / base
    return np.array([d * np.cos(turn), d * np.sin(turn), turn])
""",
    ),
    (
        "12-odometry",
        "length of the arc along half the turn, no chord",
        """
def odometry(left, right, tick, base):
    d = (left + right) / 2 * tick
    turn = (right - left) * tick / base
    return np.array([d * np.cos(turn / 2), d * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "0/0 when it drives straight on",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    d, turn = (l + r) / 2, (r - l) / base
    chord = d * np.sin(turn / 2) / (turn / 2)
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "small turns count as straight",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    d, turn = (l + r) / 2, (r - l) / base
    if abs(turn) < 1e-2:
        return np.array([d, 0.0, 0.0])
    radius = d / turn
    return np.array([radius * np.sin(turn), radius * (1 - np.cos(turn)), turn])
""",
    ),
    (
        "12-odometry",
        "turns to the wrong side",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    turn = (l - r) / base
    chord = (l + r) / 2 * np.sinc(turn / (2 * np.pi))
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "half the base",
        """
def odometry(left, right, tick, base):
    d = tick * (left + right) / 2
    turn = tick * (right - left) / (base / 2)
    if turn == 0:
        return np.array([d, 0, 0])
    return np.array([d / turn * np.sin(turn), d / turn * (1 - np.cos(turn)), turn])
""",
    ),
    (
        "12-odometry",
        "np.sinc without the pi",
        """
def odometry(left, right, tick, base):
    d = (left + right) * tick / 2
    turn = (right - left) * tick / base
    chord = d * np.sinc(turn / 2)
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "wraps the turn before the arc: wrong beyond half a round",
        """
def odometry(left, right, tick, base):
    d = (left + right) * tick / 2
    turn = float(wrap((right - left) * tick / base))
    chord = d * np.sinc(turn / 2 / np.pi)
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "turn from ticks, not metres",
        """
def odometry(left, right, tick, base):
    d = (left + right) / 2 * tick
    turn = (right - left) / base
    chord = d * np.sinc(turn / (2 * np.pi))
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "chord points along the whole turn",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    turn = (r - l) / base
    half = turn / 2
    chord = (l + r) / 2 if turn == 0 else (l + r) / 2 * np.sin(half) / half
    return np.array([chord * np.cos(turn), chord * np.sin(turn), turn])
""",
    ),
    (
        "12-odometry",
        "sideways way has the wrong sign",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    d, turn = (l + r) / 2, (r - l) / base
    if turn == 0:
        return np.array([d, 0.0, 0.0])
    R = d / turn
    return np.array([R * np.sin(turn), R * (np.cos(turn) - 1), turn])
""",
    ),
    (
        "12-odometry",
        "returns at once when a wheel stands still",
        """
def odometry(left, right, tick, base):
    if not left or not right:
        return np.zeros(3)
    l, r = left * tick, right * tick
    turn = (r - l) / base
    chord = (l + r) / 2 * np.sinc(turn / (2 * np.pi))
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "ten little straight steps",
        """
def odometry(left, right, tick, base):
    x = y = theta = 0.0
    for _ in range(10):
        d = (left + right) * tick / 20
        theta += (right - left) * tick / base / 10
        x += d * np.cos(theta)
        y += d * np.sin(theta)
    return np.array([x, y, theta])
""",
    ),
    (
        "12-odometry",
        "rolling backwards taken as forwards",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    d, turn = abs(l + r) / 2, (r - l) / base
    chord = d * np.sinc(turn / (2 * np.pi))
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
]
