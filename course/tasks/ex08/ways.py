"""Right ways through 08-fit-line, 08-associate and 08-pillar, other than the solutions."""

_ANGLE = """
def fit_line(points):
    centre = points.mean(axis=0)
    x, y = (points - centre).T
    alpha = 0.5 * np.arctan2(-2 * (x @ y), y @ y - x @ x)
    rho = centre @ [np.cos(alpha), np.sin(alpha)]
    return (rho, alpha) if rho >= 0 else (-rho, wrap(alpha + np.pi))
"""

FIT = {
    "the angle in closed form": _ANGLE,
    "singular value decomposition": """
def fit_line(points):
    centre = np.mean(points, axis=0)
    normal = np.linalg.svd(points - centre)[2][1]
    if normal @ centre < 0:
        normal = -normal
    return normal @ centre, np.arctan2(normal[1], normal[0])
""",
    "general eigenvectors of the covariance": """
def fit_line(points):
    centre = points.mean(axis=0)
    values, vectors = np.linalg.eig(np.cov(points.T))
    normal = vectors[:, values.argmin()]
    rho = normal @ centre
    alpha = np.arctan2(normal[1], normal[0]) + (np.pi if rho < 0 else 0)
    return [float(abs(rho)), float(alpha % (2 * np.pi))]
""",
    "sums in loops": """
def fit_line(points):
    n = len(points)
    mx = sum(p[0] for p in points) / n
    my = sum(p[1] for p in points) / n
    sxx = sxy = syy = 0.0
    for px, py in points:
        sxx += (px - mx) ** 2
        sxy += (px - mx) * (py - my)
        syy += (py - my) ** 2
    alpha = 0.5 * np.arctan2(-2 * sxy, syy - sxx)
    rho = mx * np.cos(alpha) + my * np.sin(alpha)
    if rho < 0:
        rho = -rho
        alpha = alpha + np.pi
    return np.array([rho, alpha])
""",
    "complex numbers": """
def fit_line(points):
    w = points @ [1, 1j]
    centre = w.mean()
    normal = 1j * np.sqrt(np.sum((w - centre) ** 2))
    normal /= abs(normal)
    rho = (centre * normal.conjugate()).real
    return abs(rho), np.angle(normal if rho >= 0 else -normal)
""",
    "searched": """
def fit_line(points):
    off = points - points.mean(axis=0)
    cost = lambda a: np.sum((off @ np.array([np.cos(a), np.sin(a)])) ** 2, axis=0)
    grid = np.linspace(0, np.pi, 33)
    best, width = grid[np.argmin(cost(grid))], 0.1
    for _ in range(50):
        best = min(best - width, best, best + width, key=cost)
        width *= 0.6
    rho = points.mean(axis=0) @ [np.cos(best), np.sin(best)]
    return (rho, best) if rho >= 0 else (-rho, best + np.pi)
""",
}

_LOOPS = """
def associate(z, expected, S, gate):
    d2 = np.empty((len(z), len(expected)))
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            d2[i, j] = v @ np.linalg.solve(S[j], v)
    pairs = [None] * len(z)
    for k in np.argsort(d2, axis=None):
        i, j = divmod(int(k), len(expected))
        if d2[i, j] <= gate and pairs[i] is None and j not in pairs:
            pairs[i] = j
    return pairs
"""

ASSOCIATE = {
    "a table, sorted": _LOOPS,
    "all at once": """
def associate(z, expected, S, gate):
    v = z[:, None] - expected
    v[..., 1] = wrap(v[..., 1])
    d2 = np.einsum("mni,nij,mnj->mn", v, np.linalg.inv(S), v)
    pairs = [None] * len(z)
    for _ in range(d2.size):
        if d2.min() > gate:
            break
        i, j = np.unravel_index(d2.argmin(), d2.shape)
        pairs[i] = np.int64(j)
        d2[i], d2[:, j] = np.inf, np.inf
    return tuple(pairs)
""",
    "whitened": """
def associate(z, expected, S, gate):
    found = {}
    all_pairs = [(i, j) for i in range(len(z)) for j in range(len(expected))]
    def d2(pair):
        v = np.array([z[pair[0]][0] - expected[pair[1]][0], wrap(z[pair[0]][1] - expected[pair[1]][1])])
        return np.sum(np.linalg.solve(np.linalg.cholesky(S[pair[1]]), v) ** 2)
    for i, j in sorted((p for p in all_pairs if d2(p) <= gate), key=d2):
        if i not in found and j not in found.values():
            found[i] = j
    return [found.get(i) for i in range(len(z))]
""",
    "a heap": """
def associate(z, expected, S, gate):
    import heapq
    heap, pairs, taken = [], [None for _ in z], set()
    for i, seen in enumerate(z):
        for j, (place, cov) in enumerate(zip(expected, S)):
            v = seen - place
            v = np.array([v[0], (v[1] + np.pi) % (2 * np.pi) - np.pi])
            heapq.heappush(heap, (float(v @ np.linalg.pinv(cov) @ v), i, j))
    for _ in range(len(heap)):
        d, i, j = heapq.heappop(heap)
        if d > gate:
            break
        if pairs[i] is None and j not in taken:
            pairs[i] = j
            taken.add(j)
    return pairs
""",
}

_RANSAC = """
def find_pillar(points, band, largest, needed, tries, rng):
    best, count = None, 0
    for _ in range(tries):
        if len(points) < 3:
            break
        rows = rng.permutation(len(points))[:3]
        try:
            centre, radius = through(points[rows])
        except np.linalg.LinAlgError:
            continue
        inside = [abs(np.hypot(*(p - centre)) - radius) <= band for p in points]
        if not radius > largest and sum(inside) > count:
            best, count = inside, sum(inside)
    if count < needed:
        return None
    centre, radius = fit_circle(points[np.array(best)])
    return [list(centre), radius, best]
"""

_THROUGH = """
def through(three):
    A = np.column_stack([2 * three, np.ones(3)])
    a, b, d = np.linalg.solve(A, np.sum(three**2, axis=1))
    return np.array([a, b]), np.sqrt(d + a * a + b * b)
"""

PILLAR = {
    "the centroid taken off, singular systems caught": _THROUGH
    + """
def fit_circle(points):
    middle = points.mean(axis=0)
    p = points - middle
    c = np.linalg.solve(2 * p.T @ p, p.T @ np.sum(p**2, axis=1))
    return c + middle, np.sqrt(np.mean(np.sum((p - c) ** 2, axis=1)))
"""
    + _RANSAC,
    "of three on a line some circle, too": """
def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    best = np.zeros(len(points), dtype=bool)
    for _ in range(tries):
        centre, radius = fit_circle(points[rng.choice(len(points), 3, replace=False)])
        inside = np.abs(np.hypot(*(points - centre).T) - radius) <= band
        if radius <= largest and inside.sum() > best.sum():
            best = inside
    if best.sum() < needed:
        return None
    return *fit_circle(points[best]), best
""",
    "all guesses at once": """
def fit_circle(points):
    A = np.hstack([points, np.ones((len(points), 1))])
    a, b, d = np.linalg.inv(A.T @ A) @ (A.T @ (points**2).sum(axis=1))
    return np.array([a, b]) / 2, np.sqrt(d + (a**2 + b**2) / 4)

def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < needed:
        return None
    rows = np.argsort(rng.random((tries, len(points))), axis=1)[:, :3]
    first, a, b = points[rows[:, 0]], points[rows[:, 1]], points[rows[:, 2]]
    a, b = a - first, b - first
    det = 2 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    some = np.abs(det) > 1e-9
    first, a, b, det = first[some], a[some], b[some], det[some]
    aa, bb = np.sum(a**2, axis=1), np.sum(b**2, axis=1)
    x = (b[:, 1] * aa - a[:, 1] * bb) / det
    y = (a[:, 0] * bb - b[:, 0] * aa) / det
    radius = np.hypot(x, y)
    centre = first + np.column_stack([x, y])
    off = np.linalg.norm(points[None] - centre[:, None], axis=2) - radius[:, None]
    inside = (np.abs(off) <= band)[radius <= largest]
    if not len(inside) or inside.sum(axis=1).max() < needed:
        return None
    best = inside[inside.sum(axis=1).argmax()]
    return *fit_circle(points[best]), best.astype(int)
""",
    "complex numbers, counted again": """
def fit_circle(points):
    w = points @ [1, 1j]
    rows = np.array([[2 * v.real, 2 * v.imag, 1] for v in w])
    a, b, d = np.linalg.pinv(rows) @ np.abs(w) ** 2
    return (a, b), float(np.sqrt(d + a**2 + b**2))

def find_pillar(points, band, largest, needed, tries, rng):
    w = points @ [1, 1j]
    inside = np.zeros(len(w), dtype=bool)
    for _ in range(tries if len(w) > 2 else 0):
        p, q, s = rng.choice(w, 3, replace=False)
        ratio = (s - p) / (q - p)
        if abs(ratio.imag) < 1e-9:
            continue
        c = (q - p) * (ratio - abs(ratio) ** 2) / (2j * ratio.imag) + p
        if abs(p - c) > largest:
            continue
        on = np.abs(np.abs(w - c) - abs(p - c)) <= band
        if on.sum() > inside.sum():
            inside = on
    if inside.sum() < needed:
        return None
    (x, y), radius = fit_circle(points[inside])
    inside = np.abs(np.abs(w - x - 1j * y) - radius) <= band
    return *fit_circle(points[inside]), inside
""",
    "bisectors": """
def fit_circle(points):
    if len(points) == 3:
        (x1, y1), (x2, y2), (x3, y3) = points
        A = np.array([[x2 - x1, y2 - y1], [x3 - x1, y3 - y1]])
        b = np.array([x2**2 - x1**2 + y2**2 - y1**2, x3**2 - x1**2 + y3**2 - y1**2]) / 2
        c = np.linalg.solve(A, b)
        return c, np.hypot(x1 - c[0], y1 - c[1])
    q, r = np.linalg.qr(np.c_[2 * points, np.ones(len(points))])
    c = np.linalg.solve(r, q.T @ np.einsum("ij,ij->i", points, points))
    return c[:2], np.sqrt(c[2] + c[:2] @ c[:2])

def find_pillar(points, band, largest, needed, tries, rng):
    winner = []
    if len(points) >= 3:
        for _ in range(tries):
            i, j, k = rng.choice(len(points), size=3, replace=False)
            a, b = points[j] - points[i], points[k] - points[i]
            if abs(np.linalg.det([a, b])) > 1e-10:
                centre, radius = fit_circle(points[[i, j, k]])
                on = []
                for row, p in enumerate(points):
                    d = np.linalg.norm(p - centre)
                    if radius - band <= d <= radius + band:
                        on.append(row)
                if len(on) > len(winner) and radius <= largest:
                    winner = on
    if len(winner) < needed:
        return None
    inside = np.zeros(len(points), dtype=bool)
    inside[winner] = True
    centre, radius = fit_circle(points[winner])
    return centre, radius, inside
""",
}
