# %% way: every corner tried
def edges(z, bounds, heading, box):
    (r, beta), (d_r, d_beta), (right, left) = z, bounds, heading
    u, d = (right + left) / 2 + beta, d_beta + (left - right) / 2
    found = []
    for angle, c in (
        (u, r + d_r),
        (u + np.pi, -(r - d_r) * np.cos(d)),
        (u + d + np.pi / 2, 0.0),
        (u - d - np.pi / 2, 0.0),
    ):
        a, b = np.cos(angle), np.sin(angle)
        found.append((a, b, c + max(a * x + b * y for x in box[:2] for y in box[2:])))
    return found

# %% way: pushed by half the sides
def edges(z, bounds, heading, box):
    direction = np.mean(heading) + z[1]
    d_abs = bounds[1] + np.ptp(heading) / 2
    angles = direction + np.array([0, np.pi, d_abs + np.pi / 2, -d_abs - np.pi / 2])
    n = np.column_stack([np.cos(angles), np.sin(angles)])
    middle, half = np.reshape(box, (2, 2)).mean(axis=1), np.ptp(np.reshape(box, (2, 2)), axis=1) / 2
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d_abs), 0, 0])
    return np.column_stack([n, c + n @ middle + np.abs(n) @ half])

# %% way: normals of any length
def edges(z, bounds, heading, box):
    r, d_r = z[0], bounds[0]
    low, high = heading[0] + z[1] - bounds[1], heading[1] + z[1] + bounds[1]
    u = (low + high) / 2
    rows = [
        (np.cos(u), np.sin(u), r + d_r),
        (-np.cos(u), -np.sin(u), -(r - d_r) * np.cos((high - low) / 2)),
        (-np.sin(high), np.cos(high), 0),
        (np.sin(low), -np.cos(low), 0),
    ]
    out = []
    for a, b, c in rows:
        x, y = box[1] if a > 0 else box[0], box[3] if b > 0 else box[2]
        out.append([3 * a, 3 * b, 3 * (c + a * x + b * y)])
    return np.array(out)

# %% way: through the points of the ring
def edges(z, bounds, heading, box):
    u, d = (heading[0] + heading[1]) / 2 + z[1], bounds[1] + (heading[1] - heading[0]) / 2
    ahead = np.array([np.cos(u), np.sin(u)])
    to_left = np.array([np.cos(u + d), np.sin(u + d)])
    to_right = np.array([np.cos(u - d), np.sin(u - d)])
    tip, corner = (z[0] + bounds[0]) * ahead, (z[0] - bounds[0]) * to_left
    normals = [ahead, -ahead, np.array([-to_left[1], to_left[0]]), np.array([to_right[1], -to_right[0]])]
    through = [tip, corner, to_left, to_right]
    corners = np.array([[x, y] for x in box[:2] for y in box[2:]])
    return [[*n, n @ p + (corners @ n).max()] for n, p in zip(normals, through)]

# %% right: support over the four corners, rows not of unit length
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

# %% right: middle and half width of the box, list of rows
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

# %% wrong: the bearing is turned into the world in place (z changed)
def edges(z, bounds, heading, box):
    d = bounds[1] + (heading[1] - heading[0]) / 2
    z[1] += (heading[0] + heading[1]) / 2
    angles = z[1] + np.array([0, np.pi, d + np.pi / 2, -d - np.pi / 2])
    a, b = np.cos(angles), np.sin(angles)
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0])
    c = c + np.maximum(a * box[0], a * box[1]) + np.maximum(b * box[2], b * box[3])
    return np.column_stack([a, b, c])

# %% wrong: the near edge is pushed inwards (minus the most)
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

# %% wrong: rows c, a, b
def edges(z, bounds, heading, box):
    t = np.mean(heading) + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    n = [(np.cos(t), np.sin(t)), (-np.cos(t), -np.sin(t)), (-np.sin(t + d), np.cos(t + d)), (np.sin(t - d), -np.cos(t - d))]
    c = [z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0]
    push = lambda v: max(v[0] * box[0], v[0] * box[1]) + max(v[1] * box[2], v[1] * box[3])
    return np.array([[k + push(v), *v] for v, k in zip(n, c)])
