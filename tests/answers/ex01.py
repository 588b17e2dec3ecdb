"""Independent answers to exercise 01: right ones, and students' mistakes."""

RIGHT = [
    (
        "01-next-pose",
        "rotation matrix and modulo",
        """
def next_pose(pose, step):
    th = pose[2]
    R = np.array([[np.cos(th), -np.sin(th)], [np.sin(th), np.cos(th)]])
    p = pose[:2] + R @ step[:2]
    new = (th + step[2] + np.pi) % (2 * np.pi) - np.pi
    return np.array([p[0], p[1], new])
""",
    ),
    (
        "01-next-pose",
        "complex numbers",
        """
def next_pose(pose, step):
    turn = np.exp(1j * pose[2])
    z = complex(pose[0], pose[1]) + turn * complex(step[0], step[1])
    return np.array([z.real, z.imag, np.angle(turn * np.exp(1j * step[2]))])
""",
    ),
    (
        "01-next-pose",
        "polar form of the step, while loops",
        """
def next_pose(pose, step):
    length = np.hypot(step[0], step[1])
    direction = pose[2] + np.arctan2(step[1], step[0])
    heading = pose[2] + step[2]
    while heading > np.pi:
        heading -= 2 * np.pi
    while heading <= -np.pi:
        heading += 2 * np.pi
    return np.array([pose[0] + length * np.cos(direction), pose[1] + length * np.sin(direction), heading])
""",
    ),
    (
        "01-seen-from",
        "rotation matrix transposed",
        """
def seen_from(a, b):
    R = np.array([[np.cos(a[2]), -np.sin(a[2])], [np.sin(a[2]), np.cos(a[2])]])
    ahead, left = R.T @ (b[:2] - a[:2])
    turn = (b[2] - a[2] + np.pi) % (2 * np.pi) - np.pi
    return np.array([ahead, left, turn])
""",
    ),
    (
        "01-seen-from",
        "inverse of homogeneous matrices",
        """
def matrix(p):
    c, s = np.cos(p[2]), np.sin(p[2])
    return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])


def seen_from(a, b):
    M = np.linalg.inv(matrix(a)) @ matrix(b)
    return np.array([M[0, 2], M[1, 2], np.arctan2(M[1, 0], M[0, 0])])
""",
    ),
    (
        "01-seen-from",
        "distance and bearing",
        """
def seen_from(a, b):
    d = np.hypot(b[0] - a[0], b[1] - a[1])
    bearing = np.arctan2(b[1] - a[1], b[0] - a[0]) - a[2]
    turn = b[2] - a[2]
    if turn > np.pi:
        turn -= 2 * np.pi
    elif turn <= -np.pi:
        turn += 2 * np.pi
    return np.array([d * np.cos(bearing), d * np.sin(bearing), turn])
""",
    ),
    (
        "01-drift",
        "closed form",
        """
def drift(n, d, sigma):
    if n == 0:
        return 0.0
    return sigma * d * ((n - 1) * n * (2 * n - 1) / 6) ** 0.5
""",
    ),
    (
        "01-drift",
        "a loop over the errors",
        """
def drift(n, d, sigma):
    var = 0.0
    for i in range(1, n + 1):
        sideways = (n - i) * d * sigma
        var += sideways ** 2
    return np.sqrt(var)
""",
    ),
    (
        "01-drift",
        "the norm of a vector",
        """
def drift(n, d, sigma):
    return float(np.linalg.norm(sigma * d * np.arange(n - 1, -1, -1)))
""",
    ),
    (
        "01-drift",
        "propagates variance of sideways and heading",
        """
def drift(n, d, sigma):
    P = np.zeros((2, 2))
    A = np.array([[1, d], [0, 1]])
    for _ in range(n):
        P = A @ P @ A.T
        P[1, 1] += sigma ** 2
    return np.sqrt(P[0, 0])
""",
    ),
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
    (
        "01-home",
        "factor by mean ratio, heading and gap shared by lap, helper functions",
        """
def home(start, steps, docked):
    bounds = [0] + list(docked)
    ratios = []
    for i, j in zip(bounds[:-1], bounds[1:]):
        ratios.append(abs(steps[i:j, 2].sum()) / (2 * np.pi))
    factor = np.mean(ratios)
    fixed = np.array(steps, dtype=float)
    fixed[:, 2] = fixed[:, 2] / factor
    out = np.zeros((len(steps) + 1, 3))
    out[0] = start
    for i, j in zip(bounds[:-1], bounds[1:]):
        lap = fixed[i:j].copy()
        want = 2 * np.pi * np.sign(lap[:, 2].sum())
        lap[:, 2] += (want - lap[:, 2].sum()) / (j - i)
        poses = track(out[i] * 0 + start, lap)
        share = (np.arange(j - i + 1) / (j - i)).reshape(-1, 1)
        poses[:, :2] -= share * (poses[-1, :2] - start[:2])
        poses[-1] = start
        out[i + 1:j + 1] = poses[1:]
    rest = track(start, fixed[bounds[-1]:])
    out[bounds[-1] + 1:] = rest[1:]
    return out
""",
    ),
    (
        "01-home",
        "least squares of the lap: small errors of each step, constraints of the end",
        """
def home(start, steps, docked):
    begins = [0, *docked[:-1]]
    told = np.array([np.sum(steps[i:j, 2]) for i, j in zip(begins, docked)])
    k = np.sum(np.abs(told)) / (2 * np.pi * len(told))
    fixed = steps.copy()
    fixed[:, 2] /= k
    poses = [np.asarray(start, dtype=float)[None]]
    for i, j in zip(begins, docked):
        lap = fixed[i:j].copy()
        n = j - i
        want = 2 * np.pi * np.sign(lap[:, 2].sum())
        for _ in range(4):
            p = np.zeros((n + 1, 3))
            p[0] = start
            heading = start[2] + np.append(0, np.cumsum(lap[:, 2]))
            ways = lap[:, 0] * np.exp(1j * heading[:-1])
            z = np.append(0, np.cumsum(ways))
            arm = 1j * (z[-1] - z[1:])
            # residuals: place and total turn; unknowns: n lengths (0.0075 m), n turns (0.01 rad)
            J = np.zeros((3, 2 * n))
            unit = np.exp(1j * heading[:-1])
            J[0, :n], J[1, :n] = unit.real, unit.imag
            J[0, n:], J[1, n:] = arm.real, arm.imag
            J[2, n:] = 1
            W = np.append((0.015 * np.maximum(abs(lap[:, 0]), 1e-3)) ** 2, np.full(n, 0.01 ** 2))
            e = np.array([-z[-1].real, -z[-1].imag, want - lap[:, 2].sum()])
            d = W * (J.T @ np.linalg.solve(J * W @ J.T, e))
            lap[:, 0] += d[:n]
            lap[:, 2] += d[n:]
        poses.append(track(np.asarray(start, dtype=float), lap)[1:])
    poses.append(track(np.asarray(start, dtype=float), fixed[docked[-1]:])[1:])
    return np.vstack(poses)
""",
    ),
]

WRONG = [
    (
        "01-next-pose",
        "moves along the new heading",
        """
def next_pose(pose, step):
    heading = pose[2] + step[2]
    heading = np.arctan2(np.sin(heading), np.cos(heading))
    c, s = np.cos(heading), np.sin(heading)
    return np.array([
        pose[0] + c * step[0] - s * step[1],
        pose[1] + s * step[0] + c * step[1],
        heading,
    ])
""",
    ),
    (
        "01-next-pose",
        "adds the step in the world's frame",
        """
def next_pose(pose, step):
    new = pose + step
    new[2] = (new[2] + np.pi) % (2 * np.pi) - np.pi
    return new
""",
    ),
    (
        "01-next-pose",
        "heading not wrapped",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    R = np.array([[c, -s], [s, c]])
    return np.append(pose[:2] + R @ step[:2], pose[2] + step[2])
""",
    ),
    (
        "01-next-pose",
        "rotation transposed",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    R = np.array([[c, s], [-s, c]])
    xy = pose[:2] + R @ step[:2]
    a = pose[2] + step[2]
    return np.array([*xy, np.arctan2(np.sin(a), np.cos(a))])
""",
    ),
    (
        "01-next-pose",
        "the sideways part is forgotten",
        """
def next_pose(pose, step):
    x, y, t = pose
    d, _, dt = step
    a = t + dt
    return np.array([x + d * np.cos(t), y + d * np.sin(t), np.arctan2(np.sin(a), np.cos(a))])
""",
    ),
    (
        "01-next-pose",
        "left taken as right",
        """
def next_pose(pose, step):
    x, y, th = pose
    f, l, t = step
    right_of = th - np.pi / 2
    x = x + f * np.cos(th) + l * np.cos(right_of)
    y = y + f * np.sin(th) + l * np.sin(right_of)
    return np.array([x, y, np.angle(np.exp(1j * (th + t)))])
""",
    ),
    (
        "01-next-pose",
        "wrapped to 0..2pi",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    return np.array([
        pose[0] + c * step[0] - s * step[1],
        pose[1] + s * step[0] + c * step[1],
        (pose[2] + step[2]) % (2 * np.pi),
    ])
""",
    ),
    (
        "01-next-pose",
        "only wraps upward overflow",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    theta = pose[2] + step[2]
    if theta > np.pi:
        theta -= 2 * np.pi
    return np.array([pose[0] + c * step[0] - s * step[1], pose[1] + s * step[0] + c * step[1], theta])
""",
    ),
    (
        "01-next-pose",
        "changes the pose in place",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    pose[0] += c * step[0] - s * step[1]
    pose[1] += s * step[0] + c * step[1]
    pose[2] = np.arctan2(np.sin(pose[2] + step[2]), np.cos(pose[2] + step[2]))
    return pose
""",
    ),
    (
        "01-next-pose",
        "moves the whole length straight ahead",
        """
def next_pose(pose, step):
    length = np.sqrt(step[0] ** 2 + step[1] ** 2)
    x = pose[0] + length * np.cos(pose[2])
    y = pose[1] + length * np.sin(pose[2])
    h = pose[2] + step[2]
    return np.array([x, y, np.arctan2(np.sin(h), np.cos(h))])
""",
    ),
    (
        "01-next-pose",
        "half the turn (arc midpoint) for the direction",
        """
def next_pose(pose, step):
    mid = pose[2] + step[2] / 2
    c, s = np.cos(mid), np.sin(mid)
    h = pose[2] + step[2]
    return np.array([
        pose[0] + c * step[0] - s * step[1],
        pose[1] + s * step[0] + c * step[1],
        np.arctan2(np.sin(h), np.cos(h)),
    ])
""",
    ),
    (
        "01-next-pose",
        "arctan(step) loses backward steps",
        """
def next_pose(pose, step):
    length = np.hypot(step[0], step[1])
    way = pose[2] + (np.arctan(step[1] / step[0]) if step[0] != 0 else np.sign(step[1]) * np.pi / 2)
    h = pose[2] + step[2]
    return np.array([pose[0] + length * np.cos(way), pose[1] + length * np.sin(way),
                     np.arctan2(np.sin(h), np.cos(h))])
""",
    ),
    (
        "01-next-pose",
        "wraps with fmod, which keeps the sign",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    h = np.fmod(pose[2] + step[2] + np.pi, 2 * np.pi) - np.pi
    return np.array([pose[0] + c * step[0] - s * step[1], pose[1] + s * step[0] + c * step[1], h])
""",
    ),
    (
        "01-seen-from",
        "not turned into a's frame",
        """
def seen_from(a, b):
    d = b - a
    return np.array([d[0], d[1], np.arctan2(np.sin(d[2]), np.cos(d[2]))])
""",
    ),
    (
        "01-seen-from",
        "rotated the wrong way",
        """
def seen_from(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    dx, dy, dt = b - a
    return np.array([c * dx - s * dy, s * dx + c * dy, np.arctan2(np.sin(dt), np.cos(dt))])
""",
    ),
    (
        "01-seen-from",
        "a seen from b",
        """
def seen_from(a, b):
    c, s = np.cos(b[2]), np.sin(b[2])
    dx, dy = a[0] - b[0], a[1] - b[1]
    turn = a[2] - b[2]
    return np.array([c * dx + s * dy, -s * dx + c * dy, np.arctan2(np.sin(turn), np.cos(turn))])
""",
    ),
    (
        "01-seen-from",
        "a minus b, in a's frame",
        """
def seen_from(a, b):
    d = a[:2] - b[:2]
    c, s = np.cos(a[2]), np.sin(a[2])
    t = np.angle(np.exp(1j * (b[2] - a[2])))
    return np.array([d @ [c, s], d @ [-s, c], t])
""",
    ),
    (
        "01-seen-from",
        "turned by b's heading",
        """
def seen_from(a, b):
    c, s = np.cos(b[2]), np.sin(b[2])
    R = np.array([[c, s], [-s, c]])
    xy = R @ (b - a)[:2]
    t = b[2] - a[2]
    return np.array([xy[0], xy[1], np.arctan2(np.sin(t), np.cos(t))])
""",
    ),
    (
        "01-seen-from",
        "turn not wrapped",
        """
def seen_from(a, b):
    delta = b - a
    u = np.array([np.cos(a[2]), np.sin(a[2])])
    v = np.array([-u[1], u[0]])
    return np.array([u @ delta[:2], v @ delta[:2], delta[2]])
""",
    ),
    (
        "01-seen-from",
        "turn is the bearing of b, not its heading",
        """
def seen_from(a, b):
    dx, dy = b[:2] - a[:2]
    r = np.hypot(dx, dy)
    bearing = np.arctan2(dy, dx) - a[2]
    bearing = np.arctan2(np.sin(bearing), np.cos(bearing))
    return np.array([r * np.cos(bearing), r * np.sin(bearing), bearing])
""",
    ),
    (
        "01-seen-from",
        "arctan instead of arctan2, and division by zero in one place",
        """
def seen_from(a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    d = np.sqrt(dx ** 2 + dy ** 2)
    bearing = np.arctan(dy / dx) - a[2]
    turn = b[2] - a[2]
    return np.array([d * np.cos(bearing), d * np.sin(bearing), np.arctan2(np.sin(turn), np.cos(turn))])
""",
    ),
    (
        "01-seen-from",
        "next_pose with the negated pose",
        """
def seen_from(a, b):
    return next_pose(-a, b)
""",
    ),
    (
        "01-seen-from",
        "returns left before ahead",
        """
def seen_from(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    dx, dy = b[0] - a[0], b[1] - a[1]
    turn = b[2] - a[2]
    return np.array([-s * dx + c * dy, c * dx + s * dy, np.arctan2(np.sin(turn), np.cos(turn))])
""",
    ),
    (
        "01-seen-from",
        "wrapped to 0..2pi",
        """
def seen_from(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    ahead, left = np.array([[c, s], [-s, c]]) @ (b[:2] - a[:2])
    return np.array([ahead, left, np.mod(b[2] - a[2], 2 * np.pi)])
""",
    ),
    (
        "01-seen-from",
        "wraps with arcsin",
        """
def seen_from(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    ahead, left = np.array([[c, s], [-s, c]]) @ (b[:2] - a[:2])
    return np.array([ahead, left, np.arcsin(np.sin(b[2] - a[2]))])
""",
    ),
    (
        "01-seen-from",
        "subtracts in place, changes b",
        """
def seen_from(a, b):
    b -= a
    c, s = np.cos(a[2]), np.sin(a[2])
    return np.array([c * b[0] + s * b[1], c * b[1] - s * b[0], np.arctan2(np.sin(b[2]), np.cos(b[2]))])
""",
    ),
    (
        "01-drift",
        "the first error bends n steps",
        """
def drift(n, d, sigma):
    var = 0
    for k in range(1, n + 1):
        var += (k * d * sigma) ** 2
    return np.sqrt(var)
""",
    ),
    (
        "01-drift",
        "adds the standard deviations",
        """
def drift(n, d, sigma):
    return sigma * d * n * (n - 1) / 2
""",
    ),
    (
        "01-drift",
        "returns the variance",
        """
def drift(n, d, sigma):
    k = np.arange(n)
    return sigma ** 2 * d ** 2 * np.sum(k ** 2)
""",
    ),
    (
        "01-drift",
        "like the length: sqrt(n)",
        """
def drift(n, d, sigma):
    return d * sigma * np.sqrt(n)
""",
    ),
    (
        "01-drift",
        "the approximation n^1.5/sqrt(3)",
        """
def drift(n, d, sigma):
    return sigma * d * np.sqrt(n ** 3 / 3)
""",
    ),
    (
        "01-drift",
        "one constant error: n-1 steps of sigma",
        """
def drift(n, d, sigma):
    return (n - 1) * d * np.sin(sigma)
""",
    ),
    (
        "01-drift",
        "one random heading per step, not picked up",
        """
def drift(n, d, sigma):
    # each step goes sideways by d * e
    var = sum((d * sigma) ** 2 for i in range(1, n))
    return np.sqrt(var)
""",
    ),
    (
        "01-drift",
        "sigma counted as degrees",
        """
def drift(n, d, sigma):
    k = np.arange(n)
    return np.radians(sigma) * d * np.sqrt(np.sum(k ** 2))
""",
    ),
    (
        "01-drift",
        "sum of k, not k squared",
        """
def drift(n, d, sigma):
    total = 0
    for k in range(n):
        total += k
    return sigma * d * np.sqrt(total)
""",
    ),
    (
        "01-drift",
        "sums to n - 2",
        """
def drift(n, d, sigma):
    return d * sigma * np.sqrt(sum(k ** 2 for k in range(n - 1)))
""",
    ),
    (
        "01-drift",
        "forgets the step length under the root",
        """
def drift(n, d, sigma):
    return sigma * np.sqrt(d * np.sum(np.arange(n) ** 2))
""",
    ),
    (
        "01-drift",
        "simulates it",
        """
def drift(n, d, sigma):
    rng = np.random.default_rng(0)
    ends = []
    for _ in range(300):
        headings = np.cumsum(sigma * rng.standard_normal(n))
        ends.append(d * np.sum(np.sin(headings[:-1])))
    return float(np.std(ends))
""",
    ),
    (
        "01-drift",
        "closed form with a slip: (2n+1)",
        """
def drift(n, d, sigma):
    return sigma * d * np.sqrt(n * (n - 1) * (2 * n + 1) / 6)
""",
    ),
    (
        "01-drift",
        "closed form divides by n, fails for no step",
        """
def drift(n, d, sigma):
    mean_of_squares = (n - 1) * n * (2 * n - 1) / 6 / n
    return sigma * d * np.sqrt(n * mean_of_squares)
""",
    ),
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
    (
        "01-home",
        "plain dead reckoning",
        """
def home(start, steps, docked):
    return track(start, steps)
""",
    ),
    (
        "01-home",
        "begins anew at the dock, nothing more",
        """
def home(start, steps, docked):
    poses = [np.array(start)]
    for k, step in enumerate(steps):
        p = next_pose(poses[-1], step)
        if k + 1 in docked:
            p = np.array(start)
        poses.append(p)
    return np.array(poses)
""",
    ),
    (
        "01-home",
        "shares the gap in place, but not the factor",
        """
def home(start, steps, docked):
    poses = [start[None]]
    i = 0
    for j in docked:
        lap = track(start, steps[i:j])
        gap = start[:2] - lap[-1, :2]
        lap[:, :2] += np.linspace(0, 1, len(lap))[:, None] * gap
        poses.append(lap[1:])
        i = j
    poses.append(track(start, steps[i:])[1:])
    return np.vstack(poses)
""",
    ),
    (
        "01-home",
        "corrects each lap's heading, but the way beyond keeps the worn tyre",
        """
def home(start, steps, docked):
    steps = steps.copy()
    out = [start[None]]
    i = 0
    for j in docked:
        total = steps[i:j, 2].sum()
        steps[i:j, 2] *= 2 * np.pi * np.sign(total) / total
        lap = track(start, steps[i:j])
        lap[:, :2] += np.outer(np.arange(len(lap)) / (len(lap) - 1), start[:2] - lap[-1, :2])
        out.append(lap[1:])
        i = j
    out.append(track(start, steps[i:])[1:])
    return np.concatenate(out)
""",
    ),
    (
        "01-home",
        "assumes all laps go to the left",
        """
def home(start, steps, docked):
    steps = steps.copy()
    laps = list(zip([0, *docked[:-1]], docked))
    factor = np.mean([steps[i:j, 2].sum() / (2 * np.pi) for i, j in laps])
    steps[:, 2] /= factor
    poses = [np.array([start])]
    for i, j in laps:
        lap = steps[i:j].copy()
        lap[:, 2] += (2 * np.pi - lap[:, 2].sum()) / len(lap)
        p = track(start, lap)
        p[:, :2] += np.linspace(0, 1, len(p))[:, None] * (start[:2] - p[-1, :2])
        poses.append(p[1:])
    poses.append(track(start, steps[docked[-1]:])[1:])
    return np.concatenate(poses)
""",
    ),
    (
        "01-home",
        "turns multiplied by the factor instead of divided",
        """
def home(start, steps, docked):
    s = steps.copy()
    edges = [0, *docked]
    factor = np.mean([abs(s[a:b, 2].sum()) for a, b in pairwise(edges)]) / (2 * np.pi)
    s[:, 2] *= factor
    out = [start]
    for a, b in pairwise(edges):
        p = track(start, s[a:b])
        p[:, :2] += np.linspace(0, 1, b - a + 1)[:, None] * (start[:2] - p[-1, :2])
        out.extend(p[1:])
    out.extend(track(start, s[edges[-1]:])[1:])
    return np.array(out)
""",
    ),
    (
        "01-home",
        "the factor alone, then dead reckoning all the way",
        """
def home(start, steps, docked):
    edges = [0, *docked]
    told = [abs(steps[a:b, 2].sum()) for a, b in pairwise(edges)]
    return track(start, steps / [1, 1, np.mean(told) / (2 * np.pi)])
""",
    ),
    (
        "01-home",
        "corrects only half of the factor, to be careful; the gap on the last step",
        """
def home(start, steps, docked):
    steps = steps.copy()
    edges = [0, *docked]
    told = [abs(steps[a:b, 2].sum()) for a, b in pairwise(edges)]
    steps[:, 2] *= (1 + 2 * np.pi / np.mean(told)) / 2
    poses = [start]
    for k in range(len(steps)):
        poses.append(np.array(start) if k + 1 in docked else next_pose(poses[-1], steps[k]))
    return np.array(poses)
""",
    ),
    (
        "01-home",
        "factor from the whole drive, the way beyond included",
        """
def home(start, steps, docked):
    steps = steps.copy()
    factor = abs(steps[:, 2].sum()) / (2 * np.pi * len(docked))
    steps[:, 2] /= factor
    out = [start[None]]
    for a, b in pairwise([0, *docked]):
        p = track(start, steps[a:b])
        p[:, :2] += np.linspace(0, 1, len(p))[:, None] * (start[:2] - p[-1, :2])
        out.append(p[1:])
    out.append(track(start, steps[docked[-1]:])[1:])
    return np.concatenate(out)
""",
    ),
    (
        "01-home",
        "works in place on the steps",
        """
def home(start, steps, docked):
    laps = list(zip([0, *docked[:-1]], docked))
    told = np.array([abs(steps[i:j, 2].sum()) for i, j in laps])
    steps[:, 2] /= told.mean() / (2 * np.pi)
    poses = [np.array([start])]
    for i, j in laps:
        lap = steps[i:j].copy()
        total = lap[:, 2].sum()
        lap[:, 2] += (2 * np.pi * np.sign(total) - total) / len(lap)
        p = track(start, lap)
        p[:, :2] += np.linspace(0, 1, len(p))[:, None] * (start[:2] - p[-1, :2])
        poses.append(p[1:])
    poses.append(track(start, steps[docked[-1]:])[1:])
    return np.concatenate(poses)
""",
    ),
    (
        "01-home",
        "docked poses twice: n + laps + 2 rows",
        """
def home(start, steps, docked):
    steps = steps.copy()
    laps = list(zip([0, *docked[:-1]], docked))
    told = np.array([abs(steps[i:j, 2].sum()) for i, j in laps])
    steps[:, 2] /= told.mean() / (2 * np.pi)
    poses = []
    for i, j in laps:
        lap = steps[i:j].copy()
        total = lap[:, 2].sum()
        lap[:, 2] += (2 * np.pi * np.sign(total) - total) / len(lap)
        p = track(start, lap)
        p[:, :2] += np.linspace(0, 1, len(p))[:, None] * (start[:2] - p[-1, :2])
        poses.append(p)
    poses.append(track(start, steps[docked[-1]:]))
    return np.concatenate(poses)
""",
    ),
    (
        "01-home",
        "a known factor: turns divided by 1.095 or 0.905, the nearer",
        """
def home(start, steps, docked):
    steps = steps.copy()
    too_large = abs(steps[:docked[0], 2].sum()) > 2 * np.pi
    steps[:, 2] /= 1.095 if too_large else 0.905
    out = [start[None]]
    for a, b in pairwise([0, *docked]):
        p = track(start, steps[a:b])
        p[:, :2] += np.linspace(0, 1, len(p))[:, None] * (start[:2] - p[-1, :2])
        out.append(p[1:])
    out.append(track(start, steps[docked[-1]:])[1:])
    return np.concatenate(out)
""",
    ),
    (
        "01-home",
        "the gap in world coordinates, shared over the whole drive at its last docking only",
        """
def home(start, steps, docked):
    steps = steps.copy()
    told = [abs(steps[a:b, 2].sum()) for a, b in pairwise([0, *docked])]
    steps[:, 2] *= 2 * np.pi / np.mean(told)
    poses = track(start, steps)
    gap = start[:2] - poses[docked[-1], :2]
    share = np.minimum(np.arange(len(poses)) / docked[-1], 1)
    poses[:, :2] += share[:, None] * gap
    return poses
""",
    ),
    (
        "01-home",
        "off by one: laps end one step early",
        """
def home(start, steps, docked):
    steps = steps.copy()
    laps = list(zip([0, *docked[:-1]], [d - 1 for d in docked]))
    told = np.array([abs(steps[i:j, 2].sum()) for i, j in laps])
    steps[:, 2] /= told.mean() / (2 * np.pi)
    poses = [start]
    for i, j in laps:
        p = track(start, steps[i:j])
        p[:, :2] += np.linspace(0, 1, len(p))[:, None] * (start[:2] - p[-1, :2])
        poses.extend(p[1:])
        poses.append(start)
    poses.extend(track(start, steps[docked[-1]:])[1:])
    return np.array(poses)
""",
    ),
]
