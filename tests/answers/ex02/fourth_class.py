"""A fourth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "02-ray-wall",
        "two by two system, its determinant tested",
        """
def ray_wall(p, phi, wall):
    a, b = np.array(wall[:2]), np.array(wall[2:])
    u = np.array([np.cos(phi), np.sin(phi)])
    M = np.column_stack([u, a - b])
    if abs(np.linalg.det(M)) < 1e-9 * np.linalg.norm(b - a):
        return np.inf
    r, tau = np.linalg.solve(M, a - p)
    return float(r) if r >= 0 and 0 <= tau <= 1 else float("inf")
""",
    ),
    (
        "02-to-points",
        "complex numbers, reading by reading",
        """
def to_points(degrees, millimetres, mount, pose):
    found = []
    for deg, mm in zip(degrees, millimetres):
        if mm > 0:
            z = mm / 1000 * np.exp(-1j * np.radians(deg))
            z = (mount[0] + 1j * mount[1]) + z * np.exp(1j * mount[2])
            z = (pose[0] + 1j * pose[1]) + z * np.exp(1j * pose[2])
            found.append([z.real, z.imag])
    return np.array(found).reshape(-1, 2)
""",
    ),
]

WRONG = [
    (
        "02-ray-wall",
        "slope and intercept",
        """
def ray_wall(p, phi, wall):
    x1, y1, x2, y2 = wall
    m = (y2 - y1) / (x2 - x1)
    q = y1 - m * x1
    t = np.tan(phi)
    x = (q - p[1] + t * p[0]) / (t - m)
    y = m * x + q
    if min(x1, x2) <= x <= max(x1, x2):
        return np.hypot(x - p[0], y - p[1])
    return np.inf
""",
    ),
    (
        "02-ray-wall",
        "a wall behind counts, by the absolute value",
        """
def ray_wall(p, phi, wall):
    a, b = np.array(wall[:2]), np.array(wall[2:])
    u, d = np.array([np.cos(phi), np.sin(phi)]), b - a
    det = u[0] * d[1] - u[1] * d[0]
    if abs(det) < 1e-12:
        return np.inf
    q = a - p
    r = (q[0] * d[1] - q[1] * d[0]) / det
    tau = (q[0] * u[1] - q[1] * u[0]) / det
    return abs(r) if 0 <= tau <= 1 else np.inf
""",
    ),
    (
        "02-ray-wall",
        "None for no wall",
        """
def ray_wall(p, phi, wall):
    a, b = np.array(wall[:2]), np.array(wall[2:])
    u, d = np.array([np.cos(phi), np.sin(phi)]), b - a
    det = u[0] * d[1] - u[1] * d[0]
    if abs(det) < 1e-12:
        return None
    q = a - p
    r = (q[0] * d[1] - q[1] * d[0]) / det
    tau = (q[0] * u[1] - q[1] * u[0]) / det
    return r if 0 <= tau <= 1 and r > 0 else None
""",
    ),
    (
        "02-ray-wall",
        "the sensor at the origin, as in the lesson",
        """
def ray_wall(p, phi, wall):
    x1, y1, x2, y2 = wall
    c, s = np.cos(phi), np.sin(phi)
    det = c * (y2 - y1) - s * (x2 - x1)
    if det == 0:
        return np.inf
    r = (x1 * (y2 - y1) - y1 * (x2 - x1)) / det
    tau = (x1 * s - y1 * c) / det
    return r if r > 0 and 0 <= tau <= 1 else np.inf
""",
    ),
    (
        "02-echo",
        "a thousand beams",
        """
def echo(p, phi, half, walls):
    if len(walls) == 0:
        return np.inf
    return min(ray_wall(p, a, w) for a in np.linspace(phi - half, phi + half, 60) for w in walls)
""",
    ),
    (
        "02-echo",
        "the angle to the foot is not wrapped",
        """
def echo(p, phi, half, walls):
    best = np.inf
    for w in walls:
        a, b = w[:2], w[2:]
        d = b - a
        t = np.clip((p - a) @ d / (d @ d), 0, 1)
        for q in (a + t * d, a, b):
            if abs(np.arctan2(*(q - p)[::-1]) - phi) <= half:
                best = min(best, np.hypot(*(q - p)))
        for s in (-half, half):
            best = min(best, ray_wall(p, phi + s, w))
    return best
""",
    ),
    (
        "02-echo",
        "forgets the rim",
        """
def echo(p, phi, half, walls):
    best = np.inf
    for w in walls:
        a, b = w[:2], w[2:]
        d = b - a
        t = np.clip((p - a) @ d / (d @ d), 0, 1)
        for q in (a + t * d, a, b):
            e = np.arctan2(*(q - p)[::-1]) - phi
            if abs(np.arctan2(np.sin(e), np.cos(e))) <= half:
                best = min(best, np.hypot(*(q - p)))
    return best
""",
    ),
    (
        "02-to-points",
        "filters after converting, with the wrong mask shape",
        """
def to_points(degrees, millimetres, mount, pose):
    r = millimetres / 1000
    a = -np.radians(degrees) + mount[2] + pose[2]
    x = pose[0] + mount[0] + r * np.cos(a)
    y = pose[1] + mount[1] + r * np.sin(a)
    pts = np.column_stack([x, y])
    return pts[r > 0]
""",
    ),
    (
        "02-to-points",
        "counter-clockwise",
        """
def to_points(degrees, millimetres, mount, pose):
    from slamlab.geometry import compose
    keep = millimetres > 0
    eye = compose(pose, mount)
    a = eye[2] + np.radians(degrees[keep])
    r = millimetres[keep] / 1000
    return np.column_stack([eye[0] + r * np.cos(a), eye[1] + r * np.sin(a)])
""",
    ),
    (
        "02-to-points",
        "metres forgotten, and readings below a metre dropped",
        """
def to_points(degrees, millimetres, mount, pose):
    from slamlab.geometry import compose
    keep = millimetres > 1
    eye = compose(pose, mount)
    a = eye[2] - np.radians(degrees[keep])
    r = millimetres[keep] / 1000
    return np.column_stack([eye[0] + r * np.cos(a), eye[1] + r * np.sin(a)])
""",
    ),
    (
        "02-noise",
        "noise of one size for all",
        """
def noisy(ranges, error, dropouts, rng):
    r = ranges + error * rng.standard_normal(len(ranges))
    r[rng.random(len(ranges)) < dropouts] = np.nan
    return r
""",
    ),
    (
        "02-noise",
        "a fixed number of beams is lost",
        """
def noisy(ranges, error, dropouts, rng):
    r = ranges * (1 + error * rng.standard_normal(len(ranges)))
    lost = rng.choice(len(r), int(dropouts * len(r)), replace=False)
    r[lost] = np.nan
    return r
""",
    ),
    (
        "02-noise",
        "one draw for noise and loss",
        """
def noisy(ranges, error, dropouts, rng):
    u = rng.random(len(ranges))
    out = ranges * (1 + error * (u - 0.5) * np.sqrt(12))
    out[u < dropouts] = np.nan
    return out
""",
    ),
    (
        "02-busy-room",
        "median and MAD, rounding forgotten",
        """
def busy_fit(scans, step):
    wall = np.median(scans, axis=0)
    share = scans / wall - 1
    mad = 1.4826 * np.median(np.abs(share))
    blocked = np.mean(np.abs(share) > 4 * mad)
    return mad, blocked
""",
    ),
]
