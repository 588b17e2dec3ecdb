"""A seventh class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "13-icp",
        "pairs by brute force, moved by steps",
        """
def icp(source, target, T, rounds):
    at = carry(T, source.astype(float))
    for _ in range(rounds):
        far = ((at[:, None] - target[None]) ** 2).sum(axis=2)
        M = best_motion(at, target[far.argmin(axis=1)])
        at, T = carry(M, at), M @ T
    return T
""",
    ),
    (
        "13-line-step",
        "a Kalman update for one wall after the other",
        """
def line_step(source, target, normals, sigma, T, Q):
    delta, P = np.zeros(3), np.array(Q, dtype=float)
    for a, b, n, s in zip(source, target, normals, sigma):
        e = n @ (T[:2, :2] @ a + T[:2, 2] - b)
        m = T[:2, :2].T @ n
        J = np.array([m[0], m[1], m @ [-a[1], a[0]]])
        S = J @ P @ J + s**2
        K = P @ J / S
        delta = delta - K * (e + J @ delta)
        P = P - np.outer(K, K) * S
    return delta, P
""",
    ),
]

WRONG = [
    (
        "13-best-motion",
        "the turn of the main axes of both clouds",
        """
def best_motion(source, target):
    def main(points):
        w, V = np.linalg.eigh(np.cov(points.T))
        return np.arctan2(V[1, -1], V[0, -1])
    angle = main(target) - main(source)
    c, s = np.cos(angle), np.sin(angle)
    Rot = np.array([[c, -s], [s, c]])
    T = np.eye(3)
    T[:2, :2], T[:2, 2] = Rot, target.mean(axis=0) - Rot @ source.mean(axis=0)
    return T
""",
    ),
    (
        "13-best-motion",
        "small-angle Gauss-Newton, three rounds from no turn",
        """
def best_motion(source, target):
    theta, t = 0.0, np.zeros(2)
    for _ in range(3):
        c, s = np.cos(theta), np.sin(theta)
        Rot, dRot = np.array([[c, -s], [s, c]]), np.array([[-s, -c], [c, -s]])
        e = (source @ Rot.T + t - target).ravel()
        J = np.zeros((len(e), 3))
        J[0::2, 0] = J[1::2, 1] = 1
        J[:, 2] = (source @ dRot.T).ravel()
        step = -np.linalg.lstsq(J, e, rcond=None)[0]
        t, theta = t + step[:2], theta + step[2]
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, t[0]], [s, c, t[1]], [0, 0, 1]])
""",
    ),
    (
        "13-icp",
        "until the pairs no longer change",
        """
def icp(source, target, T, rounds):
    last = None
    for _ in range(rounds + 1):
        _, row = nearest(carry(T, source), target)
        if last is not None and np.array_equal(row, last):
            return T
        T = best_motion(source, target[row])
        last = row
    return T
""",
    ),
    (
        "13-icp",
        "every target point looks for its source point",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        at = carry(T, source)
        _, row = nearest(target, at)
        T = best_motion(source[row], target)
    return T
""",
    ),
    (
        "13-trimmed",
        "the share is kept of what was kept in the round before",
        """
def trimmed_icp(source, target, T, rounds, share):
    rows = np.arange(len(source))
    for _ in range(rounds):
        d, near = nearest(carry(T, source[rows]), target)
        order = np.argsort(d)[: max(2, int(share * len(rows)))]
        T = best_motion(source[rows[order]], target[near[order]])
        rows = rows[order]
    return T
""",
    ),
    (
        "13-trimmed",
        "a share of the target's points",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(target))
    for _ in range(rounds):
        d, row = nearest(carry(T, source), target)
        best = np.argsort(d)[:keep]
        T = best_motion(source[best], target[row[best]])
    return T
""",
    ),
    (
        "13-line-step",
        "in the target's frame, and the step turned into the robot's at the end",
        """
def line_step(source, target, normals, sigma, T, Q):
    at = carry(T, source)
    e = np.sum(normals * (at - target), axis=1)
    J = np.column_stack([normals, at[:, 0] * normals[:, 1] - at[:, 1] * normals[:, 0]])
    L = J.T @ (J / sigma[:, None] ** 2) + np.linalg.inv(Q)
    P = np.linalg.inv(L)
    delta = -P @ J.T @ (e / sigma**2)
    back = np.eye(3)
    back[:2, :2] = T[:2, :2].T
    return back @ delta, back @ P @ back.T
""",
    ),
    (
        "13-overlap",
        "turn by a histogram of normals, then trimmed ICP",
        """
def match(source, target, T):
    def histogram(points):
        n = normals_of(points)
        angles = np.arctan2(n[:, 1], n[:, 0])
        return np.histogram(angles, 72, (-np.pi, np.pi))[0]
    a, b = histogram(source), histogram(target)
    shift = np.argmax([np.roll(a, k) @ b for k in range(72)])
    start = T.copy()
    start[:2, :2] = turned(shift * np.pi / 36)
    return trimmed_icp(source, target, start, 40, 0.6)
""",
    ),
]
