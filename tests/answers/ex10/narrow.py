"""Independent answers to 10-narrow: right ones, and students' mistakes."""

RIGHT = [
    (
        "10-narrow",
        "cells of pose space, thrown out by interval tests, again and again",
        """
def narrow(robot, heading, objects, z, bounds):
    lo = np.array([robot[0], robot[2], heading[0]], dtype=float)
    hi = np.array([robot[1], robot[3], heading[1]], dtype=float)
    objects, z = np.reshape(objects, (-1, 2)), np.reshape(z, (-1, 2))
    n = 14
    for _ in range(7):
        half = (hi - lo) / n / 2
        ticks = [lo[i] + half[i] * (2 * np.arange(n) + 1) for i in range(3)]
        x, y = (v.ravel() for v in np.meshgrid(ticks[0], ticks[1], indexing="ij"))
        keep = np.ones((n * n, n), dtype=bool)
        for (ox, oy), (r, beta) in zip(objects, z):
            dx, dy = ox - x, oy - y
            ax, ay = np.abs(dx), np.abs(dy)
            nearest = np.hypot(np.maximum(ax - half[0], 0), np.maximum(ay - half[1], 0))
            farthest = np.hypot(ax + half[0], ay + half[1])
            ok = (nearest <= r + bounds[0] + 1e-9) & (farthest >= r - bounds[0] - 1e-9)
            middle = np.arctan2(dy, dx)
            spread = np.zeros_like(x)
            for sx in (-1, 1):
                for sy in (-1, 1):
                    corner = np.arctan2(dy + sy * half[1], dx + sx * half[0])
                    spread = np.maximum(spread, np.abs(wrap(corner - middle)))
            spread = np.where((ax <= half[0] + 1e-12) & (ay <= half[1] + 1e-12), np.pi, spread)
            turned = np.abs(wrap(middle[:, None] - beta - ticks[2]))
            keep &= ok[:, None] & (turned <= spread[:, None] + bounds[1] + half[2] + 1e-9)
        keep = keep.reshape(n, n, n)
        if not keep.any():
            break
        new_lo, new_hi = lo.copy(), hi.copy()
        for i in range(3):
            axes = tuple(j for j in range(3) if j != i)
            hit = np.flatnonzero(keep.any(axis=axes))
            new_lo[i] = lo[i] + 2 * half[i] * hit[0]
            new_hi[i] = min(hi[i], lo[i] + 2 * half[i] * (hit[-1] + 1))
        lo, hi = new_lo, new_hi
    return np.array([lo[0], hi[0], lo[1], hi[1]]), np.array([lo[2], hi[2]])
""",
    ),
    (
        "10-narrow",
        "slices of the heading, a polygon each, bisected where it counts",
        """
def narrow(robot, heading, objects, z, bounds):
    def polygon(low, high):
        x0, x1, y0, y1 = robot
        points = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
        if bounds[1] + (high - low) / 2 >= 1.5:
            return points
        for place, sight in zip(objects, z):
            box = np.array([place[0], place[0], place[1], place[1]])
            for a, b, c in edges(sight, bounds, np.array([low, high]) + np.pi, box):
                room = [c + 1e-12 - a * p - b * q for p, q in points]
                new = []
                for i in range(len(points)):
                    j = (i + 1) % len(points)
                    (p, q), (u, v) = points[i], points[j]
                    if room[i] >= 0:
                        new.append((p, q))
                    if room[i] * room[j] < 0:
                        t = room[i] / (room[i] - room[j])
                        new.append((p + t * (u - p), q + t * (v - q)))
                points = new
                if not points:
                    return points
        return points

    low, high = float(heading[0]), float(heading[1])
    pieces = [(low, high, polygon(low, high))]
    for level in range(6):
        if pieces[-1][1] - pieces[0][0] < 0.01 or len(pieces) > 20:
            break
        new = []
        for a, b, _ in pieces:
            m = (a + b) / 2
            for c, d in ((a, m), (m, b)):
                points = polygon(c, d)
                if points:
                    new.append((c, d, points))
        pieces = new or pieces
    corners = np.array([p for piece in pieces for p in piece[2]])
    box = np.array(
        [corners[:, 0].min(), corners[:, 0].max(), corners[:, 1].min(), corners[:, 1].max()]
    )
    return box, np.array([pieces[0][0], pieces[-1][1]])
""",
    ),
]

WRONG = [
    (
        "10-narrow",
        "returns what it was given",
        """
def narrow(robot, heading, objects, z, bounds):
    return np.array(robot), np.array(heading)
""",
    ),
    (
        "10-narrow",
        "one round of look and no more",
        """
def narrow(robot, heading, objects, z, bounds):
    found = look(robot, heading, objects, z, bounds)
    if found is None:
        return robot, heading
    return found
""",
    ),
    (
        "10-narrow",
        "look again until nothing shrinks: three times as wide as need be",
        """
def narrow(robot, heading, objects, z, bounds):
    robot, heading = np.array(robot), np.array(heading)
    for _ in range(30):
        before = np.concatenate([robot, heading])
        result = look(robot, heading, objects, z, bounds)
        if result is None:
            break
        robot, heading = result
        if np.allclose(before, np.concatenate([robot, heading]), atol=1e-4):
            break
    return robot, heading
""",
    ),
    (
        "10-narrow",
        "random poses that agree, and a box round them: misses the farthest",
        """
def narrow(robot, heading, objects, z, bounds):
    rng = np.random.default_rng(0)
    lo = np.array([robot[0], robot[2], heading[0]])
    hi = np.array([robot[1], robot[3], heading[1]])
    for _ in range(4):
        poses = rng.uniform(lo, hi, (20_000, 3))
        good = np.ones(len(poses), dtype=bool)
        for (x, y), (r, beta) in zip(objects, z):
            dx, dy = x - poses[:, 0], y - poses[:, 1]
            good &= np.abs(np.hypot(dx, dy) - r) <= bounds[0]
            good &= np.abs(wrap(np.arctan2(dy, dx) - poses[:, 2] - beta)) <= bounds[1]
        if good.sum() < 10:
            break
        lo, hi = poses[good].min(axis=0), poses[good].max(axis=0)
    return np.array([lo[0], hi[0], lo[1], hi[1]]), np.array([lo[2], hi[2]])
""",
    ),
    (
        "10-narrow",
        "random poses, and five percent more on each side for safety",
        """
def narrow(robot, heading, objects, z, bounds):
    rng = np.random.default_rng(3)
    first_lo = lo = np.array([robot[0], robot[2], heading[0]])
    first_hi = hi = np.array([robot[1], robot[3], heading[1]])
    for _ in range(4):
        poses = rng.uniform(lo, hi, (15_000, 3))
        good = np.ones(len(poses), dtype=bool)
        for (x, y), (r, beta) in zip(objects, z):
            dx, dy = x - poses[:, 0], y - poses[:, 1]
            good &= np.abs(np.hypot(dx, dy) - r) <= bounds[0]
            good &= np.abs(wrap(np.arctan2(dy, dx) - poses[:, 2] - beta)) <= bounds[1]
        if good.sum() < 5:
            break
        a, b = poses[good].min(axis=0), poses[good].max(axis=0)
        lo, hi = np.maximum(first_lo, a - 0.05 * (b - a)), np.minimum(first_hi, b + 0.05 * (b - a))
    return np.array([lo[0], hi[0], lo[1], hi[1]]), np.array([lo[2], hi[2]])
""",
    ),
    (
        "10-narrow",
        "look, then everything shrunk to a third about its middle",
        """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(5):
        found = look(robot, heading, objects, z, bounds)
        if found is None:
            break
        robot, heading = found
    robot, heading = np.array(robot, dtype=float), np.array(heading, dtype=float)
    for k, interval in ((0, robot[:2]), (2, robot[2:])):
        m, w = interval.mean(), interval[1] - interval[0]
        robot[k : k + 2] = m - w / 6, m + w / 6
    m, w = heading.mean(), heading[1] - heading[0]
    return robot, np.array([m - w / 6, m + w / 6])
""",
    ),
    (
        "10-narrow",
        "slices of the heading taken as exact headings (their middles)",
        """
def narrow(robot, heading, objects, z, bounds):
    boxes, angles = [], []
    for theta in np.linspace(heading[0], heading[1], 40):
        box = robot
        for place, sight in zip(objects, z):
            lines = edges(sight, bounds, np.array([theta, theta]) + np.pi, np.repeat(place, 2))
            box = cut(box, lines)
            if box is None:
                break
        if box is not None:
            boxes.append(box)
            angles.append(theta)
    if not boxes:
        return robot, heading
    b = np.array(boxes)
    box = np.array([b[:, 0].min(), b[:, 1].max(), b[:, 2].min(), b[:, 3].max()])
    return box, np.array([angles[0], angles[-1]])
""",
    ),
    (
        "10-narrow",
        "the last kept slice counts with its right end only",
        """
def narrow(robot, heading, objects, z, bounds):
    ends = np.linspace(heading[0], heading[1], 31)
    boxes, angles = [], []
    for k in range(30):
        piece = np.array([ends[k], ends[k + 1]])
        found = robot, piece
        for _ in range(3):
            if found is not None:
                found = look(*found, objects, z, bounds)
        if found is not None:
            boxes.append(found[0])
            angles.append(ends[k])
    b = np.array(boxes)
    return (
        np.array([b[:, 0].min(), b[:, 1].max(), b[:, 2].min(), b[:, 3].max()]),
        np.array([min(angles), max(angles)]),
    )
""",
    ),
    (
        "10-narrow",
        "slices and polygons, but the edges not turned by pi",
        """
def narrow(robot, heading, objects, z, bounds):
    def rest(corners, edge):
        a, b, c = edge
        kept = []
        for (x, y), (u, v) in zip(corners, corners[1:] + corners[:1], strict=True):
            here, there = c - a * x - b * y, c - a * u - b * v
            if here >= 0:
                kept.append((x, y))
            if (here >= 0) != (there >= 0):
                t = here / (here - there)
                kept.append((x + t * (u - x), y + t * (v - y)))
        return kept

    ends = np.linspace(*heading, 25)
    every, angles = [], []
    for piece in zip(ends[:-1], ends[1:]):
        x0, x1, y0, y1 = robot
        corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
        for place, sight in zip(objects, z):
            for edge in edges(sight, bounds, piece, np.repeat(place, 2)):
                corners = rest(corners, edge)
        if corners:
            every += corners
            angles += piece
    if not every:
        return robot, heading
    x, y = np.array(every).T
    return np.array([x.min(), x.max(), y.min(), y.max()]), np.array([min(angles), max(angles)])
""",
    ),
    (
        "10-narrow",
        "only four slices of the heading: sound, still wide",
        """
def narrow(robot, heading, objects, z, bounds):
    ends = np.linspace(heading[0], heading[1], 5)
    found = []
    for piece in zip(ends[:-1], ends[1:]):
        one = look(robot, np.array(piece), objects, z, bounds)
        if one is not None:
            found.append(np.concatenate(one))
    found = np.array(found)
    low, high = found.min(axis=0), found.max(axis=0)
    return np.array([low[0], high[1], low[2], high[3]]), np.array([low[4], high[5]])
""",
    ),
    (
        "10-narrow",
        "box and heading changed in place",
        """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(3):
        ends = np.linspace(heading[0], heading[1], 17)
        found = []
        for k in range(16):
            one = look(robot.copy(), ends[k : k + 2].copy(), objects, z, bounds)
            if one is not None:
                found.append(np.concatenate(one))
        if not found:
            break
        found = np.array(found)
        robot[::2], robot[1::2] = found[:, [0, 2]].min(axis=0), found[:, [1, 3]].max(axis=0)
        heading[0], heading[1] = found[:, 4].min(), found[:, 5].max()
    return robot, heading
""",
    ),
    (
        "10-narrow",
        "the best pose by least squares, plus and minus the bounds",
        """
def narrow(robot, heading, objects, z, bounds):
    p = np.array([(robot[0] + robot[1]) / 2, (robot[2] + robot[3]) / 2, np.mean(heading)])
    for _ in range(10):
        rows, rest = [], []
        for (x, y), (r, beta) in zip(objects, z):
            dx, dy = x - p[0], y - p[1]
            q = np.hypot(dx, dy) + 1e-9
            rows += [[-dx / q, -dy / q, 0], [dy / q**2, -dx / q**2, -1]]
            rest += [r - q, wrap(beta - np.arctan2(dy, dx) + p[2])]
        if rows:
            p = p + np.linalg.lstsq(np.array(rows), np.array(rest), rcond=None)[0]
    box = np.array([p[0] - bounds[0], p[0] + bounds[0], p[1] - bounds[0], p[1] + bounds[0]])
    return box, np.array([p[2] - bounds[1], p[2] + bounds[1]])
""",
    ),
    (
        "10-narrow",
        "crashes without objects (concatenates nothing)",
        """
def narrow(robot, heading, objects, z, bounds):
    every = []
    ends = np.linspace(heading[0], heading[1], 25)
    for low, high in zip(ends[:-1], ends[1:]):
        lines = [
            edges(s, bounds, np.array([low, high]) + np.pi, np.repeat(p, 2))
            for p, s in zip(objects, z)
        ]
        lines = np.concatenate(lines)
        box = robot
        for _ in range(2):
            box = cut(box, lines)
        if box is not None:
            every.append([*box, low, high])
    e = np.array(every)
    return (
        np.array([e[:, 0].min(), e[:, 1].max(), e[:, 2].min(), e[:, 3].max()]),
        np.array([e[:, 4].min(), e[:, 5].max()]),
    )
""",
    ),
    (
        "10-narrow",
        "600 slices, three rounds: small and far too slow",
        """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(3):
        ends = np.linspace(heading[0], heading[1], 601)
        found = []
        for k in range(600):
            one = robot, ends[k : k + 2]
            for _ in range(3):
                if one is not None:
                    one = look(*one, objects, z, bounds)
            if one is not None:
                found.append(np.concatenate(one))
        if not found:
            break
        f = np.array(found)
        robot = np.array([f[:, 0].min(), f[:, 1].max(), f[:, 2].min(), f[:, 3].max()])
        heading = np.array([f[:, 4].min(), f[:, 5].max()])
    return robot, heading
""",
    ),
    (
        "10-narrow",
        "only the first three sightings are used",
        """
def narrow(robot, heading, objects, z, bounds):
    ends = np.linspace(heading[0], heading[1], 25)
    found = []
    for k in range(24):
        one = robot, ends[k : k + 2]
        for _ in range(3):
            if one is not None:
                one = look(*one, objects[:3], z[:3], bounds)
        if one is not None:
            found.append(np.concatenate(one))
    if not found:
        return robot, heading
    f = np.array(found)
    box = np.array([f[:, 0].min(), f[:, 1].max(), f[:, 2].min(), f[:, 3].max()])
    return box, np.array([f[:, 4].min(), f[:, 5].max()])
""",
    ),
    (
        "10-narrow",
        "only ranges, by rings seen from the objects; the heading stays",
        """
def narrow(robot, heading, objects, z, bounds):
    robot = np.array(robot)
    for _ in range(3):
        for place, sight in zip(objects, z):
            box = ring(np.repeat(place, 2), robot, sight[0], bounds[0])
            if box is not None:
                robot = box
    return robot, np.array(heading)
""",
    ),
    (
        "10-narrow",
        "heading sharpened with the robot in the middle of its box",
        """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(4):
        found = look(robot, heading, objects, z, bounds)
        if found is None:
            break
        robot, heading = found
        x, y = (robot[0] + robot[1]) / 2, (robot[2] + robot[3]) / 2
        for place, sight in zip(objects, z):
            new = sharpen(heading, np.array([x, x, y, y]), np.repeat(place, 2), sight[1], bounds[1])
            if new[0] <= new[1]:
                heading = new
    return robot, heading
""",
    ),
    (
        "10-narrow",
        "cells of pose space judged by their middles",
        """
def narrow(robot, heading, objects, z, bounds):
    lo = np.array([robot[0], robot[2], heading[0]], dtype=float)
    hi = np.array([robot[1], robot[3], heading[1]], dtype=float)
    for _ in range(4):
        n = 20
        step = (hi - lo) / n
        axes = [lo[i] + step[i] * (np.arange(n) + 0.5) for i in range(3)]
        x, y, t = (a.ravel() for a in np.meshgrid(*axes, indexing="ij"))
        ok = np.ones(x.size, dtype=bool)
        for (ox, oy), (r, b) in zip(objects, z):
            ok &= np.abs(np.hypot(ox - x, oy - y) - r) <= bounds[0]
            ok &= np.abs(wrap(np.arctan2(oy - y, ox - x) - t - b)) <= bounds[1]
        if not ok.any():
            break
        cells = np.column_stack([x, y, t])[ok]
        lo, hi = cells.min(axis=0) - step / 2, cells.max(axis=0) + step / 2
    return np.array([lo[0], hi[0], lo[1], hi[1]]), np.array([lo[2], hi[2]])
""",
    ),
]
