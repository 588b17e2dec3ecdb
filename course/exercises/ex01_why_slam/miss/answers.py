# %% way: covariance step by step
def miss(poses, length_error, heading_error):
    P = np.zeros((3, 3))
    for before, after in zip(poses[:-1], poses[1:]):
        dx, dy = after[:2] - before[:2]
        F = np.array([[1, 0, -dy], [0, 1, dx], [0, 0, 1]])
        q = length_error * np.array([dx, dy, 0])
        P = F @ P @ F.T + np.outer(q, q)
        P[2, 2] += heading_error**2
    return np.sqrt(np.diag(P)[:2])

# %% way: error by error
def miss(poses, length_error, heading_error):
    import math

    x_end, y_end = poses[-1][0], poses[-1][1]
    var_x = var_y = 0.0
    for k in range(1, len(poses)):
        x, y = poses[k][0], poses[k][1]
        var_x += (length_error * (x - poses[k - 1][0])) ** 2
        var_y += (length_error * (y - poses[k - 1][1])) ** 2
        var_x += (heading_error * (y_end - y)) ** 2
        var_y += (heading_error * (x_end - x)) ** 2
    return math.sqrt(var_x), math.sqrt(var_y)

# %% way: one Jacobian
def miss(poses, length_error, heading_error):
    n = len(poses) - 1
    J = np.zeros((2, 2 * n))
    for k in range(n):
        J[:, k] = poses[k + 1, :2] - poses[k, :2]
        rest = poses[n, :2] - poses[k + 1, :2]
        J[:, n + k] = [-rest[1], rest[0]]
    C = np.diag([length_error**2] * n + [heading_error**2] * n)
    return [float(v) for v in np.sqrt(np.diag(J @ C @ J.T))]

# %% way: in each step's frame
def miss(poses, length_error, heading_error):
    x, y, theta = poses.T
    seen = [seen_from(a, b)[:2] for a, b in zip(poses[:-1], poses[1:])]
    moved = length_error * np.array(seen).reshape(-1, 2)
    c, s = np.cos(theta[:-1]), np.sin(theta[:-1])
    in_x, in_y = c * moved[:, 0] - s * moved[:, 1], s * moved[:, 0] + c * moved[:, 1]
    far, way = np.hypot(x - x[-1], y - y[-1])[1:], np.arctan2(y[-1] - y, x[-1] - x)[1:]
    in_x = np.append(in_x, -heading_error * far * np.sin(way))
    in_y = np.append(in_y, heading_error * far * np.cos(way))
    return np.array([np.linalg.norm(in_x), np.linalg.norm(in_y)])

# %% pasted: the formula of a straight drive
def miss(poses, length_error, heading_error):
    n = len(poses) - 1
    way = np.hypot(*(poses[-1] - poses[0])[:2])
    d = way / max(n, 1)
    return [length_error * d * np.sqrt(n), drift(n, d, heading_error)]

# %% pasted: the same, turned into the world
def miss(poses, length_error, heading_error):
    n = len(poses) - 1
    ahead, left = seen_from(poses[0], poses[-1])[:2]
    way = np.arctan2(ahead, left)
    d = np.hypot(ahead, left) / max(n, 1)
    along, across = length_error * d * np.sqrt(n), drift(n, d, heading_error)
    c, s = np.cos(way), np.sin(way)
    return np.sqrt([(c * along) ** 2 + (s * across) ** 2, (s * along) ** 2 + (c * across) ** 2])

# %% pasted: the lesson's spread of two thousand robots
def miss(poses, length_error, heading_error, robots=200):
    rng, n = np.random.default_rng(2), len(poses) - 1
    step = np.hypot(*np.diff(poses[:, :2], axis=0).T)
    lengths = step * (1 + length_error * rng.standard_normal((robots, n)))
    errors = heading_error * rng.standard_normal((robots, n))
    headings = np.cumsum(errors, axis=1) - errors
    along, across = lengths * np.cos(headings), lengths * np.sin(headings)
    return [along.sum(axis=1).std(), across.sum(axis=1).std()]

# %% right: by length and direction of each arm
def miss(poses, length_error, heading_error):
    moved, arm = np.diff(poses[:, :2], axis=0), poses[-1, :2] - poses[1:, :2]
    across = np.arctan2(arm[:, 1], arm[:, 0]) + np.pi / 2
    turned = np.hypot(*arm.T)[:, None] * np.column_stack([np.cos(across), np.sin(across)])
    return np.sqrt(((length_error * moved) ** 2 + (heading_error * turned) ** 2).sum(axis=0))

# %% right: one matrix of all influences
def miss(poses, length_error, heading_error):
    p = poses[:, :2]
    by_length = length_error * (p[1:] - p[:-1])
    arms = p[-1] - p[1:]
    by_heading = heading_error * np.column_stack([-arms[:, 1], arms[:, 0]])
    return np.linalg.norm(np.vstack([by_length, by_heading]), axis=0)

# %% wrong: np.std of the poses
def miss(poses, length_error, heading_error):
    return length_error * np.std(poses[:, 0]), heading_error * np.std(poses[:, 1])

# %% wrong: poses shifted in place to the end
def miss(poses, length_error, heading_error):
    xy = poses[:, :2]
    step = np.diff(xy, axis=0)
    xy -= xy[-1].copy()
    v = length_error ** 2 * np.sum(step ** 2, axis=0) + heading_error ** 2 * np.sum(xy[1:, ::-1] ** 2, axis=0)
    return np.sqrt(v)

# %% wrong: fails for a track of one pose
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

# %% wrong: differences of the end, for each error
def miss(poses, length_error, heading_error):
    z = poses[:, 0] + 1j * poses[:, 1]
    steps, small = np.diff(z), 1e-6

    def end(longer, turned):
        bent = np.cumsum(turned) - turned
        return np.sum(steps * (1 + longer) * np.exp(1j * bent))

    none = np.zeros(len(steps))
    total = np.zeros(2)
    for k in range(len(steps)):
        one = none.copy()
        one[k] = small
        for error, ends in (
            (length_error, end(one, none) - end(-one, none)),
            (heading_error, end(none, one) - end(none, -one)),
        ):
            total += (error * np.array([ends.real, ends.imag]) / (2 * small)) ** 2
    return np.sqrt(total)
