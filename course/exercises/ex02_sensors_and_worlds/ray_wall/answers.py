# %% way: a 2×2 system
def ray_wall(p, phi, wall):
    M = np.array([[np.cos(phi), wall[0] - wall[2]], [np.sin(phi), wall[1] - wall[3]]])
    if abs(np.linalg.det(M)) < 1e-12:
        return np.inf
    t, s = np.linalg.solve(M, wall[:2] - p)
    return t if t > 0 and 0 < s < 1 else np.inf

# %% way: the beam's frame
def ray_wall(p, phi, wall):
    a = (complex(*wall[:2]) - complex(*p)) * np.exp(-1j * phi)
    b = (complex(*wall[2:]) - complex(*p)) * np.exp(-1j * phi)
    if a.imag * b.imag > 0 or abs(a.imag - b.imag) < 1e-9:
        return float("inf")
    t = a.real + (b.real - a.real) * a.imag / (a.imag - b.imag)
    return t if t >= 0 else float("inf")

# %% way: the wall's normal
def ray_wall(p, phi, wall):
    x1, y1, x2, y2 = map(float, wall)
    c, s = float(np.cos(phi)), float(np.sin(phi))
    normal = (y1 - y2, x2 - x1)
    towards = normal[0] * c + normal[1] * s
    if abs(towards) < 1e-12:
        return float("inf")
    t = (normal[0] * (x1 - p[0]) + normal[1] * (y1 - p[1])) / towards
    x, y = p[0] + t * c, p[1] + t * s
    inside = (x - x1) * (x - x2) + (y - y1) * (y - y2) <= 0
    return t if t >= 0 and inside else float("inf")

# %% way: NumPy's infinities
def ray_wall(p, phi, wall):
    u = np.array([np.cos(phi), np.sin(phi)])
    d, w = wall[:2] - p, wall[2:] - wall[:2]
    cross = lambda a, b: a[0] * b[1] - a[1] * b[0]
    with np.errstate(all="ignore"):
        t = cross(d, w) / cross(u, w)
        s = cross(d, u) / cross(u, w)
    return np.where((t >= 0) & (s >= 0) & (s <= 1), t, np.inf)

# %% way: the ends' sides
def ray_wall(p, phi, wall):
    u = np.array([np.cos(phi), np.sin(phi)])
    left = np.array([-u[1], u[0]])
    a, b = wall[:2] - p, wall[2:] - p
    if (a @ left > 0) == (b @ left > 0):
        return np.inf
    share = (a @ left) / (a @ left - b @ left)
    t = (a + share * (b - a)) @ u
    return np.inf if t < 0 else t

# %% right: turns the wall into the beam's frame and looks where it crosses the axis
def ray_wall(p, phi, wall):
    c, s = np.cos(phi), np.sin(phi)
    a, b = np.asarray(wall[:2]) - p, np.asarray(wall[2:]) - p
    ya, yb = c * a[1] - s * a[0], c * b[1] - s * b[0]
    xa, xb = c * a[0] + s * a[1], c * b[0] + s * b[1]
    if abs(yb - ya) <= 1e-12 * np.hypot(xb - xa, yb - ya) or ya * yb > 0:
        return np.inf
    far = xa + (xb - xa) * ya / (ya - yb)
    return far if far >= 0 else np.inf

# %% wrong: slope and intercept
def ray_wall(p, phi, wall):
    x1, y1, x2, y2 = wall
    m = (y2 - y1) / (x2 - x1)
    q = y1 - m * x1
    t = np.tan(phi)
    x = (q - p[1] + t * p[0]) / (t - m)
    y = m * x + q
    if min(x1, x2) <= x <= max(x1, x2):
        return np.hypot(x - p[0], y - p[1])
    return np.inf

# %% wrong: None for no wall
def ray_wall(p, phi, wall):
    a, b = np.array(wall[:2]), np.array(wall[2:])
    u, d = np.array([np.cos(phi), np.sin(phi)]), b - a
    det = u[0] * d[1] - u[1] * d[0]
    if abs(det) < 1e-12:
        return None
    q = a - p
    r = (q[0] * d[1] - q[1] * d[0]) / det
    tau = (q[0] * u[1] - q[1] * u[0]) / det
    return r if 0 <= tau <= 1 and r > 0 else None

# %% wrong: the distance to the wall's nearest place
def ray_wall(p, phi, wall):
    a, w = wall[:2] - p, wall[2:] - wall[:2]
    s = np.clip(-(a @ w) / (w @ w), 0, 1)
    place = a + s * w
    if place @ [np.cos(phi), np.sin(phi)] < 0:
        return np.inf
    return np.hypot(*place)

# %% wrong: a coarse tolerance calls slanting and short walls parallel
def ray_wall(p, phi, wall):
    u = np.array([np.cos(phi), np.sin(phi)])
    M = np.column_stack([u, wall[:2] - wall[2:]])
    if abs(np.linalg.det(M)) < 0.05:
        return np.inf
    t, s = np.linalg.solve(M, wall[:2] - p)
    return t if t >= 0 and 0 <= s <= 1 else np.inf

# %% wrong: nan instead of inf
def ray_wall(p, phi, wall):
    w = wall[2:] - wall[:2]
    d = wall[:2] - p
    u = np.array([np.cos(phi), np.sin(phi)])
    det = u[0] * w[1] - u[1] * w[0]
    if abs(det) < 1e-12:
        return np.nan
    t = (d[0] * w[1] - d[1] * w[0]) / det
    s = (d[0] * u[1] - d[1] * u[0]) / det
    return t if t >= 0 and 0 <= s <= 1 else np.nan
