"""Right ways through 01-miss other than the solution."""

WAYS = {
    "covariance step by step": """
def miss(poses, length_error, heading_error):
    P = np.zeros((3, 3))
    for before, after in zip(poses[:-1], poses[1:]):
        dx, dy = after[:2] - before[:2]
        F = np.array([[1, 0, -dy], [0, 1, dx], [0, 0, 1]])
        q = length_error * np.array([dx, dy, 0])
        P = F @ P @ F.T + np.outer(q, q)
        P[2, 2] += heading_error**2
    return np.sqrt(np.diag(P)[:2])
""",
    "error by error": """
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
""",
    "differences": """
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
""",
    "one Jacobian": """
def miss(poses, length_error, heading_error):
    n = len(poses) - 1
    J = np.zeros((2, 2 * n))
    for k in range(n):
        J[:, k] = poses[k + 1, :2] - poses[k, :2]
        rest = poses[n, :2] - poses[k + 1, :2]
        J[:, n + k] = [-rest[1], rest[0]]
    C = np.diag([length_error**2] * n + [heading_error**2] * n)
    return [float(v) for v in np.sqrt(np.diag(J @ C @ J.T))]
""",
    "in each step's frame": """
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
""",
}
