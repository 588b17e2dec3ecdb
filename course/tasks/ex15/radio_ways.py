"""Right ways through 15-range."""

MATRICES = """
def range_edge(x_i, x_j, r, a_i, a_j):
    def R(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    quarter = np.array([[0.0, -1.0], [1.0, 0.0]])
    arm_i, arm_j = R(x_i[2]) @ a_i, R(x_j[2]) @ a_j
    d = (x_j[:2] + arm_j) - (x_i[:2] + arm_i)
    distance = np.linalg.norm(d)
    u = d / distance
    turn_i, turn_j = u @ quarter @ arm_i, u @ quarter @ arm_j
    A = np.append(-u, -turn_i)
    B = np.append(u, turn_j)
    return distance - r, A, B
"""

WAYS = {
    "matrices": MATRICES,
    "differences": """
def range_edge(x_i, x_j, r, a_i, a_j):
    def e(x_i, x_j):
        ends = []
        for x, a in ((x_i, a_i), (x_j, a_j)):
            ends.append(compose(x, np.array([a[0], a[1], 0.0]))[:2])
        return np.linalg.norm(ends[1] - ends[0]) - r

    H = 1e-6 * np.eye(3)
    A = [(e(x_i + h, x_j) - e(x_i - h, x_j)) / 2e-6 for h in H]
    B = [(e(x_i, x_j + h) - e(x_i, x_j - h)) / 2e-6 for h in H]
    return e(x_i, x_j), np.array(A), np.array(B)
""",
    "one-sided differences": """
def range_edge(x_i, x_j, r, a_i, a_j):
    def distance(x_i, x_j):
        way = complex(*x_j[:2]) + complex(*a_j) * np.exp(1j * x_j[2])
        way -= complex(*x_i[:2]) + complex(*a_i) * np.exp(1j * x_i[2])
        return abs(way)

    now, H = distance(x_i, x_j), 1e-7 * np.eye(3)
    A = [(distance(x_i + h, x_j) - now) / 1e-7 for h in H]
    B = [(distance(x_i, x_j + h) - now) / 1e-7 for h in H]
    return [now - r, A, B]
""",
    "the chain rule": """
def range_edge(x_i, x_j, r, a_i, a_j):
    rows = []
    ends = []
    for x, a in ((x_i, a_i), (x_j, a_j)):
        c, s = np.cos(x[2]), np.sin(x[2])
        ends.append(x[:2] + np.array([[c, -s], [s, c]]) @ a)
        rows.append(np.column_stack([np.eye(2), np.array([[-s, -c], [c, -s]]) @ a]))
    d = ends[1] - ends[0]
    by_d = d / np.sqrt(d @ d)
    return np.sqrt(d @ d) - r, -by_d @ rows[0], by_d @ rows[1]
""",
    "by the angle of sight": """
def range_edge(x_i, x_j, r, a_i, a_j):
    radio_i, radio_j = (compose(x, [*a, 0.0]) for x, a in ((x_i, a_i), (x_j, a_j)))
    dx, dy = (radio_j - radio_i)[:2]
    sight = np.arctan2(dy, dx)
    long_i, long_j = np.hypot(*a_i), np.hypot(*a_j)
    at_i = x_i[2] + np.arctan2(a_i[1], a_i[0])
    at_j = x_j[2] + np.arctan2(a_j[1], a_j[0])
    A = np.array([-np.cos(sight), -np.sin(sight), -long_i * np.sin(sight - at_i)])
    B = np.array([np.cos(sight), np.sin(sight), long_j * np.sin(sight - at_j)])
    return np.hypot(dx, dy) - r, A, B
""",
    "in the frame of pose i": """
def range_edge(x_i, x_j, r, a_i, a_j):
    seen = between(x_i, compose(x_j, [*a_j, 0.0]))[:2]
    x, y = seen - a_i
    distance = np.hypot(x, y)
    along = np.array([x, y]) / distance
    c, s = np.cos(x_i[2]), np.sin(x_i[2])
    u = np.array([c * along[0] - s * along[1], s * along[0] + c * along[1]])
    A = np.array([-u[0], -u[1], (x * seen[1] - y * seen[0]) / distance])
    there = compose(x_j, [*a_j, 0.0])[:2] - x_j[:2]
    return distance - r, A, np.array([u[0], u[1], u[1] * there[0] - u[0] * there[1]])
""",
}
