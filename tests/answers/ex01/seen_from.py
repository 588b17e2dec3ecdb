"""Independent answers to 01-seen-from: right ones, and students' mistakes."""

RIGHT = [
    (
        "01-seen-from",
        "rotation matrix transposed",
        """
def seen_from(a, b):
    R = np.array([[np.cos(a[2]), -np.sin(a[2])], [np.sin(a[2]), np.cos(a[2])]])
    ahead, left = R.T @ (b[:2] - a[:2])
    turn = (b[2] - a[2] + np.pi) % (2 * np.pi) - np.pi
    return np.array([ahead, left, turn])
""",
    ),
    (
        "01-seen-from",
        "inverse of homogeneous matrices",
        """
def matrix(p):
    c, s = np.cos(p[2]), np.sin(p[2])
    return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])


def seen_from(a, b):
    M = np.linalg.inv(matrix(a)) @ matrix(b)
    return np.array([M[0, 2], M[1, 2], np.arctan2(M[1, 0], M[0, 0])])
""",
    ),
    (
        "01-seen-from",
        "distance and bearing",
        """
def seen_from(a, b):
    d = np.hypot(b[0] - a[0], b[1] - a[1])
    bearing = np.arctan2(b[1] - a[1], b[0] - a[0]) - a[2]
    turn = b[2] - a[2]
    if turn > np.pi:
        turn -= 2 * np.pi
    elif turn <= -np.pi:
        turn += 2 * np.pi
    return np.array([d * np.cos(bearing), d * np.sin(bearing), turn])
""",
    ),
]

WRONG = [
    (
        "01-seen-from",
        "not turned into a's frame",
        """
def seen_from(a, b):
    d = b - a
    return np.array([d[0], d[1], np.arctan2(np.sin(d[2]), np.cos(d[2]))])
""",
    ),
    (
        "01-seen-from",
        "rotated the wrong way",
        """
def seen_from(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    dx, dy, dt = b - a
    return np.array([c * dx - s * dy, s * dx + c * dy, np.arctan2(np.sin(dt), np.cos(dt))])
""",
    ),
    (
        "01-seen-from",
        "a seen from b",
        """
def seen_from(a, b):
    c, s = np.cos(b[2]), np.sin(b[2])
    dx, dy = a[0] - b[0], a[1] - b[1]
    turn = a[2] - b[2]
    return np.array([c * dx + s * dy, -s * dx + c * dy, np.arctan2(np.sin(turn), np.cos(turn))])
""",
    ),
    (
        "01-seen-from",
        "a minus b, in a's frame",
        """
def seen_from(a, b):
    d = a[:2] - b[:2]
    c, s = np.cos(a[2]), np.sin(a[2])
    t = np.angle(np.exp(1j * (b[2] - a[2])))
    return np.array([d @ [c, s], d @ [-s, c], t])
""",
    ),
    (
        "01-seen-from",
        "turned by b's heading",
        """
def seen_from(a, b):
    c, s = np.cos(b[2]), np.sin(b[2])
    R = np.array([[c, s], [-s, c]])
    xy = R @ (b - a)[:2]
    t = b[2] - a[2]
    return np.array([xy[0], xy[1], np.arctan2(np.sin(t), np.cos(t))])
""",
    ),
    (
        "01-seen-from",
        "turn not wrapped",
        """
def seen_from(a, b):
    delta = b - a
    u = np.array([np.cos(a[2]), np.sin(a[2])])
    v = np.array([-u[1], u[0]])
    return np.array([u @ delta[:2], v @ delta[:2], delta[2]])
""",
    ),
    (
        "01-seen-from",
        "turn is the bearing of b, not its heading",
        """
def seen_from(a, b):
    dx, dy = b[:2] - a[:2]
    r = np.hypot(dx, dy)
    bearing = np.arctan2(dy, dx) - a[2]
    bearing = np.arctan2(np.sin(bearing), np.cos(bearing))
    return np.array([r * np.cos(bearing), r * np.sin(bearing), bearing])
""",
    ),
    (
        "01-seen-from",
        "arctan instead of arctan2, and division by zero in one place",
        """
def seen_from(a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    d = np.sqrt(dx ** 2 + dy ** 2)
    bearing = np.arctan(dy / dx) - a[2]
    turn = b[2] - a[2]
    return np.array([d * np.cos(bearing), d * np.sin(bearing), np.arctan2(np.sin(turn), np.cos(turn))])
""",
    ),
    (
        "01-seen-from",
        "next_pose with the negated pose",
        """
def seen_from(a, b):
    return next_pose(-a, b)
""",
    ),
    (
        "01-seen-from",
        "returns left before ahead",
        """
def seen_from(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    dx, dy = b[0] - a[0], b[1] - a[1]
    turn = b[2] - a[2]
    return np.array([-s * dx + c * dy, c * dx + s * dy, np.arctan2(np.sin(turn), np.cos(turn))])
""",
    ),
    (
        "01-seen-from",
        "wrapped to 0..2pi",
        """
def seen_from(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    ahead, left = np.array([[c, s], [-s, c]]) @ (b[:2] - a[:2])
    return np.array([ahead, left, np.mod(b[2] - a[2], 2 * np.pi)])
""",
    ),
    (
        "01-seen-from",
        "wraps with arcsin",
        """
def seen_from(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    ahead, left = np.array([[c, s], [-s, c]]) @ (b[:2] - a[:2])
    return np.array([ahead, left, np.arcsin(np.sin(b[2] - a[2]))])
""",
    ),
    (
        "01-seen-from",
        "subtracts in place, changes b",
        """
def seen_from(a, b):
    b -= a
    c, s = np.cos(a[2]), np.sin(a[2])
    return np.array([c * b[0] + s * b[1], c * b[1] - s * b[0], np.arctan2(np.sin(b[2]), np.cos(b[2]))])
""",
    ),
]
