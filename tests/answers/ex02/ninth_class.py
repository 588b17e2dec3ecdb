"""A ninth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "02-ray-wall",
        "turns the wall into the beam's frame and looks where it crosses the axis",
        """
def ray_wall(p, phi, wall):
    c, s = np.cos(phi), np.sin(phi)
    a, b = np.asarray(wall[:2]) - p, np.asarray(wall[2:]) - p
    ya, yb = c * a[1] - s * a[0], c * b[1] - s * b[0]
    xa, xb = c * a[0] + s * a[1], c * b[0] + s * b[1]
    if abs(yb - ya) <= 1e-12 * np.hypot(xb - xa, yb - ya) or ya * yb > 0:
        return np.inf
    far = xa + (xb - xa) * ya / (ya - yb)
    return far if far >= 0 else np.inf
""",
    ),
    (
        "02-echo",
        "cuts each wall down to the cone by its two half planes, then nearest place of what is left",
        """
def echo(p, phi, half, walls):
    best = np.inf
    for x1, y1, x2, y2 in walls:
        a = np.array([x1 - p[0], y1 - p[1]])
        w = np.array([x2 - x1, y2 - y1])
        low, high = 0.0, 1.0
        for normal in (
            np.array([-np.sin(phi - half), np.cos(phi - half)]),  # left of the right rim
            np.array([np.sin(phi + half), -np.cos(phi + half)]),  # right of the left rim
        ):
            at, slope = normal @ a, normal @ w  # at + t slope >= 0
            if slope == 0:
                if at < 0:
                    high = -1.0
            elif slope > 0:
                low = max(low, -at / slope)
            else:
                high = min(high, -at / slope)
        if low > high:
            continue
        t = min(max(-(a @ w) / (w @ w), low), high)
        best = min(best, np.linalg.norm(a + t * w))
    return best
""",
    ),
]

WRONG = [
    (
        "02-ray-wall",
        "no check that the wall lies ahead: a wall behind gives a distance (absolute value)",
        """
def ray_wall(p, phi, wall):
    p1, p2 = np.array(wall[:2]), np.array(wall[2:])
    u, w = np.array([np.cos(phi), np.sin(phi)]), p2 - p1
    M = np.column_stack([u, -w])
    if abs(np.linalg.det(M)) < 1e-12:
        return np.inf
    r, tau = np.linalg.solve(M, p1 - p)
    return abs(r) if 0 <= tau <= 1 else np.inf
""",
    ),
    (
        "02-ray-wall",
        "wall taken as endless: never looks whether the hit lies between the ends",
        """
def ray_wall(p, phi, wall):
    x1, y1, x2, y2 = wall
    nx, ny = y1 - y2, x2 - x1
    down = nx * np.cos(phi) + ny * np.sin(phi)
    if abs(down) < 1e-12:
        return np.inf
    r = (nx * (x1 - p[0]) + ny * (y1 - p[1])) / down
    return r if r > 0 else np.inf
""",
    ),
    (
        "02-ray-wall",
        "counts as parallel what has a small determinant (below 1e-2): short walls and slanting hits are lost",
        """
def ray_wall(p, phi, wall):
    ux, uy = np.cos(phi), np.sin(phi)
    wx, wy = wall[2] - wall[0], wall[3] - wall[1]
    det = ux * wy - uy * wx
    if abs(det) < 1e-2:
        return np.inf
    dx, dy = wall[0] - p[0], wall[1] - p[1]
    r, tau = (dx * wy - dy * wx) / det, (dx * uy - dy * ux) / det
    if r < 0 or tau < 0 or tau > 1:
        return np.inf
    return r
""",
    ),
    (
        "02-ray-wall",
        "looks whether phi lies between the bearings of the ends without wrapping: fails for walls behind at the cut of pi and for phi beyond a turn",
        """
def ray_wall(p, phi, wall):
    a1 = np.arctan2(wall[1] - p[1], wall[0] - p[0])
    a2 = np.arctan2(wall[3] - p[1], wall[2] - p[0])
    if not min(a1, a2) <= phi <= max(a1, a2):
        return np.inf
    wx, wy = wall[2] - wall[0], wall[3] - wall[1]
    det = np.cos(phi) * wy - np.sin(phi) * wx
    if det == 0:
        return np.inf
    return ((wall[0] - p[0]) * wy - (wall[1] - p[1]) * wx) / det
""",
    ),
    (
        "02-ray-wall",
        "the beam starts at the origin as in the lesson, p is not used",
        """
def ray_wall(p, phi, wall):
    p1 = np.asarray(wall[:2], dtype=float)
    p2 = np.asarray(wall[2:], dtype=float)
    A = np.array([[np.cos(phi), p1[0] - p2[0]], [np.sin(phi), p1[1] - p2[1]]])
    if abs(np.linalg.det(A)) < 1e-12:
        return np.inf
    r, tau = np.linalg.solve(A, p1)
    return r if r >= 0 and 0 <= tau <= 1 else np.inf
""",
    ),
    (
        "02-echo",
        "only the nearest place of each wall counts: a wall whose nearest place lies beside the cone is not heard",
        """
def echo(p, phi, half, walls):
    best = np.inf
    for wall in walls:
        p1, p2 = wall[:2], wall[2:]
        t = np.clip((p - p1) @ (p2 - p1) / ((p2 - p1) @ (p2 - p1)), 0, 1)
        place = p1 + t * (p2 - p1) - p
        off = np.arctan2(place[1], place[0]) - phi
        off = (off + np.pi) % (2 * np.pi) - np.pi
        if abs(off) < half:
            best = min(best, np.hypot(*place))
    return best
""",
    ),
    (
        "02-echo",
        "fires a fan of 181 beams: misses thin posts between them and the exact nearest place",
        """
def echo(p, phi, half, walls):
    fan = phi + np.linspace(-half, half, 181)
    heard = [ray_wall(p, beam, wall) for beam in fan for wall in walls]
    return min(heard, default=np.inf)
""",
    ),
    (
        "02-echo",
        "bearing compared with phi without a wrap",
        """
def echo(p, phi, half, walls):
    found = [np.inf]
    for wall in walls:
        p1, w = wall[:2], wall[2:] - wall[:2]
        tau = min(1, max(0, -((p1 - p) @ w) / (w @ w)))
        for place in (p1, wall[2:], p1 + tau * w):
            d = place - p
            if abs(np.arctan2(d[1], d[0]) - phi) <= half:
                found.append(np.hypot(d[0], d[1]))
        found += [ray_wall(p, phi - half, wall), ray_wall(p, phi + half, wall)]
    return min(found)
""",
    ),
    (
        "02-echo",
        "takes only the rims and the ends, forgets the foot of the perpendicular",
        """
def echo(p, phi, half, walls):
    e = np.array([np.cos(phi), np.sin(phi)])
    best = np.inf
    for wall in walls:
        for rim in (phi - half, phi, phi + half):
            best = min(best, ray_wall(p, rim, wall))
        for end in (wall[:2], wall[2:]):
            d = end - p
            if d @ e > np.cos(half) * np.linalg.norm(d):
                best = min(best, np.linalg.norm(d))
    return best
""",
    ),
    (
        "02-to-points",
        "angles taken as counter-clockwise, sign not turned",
        """
def to_points(degrees, millimetres, mount, pose):
    ok = millimetres != 0
    r = millimetres[ok] * 1e-3
    heading = pose[2] + mount[2] + np.radians(degrees[ok])
    c, s = np.cos(pose[2]), np.sin(pose[2])
    ex = pose[0] + c * mount[0] - s * mount[1]
    ey = pose[1] + s * mount[0] + c * mount[1]
    return np.column_stack([ex + r * np.cos(heading), ey + r * np.sin(heading)])
""",
    ),
    (
        "02-to-points",
        "offset of the mount added in the world's frame, not turned with the robot",
        """
def to_points(degrees, millimetres, mount, pose):
    points = []
    for deg, mm in zip(degrees, millimetres):
        if mm == 0:
            continue
        angle = pose[2] + mount[2] - np.deg2rad(deg)
        x = pose[0] + mount[0] + mm / 1000 * np.cos(angle)
        y = pose[1] + mount[1] + mm / 1000 * np.sin(angle)
        points.append([x, y])
    return np.array(points).reshape(-1, 2)
""",
    ),
    (
        "02-to-points",
        "the sensor's own turn in the mount is forgotten",
        """
def to_points(degrees, millimetres, mount, pose):
    back = millimetres > 0
    a, r = -np.radians(degrees[back]), millimetres[back] / 1000
    robot = np.array([mount[0] + r * np.cos(a), mount[1] + r * np.sin(a)])
    R = np.array([[np.cos(pose[2]), -np.sin(pose[2])], [np.sin(pose[2]), np.cos(pose[2])]])
    return (R @ robot).T + pose[:2]
""",
    ),
    (
        "02-to-points",
        "keeps the readings of 0: they become points at the sensor",
        """
def to_points(degrees, millimetres, mount, pose):
    z = millimetres / 1000 * np.exp(-1j * np.radians(degrees))
    z = complex(mount[0], mount[1]) + z * np.exp(1j * mount[2])
    z = complex(pose[0], pose[1]) + z * np.exp(1j * pose[2])
    return np.column_stack([z.real, z.imag])
""",
    ),
    (
        "02-noise",
        "standard deviation is error itself, the same for all ranges",
        """
def noisy(ranges, error, dropouts, rng):
    out = ranges + rng.normal(0, error, size=ranges.shape)
    lost = rng.uniform(size=ranges.shape) < dropouts
    return np.where(lost, np.nan, out)
""",
    ),
    (
        "02-noise",
        "one and the same error for all beams of the scan",
        """
def noisy(ranges, error, dropouts, rng):
    out = ranges * (1 + error * rng.standard_normal())
    out[rng.random(len(out)) < dropouts] = np.nan
    return out
""",
    ),
    (
        "02-noise",
        "loses a fixed number of beams (share times n) instead of each one by itself",
        """
def noisy(ranges, error, dropouts, rng):
    n = len(ranges)
    out = ranges * (1 + error * rng.standard_normal(n))
    gone = rng.choice(n, int(round(dropouts * n)), replace=False) if n else []
    out[gone] = np.nan
    return out
""",
    ),
    (
        "02-noise",
        "changes the ranges it was given",
        """
def noisy(ranges, error, dropouts, rng):
    for k in range(len(ranges)):
        if rng.random() < dropouts:
            ranges[k] = np.nan
        else:
            ranges[k] += error * ranges[k] * rng.standard_normal()
    return ranges
""",
    ),
    (
        "02-busy-room",
        "takes the quiet room's estimate; people count as noise, blocked is 0",
        """
def busy_fit(scans, step):
    return quiet_fit(scans), 0.0
""",
    ),
    (
        "02-busy-room",
        "spread from the median absolute deviation, but without taking out the rounding to steps",
        """
def busy_fit(scans, step):
    wall = np.median(scans, axis=0)
    share = (scans - wall) / wall
    error = 1.4826 * np.median(np.abs(share))
    people = share < -3 * error - step / wall
    return error, people.mean()
""",
    ),
    (
        "02-busy-room",
        "the rounding's variance subtracted as step**2/12 from the shares, not divided by r squared",
        """
def busy_fit(scans, step):
    r = np.median(scans, axis=0)
    ok = np.abs(scans - r) < 0.08 * r + step
    share = np.where(ok, scans / r - 1, np.nan)
    var = np.nanmean(share**2) - step**2 / 12
    return np.sqrt(max(var, 1e-6)), 1 - ok.mean()
""",
    ),
    (
        "02-busy-room",
        "a person is whoever is 10 cm or more in front of the median: far walls' own noise is cut off, fixed instead of a share",
        """
def busy_fit(scans, step):
    r = np.median(scans, axis=0)
    people = scans < r - 0.1
    kept = np.ma.array(scans, mask=people)
    var = kept.var(axis=0) - step**2 / 12
    errors = np.sqrt(np.maximum(var, 0)) / r
    return float(errors.mean()), float(people.mean())
""",
    ),
    (
        "02-echo",
        "fails when there are no walls at all (minimum of nothing)",
        """
def echo(p, phi, half, walls):
    axis = np.array([np.cos(phi), np.sin(phi)])
    heard = []
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        foot = a + np.clip(-(a @ w) / (w @ w), 0, 1) * w
        for place in (a, a + w, foot):
            far = np.linalg.norm(place)
            heard.append(far if place @ axis > far * np.cos(half) else np.inf)
        heard.append(ray_wall(p, phi - half, wall))
        heard.append(ray_wall(p, phi + half, wall))
    return min(heard)
""",
    ),
    (
        "02-to-points",
        "fails when nothing came back (an empty list has no columns)",
        """
def to_points(degrees, millimetres, mount, pose):
    seen = []
    for a, mm in zip(np.radians(degrees), millimetres):
        if mm > 0:
            seen.append([mm / 1000 * np.cos(-a), mm / 1000 * np.sin(-a)])
    points = np.array(seen)
    for x, y, t in (mount, pose):
        points = np.column_stack([
            x + points[:, 0] * np.cos(t) - points[:, 1] * np.sin(t),
            y + points[:, 0] * np.sin(t) + points[:, 1] * np.cos(t),
        ])
    return points
""",
    ),
    (
        "02-noise",
        "random numbers from numpy's global generator, not from rng",
        """
def noisy(ranges, error, dropouts, rng):
    out = np.random.normal(ranges, error * np.nan_to_num(ranges))
    return np.where(np.random.rand(len(ranges)) < dropouts, np.nan, out)
""",
    ),
]
