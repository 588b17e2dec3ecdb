"""Right ways of 02-ray-wall."""

WAYS = {
    "a 2×2 system": """
def ray_wall(p, phi, wall):
    M = np.array([[np.cos(phi), wall[0] - wall[2]], [np.sin(phi), wall[1] - wall[3]]])
    if abs(np.linalg.det(M)) < 1e-12:
        return np.inf
    t, s = np.linalg.solve(M, wall[:2] - p)
    return t if t > 0 and 0 < s < 1 else np.inf
""",
    "the beam's frame": """
def ray_wall(p, phi, wall):
    a = (complex(*wall[:2]) - complex(*p)) * np.exp(-1j * phi)
    b = (complex(*wall[2:]) - complex(*p)) * np.exp(-1j * phi)
    if a.imag * b.imag > 0 or abs(a.imag - b.imag) < 1e-9:
        return float("inf")
    t = a.real + (b.real - a.real) * a.imag / (a.imag - b.imag)
    return t if t >= 0 else float("inf")
""",
    "the wall's normal": """
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
""",
    "NumPy's infinities": """
def ray_wall(p, phi, wall):
    u = np.array([np.cos(phi), np.sin(phi)])
    d, w = wall[:2] - p, wall[2:] - wall[:2]
    cross = lambda a, b: a[0] * b[1] - a[1] * b[0]
    with np.errstate(all="ignore"):
        t = cross(d, w) / cross(u, w)
        s = cross(d, u) / cross(u, w)
    return np.where((t >= 0) & (s >= 0) & (s <= 1), t, np.inf)
""",
    "the ends' sides": """
def ray_wall(p, phi, wall):
    u = np.array([np.cos(phi), np.sin(phi)])
    left = np.array([-u[1], u[0]])
    a, b = wall[:2] - p, wall[2:] - p
    if (a @ left > 0) == (b @ left > 0):
        return np.inf
    share = (a @ left) / (a @ left - b @ left)
    t = (a + share * (b - a)) @ u
    return np.inf if t < 0 else t
""",
}
