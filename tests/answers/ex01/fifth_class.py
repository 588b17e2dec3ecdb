"""A fifth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "01-next-pose",
        "rounding the turns away with floor",
        """
def next_pose(pose, step):
    t = pose[2]
    M = np.array([[np.cos(t), -np.sin(t), 0], [np.sin(t), np.cos(t), 0], [0, 0, 1]])
    q = pose + M @ step
    q[2] -= 2 * np.pi * np.floor((q[2] + np.pi) / (2 * np.pi))
    return q
""",
    ),
]

WRONG = [
    (
        "01-seen-from",
        "the turn is not wrapped",
        """
def seen_from(a, b):
    dx, dy = b[:2] - a[:2]
    c, s = np.cos(a[2]), np.sin(a[2])
    return np.array([c * dx + s * dy, c * dy - s * dx, b[2] - a[2]])
""",
    ),
    (
        "01-miss",
        "np.std of the poses",
        """
def miss(poses, length_error, heading_error):
    return length_error * np.std(poses[:, 0]), heading_error * np.std(poses[:, 1])
""",
    ),
    (
        "01-drift",
        "sigma in degrees",
        """
def drift(n, d, sigma):
    return np.degrees(sigma) * d * np.sqrt(np.sum(np.arange(n) ** 2))
""",
    ),
    (
        "01-drift",
        "simulated with 2000 robots",
        """
def drift(n, d, sigma):
    rng = np.random.default_rng(0)
    e = np.cumsum(sigma * rng.standard_normal((2000, n)), axis=1)
    return np.std(d * np.sum(np.sin(e[:, :-1]), axis=1))
""",
    ),
    (
        "01-home",
        "linear closing in place only",
        """
def home(start, steps, docked):
    poses = track(start, steps)
    a = 0
    for b in docked:
        gap = start[:2] - poses[b, :2]
        n = b - a
        for k in range(1, n + 1):
            poses[a + k, :2] += gap * k / n
        poses[b + 1:, :2] += gap
        a = b
    return poses
""",
    ),
]
