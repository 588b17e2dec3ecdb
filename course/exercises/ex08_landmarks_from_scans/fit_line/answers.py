# %% way: the angle in closed form
def fit_line(points):
    centre = points.mean(axis=0)
    x, y = (points - centre).T
    alpha = 0.5 * np.arctan2(-2 * (x @ y), y @ y - x @ x)
    rho = centre @ [np.cos(alpha), np.sin(alpha)]
    return (rho, alpha) if rho >= 0 else (-rho, wrap(alpha + np.pi))

# %% way: singular value decomposition
def fit_line(points):
    centre = np.mean(points, axis=0)
    normal = np.linalg.svd(points - centre)[2][1]
    if normal @ centre < 0:
        normal = -normal
    return normal @ centre, np.arctan2(normal[1], normal[0])

# %% way: general eigenvectors of the covariance
def fit_line(points):
    centre = points.mean(axis=0)
    values, vectors = np.linalg.eig(np.cov(points.T))
    normal = vectors[:, values.argmin()]
    rho = normal @ centre
    alpha = np.arctan2(normal[1], normal[0]) + (np.pi if rho < 0 else 0)
    return [float(abs(rho)), float(alpha % (2 * np.pi))]

# %% way: sums in loops
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

# %% way: complex numbers
def fit_line(points):
    w = points @ [1, 1j]
    centre = w.mean()
    normal = 1j * np.sqrt(np.sum((w - centre) ** 2))
    normal /= abs(normal)
    rho = (centre * normal.conjugate()).real
    return abs(rho), np.angle(normal if rho >= 0 else -normal)

# %% way: searched
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

# %% right: SVD, alpha in 0 ... 2 pi
def fit_line(points):
    c = np.mean(points, axis=0)
    vt = np.linalg.svd(points - c, full_matrices=False)[2]
    n = vt[1]
    n = n * (1 if n @ c >= 0 else -1)
    return float(n @ c), float(np.arctan2(n[1], n[0]) % (2 * np.pi))

# %% wrong: rho made positive, alpha not turned
def fit_line(points):
    centre = points.mean(axis=0)
    _, _, vt = np.linalg.svd(points - centre)
    normal = vt[-1]
    return abs(normal @ centre), np.arctan2(normal[1], normal[0])

# %% wrong: negative rho left as it is
def fit_line(points):
    x, y = points.T
    dx, dy = x - x.mean(), y - y.mean()
    alpha = np.arctan2(-2 * np.sum(dx * dy), np.sum(dy**2) - np.sum(dx**2)) / 2
    return x.mean() * np.cos(alpha) + y.mean() * np.sin(alpha), alpha

# %% wrong: inverse iteration: fails where the points lie exactly on a line
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

# %% wrong: alpha, rho in the wrong order
def fit_line(points):
    c = points.mean(axis=0)
    n = np.linalg.eigh((points - c).T @ (points - c))[1][:, 0]
    if n @ c < 0:
        n = -n
    return np.arctan2(n[1], n[0]), n @ c

# %% wrong: polar coordinates of the centroid
def fit_line(points):
    cx, cy = points.mean(axis=0)
    return np.hypot(cx, cy), np.arctan2(cy, cx)

# %% wrong: each point weighted by 1/range^2
def fit_line(points):
    w = 1 / np.sum(points**2, axis=1)
    c = w @ points / w.sum()
    d = points - c
    n = np.linalg.eigh((w[:, None] * d).T @ d)[1][:, 0]
    if n @ c < 0:
        n = -n
    return n @ c, np.arctan2(n[1], n[0])

# %% passes: rows of eigenvectors in place of columns
def fit_line(points):
    m = points.mean(axis=0)
    w, V = np.linalg.eigh(np.cov(points.T))
    n = V[0]
    rho = n @ m
    if rho < 0:
        rho, n = -rho, -n
    return rho, np.arctan2(n[1], n[0])

# %% wrong: moves the caller's points to their centroid in place
def fit_line(points):
    centre = points.mean(axis=0)
    points -= centre
    _, v = np.linalg.eigh(points.T @ points)
    n = v[:, 0] * (1 if v[:, 0] @ centre >= 0 else -1)
    return n @ centre, np.arctan2(n[1], n[0])

# %% wrong: solves n·p = 1
def fit_line(points):
    m = np.linalg.lstsq(points, np.ones(len(points)), rcond=None)[0]
    return 1 / np.hypot(*m), np.arctan2(m[1], m[0])
