"""Independent answers to 14-nodes: right ones, and students' mistakes."""

RIGHT = [
    (
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
    ),
    (
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
    ),
    (
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
    ),
]

WRONG = [
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
        "14-nodes",
        "quality cut to four bits",
        """
def nodes(data):
    def one(f, a, b, c, d):
        return [f & 1, f >> 2 & 0x0F, (a + 256 * b) // 2 / 64, (c + 256 * d) / 4]
    fives = [data[k : k + 5] for k in range(0, len(data), 5)]
    return [one(*five) for five in fives if five[0] & 3 in (1, 2) and five[1] & 1]
""",
    ),
    (
        "14-nodes",
        "quality masked, not shifted",
        """
def nodes(data):
    def one(f, a, b, c, d):
        return [f & 1, f & 63, (a + 256 * b) // 2 / 64, (c + 256 * d) / 4]
    fives = [data[k : k + 5] for k in range(0, len(data), 5)]
    return [one(*five) for five in fives if five[0] & 3 in (1, 2) and five[1] & 1]
""",
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
]
