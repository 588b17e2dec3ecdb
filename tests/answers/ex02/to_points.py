"""Independent answers to 02-to-points: right ones, and students' mistakes."""

RIGHT = [
    (
        "02-to-points",
        "compose the poses by hand, then one rotation",
        """
def to_points(degrees, millimetres, mount, pose):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    x = pose[0] + c * mount[0] - s * mount[1]
    y = pose[1] + s * mount[0] + c * mount[1]
    theta = pose[2] + mount[2]
    hit = millimetres != 0
    angle = theta - np.deg2rad(degrees[hit])
    r = millimetres[hit] * 1e-3
    return np.stack([x + r * np.cos(angle), y + r * np.sin(angle)], axis=1)
""",
    ),
    (
        "02-to-points",
        "a loop, reshape for no rows",
        """
def to_points(degrees, millimetres, mount, pose):
    def matrix(q):
        return np.array([[np.cos(q[2]), -np.sin(q[2]), q[0]], [np.sin(q[2]), np.cos(q[2]), q[1]], [0, 0, 1]])

    T = matrix(pose) @ matrix(mount)
    points = []
    for d, mm in zip(degrees, millimetres):
        if mm > 0:
            a, r = np.radians(-d), mm / 1000
            points.append((T @ [r * np.cos(a), r * np.sin(a), 1])[:2])
    return np.array(points).reshape(-1, 2)
""",
    ),
    (
        "02-to-points",
        "rows appended to a list, of which none is np.array([])",
        """
def to_points(degrees, millimetres, mount, pose):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    x0, y0 = pose[0] + c * mount[0] - s * mount[1], pose[1] + s * mount[0] + c * mount[1]
    rows = []
    for d, mm in zip(degrees, millimetres):
        if mm > 0:
            a = pose[2] + mount[2] - np.radians(d)
            rows.append([x0 + mm / 1000 * np.cos(a), y0 + mm / 1000 * np.sin(a)])
    return np.array(rows)
""",
    ),
]

WRONG = [
    (
        "02-to-points",
        "counter-clockwise",
        """
def to_points(degrees, millimetres, mount, pose):
    back = millimetres > 0
    a, r = np.radians(degrees[back]), millimetres[back] / 1000
    q = np.column_stack([r * np.cos(a), r * np.sin(a)])
    for f in (mount, pose):
        c, s = np.cos(f[2]), np.sin(f[2])
        q = q @ np.array([[c, s], [-s, c]]) + f[:2]
    return q
""",
    ),
    (
        "02-to-points",
        "readings of 0 stay, as points at the sensor",
        """
def to_points(degrees, millimetres, mount, pose):
    a, r = -np.radians(degrees), millimetres / 1000
    q = np.column_stack([r * np.cos(a), r * np.sin(a)])
    for f in (mount, pose):
        c, s = np.cos(f[2]), np.sin(f[2])
        q = q @ np.array([[c, s], [-s, c]]) + f[:2]
    return q
""",
    ),
    (
        "02-to-points",
        "centimetres: divides by 100",
        """
def to_points(degrees, millimetres, mount, pose):
    back = millimetres > 0
    a, r = -np.radians(degrees[back]), millimetres[back] / 100
    q = np.column_stack([r * np.cos(a), r * np.sin(a)])
    for f in (mount, pose):
        c, s = np.cos(f[2]), np.sin(f[2])
        q = q @ np.array([[c, s], [-s, c]]) + f[:2]
    return q
""",
    ),
    (
        "02-to-points",
        "pose and mount in the wrong order",
        """
def to_points(degrees, millimetres, mount, pose):
    back = millimetres > 0
    a, r = -np.radians(degrees[back]), millimetres[back] / 1000
    q = np.column_stack([r * np.cos(a), r * np.sin(a)])
    for f in (pose, mount):
        R = np.array([[np.cos(f[2]), -np.sin(f[2])], [np.sin(f[2]), np.cos(f[2])]])
        q = (R @ q.T).T + f[:2]
    return q
""",
    ),
    (
        "02-to-points",
        "mount and pose just added",
        """
def to_points(degrees, millimetres, mount, pose):
    back = millimetres > 0
    x, y, theta = pose + mount
    a, r = theta - np.radians(degrees[back]), millimetres[back] / 1000
    return np.column_stack([x + r * np.cos(a), y + r * np.sin(a)])
""",
    ),
    (
        "02-to-points",
        "rotation transposed for row vectors",
        """
def to_points(degrees, millimetres, mount, pose):
    back = millimetres > 0
    a, r = -np.radians(degrees[back]), millimetres[back] / 1000
    q = np.column_stack([r * np.cos(a), r * np.sin(a)])
    for f in (mount, pose):
        R = np.array([[np.cos(f[2]), -np.sin(f[2])], [np.sin(f[2]), np.cos(f[2])]])
        q = q @ R + f[:2]
    return q
""",
    ),
    (
        "02-to-points",
        "the mount's angle is forgotten",
        """
def to_points(degrees, millimetres, mount, pose):
    back = millimetres > 0
    c, s = np.cos(pose[2]), np.sin(pose[2])
    at = pose[:2] + np.array([[c, -s], [s, c]]) @ mount[:2]
    a, r = pose[2] - np.radians(degrees[back]), millimetres[back] / 1000
    return at + np.column_stack([r * np.cos(a), r * np.sin(a)])
""",
    ),
    (
        "02-to-points",
        "front along +y, as Tucek's programs",
        """
def to_points(degrees, millimetres, mount, pose):
    back = millimetres > 0
    d, r = np.radians(degrees[back]), millimetres[back] / 1000
    q = np.column_stack([r * np.sin(d), r * np.cos(d)])
    for f in (mount, pose):
        c, s = np.cos(f[2]), np.sin(f[2])
        q = q @ np.array([[c, s], [-s, c]]) + f[:2]
    return q
""",
    ),
    (
        "02-to-points",
        "near readings are dropped as noise (below 10 cm)",
        """
def to_points(degrees, millimetres, mount, pose):
    back = millimetres > 100
    a, r = -np.radians(degrees[back]), millimetres[back] / 1000
    q = np.column_stack([r * np.cos(a), r * np.sin(a)])
    for f in (mount, pose):
        c, s = np.cos(f[2]), np.sin(f[2])
        q = q @ np.array([[c, s], [-s, c]]) + f[:2]
    return q
""",
    ),
    (
        "02-to-points",
        "NaN rows for what did not come back",
        """
def to_points(degrees, millimetres, mount, pose):
    r = np.where(millimetres > 0, millimetres / 1000, np.nan)
    a = -np.radians(degrees)
    q = np.column_stack([r * np.cos(a), r * np.sin(a)])
    for f in (mount, pose):
        c, s = np.cos(f[2]), np.sin(f[2])
        q = q @ np.array([[c, s], [-s, c]]) + f[:2]
    return q
""",
    ),
    (
        "02-to-points",
        "only in the robot's frame",
        """
def to_points(degrees, millimetres, mount, pose):
    back = millimetres > 0
    a = mount[2] - np.radians(degrees[back])
    r = millimetres[back] / 1000
    return mount[:2] + np.column_stack([np.cos(a), np.sin(a)]) * r[:, None]
""",
    ),
    (
        "02-to-points",
        "the mount's place is not turned with the robot",
        """
def to_points(degrees, millimetres, mount, pose):
    back = millimetres > 0
    a = pose[2] + mount[2] - np.radians(degrees[back])
    r = millimetres[back] / 1000
    return pose[:2] + mount[:2] + np.column_stack([r * np.cos(a), r * np.sin(a)])
""",
    ),
    (
        "02-to-points",
        "sorted by angle",
        """
def to_points(degrees, millimetres, mount, pose):
    order = np.argsort(degrees)
    degrees, millimetres = degrees[order], millimetres[order]
    back = millimetres > 0
    a, r = -np.radians(degrees[back]), millimetres[back] / 1000
    q = np.column_stack([r * np.cos(a), r * np.sin(a)])
    for f in (mount, pose):
        c, s = np.cos(f[2]), np.sin(f[2])
        q = q @ np.array([[c, s], [-s, c]]) + f[:2]
    return q
""",
    ),
    (
        "02-to-points",
        "shape (2, k)",
        """
def to_points(degrees, millimetres, mount, pose):
    back = millimetres > 0
    a, r = -np.radians(degrees[back]), millimetres[back] / 1000
    q = np.array([r * np.cos(a), r * np.sin(a)])
    for f in (mount, pose):
        c, s = np.cos(f[2]), np.sin(f[2])
        q = np.array([[c, -s], [s, c]]) @ q + f[:2, None]
    return q
""",
    ),
]
