"""A fourth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "08-fit-line",
        "svd of the counted points",
        """
def fit_line(points):
    m = points.mean(axis=0)
    n = np.linalg.svd(points - m)[2][1]
    rho = n @ m
    if rho < 0:
        n, rho = -n, -rho
    return rho, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-associate",
        "all pairs in a list, sorted",
        """
def associate(z, expected, S, gate):
    pairs = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = (v[1] + np.pi) % (2 * np.pi) - np.pi
            d = v @ np.linalg.solve(S[j], v)
            if d <= gate:
                pairs.append((d, i, j))
    out, used = [None] * len(z), set()
    for d, i, j in sorted(pairs):
        if out[i] is None and j not in used:
            out[i] = j
            used.add(j)
    return out
""",
    ),
]

WRONG = [
    (
        "08-fit-line",
        "polyfit",
        """
def fit_line(points):
    m, q = np.polyfit(points[:, 0], points[:, 1], 1)
    rho = q / np.sqrt(1 + m ** 2)
    alpha = np.arctan2(1, -m)
    if rho < 0:
        rho, alpha = -rho, alpha + np.pi
    return rho, alpha
""",
    ),
    (
        "08-fit-line",
        "negative ρ made positive, α left",
        """
def fit_line(points):
    m = points.mean(axis=0)
    w, V = np.linalg.eigh(np.cov(points.T))
    n = V[:, 0]
    return abs(n @ m), np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-fit-line",
        "the first and the last point",
        """
def fit_line(points):
    d = points[-1] - points[0]
    n = np.array([-d[1], d[0]]) / np.hypot(*d)
    rho = n @ points[0]
    if rho < 0:
        rho, n = -rho, -n
    return rho, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-fit-line",
        "rows of eigenvectors in place of columns",
        """
def fit_line(points):
    m = points.mean(axis=0)
    w, V = np.linalg.eigh(np.cov(points.T))
    n = V[0]
    rho = n @ m
    if rho < 0:
        rho, n = -rho, -n
    return rho, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-corner",
        "covariances of ρ only",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    p = np.linalg.solve(N, [z1[0], z2[0]])
    A = np.linalg.inv(N)
    return p, A @ np.diag([R1[0, 0], R2[0, 0]]) @ A.T
""",
    ),
    (
        "08-corner",
        "plus in place of minus at dα",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    p = np.linalg.solve(N, [z1[0], z2[0]])
    A = np.linalg.inv(N)
    v = []
    for z, R in ((z1, R1), (z2, R2)):
        j = np.array([1, np.array([-np.sin(z[1]), np.cos(z[1])]) @ p])
        v.append(j @ R @ j)
    return p, A @ np.diag(v) @ A.T
""",
    ),
    (
        "08-corner",
        "the other order of the triple product",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    p = np.linalg.solve(N, [z1[0], z2[0]])
    A = np.linalg.inv(N)
    v = []
    for z, R in ((z1, R1), (z2, R2)):
        j = np.array([1, -np.array([-np.sin(z[1]), np.cos(z[1])]) @ p])
        v.append(j @ R @ j)
    return p, A.T @ np.diag(v) @ A
""",
    ),
    (
        "08-associate",
        "first come, first served",
        """
def associate(z, expected, S, gate):
    out, used = [], set()
    for s in z:
        best, wall = gate, None
        for j in range(len(expected)):
            v = s - expected[j]
            v[1] = wrap(v[1])
            d = v @ np.linalg.inv(S[j]) @ v
            if d <= best and j not in used:
                best, wall = d, j
        if wall is not None:
            used.add(wall)
        out.append(wall)
    return out
""",
    ),
    (
        "08-associate",
        "-1 for a new one",
        """
def associate(z, expected, S, gate):
    pairs, out = [], [-1] * len(z)
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            pairs.append((v @ np.linalg.inv(S[j]) @ v, i, j))
    used = []
    for d, i, j in sorted(pairs):
        if d <= gate and out[i] == -1 and j not in used:
            out[i] = j
            used.append(j)
    return out
""",
    ),
    (
        "08-associate",
        "the gate on the distance itself",
        """
def associate(z, expected, S, gate):
    pairs, out, used = [], [None] * len(z), []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            pairs.append((np.sqrt(v @ np.linalg.inv(S[j]) @ v), i, j))
    for d, i, j in sorted(pairs):
        if d <= gate and out[i] is None and j not in used:
            out[i] = j
            used.append(j)
    return out
""",
    ),
    (
        "08-pillar",
        "radius without its root; draws with replacement",
        """
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, (points ** 2).sum(axis=1), rcond=None)[0]
    return np.array([cx, cy]), d + cx ** 2 + cy ** 2
def find_pillar(points, band, largest, needed, tries, rng):
    best = None
    for _ in range(tries):
        c, r = fit_circle(points[rng.integers(0, len(points), 3)])
        if r > largest:
            continue
        inside = np.abs(np.hypot(*(points - c).T) - r) <= band
        if best is None or inside.sum() > best.sum():
            best = inside
    if best is None or best.sum() < needed:
        return None
    return *fit_circle(points[best]), best
""",
    ),
    (
        "08-pillar",
        "counts inside the disc, not near its rim",
        """
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, (points ** 2).sum(axis=1), rcond=None)[0]
    return np.array([cx, cy]), np.sqrt(d + cx ** 2 + cy ** 2)
def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    best = None
    for _ in range(tries):
        three = points[rng.choice(len(points), 3, replace=False)]
        if abs(np.linalg.det(np.column_stack([three, np.ones(3)]))) < 1e-9:
            continue
        c, r = fit_circle(three)
        if r > largest:
            continue
        inside = np.hypot(*(points - c).T) <= r + band
        if best is None or inside.sum() > best.sum():
            best = inside
    if best is None or best.sum() < needed:
        return None
    return *fit_circle(points[best]), best
""",
    ),
    (
        "08-segments",
        "one wall only",
        """
def segment(points, share):
    labels = np.full(len(points), -1)
    rho, alpha = fit_line(points)
    off = points @ [np.cos(alpha), np.sin(alpha)] - rho
    labels[np.abs(off) < 0.1] = 0
    return labels
""",
    ),
]
