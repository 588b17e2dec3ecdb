"""Independent answers to exercise 02: right ones, and students' mistakes."""

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
    (
        "02-echo",
        "clip each wall to the cone's part, then the nearest of the clipped piece",
        """
def echo(p, phi, half, walls):
    best = np.inf
    left = np.array([-np.sin(phi + half), np.cos(phi + half)])      # points out of the cone, on the left
    right_ = np.array([np.sin(phi - half), -np.cos(phi - half)])    # out of it, on the right
    for wall in walls:
        a, b = wall[:2] - p, wall[2:] - p
        lo, hi = 0.0, 1.0
        for n in (left, right_):
            fa, fb = n @ a, n @ b
            if fa > 0 and fb > 0:
                lo, hi = 1.0, 0.0
            elif fa > 0:
                lo = max(lo, fa / (fa - fb))
            elif fb > 0:
                hi = min(hi, fa / (fa - fb))
        if lo > hi:
            continue
        w = b - a
        s = min(max(-(a @ w) / (w @ w), lo), hi)
        best = min(best, np.hypot(*(a + s * w)))
    return best
""",
    ),
    (
        "02-echo",
        "candidates in one list, angle by arccos",
        """
def echo(p, phi, half, walls):
    u = np.array([np.cos(phi), np.sin(phi)])
    found = [np.inf]
    for x1, y1, x2, y2 in walls:
        a = np.array([x1, y1]) - p
        w = np.array([x2 - x1, y2 - y1])
        foot = -np.dot(a, w) / np.dot(w, w)
        for s in [0.0, 1.0] + ([foot] if 0 < foot < 1 else []):
            q = a + s * w
            r = np.linalg.norm(q)
            if np.arccos(np.clip(q @ u / r, -1, 1)) <= half:
                found.append(r)
        found.append(ray_wall(p, phi + half, np.array([x1, y1, x2, y2])))
        found.append(ray_wall(p, phi - half, np.array([x1, y1, x2, y2])))
    return min(found)
""",
    ),
    (
        "02-echo",
        "the nearest place of the wall if it is in the cone, else the rims (enough, for cone and wall are convex)",
        """
def echo(p, phi, half, walls):
    found = [np.inf]
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        s = np.clip(-(a @ w) / (w @ w), 0, 1)
        q = a + s * w
        off = np.arctan2(q[1], q[0]) - phi
        off = np.arctan2(np.sin(off), np.cos(off))
        if abs(off) <= half:
            found.append(np.hypot(*q))
        else:
            found += [ray_wall(p, phi - half, wall), ray_wall(p, phi + half, wall)]
    return min(found)
""",
    ),
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
    (
        "02-noise",
        "factor and np.where",
        """
def noisy(ranges, error, dropouts, rng):
    lost = rng.uniform(size=ranges.shape) < dropouts
    factor = rng.normal(1.0, error, size=ranges.shape)
    return np.where(lost, np.nan, ranges * factor)
""",
    ),
    (
        "02-noise",
        "beam by beam",
        """
def noisy(ranges, error, dropouts, rng):
    out = np.full(len(ranges), np.nan)
    for i, r in enumerate(ranges):
        if np.isnan(r):
            continue
        if rng.random() < dropouts:
            continue
        out[i] = r + rng.normal(0, error * r)
    return out
""",
    ),
    (
        "02-noise",
        "binomial for the losses",
        """
def noisy(ranges, error, dropouts, rng):
    new = ranges * (1 + error * rng.standard_normal(ranges.size))
    new[rng.binomial(1, dropouts, ranges.size) == 1] = np.nan
    return new
""",
    ),
    (
        "02-busy-room",
        "expectation maximisation: each reading's probability to be of the wall",
        """
from math import erf
_erf = np.vectorize(erf)


def busy_fit(scans, step):
    q = scans

    def cdf(x):
        return 0.5 * (1 + _erf(x / np.sqrt(2)))

    def likely(error, r):
        s = error * r
        return cdf((q + step / 2 - r) / s) - cdf((q - step / 2 - r) / s)

    r, b, error = np.median(np.sort(q, axis=0)[len(q) // 4:], axis=0), 0.2, 0.015
    for _ in range(25):
        wall = (1 - b) * likely(error, r)
        person = b * step / r * (q <= r + step / 2)
        w = wall / (wall + person + 1e-12)
        count = w.sum(axis=0)
        r = (w * q).sum(axis=0) / np.maximum(count, 1e-9)
        b = 1 - w.mean()
        # with the rounding's variance taken off, and one mean for each beam
        free = np.maximum(count - 1, 0)
        noise = np.sum(w * (q - r) ** 2) - np.sum(free) * step ** 2 / 12
        error = max(np.sqrt(max(noise, 0) / np.sum(free * r ** 2)), 0.0015)
    return error, b
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
    (
        "02-echo",
        "two hundred beams into the cone",
        """
def echo(p, phi, half, walls):
    beams = np.linspace(phi - half, phi + half, 200)
    return min([ray_wall(p, b, w) for b in beams for w in walls], default=np.inf)
""",
    ),
    (
        "02-echo",
        "only the axis",
        """
def echo(p, phi, half, walls):
    return min([ray_wall(p, phi, w) for w in walls], default=np.inf)
""",
    ),
    (
        "02-echo",
        "the rims and the axis only",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    for wall in walls:
        for a in (phi - half, phi, phi + half):
            nearest = min(nearest, ray_wall(p, a, wall))
    return nearest
""",
    ),
    (
        "02-echo",
        "the foot and the ends, but no rims",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    u = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            d = np.hypot(*q)
            if q @ u >= np.cos(half) * d:
                nearest = min(nearest, d)
    return nearest
""",
    ),
    (
        "02-echo",
        "the ends are forgotten",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    u = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        s = -(a @ w) / (w @ w)
        if 0 <= s <= 1:
            q = a + s * w
            if q @ u >= np.cos(half) * np.linalg.norm(q):
                nearest = min(nearest, np.linalg.norm(q))
        nearest = min(nearest, ray_wall(p, phi - half, wall), ray_wall(p, phi + half, wall))
    return nearest
""",
    ),
    (
        "02-echo",
        "the nearer of the two ends and the foot is chosen first, then tested: others in the cone lost",
        """
def echo(p, phi, half, walls):
    best, u = np.inf, np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, b = wall[:2] - p, wall[2:] - p
        q = min((a, b), key=lambda e: e @ e)
        w = b - a
        s = -(a @ w) / (w @ w)
        if 0 < s < 1:
            q = a + s * w
        if q @ u >= np.cos(half) * np.hypot(*q):
            best = min(best, np.hypot(*q))
    return best
""",
    ),
    (
        "02-echo",
        "s not clipped: the foot may lie beyond the ends",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    axis = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        for s in (0, 1, -(a @ w) / (w @ w)):
            q = a + s * w
            d = np.hypot(*q)
            if q @ axis >= np.cos(half) * d:
                nearest = min(nearest, d)
        for rim in (phi - half, phi + half):
            nearest = min(nearest, ray_wall(p, rim, wall))
    return nearest
""",
    ),
    (
        "02-echo",
        "the difference of angles is not wrapped",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            if abs(np.arctan2(q[1], q[0]) - phi) <= half:
                nearest = min(nearest, np.hypot(*q))
        for rim in (phi - half, phi + half):
            nearest = min(nearest, ray_wall(p, rim, wall))
    return nearest
""",
    ),
    (
        "02-echo",
        "half taken as the whole cone",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    h = half / 2
    axis = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            if q @ axis >= np.cos(h) * np.hypot(*q):
                nearest = min(nearest, np.hypot(*q))
        nearest = min(nearest, ray_wall(p, phi - h, wall), ray_wall(p, phi + h, wall))
    return nearest
""",
    ),
    (
        "02-echo",
        "no walls: min of an empty list",
        """
def echo(p, phi, half, walls):
    axis = np.array([np.cos(phi), np.sin(phi)])
    each = []
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        near = min(ray_wall(p, phi - half, wall), ray_wall(p, phi + half, wall))
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            if q @ axis >= np.cos(half) * np.hypot(*q):
                near = min(near, np.hypot(*q))
        each.append(near)
    return min(each)
""",
    ),
    (
        "02-echo",
        "the cosine test without the distance",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    axis = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            if q @ axis >= np.cos(half):
                nearest = min(nearest, np.hypot(*q))
        for rim in (phi - half, phi + half):
            nearest = min(nearest, ray_wall(p, rim, wall))
    return nearest
""",
    ),
    (
        "02-echo",
        "the cone opens to the back as well (abs)",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    axis = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            off = np.arcsin(np.clip((axis[0] * q[1] - axis[1] * q[0]) / np.hypot(*q), -1, 1))
            if abs(off) <= half:
                nearest = min(nearest, np.hypot(*q))
        for rim in (phi - half, phi + half):
            nearest = min(nearest, ray_wall(p, rim, wall))
    return nearest
""",
    ),
    (
        "02-echo",
        "the distance along the axis",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    axis = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            if q @ axis >= np.cos(half) * np.hypot(*q):
                nearest = min(nearest, q @ axis)
        for rim in (phi - half, phi + half):
            nearest = min(nearest, ray_wall(p, rim, wall) * np.cos(half))
    return nearest
""",
    ),
    (
        "02-echo",
        "returns after the first wall that is heard",
        """
def echo(p, phi, half, walls):
    axis = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        found = [ray_wall(p, phi - half, wall), ray_wall(p, phi + half, wall)]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            if q @ axis >= np.cos(half) * np.hypot(*q):
                found.append(np.hypot(*q))
        if min(found) < np.inf:
            return min(found)
    return np.inf
""",
    ),
    (
        "02-echo",
        "moves the walls to p in place",
        """
def echo(p, phi, half, walls):
    walls[:, :2] -= p
    walls[:, 2:] -= p
    origin, best = np.zeros(2), np.inf
    axis = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2], wall[2:] - wall[:2]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            if q @ axis >= np.cos(half) * np.hypot(*q):
                best = min(best, np.hypot(*q))
        best = min(best, ray_wall(origin, phi - half, wall), ray_wall(origin, phi + half, wall))
    return best
""",
    ),
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
    (
        "02-noise",
        "error in metres, the same at all ranges",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges + error * rng.standard_normal(len(ranges))
    measured[rng.random(len(ranges)) < dropouts] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "one random number for the whole scan",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges * (1 + error * rng.standard_normal())
    lost = rng.random(len(ranges)) < dropouts
    return np.where(lost, np.nan, measured)
""",
    ),
    (
        "02-noise",
        "uniform noise of +- error",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges * (1 + rng.uniform(-error, error, len(ranges)))
    measured[rng.random(len(ranges)) < dropouts] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "error is taken as the variance",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges * (1 + np.sqrt(error) * rng.standard_normal(len(ranges)))
    measured[rng.random(len(ranges)) < dropouts] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "gives normal() the variance (error r)^2",
        """
def noisy(ranges, error, dropouts, rng):
    out = np.array([rng.normal(r, (error * r) ** 2) for r in ranges])
    out[rng.random(len(ranges)) < dropouts] = np.nan
    return out
""",
    ),
    (
        "02-noise",
        "its own chance: np.random",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges * (1 + error * np.random.standard_normal(len(ranges)))
    measured[np.random.random(len(ranges)) < dropouts] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "a new generator with a fixed seed",
        """
def noisy(ranges, error, dropouts, rng):
    rng = np.random.default_rng(0)
    measured = ranges + error * ranges * rng.standard_normal(len(ranges))
    measured[rng.random(len(ranges)) < dropouts] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "changes ranges in place",
        """
def noisy(ranges, error, dropouts, rng):
    ranges += error * ranges * rng.standard_normal(len(ranges))
    ranges[rng.random(len(ranges)) < dropouts] = np.nan
    return ranges
""",
    ),
    (
        "02-noise",
        "the losses are the complement",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges * rng.normal(1, error, len(ranges))
    kept = rng.random(len(ranges)) < dropouts
    return np.where(kept, measured, np.nan)
""",
    ),
    (
        "02-noise",
        "an exact number of beams is lost",
        """
def noisy(ranges, error, dropouts, rng):
    n = len(ranges)
    measured = ranges + error * ranges * rng.standard_normal(n)
    lost = rng.choice(n, size=round(dropouts * n), replace=False)
    measured[lost] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "lost beams return 0",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges * (1 + error * rng.standard_normal(len(ranges)))
    measured[rng.random(len(ranges)) < dropouts] = 0.0
    return measured
""",
    ),
    (
        "02-noise",
        "all or none is lost",
        """
def noisy(ranges, error, dropouts, rng):
    if rng.random() < dropouts:
        return np.full(len(ranges), np.nan)
    return ranges + error * ranges * rng.standard_normal(len(ranges))
""",
    ),
    (
        "02-noise",
        "lost beams are left out",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges + error * ranges * rng.standard_normal(len(ranges))
    return measured[rng.random(len(ranges)) >= dropouts]
""",
    ),
    (
        "02-noise",
        "losses depend on the noise: the same random numbers decide both",
        """
def noisy(ranges, error, dropouts, rng):
    chance = rng.standard_normal(len(ranges))
    measured = ranges * (1 + error * chance)
    edge = np.sort(chance)[int(dropouts * len(chance)) - 1] if len(chance) and dropouts > 0 else -np.inf
    measured[chance <= edge] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "always longer: abs",
        """
def noisy(ranges, error, dropouts, rng):
    measured = ranges + np.abs(error * ranges * rng.standard_normal(len(ranges)))
    measured[rng.random(len(ranges)) < dropouts] = np.nan
    return measured
""",
    ),
    (
        "02-noise",
        "NaN becomes a number",
        """
def noisy(ranges, error, dropouts, rng):
    r = np.nan_to_num(ranges)
    measured = r * (1 + error * rng.standard_normal(len(r)))
    measured[rng.random(len(r)) < dropouts] = np.nan
    return measured
""",
    ),
    (
        "02-busy-room",
        "quiet_fit and nobody",
        """
def busy_fit(scans, step):
    return quiet_fit(scans), 0.0
""",
    ),
    (
        "02-busy-room",
        "constants in the middle of what is possible",
        """
def busy_fit(scans, step):
    return 0.01, 0.2
""",
    ),
    (
        "02-busy-room",
        "median absolute deviation, no rounding",
        """
def busy_fit(scans, step):
    r = np.median(scans, axis=0)
    error = 1.4826 * np.median(np.abs(scans - r) / r)
    blocked = np.mean(np.abs(scans - r) > 3 * error * r)
    return error, blocked
""",
    ),
    (
        "02-busy-room",
        "cuts the people off once, at a fixed 10 %, forgets the rounding",
        """
def busy_fit(scans, step):
    r = np.median(scans, axis=0)
    wall = np.abs(scans / r - 1) < 0.1
    return np.std((scans / r)[wall]), 1 - wall.mean()
""",
    ),
    (
        "02-busy-room",
        "iterates, but does not take the rounding off",
        """
def busy_fit(scans, step):
    r, error = np.median(scans, axis=0), 0.03
    for _ in range(10):
        wall = abs(scans - r) <= 2.5 * error * r + step / 2
        count = np.maximum(wall.sum(axis=0), 1)
        r = (wall * scans).sum(axis=0) / count
        error = np.sqrt(np.sum((wall * (scans / r - 1)) ** 2) / np.sum(count - 1))
    return error, 1 - wall.mean()
""",
    ),
    (
        "02-busy-room",
        "takes off step^2 instead of step^2/12",
        """
def busy_fit(scans, step):
    r, error = np.median(scans, axis=0), 0.03
    for _ in range(12):
        wall = abs(scans - r) <= 2.5 * error * r + step / 2
        count = np.maximum(wall.sum(axis=0), 1)
        r = (wall * scans).sum(axis=0) / count
        noise = np.sum(wall * (scans - r) ** 2) - np.sum(count - 1) * step ** 2
        error = max(np.sqrt(max(noise, 0) / np.sum((count - 1) * r ** 2)), 0.001)
    return error, 1 - wall.mean()
""",
    ),
    (
        "02-busy-room",
        "returns blocked first",
        """
def busy_fit(scans, step):
    r, error = np.median(scans, axis=0), 0.03
    for _ in range(12):
        wall = abs(scans - r) <= 2.5 * error * r + step / 2
        count = wall.sum(axis=0)
        r = np.where(count > 0, (wall * scans).sum(axis=0) / np.maximum(count, 1), r)
        free = np.maximum(count - 1, 0)
        noise = np.sum(wall * (scans - r) ** 2) - np.sum(free) * step ** 2 / 12
        error = max(np.sqrt(max(noise, 0) / np.sum(free * r ** 2)), 0.001)
    return 1 - wall.mean(), error
""",
    ),
    (
        "02-busy-room",
        "the error in metres",
        """
def busy_fit(scans, step):
    r, sigma = np.median(scans, axis=0), 0.1
    for _ in range(12):
        wall = abs(scans - r) <= 2.5 * sigma + step / 2
        count = np.maximum(wall.sum(axis=0), 1)
        r = (wall * scans).sum(axis=0) / count
        noise = np.sum(wall * (scans - r) ** 2) / np.sum(count - 1) - step ** 2 / 12
        sigma = np.sqrt(max(noise, 1e-5))
    return sigma, 1 - wall.mean()
""",
    ),
    (
        "02-busy-room",
        "the mean of all readings for the wall",
        """
def busy_fit(scans, step):
    r = scans.mean(axis=0)
    off = scans / r - 1
    keep = np.abs(off) < 2 * off.std()
    var = np.var(off[keep]) - np.mean((step / r) ** 2) / 12
    return np.sqrt(max(var, 1e-6)), 1 - keep.mean()
""",
    ),
    (
        "02-busy-room",
        "the largest reading for the wall",
        """
def busy_fit(scans, step):
    r = scans.max(axis=0)
    wall = scans > 0.9 * r
    share = np.where(wall, scans / r, np.nan)
    var = np.nanvar(share) - np.mean((step / r) ** 2) / 12
    return np.sqrt(max(var, 4e-6)), 1 - wall.mean()
""",
    ),
    (
        "02-busy-room",
        "averages the errors of the beams with equal weight, clips at zero each",
        """
def busy_fit(scans, step):
    errors, people = [], 0
    for column in scans.T:
        r = np.median(column)
        wall = column[np.abs(column - r) < 0.08 * r + step / 2]
        people += len(column) - len(wall)
        var = max(np.var(wall, ddof=1) - step ** 2 / 12, 0) if len(wall) > 1 else 0
        errors.append(np.sqrt(var) / r)
    return max(np.mean(errors), 0.001), people / scans.size
""",
    ),
    (
        "02-busy-room",
        "percentiles: the upper half only",
        """
def busy_fit(scans, step):
    r = np.percentile(scans, 60, axis=0)
    high = np.percentile(scans, 84, axis=0)
    error = np.median((high - r) / r)
    blocked = np.mean(scans < r * (1 - 3 * error))
    return max(error, 0.002), blocked
""",
    ),
    (
        "02-busy-room",
        "changes scans: sets people to NaN in place",
        """
def busy_fit(scans, step):
    for _ in range(8):
        r = np.nanmedian(scans, axis=0)
        var = np.nanmean((scans - r) ** 2 - step ** 2 / 12) / np.mean(r ** 2)
        error = np.sqrt(max(var, 1e-6))
        scans[np.abs(scans - r) > 2.5 * error * r + step] = np.nan
    return error, np.isnan(scans).mean()
""",
    ),
    (
        "02-busy-room",
        "cuts at 1 sigma without correcting for it",
        """
def busy_fit(scans, step):
    r, error = np.median(scans, axis=0), 0.03
    for _ in range(12):
        wall = abs(scans - r) <= 1.2 * error * r + step / 2
        count = np.maximum(wall.sum(axis=0), 1)
        r = (wall * scans).sum(axis=0) / count
        noise = np.sum(wall * (scans - r) ** 2) - np.sum(count - 1) * step ** 2 / 12
        error = max(np.sqrt(max(noise, 0) / np.sum((count - 1) * r ** 2)), 0.001)
    return error, 1 - wall.mean()
""",
    ),
]
