"""A ninth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "10-predict",
        "candidate angles: both ends and all multiples of pi/2 between them, corners of distance",
        """
def predict(box, heading, way, direction):
    lo, hi = heading[0] + direction[0], heading[1] + direction[1]
    q = np.pi / 2
    k0, k1 = int(np.ceil(lo / q)), int(np.floor(hi / q))
    angles = [lo, hi]
    xs = [d * np.cos(a) for d in way for a in angles]
    ys = [d * np.sin(a) for d in way for a in angles]
    exact = {0: (1, 0), 1: (0, 1), 2: (-1, 0), 3: (0, -1)}
    for k in range(k0, min(k1, k0 + 4) + 1):
        c, s = exact[k % 4]
        xs += [way[0] * c, way[1] * c]
        ys += [way[0] * s, way[1] * s]
    return np.array([box[0] + min(xs), box[1] + max(xs), box[2] + min(ys), box[3] + max(ys)])
""",
    ),
    (
        "10-edges",
        "edges as lines through points of the sector, pushed out by the support of the box's corners",
        """
def edges(z, bounds, heading, box):
    mid = 0.5 * (heading[0] + heading[1]) + z[1]
    half = bounds[1] + 0.5 * (heading[1] - heading[0])
    corners = np.array([(x, y) for x in box[:2] for y in box[2:]])
    angles = np.array([mid, mid + np.pi, mid + half + np.pi / 2, mid - half - np.pi / 2])
    normals = np.column_stack([np.cos(angles), np.sin(angles)])
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(half), 0.0, 0.0])
    return np.column_stack([normals, c + (normals @ corners.T).max(axis=1)])
""",
    ),
    (
        "10-ring",
        "the same question asked along x and y by cases: which sides survive, written out with intervals",
        """
def ring(robot, box, r, bound):
    near, far = max(0.0, r - bound), r + bound
    result = []
    for k in (0, 2):
        o = 2 - k
        lo, hi = box[o] - robot[o + 1], box[o + 1] - robot[o]
        farthest = max(abs(lo), abs(hi))
        closest = 0.0 if lo <= 0 <= hi else min(abs(lo), abs(hi))
        if closest > far:
            return None
        big = (far**2 - closest**2) ** 0.5
        small = (near**2 - farthest**2) ** 0.5 if near > farthest else 0.0
        ends = []
        a, b = max(box[k], robot[k] + small), min(box[k + 1], robot[k + 1] + big)
        if a <= b:
            ends += [a, b]
        a, b = max(box[k], robot[k] - big), min(box[k + 1], robot[k + 1] - small)
        if a <= b:
            ends += [a, b]
        if not ends:
            return None
        result += [min(ends), max(ends)]
    return np.array(result)
""",
    ),
]

WRONG = [
    (
        "10-predict",
        "cosine and sine only at both ends of the directions: crests in between (east, north...) are forgotten",
        """
def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    xs = [d * np.cos(a) for d in way for a in (low, high)]
    ys = [d * np.sin(a) for d in way for a in (low, high)]
    return np.array([box[0] + min(xs), box[1] + max(xs), box[2] + min(ys), box[3] + max(ys)])
""",
    ),
    (
        "10-predict",
        "the sine's range is taken as the cosine's of the angles plus pi/2, which is that of minus the sine",
        """
def cosine_range(low, high):
    lo, hi = min(np.cos(low), np.cos(high)), max(np.cos(low), np.cos(high))
    if np.ceil(low / (2 * np.pi)) * 2 * np.pi <= high:
        hi = 1.0
    if np.ceil((low - np.pi) / (2 * np.pi)) * 2 * np.pi + np.pi <= high:
        lo = -1.0
    return np.array([lo, hi])


def predict(box, heading, way, direction):
    low, high = heading + direction
    dx = np.outer(way, cosine_range(low, high))
    dy = np.outer(way, cosine_range(low + np.pi / 2, high + np.pi / 2))
    return np.array([box[0] + dx.min(), box[1] + dx.max(), box[2] + dy.min(), box[3] + dy.max()])
""",
    ),
    (
        "10-predict",
        "takes the distance as positive: way[1] goes with the extremes of cosine and sine, whatever their signs",
        """
def predict(box, heading, way, direction):
    def cosine_range(low, high):
        def met(angle):
            return (angle - low) % (2 * np.pi) <= high - low

        ends = np.cos([low, high])
        return (-1 if met(np.pi) else ends.min(), 1 if met(0) else ends.max())

    low, high = heading[0] + direction[0], heading[1] + direction[1]
    c = cosine_range(low, high)
    s = cosine_range(low - np.pi / 2, high - np.pi / 2)
    return np.array([
        box[0] + way[0] * c[0], box[1] + way[1] * c[1],
        box[2] + way[0] * s[0], box[3] + way[1] * s[1],
    ])
""",
    ),
    (
        "10-predict",
        "crests are sought at 0, pi/2, pi, -pi/2 alone, so they are missed where the angles lie on another turn",
        """
def predict(box, heading, way, direction):
    a0, a1 = heading[0] + direction[0], heading[1] + direction[1]
    angles = [a0, a1] + [a for a in (-np.pi / 2, 0, np.pi / 2, np.pi) if a0 <= a <= a1]
    dx = [d * np.cos(a) for d in way for a in angles]
    dy = [d * np.sin(a) for d in way for a in angles]
    return np.array([box[0] + min(dx), box[1] + max(dx), box[2] + min(dy), box[3] + max(dy)])
""",
    ),
    (
        "10-predict",
        "a hundred directions and ten distances are tried: the box is a little too small between the samples",
        """
def predict(box, heading, way, direction):
    t = np.linspace(heading[0] + direction[0], heading[1] + direction[1], 100)
    d = np.linspace(way[0], way[1], 10)[:, None]
    X, Y = d * np.cos(t), d * np.sin(t)
    return np.array([box[0] + X.min(), box[1] + X.max(), box[2] + Y.min(), box[3] + Y.max()])
""",
    ),
    (
        "10-predict",
        "the width of the directions is taken modulo 2 pi, so more than a whole turn becomes a small piece",
        """
def predict(box, heading, way, direction):
    low = (heading[0] + direction[0]) % (2 * np.pi)
    width = (heading[1] + direction[1] - heading[0] - direction[0]) % (2 * np.pi)
    quarter = np.arange(0, 9) * np.pi / 2
    angles = np.concatenate([[low, low + width], quarter[(quarter >= low) & (quarter <= low + width)]])
    dx, dy = np.outer(way, np.cos(angles)), np.outer(way, np.sin(angles))
    return np.array([box[0] + dx.min(), box[1] + dx.max(), box[2] + dy.min(), box[3] + dy.max()])
""",
    ),
    (
        "10-predict",
        "both ends are wrapped first; where right > left afterwards the interval is sorted and becomes its complement",
        """
def predict(box, heading, way, direction):
    low, high = sorted([float(wrap(heading[0] + direction[0])), float(wrap(heading[1] + direction[1]))])
    cand = [low, high]
    for a in (-np.pi / 2, 0.0, np.pi / 2):
        if low < a < high:
            cand.append(a)
    dx = np.array([[d * np.cos(a) for a in cand] for d in way])
    dy = np.array([[d * np.sin(a) for a in cand] for d in way])
    return box + np.array([dx.min(), dx.max(), dy.min(), dy.max()])
""",
    ),
    (
        "10-edges",
        "near edge at r - d_r, without the cosine of d_abs: cuts off the corners of the ring",
        """
def edges(z, bounds, heading, box):
    direction = (heading[0] + heading[1]) / 2 + z[1]
    d_abs = bounds[1] + (heading[1] - heading[0]) / 2
    n = np.array([np.cos(direction), np.sin(direction)])
    l, r = direction + d_abs, direction - d_abs
    rows = np.array([
        [*n, z[0] + bounds[0]],
        [*-n, -(z[0] - bounds[0])],
        [-np.sin(l), np.cos(l), 0],
        [np.sin(r), -np.cos(r), 0],
    ])
    rows[:, 2] += np.maximum(rows[:, 0] * box[0], rows[:, 0] * box[1])
    rows[:, 2] += np.maximum(rows[:, 1] * box[2], rows[:, 1] * box[3])
    return rows
""",
    ),
    (
        "10-edges",
        "edges are pushed out from the middle of the box, not from the corner that decides",
        """
def edges(z, bounds, heading, box):
    x, y = (box[0] + box[1]) / 2, (box[2] + box[3]) / 2
    direction = np.mean(heading) + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    out = []
    for angle, c in (
        (direction, z[0] + bounds[0]),
        (direction + np.pi, -(z[0] - bounds[0]) * np.cos(d)),
        (direction + d + np.pi / 2, 0),
        (direction - d - np.pi / 2, 0),
    ):
        a, b = np.cos(angle), np.sin(angle)
        out.append([a, b, c + a * x + b * y])
    return np.array(out)
""",
    ),
    (
        "10-edges",
        "d_abs takes the whole width of the heading instead of half of it",
        """
def edges(z, bounds, heading, box):
    direction = (heading[0] + heading[1]) / 2 + z[1]
    d_abs = bounds[1] + heading[1] - heading[0]
    left, right = direction + d_abs, direction - d_abs
    rows = np.array([
        [np.cos(direction), np.sin(direction), z[0] + bounds[0]],
        [-np.cos(direction), -np.sin(direction), -(z[0] - bounds[0]) * np.cos(d_abs)],
        [-np.sin(left), np.cos(left), 0],
        [np.sin(right), -np.cos(right), 0],
    ])
    for row in rows:
        row[2] += max(row[0] * x + row[1] * y for x in box[:2] for y in box[2:])
    return rows
""",
    ),
    (
        "10-edges",
        "the far edge, too, is multiplied by the cosine of d_abs: it cuts off the middle of the arc",
        """
def edges(z, bounds, heading, box):
    mid = np.mean(heading) + z[1]
    d_abs = bounds[1] + np.diff(heading)[0] / 2
    e = np.array([np.cos(mid), np.sin(mid)])
    lft = np.array([-np.sin(mid + d_abs), np.cos(mid + d_abs)])
    rgt = np.array([np.sin(mid - d_abs), -np.cos(mid - d_abs)])
    corners = np.array([[x, y] for x in box[:2] for y in box[2:]])

    def pushed(n, c):
        return [n[0], n[1], c + np.max(corners @ n)]

    k = np.cos(d_abs)
    return np.array([
        pushed(e, (z[0] + bounds[0]) * k),
        pushed(-e, -(z[0] - bounds[0]) * k),
        pushed(lft, 0.0),
        pushed(rgt, 0.0),
    ])
""",
    ),
    (
        "10-edges",
        "edges are pushed by the smallest instead of the largest n'p over the box: the wrong corner decides",
        """
def edges(z, bounds, heading, box):
    direction = (heading[0] + heading[1]) / 2 + z[1]
    d_abs = bounds[1] + (heading[1] - heading[0]) / 2
    left, right = direction + d_abs, direction - d_abs
    rows = np.array([
        [np.cos(direction), np.sin(direction), z[0] + bounds[0]],
        [-np.cos(direction), -np.sin(direction), -(z[0] - bounds[0]) * np.cos(d_abs)],
        [-np.sin(left), np.cos(left), 0],
        [np.sin(right), -np.cos(right), 0],
    ])
    for row in rows:
        a, b, _ = row
        row[2] += min(a * box[0], a * box[1]) + min(b * box[2], b * box[3])
    return rows
""",
    ),
    (
        "10-edges",
        "left and right edges are built with the normals pointing inwards",
        """
def edges(z, bounds, heading, box):
    direction = (heading[0] + heading[1]) / 2 + z[1]
    d_abs = bounds[1] + (heading[1] - heading[0]) / 2
    left, right = direction + d_abs, direction - d_abs
    normals = np.array([
        [np.cos(direction), np.sin(direction)],
        [-np.cos(direction), -np.sin(direction)],
        [np.sin(left), -np.cos(left)],
        [-np.sin(right), np.cos(right)],
    ])
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d_abs), 0, 0])
    corners = np.array([[x, y] for x in box[:2] for y in box[2:]])
    return np.column_stack([normals, c + (normals @ corners.T).max(axis=1)])
""",
    ),
    (
        "10-heading",
        "signs of the bound the wrong way round: the interval shrinks by it instead of widening",
        """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return heading
    seen = [np.arctan2(v - y, u - x) for x in robot[:2] for y in robot[2:] for u in box[:2] for v in box[2:]]
    off = [wrap(a - seen[0]) for a in seen]
    right = seen[0] + min(off) - (bearing - bound)
    left = seen[0] + max(off) - (bearing + bound)
    here, there = (heading[0] + heading[1]) / 2, (right + left) / 2
    turns = here + wrap(there - here) - there
    return np.array([max(heading[0], right + turns), min(heading[1], left + turns)])
""",
    ),
    (
        "10-heading",
        "smallest and largest arctan2 as they come: wrong where the bearings lie on both sides of pi",
        """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return heading.copy()
    A = np.array([[np.arctan2(v - y, u - x) for u in box[:2] for v in box[2:]] for x in robot[:2] for y in robot[2:]])
    lo, hi = A.min() - bearing - bound, A.max() - bearing + bound
    mid = (heading[0] + heading[1]) / 2
    k = np.round((mid - (lo + hi) / 2) / (2 * np.pi)) * 2 * np.pi
    return np.array([max(heading[0], lo + k), min(heading[1], hi + k)])
""",
    ),
    (
        "10-heading",
        "the new interval is never brought onto the same turn as the heading",
        """
def sharpen(heading, robot, box, bearing, bound):
    apart = robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]
    if not apart:
        return heading
    seen = np.array([np.arctan2(v - y, u - x)
                     for x in robot[:2] for y in robot[2:] for u in box[:2] for v in box[2:]])
    off = wrap(seen - seen[0])
    low = seen[0] + off.min() - bearing - bound
    high = seen[0] + off.max() - bearing + bound
    return np.array([max(heading[0], low), min(heading[1], high)])
""",
    ),
    (
        "10-heading",
        "boxes that overlap are treated like others: the corners' bearings are used there, too",
        """
def sharpen(heading, robot, box, bearing, bound):
    seen = [np.arctan2(v - y, u - x) for x in robot[:2] for y in robot[2:] for u in box[:2] for v in box[2:]]
    centre = np.arctan2(box[2] + box[3] - robot[2] - robot[3], box[0] + box[1] - robot[0] - robot[1])
    off = [wrap(angle - centre) for angle in seen]
    right, left = centre + min(off) - bearing - bound, centre + max(off) - bearing + bound
    here, there = (heading[0] + heading[1]) / 2, (right + left) / 2
    turns = here + wrap(there - here) - there
    return np.array([max(heading[0], right + turns), min(heading[1], left + turns)])
""",
    ),
    (
        "10-heading",
        "only the object's corners seen from the middle of the robot's box: interval too narrow",
        """
def sharpen(heading, robot, box, bearing, bound):
    if robot[0] <= box[1] and box[0] <= robot[1] and robot[2] <= box[3] and box[2] <= robot[3]:
        return heading
    x, y = (robot[0] + robot[1]) / 2, (robot[2] + robot[3]) / 2
    corners = np.array([[u, v] for u in box[:2] for v in box[2:]])
    angles = np.arctan2(corners[:, 1] - y, corners[:, 0] - x)
    first = angles[0]
    rel = wrap(angles - first)
    mid = np.mean(heading)
    right = first + rel.min() - bearing - bound
    left = first + rel.max() - bearing + bound
    shift = 2 * np.pi * np.round((mid - (right + left) / 2) / (2 * np.pi))
    return np.array([max(heading[0], right + shift), min(heading[1], left + shift)])
""",
    ),
    (
        "10-heading",
        "the bearing is added to the bearings in the world instead of subtracted",
        """
def sharpen(heading, robot, box, bearing, bound):
    overlap = box[0] <= robot[1] and robot[0] <= box[1] and box[2] <= robot[3] and robot[2] <= box[3]
    if overlap:
        return heading
    seen = [np.arctan2(v - y, u - x) for x in robot[:2] for y in robot[2:] for u in box[:2] for v in box[2:]]
    off = [wrap(a - seen[0]) for a in seen]
    right, left = seen[0] + min(off) + bearing - bound, seen[0] + max(off) + bearing + bound
    here, there = (heading[0] + heading[1]) / 2, (right + left) / 2
    turns = here + wrap(there - here) - there
    return np.array([max(heading[0], right + turns), min(heading[1], left + turns)])
""",
    ),
    (
        "10-heading",
        "boxes count as overlapping where they overlap in x or in y alone: nothing is learnt there",
        """
def sharpen(heading, robot, box, bearing, bound):
    apart = (robot[1] < box[0] or box[1] < robot[0]) and (robot[3] < box[2] or box[3] < robot[2])
    if not apart:
        return heading
    seen = [np.arctan2(v - y, u - x) for x in robot[:2] for y in robot[2:] for u in box[:2] for v in box[2:]]
    off = [wrap(angle - seen[0]) for angle in seen]
    right, left = seen[0] + min(off) - bearing - bound, seen[0] + max(off) - bearing + bound
    here, there = (heading[0] + heading[1]) / 2, (right + left) / 2
    turns = here + wrap(there - here) - there
    return np.array([max(heading[0], right + turns), min(heading[1], left + turns)])
""",
    ),
    (
        "10-ring",
        "r - bound is not cut off at 0: where r < bound its square forbids places near the robot",
        """
def ring(robot, box, r, bound):
    def span(k):
        low, high = box[k] - robot[k + 1], box[k + 1] - robot[k]
        return max(0, low, -high), max(-low, high)

    out = []
    for k in (0, 2):
        least, most = span(2 - k)
        if least > r + bound:
            return None
        outer = np.sqrt((r + bound) ** 2 - least**2)
        inner = np.sqrt(max((r - bound) ** 2 - most**2, 0))
        pieces = []
        for lo, hi in ((robot[k] - outer, robot[k + 1] - inner), (robot[k] + inner, robot[k + 1] + outer)):
            lo, hi = max(lo, box[k]), min(hi, box[k + 1])
            if lo <= hi:
                pieces.append((lo, hi))
        if not pieces:
            return None
        out += [pieces[0][0], pieces[-1][1]]
    return np.array(out)
""",
    ),
    (
        "10-ring",
        "only the outer circle is used: the hole of the ring never cuts anything off",
        """
def ring(robot, box, r, bound):
    far = r + bound
    kept = []
    for k, o in ((0, 2), (2, 0)):
        least = max(0, box[o] - robot[o + 1], robot[o] - box[o + 1])
        if least > far:
            return None
        w = np.sqrt(far**2 - least**2)
        lo, hi = max(box[k], robot[k] - w), min(box[k + 1], robot[k + 1] + w)
        if lo > hi:
            return None
        kept += [lo, hi]
    return np.array(kept)
""",
    ),
    (
        "10-ring",
        "the inner bound takes the least |dy| instead of the largest: it cuts off places that are possible",
        """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound

    def left_along(k, across):
        low, high = box[across] - robot[across + 1], box[across + 1] - robot[across]
        least = max(0, low, -high)
        if least > far:
            return None
        outer, inner = np.sqrt(far**2 - least**2), np.sqrt(max(near**2 - least**2, 0))
        sides = (robot[k] - outer, robot[k + 1] - inner), (robot[k] + inner, robot[k + 1] + outer)
        pieces = [(max(lo, box[k]), min(hi, box[k + 1])) for lo, hi in sides]
        kept = [(lo, hi) for lo, hi in pieces if lo <= hi]
        return (kept[0][0], kept[-1][1]) if kept else None

    x, y = left_along(0, 2), left_along(2, 0)
    return None if x is None or y is None else np.array([*x, *y])
""",
    ),
    (
        "10-ring",
        "the robot is taken to stand in the middle of its box",
        """
def ring(robot, box, r, bound):
    cx, cy = (robot[0] + robot[1]) / 2, (robot[2] + robot[3]) / 2
    a, b = max(0.0, r - bound), r + bound
    sides = []
    for (lo, hi), (olo, ohi), c in (
        ((box[0] - cx, box[1] - cx), (box[2] - cy, box[3] - cy), cx),
        ((box[2] - cy, box[3] - cy), (box[0] - cx, box[1] - cx), cy),
    ):
        m = 0.0 if olo <= 0 <= ohi else min(abs(olo), abs(ohi))
        M = max(abs(olo), abs(ohi))
        if m > b:
            return None
        big, small = np.sqrt(b * b - m * m), np.sqrt(max(0.0, a * a - M * M))
        pts = []
        for p, q in ((-big, -small), (small, big)):
            p, q = max(p, lo), min(q, hi)
            if p <= q:
                pts += [p, q]
        if not pts:
            return None
        sides += [min(pts) + c, max(pts) + c]
    return np.array(sides)
""",
    ),
    (
        "10-ring",
        "a grid of places is tried, each with its least and largest distance from the robot's box: too small by up to a cell",
        """
def ring(robot, box, r, bound):
    xs, ys = np.linspace(box[0], box[1], 60), np.linspace(box[2], box[3], 60)
    X, Y = np.meshgrid(xs, ys)
    dx = np.maximum(0, np.maximum(robot[0] - X, X - robot[1]))
    dy = np.maximum(0, np.maximum(robot[2] - Y, Y - robot[3]))
    least = np.hypot(dx, dy)
    most = np.hypot(np.maximum(abs(X - robot[0]), abs(X - robot[1])),
                    np.maximum(abs(Y - robot[2]), abs(Y - robot[3])))
    ok = (least <= r + bound) & (most >= r - bound)
    if not ok.any():
        return None
    return np.array([X[ok].min(), X[ok].max(), Y[ok].min(), Y[ok].max()])
""",
    ),
    (
        "10-ring",
        "the object is taken to be on the positive side: of the two pieces only dx > 0 and dy > 0 are kept",
        """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound
    res = []
    for k in (0, 2):
        o = 2 - k
        lo, hi = box[o] - robot[o + 1], box[o + 1] - robot[o]
        least, most = max(0, lo, -hi), max(-lo, hi)
        if least > far:
            return None
        low = max(box[k], robot[k] + np.sqrt(max(0, near**2 - most**2)))
        high = min(box[k + 1], robot[k + 1] + np.sqrt(far**2 - least**2))
        if low > high:
            return None
        res += [low, high]
    return np.array(res)
""",
    ),
    (
        "10-narrow",
        "one round of look and nothing more: sound, but far too wide",
        """
def narrow(robot, heading, objects, z, bounds):
    result = look(robot, heading, objects, z, bounds)
    return (robot, heading) if result is None else result
""",
    ),
    (
        "10-narrow",
        "rounds of look until nothing shrinks: sound, but the heading is never split, so still about three times too wide",
        """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(30):
        new = look(robot, heading, objects, z, bounds)
        if new is None:
            break
        change = np.abs(np.concatenate(new) - np.concatenate([robot, heading])).max()
        robot, heading = new
        if change < 1e-9:
            break
    return robot, heading
""",
    ),
    (
        "10-narrow",
        "box round random poses that agree with all sightings: not guaranteed, poses farthest out lie outside",
        """
def narrow(robot, heading, objects, z, bounds):
    rng = np.random.default_rng(0)
    lo = np.array([robot[0], robot[2], heading[0]])
    hi = np.array([robot[1], robot[3], heading[1]])
    for _ in range(6):
        s = rng.uniform(lo, hi, (8000, 3))
        ok = np.ones(len(s), dtype=bool)
        for (ox, oy), (r, b) in zip(objects, z):
            dx, dy = ox - s[:, 0], oy - s[:, 1]
            ok &= abs(np.hypot(dx, dy) - r) <= bounds[0]
            ok &= abs(wrap(np.arctan2(dy, dx) - s[:, 2] - b)) <= bounds[1]
        if ok.sum() < 5:
            break
        lo, hi = s[ok].min(axis=0), s[ok].max(axis=0)
    return np.array([lo[0], hi[0], lo[1], hi[1]]), np.array([lo[2], hi[2]])
""",
    ),
    (
        "10-narrow",
        "the heading is split into eight, but each piece is judged by its middle as if it were known exactly: possible poses are cut off",
        """
def narrow(robot, heading, objects, z, bounds):
    ends = np.linspace(heading[0], heading[1], 9)
    boxes, kept = [], []
    for lo, hi in zip(ends[:-1], ends[1:]):
        mid = (lo + hi) / 2
        box = robot
        for thing, sight in zip(objects, z):
            lines = edges(sight, bounds, np.array([mid, mid]) + np.pi, np.repeat(thing, 2))
            box = cut(box, lines)
            if box is None:
                break
        if box is not None:
            boxes.append(box)
            kept.append((lo, hi))
    if not boxes:
        return robot, heading
    B = np.array(boxes)
    return (np.array([B[:, 0].min(), B[:, 1].max(), B[:, 2].min(), B[:, 3].max()]),
            np.array([kept[0][0], kept[-1][1]]))
""",
    ),
    (
        "10-narrow",
        "the edges are drawn from the object with the heading as it is, not turned by pi: the wrong side of the object is kept",
        """
def narrow(robot, heading, objects, z, bounds):
    best, spans = [], []
    ends = np.linspace(heading[0], heading[1], 33)
    for k in range(32):
        piece = ends[k : k + 2]
        b = robot
        for thing, sight in zip(objects, z):
            if b is not None:
                b = cut(b, edges(sight, bounds, piece, np.repeat(thing, 2)))
        if b is not None:
            best.append(b)
            spans.append(piece)
    if not best:
        return robot, heading
    best = np.array(best)
    box = np.array([best[:, 0].min(), best[:, 1].max(), best[:, 2].min(), best[:, 3].max()])
    return box, np.array([spans[0][0], spans[-1][1]])
""",
    ),
    (
        "10-narrow",
        "headings are split soundly, but it fails where there is no object at all (nothing to concatenate)",
        """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(2):
        ends = np.linspace(heading[0], heading[1], 31)
        boxes, parts = [], []
        for lo, hi in zip(ends[:-1], ends[1:]):
            turned = np.array([lo, hi]) + np.pi
            lines = np.concatenate([edges(s, bounds, turned, np.repeat(o, 2)) for o, s in zip(objects, z)])
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
""",
    ),
]
