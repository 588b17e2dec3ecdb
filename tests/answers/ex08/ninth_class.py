"""A ninth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "08-fit-line",
        "closed formula of the angle from the second moments, arctan2",
        """
def fit_line(points):
    mx, my = points.mean(axis=0)
    x, y = points[:, 0] - mx, points[:, 1] - my
    alpha = 0.5 * np.arctan2(-2 * np.sum(x * y), np.sum(y**2) - np.sum(x**2))
    rho = mx * np.cos(alpha) + my * np.sin(alpha)
    if rho < 0:
        return -rho, np.arctan2(-np.sin(alpha), -np.cos(alpha))
    return rho, alpha
""",
    ),
    (
        "08-corner",
        "Cramer's rule, Jacobian of all four numbers by central differences",
        """
def corner(z1, R1, z2, R2):
    def meet(q):
        c1, s1, c2, s2 = np.cos(q[1]), np.sin(q[1]), np.cos(q[3]), np.sin(q[3])
        det = c1 * s2 - c2 * s1
        return np.array([q[0] * s2 - q[2] * s1, c1 * q[2] - c2 * q[0]]) / det
    q = np.concatenate([z1, z2]).astype(float)
    J = np.column_stack([(meet(q + e) - meet(q - e)) / 2e-5 for e in 1e-5 * np.eye(4)])
    R = np.zeros((4, 4))
    R[:2, :2], R[2:, 2:] = R1, R2
    return meet(q), J @ R @ J.T
""",
    ),
]

WRONG = [
    (
        "08-fit-line",
        "regression of y on x: least squares along y instead of across the line, vertical walls fail",
        """
def fit_line(points):
    x, y = points[:, 0], points[:, 1]
    slope, cut = np.linalg.lstsq(np.column_stack([x, np.ones(len(x))]), y, rcond=None)[0]
    alpha = np.arctan2(1.0, -slope)
    rho = cut / np.sqrt(1 + slope**2)
    if rho < 0:
        rho, alpha = -rho, wrap(alpha + np.pi)
    return rho, alpha
""",
    ),
    (
        "08-fit-line",
        "takes the direction of largest scatter for the normal",
        """
def fit_line(points):
    m = points.mean(axis=0)
    values, vectors = np.linalg.eigh(np.cov((points - m).T))
    n = vectors[:, np.argmax(values)]
    rho = n @ m
    if rho < 0:
        n, rho = -n, -rho
    return rho, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-fit-line",
        "rho made positive by abs, alpha is not turned round with it",
        """
def fit_line(points):
    centre = points.mean(axis=0)
    _, _, Vt = np.linalg.svd(points - centre)
    normal = Vt[1]
    return abs(normal @ centre), np.arctan2(normal[1], normal[0])
""",
    ),
    (
        "08-fit-line",
        "moves the caller's points to their centroid in place",
        """
def fit_line(points):
    centre = points.mean(axis=0)
    points -= centre
    _, v = np.linalg.eigh(points.T @ points)
    n = v[:, 0] * (1 if v[:, 0] @ centre >= 0 else -1)
    return n @ centre, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-corner",
        "sign of the alpha term: plus n'.p dalpha in the derivative",
        """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    p = np.linalg.solve(N, np.array([z1[0], z2[0]]))
    M = np.linalg.inv(N)
    P = np.zeros((2, 2))
    for k, (z, R) in enumerate([(z1, R1), (z2, R2)]):
        turn = -np.sin(z[1]) * p[0] + np.cos(z[1]) * p[1]
        J = np.column_stack([M[:, k], M[:, k] * turn])
        P += J @ R @ J.T
    return p, P
""",
    ),
    (
        "08-corner",
        "the errors of the angles are left out, only rho errs",
        """
def corner(z1, R1, z2, R2):
    N = np.column_stack([np.cos([z1[1], z2[1]]), np.sin([z1[1], z2[1]])])
    M = np.linalg.inv(N)
    p = M @ [z1[0], z2[0]]
    return p, M @ np.diag([R1[0, 0], R2[0, 0]]) @ M.T
""",
    ),
    (
        "08-corner",
        "correlation of rho and alpha in R dropped (variances only)",
        """
def corner(z1, R1, z2, R2):
    c1, s1, c2, s2 = np.cos(z1[1]), np.sin(z1[1]), np.cos(z2[1]), np.sin(z2[1])
    N = np.array([[c1, s1], [c2, s2]])
    p = np.linalg.solve(N, [z1[0], z2[0]])
    t = np.array([-s1 * p[0] + c1 * p[1], -s2 * p[0] + c2 * p[1]])
    noise = np.array([R1[0, 0] + t[0] ** 2 * R1[1, 1], R2[0, 0] + t[1] ** 2 * R2[1, 1]])
    M = np.linalg.inv(N)
    return p, M @ np.diag(noise) @ M.T
""",
    ),
    (
        "08-corner",
        "solves by slopes y = (rho - x cos)/sin: fails for walls with sin alpha = 0",
        """
def corner(z1, R1, z2, R2):
    (r1, a1), (r2, a2) = z1, z2
    x = (r1 / np.sin(a1) - r2 / np.sin(a2)) / (1 / np.tan(a1) - 1 / np.tan(a2))
    y = (r1 - x * np.cos(a1)) / np.sin(a1)
    p = np.array([x, y])
    N = np.array([[np.cos(a1), np.sin(a1)], [np.cos(a2), np.sin(a2)]])
    J = np.zeros((2, 4))
    J[0, :2] = 1, np.sin(a1) * x - np.cos(a1) * y
    J[1, 2:] = 1, np.sin(a2) * x - np.cos(a2) * y
    J = np.linalg.inv(N) @ J
    return p, J[:, :2] @ R1 @ J[:, :2].T + J[:, 2:] @ R2 @ J[:, 2:].T
""",
    ),
    (
        "08-associate",
        "goes through the sightings in order, each takes its nearest free wall: not the nearest pair first",
        """
def associate(z, expected, S, gate):
    taken, result = set(), []
    for one in z:
        best, choice = gate, None
        for j in range(len(expected)):
            v = one - expected[j]
            v[1] = wrap(v[1])
            d2 = v @ np.linalg.solve(S[j], v)
            if j not in taken and d2 <= best:
                best, choice = d2, j
        if choice is not None:
            taken.add(choice)
        result.append(choice)
    return result
""",
    ),
    (
        "08-associate",
        "angle of the innovation not wrapped",
        """
def associate(z, expected, S, gate):
    m, N = len(z), len(expected)
    D = np.full((m, N), np.inf)
    for i in range(m):
        for j in range(N):
            v = z[i] - expected[j]
            D[i, j] = v @ np.linalg.inv(S[j]) @ v
    out = [None] * m
    while D.size and D.min() <= gate:
        i, j = np.unravel_index(np.argmin(D), D.shape)
        out[i] = int(j)
        D[i, :] = np.inf
        D[:, j] = np.inf
    return out
""",
    ),
    (
        "08-associate",
        "several sightings may take the same wall",
        """
def associate(z, expected, S, gate):
    names = []
    for rho, alpha in z:
        d2 = []
        for (r, a), C in zip(expected, S):
            v = np.array([rho - r, wrap(alpha - a)])
            d2.append(v @ np.linalg.inv(C) @ v)
        k = int(np.argmin(d2)) if d2 else None
        names.append(k if k is not None and d2[k] <= gate else None)
    return names
""",
    ),
    (
        "08-associate",
        "compares the square root of d2 with the gate: the gate is too wide",
        """
def associate(z, expected, S, gate):
    pairs = []
    for i, a in enumerate(z):
        for j, b in enumerate(expected):
            v = a - b
            v[1] = wrap(v[1])
            d = np.sqrt(v @ np.linalg.inv(S[j]) @ v)
            if d <= gate:
                pairs.append((d, i, j))
    got = [None] * len(z)
    for d, i, j in sorted(pairs):
        if got[i] is None and j not in got:
            got[i] = j
    return got
""",
    ),
    (
        "08-associate",
        "least sum of all distances (best assignment over all) instead of nearest first",
        """
def associate(z, expected, S, gate):
    from scipy.optimize import linear_sum_assignment
    m, N = len(z), len(expected)
    D = np.zeros((m, N))
    for i in range(m):
        for j in range(N):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            D[i, j] = v @ np.linalg.inv(S[j]) @ v
    out = [None] * m
    for i, j in zip(*linear_sum_assignment(np.minimum(D, gate + 1))):
        if D[i, j] <= gate:
            out[i] = int(j)
    return out
""",
    ),
    (
        "08-pillar",
        "radius is the root of d, |c| squared is not added",
        """
def fit_circle(points):
    A = np.column_stack([2 * points[:, 0], 2 * points[:, 1], np.ones(len(points))])
    s = np.linalg.lstsq(A, (points**2).sum(axis=1), rcond=None)[0]
    return s[:2], np.sqrt(abs(s[2]))


def find_pillar(points, band, largest, needed, tries, rng):
    n = len(points)
    if n < 3:
        return None
    best = None
    for _ in range(tries):
        c, r = fit_circle(points[rng.choice(n, 3, replace=False)])
        if r > largest:
            continue
        inside = abs(np.linalg.norm(points - c, axis=1) - r) <= band
        if best is None or inside.sum() > best.sum():
            best = inside
    if best is None or best.sum() < needed:
        return None
    c, r = fit_circle(points[best])
    return c, r, best
""",
    ),
    (
        "08-pillar",
        "everything within radius + band counts as agreeing, also what lies deep inside the circle",
        """
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, (points * points).sum(axis=1), rcond=None)[0]
    return np.array([cx, cy]), np.sqrt(max(d + cx * cx + cy * cy, 0))


def find_pillar(points, band, largest, needed, tries, rng):
    best, most = None, 0
    if len(points) < 3:
        return None
    for _ in range(tries):
        centre, radius = fit_circle(points[rng.permutation(len(points))[:3]])
        if radius > largest:
            continue
        inside = np.hypot(points[:, 0] - centre[0], points[:, 1] - centre[1]) < radius + band
        if inside.sum() > most:
            best, most = inside, inside.sum()
    if most < needed:
        return None
    centre, radius = fit_circle(points[best])
    return centre, radius, best
""",
    ),
    (
        "08-pillar",
        "no limit on the radius: a wall with many readings wins as a huge circle",
        """
def fit_circle(points):
    A = np.c_[2 * points, np.ones(len(points))]
    sol = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return sol[:2], float(np.sqrt(max(sol[2] + sol[:2] @ sol[:2], 0)))


def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < max(3, needed):
        return None
    votes = []
    for _ in range(tries):
        c, r = fit_circle(rng.choice(points, 3, replace=False))
        votes.append(np.abs(np.sqrt(((points - c) ** 2).sum(axis=1)) - r) <= band)
    if not votes:
        return None
    best = max(votes, key=np.sum)
    if best.sum() < needed:
        return None
    return *fit_circle(points[best]), best
""",
    ),
    (
        "08-pillar",
        "circle through the three drawn readings is returned, not refitted to all that agree",
        """
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    b = np.sum(points**2, axis=1)
    x = np.linalg.pinv(A) @ b
    return x[:2], np.sqrt(max(0.0, x[2] + x[0] ** 2 + x[1] ** 2))


def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    winner, count = None, 0
    for _ in range(tries):
        pick = rng.choice(len(points), size=3, replace=False)
        c, r = fit_circle(points[pick])
        agree = np.abs(np.linalg.norm(points - c, axis=1) - r) <= band
        if r <= largest and agree.sum() > count:
            winner, count = (c, r, agree), agree.sum()
    return winner if count >= needed else None
""",
    ),
    (
        "08-pillar",
        "centre as the centroid of the readings and radius as their mean distance (wrong for an arc)",
        """
def fit_circle(points):
    centre = points.mean(axis=0)
    return centre, np.hypot(*(points - centre).T).mean()


def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    best = np.zeros(len(points), bool)
    for _ in range(tries):
        c, r = fit_circle(points[rng.choice(len(points), 3, replace=False)])
        inside = np.abs(np.hypot(*(points - c).T) - r) <= band
        if r <= largest and inside.sum() > best.sum():
            best = inside
    if best.sum() < needed:
        return None
    return *fit_circle(points[best]), best
""",
    ),
    (
        "08-segments",
        "all readings are one wall",
        """
def segment(points, share):
    return np.zeros(len(points), dtype=int)
""",
    ),
    (
        "08-segments",
        "cuts where neighbours are more than 30 cm apart: walls that meet in a corner stay one, clutter splits walls",
        """
def segment(points, share):
    gaps = np.hypot(*np.diff(points, axis=0).T) > 0.3
    return np.concatenate([[0], np.cumsum(gaps)]).astype(int)
""",
    ),
    (
        "08-segments",
        "only the single line on which most readings agree, never looks for the next",
        """
def segment(points, share):
    rng = np.random.default_rng(0)
    best = np.zeros(len(points), dtype=bool)
    for _ in range(60):
        a, b = points[rng.choice(len(points), 2, replace=False)]
        n = np.array([a[1] - b[1], b[0] - a[0]])
        n = n / np.linalg.norm(n)
        near = np.abs((points - a) @ n) < 0.08
        if near.sum() > best.sum():
            best = near
    return np.where(best, 0, -1)
""",
    ),
    (
        "08-segments",
        "line after line with a fixed band of 2 cm, near and far alike: noisy far walls fall apart",
        """
def segment(points, share):
    rng = np.random.default_rng(0)
    labels = np.full(len(points), -1)
    for number in range(10):
        free = np.flatnonzero(labels < 0)
        if len(free) < 8:
            break
        best = free[:0]
        for _ in range(120):
            i, j = rng.choice(free, 2, replace=False)
            n = np.array([points[i, 1] - points[j, 1], points[j, 0] - points[i, 0]])
            n = n / (np.linalg.norm(n) + 1e-12)
            near = free[np.abs((points[free] - points[i]) @ n) < 0.02]
            if len(near) > len(best):
                best = near
        if len(best) < 8:
            break
        labels[best] = number
    return labels
""",
    ),
    (
        "08-fit-line",
        "does not subtract the centroid before it looks for the directions of scatter",
        """
def fit_line(points):
    _, vectors = np.linalg.eigh(points.T @ points)
    n = vectors[:, 0]
    rho = np.mean(points @ n)
    if rho < 0:
        rho, n = -rho, -n
    return rho, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-corner",
        "covariance from 200 sampled pairs of lines: right to some ten per cent only",
        """
def corner(z1, R1, z2, R2):
    def meet(a, b):
        N = np.array([[np.cos(a[1]), np.sin(a[1])], [np.cos(b[1]), np.sin(b[1])]])
        return np.linalg.solve(N, [a[0], b[0]])
    rng = np.random.default_rng(0)
    A = rng.multivariate_normal(z1, R1, 200)
    B = rng.multivariate_normal(z2, R2, 200)
    cloud = np.array([meet(a, b) for a, b in zip(A, B)])
    return meet(z1, z2), np.cov(cloud.T)
""",
    ),
    (
        "08-pillar",
        "solves three equations exactly: stops with an error when the three drawn readings lie on one line",
        """
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    b = np.sum(points**2, axis=1)
    cx, cy, d = np.linalg.solve(A.T @ A, A.T @ b)
    return np.array([cx, cy]), np.sqrt(d + cx**2 + cy**2)


def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    best = np.zeros(len(points), dtype=bool)
    for _ in range(tries):
        three = points[rng.choice(len(points), 3, replace=False)]
        A = np.column_stack([2 * three, np.ones(3)])
        cx, cy, d = np.linalg.solve(A, np.sum(three**2, axis=1))
        radius = np.sqrt(d + cx**2 + cy**2)
        inside = np.abs(np.hypot(points[:, 0] - cx, points[:, 1] - cy) - radius) <= band
        if radius <= largest and inside.sum() > best.sum():
            best = inside
    if best.sum() < needed:
        return None
    centre, radius = fit_circle(points[best])
    return centre, radius, best
""",
    ),
]
