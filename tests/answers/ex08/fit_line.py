"""Independent answers to 08-fit-line: right ones, and students' mistakes."""

RIGHT = [
    (
        "08-fit-line",
        "closed formula, alpha turned by arctan2 of the foot",
        """
def fit_line(points):
    x, y = np.asarray(points, dtype=float).T
    mx, my = x.mean(), y.mean()
    sxx = np.sum((x - mx) ** 2)
    syy = np.sum((y - my) ** 2)
    sxy = np.sum((x - mx) * (y - my))
    alpha = 0.5 * np.arctan2(-2 * sxy, syy - sxx)
    rho = mx * np.cos(alpha) + my * np.sin(alpha)
    if rho < 0:
        return -rho, alpha + np.pi        # the text does not ask for a wrapped angle
    return rho, alpha
""",
    ),
    (
        "08-fit-line",
        "SVD, alpha in 0 ... 2 pi",
        """
def fit_line(points):
    c = np.mean(points, axis=0)
    vt = np.linalg.svd(points - c, full_matrices=False)[2]
    n = vt[1]
    n = n * (1 if n @ c >= 0 else -1)
    return float(n @ c), float(np.arctan2(n[1], n[0]) % (2 * np.pi))
""",
    ),
    (
        "08-fit-line",
        "complex numbers: the way along is half the angle of the sum of squares",
        """
def fit_line(points):
    z = points[:, 0] + 1j * points[:, 1]
    m = z.mean()
    along = 0.5 * np.angle(np.sum((z - m) ** 2))
    n = np.exp(1j * (along + np.pi / 2))
    rho = (m * n.conjugate()).real
    if rho < 0:
        rho, n = -rho, -n
    return rho, np.angle(n)
""",
    ),
]

WRONG = [
    (
        "08-fit-line",
        "y = a x + b by polyfit",
        """
def fit_line(points):
    a, b = np.polyfit(points[:, 0], points[:, 1], 1)
    alpha = np.arctan2(1, -a)
    rho = b / np.hypot(1, a)
    if rho < 0:
        rho, alpha = -rho, wrap(alpha + np.pi)
    return rho, alpha
""",
    ),
    (
        "08-fit-line",
        "polyfit with x and y exchanged for steep walls: not the least distances",
        """
def fit_line(points):
    x, y = points.T
    if np.ptp(x) > np.ptp(y):
        a, b = np.polyfit(x, y, 1)
        normal, off = np.array([-a, 1.0]), b
    else:
        a, b = np.polyfit(y, x, 1)
        normal, off = np.array([1.0, -a]), b
    length = np.linalg.norm(normal)
    normal, rho = normal / length, off / length
    if rho < 0:
        normal, rho = -normal, -rho
    return rho, np.arctan2(normal[1], normal[0])
""",
    ),
    (
        "08-fit-line",
        "eigenvector of the largest eigenvalue: along the wall",
        """
def fit_line(points):
    mean = points.mean(axis=0)
    values, vectors = np.linalg.eigh(np.cov(points.T))
    n = vectors[:, np.argmax(values)]
    rho = n @ mean
    if rho < 0:
        n, rho = -n, -rho
    return rho, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-fit-line",
        "centroid not taken off before the scatter",
        """
def fit_line(points):
    S = points.T @ points / len(points)
    n = np.linalg.eigh(S)[1][:, 0]
    rho = n @ points.mean(axis=0)
    if rho < 0:
        n, rho = -n, -rho
    return rho, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-fit-line",
        "rho made positive, alpha not turned",
        """
def fit_line(points):
    centre = points.mean(axis=0)
    _, _, vt = np.linalg.svd(points - centre)
    normal = vt[-1]
    return abs(normal @ centre), np.arctan2(normal[1], normal[0])
""",
    ),
    (
        "08-fit-line",
        "negative rho left as it is",
        """
def fit_line(points):
    x, y = points.T
    dx, dy = x - x.mean(), y - y.mean()
    alpha = np.arctan2(-2 * np.sum(dx * dy), np.sum(dy**2) - np.sum(dx**2)) / 2
    return x.mean() * np.cos(alpha) + y.mean() * np.sin(alpha), alpha
""",
    ),
    (
        "08-fit-line",
        "arctan in place of arctan2: least and most scatter confused",
        """
def fit_line(points):
    x, y = points.T
    dx, dy = x - x.mean(), y - y.mean()
    sxx, syy, sxy = dx @ dx, dy @ dy, dx @ dy
    if sxx == syy:
        alpha = np.pi / 4
    else:
        alpha = 0.5 * np.arctan(2 * sxy / (sxx - syy))
    rho = x.mean() * np.cos(alpha) + y.mean() * np.sin(alpha)
    if rho < 0:
        rho, alpha = -rho, wrap(alpha + np.pi)
    return rho, alpha
""",
    ),
    (
        "08-fit-line",
        "alpha negated instead of turned by half a turn",
        """
def fit_line(points):
    c = points.mean(axis=0)
    n = np.linalg.svd(points - c, full_matrices=False)[2][1]
    rho, alpha = n @ c, np.arctan2(n[1], n[0])
    if rho < 0:
        rho = -rho
        alpha = -alpha
    return rho, alpha
""",
    ),
    (
        "08-fit-line",
        "points centred in place",
        """
def fit_line(points):
    centre = points.mean(axis=0)
    points -= centre
    vectors = np.linalg.eigh(points.T @ points)[1]
    n = vectors[:, 0]
    rho = n @ centre
    if rho < 0:
        n, rho = -n, -rho
    return rho, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-fit-line",
        "inverse iteration: fails where the points lie exactly on a line",
        """
def fit_line(points):
    c = points.mean(axis=0)
    S = np.cov(points, rowvar=False)
    M = np.linalg.inv(S)
    n = np.array([0.6, 0.8])
    for _ in range(200):
        n = M @ n
        n = n / np.linalg.norm(n)
    rho = n @ c
    if rho < 0:
        n, rho = -n, -rho
    return rho, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-fit-line",
        "alpha, rho in the wrong order",
        """
def fit_line(points):
    c = points.mean(axis=0)
    n = np.linalg.eigh((points - c).T @ (points - c))[1][:, 0]
    if n @ c < 0:
        n = -n
    return np.arctan2(n[1], n[0]), n @ c
""",
    ),
    (
        "08-fit-line",
        "least squares of n.p = 1: weighs distances by rho, not total least squares",
        """
def fit_line(points):
    w = np.linalg.lstsq(points, np.ones(len(points)), rcond=None)[0]
    size = np.hypot(w[0], w[1])
    return 1 / size, np.arctan2(w[1], w[0])
""",
    ),
    (
        "08-fit-line",
        "column of V transposed taken for its row",
        """
def fit_line(points):
    centre = np.mean(points, axis=0)
    _, _, vt = np.linalg.svd(points - centre)
    n = vt[:, 1]
    rho = n @ centre
    if rho < 0:
        rho, n = -rho, -n
    return rho, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-fit-line",
        "np.linalg.eig taken for sorted",
        """
def fit_line(points):
    centre = points.mean(axis=0)
    values, vectors = np.linalg.eig(np.cov(points.T))
    n = vectors[:, 0]
    if n @ centre < 0:
        n = -n
    return n @ centre, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-fit-line",
        "through the first and the last point only",
        """
def fit_line(points):
    (x1, y1), (x2, y2) = points[0], points[-1]
    n = np.array([y1 - y2, x2 - x1]) / np.hypot(x2 - x1, y2 - y1)
    rho = n @ points[0]
    if rho < 0:
        rho, n = -rho, -n
    return rho, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-fit-line",
        "the point nearest to the origin taken for the foot",
        """
def fit_line(points):
    r = np.hypot(points[:, 0], points[:, 1])
    k = np.argmin(r)
    return r[k], np.arctan2(points[k, 1], points[k, 0])
""",
    ),
    (
        "08-fit-line",
        "polar coordinates of the centroid",
        """
def fit_line(points):
    cx, cy = points.mean(axis=0)
    return np.hypot(cx, cy), np.arctan2(cy, cx)
""",
    ),
    (
        "08-fit-line",
        "alpha in degrees",
        """
def fit_line(points):
    c = points.mean(axis=0)
    n = np.linalg.svd(points - c, full_matrices=False)[2][1]
    if n @ c < 0:
        n = -n
    return n @ c, np.degrees(np.arctan2(n[1], n[0]))
""",
    ),
    (
        "08-fit-line",
        "each point weighted by 1/range^2",
        """
def fit_line(points):
    w = 1 / np.sum(points**2, axis=1)
    c = w @ points / w.sum()
    d = points - c
    n = np.linalg.eigh((w[:, None] * d).T @ d)[1][:, 0]
    if n @ c < 0:
        n = -n
    return n @ c, np.arctan2(n[1], n[0])
""",
    ),
    (
        "08-fit-line",
        "median for the centroid",
        """
def fit_line(points):
    c = np.median(points, axis=0)
    d = points - c
    n = np.linalg.eigh(d.T @ d)[1][:, 0]
    if n @ c < 0:
        n = -n
    return n @ c, np.arctan2(n[1], n[0])
""",
    ),
]
