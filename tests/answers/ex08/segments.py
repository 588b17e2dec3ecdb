"""Independent answers to 08-segments: right ones, and students' mistakes."""

RIGHT = [
    (
        "08-segments",
        "sequential RANSAC, pairs of near neighbours, band in sigmas (loops)",
        """
def segment(points, share):
    n = len(points)
    r = np.linalg.norm(points, axis=1)
    u = points / r[:, None]
    rng = np.random.default_rng(1)
    labels, found = np.full(n, -1), []

    def misfit(normal, rho):
        return np.abs(points @ normal - rho) / (share * r * np.abs(u @ normal) + 0.006)

    for wall in range(12):
        left = np.flatnonzero(labels < 0)
        if len(left) < 8:
            break
        i = rng.integers(len(left), size=250)
        j = (i + rng.integers(2, 22, size=250)) % len(left)
        a, b = points[left[i]], points[left[j]]
        d = b - a
        nn = np.stack([-d[:, 1], d[:, 0]], 1) / np.maximum(np.hypot(d[:, 0], d[:, 1]), 1e-9)[:, None]
        rho = np.sum(nn * a, axis=1)
        P = points[left]
        dist = np.abs(nn @ P.T - rho[:, None])
        tol = share * r[left] * np.abs(nn @ u[left].T) + 0.006
        votes = (dist < 2.5 * tol).sum(axis=1)
        k = votes.argmax()
        if votes[k] < 8:
            break
        mine = left[dist[k] < 2.5 * tol[k]]
        for _ in range(3):
            w = 1 / r[mine] ** 2
            c = w @ points[mine] / w.sum()
            q = (points[mine] - c) * np.sqrt(w)[:, None]
            normal = np.linalg.eigh(q.T @ q)[1][:, 0]
            rho1 = normal @ c
            good = misfit(normal, rho1)[left] < 3
            if good.sum() < 5:
                break
            mine = left[good]
        labels[mine] = wall
        found.append((normal, rho1))
    if not found:
        return labels
    off = np.array([misfit(*line) for line in found])
    labels = np.where(off.min(axis=0) < 3, off.argmin(axis=0), -1)
    for k in range(len(found)):
        if np.sum(labels == k) < 7:
            labels[labels == k] = -1
    return labels
""",
    ),
    (
        "08-segments",
        "Hough in (alpha, rho), refit, nearest line last",
        """
def segment(points, share):
    n = len(points)
    r = np.hypot(points[:, 0], points[:, 1])
    u = points / r[:, None]
    angles = np.radians(np.arange(0, 180, 2.0))
    normals = np.column_stack([np.cos(angles), np.sin(angles)])
    proj = normals @ points.T
    width = 0.06
    free = np.ones(n, dtype=bool)
    low = proj.min()
    bins = np.floor((proj - low) / width).astype(int)
    size = bins.max() + 2
    flat = bins + size * np.arange(len(angles))[:, None]
    lines = []
    for _ in range(14):
        count = np.bincount(flat[:, free].ravel(), minlength=size * len(angles)).reshape(-1, size)
        both = count[:, :-1] + count[:, 1:]
        a, b = divmod(int(both.argmax()), size - 1)
        if both[a, b] < 8:
            break
        mine = free & ((bins[a] == b) | (bins[a] == b + 1))
        started = mine.copy()
        for _ in range(5):
            if mine.sum() < 5:
                break
            w = 1 / r[mine] ** 2
            c = w @ points[mine] / w.sum()
            d = (points[mine] - c) * np.sqrt(w)[:, None]
            normal = np.linalg.eigh(d.T @ d)[1][:, 0]
            rho = normal @ c
            off = np.abs(points @ normal - rho) / (share * r * np.abs(u @ normal) + 0.005)
            mine = free & (off < 3)
        if mine.sum() < 7:
            free = free & ~started if mine.sum() == 0 else free & ~mine
            continue
        lines.append((normal, rho))
        free = free & ~mine
    if not lines:
        return np.full(n, -1)
    D = np.array([np.abs(points @ m - q) / (share * r * np.abs(u @ m) + 0.005) for m, q in lines])
    labels = np.where(D.min(axis=0) < 3, D.argmin(axis=0), -1)
    for k, size in enumerate(np.bincount(labels[labels >= 0], minlength=len(lines))):
        if size < 7:
            labels[labels == k] = -1
    return labels
""",
    ),
]

WRONG = [
    (
        "08-segments",
        "one wall for all",
        """
def segment(points, share):
    return np.zeros(len(points), dtype=int)
""",
    ),
    (
        "08-segments",
        "all clutter",
        """
def segment(points, share):
    return np.full(len(points), -1)
""",
    ),
    (
        "08-segments",
        "each reading its own wall",
        """
def segment(points, share):
    return np.arange(len(points))
""",
    ),
    (
        "08-segments",
        "eight sectors of the bearing",
        """
def segment(points, share):
    bearing = np.arctan2(points[:, 1], points[:, 0]) + np.pi
    return (bearing / (2 * np.pi / 8)).astype(int) % 8
""",
    ),
    (
        "08-segments",
        "cut where the range jumps, each piece a wall",
        """
def segment(points, share):
    r = np.hypot(points[:, 0], points[:, 1])
    labels, k = np.zeros(len(points), dtype=int), 0
    for i in range(1, len(points)):
        if abs(r[i] - r[i - 1]) > 5 * share * r[i]:
            k += 1
        labels[i] = k
    sizes = np.bincount(labels)
    return np.where(sizes[labels] >= 5, labels, -1)
""",
    ),
    (
        "08-segments",
        "windows of 25 neighbours that must all fit, as in the thesis",
        """
def segment(points, share):
    n = len(points)
    labels = np.full(n, -1)
    wall = 0
    for start in range(0, n, 12):
        rows = (start + np.arange(25)) % n
        c = points[rows].mean(axis=0)
        q = points[rows] - c
        normal = np.linalg.eigh(q.T @ q)[1][:, 0]
        sigma = share * np.hypot(*points[rows].T)
        if np.all(np.abs(q @ normal) < 3 * sigma):
            off = np.abs((points - c) @ normal)
            mine = (off < 3 * share * np.hypot(*points.T)) & (labels < 0)
            labels[mine] = wall
            wall += 1
    return labels
""",
    ),
    (
        "08-segments",
        "split and merge without a thought of clutter",
        """
def segment(points, share):
    labels = np.full(len(points), -1)
    count = [0]

    def split(rows):
        if len(rows) < 8:
            return
        a, b = points[rows[0]], points[rows[-1]]
        d = b - a
        length = max(np.hypot(*d), 1e-9)
        off = np.abs(d[0] * (points[rows, 1] - a[1]) - d[1] * (points[rows, 0] - a[0])) / length
        k = int(off.argmax())
        if off[k] > 4 * share * np.hypot(*points[rows[k]]) and 0 < k < len(rows) - 1:
            split(rows[: k + 1])
            split(rows[k:])
        else:
            labels[rows] = count[0]
            count[0] += 1

    half = len(points) // 2
    split(np.arange(half))
    split(np.arange(half, len(points)))
    return labels
""",
    ),
    (
        "08-segments",
        "RANSAC for one wall only",
        """
def segment(points, share):
    rng = np.random.default_rng(0)
    best = np.zeros(len(points), dtype=bool)
    for _ in range(200):
        a, b = points[rng.choice(len(points), 2, replace=False)]
        d = b - a
        normal = np.array([-d[1], d[0]]) / np.hypot(*d)
        inside = np.abs((points - a) @ normal) < 3 * share * np.hypot(*points.T)
        if inside.sum() > best.sum():
            best = inside
    return np.where(best, 0, -1)
""",
    ),
    (
        "08-segments",
        "stops after two walls",
        """
def segment(points, share):
    far = np.hypot(*points.T)
    labels = np.full(len(points), -1)
    rng = np.random.default_rng(0)
    for wall in range(1, 3):
        left = np.flatnonzero(labels < 0)
        best = np.zeros(len(left), dtype=bool)
        for _ in range(100):
            i = rng.integers(len(left))
            j = (i + rng.integers(3, 15)) % len(left)
            d = points[left[j]] - points[left[i]]
            normal = np.array([-d[1], d[0]]) / max(np.hypot(*d), 1e-9)
            inside = np.abs((points[left] - points[left[i]]) @ normal) < 2 * share * far[left]
            if inside.sum() > best.sum():
                best = inside
        labels[left[best]] = wall
    return labels
""",
    ),
    (
        "08-segments",
        "a list of arrays of numbers, one a wall",
        """
def segment(points, share):
    far = np.hypot(*points.T)
    left, walls = np.arange(len(points)), []
    rng = np.random.default_rng(0)
    while len(left) > 20 and len(walls) < 10:
        best = None
        for _ in range(60):
            i = rng.integers(len(left))
            j = (i + rng.integers(3, 15)) % len(left)
            d = points[left[j]] - points[left[i]]
            normal = np.array([-d[1], d[0]]) / max(np.hypot(*d), 1e-9)
            inside = np.abs((points[left] - points[left[i]]) @ normal) < 2 * share * far[left]
            if best is None or inside.sum() > best.sum():
                best = inside
        walls.append(left[best])
        left = left[~best]
    return walls
""",
    ),
    (
        "08-segments",
        "the range smoothed by a median in place: points changed",
        """
def segment(points, share):
    far = np.hypot(*points.T)
    smooth = np.array([np.median(far[np.arange(i - 2, i + 3) % len(far)]) for i in range(len(far))])
    points *= (smooth / far)[:, None]
    way = np.roll(points, -2, axis=0) - np.roll(points, 2, axis=0)
    alpha = np.arctan2(way[:, 0], -way[:, 1])
    alpha = np.where(np.cos(alpha) * points[:, 0] + np.sin(alpha) * points[:, 1] < 0, alpha + np.pi, alpha)
    return (np.round(wrap(alpha) / (np.pi / 4)) % 8).astype(int)
""",
    ),
    (
        "08-segments",
        "the label is the rounded direction of the normal from neighbours",
        """
def segment(points, share):
    step = np.roll(points, -1, axis=0) - points
    alpha = wrap(np.arctan2(step[:, 1], step[:, 0]) - np.pi / 2)
    return (np.round(np.degrees(alpha) / 20).astype(int)) % 18
""",
    ),
    (
        "08-segments",
        "room taken for a rectangle: four walls, two directions",
        """
def segment(points, share):
    x, y = points.T
    labels = np.full(len(points), -1)
    for k, (value, side) in enumerate([(x, 1), (y, 1), (x, -1), (y, -1)]):
        edge = np.percentile(side * value, 90)
        labels[np.abs(side * value - edge) < 0.1] = k
    return labels
""",
    ),
    (
        "08-segments",
        "k-means with eight places",
        """
def segment(points, share):
    centres = points[:: max(len(points) // 8, 1)][:8].copy()
    for _ in range(10):
        d = np.linalg.norm(points[:, None] - centres[None], axis=2)
        labels = d.argmin(axis=1)
        for k in range(len(centres)):
            if np.any(labels == k):
                centres[k] = points[labels == k].mean(axis=0)
    return labels
""",
    ),
    (
        "08-segments",
        "five walls at most, of the example's room, with guesses from anywhere",
        """
def segment(points, share):
    room = [(2.0, 0.3), (1.6, 1.87), (3.1, -2.84), (1.2, -1.27), (2.2, 0.95)]
    off = np.array([np.abs(points @ [np.cos(a), np.sin(a)] - r) for r, a in room])
    return np.where(off.min(axis=0) < 0.1, off.argmin(axis=0), -1)
""",
    ),
    (
        "08-segments",
        "band of 30 cm everywhere: swallows the neighbours",
        """
def segment(points, share):
    rng = np.random.default_rng(3)
    labels = np.full(len(points), -1)
    for wall in range(10):
        left = np.flatnonzero(labels < 0)
        if len(left) < 8:
            break
        best = np.zeros(len(left), dtype=bool)
        for _ in range(80):
            a, b = points[rng.choice(left, 2, replace=False)]
            d = b - a
            normal = np.array([-d[1], d[0]]) / max(np.hypot(*d), 1e-9)
            inside = np.abs((points[left] - a) @ normal) < 0.3
            if inside.sum() > best.sum():
                best = inside
        labels[left[best]] = wall
    return labels
""",
    ),
    (
        "08-segments",
        "band of 5 mm everywhere: far narrower than the noise",
        """
def segment(points, share):
    rng = np.random.default_rng(3)
    labels = np.full(len(points), -1)
    for wall in range(10):
        left = np.flatnonzero(labels < 0)
        if len(left) < 8:
            break
        best = np.zeros(len(left), dtype=bool)
        for _ in range(80):
            a, b = points[rng.choice(left, 2, replace=False)]
            d = b - a
            normal = np.array([-d[1], d[0]]) / max(np.hypot(*d), 1e-9)
            inside = np.abs((points[left] - a) @ normal) < 0.005
            if inside.sum() > best.sum():
                best = inside
        labels[left[best]] = wall
    return labels
""",
    ),
    (
        "08-segments",
        "good walls, but NaN for clutter",
        """
def segment(points, share):
    far = np.hypot(*points.T)
    beams = points / far[:, None]
    labels = np.full(len(points), np.nan)
    rng = np.random.default_rng(0)
    for wall in range(12):
        left = np.flatnonzero(np.isnan(labels))
        if len(left) < 8:
            break
        i = rng.integers(len(left), size=150)
        j = (i + rng.integers(3, 20, size=150)) % len(left)
        d = points[left[j]] - points[left[i]]
        normals = np.column_stack([-d[:, 1], d[:, 0]]) / np.maximum(np.hypot(*d.T), 1e-9)[:, None]
        rho = np.sum(normals * points[left[i]], axis=1)
        tol = share * far[left] * np.abs(normals @ beams[left].T) + 0.005
        inside = np.abs(normals @ points[left].T - rho[:, None]) < 2.5 * tol
        k = inside.sum(axis=1).argmax()
        if inside[k].sum() < 8:
            break
        labels[left[inside[k]]] = wall
    return labels
""",
    ),
    (
        "08-segments",
        "clutter left out: an answer shorter than the scan",
        """
def segment(points, share):
    far = np.hypot(*points.T)
    beams = points / far[:, None]
    labels = np.full(len(points), -1)
    rng = np.random.default_rng(0)
    for wall in range(12):
        left = np.flatnonzero(labels < 0)
        if len(left) < 8:
            break
        i = rng.integers(len(left), size=150)
        j = (i + rng.integers(3, 20, size=150)) % len(left)
        d = points[left[j]] - points[left[i]]
        normals = np.column_stack([-d[:, 1], d[:, 0]]) / np.maximum(np.hypot(*d.T), 1e-9)[:, None]
        rho = np.sum(normals * points[left[i]], axis=1)
        tol = share * far[left] * np.abs(normals @ beams[left].T) + 0.005
        inside = np.abs(normals @ points[left].T - rho[:, None]) < 2.5 * tol
        k = inside.sum(axis=1).argmax()
        if inside[k].sum() < 8:
            break
        labels[left[inside[k]]] = wall
    return labels[labels >= 0]
""",
    ),
    (
        "08-segments",
        "all pairs of readings in a Python loop: seconds a scan",
        """
def segment(points, share):
    n = len(points)
    far = np.hypot(*points.T)
    labels = np.full(n, -1)
    for wall in range(8):
        left = np.flatnonzero(labels < 0)
        if len(left) < 8:
            break
        best = np.zeros(len(left), dtype=bool)
        for a in range(len(left)):
            for b in range(a + 3, min(a + 40, len(left))):
                d = points[left[b]] - points[left[a]]
                normal = np.array([-d[1], d[0]]) / max(np.hypot(d[0], d[1]), 1e-9)
                tol = 2.5 * share * np.abs(points[left] @ normal) + 0.012
                inside = np.abs((points[left] - points[left[a]]) @ normal) < tol
                if inside.sum() > best.sum():
                    best = inside
        if best.sum() < 8:
            break
        labels[left[best]] = wall
    return labels
""",
    ),
    (
        "08-segments",
        "numbers for a scan of 180 readings only",
        """
def segment(points, share):
    far = np.hypot(*points.T)
    labels = np.full(180, -1)
    rng = np.random.default_rng(0)
    for wall in range(12):
        left = np.flatnonzero(labels < 0)
        if len(left) < 8:
            break
        i = rng.integers(len(left), size=150)
        j = (i + rng.integers(3, 20, size=150)) % len(left)
        d = points[left[j]] - points[left[i]]
        normals = np.column_stack([-d[:, 1], d[:, 0]]) / np.maximum(np.hypot(*d.T), 1e-9)[:, None]
        rho = np.sum(normals * points[left[i]], axis=1)
        tol = share * np.abs(normals @ points[left].T) + 0.005
        inside = np.abs(normals @ points[left].T - rho[:, None]) < 2.5 * tol
        k = inside.sum(axis=1).argmax()
        if inside[k].sum() < 8:
            break
        labels[left[inside[k]]] = wall
    return labels
""",
    ),
    (
        "08-segments",
        "good walls, each cut anew wherever a reading does not belong",
        """
def segment(points, share):
    far = np.hypot(*points.T)
    labels = np.full(len(points), -1)
    rng = np.random.default_rng(0)
    for wall in range(12):
        left = np.flatnonzero(labels < 0)
        if len(left) < 8:
            break
        i = rng.integers(len(left), size=150)
        j = (i + rng.integers(3, 20, size=150)) % len(left)
        d = points[left[j]] - points[left[i]]
        normals = np.column_stack([-d[:, 1], d[:, 0]]) / np.maximum(np.hypot(*d.T), 1e-9)[:, None]
        rho = np.sum(normals * points[left[i]], axis=1)
        tol = share * np.abs(normals @ points[left].T) + 0.005
        inside = np.abs(normals @ points[left].T - rho[:, None]) < 2.5 * tol
        k = inside.sum(axis=1).argmax()
        if inside[k].sum() < 8:
            break
        labels[left[inside[k]]] = wall
    pieces = np.cumsum(labels != np.roll(labels, 1))
    return np.where(labels >= 0, pieces, -1)
""",
    ),
    (
        "08-segments",
        "the lesson's RANSAC with the thesis' numbers",
        """
def segment(points, share):
    from slamlab.landmarks.ransac import THESIS, lines
    from slamlab.readings import Scan
    from slamlab.sources.simulated_robot import THESIS_LIDAR

    scan = Scan(np.arctan2(points[:, 1], points[:, 0]), np.hypot(points[:, 0], points[:, 1]))
    labels = np.full(len(points), -1)
    for k, line in enumerate(lines(scan, THESIS_LIDAR.model, np.random.default_rng(0), THESIS)):
        labels[line.beams] = k
    return labels
""",
    ),
]
