"""A second class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "08-fit-line",
        "closed form of the angle",
        """
def fit_line(points):
    x, y = points[:, 0], points[:, 1]
    a, b = x - np.mean(x), y - np.mean(y)
    alpha = np.arctan2(-2 * np.sum(a * b), np.sum(b**2 - a**2)) / 2
    rho = np.mean(x) * np.cos(alpha) + np.mean(y) * np.sin(alpha)
    if rho < 0:
        return -rho, alpha + np.pi
    return rho, alpha
""",
    ),
    (
        "08-corner",
        "by Cramer's rule and differences",
        """
def corner(z1, R1, z2, R2):
    def at(q):
        r1, a1, r2, a2 = q
        det = np.sin(a2 - a1)
        return np.array([r1 * np.sin(a2) - r2 * np.sin(a1), r2 * np.cos(a1) - r1 * np.cos(a2)]) / det
    q = np.array([*z1, *z2], dtype=float)
    J = np.column_stack([(at(q + e) - at(q - e)) / 2e-6 for e in 1e-6 * np.eye(4)])
    R = np.zeros((4, 4))
    R[:2, :2], R[2:, 2:] = R1, R2
    return at(q), J @ R @ J.T
""",
    ),
    (
        "08-associate",
        "a matrix and a loop",
        """
def associate(z, expected, S, gate):
    m, N = len(z), len(expected)
    found = [None] * m
    D = np.full((m, N), np.inf)
    for i in range(m):
        for j in range(N):
            v = np.array([z[i, 0] - expected[j, 0], np.angle(np.exp(1j * (z[i, 1] - expected[j, 1])))])
            D[i, j] = v @ np.linalg.solve(S[j], v)
    while m and N and D.min() <= gate:
        i, j = np.unravel_index(np.argmin(D), D.shape)
        found[i] = int(j)
        D[i, :] = np.inf
        D[:, j] = np.inf
    return found
""",
    ),
]

WRONG = [
    (
        "08-fit-line",
        "polyfit",
        """
def fit_line(points):
    m, b = np.polyfit(points[:, 0], points[:, 1], 1)
    alpha = np.arctan2(1, -m)
    rho = b * np.sin(alpha)
    return (rho, alpha) if rho >= 0 else (-rho, alpha + np.pi)
""",
    ),
    (
        "08-fit-line",
        "first and last point",
        """
def fit_line(points):
    d = points[-1] - points[0]
    n = np.array([-d[1], d[0]]) / np.hypot(*d)
    rho = n @ points.mean(axis=0)
    if rho < 0:
        rho, n = -rho, -n
    return rho, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-fit-line",
        "largest eigenvector",
        """
def fit_line(points):
    c = points.mean(axis=0)
    w, V = np.linalg.eigh(np.cov((points - c).T))
    n = V[:, 1]
    rho = n @ c
    return abs(rho), np.arctan2(n[1], n[0]) if rho > 0 else np.arctan2(-n[1], -n[0])
""",
    ),
    (
        "08-fit-line",
        "|ρ| and the angle stays",
        """
def fit_line(points):
    c = points.mean(axis=0)
    U, s, Vt = np.linalg.svd(points - c)
    n = Vt[1]
    return abs(n @ c), np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-fit-line",
        "not centred",
        """
def fit_line(points):
    w, V = np.linalg.eigh(points.T @ points)
    n = V[:, 0]
    rho = n @ points.mean(axis=0)
    if rho < 0:
        rho, n = -rho, -n
    return rho, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-fit-line",
        "solves n·p = 1",
        """
def fit_line(points):
    m = np.linalg.lstsq(points, np.ones(len(points)), rcond=None)[0]
    return 1 / np.hypot(*m), np.arctan2(m[1], m[0])
""",
    ),
    (
        "08-corner",
        "angles' errors ignored",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    p = np.linalg.solve(N, np.array([z1[0], z2[0]]))
    M = np.linalg.inv(N)
    return p, M @ np.diag([R1[0, 0], R2[0, 0]]) @ M.T
""",
    ),
    (
        "08-corner",
        "correlations of R dropped",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    p = np.linalg.solve(N, np.array([z1[0], z2[0]]))
    M = np.linalg.inv(N)
    v = []
    for z, R in ((z1, R1), (z2, R2)):
        t = np.array([-np.sin(z[1]), np.cos(z[1])]) @ p
        v.append(R[0, 0] + t * t * R[1, 1])
    return p, M @ np.diag(v) @ M.T
""",
    ),
    (
        "08-corner",
        "sign of the angle's term",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    p = np.linalg.solve(N, np.array([z1[0], z2[0]]))
    M = np.linalg.inv(N)
    v = []
    for z, R in ((z1, R1), (z2, R2)):
        t = np.array([1, np.array([-np.sin(z[1]), np.cos(z[1])]) @ p])
        v.append(t @ R @ t)
    return p, M @ np.diag(v) @ M.T
""",
    ),
    (
        "08-corner",
        "inverse on the wrong side",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    p = np.linalg.solve(N, np.array([z1[0], z2[0]]))
    M = np.linalg.inv(N)
    v = []
    for z, R in ((z1, R1), (z2, R2)):
        t = np.array([1, -(np.array([-np.sin(z[1]), np.cos(z[1])]) @ p)])
        v.append(t @ R @ t)
    return p, M.T @ np.diag(v) @ M
""",
    ),
    (
        "08-corner",
        "slope and intercept",
        """
def corner(z1, R1, z2, R2):
    lines = [(-np.cos(a) / np.sin(a), r / np.sin(a)) for r, a in (z1, z2)]
    (m1, b1), (m2, b2) = lines
    x = (b2 - b1) / (m1 - m2)
    p = np.array([x, m1 * x + b1])
    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    M = np.linalg.inv(N)
    v = []
    for z, R in ((z1, R1), (z2, R2)):
        t = np.array([1, -(np.array([-np.sin(z[1]), np.cos(z[1])]) @ p)])
        v.append(t @ R @ t)
    return p, M @ np.diag(v) @ M.T
""",
    ),
    (
        "08-associate",
        "each sighting its nearest",
        """
def associate(z, expected, S, gate):
    out = []
    for a in z:
        best, which = gate, None
        for j, b in enumerate(expected):
            v = a - b
            v[1] = wrap(v[1])
            d2 = v @ np.linalg.inv(S[j]) @ v
            if d2 <= best:
                best, which = d2, j
        out.append(which)
    return out
""",
    ),
    (
        "08-associate",
        "in the order of the sightings",
        """
def associate(z, expected, S, gate):
    out, free = [], list(range(len(expected)))
    for a in z:
        ds = {}
        for j in free:
            v = a - expected[j]
            v[1] = wrap(v[1])
            ds[j] = v @ np.linalg.inv(S[j]) @ v
        j = min(ds, key=ds.get) if ds else None
        if j is not None and ds[j] <= gate:
            out.append(j)
            free.remove(j)
        else:
            out.append(None)
    return out
""",
    ),
    (
        "08-associate",
        "gate on d",
        """
def associate(z, expected, S, gate):
    pairs = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            pairs.append((np.sqrt(v @ np.linalg.inv(S[j]) @ v), i, j))
    out, used = [None] * len(z), set()
    for d, i, j in sorted(pairs):
        if d <= gate and out[i] is None and j not in used:
            out[i] = j
            used.add(j)
    return out
""",
    ),
    (
        "08-associate",
        "0 taken for nothing",
        """
def associate(z, expected, S, gate):
    pairs = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            pairs.append((v @ np.linalg.inv(S[j]) @ v, i, j))
    out, used = [None] * len(z), set()
    for d, i, j in sorted(pairs):
        if d <= gate and not out[i] and j not in used:
            out[i] = j
            used.add(j)
    return out
""",
    ),
    (
        "08-associate",
        "S of the first wall",
        """
def associate(z, expected, S, gate):
    if len(expected) == 0:
        return [None] * len(z)
    W = np.linalg.inv(S[0])
    pairs = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            pairs.append((v @ W @ v, i, j))
    out, used = [None] * len(z), set()
    for d, i, j in sorted(pairs):
        if d <= gate and out[i] is None and j not in used:
            out[i] = j
            used.add(j)
    return out
""",
    ),
    (
        "08-pillar",
        "inside the circle counts as near",
        """
def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    best = np.zeros(len(points), bool)
    for _ in range(tries):
        three = points[rng.choice(len(points), 3, replace=False)]
        if abs(np.linalg.det(np.column_stack([three, np.ones(3)]))) < 1e-9:
            continue
        c, r = fit_circle(three)
        if r > largest:
            continue
        near = np.hypot(*(points - c).T) <= r + band
        if near.sum() > best.sum():
            best = near
    if best.sum() < needed:
        return None
    c, r = fit_circle(points[best])
    return c, r, best
""",
    ),
    (
        "08-pillar",
        "not refitted",
        """
def find_pillar(points, band, largest, needed, tries, rng):
    best = None
    if len(points) < 3:
        return None
    for _ in range(tries):
        three = points[rng.choice(len(points), 3, replace=False)]
        if abs(np.linalg.det(np.column_stack([three, np.ones(3)]))) < 1e-9:
            continue
        c, r = fit_circle(three)
        near = np.abs(np.hypot(*(points - c).T) - r) <= band
        if r <= largest and (best is None or near.sum() > best[2].sum()):
            best = c, r, near
    return best if best is not None and best[2].sum() >= needed else None
""",
    ),
    (
        "08-pillar",
        "draws with replacement",
        """
def find_pillar(points, band, largest, needed, tries, rng):
    best = np.zeros(len(points), bool)
    for _ in range(tries):
        three = points[rng.integers(len(points), size=3)]
        try:
            c, r = fit_circle(three)
        except np.linalg.LinAlgError:
            continue
        near = np.abs(np.hypot(*(points - c).T) - r) <= band
        if r <= largest and near.sum() > best.sum():
            best = near
    if best.sum() < needed:
        return None
    return *fit_circle(points[best]), best
""",
    ),
    (
        "08-pillar",
        "radius without the centre",
        """
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    a, b, d = np.linalg.lstsq(A, (points**2).sum(axis=1), rcond=None)[0]
    return np.array([a, b]), np.sqrt(d)
""",
    ),
    (
        "08-pillar",
        "mean as the centre",
        """
def fit_circle(points):
    c = points.mean(axis=0)
    return c, np.hypot(*(points - c).T).mean()
""",
    ),
    (
        "08-segments",
        "split at jumps",
        """
def segment(points, share):
    gap = np.hypot(*(points - np.roll(points, 1, axis=0)).T)
    return np.cumsum(gap > 0.3)
""",
    ),
    (
        "08-segments",
        "one wall only",
        """
def segment(points, share):
    rng = np.random.default_rng(0)
    best = np.zeros(len(points), bool)
    for _ in range(100):
        a, b = points[rng.choice(len(points), 2, replace=False)]
        n = np.array([a[1] - b[1], b[0] - a[0]])
        n = n / np.hypot(*n)
        near = np.abs((points - a) @ n) < 0.05
        if near.sum() > best.sum():
            best = near
    return np.where(best, 0, -1)
""",
    ),
    (
        "08-segments",
        "sequential RANSAC, fixed band",
        """
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
""",
    ),
    (
        "08-segments",
        "by bearing sectors",
        """
def segment(points, share):
    return (np.arctan2(points[:, 1], points[:, 0]) // (np.pi / 4)).astype(int) + 4
""",
    ),
]
