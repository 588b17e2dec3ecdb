"""Independent answers to 10-predict: right ones, and students' mistakes."""

RIGHT = [
    (
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
    ),
    (
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
    ),
]

WRONG = [
    (
        "10-predict",
        "only the two ends of the heading are tried",
        """
def predict(box, heading, way, direction):
    ends = np.array([heading[0] + direction[0], heading[1] + direction[1]])
    dx = np.outer(way, np.cos(ends))
    dy = np.outer(way, np.sin(ends))
    return np.array([box[0] + dx.min(), box[1] + dx.max(), box[2] + dy.min(), box[3] + dy.max()])
""",
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
]
