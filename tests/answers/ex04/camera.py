"""Independent answers to 04-camera: right ones, and students' mistakes."""

RIGHT = [
    (
        "04-camera",
        "complex step",
        """
def camera(x, p, mount, F):
    def column(v):
        c, s = np.cos(v[2]), np.sin(v[2])
        dx, dy = v[3] - v[0], v[4] - v[1]
        return -F * (-s * dx + c * dy - mount[1]) / (c * dx + s * dy - mount[0])

    v = np.concatenate([x, p]).astype(complex)
    H = np.empty(5)
    for k in range(5):
        w = v.copy()
        w[k] += 1e-30j
        H[k] = column(w).imag / 1e-30
    return float(column(v).real), H
""",
    ),
    (
        "04-camera",
        "pose of the camera, bearing and chain rule",
        """
def camera(x, p, mount, F):
    a, b = mount
    c, s = np.cos(x[2]), np.sin(x[2])
    cx, cy = x[0] + c * a - s * b, x[1] + s * a + c * b
    dx, dy = p[0] - cx, p[1] - cy
    q = dx * dx + dy * dy
    bearing = np.arctan2(dy, dx) - x[2]
    by_cam = np.array([dy / q, -dx / q])
    by_theta = by_cam @ [-s * a - c * b, c * a - s * b] - 1
    db = np.array([by_cam[0], by_cam[1], by_theta, -by_cam[0], -by_cam[1]])
    return -F * np.tan(bearing), -F / np.cos(bearing) ** 2 * db
""",
    ),
    (
        "04-camera",
        "u and matrix product",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    robot = R @ (p - x[:2])
    X, Y = robot - mount
    du = np.array([F * Y / X**2, -F / X])
    D = np.hstack([-R, [[robot[1]], [-robot[0]]], R])
    return -F * Y / X, du @ D
""",
    ),
    (
        "04-camera",
        "H as a (1, 5) matrix",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    D = np.column_stack([-R, [body[1], -body[0]], R])
    return -F * Y / X, np.array([[F * Y / X**2, -F / X]]) @ D
""",
    ),
]

WRONG = [
    (
        "04-camera",
        "mount ignored",
        """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    dx, dy = p - x[:2]
    X, Y = c * dx + s * dy, -s * dx + c * dy
    H = -F / X**2 * (X * np.array([s, -c, -X, -s, c]) - Y * np.array([-c, -s, Y, c, s]))
    return -F * Y / X, H
""",
    ),
    (
        "04-camera",
        "mount subtracted in the world's frame",
        """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    dx, dy = p - x[:2] - mount
    X, Y = c * dx + s * dy, -s * dx + c * dy
    H = -F / X**2 * (X * np.array([s, -c, -X, -s, c]) - Y * np.array([-c, -s, Y, c, s]))
    return -F * Y / X, H
""",
    ),
    (
        "04-camera",
        "turn about the camera, not about the robot's centre",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    X, Y = R @ (p - x[:2]) - mount
    D = np.column_stack([-R, [Y, -X], R])
    return -F * Y / X, np.array([F * Y / X**2, -F / X]) @ D
""",
    ),
    (
        "04-camera",
        "column counted to the left (sign of u)",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    D = np.column_stack([-R, [body[1], -body[0]], R])
    return F * Y / X, np.array([-F * Y / X**2, F / X]) @ D
""",
    ),
    (
        "04-camera",
        "landmark's derivatives first",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    D = np.column_stack([R, -R, [body[1], -body[0]]])
    return -F * Y / X, np.array([F * Y / X**2, -F / X]) @ D
""",
    ),
    (
        "04-camera",
        "plus in the quotient rule",
        """
def camera(x, p, mount, F):
    dx, dy = p[0] - x[0], p[1] - x[1]
    c, s = np.cos(x[2]), np.sin(x[2])
    ahead, left = c * dx + s * dy, c * dy - s * dx
    X, Y = ahead - mount[0], left - mount[1]
    X_by = np.array([-c, -s, left, c, s])
    Y_by = np.array([s, -c, -ahead, -s, c])
    return -F * Y / X, -F * (Y_by * X + Y * X_by) / X**2
""",
    ),
    (
        "04-camera",
        "only the derivative of Y: X taken as constant",
        """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    dx, dy = p - x[:2]
    ahead, left = c * dx + s * dy, c * dy - s * dx
    X, Y = ahead - mount[0], left - mount[1]
    return -F * Y / X, -F / X * np.array([s, -c, -ahead, -s, c])
""",
    ),
    (
        "04-camera",
        "rotates by theta instead of -theta",
        """
def camera(x, p, mount, F):
    def column(v):
        c, s = np.cos(v[2]), np.sin(v[2])
        dx, dy = v[3] - v[0], v[4] - v[1]
        return -F * (s * dx + c * dy - mount[1]) / (c * dx - s * dy - mount[0])

    v = np.r_[x, p].astype(complex)
    H = np.array([column(v + 1e-20j * e).imag / 1e-20 for e in np.eye(5)])
    return column(v).real, H
""",
    ),
    (
        "04-camera",
        "mount read as [left, ahead]",
        """
def camera(x, p, mount, F):
    b, a = mount
    c, s = np.cos(x[2]), np.sin(x[2])
    ahead, left = c * (p[0] - x[0]) + s * (p[1] - x[1]), c * (p[1] - x[1]) - s * (p[0] - x[0])
    X, Y = ahead - a, left - b
    dX, dY = F * Y / X**2, -F / X
    return -F * Y / X, np.array([
        -dX * c + dY * s, -dX * s - dY * c, dX * left - dY * ahead, dX * c - dY * s, dX * s + dY * c
    ])
""",
    ),
    (
        "04-camera",
        "mount added instead of subtracted",
        """
def camera(x, p, mount, F):
    c, s = np.cos(x[2]), np.sin(x[2])
    dx, dy = p - x[:2]
    ahead, left = c * dx + s * dy, c * dy - s * dx
    X, Y = ahead + mount[0], left + mount[1]
    X_by, Y_by = np.array([-c, -s, left, c, s]), np.array([s, -c, -ahead, -s, c])
    return -F * Y / X, -F * (Y_by * X - Y * X_by) / X**2
""",
    ),
    (
        "04-camera",
        "only the pose's three derivatives, zeros for the landmark",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    by = np.array([F * Y / X**2, -F / X])
    H = np.zeros(5)
    H[:2] = -by @ R
    H[2] = by @ [body[1], -body[0]]
    return -F * Y / X, H
""",
    ),
    (
        "04-camera",
        "F as in the picture: hard-coded 500 in H",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    D = np.column_stack([-R, [body[1], -body[0]], R])
    return -F * Y / X, 500 * np.array([Y / X**2, -1 / X]) @ D
""",
    ),
    (
        "04-camera",
        "column rounded to a whole pixel",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    D = np.column_stack([-R, [body[1], -body[0]], R])
    return round(-F * Y / X), np.array([F * Y / X**2, -F / X]) @ D
""",
    ),
    (
        "04-camera",
        "proportional to the bearing (small angles) instead of Y / X",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    q = X**2 + Y**2
    D = np.column_stack([-R, [body[1], -body[0]], R])
    return -F * np.arctan2(Y, X), -F * np.array([-Y / q, X / q]) @ D
""",
    ),
    (
        "04-camera",
        "differences with a step so small that rounding eats them",
        """
def camera(x, p, mount, F):
    def column(v):
        c, s = np.cos(v[2]), np.sin(v[2])
        dx, dy = v[3] - v[0], v[4] - v[1]
        return -F * (c * dy - s * dx - mount[1]) / (c * dx + s * dy - mount[0])

    v = np.concatenate([x, p])
    u = column(v)
    return u, np.array([(column(v + e) - u) / 1e-13 for e in 1e-13 * np.eye(5)])
""",
    ),
    (
        "04-camera",
        "p made relative in place",
        """
def camera(x, p, mount, F):
    p -= x[:2]
    c, s = np.cos(x[2]), np.sin(x[2])
    ahead, left = c * p[0] + s * p[1], c * p[1] - s * p[0]
    X, Y = ahead - mount[0], left - mount[1]
    X_by, Y_by = np.array([-c, -s, left, c, s]), np.array([s, -c, -ahead, -s, c])
    return -F * Y / X, -F * (Y_by * X - Y * X_by) / X**2
""",
    ),
    (
        "04-camera",
        "u cut at the image's border",
        """
def camera(x, p, mount, F):
    R = np.array([[np.cos(x[2]), np.sin(x[2])], [-np.sin(x[2]), np.cos(x[2])]])
    body = R @ (p - x[:2])
    X, Y = body - mount
    D = np.column_stack([-R, [body[1], -body[0]], R])
    return float(np.clip(-F * Y / X, -F, F)), np.array([F * Y / X**2, -F / X]) @ D
""",
    ),
]
