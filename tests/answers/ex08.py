"""Independent answers to exercise 08: right ones and students' mistakes."""

RIGHT, WRONG = [], []


def _r(task, what, source):
    RIGHT.append((task, what, source.strip() + "\n"))


def _w(task, what, source):
    WRONG.append((task, what, source.strip() + "\n"))


# ------------------------------------------------------------------ 08-fit-line
T = "08-fit-line"

_r(
    T,
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
)
_r(
    T,
    "SVD, alpha in 0 ... 2 pi",
    """
def fit_line(points):
    c = np.mean(points, axis=0)
    vt = np.linalg.svd(points - c, full_matrices=False)[2]
    n = vt[1]
    n = n * (1 if n @ c >= 0 else -1)
    return float(n @ c), float(np.arctan2(n[1], n[0]) % (2 * np.pi))
""",
)
_r(
    T,
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
)

_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
    "rho made positive, alpha not turned",
    """
def fit_line(points):
    centre = points.mean(axis=0)
    _, _, vt = np.linalg.svd(points - centre)
    normal = vt[-1]
    return abs(normal @ centre), np.arctan2(normal[1], normal[0])
""",
)
_w(
    T,
    "negative rho left as it is",
    """
def fit_line(points):
    x, y = points.T
    dx, dy = x - x.mean(), y - y.mean()
    alpha = np.arctan2(-2 * np.sum(dx * dy), np.sum(dy**2) - np.sum(dx**2)) / 2
    return x.mean() * np.cos(alpha) + y.mean() * np.sin(alpha), alpha
""",
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
    "alpha, rho in the wrong order",
    """
def fit_line(points):
    c = points.mean(axis=0)
    n = np.linalg.eigh((points - c).T @ (points - c))[1][:, 0]
    if n @ c < 0:
        n = -n
    return np.arctan2(n[1], n[0]), n @ c
""",
)
_w(
    T,
    "least squares of n.p = 1: weighs distances by rho, not total least squares",
    """
def fit_line(points):
    w = np.linalg.lstsq(points, np.ones(len(points)), rcond=None)[0]
    size = np.hypot(w[0], w[1])
    return 1 / size, np.arctan2(w[1], w[0])
""",
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
    "the point nearest to the origin taken for the foot",
    """
def fit_line(points):
    r = np.hypot(points[:, 0], points[:, 1])
    k = np.argmin(r)
    return r[k], np.arctan2(points[k, 1], points[k, 0])
""",
)
_w(
    T,
    "polar coordinates of the centroid",
    """
def fit_line(points):
    cx, cy = points.mean(axis=0)
    return np.hypot(cx, cy), np.arctan2(cy, cx)
""",
)
_w(
    T,
    "alpha in degrees",
    """
def fit_line(points):
    c = points.mean(axis=0)
    n = np.linalg.svd(points - c, full_matrices=False)[2][1]
    if n @ c < 0:
        n = -n
    return n @ c, np.degrees(np.arctan2(n[1], n[0]))
""",
)
_w(
    T,
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
)
_w(
    T,
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
)

# ------------------------------------------------------------------ 08-corner
T = "08-corner"

_r(
    T,
    "Cramer's rule and one 2 x 4 Jacobian",
    """
def corner(z1, R1, z2, R2):
    (r1, a1), (r2, a2) = z1, z2
    c1, s1, c2, s2 = np.cos(a1), np.sin(a1), np.cos(a2), np.sin(a2)
    D = c1 * s2 - s1 * c2
    x = (r1 * s2 - r2 * s1) / D
    y = (c1 * r2 - c2 * r1) / D
    t1 = -s1 * x + c1 * y
    t2 = -s2 * x + c2 * y
    J = np.array([[s2, -t1 * s2, -s1, t2 * s1], [-c2, t1 * c2, c1, -t2 * c1]]) / D
    R = np.zeros((4, 4))
    R[:2, :2] = R1
    R[2:, 2:] = R2
    return np.array([x, y]), J @ R @ J.T
""",
)
_r(
    T,
    "complex-step derivative of the corner",
    """
def corner(z1, R1, z2, R2):
    def meet(r1, a1, r2, a2):
        D = np.sin(a2 - a1)
        return np.array([r1 * np.sin(a2) - r2 * np.sin(a1), r2 * np.cos(a1) - r1 * np.cos(a2)]) / D

    z = np.concatenate([z1, z2]).astype(complex)
    J = np.column_stack([meet(*(z + 1e-30j * e)).imag / 1e-30 for e in np.eye(4)])
    return meet(*z).real, J[:, :2] @ R1 @ J[:, :2].T + J[:, 2:] @ R2 @ J[:, 2:].T
""",
)
_r(
    T,
    "variances of n.p of both lines, carried through the inverse of N",
    """
def corner(z1, R1, z2, R2):
    a = np.array([z1[1], z2[1]])
    N, N_dash = np.stack([np.cos(a), np.sin(a)], 1), np.stack([-np.sin(a), np.cos(a)], 1)
    inverse = np.linalg.inv(N)
    p = inverse @ np.array([z1[0], z2[0]])
    g = np.stack([np.ones(2), -(N_dash @ p)], 1)
    var = np.einsum("ki,kij,kj->k", g, np.stack([R1, R2]), g)
    return p, inverse @ np.diag(var) @ inverse.T
""",
)

_w(
    T,
    "sign of the alpha term",
    """
def corner(z1, R1, z2, R2):
    a = np.array([z1[1], z2[1]])
    N = np.column_stack([np.cos(a), np.sin(a)])
    Ninv = np.linalg.inv(N)
    p = Ninv @ [z1[0], z2[0]]
    t = np.column_stack([-np.sin(a), np.cos(a)]) @ p
    J1 = Ninv[:, :1] @ np.array([[1, t[0]]])
    J2 = Ninv[:, 1:] @ np.array([[1, t[1]]])
    return p, J1 @ R1 @ J1.T + J2 @ R2 @ J2.T
""",
)
_w(
    T,
    "correlation of rho and alpha ignored",
    """
def corner(z1, R1, z2, R2):
    a = np.array([z1[1], z2[1]])
    Ninv = np.linalg.inv(np.column_stack([np.cos(a), np.sin(a)]))
    p = Ninv @ np.array([z1[0], z2[0]])
    P = np.zeros((2, 2))
    for k, R in enumerate([R1, R2]):
        t = -np.sin(a[k]) * p[0] + np.cos(a[k]) * p[1]
        var = R[0, 0] + t**2 * R[1, 1]
        P += var * np.outer(Ninv[:, k], Ninv[:, k])
    return p, P
""",
)
_w(
    T,
    "only rho is unsure: alpha term forgotten",
    """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    p = np.linalg.solve(N, np.array([z1[0], z2[0]]))
    Ni = np.linalg.inv(N)
    return p, Ni @ np.diag([R1[0, 0], R2[0, 0]]) @ Ni.T
""",
)
_w(
    T,
    "N transposed: normals as columns",
    """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.cos(z2[1])], [np.sin(z1[1]), np.sin(z2[1])]])
    Ni = np.linalg.inv(N)
    p = Ni @ [z1[0], z2[0]]
    P = np.zeros((2, 2))
    for k, (z, R) in enumerate([(z1, R1), (z2, R2)]):
        n_dash = np.array([-np.sin(z[1]), np.cos(z[1])])
        J = np.outer(Ni[:, k], [1, -n_dash @ p])
        P += J @ R @ J.T
    return p, P
""",
)
_w(
    T,
    "J' R J in place of J R J'",
    """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    Ni = np.linalg.inv(N)
    p = Ni @ [z1[0], z2[0]]
    n1d, n2d = (np.array([-np.sin(z[1]), np.cos(z[1])]) for z in (z1, z2))
    J1 = np.outer(Ni[:, 0], [1, -n1d @ p])
    J2 = np.outer(Ni[:, 1], [1, -n2d @ p])
    return p, J1.T @ R1 @ J1 + J2.T @ R2 @ J2
""",
)
_w(
    T,
    "row of the inverse taken for its column",
    """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    inv = np.linalg.inv(N)
    p = inv @ [z1[0], z2[0]]
    P = 0
    for row, n, R in zip(inv, N, (R1, R2)):
        J = np.outer(row, [1, n[1] * p[0] - n[0] * p[1]])
        P = P + J @ R @ J.T
    return p, P
""",
)
_w(
    T,
    "information form: fails for a line that is known exactly",
    """
def corner(z1, R1, z2, R2):
    p = np.linalg.solve(
        [[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]], [z1[0], z2[0]]
    )
    info = np.zeros((2, 2))
    for (rho, alpha), R in ((z1, R1), (z2, R2)):
        n, n_dash = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
        g = np.array([1, -n_dash @ p])
        info += np.outer(n, n) / (g @ R @ g)
    return p, np.linalg.inv(info)
""",
)
_w(
    T,
    "walls taken for perpendicular",
    """
def corner(z1, R1, z2, R2):
    n1 = np.array([np.cos(z1[1]), np.sin(z1[1])])
    n2 = np.array([np.cos(z2[1]), np.sin(z2[1])])
    p = z1[0] * n1 + z2[0] * n2
    P = np.zeros((2, 2))
    for n, R in ((n1, R1), (n2, R2)):
        g = np.array([1, -(np.array([-n[1], n[0]]) @ p)])
        P += (g @ R @ g) * np.outer(n, n)
    return p, P
""",
)
_w(
    T,
    "slope and intercept: a wall with sin alpha = 0 has none",
    """
def corner(z1, R1, z2, R2):
    m1, b1 = -1 / np.tan(z1[1]), z1[0] / np.sin(z1[1])
    m2, b2 = -1 / np.tan(z2[1]), z2[0] / np.sin(z2[1])
    x = (b2 - b1) / (m1 - m2)
    p = np.array([x, m1 * x + b1])
    P = np.zeros((2, 2))
    Ni = np.linalg.inv([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    for k, (z, R) in enumerate([(z1, R1), (z2, R2)]):
        J = np.outer(Ni[:, k], [1, np.sin(z[1]) * p[0] - np.cos(z[1]) * p[1]])
        P += J @ R @ J.T
    return p, P
""",
)
_w(
    T,
    "negative rho made positive",
    """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    p = np.linalg.solve(N, np.abs([z1[0], z2[0]]))
    P = np.zeros((2, 2))
    Ni = np.linalg.inv(N)
    for k, R in enumerate((R1, R2)):
        J = np.outer(Ni[:, k], [1, N[k, 1] * p[0] - N[k, 0] * p[1]])
        P = P + J @ R @ J.T
    return p, P
""",
)
_w(
    T,
    "lines turned to rho >= 0 in place: arguments changed",
    """
def corner(z1, R1, z2, R2):
    for z in (z1, z2):
        z[1] = wrap(z[1])
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    p = np.linalg.solve(N, [z1[0], z2[0]])
    Ni, P = np.linalg.inv(N), np.zeros((2, 2))
    for k, R in enumerate((R1, R2)):
        J = np.outer(Ni[:, k], [1, N[k, 1] * p[0] - N[k, 0] * p[1]])
        P = P + J @ R @ J.T
    return p, P
""",
)
_w(
    T,
    "R1 used for both lines",
    """
def corner(z1, R1, z2, R2):
    def jac(k):
        return np.outer(Ni[:, k], [1, -(np.array([-N[k, 1], N[k, 0]]) @ p)])

    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    Ni = np.linalg.inv(N)
    p = Ni @ np.array([z1[0], z2[0]])
    return p, jac(0) @ R1 @ jac(0).T + jac(1) @ R1 @ jac(1).T
""",
)
_w(
    T,
    "Jacobian by differences with a coarse step",
    """
def corner(z1, R1, z2, R2):
    def where(z):
        N = [[np.cos(z[1]), np.sin(z[1])], [np.cos(z[3]), np.sin(z[3])]]
        return np.linalg.solve(N, [z[0], z[2]])

    z = np.concatenate([z1, z2])
    p, h = where(z), 0.01
    J = np.array([(where(z + h * e) - p) / h for e in np.eye(4)]).T
    R = np.block([[R1, np.zeros((2, 2))], [np.zeros((2, 2)), R2]])
    return p, J @ R @ J.T
""",
)
_w(
    T,
    "P from 2000 samples",
    """
def corner(z1, R1, z2, R2):
    def where(a, b):
        N = [[np.cos(a[1]), np.sin(a[1])], [np.cos(b[1]), np.sin(b[1])]]
        return np.linalg.solve(N, [a[0], b[0]])

    rng = np.random.default_rng(0)
    A = rng.multivariate_normal(z1, R1, 2000)
    B = rng.multivariate_normal(z2, R2, 2000)
    return where(z1, z2), np.cov(np.array([where(a, b) for a, b in zip(A, B)]).T)
""",
)
_w(
    T,
    "n' taken at the foot of each line, not at the corner",
    """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    p = np.linalg.solve(N, [z1[0], z2[0]])
    P = np.zeros((2, 2))
    for k, (z, R) in enumerate(((z1, R1), (z2, R2))):
        foot = z[0] * N[1 - k]
        across = np.array([-N[k, 1], N[k, 0]])
        J = np.outer(np.linalg.inv(N)[:, k], [1, -(across @ foot)])
        P = P + J @ R @ J.T
    return p, P
""",
)
_w(
    T,
    "standard deviations in place of P",
    """
def corner(z1, R1, z2, R2):
    a = np.array([z1[1], z2[1]])
    Ni = np.linalg.inv(np.column_stack([np.cos(a), np.sin(a)]))
    p = Ni @ np.array([z1[0], z2[0]])
    P = np.zeros((2, 2))
    for k, R in enumerate([R1, R2]):
        J = np.outer(Ni[:, k], [1, np.sin(a[k]) * p[0] - np.cos(a[k]) * p[1]])
        P += J @ R @ J.T
    return p, np.sqrt(np.diag(np.diag(P)))
""",
)
_w(
    T,
    "walls less than 20 degrees from parallel refused",
    """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    if abs(np.linalg.det(N)) < np.sin(np.radians(20)):
        return None
    Ni = np.linalg.inv(N)
    p, P = Ni @ [z1[0], z2[0]], np.zeros((2, 2))
    for k, R in enumerate((R1, R2)):
        J = np.outer(Ni[:, k], [1, N[k, 1] * p[0] - N[k, 0] * p[1]])
        P = P + J @ R @ J.T
    return p, P
""",
)
_w(
    T,
    "sum begun in R1: argument changed",
    """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    Ni = np.linalg.inv(N)
    p = Ni @ [z1[0], z2[0]]
    Js = [np.outer(Ni[:, k], [1, N[k, 1] * p[0] - N[k, 0] * p[1]]) for k in (0, 1)]
    P = R1
    P[:] = Js[0] @ R1 @ Js[0].T
    P += Js[1] @ R2 @ Js[1].T
    return p, P
""",
)
_w(
    T,
    "both errors treated as one: (J1 + J2)(R1 + R2)(J1 + J2)'",
    """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    Ni = np.linalg.inv(N)
    p = Ni @ [z1[0], z2[0]]
    J = sum(np.outer(Ni[:, k], [1, N[k, 1] * p[0] - N[k, 0] * p[1]]) for k in (0, 1))
    return p, J @ (R1 + R2) @ J.T
""",
)

# ------------------------------------------------------------------ 08-associate
T = "08-associate"

_r(
    T,
    "matrix of distances, smallest taken out until none is in the gate",
    """
def associate(z, expected, S, gate):
    m, N = len(z), len(expected)
    answer = [None] * m
    if m == 0 or N == 0:
        return answer
    v = z[:, None, :] - expected[None, :, :]
    v[..., 1] = wrap(v[..., 1])
    D = np.einsum("ijk,jkl,ijl->ij", v, np.linalg.inv(S), v)
    while True:
        i, j = np.unravel_index(np.argmin(D), D.shape)
        if not D[i, j] <= gate:
            return answer
        answer[i] = int(j)
        D[i, :] = np.inf
        D[:, j] = np.inf
        if np.isinf(D).all():
            return answer
""",
)
_r(
    T,
    "recursion on what is left, wrapped by arctan2",
    """
def associate(z, expected, S, gate):
    def d2(i, j):
        dr, da = z[i][0] - expected[j][0], z[i][1] - expected[j][1]
        v = np.array([dr, np.arctan2(np.sin(da), np.cos(da))])
        return v @ np.linalg.solve(S[j], v)

    table = {(i, j): d2(i, j) for i in range(len(z)) for j in range(len(expected))}

    def pair(left):
        if not left:
            return {}
        i, j = min(left, key=left.get)
        return {i: j} | pair({k: d for k, d in left.items() if k[0] != i and k[1] != j})

    found = pair({k: d for k, d in table.items() if d <= gate})
    return [found.get(i) for i in range(len(z))]
""",
)

_w(
    T,
    "angle not wrapped",
    """
def associate(z, expected, S, gate):
    cand = []
    for i, a in enumerate(z):
        for j, b in enumerate(expected):
            v = a - b
            cand.append((v @ np.linalg.solve(S[j], v), i, j))
    result, used = [None] * len(z), set()
    for d, i, j in sorted(cand):
        if d <= gate and result[i] is None and j not in used:
            result[i] = j
            used.add(j)
    return result
""",
)
_w(
    T,
    "Euclid in place of Mahalanobis",
    """
def associate(z, expected, S, gate):
    pairs = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            pairs.append((v[0] ** 2 + wrap(v[1]) ** 2, i, j))
    result, used = [None] * len(z), set()
    for d, i, j in sorted(pairs):
        if d <= gate and result[i] is None and j not in used:
            result[i] = j
            used.add(j)
    return result
""",
)
_w(
    T,
    "each sighting takes its nearest, walls used more than once",
    """
def associate(z, expected, S, gate):
    result = []
    for sighting in z:
        best, best_d = None, gate
        for j in range(len(expected)):
            v = sighting - expected[j]
            v[1] = wrap(v[1])
            d = v @ np.linalg.inv(S[j]) @ v
            if d <= best_d:
                best, best_d = j, d
        result.append(best)
    return result
""",
)
_w(
    T,
    "greedy in the order of the sightings",
    """
def associate(z, expected, S, gate):
    free = set(range(len(expected)))
    result = []
    for sighting in z:
        best, best_d = None, gate
        for j in sorted(free):
            v = sighting - expected[j]
            v[1] = wrap(v[1])
            d = v @ np.linalg.inv(S[j]) @ v
            if d <= best_d:
                best, best_d = j, d
        if best is not None:
            free.remove(best)
        result.append(best)
    return result
""",
)
_w(
    T,
    "greedy in the order of the walls",
    """
def associate(z, expected, S, gate):
    result = [None] * len(z)
    for j, (wall, cov) in enumerate(zip(expected, S)):
        inv = np.linalg.inv(cov)
        options = []
        for i in range(len(z)):
            if result[i] is None:
                v = np.array([z[i, 0] - wall[0], wrap(z[i, 1] - wall[1])])
                options.append((v @ inv @ v, i))
        if options and min(options)[0] <= gate:
            result[min(options)[1]] = j
    return result
""",
)
_w(
    T,
    "d in place of d^2 under the gate",
    """
def associate(z, expected, S, gate):
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            todo.append((np.sqrt(v @ np.linalg.inv(S[j]) @ v), i, j))
    out, taken = [None] * len(z), []
    for d, i, j in sorted(todo):
        if d <= gate and out[i] is None and j not in taken:
            out[i] = j
            taken.append(j)
    return out
""",
)
_w(
    T,
    "a pair exactly at the gate refused",
    """
def associate(z, expected, S, gate):
    distances = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            distances.append((v @ np.linalg.inv(S[j]) @ v, i, j))
    pairs = {}
    for d2, i, j in sorted(distances):
        if d2 < gate and i not in pairs and j not in pairs.values():
            pairs[i] = j
    return [pairs.get(i) for i in range(len(z))]
""",
)
_w(
    T,
    "angles of the sightings changed in place",
    """
def associate(z, expected, S, gate):
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i]
            v -= expected[j]
            v[1] = wrap(v[1])
            todo.append((v @ np.linalg.inv(S[j]) @ v, i, j))
            v += expected[j]
    out, taken = [None] * len(z), set()
    for d, i, j in sorted(todo):
        if d <= gate and out[i] is None and j not in taken:
            out[i] = j
            taken.add(j)
    return out
""",
)
_w(
    T,
    "S of the first wall for all",
    """
def associate(z, expected, S, gate):
    if len(expected) == 0:
        return [None] * len(z)
    inverse = np.linalg.inv(S[0])
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = np.array([z[i, 0] - expected[j, 0], wrap(z[i, 1] - expected[j, 1])])
            todo.append((v @ inverse @ v, i, j))
    out, taken = [None] * len(z), set()
    for d, i, j in sorted(todo):
        if d <= gate and out[i] is None and j not in taken:
            out[i] = j
            taken.add(j)
    return out
""",
)
_w(
    T,
    "only the variances of S",
    """
def associate(z, expected, S, gate):
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            dr, da = z[i, 0] - expected[j, 0], wrap(z[i, 1] - expected[j, 1])
            todo.append((dr**2 / S[j, 0, 0] + da**2 / S[j, 1, 1], i, j))
    out, taken = [None] * len(z), set()
    for d, i, j in sorted(todo):
        if d <= gate and out[i] is None and j not in taken:
            out[i] = j
            taken.add(j)
    return out
""",
)
_w(
    T,
    "argmin of an empty map",
    """
def associate(z, expected, S, gate):
    out = [None] * len(z)
    if len(z) == 0:
        return out
    v = z[:, None] - expected[None]
    v[:, :, 1] = wrap(v[:, :, 1])
    D = np.einsum("ijk,jkl,ijl->ij", v, np.linalg.inv(S), v)
    for _ in range(len(z)):
        i, j = divmod(int(D.argmin()), D.shape[1])
        if D[i, j] > gate:
            break
        out[i] = j
        D[i], D[:, j] = np.inf, np.inf
    return out
""",
)
_w(
    T,
    "an empty scan: min of nothing",
    """
def associate(z, expected, S, gate):
    if len(expected) == 0:
        return [None] * len(z)
    v = z[:, None] - expected[None]
    v[:, :, 1] = wrap(v[:, :, 1])
    D = np.einsum("ijk,jkl,ijl->ij", v, np.linalg.inv(S), v)
    out = [None] * len(z)
    while D.min() <= gate:
        i, j = np.unravel_index(D.argmin(), D.shape)
        out[i] = int(j)
        D[i, :] = D[:, j] = np.inf
    return out
""",
)
_w(
    T,
    "-1 in place of None",
    """
def associate(z, expected, S, gate):
    out, used = [-1] * len(z), set()
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            todo.append((float(v @ np.linalg.inv(S[j]) @ v), i, j))
    todo.sort()
    for d, i, j in todo:
        if d <= gate and out[i] < 0 and j not in used:
            out[i] = j
            used.add(j)
    return out
""",
)
_w(
    T,
    "wall 0 taken for no wall",
    """
def associate(z, expected, S, gate):
    out, used = {}, set()
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            todo.append((float(v @ np.linalg.inv(S[j]) @ v), i, j))
    for d, i, j in sorted(todo):
        if d <= gate and not out.get(i) and j not in used:
            out[i] = j
            used.add(j)
    return [out.get(i) or None for i in range(len(z))]
""",
)
_w(
    T,
    "least sum of all distances (Hungarian), then the gate",
    """
def associate(z, expected, S, gate):
    from scipy.optimize import linear_sum_assignment

    out = [None] * len(z)
    if len(z) == 0 or len(expected) == 0:
        return out
    v = z[:, None] - expected[None]
    v[..., 1] = wrap(v[..., 1])
    D = np.einsum("ijk,jkl,ijl->ij", v, np.linalg.inv(S), v)
    for i, j in zip(*linear_sum_assignment(D)):
        if D[i, j] <= gate:
            out[i] = int(j)
    return out
""",
)
_w(
    T,
    "both angles wrapped, not their difference",
    """
def associate(z, expected, S, gate):
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = np.array([z[i, 0] - expected[j, 0], wrap(z[i, 1]) - wrap(expected[j, 1])])
            todo.append((v @ np.linalg.inv(S[j]) @ v, i, j))
    out, taken = [None] * len(z), set()
    for d, i, j in sorted(todo):
        if d <= gate and out[i] is None and j not in taken:
            out[i] = j
            taken.add(j)
    return out
""",
)
_w(
    T,
    "wrapped angle made positive: its sign lost",
    """
def associate(z, expected, S, gate):
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            da = abs(z[i, 1] - expected[j, 1]) % (2 * np.pi)
            da = min(da, 2 * np.pi - da)
            v = np.array([z[i, 0] - expected[j, 0], da])
            todo.append((v @ np.linalg.inv(S[j]) @ v, i, j))
    out, taken = [None] * len(z), set()
    for d, i, j in sorted(todo):
        if d <= gate and out[i] is None and j not in taken:
            out[i] = j
            taken.add(j)
    return out
""",
)
_w(
    T,
    "rho wrapped as well",
    """
def associate(z, expected, S, gate):
    out, taken = [None] * len(z), set()
    todo = []
    for i, seen in enumerate(z):
        for j, wall in enumerate(expected):
            v = wrap(seen - wall)
            todo.append((v @ np.linalg.inv(S[j]) @ v, i, j))
    for d, i, j in sorted(todo):
        if d <= gate and out[i] is None and j not in taken:
            out[i] = j
            taken.add(j)
    return out
""",
)
_w(
    T,
    "rows and columns deleted: the numbers shift",
    """
def associate(z, expected, S, gate):
    m, N = len(z), len(expected)
    out = [None] * m
    if m == 0 or N == 0:
        return out
    v = z[:, None] - expected[None]
    v[..., 1] = wrap(v[..., 1])
    D = np.einsum("ijk,jkl,ijl->ij", v, np.linalg.inv(S), v)
    while D.size and D.min() <= gate:
        i, j = np.unravel_index(D.argmin(), D.shape)
        out[i] = int(j)
        D = np.delete(np.delete(D, i, axis=0), j, axis=1)
    return out
""",
)
_w(
    T,
    "only mutual nearest neighbours: no next nearest",
    """
def associate(z, expected, S, gate):
    m, N = len(z), len(expected)
    if m == 0 or N == 0:
        return [None] * m
    v = z[:, None] - expected[None]
    v[..., 1] = wrap(v[..., 1])
    D = np.einsum("ijk,jkl,ijl->ij", v, np.linalg.inv(S), v)
    out = []
    for i in range(m):
        j = int(D[i].argmin())
        out.append(j if D[i, j] <= gate and D[:, j].argmin() == i else None)
    return out
""",
)
_w(
    T,
    "the first wall under the gate, not the nearest",
    """
def associate(z, expected, S, gate):
    out = []
    for seen in z:
        mine = None
        for j in range(len(expected)):
            v = seen - expected[j]
            v[1] = wrap(v[1])
            if j not in out and v @ np.linalg.solve(S[j], v) <= gate:
                mine = j
                break
        out.append(mine)
    return out
""",
)

# ------------------------------------------------------------------ 08-pillar
T = "08-pillar"

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

_r(T, "permutation, determinant, norm", FIT + FIND)
_r(
    T,
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
)

_w(
    T,
    "radius is the root of d alone",
    """
def fit_circle(points):
    A = np.column_stack([2 * points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return np.array([cx, cy]), np.sqrt(abs(d))

"""
    + FIND,
)
_w(
    T,
    "r squared returned",
    """
def fit_circle(points):
    A = np.c_[2 * points, np.ones(len(points))]
    b = (points**2).sum(1)
    cx, cy, d = np.linalg.lstsq(A, b, rcond=None)[0]
    return np.array([cx, cy]), d + cx**2 + cy**2

"""
    + FIND,
)
_w(
    T,
    "factor 2 of c.p forgotten",
    """
def fit_circle(points):
    A = np.column_stack([points, np.ones(len(points))])
    cx, cy, d = np.linalg.lstsq(A, np.sum(points**2, axis=1), rcond=None)[0]
    return np.array([cx, cy]), np.sqrt(abs(d + cx**2 + cy**2))

"""
    + FIND,
)
_w(
    T,
    "centroid and mean distance",
    """
def fit_circle(points):
    centre = points.mean(axis=0)
    return centre, np.mean(np.linalg.norm(points - centre, axis=1))

"""
    + FIND,
)
_w(
    T,
    "circle through the first three points only",
    """
def fit_circle(points):
    A = np.column_stack([2 * points[:3], np.ones(3)])
    cx, cy, d = np.linalg.solve(A, np.sum(points[:3] ** 2, axis=1))
    return np.array([cx, cy]), np.sqrt(d + cx**2 + cy**2)

"""
    + FIND,
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(T, "largest taken for the diameter", FIT + FIND.replace("if r > largest", "if 2 * r > largest"))
_w(
    T,
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
)
_w(
    T,
    "outer half of the band forgotten",
    FIT
    + FIND.replace(
        "np.abs(np.linalg.norm(points - c, axis=1) - r) <= band",
        "(np.linalg.norm(points - c, axis=1) <= r + 1e-9) & (np.linalg.norm(points - c, axis=1) >= r - band)",
    ),
)
_w(
    T,
    "squares compared with the band",
    FIT
    + FIND.replace(
        "np.abs(np.linalg.norm(points - c, axis=1) - r) <= band",
        "np.abs(np.sum((points - c) ** 2, axis=1) - r**2) <= band",
    ),
)
_w(
    T,
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
)
_w(
    T,
    "inside found anew after the refit: not those it was fitted to",
    FIT
    + FIND.replace(
        "    return c, r, winner",
        "    inside = np.abs(np.linalg.norm(points - c, axis=1) - r) <= band\n    return c, r, inside",
    ),
)
_w(
    T,
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
)
_w(
    T,
    "exactly needed readings refused",
    FIT + FIND.replace("if votes < needed", "if votes <= needed"),
)
_w(
    T,
    "gives up at the first three on a line",
    FIT + FIND.replace("1e-9:\n            continue", "1e-9:\n            return None"),
)
_w(
    T,
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
)
_w(
    T,
    "numbers of the readings in place of a mask",
    FIT + FIND.replace("    return c, r, winner", "    return c, r, np.flatnonzero(winner)"),
)
_w(
    T,
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
)
_w(
    T,
    "small pillars taken for lines: area limit of 0.01 m^2",
    FIT + FIND.replace("< 1e-9", "< 1e-2"),
)
_w(
    T,
    "last guess kept, not the best",
    FIT
    + FIND.replace(
        "        if inside.sum() > votes:\n            winner, votes = inside, inside.sum()",
        "        votes = max(votes, inside.sum())\n        winner = inside",
    ),
)
_w(
    T,
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
)
_w(
    T,
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
)

# ------------------------------------------------------------------ 08-segments
T = "08-segments"

_r(
    T,
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
)
_r(
    T,
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
)

_w(
    T,
    "one wall for all",
    """
def segment(points, share):
    return np.zeros(len(points), dtype=int)
""",
)
_w(
    T,
    "all clutter",
    """
def segment(points, share):
    return np.full(len(points), -1)
""",
)
_w(
    T,
    "each reading its own wall",
    """
def segment(points, share):
    return np.arange(len(points))
""",
)
_w(
    T,
    "eight sectors of the bearing",
    """
def segment(points, share):
    bearing = np.arctan2(points[:, 1], points[:, 0]) + np.pi
    return (bearing / (2 * np.pi / 8)).astype(int) % 8
""",
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
    "the label is the rounded direction of the normal from neighbours",
    """
def segment(points, share):
    step = np.roll(points, -1, axis=0) - points
    alpha = wrap(np.arctan2(step[:, 1], step[:, 0]) - np.pi / 2)
    return (np.round(np.degrees(alpha) / 20).astype(int)) % 18
""",
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
    "five walls at most, of the example's room, with guesses from anywhere",
    """
def segment(points, share):
    room = [(2.0, 0.3), (1.6, 1.87), (3.1, -2.84), (1.2, -1.27), (2.2, 0.95)]
    off = np.array([np.abs(points @ [np.cos(a), np.sin(a)] - r) for r, a in room])
    return np.where(off.min(axis=0) < 0.1, off.argmin(axis=0), -1)
""",
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
_w(
    T,
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
)
