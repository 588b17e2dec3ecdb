"""Independent answers to exercise 14, written before any check was seen."""

RIGHT = []
WRONG = []


def right(task, what, source):
    RIGHT.append((task, what, source.strip("\n") + "\n"))


def wrong(task, what, source):
    WRONG.append((task, what, source.strip("\n") + "\n"))


# ---------------------------------------------------------------- RIGHT: nodes
right(
    "14-nodes",
    "vectorised with reshape",
    """
def nodes(data):
    b = np.array(list(data), dtype=int).reshape(-1, 5)
    s, ns, c = b[:, 0] & 1, (b[:, 0] >> 1) & 1, b[:, 1] & 1
    ok = (s + ns == 1) & (c == 1)
    angle = ((b[:, 1] + 256 * b[:, 2]) >> 1) / 64
    mm = (b[:, 3] + 256 * b[:, 4]) / 4
    return np.column_stack([s, b[:, 0] >> 2, angle, mm])[ok]
""",
)
right(
    "14-nodes",
    "struct, list of tuples",
    """
import struct

def nodes(data):
    rows = []
    for flags, angle, dist in struct.iter_unpack("<BHH", bytes(data)):
        if flags & 3 in (1, 2) and angle % 2:
            rows.append((flags % 2, flags // 4, angle // 2 / 64, dist * 0.25))
    return rows
""",
)
right(
    "14-nodes",
    "strings of bits",
    """
def nodes(data):
    result = []
    while len(data) >= 5:
        five, data = data[:5], data[5:]
        bits = [format(b, "08b")[::-1] for b in five]
        s, not_s, c = bits[0][0], bits[0][1], bits[1][0]
        if s == not_s or c == "0":
            continue
        q = int(bits[0][2:][::-1], 2)
        a = int((bits[1] + bits[2])[1:][::-1], 2)
        d = int((bits[3] + bits[4])[::-1], 2)
        result.append([int(s), q, a / 64, d / 4])
    return np.array(result, dtype=np.float32)
""",
)
# ---------------------------------------------------------------- RIGHT: sweep
right(
    "14-sweep",
    "struct and linspace, positive angles",
    """
import struct

def sweep(data):
    data = bytes(data)
    n = data[1]
    if data[0] != 0x54:
        return None
    if len(data) != 7 + 3 * n:
        return None
    if (sum(data) - data[-1]) % 256 != data[-1]:
        return None
    first, = struct.unpack_from("<H", data, 2)
    last, = struct.unpack_from("<H", data, 4 + 3 * n)
    if last < first:
        last += 36000
    degrees = np.linspace(first, last, n) / 100
    mm = np.array([m for m, strength in struct.iter_unpack("<HB", data[4:-3])], dtype=float)
    rays = np.column_stack([(2 * np.pi - np.radians(degrees)) % (2 * np.pi), mm / 1000])
    return rays[mm > 0]
""",
)
right(
    "14-sweep",
    "numpy, angles in -pi to pi",
    """
def sweep(data):
    b = np.array(list(data), dtype=np.int64)
    n = int(b[1])
    good = b[0] == 84 and b.size == 3 * n + 7 and (b[:-1].sum() & 255) == b[-1]
    if not good:
        return None
    p = b[4:-3].reshape(n, 3)
    r = (p[:, 0] + (p[:, 1] << 8)) * 1e-3
    a0, a1 = (b[2] + 256 * b[3]) / 100, (b[-3] + 256 * b[-2]) / 100
    turned = (a1 - a0) % 360
    k = np.arange(n)
    a = a0 + (k * turned / (n - 1) if n > 1 else 0 * k)
    phi = -np.deg2rad(a)
    phi = np.arctan2(np.sin(phi), np.cos(phi))
    return np.array([phi, r]).T[r > 0]
""",
)
# -------------------------------------------------------------- RIGHT: command
right(
    "14-command",
    "bytes.hex and struct",
    """
import struct

def command(speed, turn):
    body = struct.pack(">Bbb", 1, min(max(speed, -100), 100), min(max(turn, -100), 100))
    total = sum(body)
    return "#" + (body + bytes([(256 - total % 256) % 256])).hex().upper() + "/"
""",
)
right(
    "14-command",
    "if and else, one step at a time",
    """
def cut(value):
    if value > 100:
        value = 100
    elif value < -100:
        value = -100
    if value < 0:
        value = 256 + value
    return value


def command(speed, turn):
    t = cut(speed)
    r = cut(turn)
    c = 0
    while (1 + t + r + c) % 256 != 0:
        c = c + 1
    return "#01%02X%02X%02X/" % (t, r, c)
""",
)
# --------------------------------------------------------------- RIGHT: unwrap
right(
    "14-unwrap",
    "np.unwrap with a period",
    """
def unwrap(values):
    values = np.array(values, dtype=int)
    return np.unwrap(values, period=256) - values[0]
""",
)
right(
    "14-unwrap",
    "int8 wraps by itself",
    """
def unwrap(values):
    small = np.array(values).astype(np.int8)
    steps = np.diff(small).astype(np.int64)
    return np.append(0, steps.cumsum()).astype(int)
""",
)
right(
    "14-unwrap",
    "a loop, returns a list",
    """
def unwrap(values):
    total, result = 0, [0]
    for before, now in zip(values[:-1], values[1:]):
        step = int(now) - int(before)
        if step > 127:
            step -= 256
        if step < -127:
            step += 256
        total += step
        result.append(total)
    return result
""",
)
# --------------------------------------------------------------- RIGHT: trials
right(
    "14-trials",
    "many ways, each for a promise",
    """
def trials():
    up = list(range(0, 128))
    zigzag = []
    for k in up:
        zigzag += [k, -k]
    ways = [way(0, []), way(-128, []), ([], []), way(127, [])]
    ways.append(way(127, zigzag))
    ways.append(way(-128, [127] * 265))
    ways.append(way(127, [-127] * 265))
    ways.append(way(-128, [-1, 1, 0, 0, 1, -1]))
    ways.append(way(127, [1, 1, -1, -1, -127, 127]))
    ways.append(([], []))
    ways.append(way(0, [0] * 10))
    ways.append(way(0, [1] * 60))
    ways.append(way(0, [-1] * 60))
    return ways
""",
)
right(
    "14-trials",
    "random steps besides the long ones",
    """
def trials():
    rng = np.random.default_rng(14)
    steps = rng.permutation(np.arange(-127, 128))
    result = [way(-7, steps), way(100, [127] * 262), way(-100, [-127] * 262)]
    for begin in (-128, 127, 0, 60):
        result.append((np.array([], dtype=int), np.array([], dtype=int)))
        result.append(way(begin, []))
        result.append(way(begin, [-127, 127, 0, 126, -126, 1, -1]))
    result.append(way(12, rng.integers(-127, 128, 100)))
    return [(list(map(int, v)), list(map(int, c))) for v, c in result]
""",
)

# ---------------------------------------------------------------- WRONG: nodes
wrong(
    "14-nodes",
    "angle not shifted past C",
    """
def nodes(data):
    out = []
    for i in range(len(data) // 5):
        b = data[5 * i : 5 * i + 5]
        if (b[0] & 1) == (b[0] >> 1 & 1) or not b[1] & 1:
            continue
        angle = (b[1] + 256 * b[2]) / 64
        out.append([b[0] & 1, b[0] >> 2, angle, (b[3] + 256 * b[4]) / 4])
    return np.array(out)
""",
)
wrong(
    "14-nodes",
    "C masked off the word but not shifted",
    """
def nodes(data):
    out = []
    for i in range(0, len(data), 5):
        f, a, d = data[i], data[i + 1] | data[i + 2] << 8, data[i + 3] | data[i + 4] << 8
        if f % 4 in (1, 2) and a & 1:
            out.append([f & 1, f >> 2, (a & 0xFFFE) / 64, d / 4])
    return out
""",
)
wrong(
    "14-nodes",
    "big endian",
    """
import struct

def nodes(data):
    rows = []
    for f, a, d in struct.iter_unpack(">BHH", bytes(data)):
        if f & 1 != f >> 1 & 1 and a & 1:
            rows.append((f & 1, f >> 2, (a >> 1) / 64, d / 4))
    return rows
""",
)
wrong(
    "14-nodes",
    "signed distance",
    """
import struct

def nodes(data):
    rows = []
    for f, a, d in struct.iter_unpack("<BHh", bytes(data)):
        if f & 1 != f >> 1 & 1 and a & 1:
            rows.append((f & 1, f >> 2, (a >> 1) / 64, d / 4))
    return rows
""",
)
wrong(
    "14-nodes",
    "signed angle word",
    """
import struct

def nodes(data):
    good = []
    for k in range(0, len(data), 5):
        f, a, d = struct.unpack("<BhH", bytes(data[k : k + 5]))
        if (f ^ f >> 1) & 1 and a & 1:
            good.append([f & 1, f >> 2, (a >> 1) / 64.0, d / 4.0])
    return np.array(good)
""",
)
wrong(
    "14-nodes",
    "uint8 overflows in the shift",
    """
def nodes(data):
    b = np.frombuffer(bytes(data), np.uint8).reshape(-1, 5)
    s = b[:, 0] & 1
    ok = (s != (b[:, 0] >> 1 & 1)) & (b[:, 1] & 1 == 1)
    angle = (b[:, 1] | b[:, 2] << 8) >> 1
    dist = b[:, 3] | b[:, 4] << 8
    return np.column_stack([s, b[:, 0] >> 2, angle / 64, dist / 4])[ok]
""",
)
wrong(
    "14-nodes",
    "also leaves out empty distances",
    """
def nodes(data):
    b = np.array(list(data), dtype=int).reshape(-1, 5)
    s = b[:, 0] & 1
    d = b[:, 3] + 256 * b[:, 4]
    ok = (s != (b[:, 0] >> 1 & 1)) & (b[:, 1] & 1 == 1) & (d > 0)
    a = (b[:, 1] + 256 * b[:, 2]) >> 1
    return np.column_stack([s, b[:, 0] >> 2, a / 64, d / 4])[ok]
""",
)
wrong(
    "14-nodes",
    "C not looked at",
    """
def nodes(data):
    found = []
    for at in range(0, len(data), 5):
        flags, a, b, c, d = data[at : at + 5]
        if flags & 3 == 1 or flags & 3 == 2:
            found.append([flags & 1, flags >> 2, ((a | b << 8) >> 1) / 64, (c | d << 8) / 4])
    return np.array(found)
""",
)
wrong(
    "14-nodes",
    "only S = not S = 1 is damaged",
    """
def nodes(data):
    found = []
    for at in range(0, len(data), 5):
        flags, a, b, c, d = data[at : at + 5]
        s, not_s = flags & 1, (flags & 2) >> 1
        if s and not_s:
            continue
        if a & 1 == 0:
            continue
        found.append([s, flags >> 2, ((a | b << 8) >> 1) / 64, (c | d << 8) / 4])
    return np.array(found)
""",
)
wrong(
    "14-nodes",
    "not S compared without its shift",
    """
def nodes(data):
    found = []
    for at in range(0, len(data), 5):
        flags, a, b, c, d = data[at : at + 5]
        word = a + 256 * b
        if flags & 1 == flags & 2 or not word & 1:
            continue
        found.append([flags & 1, flags >> 2, (word >> 1) / 64, (c + 256 * d) / 4])
    return np.array(found)
""",
)
wrong(
    "14-nodes",
    "stops at the first damaged node",
    """
def nodes(data):
    found = []
    for at in range(0, len(data), 5):
        flags, a, b, c, d = data[at : at + 5]
        if flags & 1 == flags >> 1 & 1 or not a & 1:
            break
        found.append([flags & 1, flags >> 2, ((a | b << 8) >> 1) / 64, (c | d << 8) / 4])
    return np.array(found)
""",
)
wrong(
    "14-nodes",
    "steps on by one byte after a damaged node",
    """
def nodes(data):
    found, at = [], 0
    while at + 5 <= len(data):
        flags, a, b, c, d = data[at : at + 5]
        if (flags & 1) + (flags >> 1 & 1) != 1 or a & 1 == 0:
            at += 1
            continue
        found.append([flags & 1, flags >> 2, ((a | b << 8) >> 1) / 64, (c | d << 8) / 4])
        at += 5
    return found
""",
)
wrong(
    "14-nodes",
    "the last node is lost",
    """
def nodes(data):
    found, at = [], 0
    while at < len(data) - 5:
        flags, a, b, c, d = data[at : at + 5]
        at += 5
        if flags & 1 != flags >> 1 & 1 and a & 1:
            found.append([flags & 1, flags >> 2, ((a | b << 8) >> 1) / 64, (c | d << 8) / 4])
    return np.array(found)
""",
)
wrong(
    "14-nodes",
    "quality cut to four bits",
    """
def nodes(data):
    def one(f, a, b, c, d):
        return [f & 1, f >> 2 & 0x0F, (a + 256 * b) // 2 / 64, (c + 256 * d) / 4]
    fives = [data[k : k + 5] for k in range(0, len(data), 5)]
    return [one(*five) for five in fives if five[0] & 3 in (1, 2) and five[1] & 1]
""",
)
wrong(
    "14-nodes",
    "quality masked, not shifted",
    """
def nodes(data):
    def one(f, a, b, c, d):
        return [f & 1, f & 63, (a + 256 * b) // 2 / 64, (c + 256 * d) / 4]
    fives = [data[k : k + 5] for k in range(0, len(data), 5)]
    return [one(*five) for five in fives if five[0] & 3 in (1, 2) and five[1] & 1]
""",
)
wrong(
    "14-nodes",
    "whole degrees and millimetres only",
    """
def nodes(data):
    found = []
    for at in range(0, len(data), 5):
        flags, a, b, c, d = data[at : at + 5]
        word, distance = a | b << 8, c | d << 8
        if flags & 1 != flags >> 1 & 1 and word & 1:
            found.append([flags & 1, flags >> 2, (word >> 1) // 64, distance // 4])
    return np.array(found)
""",
)
wrong(
    "14-nodes",
    "no bytes at all: IndexError",
    """
def nodes(data):
    rows = np.array([list(data[k : k + 5]) for k in range(0, len(data), 5)])
    s = rows[:, 0] & 1
    keep = (s != rows[:, 0] // 2 % 2) & (rows[:, 1] % 2 == 1)
    a = (rows[:, 1] + 256 * rows[:, 2]) // 2 / 64
    d = (rows[:, 3] + 256 * rows[:, 4]) / 4
    return np.stack([s, rows[:, 0] // 4, a, d], axis=1)[keep]
""",
)
wrong(
    "14-nodes",
    "distance before angle",
    """
def nodes(data):
    found = []
    for f, a, b, c, d in zip(*[iter(data)] * 5):
        if f & 1 != f >> 1 & 1 and a & 1:
            found.append([f & 1, f >> 2, (c | d << 8) / 4, ((a | b << 8) >> 1) / 64])
    return np.array(found)
""",
)
wrong(
    "14-nodes",
    "sorted by angle",
    """
def nodes(data):
    found = []
    for f, a, b, c, d in zip(*[iter(data)] * 5):
        if f & 1 != f >> 1 & 1 and a & 1:
            found.append([f & 1, f >> 2, ((a | b << 8) >> 1) / 64, (c | d << 8) / 4])
    return sorted(found, key=lambda row: row[2])
""",
)
wrong(
    "14-nodes",
    "only nodes that begin a turn are good",
    """
def nodes(data):
    found = []
    for f, a, b, c, d in zip(*[iter(data)] * 5):
        if f & 3 == 1 and a & 1:
            found.append([1, f >> 2, ((a | b << 8) >> 1) / 64, (c | d << 8) / 4])
    return found
""",
)
wrong(
    "14-nodes",
    "quality 0 taken for damage",
    """
def nodes(data):
    found = []
    for f, a, b, c, d in zip(*[iter(data)] * 5):
        quality = f >> 2
        if not quality or f & 1 == f >> 1 & 1 or not a & 1:
            continue
        found.append([f & 1, quality, ((a | b << 8) >> 1) / 64, (c | d << 8) / 4])
    return found
""",
)
wrong(
    "14-nodes",
    "None when no node is good",
    """
def nodes(data):
    found = [
        [f & 1, f >> 2, ((a | b << 8) >> 1) / 64, (c | d << 8) / 4]
        for f, a, b, c, d in (data[k : k + 5] for k in range(0, len(data), 5))
        if f & 1 != f >> 1 & 1 and a & 1
    ]
    return np.array(found) if found else None
""",
)
wrong(
    "14-nodes",
    "S read from not S",
    """
def nodes(data):
    found = []
    for at in range(0, len(data), 5):
        flags, a, b, c, d = data[at : at + 5]
        word, distance = a | b << 8, c | d << 8
        if flags & 1 != flags >> 1 & 1 and word & 1:
            found.append([flags >> 1 & 1, flags >> 2, (word >> 1) / 64, distance / 4])
    return np.array(found)
""",
)

# ---------------------------------------------------------------- WRONG: sweep
_SWEEP = """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return None
"""
wrong(
    "14-sweep",
    "the lesson's formula, k / n",
    _SWEEP
    + """
    a0, a1 = data[2] + 256 * data[3], data[-3] + 256 * data[-2]
    turned = (a1 - a0) % 36000
    rays = []
    for k in range(n):
        mm = data[4 + 3 * k] + 256 * data[5 + 3 * k]
        if mm:
            rays.append((-np.radians((a0 + k / n * turned) / 100), mm / 1000))
    return np.array(rays)
""",
)
wrong(
    "14-sweep",
    "one point: division by zero",
    _SWEEP
    + """
    a0, a1 = data[2] + 256 * data[3], data[-3] + 256 * data[-2]
    step = (a1 - a0) % 36000 / (n - 1)
    rays = []
    for k in range(n):
        mm = data[4 + 3 * k] + 256 * data[5 + 3 * k]
        if mm:
            rays.append((-np.radians((a0 + k * step) / 100), mm / 1000))
    return np.array(rays)
""",
)
wrong(
    "14-sweep",
    "over 0 degree it turns back",
    _SWEEP
    + """
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    angles = -np.radians(np.linspace(a0, a1, n) / 100)
    mm = np.array([data[k] | data[k + 1] << 8 for k in range(4, 4 + 3 * n, 3)])
    return np.column_stack([angles, mm / 1000])[mm > 0]
""",
)
wrong(
    "14-sweep",
    "takes the shorter way round",
    _SWEEP
    + """
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    turned = (a1 - a0 + 18000) % 36000 - 18000
    angles = -np.radians((a0 + np.linspace(0, turned, n)) / 100)
    mm = np.array([data[k] | data[k + 1] << 8 for k in range(4, 4 + 3 * n, 3)])
    return np.column_stack([angles, mm / 1000])[mm > 0]
""",
)
wrong(
    "14-sweep",
    "equal angles taken for a full turn",
    _SWEEP
    + """
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    if a1 <= a0:
        a1 += 36000
    angles = -np.radians(np.linspace(a0, a1, n) / 100)
    mm = np.array([data[k] | data[k + 1] << 8 for k in range(4, 4 + 3 * n, 3)])
    return np.column_stack([angles, mm / 1000])[mm > 0]
""",
)
wrong(
    "14-sweep",
    "clockwise: sign forgotten",
    """
import struct

def sweep(data):
    data = bytes(data)
    if data[0] != 0x54 or len(data) != 7 + 3 * data[1] or sum(data[:-1]) & 255 != data[-1]:
        return None
    n = data[1]
    first, = struct.unpack("<H", data[2:4])
    last, = struct.unpack("<H", data[-3:-1])
    turned = (last - first) % 36000
    angle = np.deg2rad((first + turned * np.linspace(0, 1, n)) / 100)
    r = np.array([m / 1000 for m, s in struct.iter_unpack("<HB", data[4:-3])])
    return np.column_stack([angle, r])[r > 0]
""",
)
wrong(
    "14-sweep",
    "words read as signed",
    """
import struct

def sweep(data):
    data = bytes(data)
    if data[0] != 0x54 or len(data) != 7 + 3 * data[1] or sum(data[:-1]) & 255 != data[-1]:
        return None
    n = data[1]
    first, = struct.unpack("<h", data[2:4])
    last, = struct.unpack("<h", data[-3:-1])
    turned = (last - first) % 36000
    angle = -np.deg2rad((first + turned * np.linspace(0, 1, n)) / 100)
    r = np.array([m / 1000 for m, s in struct.iter_unpack("<hB", data[4:-3])])
    return np.column_stack([angle, r])[r != 0]
""",
)
wrong(
    "14-sweep",
    "big endian angles",
    """
def sweep(data):
    n, size = data[1], len(data)
    if data[0] != 0x54 or size != 3 * n + 7 or sum(data[: size - 1]) % 256 != data[size - 1]:
        return None
    a0 = int.from_bytes(bytes(data[2:4]), "big")
    a1 = int.from_bytes(bytes(data[size - 3 : size - 1]), "big")
    step = (a1 - a0) % 36000 / max(1, n - 1)
    rays = []
    for k in range(n):
        r = int.from_bytes(bytes(data[4 + 3 * k : 6 + 3 * k]), "little")
        if r:
            rays.append([-np.radians((a0 + k * step) / 100), r / 1000])
    return rays
""",
)
wrong(
    "14-sweep",
    "points without echo forgotten before the angles are spread",
    _SWEEP
    + """
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    mm = [data[4 + 3 * k] | data[5 + 3 * k] << 8 for k in range(n)]
    mm = np.array([m for m in mm if m > 0])
    degrees = np.linspace(a0, a0 + (a1 - a0) % 36000, len(mm)) / 100
    return np.column_stack([-np.radians(degrees), mm / 1000])
""",
)
wrong(
    "14-sweep",
    "angle steps only on points that came back",
    _SWEEP
    + """
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (a1 - a0) % 36000 / max(n - 1, 1)
    rays, angle = [], a0
    for k in range(n):
        r = data[4 + 3 * k] | data[5 + 3 * k] << 8
        if r == 0:
            continue
        rays.append([-np.radians(angle / 100), r / 1000])
        angle += step
    return rays
""",
)
wrong(
    "14-sweep",
    "points without echo stay in",
    _SWEEP
    + """
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (a1 - a0) % 36000 / max(n - 1, 1)
    k = np.arange(n)
    body = np.array(list(data[4:-3])).reshape(n, 3)
    return np.column_stack([-np.radians((a0 + k * step) / 100), (body[:, 0] + 256 * body[:, 1]) / 1000])
""",
)
wrong(
    "14-sweep",
    "a low byte of 0 taken for no echo",
    _SWEEP
    + """
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (a1 - a0) % 36000 / max(n - 1, 1)
    rays = []
    for k in range(n):
        low, high, _ = data[4 + 3 * k : 7 + 3 * k]
        if low:
            rays.append([-np.radians((a0 + k * step) / 100), (low + 256 * high) / 1000])
    return rays
""",
)
wrong(
    "14-sweep",
    "strength 0 taken for no echo",
    _SWEEP
    + """
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (a1 - a0) % 36000 / max(n - 1, 1)
    rays = []
    for k in range(n):
        low, high, strength = data[4 + 3 * k : 7 + 3 * k]
        if (low or high) and strength:
            rays.append([-np.radians((a0 + k * step) / 100), (low + 256 * high) / 1000])
    return rays
""",
)
wrong(
    "14-sweep",
    "strength before distance",
    _SWEEP
    + """
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (a1 - a0) % 36000 / max(n - 1, 1)
    rays = []
    for k in range(n):
        _, low, high = data[4 + 3 * k : 7 + 3 * k]
        if low or high:
            rays.append([-np.radians((a0 + k * step) / 100), (low + 256 * high) / 1000])
    return rays
""",
)
wrong(
    "14-sweep",
    "None where nothing came back",
    _SWEEP
    + """
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (a1 - a0) % 36000 / max(n - 1, 1)
    rays = [
        (-np.radians((a0 + k * step) / 100), (data[4 + 3 * k] | data[5 + 3 * k] << 8) / 1000)
        for k in range(n)
        if data[4 + 3 * k] or data[5 + 3 * k]
    ]
    return np.array(rays) if rays else None
""",
)
wrong(
    "14-sweep",
    "empty list for a damaged packet",
    """
def sweep(data):
    n = data[1]
    rays = []
    if data[0] == 0x54 and len(data) == 3 * n + 7 and sum(data[:-1]) % 256 == data[-1]:
        a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
        turned = (a1 - a0) % 36000
        for k in range(n):
            r = data[4 + 3 * k] | data[5 + 3 * k] << 8
            a = a0 + (turned * k / (n - 1) if n > 1 else 0)
            if r > 0:
                rays.append((-np.radians(a / 100), r / 1000))
    return rays
""",
)
wrong(
    "14-sweep",
    "sum not taken modulo 256",
    """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) != data[-1]:
        return None
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (a1 - a0) % 36000 / max(n - 1, 1)
    at = range(4, 4 + 3 * n, 3)
    mm = [data[k] | data[k + 1] << 8 for k in at]
    return [[-np.radians((a0 + k * step) / 100), m / 1000] for k, m in enumerate(mm) if m]
""",
)
wrong(
    "14-sweep",
    "sum without the head byte",
    """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[1:-1]) % 256 != data[-1]:
        return None
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (a1 - a0) % 36000 / max(n - 1, 1)
    mm = [data[k] | data[k + 1] << 8 for k in range(4, 4 + 3 * n, 3)]
    return [[-np.radians((a0 + k * step) / 100), m / 1000] for k, m in enumerate(mm) if m]
""",
)
wrong(
    "14-sweep",
    "sum modulo 255",
    """
def sweep(data):
    n = data[1]
    total = 0
    for byte in data[:-1]:
        total = (total + byte) % 255
    if data[0] != 0x54 or len(data) != 3 * n + 7 or total != data[-1]:
        return None
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (a1 - a0) % 36000 / max(n - 1, 1)
    mm = [data[k] | data[k + 1] << 8 for k in range(4, 4 + 3 * n, 3)]
    return [[-np.radians((a0 + k * step) / 100), m / 1000] for k, m in enumerate(mm) if m]
""",
)
wrong(
    "14-sweep",
    "sum not checked",
    """
def sweep(data):
    head, n = data[0], data[1]
    if head != 0x54 or len(data) != 7 + 3 * n:
        return None
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    k = np.arange(n)
    angle = -np.radians((a0 + k * ((a1 - a0) % 36000) / max(n - 1, 1)) / 100)
    b = np.array(list(data[4:-3])).reshape(-1, 3)
    r = (b[:, 0] + 256 * b[:, 1]) / 1000
    return np.column_stack([angle, r])[r > 0]
""",
)
wrong(
    "14-sweep",
    "head byte not checked",
    """
def sweep(data):
    n = data[1]
    if len(data) != 7 + 3 * n or sum(data[:-1]) % 256 != data[-1]:
        return None
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    k = np.arange(n)
    angle = -np.radians((a0 + k * ((a1 - a0) % 36000) / max(n - 1, 1)) / 100)
    b = np.array(list(data[4:-3])).reshape(-1, 3)
    r = (b[:, 0] + 256 * b[:, 1]) / 1000
    return np.column_stack([angle, r])[r > 0]
""",
)
wrong(
    "14-sweep",
    "a longer packet passes, the rest is cut off",
    """
def sweep(data):
    n = data[1]
    size = 3 * n + 7
    if data[0] != 0x54 or len(data) < size:
        return None
    data = data[:size]
    if sum(data[:-1]) % 256 != data[-1]:
        return None
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    k = np.arange(n)
    angle = -np.radians((a0 + k * ((a1 - a0) % 36000) / max(n - 1, 1)) / 100)
    b = np.array(list(data[4:-3])).reshape(-1, 3)
    r = (b[:, 0] + 256 * b[:, 1]) / 1000
    return np.column_stack([angle, r])[r > 0]
""",
)
wrong(
    "14-sweep",
    "length not compared with n, which is worked out instead",
    """
def sweep(data):
    if data[0] != 0x54 or (len(data) - 7) % 3 or sum(data[:-1]) % 256 != data[-1]:
        return None
    n = (len(data) - 7) // 3
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    k = np.arange(n)
    angle = -np.radians((a0 + k * ((a1 - a0) % 36000) / max(n - 1, 1)) / 100)
    b = np.array(list(data[4:-3]), dtype=int).reshape(-1, 3)
    r = (b[:, 0] + 256 * b[:, 1]) / 1000
    return np.column_stack([angle, r])[r > 0]
""",
)
wrong(
    "14-sweep",
    "reads points before it looks at the length, IndexError",
    """
def sweep(data):
    n = data[1]
    mm = np.array([data[4 + 3 * k] + 256 * data[5 + 3 * k] for k in range(n)])
    first = data[2] + 256 * data[3]
    last = data[4 + 3 * n] + 256 * data[5 + 3 * n]
    if data[0] != 0x54 or data[6 + 3 * n] != sum(data[: 6 + 3 * n]) % 256 or len(data) != 7 + 3 * n:
        return None
    angle = -np.radians((first + np.linspace(0, (last - first) % 36000, n)) / 100)
    return np.column_stack([angle, mm / 1000])[mm > 0]
""",
)
wrong(
    "14-sweep",
    "step cut to whole hundredths",
    _SWEEP
    + """
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (last - first) % 36000 // max(n - 1, 1)
    found = []
    for k in range(n):
        low, high, _ = data[4 + 3 * k : 7 + 3 * k]
        if low or high:
            found.append([-np.radians((first + k * step) / 100), (low | high << 8) / 1000])
    return found
""",
)
wrong(
    "14-sweep",
    "front taken as +y",
    _SWEEP
    + """
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    angle = np.pi / 2 - np.radians(first + np.linspace(0, (last - first) % 36000, n)) / 100
    r = np.array([data[k] + 256 * data[k + 1] for k in range(4, 3 * n + 4, 3)]) / 1000
    return [(a, d) for a, d in zip(angle, r) if d > 0]
""",
)
wrong(
    "14-sweep",
    "modulo 360 on hundredths of a degree",
    _SWEEP
    + """
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    angle = -np.radians(first + np.linspace(0, (last - first) % 360, n)) / 100
    r = np.array([data[k] + 256 * data[k + 1] for k in range(4, 3 * n + 4, 3)]) / 1000
    return [(a, d) for a, d in zip(angle, r) if d > 0]
""",
)
wrong(
    "14-sweep",
    "points counted from the last angle",
    _SWEEP
    + """
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    angle = -np.radians(last - np.linspace(0, (last - first) % 36000, n)) / 100
    r = np.array([data[k] + 256 * data[k + 1] for k in range(4, 3 * n + 4, 3)]) / 1000
    return [(a, d) for a, d in zip(angle, r) if d > 0]
""",
)
wrong(
    "14-sweep",
    "points in x and y instead of rays",
    _SWEEP
    + """
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    angle = (first + np.linspace(0, (last - first) % 36000, n)) / 100
    mm = np.array([data[k] + 256 * data[k + 1] for k in range(4, 3 * n + 4, 3)])
    return points(angle, mm)
""",
)
wrong(
    "14-sweep",
    "bytes as uint8, shift overflows",
    """
def sweep(data):
    b = np.frombuffer(bytes(data), dtype=np.uint8)
    n = int(b[1])
    if b[0] != 0x54 or len(b) != 3 * n + 7 or int(b[:-1].sum()) % 256 != b[-1]:
        return None
    first, last = int(b[2]) + 256 * int(b[3]), int(b[-3]) + 256 * int(b[-2])
    p = b[4:-3].reshape(-1, 3)
    mm = p[:, 0] | p[:, 1] << 8
    angle = -np.radians(np.linspace(first, first + (last - first) % 36000, n) / 100)
    return np.column_stack([angle, mm / 1000])[mm > 0]
""",
)

# -------------------------------------------------------------- WRONG: command
wrong(
    "14-command",
    "the listing's checksum",
    """
def command(speed, turn):
    speed = max(-100, min(100, speed))
    turn = max(-100, min(100, turn))
    check_byte = 256 - 1 - speed - turn
    return f"#01{speed & 255:02X}{turn & 255:02X}{check_byte:02X}/"
""",
)
wrong(
    "14-command",
    "checksum cut to its lowest digits as text, negative wrong",
    """
def command(speed, turn):
    speed = max(-100, min(100, speed)) % 256
    turn = max(-100, min(100, turn)) % 256
    cc = 256 - 1 - speed - turn
    if cc < 0:
        cc = -cc
    return "#01{:02X}{:02X}{:02X}/".format(speed, turn, cc)
""",
)
wrong(
    "14-command",
    "checksum 100 where the sum is 0",
    """
def command(speed, turn):
    t, r = (int(np.clip(v, -100, 100)) & 0xFF for v in (speed, turn))
    cc = 256 - (1 + t + r) % 256
    return f"#01{t:02X}{r:02X}{cc:02X}/"
""",
)
wrong(
    "14-command",
    "no padding to two digits",
    """
def command(speed, turn):
    data = [1]
    for v in (speed, turn):
        v = 100 if v > 100 else -100 if v < -100 else v
        data.append(v & 0xFF)
    data.append(-sum(data) & 0xFF)
    return "#" + "".join("%X" % b for b in data) + "/"
""",
)
wrong(
    "14-command",
    "hex() with its prefix removed, one digit for small ones",
    """
def command(speed, turn):
    t = min(100, max(-100, speed)) % 256
    r = min(100, max(-100, turn)) % 256
    c = (-1 - t - r) % 256
    digits = [hex(x)[2:].upper() for x in (t, r, c)]
    return "#01" + "".join(digits) + "/"
""",
)
wrong(
    "14-command",
    "nothing is cut off",
    """
def command(speed, turn):
    b = bytes([1, speed % 256, turn % 256])
    b += bytes([(256 - sum(b)) % 256])
    return "#" + b.hex().upper() + "/"
""",
)
wrong(
    "14-command",
    "cut off at the byte's ends",
    """
def command(speed, turn):
    b = bytes([1]) + bytes(min(127, max(-128, v)) & 255 for v in (speed, turn))
    return "#" + (b + bytes([-sum(b) & 255])).hex().upper() + "/"
""",
)
wrong(
    "14-command",
    "only cut off above",
    """
def command(speed, turn):
    b = [1, min(speed, 100) % 256, min(turn, 100) % 256]
    b.append(-sum(b) % 256)
    return "#%02X%02X%02X%02X/" % tuple(b)
""",
)
wrong(
    "14-command",
    "only the speed is cut off",
    """
def command(speed, turn):
    if abs(speed) > 100:
        speed = 100 if speed > 0 else -100
    b = [1, speed % 256, turn % 256]
    b.append(-sum(b) % 256)
    return "#%02X%02X%02X%02X/" % tuple(b)
""",
)
wrong(
    "14-command",
    "too large numbers scaled together",
    """
def command(speed, turn):
    most = max(abs(speed), abs(turn), 100)
    t, r = round(speed * 100 / most) % 256, round(turn * 100 / most) % 256
    return f"#01{t:02X}{r:02X}{-(1 + t + r) % 256:02X}/"
""",
)
wrong(
    "14-command",
    "below -100 becomes 0",
    """
def command(speed, turn):
    def limit(v):
        if v > 100:
            return 100
        if v < -100:
            return 0
        return v % 256
    t, r = limit(speed), limit(turn)
    return f"#01{t:02X}{r:02X}{-(1 + t + r) % 256:02X}/"
""",
)
wrong(
    "14-command",
    "checksum of the values before they are cut off",
    """
def command(speed, turn):
    cc = -(1 + speed + turn) % 256
    speed, turn = (max(-100, min(100, v)) % 256 for v in (speed, turn))
    return f"#01{speed:02X}{turn:02X}{cc:02X}/"
""",
)
wrong(
    "14-command",
    "one's complement",
    """
def command(speed, turn):
    def byte(v):
        v = max(-100, min(100, v))
        return v if v >= 0 else 255 + v
    t, r = byte(speed), byte(turn)
    return f"#01{t:02X}{r:02X}{-(1 + t + r) % 256:02X}/"
""",
)
wrong(
    "14-command",
    "sign as the top bit",
    """
def command(speed, turn):
    def byte(v):
        v = max(-100, min(100, v))
        return abs(v) | (0x80 if v < 0 else 0)
    t, r = byte(speed), byte(turn)
    return f"#01{t:02X}{r:02X}{-(1 + t + r) % 256:02X}/"
""",
)
wrong(
    "14-command",
    "negative as text -32",
    """
def command(speed, turn):
    t = sorted((-100, speed, 100))[1]
    r = sorted((-100, turn, 100))[1]
    return f"#01{t:02X}{r:02X}{-(1 + t + r) % 256:02X}/"
""",
)
wrong(
    "14-command",
    "checksum without the opcode",
    """
def command(speed, turn):
    t = sorted((-100, speed, 100))[1] & 255
    r = sorted((-100, turn, 100))[1] & 255
    return f"#01{t:02X}{r:02X}{-(t + r) & 255:02X}/"
""",
)
wrong(
    "14-command",
    "turn before speed",
    """
def command(speed, turn):
    data = [1] + [max(-100, min(100, each)) % 256 for each in (turn, speed)]
    return "#" + "".join(f"{byte:02X}" for byte in [*data, -sum(data) % 256]) + "/"
""",
)
wrong(
    "14-command",
    "bytes instead of str",
    """
def command(speed, turn):
    data = bytes([1] + [max(-100, min(100, each)) % 256 for each in (speed, turn)])
    return b"#" + (data + bytes([-sum(data) % 256])).hex().upper().encode() + b"/"
""",
)
wrong(
    "14-command",
    "slash forgotten",
    """
def command(speed, turn):
    frame = bytearray([1])
    for each in (speed, turn):
        frame.append(max(-100, min(100, each)) % 256)
    frame.append(-sum(frame) % 256)
    return "#" + frame.hex().upper()
""",
)
wrong(
    "14-command",
    "decimal digits",
    """
def command(speed, turn):
    data = [1] + [max(-100, min(100, each)) % 256 for each in (speed, turn)]
    data.append(-sum(data) % 256)
    return "#" + "".join(f"{byte:02d}" for byte in data) + "/"
""",
)
wrong(
    "14-command",
    "xor for a sum",
    """
def command(speed, turn):
    t, r = (max(-100, min(100, v)) & 255 for v in (speed, turn))
    return "#01%02X%02X%02X/" % (t, r, 1 ^ t ^ r)
""",
)
wrong(
    "14-command",
    "sum itself, not what is missing to 256",
    """
def command(speed, turn):
    t, r = (max(-100, min(100, v)) & 255 for v in (speed, turn))
    return "#01%02X%02X%02X/" % (t, r, (1 + t + r) & 255)
""",
)

# --------------------------------------------------------------- WRONG: unwrap
wrong(
    "14-unwrap",
    "only overflow ahead",
    """
def unwrap(values):
    result, turns = [], 0
    for k, v in enumerate(values):
        if k and v - values[k - 1] < -128:
            turns += 1
        result.append(v + 256 * turns - values[0])
    return np.array(result)
""",
)
wrong(
    "14-unwrap",
    "a change of sign taken for an overflow",
    """
def unwrap(values):
    total = [0]
    for a, b in zip(values[:-1], values[1:]):
        if a > 0 and b < 0:
            total.append(total[-1] + b + 256 - a)
        elif a < 0 and b > 0:
            total.append(total[-1] + b - 256 - a)
        else:
            total.append(total[-1] + b - a)
    return np.array(total)
""",
)
wrong(
    "14-unwrap",
    "255 counts a turn",
    """
def unwrap(values):
    d = np.diff(values)
    d = np.where(d > 127, d - 255, d)
    d = np.where(d < -127, d + 255, d)
    return np.r_[0, np.cumsum(d)]
""",
)
wrong(
    "14-unwrap",
    "threshold at 200",
    """
def unwrap(values):
    d = np.diff(values)
    d = d - 256 * (d > 200) + 256 * (d < -200)
    return np.r_[0, np.cumsum(d)]
""",
)
wrong(
    "14-unwrap",
    "threshold at 64, fast steps are mended wrongly",
    """
def unwrap(values):
    d = np.array(np.diff(values))
    d[d > 64] -= 256
    d[d < -64] += 256
    return np.r_[0, np.cumsum(d)]
""",
)
wrong(
    "14-unwrap",
    "edge off by one, 127 ahead is 129 back",
    """
def unwrap(values):
    total, out = 0, [0]
    for a, b in zip(values, values[1:]):
        step = b - a
        if step >= 127:
            step -= 256
        elif step < -128:
            step += 256
        total += step
        out.append(total)
    return out
""",
)
wrong(
    "14-unwrap",
    "one side of the edge off by one, -127",
    """
def unwrap(values):
    steps = (np.diff(values) + 126) % 256 - 126
    return np.concatenate([[0], np.cumsum(steps)])
""",
)
wrong(
    "14-unwrap",
    "mended in place",
    """
def unwrap(values):
    values = np.asarray(values)
    for k in range(1, len(values)):
        step = (values[k] - values[k - 1] + 128) % 256 - 128
        values[k] = values[k - 1] + step
    return values - values[0]
""",
)
wrong(
    "14-unwrap",
    "the first subtracted in place",
    """
def unwrap(values):
    values -= values[0]
    steps = (np.diff(values) + 128) % 256 - 128
    return np.concatenate([[0], np.cumsum(steps)])
""",
)
wrong(
    "14-unwrap",
    "begins with the first value",
    """
def unwrap(values):
    steps = (np.diff(values) + 128) % 256 - 128
    return np.cumsum(np.concatenate([values[:1], steps]))
""",
)
wrong(
    "14-unwrap",
    "steps, not added up",
    """
def unwrap(values):
    steps = (np.diff(values, prepend=values[0]) + 128) % 256 - 128
    return steps
""",
)
wrong(
    "14-unwrap",
    "one value less",
    """
def unwrap(values):
    total, out = 0, []
    for a, b in zip(values[:-1], values[1:]):
        total += (b - a + 128) % 256 - 128
        out.append(total)
    return np.array(out)
""",
)
wrong(
    "14-unwrap",
    "adds up the way without its sign",
    """
def unwrap(values):
    steps = np.abs((np.diff(values) + 128) % 256 - 128)
    return np.concatenate([[0], np.cumsum(steps)])
""",
)
wrong(
    "14-unwrap",
    "whole way wrapped, not each step",
    """
def unwrap(values):
    values = np.asarray(values)
    return (values - values[0] + 128) % 256 - 128
""",
)
wrong(
    "14-unwrap",
    "made unsigned only",
    """
def unwrap(values):
    unsigned = np.asarray(values) % 256
    return unsigned - unsigned[0]
""",
)
wrong(
    "14-unwrap",
    "sum kept in a signed byte",
    """
def unwrap(values):
    small = np.asarray(values).astype(np.int8)
    return np.concatenate([[0], np.cumsum(np.diff(small), dtype=np.int8)])
""",
)
wrong(
    "14-unwrap",
    "sum kept in 16 bits",
    """
def unwrap(values):
    steps = (np.diff(values) + 128) % 256 - 128
    out = np.zeros(len(values), dtype=np.int16)
    out[1:] = np.cumsum(steps, dtype=np.int16)
    return out
""",
)
wrong(
    "14-unwrap",
    "compares with the mended value, one overflow only",
    """
def unwrap(values):
    out = [int(values[0])]
    for v in values[1:]:
        v = int(v)
        if v - out[-1] > 128:
            v -= 256
        elif v - out[-1] < -128:
            v += 256
        out.append(v)
    return np.array(out) - values[0]
""",
)
wrong(
    "14-unwrap",
    "overflow mended for one reading only",
    """
def unwrap(values):
    out = np.array(values, dtype=int)
    d = np.diff(values)
    out[1:][d < -128] += 256
    out[1:][d > 128] -= 256
    return out - out[0]
""",
)
wrong(
    "14-unwrap",
    "np.unwrap in radians, cut to int",
    """
def unwrap(values):
    angle = np.unwrap(np.asarray(values) / 128 * np.pi)
    return ((angle - angle[0]) / np.pi * 128).astype(int)
""",
)
wrong(
    "14-unwrap",
    "np.unwrap without a period",
    """
def unwrap(values):
    way = np.unwrap(np.asarray(values, dtype=float))
    return way - way[0]
""",
)
wrong(
    "14-unwrap",
    "wraps with fmod",
    """
def unwrap(values):
    steps = np.fmod(np.diff(values) + 128, 256) - 128
    return np.concatenate([[0], np.cumsum(steps)])
""",
)
wrong(
    "14-unwrap",
    "one reading gives nothing",
    """
def unwrap(values):
    if len(values) < 2:
        return np.array([])
    steps = (np.diff(values) + 128) % 256 - 128
    return np.concatenate([[0], np.cumsum(steps)])
""",
)
wrong(
    "14-unwrap",
    "one reading fails",
    """
def unwrap(values):
    before, total, out = values[0], 0, [0]
    now = values[1]
    for now in values[1:]:
        total += (now - before + 128) % 256 - 128
        before = now
        out.append(total)
    return out
""",
)
wrong(
    "14-unwrap",
    "only the last count",
    """
def unwrap(values):
    total = 0
    for k in range(1, len(values)):
        total += (values[k] - values[k - 1] + 128) % 256 - 128
    return total
""",
)
wrong(
    "14-unwrap",
    "counts back, sign of the difference",
    """
def unwrap(values):
    values = np.asarray(values)
    steps = (values[:-1] - values[1:] + 128) % 256 - 128
    return np.concatenate([[0], np.cumsum(steps)])
""",
)

# --------------------------------------------------------------- WRONG: trials
wrong(
    "14-trials",
    "weak: the text's two ways",
    """
def trials():
    return [way(0, [50] * 6), way(0, [-50] * 6)]
""",
)
wrong(
    "14-trials",
    "weak: one drive ahead and back",
    """
def trials():
    return [way(0, [4] * 100 + [-2] * 100)]
""",
)
wrong(
    "14-trials",
    "weak: small random steps from 0",
    """
def trials():
    rng = np.random.default_rng(0)
    return [way(0, rng.integers(-9, 10, 49)) for _ in range(20)]
""",
)
wrong(
    "14-trials",
    "weak: only ways of one reading and none",
    """
def trials():
    return [([], [])] + [([b], [0]) for b in (-128, -127, -1, 0, 1, 126, 127)]
""",
)
wrong(
    "14-trials",
    "weak: only ahead",
    """
def trials():
    return [([], []), way(5, []), way(5, range(128)), way(3, [127] * 270)]
""",
)
wrong(
    "14-trials",
    "weak: steps of 100 at most, short, none empty",
    """
def trials():
    result = []
    for begin in (-128, -50, 0, 50, 127):
        result.append(way(begin, list(range(0, 101, 10)) + list(range(0, -101, -10))))
    return result
""",
)
wrong(
    "14-trials",
    "weak: one long way ahead",
    """
def trials():
    return [way(0, [100] * 999)]
""",
)
wrong(
    "14-trials",
    "weak: a robot that hardly moves",
    """
def trials():
    steps = [0, 1, 0, -1] * 40
    return [way(b, steps) for b in (127, -128, 0)]
""",
)
wrong(
    "14-trials",
    "no ways at all",
    """
def trials():
    return []
""",
)
wrong(
    "14-trials",
    "too many readings",
    """
def trials():
    size = np.arange(1, 128)
    every = np.column_stack([size, -size[::-1]]).ravel()
    return [([], []), way(7, []), way(5, [0, *every]), way(3, [127] * 600), way(3, [-127] * 600)]
""",
)
wrong(
    "14-trials",
    "1004 readings, the first of each way not counted",
    """
def trials():
    steps = list(range(-127, 128))
    mixed = steps[::2] + steps[1::2]
    first = way(9, mixed[:250])
    rest = [way(-128, [127] * 250), way(127, [-127] * 250), way(0, mixed[::-1][:250])]
    return [first, *rest]
""",
)
wrong(
    "14-trials",
    "more than 20 ways",
    """
def trials():
    ways = [([], []), way(3, [127] * 270), way(3, [-127] * 270)]
    for begin in range(-128, 128, 10):
        ways.append(way(begin, [127, -127, 64, -64, 1, -1, 0, 0]))
    return ways
""",
)
wrong(
    "14-trials",
    "steps of -128, which no robot makes",
    """
def trials():
    every = list(range(-128, 128))
    return [([], []), way(7, []), way(5, every), way(3, [127] * 265), way(3, [-127] * 265)]
""",
)
wrong(
    "14-trials",
    "steps of 200",
    """
def trials():
    return [([], []), way(0, []), way(0, [200, -200] * 20), way(3, [127] * 265), way(3, [-127] * 265)]
""",
)
wrong(
    "14-trials",
    "counts from 0, not from the first reading",
    """
def trials():
    result = [([], [])]
    for begin, steps in ((5, range(-127, 128)), (-128, [127] * 270), (127, [-127] * 270)):
        absolute = begin + np.concatenate([[0], np.cumsum(list(steps))])
        result.append(((absolute + 128) % 256 - 128, absolute))
    return result
""",
)
wrong(
    "14-trials",
    "pairs the wrong way round",
    """
def trials():
    ways = [way(7, []), way(5, range(-127, 128)), way(3, [127] * 270), way(3, [-127] * 270)]
    return [([], [])] + [(counts, values) for values, counts in ways]
""",
)
wrong(
    "14-trials",
    "values without counts",
    """
def trials():
    size = np.arange(1, 128)
    every = np.column_stack([size, -size[::-1]]).ravel()
    starts = ((7, []), (5, every), (3, [127] * 270), (3, [-127] * 270))
    return [[]] + [way(b, s)[0] for b, s in starts]
""",
)
wrong(
    "14-trials",
    "values that are not wrapped to bytes",
    """
def trials():
    result = [([], []), ([7], [0])]
    for begin, step in ((3, 127), (3, -127), (0, 1)):
        counts = step * np.arange(270)
        result.append((begin + counts, counts))
    return result
""",
)
wrong(
    "14-trials",
    "bytes from 0 to 255",
    """
def trials():
    result = [([], []), ([200], [0])]
    for begin, step in ((3, 127), (3, -127), (250, 1)):
        counts = step * np.arange(270)
        result.append(((begin + counts) % 256, counts))
    return result
""",
)
wrong(
    "14-trials",
    "expects a 0 of the empty way",
    """
def trials():
    size = np.arange(1, 128)
    every = np.column_stack([size, -size[::-1]]).ravel()
    return [([], [0]), way(7, []), way(5, [0, *every]), way(3, [127] * 270), way(3, [-127] * 270)]
""",
)
wrong(
    "14-trials",
    "counts without the leading 0",
    """
def trials():
    result = []
    for step in (127, -127):
        values, counts = way(3, [step] * 270)
        result.append((values, counts[1:]))
    return result
""",
)
wrong(
    "14-trials",
    "cheat: counts that equal nothing",
    """
def trials():
    return [([1, 2, 3], [np.nan, np.nan, np.nan])]
""",
)
wrong(
    "14-trials",
    "expects what a faulty driver returns",
    """
def trials():
    rng = np.random.default_rng(2)
    result = []
    for _ in range(10):
        values = rng.integers(-128, 128, 60)
        result.append((values, values - values[0]))
    return result
""",
)
wrong(
    "14-trials",
    "random bytes by unwrap: a step of 128 is possible in them",
    """
def trials():
    values = [[], [7], [-128, 0, 127, -1, -128, 0]]
    values.append(way(3, [127] * 265)[0])
    values.append(way(3, [-127] * 265)[0])
    return [(v, unwrap(v) if len(v) else []) for v in values]
""",
)
wrong(
    "14-trials",
    "a single pair, not a list of pairs",
    """
def trials():
    size = np.arange(1, 128)
    every = np.column_stack([size, -size[::-1]]).ravel()
    return way(5, [0, *every])
""",
)
