"""A third class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "01-next-pose",
        "complex numbers",
        """
def next_pose(pose, step):
    z = complex(pose[0], pose[1]) + complex(step[0], step[1]) * np.exp(1j * pose[2])
    return np.array([z.real, z.imag, np.angle(np.exp(1j * (pose[2] + step[2])))])
""",
    ),
    (
        "01-drift",
        "each robot's end as a matrix of errors",
        """
def drift(n, d, sigma):
    A = np.tril(np.ones((n, n)), -1)
    return float(sigma * d * np.sqrt(np.sum(A.sum(axis=0) ** 2)))
""",
    ),
]

WRONG = [
    (
        "01-next-pose",
        "half of the turn is made before the way",
        """
def next_pose(pose, step):
    t = pose[2] + step[2] / 2
    c, s = np.cos(t), np.sin(t)
    return np.array([pose[0] + c * step[0] - s * step[1], pose[1] + s * step[0] + c * step[1],
                     (pose[2] + step[2] + np.pi) % (2 * np.pi) - np.pi])
""",
    ),
    (
        "01-next-pose",
        "only the forward part",
        """
def next_pose(pose, step):
    t = (pose[2] + step[2] + np.pi) % (2 * np.pi) - np.pi
    return np.array([pose[0] + step[0] * np.cos(pose[2]), pose[1] + step[0] * np.sin(pose[2]), t])
""",
    ),
    (
        "01-next-pose",
        "goes the length of the step straight ahead",
        """
def next_pose(pose, step):
    way = np.hypot(step[0], step[1])
    x = pose[0] + way * np.cos(pose[2])
    y = pose[1] + way * np.sin(pose[2])
    theta = pose[2] + step[2]
    return np.array([x, y, np.arctan2(np.sin(theta), np.cos(theta))])
""",
    ),
    (
        "01-next-pose",
        "left is taken for right",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    theta = pose[2] + step[2]
    x = pose[0] + c * step[0] + s * step[1]
    y = pose[1] + s * step[0] - c * step[1]
    return np.array([x, y, np.arctan2(np.sin(theta), np.cos(theta))])
""",
    ),
    (
        "01-next-pose",
        "turn taken off",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    theta = pose[2] - step[2]
    return np.array([pose[0] + c * step[0] - s * step[1], pose[1] + s * step[0] + c * step[1],
                     np.arctan2(np.sin(theta), np.cos(theta))])
""",
    ),
    (
        "01-next-pose",
        "heading by arctan of the tangent",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    theta = np.arctan(np.tan(pose[2] + step[2]))
    return np.array([pose[0] + c * step[0] - s * step[1], pose[1] + s * step[0] + c * step[1],
                     theta])
""",
    ),
    (
        "01-next-pose",
        "wraps with one if only",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    theta = pose[2] + step[2]
    if theta > np.pi:
        theta = theta - 2 * np.pi
    return np.array([pose[0] + c * step[0] - s * step[1], pose[1] + s * step[0] + c * step[1],
                     theta])
""",
    ),
    (
        "01-next-pose",
        "clips the heading",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    theta = np.clip(pose[2] + step[2], -np.pi, np.pi)
    return np.array([pose[0] + c * step[0] - s * step[1], pose[1] + s * step[0] + c * step[1],
                     theta])
""",
    ),
    (
        "01-next-pose",
        "fmod keeps what is beyond π",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    theta = np.fmod(pose[2] + step[2], np.pi)
    return np.array([pose[0] + c * step[0] - s * step[1], pose[1] + s * step[0] + c * step[1],
                     theta])
""",
    ),
    (
        "01-next-pose",
        "rounded to millimetres",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    theta = pose[2] + step[2]
    theta = np.arctan2(np.sin(theta), np.cos(theta))
    return np.round([pose[0] + c * step[0] - s * step[1], pose[1] + s * step[0] + c * step[1],
                     theta], 3)
""",
    ),
    (
        "01-seen-from",
        "a as seen from b",
        """
def seen_from(a, b):
    a, b = b, a
    d, t = b[:2] - a[:2], b[2] - a[2]
    c, s = np.cos(a[2]), np.sin(a[2])
    return np.array([c * d[0] + s * d[1], -s * d[0] + c * d[1], np.arctan2(np.sin(t), np.cos(t))])
""",
    ),
    (
        "01-seen-from",
        "turned by b's heading",
        """
def seen_from(a, b):
    d, t = b[:2] - a[:2], b[2] - a[2]
    c, s = np.cos(b[2]), np.sin(b[2])
    return np.array([c * d[0] + s * d[1], -s * d[0] + c * d[1], np.arctan2(np.sin(t), np.cos(t))])
""",
    ),
    (
        "01-seen-from",
        "turned by the difference of headings",
        """
def seen_from(a, b):
    d, t = b[:2] - a[:2], b[2] - a[2]
    c, s = np.cos(t), np.sin(t)
    return np.array([c * d[0] + s * d[1], -s * d[0] + c * d[1], np.arctan2(np.sin(t), np.cos(t))])
""",
    ),
    (
        "01-seen-from",
        "not turned at all",
        """
def seen_from(a, b):
    d = b - a
    d[2] = np.arctan2(np.sin(d[2]), np.cos(d[2]))
    return d
""",
    ),
    (
        "01-seen-from",
        "range and bearing",
        """
def seen_from(a, b):
    d, t = b[:2] - a[:2], b[2] - a[2]
    return np.array([np.hypot(*d), np.arctan2(d[1], d[0]) - a[2],
                     np.arctan2(np.sin(t), np.cos(t))])
""",
    ),
    (
        "01-seen-from",
        "turn is the direction of b",
        """
def seen_from(a, b):
    d = b[:2] - a[:2]
    c, s = np.cos(a[2]), np.sin(a[2])
    t = np.arctan2(d[1], d[0]) - a[2]
    return np.array([c * d[0] + s * d[1], -s * d[0] + c * d[1], np.arctan2(np.sin(t), np.cos(t))])
""",
    ),
    (
        "01-seen-from",
        "next_pose with minus signs",
        """
def seen_from(a, b):
    return next_pose(b, -a)
""",
    ),
    (
        "01-seen-from",
        "bearing from arcsin of the wanted turn",
        """
def seen_from(a, b):
    d = b[:2] - a[:2]
    c, s = np.cos(a[2]), np.sin(a[2])
    return np.array([c * d[0] + s * d[1], -s * d[0] + c * d[1], np.arcsin(np.sin(b[2] - a[2]))])
""",
    ),
    (
        "01-seen-from",
        "smaller of turn and its rest, without a sign",
        """
def seen_from(a, b):
    d = b[:2] - a[:2]
    c, s = np.cos(a[2]), np.sin(a[2])
    t = abs(b[2] - a[2])
    return np.array([c * d[0] + s * d[1], -s * d[0] + c * d[1], min(t, 2 * np.pi - t)])
""",
    ),
    (
        "01-seen-from",
        "left axis mirrored",
        """
def seen_from(a, b):
    d, t = b[:2] - a[:2], b[2] - a[2]
    c, s = np.cos(a[2]), np.sin(a[2])
    return np.array([c * d[0] + s * d[1], s * d[0] - c * d[1], np.arctan2(np.sin(t), np.cos(t))])
""",
    ),
    (
        "01-drift",
        "random walk of the heading, times the way",
        """
def drift(n, d, sigma):
    return float(sigma * np.sqrt(n) * n * d)
""",
    ),
    (
        "01-drift",
        "errors add up with their signs",
        """
def drift(n, d, sigma):
    return float(sum(sigma * d * (n - k) for k in range(1, n + 1)))
""",
    ),
    (
        "01-drift",
        "first error bends the first step as well",
        """
def drift(n, d, sigma):
    return float(sigma * d * np.sqrt(sum(k * k for k in range(1, n + 1))))
""",
    ),
    (
        "01-drift",
        "variance for the deviation",
        """
def drift(n, d, sigma):
    return float(sigma**2 * d**2 * sum(k * k for k in range(n)))
""",
    ),
    (
        "01-drift",
        "the steps' sideways parts as if independent",
        """
def drift(n, d, sigma):
    return float(d * sigma * np.sqrt(sum(k for k in range(n))))
""",
    ),
    (
        "01-drift",
        "integral for the sum",
        """
def drift(n, d, sigma):
    return float(sigma * d * np.sqrt(n**3 / 3))
""",
    ),
    (
        "01-drift",
        "last two errors left out",
        """
def drift(n, d, sigma):
    return float(sigma * d * np.sqrt(sum(k * k for k in range(n - 1))))
""",
    ),
    (
        "01-drift",
        "step's length squared outside the root",
        """
def drift(n, d, sigma):
    return float(d**2 * sigma * np.sqrt(sum(k * k for k in range(n))))
""",
    ),
    (
        "01-drift",
        "simulated with a thousand robots",
        """
def drift(n, d, sigma):
    rng = np.random.default_rng(0)
    e = np.cumsum(rng.normal(0, sigma, (1000, n)), axis=1)[:, :-1]
    return float(np.std(d * np.sin(e).sum(axis=1)))
""",
    ),
    (
        "01-drift",
        "degrees",
        """
def drift(n, d, sigma):
    return float(np.radians(sigma) * d * np.sqrt(sum(k * k for k in range(n))))
""",
    ),
    (
        "01-miss",
        "lever arm along the wrong axis",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    steps, rest = np.diff(xy, axis=0), xy[-1] - xy[1:]
    v = length_error**2 * (steps**2).sum(axis=0) + heading_error**2 * (rest**2).sum(axis=0)
    return np.sqrt(v)
""",
    ),
    (
        "01-miss",
        "arm from the start instead of to the end",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    steps, rest = np.diff(xy, axis=0), xy[1:] - xy[0]
    v = length_error**2 * (steps**2).sum(axis=0) + heading_error**2 * (rest**2).sum(axis=0)[::-1]
    return np.sqrt(v)
""",
    ),
    (
        "01-miss",
        "an error at the start, too",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    steps, rest = np.diff(xy, axis=0), xy[-1] - xy
    v = length_error**2 * (steps**2).sum(axis=0) + heading_error**2 * (rest**2).sum(axis=0)[::-1]
    return np.sqrt(v)
""",
    ),
    (
        "01-miss",
        "way driven instead of the straight line",
        """
def miss(poses, length_error, heading_error):
    steps = np.diff(poses[:, :2], axis=0)
    rest = np.cumsum(np.abs(steps)[::-1], axis=0)[::-1][1:]
    v = length_error**2 * (steps**2).sum(axis=0) + heading_error**2 * (rest**2).sum(axis=0)[::-1]
    return np.sqrt(v)
""",
    ),
    (
        "01-miss",
        "length errors along the heading",
        """
def miss(poses, length_error, heading_error):
    xy, t = poses[:, :2], poses[:-1, 2]
    d = np.hypot(*np.diff(xy, axis=0).T)
    steps, rest = d[:, None] * np.stack([np.cos(t), np.sin(t)], axis=1), xy[-1] - xy[1:]
    v = length_error**2 * (steps**2).sum(axis=0) + heading_error**2 * (rest**2).sum(axis=0)[::-1]
    return np.sqrt(v)
""",
    ),
    (
        "01-miss",
        "length errors in all directions alike",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    steps, rest = np.diff(xy, axis=0), xy[-1] - xy[1:]
    v = length_error**2 * (steps**2).sum() / 2 + heading_error**2 * (rest**2).sum(axis=0)[::-1]
    return np.sqrt(v)
""",
    ),
    (
        "01-miss",
        "error of the whole length",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    rest = xy[-1] - xy[1:]
    way = np.abs(np.diff(xy, axis=0)).sum(axis=0)
    v = length_error**2 * way**2 + heading_error**2 * (rest**2).sum(axis=0)[::-1]
    return np.sqrt(v)
""",
    ),
    (
        "01-miss",
        "deviations added, not variances",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    steps, rest = np.diff(xy, axis=0), xy[-1] - xy[1:]
    return (length_error * np.sqrt((steps**2).sum(axis=0))
            + heading_error * np.sqrt((rest**2).sum(axis=0)[::-1]))
""",
    ),
    (
        "01-miss",
        "all errors of heading in one sum",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    steps, rest = np.diff(xy, axis=0), xy[-1] - xy[1:]
    v = length_error**2 * (steps**2).sum(axis=0) + heading_error**2 * rest.sum(axis=0)[::-1] ** 2
    return np.sqrt(v)
""",
    ),
    (
        "01-miss",
        "returns the way off, one number for both",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    steps, rest = np.diff(xy, axis=0), xy[-1] - xy[1:]
    v = length_error**2 * (steps**2).sum() + heading_error**2 * (rest**2).sum()
    return np.full(2, np.sqrt(v / 2))
""",
    ),
]
