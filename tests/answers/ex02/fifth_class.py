"""A fifth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = []

WRONG = [
    (
        "02-ray-wall",
        "parallel is tested by equal slopes, τ by a strict half",
        """
def ray_wall(p, phi, wall):
    (x1, y1, x2, y2), (c, s) = wall, (np.cos(phi), np.sin(phi))
    det = c * (y2 - y1) - s * (x2 - x1)
    if abs(det) < 1e-3:
        return np.inf
    r = ((x1 - p[0]) * (y2 - y1) - (y1 - p[1]) * (x2 - x1)) / det
    tau = ((x1 - p[0]) * s - (y1 - p[1]) * c) / det
    return r if r > 0 and 0 < tau < 1 else np.inf
""",
    ),
    (
        "02-noise",
        "lost beams become 0",
        """
def noisy(ranges, error, dropouts, rng):
    r = ranges * (1 + error * rng.standard_normal(len(ranges)))
    return np.where(rng.random(len(r)) < dropouts, 0, r)
""",
    ),
    (
        "02-to-points",
        "one scan of 360 readings assumed",
        """
def to_points(degrees, millimetres, mount, pose):
    from slamlab.geometry import compose
    eye = compose(pose, mount)
    a = eye[2] - np.radians(np.arange(len(degrees)))
    r, keep = millimetres / 1000, millimetres > 0
    return np.column_stack([eye[0] + r * np.cos(a), eye[1] + r * np.sin(a)])[keep]
""",
    ),
    (
        "02-ray-wall",
        "directions of the two ends compared as numbers",
        """
def ray_wall(p, phi, wall):
    x1, y1, x2, y2 = wall
    a1 = np.arctan2(y1 - p[1], x1 - p[0])
    a2 = np.arctan2(y2 - p[1], x2 - p[0])
    phi = np.arctan2(np.sin(phi), np.cos(phi))
    if not min(a1, a2) <= phi <= max(a1, a2):
        return np.inf
    nx, ny = y1 - y2, x2 - x1
    along = nx * np.cos(phi) + ny * np.sin(phi)
    if abs(along) < 1e-12:
        return np.inf
    return (nx * (x1 - p[0]) + ny * (y1 - p[1])) / along
""",
    ),
    (
        "02-echo",
        "rays a quarter degree apart",
        """
def echo(p, phi, half, walls):
    best = np.inf
    for a in np.arange(phi - half, phi + half, np.radians(0.25)):
        for w in walls:
            best = min(best, ray_wall(p, a, w))
    return best
""",
    ),
    (
        "02-noise",
        "a fixed count, rounded, permutation",
        """
def noisy(ranges, error, dropouts, rng):
    n = len(ranges)
    r = ranges + rng.normal(0, 1, n) * error * ranges
    r[rng.permutation(n)[:round(dropouts * n)]] = np.nan
    return r
""",
    ),
]
