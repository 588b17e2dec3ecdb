"""A fifth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "05-map",
        "classes and setdefault",
        """
class Mark:
    def __init__(self, x, z, R):
        J = J_z(x, z)
        self.p, self.P = g(x, z), J @ R @ J.T
    def again(self, x, z, R):
        self.p, self.P = update_landmark(self.p, self.P, x, z, R)
def build_map(xs, ids, zs, R):
    marks = {}
    for k in range(len(ids)):
        if ids[k] in marks:
            marks[ids[k]].again(xs[k], zs[k], R)
        else:
            marks[ids[k]] = Mark(xs[k], zs[k], R)
    return {int(i): (m.p, m.P) for i, m in marks.items()}
""",
    ),
]

WRONG = [
    (
        "05-ranges",
        "independent updates with new Jacobians",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    for r, b in zip(rs, beacons):
        c, s = np.cos(x[2]), np.sin(x[2])
        arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
        d = x[:2] + arm - b
        n = np.hypot(*d)
        H = np.array([d[0], d[1], d[1] * arm[0] - d[0] * arm[1]]) / n
        S = H @ P @ H + sigma ** 2
        K = P @ H / S
        x, P = x + K * (r - n), P - np.outer(K, K) * S
    return x, P
""",
    ),
    (
        "05-localise",
        "the start is not used",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    x, P, xs, Ps = np.zeros(3), np.eye(3), [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
]
