# %% way: where lines cross
def narrow(robot, heading, objects, z, bounds):
    for _ in range(2):
        ends, found = np.linspace(*heading, 25), []
        for piece in zip(ends[:-1], ends[1:]):
            lines = [(-1, 0, -robot[0]), (1, 0, robot[1]), (0, -1, -robot[2]), (0, 1, robot[3])]
            for place, z_object in zip(objects, z):
                lines += list(edges(z_object, bounds, np.add(piece, np.pi), np.repeat(place, 2)))
            lines = np.array(lines)
            k, m = np.triu_indices(len(lines), 1)
            (a, b, c), (d, e, f) = lines[k].T, lines[m].T
            with np.errstate(all="ignore"):
                points = np.array([c * e - b * f, a * f - c * d]) / (a * e - b * d)
                points = points[:, (lines[:, :2] @ points <= lines[:, 2:] + 1e-9).all(axis=0)]
            if points.size:
                found.append([*points.min(axis=1), piece[0], *points.max(axis=1), piece[1]])
        low, high = np.min(found, axis=0)[:3], np.max(found, axis=0)[3:]
        robot, heading = np.array([low[0], high[0], low[1], high[1]]), np.array([low[2], high[2]])
    return robot, heading


# %% way: a grid of cells
def narrow(robot, heading, objects, z, bounds):
    for _ in range(4):
        sides = [np.linspace(*side, 13) for side in (robot[:2], robot[2:], heading)]
        low = np.array(np.meshgrid(*(s[:-1] for s in sides))).reshape(3, -1)
        high = np.array(np.meshgrid(*(s[1:] for s in sides))).reshape(3, -1)
        for place, (r, bearing) in zip(objects, z):
            x, y = np.array([low[:2], high[:2]]).swapaxes(0, 1) - place[:, None, None]
            aside = [np.maximum(0, np.maximum(s[0], -s[1])) for s in (x, y)]
            most = np.hypot(np.abs(x).max(axis=0), np.abs(y).max(axis=0))
            middle = np.arctan2(-y.sum(axis=0), -x.sum(axis=0))
            off = wrap(np.arctan2(-y[[0, 0, 1, 1]], -x[[0, 1, 0, 1]]) - middle)
            turn = wrap(middle - bearing - (low[2] + high[2]) / 2)
            slack = bounds[1] + (high[2] - low[2]) / 2
            seen = (turn + off.min(axis=0) <= slack) & (turn + off.max(axis=0) >= -slack)
            seen |= np.hypot(*aside) == 0
            keep = seen & (np.hypot(*aside) <= r + bounds[0]) & (most >= r - bounds[0])
            low, high = low[:, keep], high[:, keep]
        ends = np.array([low.min(axis=1), high.max(axis=1)])
        robot, heading = ends[:, :2].T.ravel(), ends[:, 2]
    return robot, heading


# %% way: pieces after many rounds
def narrow(robot, heading, objects, z, bounds):
    for _ in range(12):
        robot, heading = look(robot, heading, objects, z, bounds)

    boxes = []
    width = (heading[1] - heading[0]) / 40
    for k in range(40):
        piece = heading[0] + k * width, heading[0] + (k + 1) * width
        polygon = [
            (robot[0], robot[2]),
            (robot[1], robot[2]),
            (robot[1], robot[3]),
            (robot[0], robot[3]),
        ]
        for place, z_object in zip(objects, z):
            for edge in edges(z_object, bounds, np.add(piece, np.pi), place[[0, 0, 1, 1]]):
                polygon = clip_polygon(polygon, edge)
            if not polygon:
                break
        if polygon:
            boxes.append((*np.min(polygon, axis=0), *np.max(polygon, axis=0), *piece))
    x0, y0, x1, y1, right, left = np.transpose(boxes)
    return (x0.min(), x1.max(), y0.min(), y1.max()), (right.min(), left.max())


# %% pasted: look
def narrow(robot, heading, objects, z, bounds):
    return look(robot, heading, objects, z, bounds)


# %% pasted: look until nothing shrinks
def narrow(robot, heading, objects, z, bounds):
    for _ in range(20):
        robot, heading = look(robot, heading, objects, z, bounds)
    return robot, heading


# %% pasted: each sighting until nothing shrinks
def narrow(robot, heading, objects, z, bounds):
    for place, z_object in zip(objects, z):
        for _ in range(10):
            robot, heading = look(robot, heading, place[None], z_object[None], bounds)
    return robot, heading


# %% pasted: predict backwards
def narrow(robot, heading, objects, z, bounds):
    for place, (r, bearing) in zip(objects, z):
        way = -r - bounds[0], -r + bounds[0]
        back = predict(
            np.repeat(place, 2), heading, way, (bearing - bounds[1], bearing + bounds[1])
        )
        robot = np.where([1, 0, 1, 0], np.maximum(robot, back), np.minimum(robot, back))
        heading = sharpen(heading, robot, np.repeat(place, 2), bearing, bounds[1])
    return robot, heading


# %% right: cells of pose space, thrown out by interval tests, again and again
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


# %% right: slices of the heading, a polygon each, bisected where it counts
def narrow(robot, heading, objects, z, bounds):
    def polygon(low, high):
        x0, x1, y0, y1 = robot
        points = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
        if bounds[1] + (high - low) / 2 >= 1.5:
            return points
        for place, z_object in zip(objects, z):
            box = np.array([place[0], place[0], place[1], place[1]])
            for a, b, c in edges(z_object, bounds, np.array([low, high]) + np.pi, box):
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
    for level in range(8):
        if pieces[-1][1] - pieces[0][0] < 0.001 or len(pieces) > 80:
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


# %% wrong: climbing samples, a margin of 15 %
def narrow(robot, heading, objects, z, bounds):
    rng = np.random.default_rng(0)
    sides = np.reshape([*robot, *heading], (3, 2))
    middle, half = sides.mean(axis=1), np.ptp(sides, axis=1) / 2

    def need(poses):
        worst = (np.abs(poses - middle) / half).max(axis=1)
        for (x, y), seen in zip(objects, z):
            dx, dy = x - poses[:, 0], y - poses[:, 1]
            error = np.array([np.hypot(dx, dy) - seen[0], wrap(np.arctan2(dy, dx) - poses[:, 2] - seen[1])])
            worst = np.maximum(worst, np.abs(error / bounds[:, None]).max(axis=0))
        return worst

    poses = rng.uniform(*sides.T, (4000, 3))
    for k in range(60):
        share = need(poses)
        best = poses[np.argsort(share)[:100]]
        if share.min() <= 1 and k > 20:
            break
        poses = np.vstack([best, np.repeat(best, 20, axis=0) + half * 0.8**k * rng.standard_normal((2000, 3))])
    good = poses[need(poses) <= 1]
    for k in range(40):
        ends = np.concatenate([good[[good[:, a].argmin(), good[:, a].argmax()]] for a in range(3)])
        tries = np.repeat(ends, 60, axis=0) + half * 0.85**k * rng.standard_normal((360, 3))
        good = np.vstack([ends, tries[need(tries) <= 1]])
    low, high = good.min(axis=0), good.max(axis=0)
    margin = 0.15 * (high - low)
    low, high = np.maximum(low - margin, sides[:, 0]), np.minimum(high + margin, sides[:, 1])
    return np.array([low[0], high[0], low[1], high[1]]), np.array([low[2], high[2]])


# %% wrong: look until nothing changes, heading as it was
def narrow(robot, heading, objects, z, bounds):
    for _ in range(30):
        robot, _ = look(robot, heading, objects, z, bounds)
    return robot, heading


# %% wrong: returns what it was given
def narrow(robot, heading, objects, z, bounds):
    return np.array(robot), np.array(heading)


# %% wrong: box and heading changed in place
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


# %% wrong: headings are split soundly, but it fails where there is no object at all (nothing to concatenate)
def narrow(robot, heading, objects, z, bounds):
    for _ in range(2):
        ends = np.linspace(heading[0], heading[1], 31)
        boxes, parts = [], []
        for lo, hi in zip(ends[:-1], ends[1:]):
            turned = np.array([lo, hi]) + np.pi
            lines = np.concatenate(
                [edges(s, bounds, turned, np.repeat(o, 2)) for o, s in zip(objects, z)]
            )
            box = robot
            for _ in range(3):
                box = cut(box, lines)
            if box is not None:
                boxes.append(box)
                parts += [lo, hi]
        B = np.array(boxes)
        robot = np.array([B[:, 0].min(), B[:, 1].max(), B[:, 2].min(), B[:, 3].max()])
        heading = np.array([min(parts), max(parts)])
    return robot, heading
