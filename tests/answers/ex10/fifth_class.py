"""A fifth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "10-heading",
        "bearing by bearing, each on the turn of the heading's middle",
        """
def sharpen(heading, robot, box, bearing, bound):
    if min(robot[1], box[1]) >= max(robot[0], box[0]) and min(robot[3], box[3]) >= max(robot[2], box[2]):
        return np.array(heading)
    c = np.array([box[0] + box[1] - robot[0] - robot[1], box[2] + box[3] - robot[2] - robot[3]])
    c0 = np.arctan2(c[1], c[0])
    b = [wrap(np.arctan2(y - v, x - u) - c0) for x in box[:2] for y in box[2:] for u in robot[:2] for v in robot[2:]]
    lo, hi = c0 + min(b) - bearing - bound, c0 + max(b) - bearing + bound
    for k in range(-4, 5):
        l, h_ = max(heading[0], lo + 2 * np.pi * k), min(heading[1], hi + 2 * np.pi * k)
        if l <= h_ + 1e-12:
            return np.array([l, max(l, h_)])
    return np.array(heading)
""",
    ),
]

WRONG = [
    (
        "10-predict",
        "the box grows by the longest way to all sides",
        """
def predict(box, heading, way, direction):
    w = max(abs(way[0]), abs(way[1]))
    return np.array([box[0] - w, box[1] + w, box[2] - w, box[3] + w])
""",
    ),
    (
        "10-edges",
        "rows c, a, b",
        """
def edges(z, bounds, heading, box):
    t = np.mean(heading) + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    n = [(np.cos(t), np.sin(t)), (-np.cos(t), -np.sin(t)), (-np.sin(t + d), np.cos(t + d)), (np.sin(t - d), -np.cos(t - d))]
    c = [z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0]
    push = lambda v: max(v[0] * box[0], v[0] * box[1]) + max(v[1] * box[2], v[1] * box[3])
    return np.array([[k + push(v), *v] for v, k in zip(n, c)])
""",
    ),
    (
        "10-predict",
        "k from floor without + 1: one multiple too many at the low side",
        """
def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    candidates = [low, high]
    k = int(np.floor(low / (np.pi / 2)))
    while k * np.pi / 2 <= high:
        candidates.append(k * np.pi / 2)
        k += 1
    xs = [d * np.cos(t) for d in way for t in candidates]
    ys = [d * np.sin(t) for d in way for t in candidates]
    return np.array([box[0] + min(xs), box[1] + max(xs), box[2] + min(ys), box[3] + max(ys)])
""",
    ),
    (
        "10-predict",
        "range to floor(high) without + 1",
        """
def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    q = np.pi / 2
    inside = [k * q for k in range(int(np.ceil(low / q)), int(np.floor(high / q)))]
    course = np.array([low, high] + inside)
    x, y = np.outer(way, np.cos(course)), np.outer(way, np.sin(course))
    return np.array([box[0] + x.min(), box[1] + x.max(), box[2] + y.min(), box[3] + y.max()])
""",
    ),
]
