"""Right ways of 02-echo."""

WAYS = {
    "cut at the rims": """
def echo(p, phi, half, walls):
    found = [np.inf]
    for x1, y1, x2, y2 in walls:
        a, b = np.array([x1, y1]) - p, np.array([x2, y2]) - p
        w, low, high = b - a, 0.0, 1.0
        for angle in (phi - half + np.pi / 2, phi + half - np.pi / 2):
            inward = np.array([np.cos(angle), np.sin(angle)])
            at_a, at_b = inward @ a, inward @ b
            if at_a < 0 and at_b < 0:
                low, high = 1.0, 0.0
            elif at_a < 0:
                low = max(low, at_a / (at_a - at_b))
            elif at_b < 0:
                high = min(high, at_a / (at_a - at_b))
        if low <= high:
            s = min(max(-(a @ w) / (w @ w), low), high)
            found.append(np.linalg.norm(a + s * w))
    return min(found)
""",
    "by bearings": """
def echo(p, phi, half, walls):
    def bearing(q):
        return (np.arctan2(q[1], q[0]) - phi + np.pi) % (2 * np.pi) - np.pi

    distances = []
    for wall in walls:
        a, b = wall[:2] - p, wall[2:] - p
        foot = a - (a @ (b - a)) / ((b - a) @ (b - a)) * (b - a)
        places = [a, b]
        if (foot - a) @ (foot - b) < 0:
            places.append(foot)
        distances += [np.sqrt(q @ q) for q in places if abs(bearing(q)) <= half]
        distances += [ray_wall(p, phi - half, wall), ray_wall(p, phi + half, wall)]
    return min(distances, default=np.inf)
""",
    "complex, all walls at once": """
def echo(p, phi, half, walls):
    if len(walls) == 0:
        return np.inf
    turn = np.exp(-1j * phi)
    a = (walls[:, 0] - p[0] + 1j * (walls[:, 1] - p[1])) * turn
    w = (walls[:, 2] - walls[:, 0] + 1j * (walls[:, 3] - walls[:, 1])) * turn
    rims = np.exp(1j * half * np.array([[-1], [1]]))
    with np.errstate(all="ignore"):
        s = -(a * rims.conj()).imag / (w * rims.conj()).imag
    feet = np.clip(-(a * w.conj()).real / abs(w) ** 2, 0, 1)
    s = np.vstack([0 * feet, 0 * feet + 1, feet, np.clip(np.nan_to_num(s), 0, 1)])
    q = a + s * w
    inside = abs(np.angle(q)) <= half + 1e-9
    return np.where(inside, abs(q), np.inf).min()
""",
    "the angles that a wall fills": """
def echo(p, phi, half, walls):
    best = float("inf")
    for wall in np.asarray(walls, dtype=float):
        a, b = wall[:2] - p, wall[2:] - p
        begin = np.arctan2(a[1], a[0]) - phi
        width = np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b)
        if width < 0:
            begin, width, a, b = begin + width, -width, b, a
        normal = np.array([-(b - a)[1], (b - a)[0]])
        if normal @ a < 0:
            normal = -normal
        square_on = np.arctan2(normal[1], normal[0]) - phi
        for turn in (-3, -2, -1, 0, 1, 2, 3):
            low = max(begin + 2 * np.pi * turn, -half)
            high = min(begin + 2 * np.pi * turn + width, half)
            if low <= high:
                if width < 1e-7:
                    best = min(best, np.hypot(*a), np.hypot(*b))
                    continue
                towards = low - np.pi + (square_on - low + np.pi) % (2 * np.pi)
                for beta in (low, high, min(max(towards, low), high)):
                    share = np.hypot(*normal) * np.cos(beta - towards)
                    best = min(best, normal @ a / share if share > 1e-12 else np.inf)
    return best
""",
}
