"""A fourth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "10-predict",
        "corners of distance and of a fine list of critical directions",
        """
def predict(box, heading, way, direction):
    lo, hi = heading[0] + direction[0], heading[1] + direction[1]
    quarter = np.pi / 2
    a = [lo, hi] + [k * quarter for k in range(int(np.ceil(lo / quarter)), int(np.floor(hi / quarter)) + 1)]
    dx = [d * np.cos(t) for d in way for t in a]
    dy = [d * np.sin(t) for d in way for t in a]
    return [box[0] + min(dx), box[1] + max(dx), box[2] + min(dy), box[3] + max(dy)]
""",
    ),
    (
        "10-ring",
        "the largest and smallest |Δx| by the nearest and farthest |Δy|, then signs apart",
        """
def ring(robot, box, r, bound):
    lo, hi = max(r - bound, 0.0), r + bound
    def one(a0, a1, b0, b1, c0, c1, e0, e1):
        # a: robot along, b: object along; c, e: across
        y0, y1 = e0 - c1, e1 - c0
        near = 0.0 if y0 <= 0 <= y1 else min(abs(y0), abs(y1))
        far = max(abs(y0), abs(y1))
        if near > hi:
            return None
        largest = np.sqrt(hi ** 2 - near ** 2)
        smallest = np.sqrt(max(lo ** 2 - far ** 2, 0.0))
        pieces = []
        for p, q in ((-largest, -smallest), (smallest, largest)):
            p, q = max(p, b0 - a1), min(q, b1 - a0)
            if p <= q:
                pieces.append((max(b0, a0 + p), min(b1, a1 + q)))
        if not pieces:
            return None
        return min(p for p, q in pieces), max(q for p, q in pieces)
    x = one(robot[0], robot[1], box[0], box[1], robot[2], robot[3], box[2], box[3])
    y = one(robot[2], robot[3], box[2], box[3], robot[0], robot[1], box[0], box[1])
    return None if x is None or y is None else np.array([*x, *y])
""",
    ),
]

WRONG = [
    (
        "10-predict",
        "only the corners of the intervals",
        """
def predict(box, heading, way, direction):
    a = np.array([heading[0] + direction[0], heading[1] + direction[1]])
    xs = np.outer(way, np.cos(a))
    ys = np.outer(way, np.sin(a))
    return np.array([box[0] + xs.min(), box[1] + xs.max(), box[2] + ys.min(), box[3] + ys.max()])
""",
    ),
    (
        "10-predict",
        "a hundred samples of the direction",
        """
def predict(box, heading, way, direction):
    a = np.linspace(heading[0] + direction[0], heading[1] + direction[1], 100)
    xs = np.outer(way, np.cos(a))
    ys = np.outer(way, np.sin(a))
    return np.array([box[0] + xs.min(), box[1] + xs.max(), box[2] + ys.min(), box[3] + ys.max()])
""",
    ),
    (
        "10-predict",
        "forwards only: the lower end takes the shorter way",
        """
def predict(box, heading, way, direction):
    lo, hi = heading[0] + direction[0], heading[1] + direction[1]
    a = [lo, hi] + [k * np.pi / 2 for k in range(-20, 21) if lo <= k * np.pi / 2 <= hi]
    c, s = np.cos(a), np.sin(a)
    w0, w1 = way
    return np.array([box[0] + w1 * c.min(), box[1] + w1 * c.max(), box[2] + w1 * s.min(), box[3] + w1 * s.max()])
""",
    ),
    (
        "10-edges",
        "pushed out by the centre of the box",
        """
def edges(z, bounds, heading, box):
    t = np.mean(heading) + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    m = np.array([(box[0] + box[1]) / 2, (box[2] + box[3]) / 2])
    n = [np.array([np.cos(t), np.sin(t)]), -np.array([np.cos(t), np.sin(t)]),
         np.array([-np.sin(t + d), np.cos(t + d)]), np.array([np.sin(t - d), -np.cos(t - d)])]
    c = [z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0]
    return np.array([[*v, k + v @ m] for v, k in zip(n, c)])
""",
    ),
    (
        "10-edges",
        "near edge at r − d_r, not at its chord",
        """
def edges(z, bounds, heading, box):
    t = np.mean(heading) + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    n = [np.array([np.cos(t), np.sin(t)]), -np.array([np.cos(t), np.sin(t)]),
         np.array([-np.sin(t + d), np.cos(t + d)]), np.array([np.sin(t - d), -np.cos(t - d)])]
    c = [z[0] + bounds[0], -(z[0] - bounds[0]), 0, 0]
    push = lambda v: max(v[0] * box[0], v[0] * box[1]) + max(v[1] * box[2], v[1] * box[3])
    return np.array([[*v, k + push(v)] for v, k in zip(n, c)])
""",
    ),
    (
        "10-edges",
        "left and right exchanged",
        """
def edges(z, bounds, heading, box):
    t = np.mean(heading) + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    n = [np.array([np.cos(t), np.sin(t)]), -np.array([np.cos(t), np.sin(t)]),
         np.array([np.sin(t - d), -np.cos(t - d)]), np.array([-np.sin(t + d), np.cos(t + d)])]
    c = [z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0]
    push = lambda v: max(v[0] * box[0], v[0] * box[1]) + max(v[1] * box[2], v[1] * box[3])
    return np.array([[*v, k + push(v)] for v, k in zip(n, c)])
""",
    ),
    (
        "10-edges",
        "pushed in: the least corner",
        """
def edges(z, bounds, heading, box):
    t = np.mean(heading) + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    n = [np.array([np.cos(t), np.sin(t)]), -np.array([np.cos(t), np.sin(t)]),
         np.array([-np.sin(t + d), np.cos(t + d)]), np.array([np.sin(t - d), -np.cos(t - d)])]
    c = [z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0]
    push = lambda v: min(v[0] * box[0], v[0] * box[1]) + min(v[1] * box[2], v[1] * box[3])
    return np.array([[*v, k + push(v)] for v, k in zip(n, c)])
""",
    ),
    (
        "10-heading",
        "no wrap anywhere",
        """
def sharpen(heading, robot, box, bearing, bound):
    if robot[0] <= box[1] and box[0] <= robot[1] and robot[2] <= box[3] and box[2] <= robot[3]:
        return heading
    b = [np.arctan2(y - v, x - u) for x in box[:2] for y in box[2:] for u in robot[:2] for v in robot[2:]]
    lo, hi = min(b) - bearing - bound, max(b) - bearing + bound
    return np.array([max(lo, heading[0]), min(hi, heading[1])])
""",
    ),
    (
        "10-heading",
        "replaces the heading by what the sighting says",
        """
def sharpen(heading, robot, box, bearing, bound):
    if robot[0] <= box[1] and box[0] <= robot[1] and robot[2] <= box[3] and box[2] <= robot[3]:
        return heading
    m = np.arctan2(box[2] + box[3] - robot[2] - robot[3], box[0] + box[1] - robot[0] - robot[1])
    b = [wrap(np.arctan2(y - v, x - u) - m) for x in box[:2] for y in box[2:] for u in robot[:2] for v in robot[2:]]
    return np.array([wrap(m + min(b) - bearing - bound), wrap(m + max(b) - bearing + bound)])
""",
    ),
    (
        "10-heading",
        "the bound is forgotten",
        """
def sharpen(heading, robot, box, bearing, bound):
    if robot[0] <= box[1] and box[0] <= robot[1] and robot[2] <= box[3] and box[2] <= robot[3]:
        return heading
    m = np.mean(heading)
    c = np.arctan2(box[2] + box[3] - robot[2] - robot[3], box[0] + box[1] - robot[0] - robot[1])
    b = [wrap(np.arctan2(y - v, x - u) - c) for x in box[:2] for y in box[2:] for u in robot[:2] for v in robot[2:]]
    mid = m + wrap(c - bearing - m)
    lo, hi = max(heading[0], mid + min(b)), min(heading[1], mid + max(b))
    r = wrap(lo)
    return np.array([r, r + hi - lo])
""",
    ),
    (
        "10-ring",
        "only the outer circle",
        """
def ring(robot, box, r, bound):
    o = r + bound
    new = np.array([max(box[0], robot[0] - o), min(box[1], robot[1] + o),
                    max(box[2], robot[2] - o), min(box[3], robot[3] + o)])
    return None if new[0] > new[1] or new[2] > new[3] else new
""",
    ),
    (
        "10-ring",
        "always an array, NaN where nothing is left",
        """
def ring(robot, box, r, bound):
    dx0, dx1 = box[0] - robot[1], box[1] - robot[0]
    dy0, dy1 = box[2] - robot[3], box[3] - robot[2]
    hi = r + bound
    ny = 0 if dy0 <= 0 <= dy1 else min(abs(dy0), abs(dy1))
    nx = 0 if dx0 <= 0 <= dx1 else min(abs(dx0), abs(dx1))
    X, Y = np.sqrt(hi ** 2 - ny ** 2), np.sqrt(hi ** 2 - nx ** 2)
    return np.array([max(box[0], robot[0] - X), min(box[1], robot[1] + X),
                     max(box[2], robot[2] - Y), min(box[3], robot[3] + Y)])
""",
    ),
    (
        "10-narrow",
        "look until nothing changes, heading as it was",
        """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(30):
        robot, _ = look(robot, heading, objects, z, bounds)
    return robot, heading
""",
    ),
]
