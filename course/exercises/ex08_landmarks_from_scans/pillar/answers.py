# %% way: the centroid taken off, singular systems caught
def through(three):
    A = np.column_stack([2 * three, np.ones(3)])
    a, b, d = np.linalg.solve(A, np.sum(three**2, axis=1))
    return np.array([a, b]), np.sqrt(d + a * a + b * b)

def fit_circle(points):
    middle = points.mean(axis=0)
    p = points - middle
    c = np.linalg.solve(2 * p.T @ p, p.T @ np.sum(p**2, axis=1))
    return c + middle, np.sqrt(np.mean(np.sum((p - c) ** 2, axis=1)))

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

# %% way: of three on a line some circle, too
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

# %% way: all guesses at once
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

# %% way: complex numbers, counted again
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

# %% way: bisectors
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

# %% pasted: RANSAC for lines
def fit_circle(points):
    centre = points.mean(axis=0)
    x, y = (points - centre).T
    alpha = 0.5 * np.arctan2(-2 * x @ y, y @ y - x @ x)
    return np.array([np.cos(alpha), np.sin(alpha)]), centre @ [np.cos(alpha), np.sin(alpha)]

def find_pillar(points, band, largest, needed, tries, rng):
    best = np.zeros(len(points), dtype=bool)
    for _ in range(tries if len(points) > 1 else 0):
        normal, rho = fit_circle(points[rng.choice(len(points), 2, replace=False)])
        inside = np.abs(points @ normal - rho) <= band
        if inside.sum() > best.sum():
            best = inside
    if best.sum() < needed:
        return None
    return *fit_circle(points[best]), best

# %% pasted: the line of this notebook
def fit_circle(points):
    rho, alpha = fit_line(points)
    return rho * np.array([np.cos(alpha), np.sin(alpha)]), rho

def find_pillar(points, band, largest, needed, tries, rng):
    return (*fit_circle(points), np.ones(len(points), dtype=bool)) if len(points) > 2 else None

# %% right: permutation, determinant, norm
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return np.array([cx, cy]), np.sqrt(d + cx**2 + cy**2)


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

# %% right: lstsq on three readings on a line: a circle that is none
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return np.array([cx, cy]), np.sqrt(d + cx**2 + cy**2)


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

# %% wrong: radius without its root; draws with replacement
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

# %% wrong: centroid and mean distance
def fit_circle(points):
    centre = points.mean(axis=0)
    return centre, np.mean(np.linalg.norm(points - centre, axis=1))


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

# %% wrong: geometric least squares in place of the equation's
def start_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return np.array([cx, cy]), np.sqrt(d + cx**2 + cy**2)


def fit_circle(points):
    c, r = start_circle(points)
    for _ in range(20):
        d = points - c
        dist = np.hypot(d[:, 0], d[:, 1])
        J = np.column_stack([-d / dist[:, None], -np.ones(len(points))])
        step = np.linalg.lstsq(J, -(dist - r), rcond=None)[0]
        c, r = c + step[:2], r + step[2]
    return c, r


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

# %% wrong: points centred in place in fit_circle
def fit_circle(points):
    m = points.mean(axis=0)
    points -= m
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return m + [cx, cy], np.sqrt(d + cx**2 + cy**2)


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

# %% wrong: gives up at the first three on a line
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return np.array([cx, cy]), np.sqrt(d + cx**2 + cy**2)


def find_pillar(points, band, largest, needed, tries, rng):
    n = len(points)
    if n < 3:
        return None
    winner, votes = None, 0
    for _ in range(tries):
        three = points[rng.permutation(n)[:3]]
        if abs(np.linalg.det(np.column_stack([three, np.ones(3)]))) < 1e-9:
            return None
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

# %% wrong: numbers of the readings in place of a mask
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return np.array([cx, cy]), np.sqrt(d + cx**2 + cy**2)


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
    return c, r, np.flatnonzero(winner)

# %% wrong: first guess with enough readings taken
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return np.array([cx, cy]), np.sqrt(d + cx**2 + cy**2)


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

# %% wrong: no guess counted: winner never set where all are too large
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return np.array([cx, cy]), np.sqrt(d + cx**2 + cy**2)


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

# %% wrong: the same random numbers in each try
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return np.array([cx, cy]), np.sqrt(d + cx**2 + cy**2)


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

# %% wrong: radius without the centre
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    a, b, d = np.linalg.lstsq(A, (points**2).sum(axis=1), rcond=None)[0]
    return np.array([a, b]), np.sqrt(d)
