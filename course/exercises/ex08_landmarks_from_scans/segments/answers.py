# %% way: guesses at random, refined in rounds
def fitted(points, weight):
    centre = weight @ points / weight.sum()
    x, y = (points - centre).T * np.sqrt(weight)
    alpha = 0.5 * np.arctan2(-2 * x @ y, y @ y - x @ x)
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    return normal, centre @ normal

def chosen(points, share, lines, far, beams):
    if not lines:
        return np.full(len(points), -1)
    off = []
    for normal, rho in lines:
        off.append(np.abs(points @ normal - rho) / (share * far * np.abs(beams @ normal) + 0.005))
    off = np.array(off)
    labels = np.where(off.min(axis=0) < 3, off.argmin(axis=0), -1)
    for k in range(len(lines)):
        if np.sum(labels == k) < 7:
            labels[labels == k] = -1
    return labels

def segment(points, share):
    rng, n = np.random.default_rng(3), len(points)
    far = np.hypot(*points.T)
    beams = points / far[:, None]
    labels, lines = np.full(n, -1), []
    for _ in range(14):
        free = np.flatnonzero(labels < 0)
        if len(free) < 9:
            break
        first = rng.integers(0, len(free), 700)
        second = (first + rng.integers(2, 17, 700)) % len(free)
        way = points[free[second]] - points[free[first]]
        ok = np.hypot(*way.T) > 1e-6
        normals = np.column_stack([-way[ok, 1], way[ok, 0]]) / np.hypot(*way[ok].T)[:, None]
        rho = np.sum(normals * points[free[first[ok]]], axis=1)
        sigma = share * far[free] * np.abs(normals @ beams[free].T) + 0.005
        near = np.abs(normals @ points[free].T - rho[:, None]) < 2.5 * sigma
        best = near.sum(axis=1).argmax()
        if near[best].sum() < 9:
            break
        lines.append(fitted(points[free[near[best]]], 1 / far[free[near[best]]] ** 2))
        labels = chosen(points, share, lines, far, beams)
        for k in np.unique(labels[labels >= 0]):
            mine = labels == k
            lines[k] = fitted(points[mine], 1 / far[mine] ** 2)
        labels = chosen(points, share, lines, far, beams)
    return labels.tolist()

# %% way: a table of votes, then least squares
def fitted(points, weight):
    centre = weight @ points / weight.sum()
    x, y = (points - centre).T * np.sqrt(weight)
    alpha = 0.5 * np.arctan2(-2 * x @ y, y @ y - x @ x)
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    return normal, centre @ normal

def chosen(points, share, lines, far, beams):
    if not lines:
        return np.full(len(points), -1)
    off = []
    for normal, rho in lines:
        off.append(np.abs(points @ normal - rho) / (share * far * np.abs(beams @ normal) + 0.005))
    off = np.array(off)
    labels = np.where(off.min(axis=0) < 3, off.argmin(axis=0), -1)
    for k in range(len(lines)):
        if np.sum(labels == k) < 7:
            labels[labels == k] = -1
    return labels

def segment(points, share):
    far = np.hypot(*points.T)
    beams = points / far[:, None]
    alpha = np.arange(0, np.pi, np.radians(1.25))
    normal = np.column_stack([np.cos(alpha), np.sin(alpha)])
    level = np.arange(-8, 8, 0.05)
    free, lines = np.ones(len(points), dtype=bool), []
    rho = normal @ points.T
    sigma = share * far * np.abs(normal @ beams.T) + 0.01
    for _ in range(14):
        best, where = 0, None
        for a in range(len(alpha)):
            low, high = rho[a, free] - 2.5 * sigma[a, free], rho[a, free] + 2.5 * sigma[a, free]
            there = np.searchsorted(np.sort(low), level, "right") - np.searchsorted(np.sort(high), level)
            if there.max() > best:
                best, where = there.max(), (a, level[there.argmax()])
        if best < 9:
            break
        a, r = where
        inside = free & (np.abs(rho[a] - r) < 2.5 * sigma[a])
        for _ in range(4):
            line = fitted(points[inside], 1 / far[inside] ** 2)
            off = np.abs(points @ line[0] - line[1]) / (share * far * np.abs(beams @ line[0]) + 0.005)
            inside = free & (off < 3)
            if inside.sum() < 3:
                break
        lines.append(line)
        free = free & (off >= 3) & ~inside
        if inside.sum() < 3:
            free[np.abs(rho[a] - r) < 2.5 * sigma[a]] = False
    for _ in range(3):
        labels = chosen(points, share, lines, far, beams)
        for k in np.unique(labels[labels >= 0]):
            lines[k] = fitted(points[labels == k], 1 / far[labels == k] ** 2)
    return chosen(points, share, lines, far, beams)

# %% way: all pairs of readings, loops
def fitted(points, weight):
    centre = weight @ points / weight.sum()
    x, y = (points - centre).T * np.sqrt(weight)
    alpha = 0.5 * np.arctan2(-2 * x @ y, y @ y - x @ x)
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    return normal, centre @ normal

def chosen(points, share, lines, far, beams):
    if not lines:
        return np.full(len(points), -1)
    off = []
    for normal, rho in lines:
        off.append(np.abs(points @ normal - rho) / (share * far * np.abs(beams @ normal) + 0.005))
    off = np.array(off)
    labels = np.where(off.min(axis=0) < 3, off.argmin(axis=0), -1)
    for k in range(len(lines)):
        if np.sum(labels == k) < 7:
            labels[labels == k] = -1
    return labels

def segment(points, share):
    n = len(points)
    far = np.hypot(points[:, 0], points[:, 1])
    beams = points / far[:, None]
    free, lines = np.ones(n, dtype=bool), []
    guesses = []
    for i in range(n):
        for step in (5, 11, 20):
            j = (i + step) % n
            way = points[j] - points[i]
            length = np.hypot(*way)
            if length < 1e-6:
                continue
            normal = np.array([way[1], -way[0]]) / length
            off = points @ normal - points[i] @ normal
            guesses.append(np.abs(off) < 2.6 * (share * far * np.abs(beams @ normal) + 0.005))
    guesses = np.array(guesses)
    for _ in range(14):
        votes = guesses @ free.astype(float)
        inside = guesses[votes.argmax()] & free
        if inside.sum() < 9:
            break
        for _ in range(3):
            line = fitted(points[inside], 1 / far[inside] ** 2)
            off = np.abs(points @ line[0] - line[1]) / (share * far * np.abs(beams @ line[0]) + 0.005)
            inside = free & (off < 3)
        lines.append(line)
        free = free & (off >= 3) & ~guesses[votes.argmax()]
    return chosen(points, share, lines, far, beams)

# %% pasted: the windows of the thesis
def line_of(points):
    centre = points.mean(axis=0)
    x, y = (points - centre).T
    alpha = 0.5 * np.arctan2(-2 * x @ y, y @ y - x @ x)
    return centre @ [np.cos(alpha), np.sin(alpha)], alpha

def guess(points, middle, window):
    rows = (middle + np.arange(window) - window // 2) % len(points)
    return rows, line_of(points[rows])

def across(points, line):
    rho, alpha = line
    return points @ [np.cos(alpha), np.sin(alpha)] - rho

def segment(points, share):
    labels = np.full(len(points), -1)
    for middle in range(len(points)):
        rows, line = guess(points, middle, 25)
        inside = rows[np.abs(across(points[rows], line)) <= 0.015]
        if len(inside) >= 21:
            free = inside[labels[inside] < 0]
            labels[free] = labels.max() + 1
    return labels

# %% pasted: the lesson's guess, count and grow
def line_of(points):
    centre = points.mean(axis=0)
    x, y = (points - centre).T
    alpha = 0.5 * np.arctan2(-2 * x @ y, y @ y - x @ x)
    return centre @ [np.cos(alpha), np.sin(alpha)], alpha

def guess(points, middle, window):
    rows = (middle + np.arange(window) - window // 2) % len(points)
    return rows, line_of(points[rows])

def across(points, line):
    rho, alpha = line
    return points @ [np.cos(alpha), np.sin(alpha)] - rho


def segment(points, share):
    labels, band = np.full(len(points), -1), 2.8 * share * np.hypot(*points.T)
    for middle in range(len(points)):
        rows, line = guess(points, middle, 9)
        inside = rows[np.abs(across(points[rows], line)) <= band[rows]]
        if len(inside) < 8 or (labels[rows] >= 0).any():
            continue
        for _ in range(4):
            line = line_of(points[inside])
            near = np.flatnonzero((np.abs(across(points, line)) <= band) & (labels < 0))
            inside = near if len(near) > 3 else inside
        labels[inside] = labels.max() + 1
    return labels

# %% right: sequential RANSAC, pairs of near neighbours, band in sigmas (loops)
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

# %% right: Hough in (alpha, rho), refit, nearest line last
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

# %% wrong: all readings are one wall
def segment(points, share):
    return np.zeros(len(points), dtype=int)

# %% wrong: sequential RANSAC, fixed band
def segment(points, share):
    rng = np.random.default_rng(0)
    out = np.full(len(points), -1)
    for k in range(8):
        free = np.flatnonzero(out < 0)
        if len(free) < 10:
            break
        best = free[:0]
        for _ in range(60):
            a, b = points[rng.choice(free, 2, replace=False)]
            n = np.array([a[1] - b[1], b[0] - a[0]])
            n = n / np.hypot(*n)
            near = free[np.abs((points[free] - a) @ n) < 0.05]
            if len(near) > len(best):
                best = near
        if len(best) < 8:
            break
        out[best] = k
    return out

# %% wrong: all clutter
def segment(points, share):
    return np.full(len(points), -1)

# %% wrong: each reading its own wall
def segment(points, share):
    return np.arange(len(points))

# %% wrong: a list of arrays of numbers, one a wall
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

# %% wrong: good walls, but NaN for clutter
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

# %% wrong: numbers for a scan of 180 readings only
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

# %% wrong: good walls, each cut anew wherever a reading does not belong
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
