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
]
