"""Independent answers to 02-ray-wall: right ones, and students' mistakes."""

RIGHT = [
    (
        "02-ray-wall",
        "linear system, tolerance for parallels",
        """
def ray_wall(p, phi, wall):
    u = np.array([np.cos(phi), np.sin(phi)])
    a, b = wall[:2], wall[2:]
    M = np.column_stack([u, a - b])
    if abs(np.linalg.det(M)) < 1e-12:
        return np.inf
    t, s = np.linalg.solve(M, a - p)
    if t < 0 or s < 0 or s > 1:
        return np.inf
    return t
""",
    ),
    (
        "02-ray-wall",
        "the wall turned into the beam's frame",
        """
def ray_wall(p, phi, wall):
    c, s = np.cos(phi), np.sin(phi)
    x1 = c * (wall[0] - p[0]) + s * (wall[1] - p[1])
    y1 = -s * (wall[0] - p[0]) + c * (wall[1] - p[1])
    x2 = c * (wall[2] - p[0]) + s * (wall[3] - p[1])
    y2 = -s * (wall[2] - p[0]) + c * (wall[3] - p[1])
    if abs(y1 - y2) < 1e-12 or y1 * y2 > 0:
        return np.inf
    t = x1 + (x2 - x1) * y1 / (y1 - y2)
    return t if t > 0 else np.inf
""",
    ),
    (
        "02-ray-wall",
        "the wall's normal and its midpoint",
        """
def ray_wall(p, phi, wall):
    u = np.array([np.cos(phi), np.sin(phi)])
    a, b = wall[:2], wall[2:]
    length = np.linalg.norm(b - a)
    along = (b - a) / length
    n = np.array([-along[1], along[0]])
    slope = n @ u
    if abs(slope) < 1e-12:
        return np.inf
    t = n @ (a - p) / slope
    hit = p + t * u
    if t >= 0 and abs(along @ (hit - (a + b) / 2)) <= length / 2:
        return float(t)
    return np.inf
""",
    ),
]

WRONG = [
    (
        "02-ray-wall",
        "walls behind the sensor are met, negative distance",
        """
def ray_wall(p, phi, wall):
    u = np.array([np.cos(phi), np.sin(phi)])
    M = np.column_stack([u, wall[:2] - wall[2:]])
    if abs(np.linalg.det(M)) < 1e-12:
        return np.inf
    t, s = np.linalg.solve(M, wall[:2] - p)
    return t if 0 <= s <= 1 else np.inf
""",
    ),
    (
        "02-ray-wall",
        "absolute value: walls behind count as in front",
        """
def ray_wall(p, phi, wall):
    w = wall[2:] - wall[:2]
    d = wall[:2] - p
    u = np.array([np.cos(phi), np.sin(phi)])
    det = u[0] * w[1] - u[1] * w[0]
    if abs(det) < 1e-12:
        return np.inf
    t = abs((d[0] * w[1] - d[1] * w[0]) / det)
    s = (d[0] * u[1] - d[1] * u[0]) / det
    return t if 0 <= s <= 1 else np.inf
""",
    ),
    (
        "02-ray-wall",
        "the wall as an endless line",
        """
def ray_wall(p, phi, wall):
    n = np.array([wall[1] - wall[3], wall[2] - wall[0]])
    den = n @ [np.cos(phi), np.sin(phi)]
    if abs(den) < 1e-12:
        return np.inf
    t = n @ (wall[:2] - p) / den
    return t if t >= 0 else np.inf
""",
    ),
    (
        "02-ray-wall",
        "slope y = mx + q fails for vertical walls and beams",
        """
def ray_wall(p, phi, wall):
    m = (wall[3] - wall[1]) / (wall[2] - wall[0])
    k = np.tan(phi)
    if m == k:
        return np.inf
    x = (p[1] - wall[1] + m * wall[0] - k * p[0]) / (m - k)
    y = p[1] + k * (x - p[0])
    if not min(wall[0], wall[2]) <= x <= max(wall[0], wall[2]):
        return np.inf
    if (x - p[0]) * np.cos(phi) + (y - p[1]) * np.sin(phi) < 0:
        return np.inf
    return np.hypot(x - p[0], y - p[1])
""",
    ),
    (
        "02-ray-wall",
        "bounding box test: fails for walls along x or y by rounding",
        """
def ray_wall(p, phi, wall):
    u = np.array([np.cos(phi), np.sin(phi)])
    n = np.array([wall[1] - wall[3], wall[2] - wall[0]])
    den = n @ u
    if abs(den) < 1e-12:
        return np.inf
    t = n @ (wall[:2] - p) / den
    x, y = p + t * u
    in_x = min(wall[0], wall[2]) < x < max(wall[0], wall[2])
    in_y = min(wall[1], wall[3]) < y < max(wall[1], wall[3])
    return t if t >= 0 and in_x and in_y else np.inf
""",
    ),
    (
        "02-ray-wall",
        "sign of s",
        """
def ray_wall(p, phi, wall):
    ux, uy = np.cos(phi), np.sin(phi)
    wx, wy = wall[2] - wall[0], wall[3] - wall[1]
    dx, dy = wall[0] - p[0], wall[1] - p[1]
    det = ux * wy - uy * wx
    if det == 0:
        return np.inf
    t = (dx * wy - dy * wx) / det
    s = (dy * ux - dx * uy) / det
    return t if t >= 0 and 0 <= s <= 1 else np.inf
""",
    ),
    (
        "02-ray-wall",
        "s compared with the wall's length in metres",
        """
def ray_wall(p, phi, wall):
    u = np.array([np.cos(phi), np.sin(phi)])
    w = wall[2:] - wall[:2]
    length = np.hypot(*w)
    M = np.column_stack([u, -w])
    if abs(np.linalg.det(M)) < 1e-12:
        return np.inf
    t, s = np.linalg.solve(M, wall[:2] - p)
    return t if t >= 0 and 0 <= s <= length else np.inf
""",
    ),
    (
        "02-ray-wall",
        "no test for parallels",
        """
def ray_wall(p, phi, wall):
    u = np.array([np.cos(phi), np.sin(phi)])
    M = np.column_stack([u, wall[:2] - wall[2:]])
    t, s = np.linalg.solve(M, wall[:2] - p)
    if t >= 0 and 0 <= s <= 1:
        return t
    return np.inf
""",
    ),
    (
        "02-ray-wall",
        "direction in degrees",
        """
def ray_wall(p, phi, wall):
    a = np.radians(phi)
    u = np.array([np.cos(a), np.sin(a)])
    M = np.column_stack([u, wall[:2] - wall[2:]])
    if abs(np.linalg.det(M)) < 1e-12:
        return np.inf
    t, s = np.linalg.solve(M, wall[:2] - p)
    return t if t >= 0 and 0 <= s <= 1 else np.inf
""",
    ),
    (
        "02-ray-wall",
        "the distance to the wall's nearest place",
        """
def ray_wall(p, phi, wall):
    a, w = wall[:2] - p, wall[2:] - wall[:2]
    s = np.clip(-(a @ w) / (w @ w), 0, 1)
    place = a + s * w
    if place @ [np.cos(phi), np.sin(phi)] < 0:
        return np.inf
    return np.hypot(*place)
""",
    ),
    (
        "02-ray-wall",
        "a coarse tolerance calls slanting and short walls parallel",
        """
def ray_wall(p, phi, wall):
    u = np.array([np.cos(phi), np.sin(phi)])
    M = np.column_stack([u, wall[:2] - wall[2:]])
    if abs(np.linalg.det(M)) < 0.05:
        return np.inf
    t, s = np.linalg.solve(M, wall[:2] - p)
    return t if t >= 0 and 0 <= s <= 1 else np.inf
""",
    ),
    (
        "02-ray-wall",
        "bearings of the ends without a wrap",
        """
def ray_wall(p, phi, wall):
    b1 = np.arctan2(wall[1] - p[1], wall[0] - p[0])
    b2 = np.arctan2(wall[3] - p[1], wall[2] - p[0])
    if not min(b1, b2) <= phi <= max(b1, b2):
        return np.inf
    n = np.array([wall[1] - wall[3], wall[2] - wall[0]])
    den = n @ [np.cos(phi), np.sin(phi)]
    return n @ (wall[:2] - p) / den if den != 0 else np.inf
""",
    ),
    (
        "02-ray-wall",
        "range limited to 10 m as in the picture",
        """
def ray_wall(p, phi, wall):
    u = np.array([np.cos(phi), np.sin(phi)])
    M = np.column_stack([u, wall[:2] - wall[2:]])
    if abs(np.linalg.det(M)) < 1e-12:
        return np.inf
    t, s = np.linalg.solve(M, wall[:2] - p)
    return t if 0 <= t <= 10 and 0 <= s <= 1 else np.inf
""",
    ),
    (
        "02-ray-wall",
        "nan instead of inf",
        """
def ray_wall(p, phi, wall):
    w = wall[2:] - wall[:2]
    d = wall[:2] - p
    u = np.array([np.cos(phi), np.sin(phi)])
    det = u[0] * w[1] - u[1] * w[0]
    if abs(det) < 1e-12:
        return np.nan
    t = (d[0] * w[1] - d[1] * w[0]) / det
    s = (d[0] * u[1] - d[1] * u[0]) / det
    return t if t >= 0 and 0 <= s <= 1 else np.nan
""",
    ),
    (
        "02-ray-wall",
        "the quadrant test forgets the axes",
        """
def ray_wall(p, phi, wall):
    u = np.array([np.cos(phi), np.sin(phi)])
    M = np.column_stack([u, wall[:2] - wall[2:]])
    if abs(np.linalg.det(M)) < 1e-12:
        return np.inf
    t, s = np.linalg.solve(M, wall[:2] - p)
    hit = p + t * u
    same_quadrant = (hit[0] - p[0] > 0) == (phi % (2 * np.pi) < np.pi / 2 or phi % (2 * np.pi) > 3 * np.pi / 2)
    same_quadrant &= (hit[1] - p[1] > 0) == (phi < np.pi)
    return abs(t) if same_quadrant and 0 <= s <= 1 else np.inf
""",
    ),
]
