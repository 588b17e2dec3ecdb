"""A ninth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "01-seen-from",
        "complex numbers: (b - a) divided by the direction of a",
        """
def seen_from(a, b):
    way = complex(b[0] - a[0], b[1] - a[1]) * np.exp(-1j * a[2])
    turn = np.angle(np.exp(1j * (b[2] - a[2])))
    return np.array([way.real, way.imag, turn])
""",
    ),
    (
        "01-drift",
        "propagates the covariance of (sideways, heading) step by step",
        """
def drift(n, d, sigma):
    A = np.array([[1.0, d], [0.0, 1.0]])
    P = np.zeros((2, 2))
    for _ in range(n):
        P = A @ P @ A.T
        P[1, 1] += sigma**2
    return float(np.sqrt(P[0, 0]))
""",
    ),
]

WRONG = [
    (
        "01-next-pose",
        "adds the step in the world's frame, as if the robot always looked along +x",
        """
def next_pose(pose, step):
    new = np.asarray(pose, dtype=float) + np.asarray(step, dtype=float)
    new[2] = (new[2] + np.pi) % (2 * np.pi) - np.pi
    return new
""",
    ),
    (
        "01-next-pose",
        "turns first and then drives: uses the new heading for the step",
        """
def next_pose(pose, step):
    heading = pose[2] + step[2]
    moved = (pose[0] + 1j * pose[1]) + (step[0] + 1j * step[1]) * np.exp(1j * heading)
    return np.array([moved.real, moved.imag, np.angle(np.exp(1j * heading))])
""",
    ),
    (
        "01-next-pose",
        "rotates the wrong way round (transposed matrix, by minus the heading)",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    rotation = np.array([[c, s], [-s, c]])
    xy = pose[:2] + rotation @ step[:2]
    theta = pose[2] + step[2]
    return np.array([xy[0], xy[1], np.arctan2(np.sin(theta), np.cos(theta))])
""",
    ),
    (
        "01-next-pose",
        "heading brought into 0 to 2 pi instead of -pi to pi",
        """
def next_pose(pose, step):
    x, y, th = pose
    f, l, t = step
    return np.array([
        x + f * np.cos(th) + l * np.cos(th + np.pi / 2),
        y + f * np.sin(th) + l * np.sin(th + np.pi / 2),
        np.mod(th + t, 2 * np.pi),
    ])
""",
    ),
    (
        "01-seen-from",
        "turns the difference by +heading of a (forward as in next_pose) instead of undoing it",
        """
def seen_from(a, b):
    diff = b - a
    c, s = np.cos(a[2]), np.sin(a[2])
    ahead = c * diff[0] - s * diff[1]
    left = s * diff[0] + c * diff[1]
    return np.array([ahead, left, np.arctan2(np.sin(diff[2]), np.cos(diff[2]))])
""",
    ),
    (
        "01-seen-from",
        "wraps only turns that are too large, forgets those below -pi",
        """
def seen_from(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    R = np.array([[c, -s], [s, c]])
    ahead, left = R.T @ (b[:2] - a[:2])
    turn = b[2] - a[2]
    if turn > np.pi:
        turn -= 2 * np.pi
    return np.array([ahead, left, turn])
""",
    ),
    (
        "01-seen-from",
        "polar way with arctan(dy/dx) instead of arctan2: wrong where b has the smaller x",
        """
def seen_from(a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    far = np.hypot(dx, dy)
    if dx == 0:
        bearing = np.sign(dy) * np.pi / 2
    else:
        bearing = np.arctan(dy / dx)
    bearing -= a[2]
    turn = (b[2] - a[2] + np.pi) % (2 * np.pi) - np.pi
    return np.array([far * np.cos(bearing), far * np.sin(bearing), turn])
""",
    ),
    (
        "01-seen-from",
        "swapped roles: gives a as seen from b",
        """
def seen_from(a, b):
    d = np.array(a[:2]) - np.array(b[:2])
    e = np.array([np.cos(b[2]), np.sin(b[2])])
    n = np.array([-np.sin(b[2]), np.cos(b[2])])
    t = a[2] - b[2]
    return np.array([d @ e, d @ n, np.arctan2(np.sin(t), np.cos(t))])
""",
    ),
    (
        "01-drift",
        "off by one: the first error bends all n steps, also the one before it",
        """
def drift(n, d, sigma):
    total = 0.0
    for k in range(1, n + 1):
        total += (k * d * sigma) ** 2
    return np.sqrt(total)
""",
    ),
    (
        "01-drift",
        "adds standard deviations instead of variances",
        """
def drift(n, d, sigma):
    sideways = 0.0
    for k in range(n):
        sideways = sideways + (n - 1 - k) * d * sigma
    return sideways
""",
    ),
    (
        "01-drift",
        "each step takes a fresh angle of the grown variance: forgets that sideways and heading are correlated",
        """
def drift(n, d, sigma):
    var_heading, var_side = 0.0, 0.0
    for _ in range(n):
        var_side += d**2 * var_heading
        var_heading += sigma**2
    return np.sqrt(var_side)
""",
    ),
    (
        "01-drift",
        "returns the variance, no square root",
        """
def drift(n, d, sigma):
    return d**2 * sigma**2 * (n - 1) * n * (2 * n - 1) / 6
""",
    ),
    (
        "01-miss",
        "heading errors at the start of each step: turns about poses 0..n-1 instead of 1..n",
        """
def miss(poses, length_error, heading_error):
    end = poses[-1, :2]
    vx = vy = 0.0
    for k in range(len(poses) - 1):
        dx, dy = poses[k + 1, :2] - poses[k, :2]
        rx, ry = end - poses[k, :2]
        vx += (length_error * dx) ** 2 + (heading_error * ry) ** 2
        vy += (length_error * dy) ** 2 + (heading_error * rx) ** 2
    return np.sqrt([vx, vy])
""",
    ),
    (
        "01-miss",
        "heading error moves the end along the line to it instead of across (x and y not swapped)",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    steps = np.diff(xy, axis=0)
    rest = xy[-1] - xy[1:]
    return np.sqrt(np.sum((length_error * steps) ** 2 + (heading_error * rest) ** 2, axis=0))
""",
    ),
    (
        "01-miss",
        "length error along the heading of the pose instead of along the way the robot moved",
        """
def miss(poses, length_error, heading_error):
    xy, th = poses[:, :2], poses[:-1, 2]
    length = np.hypot(*np.diff(xy, axis=0).T)
    e = np.column_stack([np.cos(th), np.sin(th)]) * length[:, None]
    r = xy[-1] - xy[1:]
    var_x = length_error**2 * np.sum(e[:, 0] ** 2) + heading_error**2 * np.sum(r[:, 1] ** 2)
    var_y = length_error**2 * np.sum(e[:, 1] ** 2) + heading_error**2 * np.sum(r[:, 0] ** 2)
    return np.array([np.sqrt(var_x), np.sqrt(var_y)])
""",
    ),
    (
        "01-miss",
        "length error the same in x and y (share of the step's whole length on both axes)",
        """
def miss(poses, length_error, heading_error):
    p = poses[:, 0] + 1j * poses[:, 1]
    length = np.abs(np.diff(p))
    to_end = 1j * (p[-1] - p[1:])
    along = length_error**2 * np.sum(length**2)
    return np.sqrt(np.array([
        along + heading_error**2 * np.sum(to_end.real**2),
        along + heading_error**2 * np.sum(to_end.imag**2),
    ]))
""",
    ),
    (
        "01-home",
        "plain dead reckoning, the dockings are not used",
        """
def home(start, steps, docked):
    return track(start, steps)
""",
    ),
    (
        "01-home",
        "only starts afresh at each dock; within a lap and after the last nothing is mended",
        """
def home(start, steps, docked):
    out = [np.array(start)]
    for k, step in enumerate(steps, start=1):
        out.append(np.array(start) if k in docked else next_pose(out[-1], step))
    return np.array(out)
""",
    ),
    (
        "01-home",
        "factor of the tyre from the signed sum of all turns over laps * 2 pi: left and right laps cancel",
        """
def home(start, steps, docked):
    steps = steps.copy()
    factor = steps[:docked[-1], 2].sum() / (2 * np.pi * len(docked))
    steps[:, 2] = steps[:, 2] / factor
    way = track(start, steps)
    before = 0
    for k in docked:
        gap = start[:2] - way[k, :2]
        share = np.linspace(0, 1, k - before + 1)[1:]
        way[before + 1:k + 1, :2] += share[:, None] * gap
        way[k + 1:, :2] += gap
        before = k
    return way
""",
    ),
    (
        "01-home",
        "changes the steps it was given (divides their turns in place)",
        """
def home(start, steps, docked):
    begin = 0
    factors = []
    for k in docked:
        factors.append(abs(steps[begin:k, 2].sum()) / (2 * np.pi))
        begin = k
    steps[:, 2] /= np.mean(factors)
    out, begin = [np.array([start])], 0
    for k in docked:
        lap = steps[begin:k].copy()
        full = 2 * np.pi * np.sign(lap[:, 2].sum())
        lap[:, 2] += (full - lap[:, 2].sum()) / len(lap)
        poses = track(start, lap)
        gap = start[:2] - poses[-1, :2]
        poses[:, :2] += np.linspace(0, 1, len(poses))[:, None] * gap
        out.append(poses[1:])
        begin = k
    out.append(track(start, steps[begin:])[1:])
    return np.vstack(out)
""",
    ),
    (
        "01-home",
        "shares out the gap of each lap evenly in place only: the turns stay too large, also after the last lap",
        """
def home(start, steps, docked):
    way, first = [np.array([start])], 0
    for last in docked:
        lap = track(start, steps[first:last])
        t = np.arange(len(lap)) / (len(lap) - 1)
        lap[:, :2] += t[:, None] * (start[:2] - lap[-1, :2])
        way.append(lap[1:])
        first = last
    way.append(track(start, steps[first:])[1:])
    return np.concatenate(way)
""",
    ),
    (
        "01-next-pose",
        "writes the new place into the pose that was given",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    pose[0] += c * step[0] - s * step[1]
    pose[1] += s * step[0] + c * step[1]
    pose[2] = np.angle(np.exp(1j * (pose[2] + step[2])))
    return pose
""",
    ),
    (
        "01-drift",
        "fails for a drive of no step at all (array of size n - 1)",
        """
def drift(n, d, sigma):
    arms = d * np.cumsum(np.ones(n - 1))
    return sigma * np.linalg.norm(arms)
""",
    ),
    (
        "01-miss",
        "arm of a heading error is the way still to drive, along the path, instead of the straight line to the end",
        """
def miss(poses, length_error, heading_error):
    steps = np.diff(poses[:, :2], axis=0)
    length = np.linalg.norm(steps, axis=1)
    var = length_error**2 * np.sum(steps**2, axis=0)
    for k in range(1, len(steps)):
        rest = length[k:].sum()
        way = poses[-1, :2] - poses[k, :2]
        far = np.linalg.norm(way)
        across = np.array([-way[1], way[0]]) / far if far > 0 else np.zeros(2)
        var = var + (heading_error * rest * across) ** 2
    return np.sqrt(var)
""",
    ),
]
