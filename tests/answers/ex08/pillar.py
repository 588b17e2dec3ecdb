"""Independent answers to 08-pillar: right ones, and students' mistakes."""

FIT = """
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return np.array([cx, cy]), np.sqrt(d + cx**2 + cy**2)

"""

FIND = """
def find_pillar(points, band, largest, needed, tries, rng):
    n = len(points)
    if n < 3:
        return None
    winner, votes = None, 0
    for _ in range(tries):
        three = points[rng.permutation(n)[:3]]
        if abs(np.linalg.det(np.column_stack([three, np.ones(3)]))) < 1e-9:
            continue
        c, r = fit_circle(three)
        if r > largest:
            continue
        inside = np.abs(np.linalg.norm(points - c, axis=1) - r) <= band
        if inside.sum() > votes:
            winner, votes = inside, inside.sum()
    if votes < needed:
        return None
    c, r = fit_circle(points[winner])
    return c, r, winner
"""

RIGHT = [
    (
        "08-pillar",
        "permutation, determinant, norm",
        FIT + FIND,
    ),
    (
        "08-pillar",
        "normal equations about the centroid; circumcentre by formula",
        """
def fit_circle(points):
    # moving the origin changes neither side's difference: the same least squares
    m = points.mean(axis=0)
    q = points - m
    w = np.sum(q**2, axis=1)
    c = np.linalg.solve(2 * q.T @ q, q.T @ (w - w.mean()))
    return m + c, float(np.sqrt(w.mean() + c @ c))


def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    best, best_count = None, -1
    for _ in range(tries):
        a, b, c = points[rng.choice(len(points), size=3, replace=False)]
        p, q = b - a, c - a
        D = 2 * (p[0] * q[1] - p[1] * q[0])
        if abs(D) < 1e-12:
            continue
        u = np.array([q[1] * (p @ p) - p[1] * (q @ q), p[0] * (q @ q) - q[0] * (p @ p)]) / D
        r = np.sqrt(u @ u)
        if not r <= largest:
            continue
        off = np.sqrt(np.sum((points - a - u) ** 2, axis=1)) - r
        inside = (off <= band) & (off >= -band)
        if np.count_nonzero(inside) > best_count:
            best, best_count = inside, np.count_nonzero(inside)
    if best_count < needed:
        return None
    centre, radius = fit_circle(points[best])
    return centre, radius, best
""",
    ),
    (
        "08-pillar",
        "lstsq on three readings on a line: a circle that is none",
        FIT
        + """
def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    best = np.zeros(len(points), dtype=bool)
    for _ in range(tries):
        centre, radius = fit_circle(points[rng.choice(len(points), 3, replace=False)])
        if radius > largest:
            continue
        inside = np.abs(np.hypot(*(points - centre).T) - radius) <= band
        if inside.sum() > best.sum():
            best = inside
    if best.sum() < needed:
        return None
    return *fit_circle(points[best]), best
""",
    ),
]

WRONG = [
    (
        "08-pillar",
        "radius is the root of d alone",
        """
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return np.array([cx, cy]), np.sqrt(abs(d))

"""
        + FIND,
    ),
    (
        "08-pillar",
        "r squared returned",
        """
def fit_circle(points):
    A = np.c_[2 * points, np.ones(len(points))]
    b = (points**2).sum(1)
    cx, cy, d = np.linalg.lstsq(A, b, rcond=None)[0]
    return np.array([cx, cy]), d + cx**2 + cy**2

"""
        + FIND,
    ),
    (
        "08-pillar",
        "factor 2 of c.p forgotten",
        """
def fit_circle(points):
    A = np.column_stack([points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return np.array([cx, cy]), np.sqrt(abs(d + cx**2 + cy**2))

"""
        + FIND,
    ),
    (
        "08-pillar",
        "centroid and mean distance",
        """
def fit_circle(points):
    centre = points.mean(axis=0)
    return centre, np.mean(np.linalg.norm(points - centre, axis=1))

"""
        + FIND,
    ),
    (
        "08-pillar",
        "circle through the first three points only",
        """
def fit_circle(points):
    A = np.column_stack([2 * points[:3], np.ones(3)])
    cx, cy, d = np.linalg.solve(A, np.sum(points[:3] ** 2, axis=1))
    return np.array([cx, cy]), np.sqrt(d + cx**2 + cy**2)

"""
        + FIND,
    ),
    (
        "08-pillar",
        "geometric least squares in place of the equation's",
        FIT.replace("def fit_circle", "def start_circle")
        + """
def fit_circle(points):
    c, r = start_circle(points)
    for _ in range(20):
        d = points - c
        dist = np.hypot(d[:, 0], d[:, 1])
        J = np.column_stack([-d / dist[:, None], -np.ones(len(points))])
        step = np.linalg.lstsq(J, -(dist - r), rcond=None)[0]
        c, r = c + step[:2], r + step[2]
    return c, r

"""
        + FIND,
    ),
    (
        "08-pillar",
        "points centred in place in fit_circle",
        """
def fit_circle(points):
    m = points.mean(axis=0)
    points -= m
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return m + [cx, cy], np.sqrt(d + cx**2 + cy**2)

"""
        + FIND,
    ),
    (
        "08-pillar",
        "solve without a thought of three readings on a line",
        FIT
        + """
def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    best = np.zeros(len(points), dtype=bool)
    for _ in range(tries):
        three = points[rng.choice(len(points), 3, replace=False)]
        cx, cy, d = np.linalg.solve(np.column_stack([2 * three, np.ones(3)]), (three**2).sum(axis=1))
        r = np.sqrt(max(d + cx**2 + cy**2, 0))
        inside = np.abs(np.hypot(points[:, 0] - cx, points[:, 1] - cy) - r) <= band
        if r <= largest and inside.sum() > best.sum():
            best = inside
    if best.sum() < needed:
        return None
    return *fit_circle(points[best]), best
""",
    ),
    (
        "08-pillar",
        "largest forgotten: walls are pillars",
        FIT
        + """
def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    best = np.zeros(len(points), dtype=bool)
    for _ in range(tries):
        three = points[rng.choice(len(points), 3, replace=False)]
        u, v = three[1] - three[0], three[2] - three[0]
        if abs(u[0] * v[1] - u[1] * v[0]) < 1e-9:
            continue
        c, r = fit_circle(three)
        inside = abs(np.hypot(*(points - c).T) - r) <= band
        if sum(inside) > sum(best):
            best = inside
    if sum(best) < needed:
        return None
    c, r = fit_circle(points[best])
    return c, r, best
""",
    ),
    (
        "08-pillar",
        "largest asked of the refit only",
        FIT
        + """
def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    best = np.zeros(len(points), dtype=bool)
    for _ in range(tries):
        three = points[rng.choice(len(points), 3, replace=False)]
        u, v = three[1] - three[0], three[2] - three[0]
        if abs(u[0] * v[1] - u[1] * v[0]) < 1e-9:
            continue
        c, r = fit_circle(three)
        inside = abs(np.hypot(*(points - c).T) - r) <= band
        if sum(inside) > sum(best):
            best = inside
    if sum(best) < needed:
        return None
    c, r = fit_circle(points[best])
    return (c, r, best) if r <= largest else None
""",
    ),
    (
        "08-pillar",
        "largest taken for the diameter",
        FIT + FIND.replace("if r > largest", "if 2 * r > largest"),
    ),
    (
        "08-pillar",
        "all within the disc counted, not only the ring",
        FIT
        + """
def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    best, count = None, 0
    for _ in range(tries):
        i, j, k = rng.choice(len(points), 3, replace=False)
        u, v = points[j] - points[i], points[k] - points[i]
        if abs(u[0] * v[1] - u[1] * v[0]) < 1e-9:
            continue
        c, r = fit_circle(points[[i, j, k]])
        inside = np.linalg.norm(points - c, axis=1) <= r + band
        if r <= largest and inside.sum() > count:
            best, count = inside, inside.sum()
    if count < needed:
        return None
    return fit_circle(points[best]) + (best,)
""",
    ),
    (
        "08-pillar",
        "outer half of the band forgotten",
        FIT
        + FIND.replace(
            "np.abs(np.linalg.norm(points - c, axis=1) - r) <= band",
            "(np.linalg.norm(points - c, axis=1) <= r + 1e-9) & (np.linalg.norm(points - c, axis=1) >= r - band)",
        ),
    ),
    (
        "08-pillar",
        "squares compared with the band",
        FIT
        + FIND.replace(
            "np.abs(np.linalg.norm(points - c, axis=1) - r) <= band",
            "np.abs(np.sum((points - c) ** 2, axis=1) - r**2) <= band",
        ),
    ),
    (
        "08-pillar",
        "best guess returned without a refit",
        FIT
        + """
def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    best = (None, None, np.zeros(len(points), dtype=bool))
    for _ in range(tries):
        three = points[rng.choice(len(points), 3, replace=False)]
        u, v = three[1] - three[0], three[2] - three[0]
        if abs(u[0] * v[1] - u[1] * v[0]) < 1e-9:
            continue
        c, r = fit_circle(three)
        inside = np.abs(np.hypot(*(points - c).T) - r) <= band
        if r <= largest and inside.sum() > best[2].sum():
            best = (c, r, inside)
    return best if best[2].sum() >= needed else None
""",
    ),
    (
        "08-pillar",
        "inside found anew after the refit: not those it was fitted to",
        FIT
        + FIND.replace(
            "    return c, r, winner",
            "    inside = np.abs(np.linalg.norm(points - c, axis=1) - r) <= band\n    return c, r, inside",
        ),
    ),
    (
        "08-pillar",
        "fewer than three readings: choice fails",
        FIT
        + """
def find_pillar(points, band, largest, needed, tries, rng):
    best = np.zeros(len(points), dtype=bool)
    for _ in range(tries):
        three = points[rng.choice(len(points), 3, replace=False)]
        u, v = three[1] - three[0], three[2] - three[0]
        if abs(u[0] * v[1] - u[1] * v[0]) < 1e-9:
            continue
        c, r = fit_circle(three)
        inside = np.abs(np.hypot(*(points - c).T) - r) <= band
        if r <= largest and inside.sum() > best.sum():
            best = inside
    if best.sum() < needed:
        return None
    return *fit_circle(points[best]), best
""",
    ),
    (
        "08-pillar",
        "exactly needed readings refused",
        FIT + FIND.replace("if votes < needed", "if votes <= needed"),
    ),
    (
        "08-pillar",
        "gives up at the first three on a line",
        FIT + FIND.replace("1e-9:\n            continue", "1e-9:\n            return None"),
    ),
    (
        "08-pillar",
        "three neighbours drawn, as if the readings were in order",
        FIT
        + """
def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    best = np.zeros(len(points), dtype=bool)
    for _ in range(tries):
        k = rng.integers(len(points) - 2)
        three = points[k : k + 3]
        u, v = three[1] - three[0], three[2] - three[0]
        if abs(u[0] * v[1] - u[1] * v[0]) < 1e-9:
            continue
        c, r = fit_circle(three)
        inside = np.abs(np.hypot(*(points - c).T) - r) <= band
        if r <= largest and inside.sum() > best.sum():
            best = inside
    if best.sum() < needed:
        return None
    return *fit_circle(points[best]), best
""",
    ),
    (
        "08-pillar",
        "numbers of the readings in place of a mask",
        FIT + FIND.replace("    return c, r, winner", "    return c, r, np.flatnonzero(winner)"),
    ),
    (
        "08-pillar",
        "first guess with enough readings taken",
        FIT
        + """
def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    for _ in range(tries):
        three = points[rng.choice(len(points), 3, replace=False)]
        u, v = three[1] - three[0], three[2] - three[0]
        if abs(u[0] * v[1] - u[1] * v[0]) < 1e-9:
            continue
        c, r = fit_circle(three)
        inside = np.abs(np.hypot(*(points - c).T) - r) <= band
        if r <= largest and inside.sum() >= needed:
            return *fit_circle(points[inside]), inside
    return None
""",
    ),
    (
        "08-pillar",
        "small pillars taken for lines: area limit of 0.01 m^2",
        FIT + FIND.replace("< 1e-9", "< 1e-2"),
    ),
    (
        "08-pillar",
        "last guess kept, not the best",
        FIT
        + FIND.replace(
            "        if inside.sum() > votes:\n            winner, votes = inside, inside.sum()",
            "        votes = max(votes, inside.sum())\n        winner = inside",
        ),
    ),
    (
        "08-pillar",
        "no guess counted: winner never set where all are too large",
        FIT
        + """
def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    guesses = []
    for _ in range(tries):
        three = points[rng.choice(len(points), 3, replace=False)]
        u, v = three[1] - three[0], three[2] - three[0]
        if abs(u[0] * v[1] - u[1] * v[0]) < 1e-9:
            continue
        c, r = fit_circle(three)
        if r <= largest:
            guesses.append(np.abs(np.hypot(*(points - c).T) - r) <= band)
    best = max(guesses, key=lambda g: g.sum())
    if best.sum() < needed:
        return None
    return *fit_circle(points[best]), best
""",
    ),
    (
        "08-pillar",
        "the same random numbers in each try",
        FIT
        + """
def find_pillar(points, band, largest, needed, tries, rng):
    if len(points) < 3:
        return None
    best = np.zeros(len(points), dtype=bool)
    for _ in range(tries):
        rng = np.random.default_rng(42)
        three = points[rng.choice(len(points), 3, replace=False)]
        u, v = three[1] - three[0], three[2] - three[0]
        if abs(u[0] * v[1] - u[1] * v[0]) < 1e-9:
            continue
        c, r = fit_circle(three)
        inside = np.abs(np.hypot(*(points - c).T) - r) <= band
        if r <= largest and inside.sum() > best.sum():
            best = inside
    if best.sum() < needed:
        return None
    return *fit_circle(points[best]), best
""",
    ),
]
