# %% way: cut at the rims
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

# %% way: by bearings
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

# %% way: complex, all walls at once
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

# %% way: the angles that a wall fills
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

# %% pasted: the lesson's scan along the axis
def echo(p, phi, half, walls):
    directions = np.linspace(phi, phi, 1)
    ranges = [ray_wall(p, direction, wall) for direction in directions for wall in walls]
    return min(ranges, default=np.inf)

# %% pasted: a scan of fifty beams
def echo(p, phi, half, walls):
    directions = np.linspace(phi - half, phi + half, 50)
    ranges = [ray_wall(p, direction, wall) for direction in directions for wall in walls]
    return min(ranges, default=np.inf)

# %% pasted: ray_wall of the first wall
def echo(p, phi, half, walls):
    return ray_wall(p, phi, walls[0]) if len(walls) else np.inf

# %% right: clip each wall to the cone's part, then the nearest of the clipped piece
def echo(p, phi, half, walls):
    best = np.inf
    left = np.array([-np.sin(phi + half), np.cos(phi + half)])      # points out of the cone, on the left
    right_ = np.array([np.sin(phi - half), -np.cos(phi - half)])    # out of it, on the right
    for wall in walls:
        a, b = wall[:2] - p, wall[2:] - p
        lo, hi = 0.0, 1.0
        for n in (left, right_):
            fa, fb = n @ a, n @ b
            if fa > 0 and fb > 0:
                lo, hi = 1.0, 0.0
            elif fa > 0:
                lo = max(lo, fa / (fa - fb))
            elif fb > 0:
                hi = min(hi, fa / (fa - fb))
        if lo > hi:
            continue
        w = b - a
        s = min(max(-(a @ w) / (w @ w), lo), hi)
        best = min(best, np.hypot(*(a + s * w)))
    return best

# %% right: candidates in one list, angle by arccos
def echo(p, phi, half, walls):
    u = np.array([np.cos(phi), np.sin(phi)])
    found = [np.inf]
    for x1, y1, x2, y2 in walls:
        a = np.array([x1, y1]) - p
        w = np.array([x2 - x1, y2 - y1])
        foot = -np.dot(a, w) / np.dot(w, w)
        for s in [0.0, 1.0] + ([foot] if 0 < foot < 1 else []):
            q = a + s * w
            r = np.linalg.norm(q)
            if np.arccos(np.clip(q @ u / r, -1, 1)) <= half:
                found.append(r)
        found.append(ray_wall(p, phi + half, np.array([x1, y1, x2, y2])))
        found.append(ray_wall(p, phi - half, np.array([x1, y1, x2, y2])))
    return min(found)

# %% right: the nearest place of the wall if it is in the cone, else the rims (enough, for cone and wall are convex)
def echo(p, phi, half, walls):
    found = [np.inf]
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        s = np.clip(-(a @ w) / (w @ w), 0, 1)
        q = a + s * w
        off = np.arctan2(q[1], q[0]) - phi
        off = np.arctan2(np.sin(off), np.cos(off))
        if abs(off) <= half:
            found.append(np.hypot(*q))
        else:
            found += [ray_wall(p, phi - half, wall), ray_wall(p, phi + half, wall)]
    return min(found)

# %% wrong: two hundred beams into the cone
def echo(p, phi, half, walls):
    beams = np.linspace(phi - half, phi + half, 200)
    return min([ray_wall(p, b, w) for b in beams for w in walls], default=np.inf)

# %% wrong: the rims and the axis only
def echo(p, phi, half, walls):
    nearest = np.inf
    for wall in walls:
        for a in (phi - half, phi, phi + half):
            nearest = min(nearest, ray_wall(p, a, wall))
    return nearest

# %% wrong: no walls: min of an empty list
def echo(p, phi, half, walls):
    axis = np.array([np.cos(phi), np.sin(phi)])
    each = []
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        near = min(ray_wall(p, phi - half, wall), ray_wall(p, phi + half, wall))
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            if q @ axis >= np.cos(half) * np.hypot(*q):
                near = min(near, np.hypot(*q))
        each.append(near)
    return min(each)

# %% wrong: the distance along the axis
def echo(p, phi, half, walls):
    nearest = np.inf
    axis = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            if q @ axis >= np.cos(half) * np.hypot(*q):
                nearest = min(nearest, q @ axis)
        for rim in (phi - half, phi + half):
            nearest = min(nearest, ray_wall(p, rim, wall) * np.cos(half))
    return nearest

# %% wrong: moves the walls to p in place
def echo(p, phi, half, walls):
    walls[:, :2] -= p
    walls[:, 2:] -= p
    origin, best = np.zeros(2), np.inf
    axis = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2], wall[2:] - wall[:2]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            if q @ axis >= np.cos(half) * np.hypot(*q):
                best = min(best, np.hypot(*q))
        best = min(best, ray_wall(origin, phi - half, wall), ray_wall(origin, phi + half, wall))
    return best
