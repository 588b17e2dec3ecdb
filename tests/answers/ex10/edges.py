"""Independent answers to 10-edges: right ones, and students' mistakes."""

RIGHT = [
    (
        "10-edges",
        "support over the four corners, rows not of unit length",
        """
def edges(z, bounds, heading, box):
    r, beta = z
    spread = bounds[1] + 0.5 * (heading[1] - heading[0])
    u = 0.5 * (heading[0] + heading[1]) + beta
    normals = 2.0 * np.array(
        [
            [np.cos(u), np.sin(u)],
            [np.cos(u + np.pi), np.sin(u + np.pi)],
            [np.cos(u + spread + np.pi / 2), np.sin(u + spread + np.pi / 2)],
            [np.cos(u - spread - np.pi / 2), np.sin(u - spread - np.pi / 2)],
        ]
    )
    offsets = 2.0 * np.array([r + bounds[0], -(r - bounds[0]) * np.cos(spread), 0.0, 0.0])
    corners = np.array([[x, y] for x in (box[0], box[1]) for y in (box[2], box[3])])
    return np.column_stack([normals, offsets + (normals @ corners.T).max(axis=1)])
""",
    ),
    (
        "10-edges",
        "middle and half width of the box, list of rows",
        """
def edges(z, bounds, heading, box):
    mid = heading[0] + (heading[1] - heading[0]) / 2
    d_abs = (heading[1] - heading[0]) / 2 + bounds[1]
    phi = wrap(mid + z[1])
    cx, cy = (box[0] + box[1]) / 2, (box[2] + box[3]) / 2
    hx, hy = (box[1] - box[0]) / 2, (box[3] - box[2]) / 2
    out = []
    for angle, c in (
        (phi, z[0] + bounds[0]),
        (phi - np.pi, (bounds[0] - z[0]) * np.cos(d_abs)),
        (phi + d_abs + np.pi / 2, 0),
        (phi - d_abs - np.pi / 2, 0),
    ):
        a, b = np.cos(angle), np.sin(angle)
        out.append([a, b, c + a * cx + b * cy + abs(a) * hx + abs(b) * hy])
    return np.array(out)
""",
    ),
]

WRONG = [
    (
        "10-edges",
        "near edge at r - d_r, cosine forgotten",
        """
def edges(z, bounds, heading, box):
    u = np.mean(heading) + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    e = np.array([np.cos(u), np.sin(u)])
    left = np.array([-np.sin(u + d), np.cos(u + d)])
    right = np.array([np.sin(u - d), -np.cos(u - d)])
    rows = []
    for n, c in ((e, z[0] + bounds[0]), (-e, bounds[0] - z[0]), (left, 0.0), (right, 0.0)):
        push = max(n @ [x, y] for x in box[:2] for y in box[2:])
        rows.append([n[0], n[1], c + push])
    return np.array(rows)
""",
    ),
    (
        "10-edges",
        "cosine of the bearing's bound only in the near edge",
        """
def edges(z, bounds, heading, box):
    u = np.mean(heading) + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    angles = np.array([u, u + np.pi, u + d + np.pi / 2, u - d - np.pi / 2])
    a, b = np.cos(angles), np.sin(angles)
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(bounds[1]), 0, 0])
    c = c + np.maximum(a * box[0], a * box[1]) + np.maximum(b * box[2], b * box[3])
    return np.column_stack([a, b, c])
""",
    ),
    (
        "10-edges",
        "whole width of the heading in place of half",
        """
def edges(z, bounds, heading, box):
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + heading[1] - heading[0]
    angles = np.array([u, u + np.pi, u + d + np.pi / 2, u - d - np.pi / 2])
    a, b = np.cos(angles), np.sin(angles)
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0])
    c += np.where(a > 0, a * box[1], a * box[0]) + np.where(b > 0, b * box[3], b * box[2])
    return np.stack([a, b, c], axis=1)
""",
    ),
    (
        "10-edges",
        "normals of the side edges point in",
        """
def edges(z, bounds, heading, box):
    direction = (heading[0] + heading[1]) / 2 + z[1]
    d_abs = bounds[1] + (heading[1] - heading[0]) / 2
    left, right = direction + d_abs, direction - d_abs
    rows = np.array(
        [
            [np.cos(direction), np.sin(direction), z[0] + bounds[0]],
            [-np.cos(direction), -np.sin(direction), -(z[0] - bounds[0]) * np.cos(d_abs)],
            [np.sin(left), -np.cos(left), 0],
            [-np.sin(right), np.cos(right), 0],
        ]
    )
    for row in rows:
        a, b, _ = row
        row[2] += max(a * box[0], a * box[1]) + max(b * box[2], b * box[3])
    return rows
""",
    ),
    (
        "10-edges",
        "order near, far, left, right",
        """
def edges(z, bounds, heading, box):
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2

    def moved(angle, c):
        a, b = np.cos(angle), np.sin(angle)
        return a, b, c + max(a * x + b * y for x in box[:2] for y in box[2:])

    near = moved(u + np.pi, -(z[0] - bounds[0]) * np.cos(d))
    far = moved(u, z[0] + bounds[0])
    return np.array([near, far, moved(u + d + np.pi / 2, 0), moved(u - d - np.pi / 2, 0)])
""",
    ),
    (
        "10-edges",
        "pushed by half the diagonal of the box: sound, not tight",
        """
def edges(z, bounds, heading, box):
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    middle = np.array([box[0] + box[1], box[2] + box[3]]) / 2
    radius = np.hypot(box[1] - box[0], box[3] - box[2]) / 2
    angles = np.array([u, u + np.pi, u + d + np.pi / 2, u - d - np.pi / 2])
    n = np.column_stack([np.cos(angles), np.sin(angles)])
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0])
    return np.column_stack([n, c + n @ middle + radius])
""",
    ),
    (
        "10-edges",
        "every edge pushed by the same corner (x_max, y_max)",
        """
def edges(z, bounds, heading, box):
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    rows = np.array(
        [
            [np.cos(u), np.sin(u), z[0] + bounds[0]],
            [-np.cos(u), -np.sin(u), -(z[0] - bounds[0]) * np.cos(d)],
            [-np.sin(u + d), np.cos(u + d), 0],
            [np.sin(u - d), -np.cos(u - d), 0],
        ]
    )
    rows[:, 2] += rows[:, 0] * box[1] + rows[:, 1] * box[3]
    return rows
""",
    ),
    (
        "10-edges",
        "box read as x_min, y_min, x_max, y_max",
        """
def edges(z, bounds, heading, box):
    x_min, y_min, x_max, y_max = box
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    rows = []
    for angle, c in (
        (u, z[0] + bounds[0]),
        (u + np.pi, -(z[0] - bounds[0]) * np.cos(d)),
        (u + d + np.pi / 2, 0),
        (u - d - np.pi / 2, 0),
    ):
        a, b = np.cos(angle), np.sin(angle)
        rows.append([a, b, c + max(a * x_min, a * x_max) + max(b * y_min, b * y_max)])
    return np.array(rows)
""",
    ),
    (
        "10-edges",
        "middle of the heading from wrapped ends: opposite direction over the seam",
        """
def edges(z, bounds, heading, box):
    u = (wrap(heading[0]) + wrap(heading[1])) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    angles = np.array([u, u + np.pi, u + d + np.pi / 2, u - d - np.pi / 2])
    a, b = np.cos(angles), np.sin(angles)
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0])
    c = c + np.maximum(a * box[0], a * box[1]) + np.maximum(b * box[2], b * box[3])
    return np.column_stack([a, b, c])
""",
    ),
    (
        "10-edges",
        "far edge through the outer corners: cuts the bulge off",
        """
def edges(z, bounds, heading, box):
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    angles = np.array([u, u + np.pi, u + d + np.pi / 2, u - d - np.pi / 2])
    a, b = np.cos(angles), np.sin(angles)
    c = np.array([z[0] + bounds[0], bounds[0] - z[0], 0, 0]) * np.cos(d)
    c = c + np.maximum(a * box[0], a * box[1]) + np.maximum(b * box[2], b * box[3])
    return np.column_stack([a, b, c])
""",
    ),
    (
        "10-edges",
        "pushed by the largest absolute coordinate: too wide away from the origin",
        """
def edges(z, bounds, heading, box):
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    rows = np.array(
        [
            [np.cos(u), np.sin(u), z[0] + bounds[0]],
            [-np.cos(u), -np.sin(u), -(z[0] - bounds[0]) * np.cos(d)],
            [-np.sin(u + d), np.cos(u + d), 0],
            [np.sin(u - d), -np.cos(u - d), 0],
        ]
    )
    x, y = np.abs(box[:2]).max(), np.abs(box[2:]).max()
    rows[:, 2] += np.abs(rows[:, 0]) * x + np.abs(rows[:, 1]) * y
    return rows
""",
    ),
    (
        "10-edges",
        "rows scaled so that c is 1: turned round where c is negative",
        """
def edges(z, bounds, heading, box):
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    angles = np.array([u, u + np.pi, u + d + np.pi / 2, u - d - np.pi / 2])
    a, b = np.cos(angles), np.sin(angles)
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0])
    c = c + np.maximum(a * box[0], a * box[1]) + np.maximum(b * box[2], b * box[3])
    return np.column_stack([a, b, c]) / c[:, None]
""",
    ),
    (
        "10-edges",
        "the bearing is turned into the world in place (z changed)",
        """
def edges(z, bounds, heading, box):
    d = bounds[1] + (heading[1] - heading[0]) / 2
    z[1] += (heading[0] + heading[1]) / 2
    angles = z[1] + np.array([0, np.pi, d + np.pi / 2, -d - np.pi / 2])
    a, b = np.cos(angles), np.sin(angles)
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0])
    c = c + np.maximum(a * box[0], a * box[1]) + np.maximum(b * box[2], b * box[3])
    return np.column_stack([a, b, c])
""",
    ),
    (
        "10-edges",
        "d_abs without the bearing's own bound",
        """
def edges(z, bounds, heading, box):
    direction = np.mean(heading) + z[1]
    d_abs = np.ptp(heading) / 2
    lines = []
    for turn, c in (
        (0, z[0] + bounds[0]),
        (np.pi, -(z[0] - bounds[0]) * np.cos(d_abs)),
        (np.pi / 2 + d_abs, 0),
        (-np.pi / 2 - d_abs, 0),
    ):
        a, b = np.cos(direction + turn), np.sin(direction + turn)
        lines.append([a, b, c + max(a * box[0], a * box[1]) + max(b * box[2], b * box[3])])
    return np.array(lines)
""",
    ),
    (
        "10-edges",
        "the near edge is pushed inwards (minus the most)",
        """
def edges(z, bounds, heading, box):
    def most(a, b):
        return max(a * box[0], a * box[1]) + max(b * box[2], b * box[3])

    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    c, s = np.cos(u), np.sin(u)
    far = [c, s, z[0] + bounds[0] + most(c, s)]
    near = [-c, -s, -((z[0] - bounds[0]) * np.cos(d) + most(c, s))]
    a, b = -np.sin(u + d), np.cos(u + d)
    left = [a, b, most(a, b)]
    a, b = np.sin(u - d), -np.cos(u - d)
    return np.array([far, near, left, [a, b, most(a, b)]])
""",
    ),
]
