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
]
