"""Independent answers to 02-echo: right ones, and students' mistakes."""

RIGHT = [
    (
        "02-echo",
        "clip each wall to the cone's part, then the nearest of the clipped piece",
        """
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
""",
    ),
    (
        "02-echo",
        "candidates in one list, angle by arccos",
        """
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
""",
    ),
    (
        "02-echo",
        "the nearest place of the wall if it is in the cone, else the rims (enough, for cone and wall are convex)",
        """
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
""",
    ),
]

WRONG = [
    (
        "02-echo",
        "two hundred beams into the cone",
        """
def echo(p, phi, half, walls):
    beams = np.linspace(phi - half, phi + half, 200)
    return min([ray_wall(p, b, w) for b in beams for w in walls], default=np.inf)
""",
    ),
    (
        "02-echo",
        "only the axis",
        """
def echo(p, phi, half, walls):
    return min([ray_wall(p, phi, w) for w in walls], default=np.inf)
""",
    ),
    (
        "02-echo",
        "the rims and the axis only",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    for wall in walls:
        for a in (phi - half, phi, phi + half):
            nearest = min(nearest, ray_wall(p, a, wall))
    return nearest
""",
    ),
    (
        "02-echo",
        "the foot and the ends, but no rims",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    u = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            d = np.hypot(*q)
            if q @ u >= np.cos(half) * d:
                nearest = min(nearest, d)
    return nearest
""",
    ),
    (
        "02-echo",
        "the ends are forgotten",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    u = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        s = -(a @ w) / (w @ w)
        if 0 <= s <= 1:
            q = a + s * w
            if q @ u >= np.cos(half) * np.linalg.norm(q):
                nearest = min(nearest, np.linalg.norm(q))
        nearest = min(nearest, ray_wall(p, phi - half, wall), ray_wall(p, phi + half, wall))
    return nearest
""",
    ),
    (
        "02-echo",
        "the nearer of the two ends and the foot is chosen first, then tested: others in the cone lost",
        """
def echo(p, phi, half, walls):
    best, u = np.inf, np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, b = wall[:2] - p, wall[2:] - p
        q = min((a, b), key=lambda e: e @ e)
        w = b - a
        s = -(a @ w) / (w @ w)
        if 0 < s < 1:
            q = a + s * w
        if q @ u >= np.cos(half) * np.hypot(*q):
            best = min(best, np.hypot(*q))
    return best
""",
    ),
    (
        "02-echo",
        "s not clipped: the foot may lie beyond the ends",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    axis = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        for s in (0, 1, -(a @ w) / (w @ w)):
            q = a + s * w
            d = np.hypot(*q)
            if q @ axis >= np.cos(half) * d:
                nearest = min(nearest, d)
        for rim in (phi - half, phi + half):
            nearest = min(nearest, ray_wall(p, rim, wall))
    return nearest
""",
    ),
    (
        "02-echo",
        "the difference of angles is not wrapped",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            if abs(np.arctan2(q[1], q[0]) - phi) <= half:
                nearest = min(nearest, np.hypot(*q))
        for rim in (phi - half, phi + half):
            nearest = min(nearest, ray_wall(p, rim, wall))
    return nearest
""",
    ),
    (
        "02-echo",
        "half taken as the whole cone",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    h = half / 2
    axis = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            if q @ axis >= np.cos(h) * np.hypot(*q):
                nearest = min(nearest, np.hypot(*q))
        nearest = min(nearest, ray_wall(p, phi - h, wall), ray_wall(p, phi + h, wall))
    return nearest
""",
    ),
    (
        "02-echo",
        "no walls: min of an empty list",
        """
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
""",
    ),
    (
        "02-echo",
        "the cosine test without the distance",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    axis = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            if q @ axis >= np.cos(half):
                nearest = min(nearest, np.hypot(*q))
        for rim in (phi - half, phi + half):
            nearest = min(nearest, ray_wall(p, rim, wall))
    return nearest
""",
    ),
    (
        "02-echo",
        "the cone opens to the back as well (abs)",
        """
def echo(p, phi, half, walls):
    nearest = np.inf
    axis = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            off = np.arcsin(np.clip((axis[0] * q[1] - axis[1] * q[0]) / np.hypot(*q), -1, 1))
            if abs(off) <= half:
                nearest = min(nearest, np.hypot(*q))
        for rim in (phi - half, phi + half):
            nearest = min(nearest, ray_wall(p, rim, wall))
    return nearest
""",
    ),
    (
        "02-echo",
        "the distance along the axis",
        """
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
""",
    ),
    (
        "02-echo",
        "returns after the first wall that is heard",
        """
def echo(p, phi, half, walls):
    axis = np.array([np.cos(phi), np.sin(phi)])
    for wall in walls:
        a, w = wall[:2] - p, wall[2:] - wall[:2]
        found = [ray_wall(p, phi - half, wall), ray_wall(p, phi + half, wall)]
        for s in (0, 1, np.clip(-(a @ w) / (w @ w), 0, 1)):
            q = a + s * w
            if q @ axis >= np.cos(half) * np.hypot(*q):
                found.append(np.hypot(*q))
        if min(found) < np.inf:
            return min(found)
    return np.inf
""",
    ),
    (
        "02-echo",
        "moves the walls to p in place",
        """
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
""",
    ),
]
