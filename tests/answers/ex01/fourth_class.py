"""A fourth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "01-seen-from",
        "homogeneous matrices, the first one inverted",
        """
def seen_from(a, b):
    def T(p):
        return np.array([[np.cos(p[2]), -np.sin(p[2]), p[0]],
                         [np.sin(p[2]), np.cos(p[2]), p[1]], [0, 0, 1]])
    M = np.linalg.inv(T(a)) @ T(b)
    return [M[0, 2], M[1, 2], np.arctan2(M[1, 0], M[0, 0])]
""",
    ),
    (
        "01-miss",
        "each error's lever by a loop, sums of squares by hand",
        """
def miss(poses, length_error, heading_error):
    vx = vy = 0.0
    xe, ye = poses[-1][0], poses[-1][1]
    for k in range(1, len(poses)):
        dx, dy = poses[k][0] - poses[k - 1][0], poses[k][1] - poses[k - 1][1]
        vx += (length_error * dx) ** 2 + (heading_error * (ye - poses[k][1])) ** 2
        vy += (length_error * dy) ** 2 + (heading_error * (xe - poses[k][0])) ** 2
    return vx ** 0.5, vy ** 0.5
""",
    ),
]

WRONG = [
    (
        "01-next-pose",
        "the heading is wrapped by a single if that forgets the negative side",
        """
def next_pose(pose, step):
    x, y, t = pose
    f, l, turn = step
    t2 = t + turn
    if t2 > np.pi:
        t2 -= 2 * np.pi
    return np.array([x + f * np.cos(t) - l * np.sin(t), y + f * np.sin(t) + l * np.cos(t), t2])
""",
    ),
    (
        "01-next-pose",
        "into an array of whole numbers",
        """
def next_pose(pose, step):
    new = np.zeros(3, dtype=int)
    c, s = np.cos(pose[2]), np.sin(pose[2])
    new[0] = pose[0] + c * step[0] - s * step[1]
    new[1] = pose[1] + s * step[0] + c * step[1]
    new[2] = pose[2] + step[2]
    return new
""",
    ),
    (
        "01-next-pose",
        "2π is taken off whenever the heading is negative",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    return np.array([pose[0] + c * step[0] - s * step[1], pose[1] + s * step[0] + c * step[1],
                     (pose[2] + step[2]) % (2 * np.pi)])
""",
    ),
    (
        "01-next-pose",
        "prints and returns nothing",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    x = pose[0] + c * step[0] - s * step[1]
    y = pose[1] + s * step[0] + c * step[1]
    print(x, y, pose[2] + step[2])
""",
    ),
    (
        "01-seen-from",
        "only the difference in the world",
        """
def seen_from(a, b):
    d = b - a
    d[2] = (d[2] + np.pi) % (2 * np.pi) - np.pi
    return d
""",
    ),
    (
        "01-seen-from",
        "turned by the heading of b",
        """
def seen_from(a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    c, s = np.cos(b[2]), np.sin(b[2])
    t = b[2] - a[2]
    return np.array([c * dx + s * dy, -s * dx + c * dy, np.arctan2(np.sin(t), np.cos(t))])
""",
    ),
    (
        "01-seen-from",
        "polar: distance and direction in place of ahead and left",
        """
def seen_from(a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    t = b[2] - a[2]
    return np.array([np.hypot(dx, dy), np.arctan2(dy, dx) - a[2], np.arctan2(np.sin(t), np.cos(t))])
""",
    ),
    (
        "01-drift",
        "counts the error after the last step as bending one step more",
        """
def drift(n, d, sigma):
    return d * sigma * np.sqrt(sum(k ** 2 for k in range(1, n + 1)))
""",
    ),
    (
        "01-drift",
        "the levers are added, not their squares",
        """
def drift(n, d, sigma):
    return d * sigma * sum(range(n))
""",
    ),
    (
        "01-drift",
        "root of the sum of steps only",
        """
def drift(n, d, sigma):
    return sigma * d * np.sqrt(n * (n - 1) / 2)
""",
    ),
    (
        "01-drift",
        "divides by n for a mean",
        """
def drift(n, d, sigma):
    k = np.arange(n)
    return sigma * d * np.sqrt(np.mean(k ** 2))
""",
    ),
    (
        "01-miss",
        "the turn moves x by the way in x",
        """
def miss(poses, length_error, heading_error):
    p = poses[:, :2]
    d = np.diff(p, axis=0)
    lever = p[-1] - p[1:]
    return np.sqrt((length_error * d) ** 2 + (heading_error * lever) ** 2).sum(axis=0)
""",
    ),
    (
        "01-miss",
        "levers from the start of each step",
        """
def miss(poses, length_error, heading_error):
    p = poses[:, :2]
    d, lever = np.diff(p, axis=0), (p[-1] - p[:-1])[:, ::-1]
    v = (length_error * d) ** 2 + (heading_error * lever) ** 2
    return np.sqrt(v.sum(axis=0))
""",
    ),
    (
        "01-miss",
        "along the heading in place of the way",
        """
def miss(poses, length_error, heading_error):
    step = np.hypot(*np.diff(poses[:, :2], axis=0).T)
    t = poses[:-1, 2]
    d = np.column_stack([step * np.cos(t), step * np.sin(t)])
    lever = (poses[-1, :2] - poses[1:, :2])[:, ::-1]
    return np.sqrt(((length_error * d) ** 2 + (heading_error * lever) ** 2).sum(axis=0))
""",
    ),
    (
        "01-home",
        "docked poses are set, nothing between them is mended",
        """
def home(start, steps, docked):
    poses = track(start, steps)
    for k in docked:
        poses[k] = start
    return poses
""",
    ),
]
