"""Independent answers to 01-miss: right ones, and students' mistakes."""

RIGHT = [
    (
        "01-miss",
        "a loop over the errors",
        """
def miss(poses, length_error, heading_error):
    n = len(poses) - 1
    vx = vy = 0.0
    ex, ey = poses[-1, 0], poses[-1, 1]
    for k in range(1, n + 1):
        dx = poses[k, 0] - poses[k - 1, 0]
        dy = poses[k, 1] - poses[k - 1, 1]
        vx += (length_error * dx) ** 2
        vy += (length_error * dy) ** 2
        vx += (heading_error * (ey - poses[k, 1])) ** 2
        vy += (heading_error * (ex - poses[k, 0])) ** 2
    return np.array([np.sqrt(vx), np.sqrt(vy)])
""",
    ),
    (
        "01-miss",
        "covariance recursion over the steps",
        """
def miss(poses, length_error, heading_error):
    P = np.zeros((3, 3))
    for before, after in zip(poses[:-1], poses[1:]):
        dx, dy = after[:2] - before[:2]
        F = np.array([[1, 0, -dy], [0, 1, dx], [0, 0, 1.0]])
        G = np.array([dx, dy, 0])
        P = F @ P @ F.T + length_error ** 2 * np.outer(G, G)
        P[2, 2] += heading_error ** 2
    return np.sqrt(np.diag(P)[:2])
""",
    ),
    (
        "01-miss",
        "one matrix of all influences",
        """
def miss(poses, length_error, heading_error):
    p = poses[:, :2]
    by_length = length_error * (p[1:] - p[:-1])
    arms = p[-1] - p[1:]
    by_heading = heading_error * np.column_stack([-arms[:, 1], arms[:, 0]])
    return np.linalg.norm(np.vstack([by_length, by_heading]), axis=0)
""",
    ),
]

WRONG = [
    (
        "01-miss",
        "x and y not swapped for the heading",
        """
def miss(poses, length_error, heading_error):
    p = poses[:, :2]
    step = np.diff(p, axis=0)
    to_end = p[-1] - p[1:]
    var = length_error ** 2 * (step ** 2).sum(axis=0) + heading_error ** 2 * (to_end ** 2).sum(axis=0)
    return np.sqrt(var)
""",
    ),
    (
        "01-miss",
        "heading error also at the start",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    step = np.diff(xy, axis=0)
    arm = xy[-1] - xy
    vx = length_error ** 2 * np.sum(step[:, 0] ** 2) + heading_error ** 2 * np.sum(arm[:, 1] ** 2)
    vy = length_error ** 2 * np.sum(step[:, 1] ** 2) + heading_error ** 2 * np.sum(arm[:, 0] ** 2)
    return np.sqrt(np.array([vx, vy]))
""",
    ),
    (
        "01-miss",
        "length error along the heading instead of the motion",
        """
def miss(poses, length_error, heading_error):
    xy, th = poses[:, :2], poses[:-1, 2]
    d = np.hypot(*np.diff(xy, axis=0).T)
    sx = d * np.cos(th)
    sy = d * np.sin(th)
    arm = xy[-1] - xy[1:]
    vx = np.sum((length_error * sx) ** 2) + np.sum((heading_error * arm[:, 1]) ** 2)
    vy = np.sum((length_error * sy) ** 2) + np.sum((heading_error * arm[:, 0]) ** 2)
    return np.sqrt([vx, vy])
""",
    ),
    (
        "01-miss",
        "rotates about the start instead of about pose k",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    step = np.diff(xy, axis=0)
    arm = xy[1:] - xy[0]
    v = length_error ** 2 * np.sum(step ** 2, axis=0)
    v = v + heading_error ** 2 * np.sum(arm[:, ::-1] ** 2, axis=0)
    return np.sqrt(v)
""",
    ),
    (
        "01-miss",
        "arm is the way driven, not the straight line",
        """
def miss(poses, length_error, heading_error):
    steps = np.diff(poses[:, :2], axis=0)
    lengths = np.hypot(steps[:, 0], steps[:, 1])
    left = lengths.sum() - np.cumsum(lengths)
    th = np.arctan2(steps[:, 1], steps[:, 0])
    vx = np.sum((length_error * steps[:, 0]) ** 2) + np.sum((heading_error * left * np.sin(th)) ** 2)
    vy = np.sum((length_error * steps[:, 1]) ** 2) + np.sum((heading_error * left * np.cos(th)) ** 2)
    return np.array([np.sqrt(vx), np.sqrt(vy)])
""",
    ),
    (
        "01-miss",
        "adds the deviations of length and heading",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    a = length_error * np.sqrt(np.sum(np.diff(xy, axis=0) ** 2, axis=0))
    arm = xy[-1] - xy[1:]
    b = heading_error * np.sqrt(np.sum(arm[:, ::-1] ** 2, axis=0))
    return a + b
""",
    ),
    (
        "01-miss",
        "errors of all steps are the same (sum before the square)",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    step = np.diff(xy, axis=0)
    arm = xy[-1] - xy[1:]
    by_length = length_error * np.sum(step, axis=0)
    by_heading = heading_error * np.sum(arm[:, ::-1], axis=0)
    return np.sqrt(by_length ** 2 + by_heading ** 2)
""",
    ),
    (
        "01-miss",
        "returns variances",
        """
def miss(poses, length_error, heading_error):
    var = np.zeros(2)
    end = poses[-1, :2]
    for p, q in pairwise(poses[:, :2]):
        var += (length_error * (q - p)) ** 2
        var += (heading_error * (end - q)[::-1]) ** 2
    return var
""",
    ),
    (
        "01-miss",
        "the full length of each step goes into both x and y",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    lengths = np.linalg.norm(np.diff(xy, axis=0), axis=1)
    arm = xy[-1] - xy[1:]
    v = length_error ** 2 * np.sum(lengths ** 2) + heading_error ** 2 * np.sum(arm[:, ::-1] ** 2, axis=0)
    return np.sqrt(v)
""",
    ),
    (
        "01-miss",
        "heading bends by the distance to the end, same in x and y",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    step = np.diff(xy, axis=0)
    far = np.hypot(*(xy[-1] - xy[1:]).T)
    v = length_error ** 2 * np.sum(step ** 2, axis=0) + heading_error ** 2 * np.sum(far ** 2)
    return np.sqrt(v)
""",
    ),
    (
        "01-miss",
        "in the end pose's frame, along and across",
        """
def miss(poses, length_error, heading_error):
    c, s = np.cos(poses[-1, 2]), np.sin(poses[-1, 2])
    xy = poses[:, :2] @ np.array([[c, -s], [s, c]])
    step = np.diff(xy, axis=0)
    arm = xy[-1] - xy[1:]
    v = length_error ** 2 * np.sum(step ** 2, axis=0) + heading_error ** 2 * np.sum(arm[:, ::-1] ** 2, axis=0)
    return np.sqrt(v)
""",
    ),
    (
        "01-miss",
        "the straight drive's formula, with all poses on a line",
        """
def miss(poses, length_error, heading_error):
    n = len(poses) - 1
    d = np.mean(np.hypot(*np.diff(poses[:, :2], axis=0).T)) if n else 0.0
    return np.array([length_error * d * np.sqrt(n), drift(n, d, heading_error)])
""",
    ),
    (
        "01-miss",
        "length error not times the length",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    unit = np.diff(xy, axis=0)
    n = np.linalg.norm(unit, axis=1, keepdims=True)
    unit = np.divide(unit, n, out=np.zeros_like(unit), where=n > 0)
    arm = xy[-1] - xy[1:]
    v = length_error ** 2 * np.sum(unit ** 2, axis=0) + heading_error ** 2 * np.sum(arm[:, ::-1] ** 2, axis=0)
    return np.sqrt(v)
""",
    ),
    (
        "01-miss",
        "poses shifted in place to the end",
        """
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    step = np.diff(xy, axis=0)
    xy -= xy[-1].copy()
    v = length_error ** 2 * np.sum(step ** 2, axis=0) + heading_error ** 2 * np.sum(xy[1:, ::-1] ** 2, axis=0)
    return np.sqrt(v)
""",
    ),
    (
        "01-miss",
        "fails for a track of one pose",
        """
def miss(poses, length_error, heading_error):
    end = poses[-1, :2]
    rows = []
    for k in range(1, len(poses)):
        dx, dy = poses[k, :2] - poses[k - 1, :2]
        ax, ay = end - poses[k, :2]
        rows.append([(length_error * dx) ** 2 + (heading_error * ay) ** 2,
                     (length_error * dy) ** 2 + (heading_error * ax) ** 2])
    rows = np.array(rows)
    return np.sqrt([rows[:, 0].sum(), rows[:, 1].sum()])
""",
    ),
]
