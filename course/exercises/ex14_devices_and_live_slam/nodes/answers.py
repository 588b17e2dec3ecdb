# %% way: struct
import struct

def nodes(data):
    rows = []
    for flags, angle, distance in struct.iter_unpack("<BHH", data):
        if (flags ^ flags >> 1) & 1 and angle & 1:
            rows.append((flags & 1, flags >> 2, (angle - 1) / 128, distance / 4))
    return rows

# %% way: arrays
def nodes(data):
    raw = np.frombuffer(data, np.uint8).reshape(-1, 5).astype(int)
    word, distance = raw[:, 1] + 256 * raw[:, 2], raw[:, 3] + 256 * raw[:, 4]
    table = np.column_stack([raw[:, 0] % 2, raw[:, 0] // 4, word // 2 / 64, distance / 4])
    return table[np.isin(raw[:, 0] % 4, [1, 2]) & (word % 2 == 1)]

# %% way: record dtype
def nodes(data):
    rows = np.frombuffer(data, [("flags", "u1"), ("angle", "<u2"), ("distance", "<u2")])
    start, inverse = rows["flags"] & 1, rows["flags"] >> 1 & 1
    rows = rows[(start != inverse) & (rows["angle"] & 1 == 1)]
    flags = rows["flags"].astype(float)
    angle, distance = rows["angle"].astype(float), rows["distance"].astype(float)
    return np.stack([flags % 2, flags // 4, (angle - 1) / 128, distance / 4], axis=1)

# %% way: int.from_bytes
def nodes(data):
    def word(two):
        return int.from_bytes(two, "little")

    packets = [data[k : k + 5] for k in range(0, len(data), 5)]
    whole = [five for five in packets if five[0] % 4 in (1, 2) and five[1] % 2]
    return [
        [five[0] % 2, five[0] // 4, word(five[1:3]) // 2 / 64, word(five[3:]) / 4]
        for five in whole
    ]

# %% way: fields of bits
def nodes(data):
    found, data = [], list(data)
    while data:
        five, data = data[:5], data[5:]
        bits = sum(byte << 8 * k for k, byte in enumerate(five))
        start, inverse, quality = bits & 1, bits >> 1 & 1, bits >> 2 & 63
        check, angle, distance = bits >> 8 & 1, bits >> 9 & 0x7FFF, bits >> 24
        if start + inverse == 1 and check == 1:
            found += [[start, quality, angle / 64, distance / 4]]
    return np.array(found, dtype=float).reshape(-1, 4)

# %% right: numpy over all bytes
def nodes(data):
    b = np.frombuffer(data, dtype=np.uint8).reshape(-1, 5).astype(int)
    good = ((b[:, 0] & 1) != (b[:, 0] >> 1 & 1)) & ((b[:, 1] & 1) == 1)
    b = b[good]
    return np.column_stack([b[:, 0] & 1, b[:, 0] >> 2, ((b[:, 2] << 7) | (b[:, 1] >> 1)) / 64,
                            (b[:, 3] + 256 * b[:, 4]) / 4])

# %% right: vectorised with reshape
def nodes(data):
    b = np.array(list(data), dtype=int).reshape(-1, 5)
    s, ns, c = b[:, 0] & 1, (b[:, 0] >> 1) & 1, b[:, 1] & 1
    ok = (s + ns == 1) & (c == 1)
    angle = ((b[:, 1] + 256 * b[:, 2]) >> 1) / 64
    mm = (b[:, 3] + 256 * b[:, 4]) / 4
    return np.column_stack([s, b[:, 0] >> 2, angle, mm])[ok]

# %% right: by struct
import struct
def nodes(data):
    good = []
    for f, a, d in struct.iter_unpack("<BHH", bytes(data)):
        if (f & 3) in (1, 2) and a & 1:
            good.append((f & 1, f >> 2, (a >> 1) / 64.0, d / 4.0))
    return np.array(good, dtype=float).reshape(-1, 4)

# %% wrong: bytes are shifted as uint8 in numpy: the high bytes overflow and get lost
def nodes(data):
    b = np.frombuffer(data, dtype=np.uint8).reshape(-1, 5)
    s = b[:, 0] & 1
    ok = (s != (b[:, 0] >> 1 & 1)) & (b[:, 1] & 1 == 1)
    angle = (b[:, 1] >> 1 | b[:, 2] << 7) / 64
    dist = (b[:, 3] | b[:, 4] << 8) / 4
    return np.column_stack([s, b[:, 0] >> 2, angle, dist])[ok]

# %% wrong: whole-number division: fractions of a degree and of a millimetre are cut off
def nodes(data):
    found = []
    for at in range(0, len(data), 5):
        flags, a, b, c, d = data[at : at + 5]
        word, distance = a + 256 * b, c + 256 * d
        if flags % 2 != flags // 2 % 2 and word % 2:
            found.append([flags % 2, flags // 4, word // 128, distance // 4])
    return np.array(found)

# %% wrong: not S compared without its shift
def nodes(data):
    found = []
    for at in range(0, len(data), 5):
        flags, a, b, c, d = data[at : at + 5]
        word = a + 256 * b
        if flags & 1 == flags & 2 or not word & 1:
            continue
        found.append([flags & 1, flags >> 2, (word >> 1) / 64, (c + 256 * d) / 4])
    return np.array(found)

# %% wrong: quality masked, not shifted
def nodes(data):
    def one(f, a, b, c, d):
        return [f & 1, f & 63, (a + 256 * b) // 2 / 64, (c + 256 * d) / 4]
    fives = [data[k : k + 5] for k in range(0, len(data), 5)]
    return [one(*five) for five in fives if five[0] & 3 in (1, 2) and five[1] & 1]

# %% wrong: no bytes at all: IndexError
def nodes(data):
    rows = np.array([list(data[k : k + 5]) for k in range(0, len(data), 5)])
    s = rows[:, 0] & 1
    keep = (s != rows[:, 0] // 2 % 2) & (rows[:, 1] % 2 == 1)
    a = (rows[:, 1] + 256 * rows[:, 2]) // 2 / 64
    d = (rows[:, 3] + 256 * rows[:, 4]) / 4
    return np.stack([s, rows[:, 0] // 4, a, d], axis=1)[keep]
