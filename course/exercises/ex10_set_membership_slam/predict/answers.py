# %% way: extremes listed
def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    first, last = np.ceil(low / (np.pi / 2)), np.floor(high / (np.pi / 2))
    course = [low, high, *np.arange(first, last + 1) * np.pi / 2]
    x = [w * np.cos(a) for w in way for a in course]
    y = [w * np.sin(a) for w in way for a in course]
    return box[0] + min(x), box[1] + max(x), box[2] + min(y), box[3] + max(y)

# %% way: whole turns counted
def spread(low, high, extreme):
    turn = 2 * np.pi
    return np.floor((high - extreme) / turn) >= np.ceil((low - extreme) / turn)


def predict(box, heading, way, direction):
    low, high = np.add(heading, direction)
    found = np.array(box, dtype=float)
    for k, quarter in ((0, 0), (2, np.pi / 2)):
        values = [np.cos(low - quarter), np.cos(high - quarter)]
        if spread(low, high, quarter):
            values.append(1.0)
        if spread(low, high, quarter + np.pi):
            values.append(-1.0)
        moved = [w * value for w in way for value in values]
        found[k] += min(moved)
        found[k + 1] += max(moved)
    return found

# %% way: complex numbers
def predict(box, heading, way, direction):
    low, wide = heading[0] + direction[0], heading[1] - heading[0] + direction[1] - direction[0]
    compass = [low + (k * np.pi / 2 - low) % (2 * np.pi) for k in range(4)]
    tips = np.exp(1j * np.array([low, low + wide] + [a for a in compass if a <= low + wide]))
    ends = np.concatenate([way[0] * tips, way[1] * tips])
    away = [ends.real.min(), ends.real.max(), ends.imag.min(), ends.imag.max()]
    return list(np.add(box, away))

# %% way: rounded outwards
def reach(low, high, way):
    inside = [a for a in (0.0, np.pi) if (a - low) % (2 * np.pi) <= high - low]
    moved = np.outer(way, np.cos([low, high, *inside]))
    return np.array([moved.min() - 1e-9, moved.max() + 1e-9])


def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    moved = np.concatenate([reach(low, high, way), reach(low - np.pi / 2, high - np.pi / 2, way)])
    return box + moved

# %% right: candidate angles: both ends and all multiples of pi/2 between them, corners of distance
def predict(box, heading, way, direction):
    lo, hi = heading[0] + direction[0], heading[1] + direction[1]
    q = np.pi / 2
    k0, k1 = int(np.ceil(lo / q)), int(np.floor(hi / q))
    angles = [lo, hi]
    xs = [d * np.cos(a) for d in way for a in angles]
    ys = [d * np.sin(a) for d in way for a in angles]
    exact = {0: (1, 0), 1: (0, 1), 2: (-1, 0), 3: (0, -1)}
    for k in range(k0, min(k1, k0 + 4) + 1):
        c, s = exact[k % 4]
        xs += [way[0] * c, way[1] * c]
        ys += [way[0] * s, way[1] * s]
    return np.array([box[0] + min(xs), box[1] + max(xs), box[2] + min(ys), box[3] + max(ys)])

# %% right: math and ceil, own interval product
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

# %% wrong: crests are sought at 0, pi/2, pi, -pi/2 alone, so they are missed where the angles lie on another turn
def predict(box, heading, way, direction):
    a0, a1 = heading[0] + direction[0], heading[1] + direction[1]
    angles = [a0, a1] + [a for a in (-np.pi / 2, 0, np.pi / 2, np.pi) if a0 <= a <= a1]
    dx = [d * np.cos(a) for d in way for a in angles]
    dy = [d * np.sin(a) for d in way for a in angles]
    return np.array([box[0] + min(dx), box[1] + max(dx), box[2] + min(dy), box[3] + max(dy)])

# %% wrong: the width of the directions is taken modulo 2 pi, so more than a whole turn becomes a small piece
def predict(box, heading, way, direction):
    low = (heading[0] + direction[0]) % (2 * np.pi)
    width = (heading[1] + direction[1] - heading[0] - direction[0]) % (2 * np.pi)
    quarter = np.arange(0, 9) * np.pi / 2
    angles = np.concatenate([[low, low + width], quarter[(quarter >= low) & (quarter <= low + width)]])
    dx, dy = np.outer(way, np.cos(angles)), np.outer(way, np.sin(angles))
    return np.array([box[0] + dx.min(), box[1] + dx.max(), box[2] + dy.min(), box[3] + dy.max()])

# %% wrong: extremes looked for between -2 pi and 2 pi: 14 rad forgotten
def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    special = np.arange(-4, 5) * np.pi / 2
    angles = np.append(special[(special >= low) & (special <= high)], [low, high])
    reach = np.array([[w * np.cos(angles), w * np.sin(angles)] for w in way])
    smallest, largest = reach.min(axis=(0, 2)), reach.max(axis=(0, 2))
    return np.array(
        [box[0] + smallest[0], box[1] + largest[0], box[2] + smallest[1], box[3] + largest[1]]
    )

# %% wrong: a hundred thousand directions, and some nanometres outwards
def predict(box, heading, way, direction):
    angles = np.linspace(heading[0] + direction[0], heading[1] + direction[1], 100_000)
    x, y = np.outer(way, np.cos(angles)), np.outer(way, np.sin(angles))
    return box + [x.min() - 4e-9, x.max() + 4e-9, y.min() - 4e-9, y.max() + 4e-9]

# %% wrong: the box is changed in place
def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    quarter = np.pi / 2
    k = np.arange(np.ceil(low / quarter), np.floor(high / quarter) + 1)
    angles = np.concatenate([[low, high], k * quarter])
    dx, dy = np.outer(way, np.cos(angles)), np.outer(way, np.sin(angles))
    box += np.array([dx.min(), dx.max(), dy.min(), dy.max()])
    return box

# %% wrong: the way's length is assumed not negative (backing forgotten)
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
