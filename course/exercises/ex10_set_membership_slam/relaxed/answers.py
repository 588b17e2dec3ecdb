# %% way: strips between the sides
def relaxed(boxes, q):
    least, boxes = len(boxes) - q, np.asarray(boxes)
    points, possible = [], set()
    for x in {float(side) for side in boxes[:, :2].ravel()}:
        here = [k for k, b in enumerate(boxes) if b[0] <= x <= b[1]]
        for y in (side for k in here for side in boxes[k, 2:]):
            met = [k for k in here if boxes[k, 2] <= y <= boxes[k, 3]]
            if len(met) >= least:
                points.append((x, y))
                possible.update(met)
    if not points:
        return None
    (left, down), (right, up) = np.min(points, axis=0), np.max(points, axis=0)
    return [left, right, down, up], [k not in possible for k in range(len(boxes))]

# %% way: a grid of all sides
def relaxed(boxes, q):
    x, y = np.unique(boxes[:, :2]), np.unique(boxes[:, 2:])
    in_x = (boxes[:, :1] <= x) & (x <= boxes[:, 1:2])
    in_y = (boxes[:, 2:3] <= y) & (y <= boxes[:, 3:])
    count = in_x.T.astype(int) @ in_y.astype(int)
    kept = count >= len(boxes) - q
    if not kept.any():
        return None
    x_kept, y_kept = x[kept.any(axis=1)], y[kept.any(axis=0)]
    met = ((in_x.astype(int) @ kept) * in_y).sum(axis=1)
    return np.array([x_kept[0], x_kept[-1], y_kept[0], y_kept[-1]]), met == 0

# %% right: each box is tested by the others inside it
def deepest(boxes, within):
    """(points in as many of the boxes as asked) inside one box"""
    a = [(max(b[0], within[0]), min(b[1], within[1]), max(b[2], within[2]), min(b[3], within[3]), b) for b in boxes]
    a = [b for b in a if b[0] <= b[1] and b[2] <= b[3]]
    best = 0
    for x in [b[0] for b in a]:
        col = [b for b in a if b[0] <= x <= b[1]]
        for y in [b[2] for b in col]:
            best = max(best, sum(b[2] <= y <= b[3] for b in col))
    return best


def relaxed(boxes, q):
    n = len(boxes)
    sure = np.array([deepest(boxes, b) < n - q for b in boxes])
    if sure.all():
        return None
    ends = []
    for k in (0, 2):
        other = 2 - k
        good = []
        for s in np.concatenate([boxes[:, k], boxes[:, k + 1]]):
            line = boxes[(boxes[:, k] <= s) & (s <= boxes[:, k + 1])]
            most = max((np.sum((line[:, other] <= t) & (t <= line[:, other + 1])) for t in line[:, other]), default=0)
            if most >= n - q:
                good.append(s)
        ends += [min(good), max(good)]
    return np.array(ends), sure

# %% right: sweep along x with sorted events
def relaxed(boxes, q):
    n = len(boxes)
    events = sorted([(b[0], 0, k) for k, b in enumerate(boxes)] + [(b[1], 1, k) for k, b in enumerate(boxes)])
    active, xs, ys, alive = set(), [], [], set()
    for x, kind, k in events:
        if kind == 0:
            active.add(k)
        inside = sorted([(boxes[j][2], 0, j) for j in active] + [(boxes[j][3], 1, j) for j in active])
        held = set()
        for y, end, j in inside:
            if end == 0:
                held.add(j)
            if len(held) >= n - q:
                xs.append(x)
                ys.append(y)
                alive |= held
            if end == 1:
                held.discard(j)
        if kind == 1:
            active.discard(k)
    if not xs:
        return None
    return (min(xs), max(xs), min(ys), max(ys)), [k not in alive for k in range(n)]

# %% wrong: all subsets are tried, which takes too long for thirty boxes
def relaxed(boxes, q):
    from itertools import combinations
    n, pieces = len(boxes), []
    for chosen in combinations(boxes, n - q):
        b = np.array(chosen)
        piece = [b[:, 0].max(), b[:, 1].min(), b[:, 2].max(), b[:, 3].min()]
        if piece[0] <= piece[1] and piece[2] <= piece[3]:
            pieces.append(piece)
    if not pieces:
        return None
    p = np.array(pieces)
    meets = [any(a[0] <= b[1] and b[0] <= a[1] and a[2] <= b[3] and b[2] <= a[3] for a in p) for b in boxes]
    return np.array([p[:, 0].min(), p[:, 1].max(), p[:, 2].min(), p[:, 3].max()]), ~np.array(meets)

# %% wrong: x and y each sorted, and the boxes tested by the box that is left
def relaxed(boxes, q):
    n = len(boxes)
    found = []
    for low, high in ((boxes[:, 0], boxes[:, 1]), (boxes[:, 2], boxes[:, 3])):
        ends = [v for v in np.concatenate([low, high]) if np.sum((low <= v) & (v <= high)) >= n - q]
        if not ends:
            return None
        found += [min(ends), max(ends)]
    a, b, c, d = found
    return np.array(found), np.array([x1 < a or x0 > b or y1 < c or y0 > d for x0, x1, y0, y1 in boxes])

# %% wrong: the q boxes farthest from the median are dropped
def relaxed(boxes, q):
    middle = np.column_stack([boxes[:, :2].mean(axis=1), boxes[:, 2:].mean(axis=1)])
    far = np.hypot(*(middle - np.median(middle, axis=0)).T)
    keep = np.argsort(far)[: len(boxes) - q]
    b = boxes[keep]
    box = np.array([b[:, 0].max(), b[:, 1].min(), b[:, 2].max(), b[:, 3].min()])
    if box[0] > box[1] or box[2] > box[3]:
        return None
    return box, ~np.isin(np.arange(len(boxes)), keep)

# %% wrong: cells between the sides, so that single points are lost, and outliers by the result's corners
def relaxed(boxes, q):
    x, y = np.unique(boxes[:, :2]), np.unique(boxes[:, 2:])
    left, right, down, up = [], [], [], []
    for a, b in zip(x[:-1], x[1:]):
        for c, d in zip(y[:-1], y[1:]):
            u, v = (a + b) / 2, (c + d) / 2
            inside = (boxes[:, 0] < u) & (u < boxes[:, 1]) & (boxes[:, 2] < v) & (v < boxes[:, 3])
            if inside.sum() >= len(boxes) - q:
                left.append(a), right.append(b), down.append(c), up.append(d)
    if not left:
        return None
    box = np.array([min(left), max(right), min(down), max(up)])
    corner = [(x, y) for x in box[:2] for y in box[2:]]
    return box, [not any(b[0] <= x <= b[1] and b[2] <= y <= b[3] for x, y in corner) for b in boxes]

# %% wrong: the largest set of boxes that meet
def relaxed(boxes, q):
    best = np.zeros(len(boxes), dtype=bool)
    for x in boxes[:, 0]:
        for y in boxes[:, 2]:
            inside = (boxes[:, 0] <= x) & (x <= boxes[:, 1]) & (boxes[:, 2] <= y) & (y <= boxes[:, 3])
            if inside.sum() > best.sum():
                best = inside
    if best.sum() < len(boxes) - q:
        return None
    b = boxes[best]
    return np.array([b[:, 0].max(), b[:, 1].min(), b[:, 2].max(), b[:, 3].min()]), ~best
