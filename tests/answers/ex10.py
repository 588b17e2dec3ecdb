"""Independent answers to exercise 10 (boxes): right ones and students' mistakes."""

RIGHT = []
WRONG = []


def right(task, name, source):
    RIGHT.append((task, name, source.strip("\n") + "\n"))


def wrong(task, name, source):
    WRONG.append((task, name, source.strip("\n") + "\n"))


# ---------------------------------------------------------------- predict

right(
    "10-predict",
    "candidates: ends and all multiples of a right angle between",
    """
def predict(box, heading, way, direction):
    low = heading[0] + direction[0]
    high = heading[1] + direction[1]
    quarter = np.pi / 2
    k = np.arange(np.ceil(low / quarter), np.floor(high / quarter) + 1)
    angles = np.concatenate([[low, high], k * quarter])
    dx = np.concatenate([w * np.cos(angles) for w in way])
    dy = np.concatenate([w * np.sin(angles) for w in way])
    x_min, x_max, y_min, y_max = box
    return np.array([x_min + dx.min(), x_max + dx.max(), y_min + dy.min(), y_max + dy.max()])
""",
)

right(
    "10-predict",
    "math and ceil, own interval product",
    """
import math


def _cos_interval(lo, hi):
    top = 2 * math.pi * math.ceil(lo / (2 * math.pi)) <= hi
    n = math.ceil((lo - math.pi) / (2 * math.pi))
    bottom = math.pi + 2 * math.pi * n <= hi
    c = sorted((math.cos(lo), math.cos(hi)))
    if bottom:
        c[0] = -1.0
    if top:
        c[1] = 1.0
    return c


def predict(box, heading, way, direction):
    lo, hi = float(heading[0] + direction[0]), float(heading[1] + direction[1])
    result = []
    for k, shift in ((0, 0.0), (2, math.pi / 2)):
        c = _cos_interval(lo - shift, hi - shift)
        p = [w * e for w in (way[0], way[1]) for e in c]
        result += [box[k] + min(p), box[k + 1] + max(p)]
    return np.array(result)
""",
)

wrong(
    "10-predict",
    "only the two ends of the heading are tried",
    """
def predict(box, heading, way, direction):
    ends = np.array([heading[0] + direction[0], heading[1] + direction[1]])
    dx = np.outer(way, np.cos(ends))
    dy = np.outer(way, np.sin(ends))
    return np.array([box[0] + dx.min(), box[1] + dx.max(), box[2] + dy.min(), box[3] + dy.max()])
""",
)

wrong(
    "10-predict",
    "extremes only looked for between -pi and pi, no further turns",
    """
def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    angles = [low, high]
    for a in (-np.pi, -np.pi / 2, 0.0, np.pi / 2, np.pi):
        if low < a < high:
            angles.append(a)
    angles = np.array(angles)
    xs = [w * c for w in way for c in np.cos(angles)]
    ys = [w * s for w in way for s in np.sin(angles)]
    return np.array([box[0] + min(xs), box[1] + max(xs), box[2] + min(ys), box[3] + max(ys)])
""",
)

wrong(
    "10-predict",
    "extremes looked for between -2 pi and 2 pi: 14 rad forgotten",
    """
def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    special = np.arange(-4, 5) * np.pi / 2
    angles = np.append(special[(special >= low) & (special <= high)], [low, high])
    reach = np.array([[w * np.cos(angles), w * np.sin(angles)] for w in way])
    smallest, largest = reach.min(axis=(0, 2)), reach.max(axis=(0, 2))
    return np.array(
        [box[0] + smallest[0], box[1] + largest[0], box[2] + smallest[1], box[3] + largest[1]]
    )
""",
)

wrong(
    "10-predict",
    "interval product low*low, high*high only",
    """
def predict(box, heading, way, direction):
    def cosine_range(low, high):
        def met(angle):
            return (angle - low) % (2 * np.pi) <= high - low

        ends = np.cos([low, high])
        return (-1 if met(np.pi) else ends.min(), 1 if met(0) else ends.max())

    low, high = heading[0] + direction[0], heading[1] + direction[1]
    c = cosine_range(low, high)
    s = cosine_range(low - np.pi / 2, high - np.pi / 2)
    return np.array(
        [
            box[0] + way[0] * c[0],
            box[1] + way[1] * c[1],
            box[2] + way[0] * s[0],
            box[3] + way[1] * s[1],
        ]
    )
""",
)

wrong(
    "10-predict",
    "only the longest way, way[1], is driven",
    """
def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    quarter = np.pi / 2
    k = np.arange(np.ceil(low / quarter), np.floor(high / quarter) + 1)
    angles = np.concatenate([[low, high], k * quarter])
    dx, dy = way[1] * np.cos(angles), way[1] * np.sin(angles)
    return np.array([box[0] + dx.min(), box[1] + dx.max(), box[2] + dy.min(), box[3] + dy.max()])
""",
)

wrong(
    "10-predict",
    "direction is subtracted with crossed ends",
    """
def predict(box, heading, way, direction):
    low, high = heading[0] - direction[1], heading[1] - direction[0]

    def span(lo, hi):
        low_end = -1.0 if (np.pi - lo) % (2 * np.pi) <= hi - lo else min(np.cos(lo), np.cos(hi))
        high_end = 1.0 if (-lo) % (2 * np.pi) <= hi - lo else max(np.cos(lo), np.cos(hi))
        return low_end, high_end

    dx = np.outer(way, span(low, high))
    dy = np.outer(way, span(low - np.pi / 2, high - np.pi / 2))
    return np.array([box[0] + dx.min(), box[1] + dx.max(), box[2] + dy.min(), box[3] + dy.max()])
""",
)

wrong(
    "10-predict",
    "fifty samples of the angle in place of the extremes",
    """
def predict(box, heading, way, direction):
    angles = np.linspace(heading[0] + direction[0], heading[1] + direction[1], 50)
    ways = np.linspace(way[0], way[1], 5)
    x = np.outer(ways, np.cos(angles))
    y = np.outer(ways, np.sin(angles))
    return np.array([box[0] + x.min(), box[1] + x.max(), box[2] + y.min(), box[3] + y.max()])
""",
)

wrong(
    "10-predict",
    "the box is changed in place",
    """
def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    quarter = np.pi / 2
    k = np.arange(np.ceil(low / quarter), np.floor(high / quarter) + 1)
    angles = np.concatenate([[low, high], k * quarter])
    dx, dy = np.outer(way, np.cos(angles)), np.outer(way, np.sin(angles))
    box += np.array([dx.min(), dx.max(), dy.min(), dy.max()])
    return box
""",
)

wrong(
    "10-predict",
    "returns x_min, y_min, x_max, y_max",
    """
def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    quarter = np.pi / 2
    k = np.arange(np.ceil(low / quarter), np.floor(high / quarter) + 1)
    angles = np.concatenate([[low, high], k * quarter])
    move = np.array([[w * np.cos(a), w * np.sin(a)] for w in way for a in angles])
    lower = np.array([box[0], box[2]]) + move.min(axis=0)
    upper = np.array([box[1], box[3]]) + move.max(axis=0)
    return np.concatenate([lower, upper])
""",
)

wrong(
    "10-predict",
    "sine as the cosine of alpha + pi/2 (its negative)",
    """
def predict(box, heading, way, direction):
    def cosine_range(low, high):
        def met(angle):
            return (angle - low) % (2 * np.pi) <= high - low

        ends = np.cos([low, high])
        return (-1 if met(np.pi) else ends.min(), 1 if met(0) else ends.max())

    low, high = heading[0] + direction[0], heading[1] + direction[1]
    cosines, sines = cosine_range(low, high), cosine_range(low + np.pi / 2, high + np.pi / 2)
    dx, dy = np.outer(way, cosines), np.outer(way, sines)
    return np.array([box[0] + dx.min(), box[1] + dx.max(), box[2] + dy.min(), box[3] + dy.max()])
""",
)

wrong(
    "10-predict",
    "both ends are wrapped and sorted, so the seam turns the interval inside out",
    """
def predict(box, heading, way, direction):
    low, high = sorted([wrap(heading[0] + direction[0]), wrap(heading[1] + direction[1])])
    angles = [low, high] + [a for a in np.arange(-2, 3) * np.pi / 2 if low < a < high]
    dx = [w * np.cos(a) for a in angles for w in way]
    dy = [w * np.sin(a) for a in angles for w in way]
    return np.array([box[0] + min(dx), box[1] + max(dx), box[2] + min(dy), box[3] + max(dy)])
""",
)

wrong(
    "10-predict",
    "the width is taken modulo a turn: more than a whole turn becomes little",
    """
def predict(box, heading, way, direction):
    low = wrap(float(heading[0] + direction[0]))
    width = (heading[1] - heading[0] + direction[1] - direction[0]) % (2 * np.pi)
    high = low + width
    angles = [low, high]
    for n in range(-4, 9):
        if low <= n * np.pi / 2 <= high:
            angles.append(n * np.pi / 2)
    angles = np.array(angles)
    dx, dy = np.outer(way, np.cos(angles)), np.outer(way, np.sin(angles))
    return np.array([box[0] + dx.min(), box[1] + dx.max(), box[2] + dy.min(), box[3] + dy.max()])
""",
)

wrong(
    "10-predict",
    "the last right angle is missed (arange without + 1)",
    """
def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    q = np.pi / 2
    inner = q * np.arange(np.ceil(low / q), np.floor(high / q))
    angles = np.r_[low, high, inner]
    dx, dy = np.outer(way, np.cos(angles)), np.outer(way, np.sin(angles))
    return np.array([box[0] + dx.min(), box[1] + dx.max(), box[2] + dy.min(), box[3] + dy.max()])
""",
)

wrong(
    "10-predict",
    "the way's length is assumed not negative (backing forgotten)",
    """
def predict(box, heading, way, direction):
    lo, hi = heading[0] + direction[0], heading[1] + direction[1]

    def extremes(f, top, bottom):
        e = f([lo, hi])
        a = -1.0 if (bottom - lo) % (2 * np.pi) <= hi - lo else e.min()
        b = 1.0 if (top - lo) % (2 * np.pi) <= hi - lo else e.max()
        # the smallest: shortest way if it still goes forward, else the longest
        return (way[0] if a > 0 else way[1]) * a, (way[1] if b > 0 else way[0]) * b

    x = extremes(np.cos, 0, np.pi)
    y = extremes(np.sin, np.pi / 2, -np.pi / 2)
    return np.array([box[0] + x[0], box[1] + x[1], box[2] + y[0], box[3] + y[1]])
""",
)

# ---------------------------------------------------------------- edges

right(
    "10-edges",
    "support over the four corners, rows not of unit length",
    """
def edges(z, bounds, heading, box):
    r, beta = z
    spread = bounds[1] + 0.5 * (heading[1] - heading[0])
    u = 0.5 * (heading[0] + heading[1]) + beta
    normals = 2.0 * np.array(
        [
            [np.cos(u), np.sin(u)],
            [np.cos(u + np.pi), np.sin(u + np.pi)],
            [np.cos(u + spread + np.pi / 2), np.sin(u + spread + np.pi / 2)],
            [np.cos(u - spread - np.pi / 2), np.sin(u - spread - np.pi / 2)],
        ]
    )
    offsets = 2.0 * np.array([r + bounds[0], -(r - bounds[0]) * np.cos(spread), 0.0, 0.0])
    corners = np.array([[x, y] for x in (box[0], box[1]) for y in (box[2], box[3])])
    return np.column_stack([normals, offsets + (normals @ corners.T).max(axis=1)])
""",
)

right(
    "10-edges",
    "middle and half width of the box, list of rows",
    """
def edges(z, bounds, heading, box):
    mid = heading[0] + (heading[1] - heading[0]) / 2
    d_abs = (heading[1] - heading[0]) / 2 + bounds[1]
    phi = wrap(mid + z[1])
    cx, cy = (box[0] + box[1]) / 2, (box[2] + box[3]) / 2
    hx, hy = (box[1] - box[0]) / 2, (box[3] - box[2]) / 2
    out = []
    for angle, c in (
        (phi, z[0] + bounds[0]),
        (phi - np.pi, (bounds[0] - z[0]) * np.cos(d_abs)),
        (phi + d_abs + np.pi / 2, 0),
        (phi - d_abs - np.pi / 2, 0),
    ):
        a, b = np.cos(angle), np.sin(angle)
        out.append([a, b, c + a * cx + b * cy + abs(a) * hx + abs(b) * hy])
    return np.array(out)
""",
)

wrong(
    "10-edges",
    "near edge at r - d_r, cosine forgotten",
    """
def edges(z, bounds, heading, box):
    u = np.mean(heading) + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    e = np.array([np.cos(u), np.sin(u)])
    left = np.array([-np.sin(u + d), np.cos(u + d)])
    right = np.array([np.sin(u - d), -np.cos(u - d)])
    rows = []
    for n, c in ((e, z[0] + bounds[0]), (-e, bounds[0] - z[0]), (left, 0.0), (right, 0.0)):
        push = max(n @ [x, y] for x in box[:2] for y in box[2:])
        rows.append([n[0], n[1], c + push])
    return np.array(rows)
""",
)

wrong(
    "10-edges",
    "cosine of the bearing's bound only in the near edge",
    """
def edges(z, bounds, heading, box):
    u = np.mean(heading) + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    angles = np.array([u, u + np.pi, u + d + np.pi / 2, u - d - np.pi / 2])
    a, b = np.cos(angles), np.sin(angles)
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(bounds[1]), 0, 0])
    c = c + np.maximum(a * box[0], a * box[1]) + np.maximum(b * box[2], b * box[3])
    return np.column_stack([a, b, c])
""",
)

wrong(
    "10-edges",
    "whole width of the heading in place of half",
    """
def edges(z, bounds, heading, box):
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + heading[1] - heading[0]
    angles = np.array([u, u + np.pi, u + d + np.pi / 2, u - d - np.pi / 2])
    a, b = np.cos(angles), np.sin(angles)
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0])
    c += np.where(a > 0, a * box[1], a * box[0]) + np.where(b > 0, b * box[3], b * box[2])
    return np.stack([a, b, c], axis=1)
""",
)

wrong(
    "10-edges",
    "normals of the side edges point in",
    """
def edges(z, bounds, heading, box):
    direction = (heading[0] + heading[1]) / 2 + z[1]
    d_abs = bounds[1] + (heading[1] - heading[0]) / 2
    left, right = direction + d_abs, direction - d_abs
    rows = np.array(
        [
            [np.cos(direction), np.sin(direction), z[0] + bounds[0]],
            [-np.cos(direction), -np.sin(direction), -(z[0] - bounds[0]) * np.cos(d_abs)],
            [np.sin(left), -np.cos(left), 0],
            [-np.sin(right), np.cos(right), 0],
        ]
    )
    for row in rows:
        a, b, _ = row
        row[2] += max(a * box[0], a * box[1]) + max(b * box[2], b * box[3])
    return rows
""",
)

wrong(
    "10-edges",
    "order near, far, left, right",
    """
def edges(z, bounds, heading, box):
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2

    def moved(angle, c):
        a, b = np.cos(angle), np.sin(angle)
        return a, b, c + max(a * x + b * y for x in box[:2] for y in box[2:])

    near = moved(u + np.pi, -(z[0] - bounds[0]) * np.cos(d))
    far = moved(u, z[0] + bounds[0])
    return np.array([near, far, moved(u + d + np.pi / 2, 0), moved(u - d - np.pi / 2, 0)])
""",
)

wrong(
    "10-edges",
    "pushed by half the diagonal of the box: sound, not tight",
    """
def edges(z, bounds, heading, box):
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    middle = np.array([box[0] + box[1], box[2] + box[3]]) / 2
    radius = np.hypot(box[1] - box[0], box[3] - box[2]) / 2
    angles = np.array([u, u + np.pi, u + d + np.pi / 2, u - d - np.pi / 2])
    n = np.column_stack([np.cos(angles), np.sin(angles)])
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0])
    return np.column_stack([n, c + n @ middle + radius])
""",
)

wrong(
    "10-edges",
    "every edge pushed by the same corner (x_max, y_max)",
    """
def edges(z, bounds, heading, box):
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    rows = np.array(
        [
            [np.cos(u), np.sin(u), z[0] + bounds[0]],
            [-np.cos(u), -np.sin(u), -(z[0] - bounds[0]) * np.cos(d)],
            [-np.sin(u + d), np.cos(u + d), 0],
            [np.sin(u - d), -np.cos(u - d), 0],
        ]
    )
    rows[:, 2] += rows[:, 0] * box[1] + rows[:, 1] * box[3]
    return rows
""",
)

wrong(
    "10-edges",
    "box read as x_min, y_min, x_max, y_max",
    """
def edges(z, bounds, heading, box):
    x_min, y_min, x_max, y_max = box
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    rows = []
    for angle, c in (
        (u, z[0] + bounds[0]),
        (u + np.pi, -(z[0] - bounds[0]) * np.cos(d)),
        (u + d + np.pi / 2, 0),
        (u - d - np.pi / 2, 0),
    ):
        a, b = np.cos(angle), np.sin(angle)
        rows.append([a, b, c + max(a * x_min, a * x_max) + max(b * y_min, b * y_max)])
    return np.array(rows)
""",
)

wrong(
    "10-edges",
    "middle of the heading from wrapped ends: opposite direction over the seam",
    """
def edges(z, bounds, heading, box):
    u = (wrap(heading[0]) + wrap(heading[1])) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    angles = np.array([u, u + np.pi, u + d + np.pi / 2, u - d - np.pi / 2])
    a, b = np.cos(angles), np.sin(angles)
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0])
    c = c + np.maximum(a * box[0], a * box[1]) + np.maximum(b * box[2], b * box[3])
    return np.column_stack([a, b, c])
""",
)

wrong(
    "10-edges",
    "far edge through the outer corners: cuts the bulge off",
    """
def edges(z, bounds, heading, box):
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    angles = np.array([u, u + np.pi, u + d + np.pi / 2, u - d - np.pi / 2])
    a, b = np.cos(angles), np.sin(angles)
    c = np.array([z[0] + bounds[0], bounds[0] - z[0], 0, 0]) * np.cos(d)
    c = c + np.maximum(a * box[0], a * box[1]) + np.maximum(b * box[2], b * box[3])
    return np.column_stack([a, b, c])
""",
)

wrong(
    "10-edges",
    "pushed by the largest absolute coordinate: too wide away from the origin",
    """
def edges(z, bounds, heading, box):
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    rows = np.array(
        [
            [np.cos(u), np.sin(u), z[0] + bounds[0]],
            [-np.cos(u), -np.sin(u), -(z[0] - bounds[0]) * np.cos(d)],
            [-np.sin(u + d), np.cos(u + d), 0],
            [np.sin(u - d), -np.cos(u - d), 0],
        ]
    )
    x, y = np.abs(box[:2]).max(), np.abs(box[2:]).max()
    rows[:, 2] += np.abs(rows[:, 0]) * x + np.abs(rows[:, 1]) * y
    return rows
""",
)

wrong(
    "10-edges",
    "rows scaled so that c is 1: turned round where c is negative",
    """
def edges(z, bounds, heading, box):
    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    angles = np.array([u, u + np.pi, u + d + np.pi / 2, u - d - np.pi / 2])
    a, b = np.cos(angles), np.sin(angles)
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0])
    c = c + np.maximum(a * box[0], a * box[1]) + np.maximum(b * box[2], b * box[3])
    return np.column_stack([a, b, c]) / c[:, None]
""",
)

wrong(
    "10-edges",
    "the bearing is turned into the world in place (z changed)",
    """
def edges(z, bounds, heading, box):
    d = bounds[1] + (heading[1] - heading[0]) / 2
    z[1] += (heading[0] + heading[1]) / 2
    angles = z[1] + np.array([0, np.pi, d + np.pi / 2, -d - np.pi / 2])
    a, b = np.cos(angles), np.sin(angles)
    c = np.array([z[0] + bounds[0], -(z[0] - bounds[0]) * np.cos(d), 0, 0])
    c = c + np.maximum(a * box[0], a * box[1]) + np.maximum(b * box[2], b * box[3])
    return np.column_stack([a, b, c])
""",
)

wrong(
    "10-edges",
    "d_abs without the bearing's own bound",
    """
def edges(z, bounds, heading, box):
    direction = np.mean(heading) + z[1]
    d_abs = np.ptp(heading) / 2
    lines = []
    for turn, c in (
        (0, z[0] + bounds[0]),
        (np.pi, -(z[0] - bounds[0]) * np.cos(d_abs)),
        (np.pi / 2 + d_abs, 0),
        (-np.pi / 2 - d_abs, 0),
    ):
        a, b = np.cos(direction + turn), np.sin(direction + turn)
        lines.append([a, b, c + max(a * box[0], a * box[1]) + max(b * box[2], b * box[3])])
    return np.array(lines)
""",
)

wrong(
    "10-edges",
    "the near edge is pushed inwards (minus the most)",
    """
def edges(z, bounds, heading, box):
    def most(a, b):
        return max(a * box[0], a * box[1]) + max(b * box[2], b * box[3])

    u = (heading[0] + heading[1]) / 2 + z[1]
    d = bounds[1] + (heading[1] - heading[0]) / 2
    c, s = np.cos(u), np.sin(u)
    far = [c, s, z[0] + bounds[0] + most(c, s)]
    near = [-c, -s, -((z[0] - bounds[0]) * np.cos(d) + most(c, s))]
    a, b = -np.sin(u + d), np.cos(u + d)
    left = [a, b, most(a, b)]
    a, b = np.sin(u - d), -np.cos(u - d)
    return np.array([far, near, left, [a, b, most(a, b)]])
""",
)

# ---------------------------------------------------------------- heading

right(
    "10-heading",
    "box of differences, centre bearing, normalised right",
    """
def sharpen(heading, robot, box, bearing, bound):
    dx = box[0] - robot[1], box[1] - robot[0]
    dy = box[2] - robot[3], box[3] - robot[2]
    if dx[0] <= 0 <= dx[1] and dy[0] <= 0 <= dy[1]:
        return np.array(heading, dtype=float)
    centre = np.arctan2(dy[0] + dy[1], dx[0] + dx[1])
    off = [wrap(np.arctan2(y, x) - centre) for x in dx for y in dy]
    width = max(off) - min(off) + 2 * bound
    start = centre + min(off) - bearing - bound
    for k in range(-4, 5):
        low = max(heading[0], start + 2 * np.pi * k)
        high = min(heading[1], start + width + 2 * np.pi * k)
        if low <= high:
            right = wrap(float(low))
            return np.array([right, right + high - low])
    return np.array(heading, dtype=float)
""",
)

right(
    "10-heading",
    "complex numbers, everything counted from the heading's middle",
    """
def sharpen(heading, robot, box, bearing, bound):
    apart_x = max(robot[0], box[0]) > min(robot[1], box[1])
    apart_y = max(robot[2], box[2]) > min(robot[3], box[3])
    if not (apart_x or apart_y):
        return np.array([heading[0], heading[1]])
    mine = np.array([complex(x, y) for x in robot[:2] for y in robot[2:]])
    its = np.array([complex(x, y) for x in box[:2] for y in box[2:]])
    ways = (its[:, None] - mine[None, :]).ravel()
    main = its.mean() - mine.mean()
    rel = np.angle(ways / main)
    mid = (heading[0] + heading[1]) / 2
    told = np.angle(main) - bearing + np.array([rel.min() - bound, rel.max() + bound])
    shift = np.round((mid - told.mean()) / (2 * np.pi)) * 2 * np.pi
    return np.array([max(heading[0], told[0] + shift), min(heading[1], told[1] + shift)])
""",
)

wrong(
    "10-heading",
    "plain min and max of arctan2: torn at the seam",
    """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)
    angles = []
    for x in robot[:2]:
        for y in robot[2:]:
            for u in box[:2]:
                for v in box[2:]:
                    angles.append(np.arctan2(v - y, u - x))
    low, high = min(angles) - bearing - bound, max(angles) - bearing + bound
    turns = 2 * np.pi * np.round((np.mean(heading) - (low + high) / 2) / (2 * np.pi))
    return np.array([max(heading[0], low + turns), min(heading[1], high + turns)])
""",
)

wrong(
    "10-heading",
    "bearing added in place of subtracted",
    """
def sharpen(heading, robot, box, bearing, bound):
    apart = robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]
    if not apart:
        return heading
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    told = np.array([mid + min(off) + bearing - bound, mid + max(off) + bearing + bound])
    here = np.mean(heading)
    told += here + wrap(told.mean() - here) - told.mean()
    return np.array([max(heading[0], told[0]), min(heading[1], told[1])])
""",
)

wrong(
    "10-heading",
    "overlapping boxes give every direction",
    """
def sharpen(heading, robot, box, bearing, bound):
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    if u[0] <= 0 <= u[1] and v[0] <= 0 <= v[1]:
        return np.array([np.pi, 3 * np.pi])
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    told = np.array([mid + min(off) - bearing - bound, mid + max(off) - bearing + bound])
    here = np.mean(heading)
    told += here + wrap(told.mean() - here) - told.mean()
    return np.array([max(heading[0], told[0]), min(heading[1], told[1])])
""",
)

wrong(
    "10-heading",
    "bound on the wrong side: interval made narrower",
    """
def sharpen(heading, robot, box, bearing, bound):
    apart = robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]
    if not apart:
        return heading
    seen = [
        np.arctan2(v - y, u - x)
        for x in robot[:2]
        for y in robot[2:]
        for u in box[:2]
        for v in box[2:]
    ]
    off = [wrap(angle - seen[0]) for angle in seen]
    right, left = seen[0] + min(off) - bearing + bound, seen[0] + max(off) - bearing - bound
    here, there = (heading[0] + heading[1]) / 2, (right + left) / 2
    turns = here + wrap(there - here) - there
    return np.array([max(heading[0], right + turns), min(heading[1], left + turns)])
""",
)

wrong(
    "10-heading",
    "only equal corners of the two boxes are paired",
    """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)

    def corners(b):
        return np.array([(x, y) for x in b[:2] for y in b[2:]])

    d = corners(box) - corners(robot)
    seen = np.arctan2(d[:, 1], d[:, 0])
    off = wrap(seen - seen[0])
    right = seen[0] + off.min() - bearing - bound
    left = seen[0] + off.max() - bearing + bound
    k = np.round((np.mean(heading) - (right + left) / 2) / (2 * np.pi)) * 2 * np.pi
    return np.array([max(heading[0], right + k), min(heading[1], left + k)])
""",
)

wrong(
    "10-heading",
    "intervals compared on whatever turn they happen to be",
    """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    width = max(off) - min(off) + 2 * bound
    right = wrap(mid + min(off) - bearing - bound)
    left = right + width
    return np.array([max(heading[0], right), min(heading[1], left)])
""",
)

wrong(
    "10-heading",
    "boxes count as overlapping when they do so in x or in y",
    """
def sharpen(heading, robot, box, bearing, bound):
    overlap_x = robot[0] <= box[1] and box[0] <= robot[1]
    overlap_y = robot[2] <= box[3] and box[2] <= robot[3]
    if overlap_x or overlap_y:
        return np.array(heading)
    mid = np.arctan2(box[2] + box[3] - robot[2] - robot[3], box[0] + box[1] - robot[0] - robot[1])
    off = [
        wrap(np.arctan2(v - y, u - x) - mid)
        for x in robot[:2] for y in robot[2:] for u in box[:2] for v in box[2:]
    ]
    right, left = mid + min(off) - bearing - bound, mid + max(off) - bearing + bound
    k = np.round((np.mean(heading) - (right + left) / 2) / (2 * np.pi)) * 2 * np.pi
    return np.array([max(heading[0], right + k), min(heading[1], left + k)])
""",
)

wrong(
    "10-heading",
    "overlap only noticed if the robot's middle lies in the object's box",
    """
def sharpen(heading, robot, box, bearing, bound):
    x, y = (robot[0] + robot[1]) / 2, (robot[2] + robot[3]) / 2
    if box[0] <= x <= box[1] and box[2] <= y <= box[3]:
        return np.array(heading)
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    right, left = mid + min(off) - bearing - bound, mid + max(off) - bearing + bound
    k = np.round((np.mean(heading) - (right + left) / 2) / (2 * np.pi)) * 2 * np.pi
    return np.array([max(heading[0], right + k), min(heading[1], left + k)])
""",
)

wrong(
    "10-heading",
    "bearing from middle to middle, the boxes' size forgotten",
    """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)
    dx = (box[0] + box[1] - robot[0] - robot[1]) / 2
    dy = (box[2] + box[3] - robot[2] - robot[3]) / 2
    theta = np.arctan2(dy, dx) - bearing
    here = (heading[0] + heading[1]) / 2
    theta = here + wrap(theta - here)
    return np.array([max(heading[0], theta - bound), min(heading[1], theta + bound)])
""",
)

wrong(
    "10-heading",
    "what is known already is thrown away: no intersection",
    """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    right = wrap(mid + min(off) - bearing - bound)
    return np.array([right, right + max(off) - min(off) + 2 * bound])
""",
)

wrong(
    "10-heading",
    "heading changed in place",
    """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return heading
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    right, left = mid + min(off) - bearing - bound, mid + max(off) - bearing + bound
    k = np.round((np.mean(heading) - (right + left) / 2) / (2 * np.pi)) * 2 * np.pi
    if right + k > heading[0]:
        heading[0] = right + k
    if left + k < heading[1]:
        heading[1] = left + k
    return heading
""",
)

wrong(
    "10-heading",
    "bearing from the object to the robot",
    """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)
    corners = [(robot[i] - box[j], robot[k] - box[m])
               for i in (0, 1) for j in (0, 1) for k in (2, 3) for m in (2, 3)]
    first = np.arctan2(corners[0][1], corners[0][0])
    off = [wrap(np.arctan2(b, a) - first) for a, b in corners]
    right, left = first + min(off) - bearing - bound, first + max(off) - bearing + bound
    k = np.round((np.mean(heading) - (right + left) / 2) / (2 * np.pi)) * 2 * np.pi
    return np.array([max(heading[0], right + k), min(heading[1], left + k)])
""",
)

wrong(
    "10-heading",
    "both ends of the result wrapped: left may be less than right",
    """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    right, left = mid + min(off) - bearing - bound, mid + max(off) - bearing + bound
    k = np.round((np.mean(heading) - (right + left) / 2) / (2 * np.pi)) * 2 * np.pi
    return wrap(np.array([max(heading[0], right + k), min(heading[1], left + k)]))
""",
)

wrong(
    "10-heading",
    "told ends counted from the heading's right, from -pi to pi: wide headings torn",
    """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    width = max(off) - min(off) + 2 * bound
    start = wrap(mid + min(off) - bearing - bound - heading[0])
    whole = heading[1] - heading[0]
    return heading[0] + np.array([max(0.0, start), min(whole, start + width)])
""",
)

# ---------------------------------------------------------------- ring

right(
    "10-ring",
    "mirror: only objects to the right are treated, four times",
    '''
def ring(robot, box, r, bound):
    inner_radius, outer_radius = max(0.0, r - bound), r + bound

    def towards_larger(me, it, low_other, high_other):
        """Interval of the object's coordinate that is not less than the robot's."""
        if low_other > outer_radius:
            return None
        most = (outer_radius**2 - low_other**2) ** 0.5
        least = max(0.0, inner_radius**2 - high_other**2) ** 0.5
        low, high = max(it[0], me[0] + least), min(it[1], me[1] + most)
        return (low, high) if low <= high else None

    def axis(me, it, me2, it2):
        gaps = it2[0] - me2[1], it2[1] - me2[0]
        low_other = 0.0 if gaps[0] <= 0 <= gaps[1] else min(abs(gaps[0]), abs(gaps[1]))
        high_other = max(abs(gaps[0]), abs(gaps[1]))
        found = []
        plus = towards_larger(me, it, low_other, high_other)
        if plus:
            found.append(plus)
        minus = towards_larger((-me[1], -me[0]), (-it[1], -it[0]), low_other, high_other)
        if minus:
            found.append((-minus[1], -minus[0]))
        if not found:
            return None
        return min(f[0] for f in found), max(f[1] for f in found)

    rx, ry, bx, by = robot[:2], robot[2:], box[:2], box[2:]
    x, y = axis(rx, bx, ry, by), axis(ry, by, rx, bx)
    if x is None or y is None:
        return None
    return np.array([x[0], x[1], y[0], y[1]], dtype=float)
''',
)

right(
    "10-ring",
    "one axis after the other, the second with the first's result",
    """
def ring(robot, box, r, bound):
    R0, R1 = (r - bound if r > bound else 0.0), r + bound
    result = np.array(box, dtype=float)
    for k in (0, 2):
        o = 2 - k
        d = np.array([result[o] - robot[o + 1], result[o + 1] - robot[o]])
        far_off = np.abs(d).max()
        near_off = 0.0 if d[0] * d[1] <= 0 else np.abs(d).min()
        if near_off > R1:
            return None
        big = np.sqrt(R1**2 - near_off**2)
        small = np.sqrt(R0**2 - far_off**2) if R0 > far_off else 0.0
        pieces = np.array(
            [[robot[k] - big, robot[k + 1] - small], [robot[k] + small, robot[k + 1] + big]]
        )
        pieces = np.clip(pieces, [[result[k]] * 2] * 2, None)[
            (pieces[:, 1] >= result[k]) & (pieces[:, 0] <= result[k + 1])
        ]
        if len(pieces) == 0:
            return None
        result[k], result[k + 1] = pieces[:, 0].min(), min(pieces[:, 1].max(), result[k + 1])
    return result
""",
)

wrong(
    "10-ring",
    "r - bound not taken as 0 where negative",
    """
def ring(robot, box, r, bound):
    near, far = r - bound, r + bound

    def reach(me, it, me2, it2):
        d = it2[0] - me2[1], it2[1] - me2[0]
        least, most = max(0, d[0], -d[1]), max(abs(d[0]), abs(d[1]))
        if least > far:
            return []
        out = (far**2 - least**2) ** 0.5
        hole = max(near**2 - most**2, 0) ** 0.5
        both = [(me[0] - out, me[1] - hole), (me[0] + hole, me[1] + out)]
        both = [(max(a, it[0]), min(b, it[1])) for a, b in both]
        return [v for a, b in both if a <= b for v in (a, b)]

    x = reach(robot[:2], box[:2], robot[2:], box[2:])
    y = reach(robot[2:], box[2:], robot[:2], box[:2])
    return np.array([min(x), max(x), min(y), max(y)]) if x and y else None
""",
)

wrong(
    "10-ring",
    "only the outer circle is used: the hole is forgotten",
    """
def ring(robot, box, r, bound):
    far = r + bound
    new = []
    for k, o in ((0, 2), (2, 0)):
        gap = max(0, box[o] - robot[o + 1], robot[o] - box[o + 1])
        if gap > far:
            return None
        reach = np.sqrt(far**2 - gap**2)
        low, high = max(box[k], robot[k] - reach), min(box[k + 1], robot[k + 1] + reach)
        if low > high:
            return None
        new += [low, high]
    return np.array(new)
""",
)

wrong(
    "10-ring",
    "a square round the robot's box, as the lesson does beyond a right angle",
    """
def ring(robot, box, r, bound):
    far = r + bound
    x_min, x_max = max(box[0], robot[0] - far), min(box[1], robot[1] + far)
    y_min, y_max = max(box[2], robot[2] - far), min(box[3], robot[3] + far)
    if x_min > x_max or y_min > y_max:
        return None
    return np.array([x_min, x_max, y_min, y_max])
""",
)

wrong(
    "10-ring",
    "least and most swapped: inner with the least across, outer with the most",
    """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound

    def apart(k):
        low, high = box[k] - robot[k + 1], box[k + 1] - robot[k]
        return max(0, low, -high), max(-low, high)

    def left_along(k, across):
        least, most = apart(across)
        if least > far:
            return None
        outer, inner = np.sqrt(max(far**2 - most**2, 0)), np.sqrt(max(near**2 - least**2, 0))
        sides = (robot[k] - outer, robot[k + 1] - inner), (robot[k] + inner, robot[k + 1] + outer)
        pieces = [(max(low, box[k]), min(high, box[k + 1])) for low, high in sides]
        kept = [(low, high) for low, high in pieces if low <= high]
        return (kept[0][0], kept[-1][1]) if kept else None

    x, y = left_along(0, 2), left_along(2, 0)
    return None if x is None or y is None else np.array([*x, *y])
""",
)

wrong(
    "10-ring",
    "the robot stands in the middle of its box",
    """
def ring(robot, box, r, bound):
    px, py = (robot[0] + robot[1]) / 2, (robot[2] + robot[3]) / 2
    near, far = max(r - bound, 0.0), r + bound

    def side(p, lo, hi, q, lo2, hi2):
        least = max(0.0, lo2 - q, q - hi2)
        most = max(hi2 - q, q - lo2)
        if least > far:
            return None
        out, hole = np.sqrt(far**2 - least**2), np.sqrt(max(0.0, near**2 - most**2))
        got = []
        for a, b in ((p - out, p - hole), (p + hole, p + out)):
            a, b = max(a, lo), min(b, hi)
            if a <= b:
                got += [a, b]
        return (min(got), max(got)) if got else None

    x = side(px, box[0], box[1], py, box[2], box[3])
    y = side(py, box[2], box[3], px, box[0], box[1])
    if x is None or y is None:
        return None
    return np.array(x + y)
""",
)

wrong(
    "10-ring",
    "both ends of a piece from the same end of the robot's box",
    """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound
    out = np.empty(4)
    for k in (0, 2):
        o = 2 - k
        d = box[o] - robot[o + 1], box[o + 1] - robot[o]
        least, most = max(0, d[0], -d[1]), max(-d[0], d[1])
        if least > far:
            return None
        big, small = np.sqrt(far**2 - least**2), np.sqrt(max(0, near**2 - most**2))
        values = []
        for low, high in ((robot[k] - big, robot[k] - small), (robot[k + 1] + small, robot[k + 1] + big)):
            low, high = max(low, box[k]), min(high, box[k + 1])
            if low <= high:
                values += [low, high]
        if not values:
            return None
        out[k], out[k + 1] = min(values), max(values)
    return out
""",
)

wrong(
    "10-ring",
    "the least distance across is never 0, even where the boxes overlap there",
    """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound

    def along(k, o):
        ends = np.abs([box[o] - robot[o + 1], box[o + 1] - robot[o]])
        if ends.min() > far:
            return None
        big = np.sqrt(far**2 - ends.min() ** 2)
        small = np.sqrt(max(near**2 - ends.max() ** 2, 0))
        pieces = [(robot[k] - big, robot[k + 1] - small), (robot[k] + small, robot[k + 1] + big)]
        pieces = [(max(a, box[k]), min(b, box[k + 1])) for a, b in pieces]
        pieces = [p for p in pieces if p[0] <= p[1]]
        return (pieces[0][0], pieces[-1][1]) if pieces else None

    x, y = along(0, 2), along(2, 0)
    if x is None or y is None:
        return None
    return np.array([*x, *y])
""",
)

wrong(
    "10-ring",
    "None forgotten: a crossed box where no piece is left",
    """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound

    def along(k, o):
        low, high = box[o] - robot[o + 1], box[o + 1] - robot[o]
        least, most = max(0, low, -high), max(-low, high)
        big = np.sqrt(max(far**2 - least**2, 0))
        small = np.sqrt(max(near**2 - most**2, 0))
        left = max(box[k], robot[k] - big), min(box[k + 1], robot[k + 1] - small)
        right = max(box[k], robot[k] + small), min(box[k + 1], robot[k + 1] + big)
        if left[0] > left[1]:
            return right
        if right[0] > right[1]:
            return left
        return left[0], right[1]

    return np.array([*along(0, 2), *along(2, 0)])
""",
)

wrong(
    "10-ring",
    "only the object's larger x and y side of the ring: negative d forgotten",
    """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound
    kept = []
    for k, o in ((0, 2), (2, 0)):
        low, high = box[o] - robot[o + 1], box[o + 1] - robot[o]
        least, most = max(0, low, -high), max(abs(low), abs(high))
        if least > far:
            return None
        a = max(box[k], robot[k] + np.sqrt(max(near**2 - most**2, 0)))
        b = min(box[k + 1], robot[k + 1] + np.sqrt(far**2 - least**2))
        if a > b:
            return None
        kept += [a, b]
    return np.array(kept)
""",
)

wrong(
    "10-ring",
    "where the ring crosses twice only the first piece is kept",
    """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound

    def along(k, o):
        low, high = box[o] - robot[o + 1], box[o + 1] - robot[o]
        least, most = max(0, low, -high), max(-low, high)
        if least > far:
            return None
        big, small = np.sqrt(far**2 - least**2), np.sqrt(max(near**2 - most**2, 0))
        if small == 0:
            pieces = [(robot[k] - big, robot[k + 1] + big)]
        else:
            pieces = [(robot[k] - big, robot[k + 1] - small), (robot[k] + small, robot[k + 1] + big)]
        for a, b in pieces:
            a, b = max(a, box[k]), min(b, box[k + 1])
            if a <= b:
                return a, b
        return None

    x, y = along(0, 2), along(2, 0)
    return None if x is None or y is None else np.array([*x, *y])
""",
)

wrong(
    "10-ring",
    "pieces tested one by one but the hull spans both: an empty piece is not left out",
    """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound
    out = []
    for k, o in ((0, 2), (2, 0)):
        low, high = box[o] - robot[o + 1], box[o + 1] - robot[o]
        least, most = max(0, low, -high), max(-low, high)
        if least > far:
            return None
        big, small = np.sqrt(far**2 - least**2), np.sqrt(max(near**2 - most**2, 0))
        left = max(box[k], robot[k] - big), min(box[k + 1], robot[k + 1] - small)
        right = max(box[k], robot[k] + small), min(box[k + 1], robot[k + 1] + big)
        if left[0] > left[1] and right[0] > right[1]:
            return None
        out += [left[0], right[1]]
    return np.array(out)
""",
)

wrong(
    "10-ring",
    "the box is changed in place",
    """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound
    for k, o in ((0, 2), (2, 0)):
        low, high = box[o] - robot[o + 1], box[o + 1] - robot[o]
        least, most = max(0, low, -high), max(-low, high)
        if least > far:
            return None
        big, small = np.sqrt(far**2 - least**2), np.sqrt(max(near**2 - most**2, 0))
        values = []
        for a, b in ((robot[k] - big, robot[k + 1] - small), (robot[k] + small, robot[k + 1] + big)):
            a, b = max(a, box[k]), min(b, box[k + 1])
            if a <= b:
                values += [a, b]
        if not values:
            return None
        box[k], box[k + 1] = min(values), max(values)
    return box
""",
)

wrong(
    "10-ring",
    "distances subtracted, not squares: inner = near - most, outer = far - least",
    """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound

    def along(k, o):
        low, high = box[o] - robot[o + 1], box[o + 1] - robot[o]
        least, most = max(0, low, -high), max(-low, high)
        if least > far:
            return None
        outer, inner = far - least, max(near - most, 0)
        sides = [(robot[k] - outer, robot[k + 1] - inner), (robot[k] + inner, robot[k + 1] + outer)]
        kept = [(max(a, box[k]), min(b, box[k + 1])) for a, b in sides]
        kept = [(a, b) for a, b in kept if a <= b]
        return (kept[0][0], kept[-1][1]) if kept else None

    x, y = along(0, 2), along(2, 0)
    return None if x is None or y is None else np.array([*x, *y])
""",
)

wrong(
    "10-ring",
    "whole box or nothing: only the distances of the boxes are compared",
    """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound
    gap_x = max(0, box[0] - robot[1], robot[0] - box[1])
    gap_y = max(0, box[2] - robot[3], robot[2] - box[3])
    span_x = max(box[1] - robot[0], robot[1] - box[0])
    span_y = max(box[3] - robot[2], robot[3] - box[2])
    if np.hypot(gap_x, gap_y) > far or np.hypot(span_x, span_y) < near:
        return None
    return np.array(box, dtype=float)
""",
)

# ---------------------------------------------------------------- narrow

right(
    "10-narrow",
    "cells of pose space, thrown out by interval tests, again and again",
    """
def narrow(robot, heading, objects, z, bounds):
    lo = np.array([robot[0], robot[2], heading[0]], dtype=float)
    hi = np.array([robot[1], robot[3], heading[1]], dtype=float)
    objects, z = np.reshape(objects, (-1, 2)), np.reshape(z, (-1, 2))
    n = 14
    for _ in range(7):
        half = (hi - lo) / n / 2
        ticks = [lo[i] + half[i] * (2 * np.arange(n) + 1) for i in range(3)]
        x, y = (v.ravel() for v in np.meshgrid(ticks[0], ticks[1], indexing="ij"))
        keep = np.ones((n * n, n), dtype=bool)
        for (ox, oy), (r, beta) in zip(objects, z):
            dx, dy = ox - x, oy - y
            ax, ay = np.abs(dx), np.abs(dy)
            nearest = np.hypot(np.maximum(ax - half[0], 0), np.maximum(ay - half[1], 0))
            farthest = np.hypot(ax + half[0], ay + half[1])
            ok = (nearest <= r + bounds[0] + 1e-9) & (farthest >= r - bounds[0] - 1e-9)
            middle = np.arctan2(dy, dx)
            spread = np.zeros_like(x)
            for sx in (-1, 1):
                for sy in (-1, 1):
                    corner = np.arctan2(dy + sy * half[1], dx + sx * half[0])
                    spread = np.maximum(spread, np.abs(wrap(corner - middle)))
            spread = np.where((ax <= half[0] + 1e-12) & (ay <= half[1] + 1e-12), np.pi, spread)
            turned = np.abs(wrap(middle[:, None] - beta - ticks[2]))
            keep &= ok[:, None] & (turned <= spread[:, None] + bounds[1] + half[2] + 1e-9)
        keep = keep.reshape(n, n, n)
        if not keep.any():
            break
        new_lo, new_hi = lo.copy(), hi.copy()
        for i in range(3):
            axes = tuple(j for j in range(3) if j != i)
            hit = np.flatnonzero(keep.any(axis=axes))
            new_lo[i] = lo[i] + 2 * half[i] * hit[0]
            new_hi[i] = min(hi[i], lo[i] + 2 * half[i] * (hit[-1] + 1))
        lo, hi = new_lo, new_hi
    return np.array([lo[0], hi[0], lo[1], hi[1]]), np.array([lo[2], hi[2]])
""",
)

right(
    "10-narrow",
    "slices of the heading, a polygon each, bisected where it counts",
    """
def narrow(robot, heading, objects, z, bounds):
    def polygon(low, high):
        x0, x1, y0, y1 = robot
        points = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
        if bounds[1] + (high - low) / 2 >= 1.5:
            return points
        for place, sight in zip(objects, z):
            box = np.array([place[0], place[0], place[1], place[1]])
            for a, b, c in edges(sight, bounds, np.array([low, high]) + np.pi, box):
                room = [c + 1e-12 - a * p - b * q for p, q in points]
                new = []
                for i in range(len(points)):
                    j = (i + 1) % len(points)
                    (p, q), (u, v) = points[i], points[j]
                    if room[i] >= 0:
                        new.append((p, q))
                    if room[i] * room[j] < 0:
                        t = room[i] / (room[i] - room[j])
                        new.append((p + t * (u - p), q + t * (v - q)))
                points = new
                if not points:
                    return points
        return points

    low, high = float(heading[0]), float(heading[1])
    pieces = [(low, high, polygon(low, high))]
    for level in range(6):
        if pieces[-1][1] - pieces[0][0] < 0.01 or len(pieces) > 20:
            break
        new = []
        for a, b, _ in pieces:
            m = (a + b) / 2
            for c, d in ((a, m), (m, b)):
                points = polygon(c, d)
                if points:
                    new.append((c, d, points))
        pieces = new or pieces
    corners = np.array([p for piece in pieces for p in piece[2]])
    box = np.array(
        [corners[:, 0].min(), corners[:, 0].max(), corners[:, 1].min(), corners[:, 1].max()]
    )
    return box, np.array([pieces[0][0], pieces[-1][1]])
""",
)

wrong(
    "10-narrow",
    "returns what it was given",
    """
def narrow(robot, heading, objects, z, bounds):
    return np.array(robot), np.array(heading)
""",
)

wrong(
    "10-narrow",
    "one round of look and no more",
    """
def narrow(robot, heading, objects, z, bounds):
    found = look(robot, heading, objects, z, bounds)
    if found is None:
        return robot, heading
    return found
""",
)

wrong(
    "10-narrow",
    "look again until nothing shrinks: three times as wide as need be",
    """
def narrow(robot, heading, objects, z, bounds):
    robot, heading = np.array(robot), np.array(heading)
    for _ in range(30):
        before = np.concatenate([robot, heading])
        result = look(robot, heading, objects, z, bounds)
        if result is None:
            break
        robot, heading = result
        if np.allclose(before, np.concatenate([robot, heading]), atol=1e-4):
            break
    return robot, heading
""",
)

wrong(
    "10-narrow",
    "random poses that agree, and a box round them: misses the farthest",
    """
def narrow(robot, heading, objects, z, bounds):
    rng = np.random.default_rng(0)
    lo = np.array([robot[0], robot[2], heading[0]])
    hi = np.array([robot[1], robot[3], heading[1]])
    for _ in range(4):
        poses = rng.uniform(lo, hi, (20_000, 3))
        good = np.ones(len(poses), dtype=bool)
        for (x, y), (r, beta) in zip(objects, z):
            dx, dy = x - poses[:, 0], y - poses[:, 1]
            good &= np.abs(np.hypot(dx, dy) - r) <= bounds[0]
            good &= np.abs(wrap(np.arctan2(dy, dx) - poses[:, 2] - beta)) <= bounds[1]
        if good.sum() < 10:
            break
        lo, hi = poses[good].min(axis=0), poses[good].max(axis=0)
    return np.array([lo[0], hi[0], lo[1], hi[1]]), np.array([lo[2], hi[2]])
""",
)

wrong(
    "10-narrow",
    "random poses, and five percent more on each side for safety",
    """
def narrow(robot, heading, objects, z, bounds):
    rng = np.random.default_rng(3)
    first_lo = lo = np.array([robot[0], robot[2], heading[0]])
    first_hi = hi = np.array([robot[1], robot[3], heading[1]])
    for _ in range(4):
        poses = rng.uniform(lo, hi, (15_000, 3))
        good = np.ones(len(poses), dtype=bool)
        for (x, y), (r, beta) in zip(objects, z):
            dx, dy = x - poses[:, 0], y - poses[:, 1]
            good &= np.abs(np.hypot(dx, dy) - r) <= bounds[0]
            good &= np.abs(wrap(np.arctan2(dy, dx) - poses[:, 2] - beta)) <= bounds[1]
        if good.sum() < 5:
            break
        a, b = poses[good].min(axis=0), poses[good].max(axis=0)
        lo, hi = np.maximum(first_lo, a - 0.05 * (b - a)), np.minimum(first_hi, b + 0.05 * (b - a))
    return np.array([lo[0], hi[0], lo[1], hi[1]]), np.array([lo[2], hi[2]])
""",
)

wrong(
    "10-narrow",
    "look, then everything shrunk to a third about its middle",
    """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(5):
        found = look(robot, heading, objects, z, bounds)
        if found is None:
            break
        robot, heading = found
    robot, heading = np.array(robot, dtype=float), np.array(heading, dtype=float)
    for k, interval in ((0, robot[:2]), (2, robot[2:])):
        m, w = interval.mean(), interval[1] - interval[0]
        robot[k : k + 2] = m - w / 6, m + w / 6
    m, w = heading.mean(), heading[1] - heading[0]
    return robot, np.array([m - w / 6, m + w / 6])
""",
)

wrong(
    "10-narrow",
    "slices of the heading taken as exact headings (their middles)",
    """
def narrow(robot, heading, objects, z, bounds):
    boxes, angles = [], []
    for theta in np.linspace(heading[0], heading[1], 40):
        box = robot
        for place, sight in zip(objects, z):
            lines = edges(sight, bounds, np.array([theta, theta]) + np.pi, np.repeat(place, 2))
            box = cut(box, lines)
            if box is None:
                break
        if box is not None:
            boxes.append(box)
            angles.append(theta)
    if not boxes:
        return robot, heading
    b = np.array(boxes)
    box = np.array([b[:, 0].min(), b[:, 1].max(), b[:, 2].min(), b[:, 3].max()])
    return box, np.array([angles[0], angles[-1]])
""",
)

wrong(
    "10-narrow",
    "the last kept slice counts with its right end only",
    """
def narrow(robot, heading, objects, z, bounds):
    ends = np.linspace(heading[0], heading[1], 31)
    boxes, angles = [], []
    for k in range(30):
        piece = np.array([ends[k], ends[k + 1]])
        found = robot, piece
        for _ in range(3):
            if found is not None:
                found = look(*found, objects, z, bounds)
        if found is not None:
            boxes.append(found[0])
            angles.append(ends[k])
    b = np.array(boxes)
    return (
        np.array([b[:, 0].min(), b[:, 1].max(), b[:, 2].min(), b[:, 3].max()]),
        np.array([min(angles), max(angles)]),
    )
""",
)

wrong(
    "10-narrow",
    "slices and polygons, but the edges not turned by pi",
    """
def narrow(robot, heading, objects, z, bounds):
    def rest(corners, edge):
        a, b, c = edge
        kept = []
        for (x, y), (u, v) in zip(corners, corners[1:] + corners[:1], strict=True):
            here, there = c - a * x - b * y, c - a * u - b * v
            if here >= 0:
                kept.append((x, y))
            if (here >= 0) != (there >= 0):
                t = here / (here - there)
                kept.append((x + t * (u - x), y + t * (v - y)))
        return kept

    ends = np.linspace(*heading, 25)
    every, angles = [], []
    for piece in zip(ends[:-1], ends[1:]):
        x0, x1, y0, y1 = robot
        corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
        for place, sight in zip(objects, z):
            for edge in edges(sight, bounds, piece, np.repeat(place, 2)):
                corners = rest(corners, edge)
        if corners:
            every += corners
            angles += piece
    if not every:
        return robot, heading
    x, y = np.array(every).T
    return np.array([x.min(), x.max(), y.min(), y.max()]), np.array([min(angles), max(angles)])
""",
)

wrong(
    "10-narrow",
    "only four slices of the heading: sound, still wide",
    """
def narrow(robot, heading, objects, z, bounds):
    ends = np.linspace(heading[0], heading[1], 5)
    found = []
    for piece in zip(ends[:-1], ends[1:]):
        one = look(robot, np.array(piece), objects, z, bounds)
        if one is not None:
            found.append(np.concatenate(one))
    found = np.array(found)
    low, high = found.min(axis=0), found.max(axis=0)
    return np.array([low[0], high[1], low[2], high[3]]), np.array([low[4], high[5]])
""",
)

wrong(
    "10-narrow",
    "box and heading changed in place",
    """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(3):
        ends = np.linspace(heading[0], heading[1], 17)
        found = []
        for k in range(16):
            one = look(robot.copy(), ends[k : k + 2].copy(), objects, z, bounds)
            if one is not None:
                found.append(np.concatenate(one))
        if not found:
            break
        found = np.array(found)
        robot[::2], robot[1::2] = found[:, [0, 2]].min(axis=0), found[:, [1, 3]].max(axis=0)
        heading[0], heading[1] = found[:, 4].min(), found[:, 5].max()
    return robot, heading
""",
)

wrong(
    "10-narrow",
    "the best pose by least squares, plus and minus the bounds",
    """
def narrow(robot, heading, objects, z, bounds):
    p = np.array([(robot[0] + robot[1]) / 2, (robot[2] + robot[3]) / 2, np.mean(heading)])
    for _ in range(10):
        rows, rest = [], []
        for (x, y), (r, beta) in zip(objects, z):
            dx, dy = x - p[0], y - p[1]
            q = np.hypot(dx, dy) + 1e-9
            rows += [[-dx / q, -dy / q, 0], [dy / q**2, -dx / q**2, -1]]
            rest += [r - q, wrap(beta - np.arctan2(dy, dx) + p[2])]
        if rows:
            p = p + np.linalg.lstsq(np.array(rows), np.array(rest), rcond=None)[0]
    box = np.array([p[0] - bounds[0], p[0] + bounds[0], p[1] - bounds[0], p[1] + bounds[0]])
    return box, np.array([p[2] - bounds[1], p[2] + bounds[1]])
""",
)

wrong(
    "10-narrow",
    "crashes without objects (concatenates nothing)",
    """
def narrow(robot, heading, objects, z, bounds):
    every = []
    ends = np.linspace(heading[0], heading[1], 25)
    for low, high in zip(ends[:-1], ends[1:]):
        lines = [
            edges(s, bounds, np.array([low, high]) + np.pi, np.repeat(p, 2))
            for p, s in zip(objects, z)
        ]
        lines = np.concatenate(lines)
        box = robot
        for _ in range(2):
            box = cut(box, lines)
        if box is not None:
            every.append([*box, low, high])
    e = np.array(every)
    return (
        np.array([e[:, 0].min(), e[:, 1].max(), e[:, 2].min(), e[:, 3].max()]),
        np.array([e[:, 4].min(), e[:, 5].max()]),
    )
""",
)

wrong(
    "10-narrow",
    "600 slices, three rounds: small and far too slow",
    """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(3):
        ends = np.linspace(heading[0], heading[1], 601)
        found = []
        for k in range(600):
            one = robot, ends[k : k + 2]
            for _ in range(3):
                if one is not None:
                    one = look(*one, objects, z, bounds)
            if one is not None:
                found.append(np.concatenate(one))
        if not found:
            break
        f = np.array(found)
        robot = np.array([f[:, 0].min(), f[:, 1].max(), f[:, 2].min(), f[:, 3].max()])
        heading = np.array([f[:, 4].min(), f[:, 5].max()])
    return robot, heading
""",
)

wrong(
    "10-narrow",
    "only the first three sightings are used",
    """
def narrow(robot, heading, objects, z, bounds):
    ends = np.linspace(heading[0], heading[1], 25)
    found = []
    for k in range(24):
        one = robot, ends[k : k + 2]
        for _ in range(3):
            if one is not None:
                one = look(*one, objects[:3], z[:3], bounds)
        if one is not None:
            found.append(np.concatenate(one))
    if not found:
        return robot, heading
    f = np.array(found)
    box = np.array([f[:, 0].min(), f[:, 1].max(), f[:, 2].min(), f[:, 3].max()])
    return box, np.array([f[:, 4].min(), f[:, 5].max()])
""",
)

wrong(
    "10-narrow",
    "only ranges, by rings seen from the objects; the heading stays",
    """
def narrow(robot, heading, objects, z, bounds):
    robot = np.array(robot)
    for _ in range(3):
        for place, sight in zip(objects, z):
            box = ring(np.repeat(place, 2), robot, sight[0], bounds[0])
            if box is not None:
                robot = box
    return robot, np.array(heading)
""",
)

wrong(
    "10-narrow",
    "heading sharpened with the robot in the middle of its box",
    """
def narrow(robot, heading, objects, z, bounds):
    for _ in range(4):
        found = look(robot, heading, objects, z, bounds)
        if found is None:
            break
        robot, heading = found
        x, y = (robot[0] + robot[1]) / 2, (robot[2] + robot[3]) / 2
        for place, sight in zip(objects, z):
            new = sharpen(heading, np.array([x, x, y, y]), np.repeat(place, 2), sight[1], bounds[1])
            if new[0] <= new[1]:
                heading = new
    return robot, heading
""",
)

wrong(
    "10-narrow",
    "cells of pose space judged by their middles",
    """
def narrow(robot, heading, objects, z, bounds):
    lo = np.array([robot[0], robot[2], heading[0]], dtype=float)
    hi = np.array([robot[1], robot[3], heading[1]], dtype=float)
    for _ in range(4):
        n = 20
        step = (hi - lo) / n
        axes = [lo[i] + step[i] * (np.arange(n) + 0.5) for i in range(3)]
        x, y, t = (a.ravel() for a in np.meshgrid(*axes, indexing="ij"))
        ok = np.ones(x.size, dtype=bool)
        for (ox, oy), (r, b) in zip(objects, z):
            ok &= np.abs(np.hypot(ox - x, oy - y) - r) <= bounds[0]
            ok &= np.abs(wrap(np.arctan2(oy - y, ox - x) - t - b)) <= bounds[1]
        if not ok.any():
            break
        cells = np.column_stack([x, y, t])[ok]
        lo, hi = cells.min(axis=0) - step / 2, cells.max(axis=0) + step / 2
    return np.array([lo[0], hi[0], lo[1], hi[1]]), np.array([lo[2], hi[2]])
""",
)
