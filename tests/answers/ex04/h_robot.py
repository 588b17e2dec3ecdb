"""Independent answers to 04-h-robot: right ones, and students' mistakes."""

RIGHT = [
    (
        "04-h-robot",
        "polar form",
        """
def H_robot(x, p):
    offset = np.asarray(p, float) - np.asarray(x, float)[:2]
    r = np.linalg.norm(offset)
    phi = np.arctan2(offset[1], offset[0])
    H = np.zeros((2, 3))
    H[0, :2] = -np.cos(phi), -np.sin(phi)
    H[1, :2] = np.sin(phi) / r, -np.cos(phi) / r
    H[1, 2] = -1
    return H
""",
    ),
    (
        "04-h-robot",
        "central differences of h, bearing's difference wrapped",
        """
def H_robot(x, p):
    columns = []
    for i in range(3):
        e = np.zeros(3)
        e[i] = 1e-6
        change = h(x + e, p) - h(x - e, p)
        change[1] = (change[1] + np.pi) % (2 * np.pi) - np.pi
        columns.append(change / 2e-6)
    return np.array(columns).T
""",
    ),
    (
        "04-h-robot",
        "stacked from unit vector and its quarter turn",
        """
def H_robot(x, p):
    n = p - x[:2]
    r = np.hypot(*n)
    n = n / r
    side = np.array([-n[1], n[0]])
    return np.vstack([np.append(-n, 0), np.append(-side / r, -1)])
""",
    ),
]

WRONG = [
    (
        "04-h-robot",
        "sign of the bearing by y",
        """
def H_robot(x, p):
    dx, dy = p[0] - x[0], p[1] - x[1]
    q = dx**2 + dy**2
    r = np.sqrt(q)
    return np.array([[-dx / r, -dy / r, 0], [dy / q, dx / q, -1]])
""",
    ),
    (
        "04-h-robot",
        "derivatives by the landmark instead of by the robot",
        """
def H_robot(x, p):
    d = p - x[:2]
    r = np.linalg.norm(d)
    return np.array([[d[0] / r, d[1] / r, 0], [-d[1] / r**2, d[0] / r**2, -1]])
""",
    ),
    (
        "04-h-robot",
        "offset taken from the landmark to the robot, formula of the other",
        """
def H_robot(x, p):
    dx, dy = x[:2] - p
    r = np.hypot(dx, dy)
    H = np.zeros((2, 3))
    H[0] = [-dx / r, -dy / r, 0]
    H[1] = [dy / r**2, -dx / r**2, -1]
    return H
""",
    ),
    (
        "04-h-robot",
        "second row divided by r, not r squared",
        """
def H_robot(x, p):
    phi = np.arctan2(p[1] - x[1], p[0] - x[0])
    return np.array([[-np.cos(phi), -np.sin(phi), 0], [np.sin(phi), -np.cos(phi), -1]])
""",
    ),
    (
        "04-h-robot",
        "turning is forgotten: last column zero",
        """
def H_robot(x, p):
    d = p - x[:2]
    q = d @ d
    H = np.zeros((2, 3))
    H[0, :2] = -d / np.sqrt(q)
    H[1, :2] = d[1] / q, -d[0] / q
    return H
""",
    ),
    (
        "04-h-robot",
        "turning left makes the bearing grow",
        """
def H_robot(x, p):
    d = p - x[:2]
    q = d @ d
    top = np.append(-d / np.sqrt(q), 0)
    bottom = np.array([d[1] / q, -d[0] / q, 1.0])
    return np.stack([top, bottom])
""",
    ),
    (
        "04-h-robot",
        "r without the root",
        """
def H_robot(x, p):
    dx, dy = p - x[:2]
    r = dx**2 + dy**2
    return np.array([[-dx / r, -dy / r, 0], [dy / r**2, -dx / r**2, -1]])
""",
    ),
    (
        "04-h-robot",
        "offset turned into the robot's frame",
        """
def H_robot(x, p):
    r, beta = h(x, p)
    return np.array([
        [-np.cos(beta), -np.sin(beta), 0],
        [np.sin(beta) / r, -np.cos(beta) / r, -1],
    ])
""",
    ),
    (
        "04-h-robot",
        "differences of h, bearing not wrapped: fails straight behind",
        """
def H_robot(x, p):
    H, step = np.zeros((2, 3)), 1e-6
    for j in range(3):
        e = np.zeros(3)
        e[j] = step
        H[:, j] = (h(x + e, p) - h(x - e, p)) / (2 * step)
    return H
""",
    ),
    (
        "04-h-robot",
        "one-sided differences with a coarse step of 1 cm",
        """
def H_robot(x, p):
    H = []
    for step in 0.01 * np.eye(3):
        diff = h(x + step, p) - h(x, p)
        diff[1] = (diff[1] + np.pi) % (2 * np.pi) - np.pi
        H.append(diff / 0.01)
    return np.array(H).T
""",
    ),
    (
        "04-h-robot",
        "differentiates arctan of a quotient: divides by zero at dx = 0",
        """
def H_robot(x, p):
    dx, dy = p[0] - x[0], p[1] - x[1]
    r = np.sqrt(dx**2 + dy**2)
    t = dy / dx
    inner = 1 / (1 + t**2)
    return np.array([[-dx / r, -dy / r, 0], [inner * dy / dx**2, -inner / dx, -1]])
""",
    ),
    (
        "04-h-robot",
        "changes p in place",
        """
def H_robot(x, p):
    p -= x[:2]
    r = np.sqrt(p[0] ** 2 + p[1] ** 2)
    return np.array([[-p[0] / r, -p[1] / r, 0], [p[1] / r**2, -p[0] / r**2, -1]])
""",
    ),
    (
        "04-h-robot",
        "a guard against division by zero that bites near landmarks",
        """
def H_robot(x, p):
    dx, dy = p[0] - x[0], p[1] - x[1]
    r = max(np.hypot(dx, dy), 0.5)
    return np.array([[-dx / r, -dy / r, 0], [dy / r**2, -dx / r**2, -1]])
""",
    ),
    (
        "04-h-robot",
        "transposed: one row for x, y, theta",
        """
def H_robot(x, p):
    dx, dy = p - x[:2]
    q = dx * dx + dy * dy
    r = q**0.5
    by_x = [-dx / r, dy / q]
    by_y = [-dy / r, -dx / q]
    by_theta = [0, -1]
    return np.array([by_x, by_y, by_theta])
""",
    ),
    (
        "04-h-robot",
        "distances without sign (abs)",
        """
def H_robot(x, p):
    dx, dy = np.abs(np.asarray(p) - x[:2])
    r = np.sqrt(dx**2 + dy**2)
    return np.array([[-dx / r, -dy / r, 0], [dy / r**2, -dx / r**2, -1]])
""",
    ),
    (
        "04-h-robot",
        "folds bearings of landmarks behind the robot to the front",
        """
def H_robot(x, p):
    d = p - x[:2]
    r = np.sqrt(d @ d)
    phi = np.arctan(d[1] / d[0]) if d[0] != 0 else np.pi / 2 * np.sign(d[1])
    c, s = np.cos(phi), np.sin(phi)
    return np.array([[-c, -s, 0], [s / r, -c / r, -1]])
""",
    ),
    (
        "04-h-robot",
        "bearing's row in degrees",
        """
def H_robot(x, p):
    dx, dy = p - x[:2]
    q = dx**2 + dy**2
    range_row = np.array([-dx, -dy, 0]) / np.sqrt(q)
    bearing_row = np.degrees(np.array([dy / q, -dx / q, -1]))
    return np.array([range_row, bearing_row])
""",
    ),
]
