# %% way: arrays
def sweep(data):
    raw = np.frombuffer(data, np.uint8).astype(int)
    n = raw[1]
    if raw[0] != 0x54 or len(raw) != 7 + 3 * n or (raw[:-1].sum() - raw[-1]) % 256:
        return None
    first, last = raw[2] + 256 * raw[3], raw[-3] + 256 * raw[-2]
    if last < first:
        last += 36000
    angle = np.radians(np.linspace(first, last, n) / 100)
    points = raw[4:-3].reshape(n, 3)
    metres = (points[:, 0] + 256 * points[:, 1]) / 1000
    return np.column_stack([-angle, metres])[metres > 0]

# %% way: struct
import struct

def sweep(data):
    head, n, first = struct.unpack_from("<BBH", data)
    if head != 0x54 or len(data) != 3 * n + 7:
        return None
    last, total = struct.unpack_from("<HB", data, 4 + 3 * n)
    if total != sum(data[:-1]) & 0xFF:
        return None
    turned = (last - first + 36000) % 36000
    rays = []
    for k, (distance, strength) in enumerate(struct.iter_unpack("<HB", data[4:-3])):
        alpha = first + (k * turned / (n - 1) if k else 0)
        if distance > 0:
            rays.append((np.deg2rad(360 - alpha / 100), distance * 1e-3))
    return np.array(rays)

# %% way: by a clock
def sweep(data):
    *body, total = data
    head, n, low, high = body[:4]
    if head != 0x54 or len(body) - 6 != 3 * n or sum(body) % 256 != total:
        return None
    angle = -2 * np.pi * (low + 256 * high) / 36000
    end = -2 * np.pi * (body[-2] + 256 * body[-1]) / 36000
    while end > angle:
        end -= 2 * np.pi
    gap = (end - angle) / (n - 1) if n > 1 else 0
    found = np.zeros((0, 2))
    for at in range(4, 4 + 3 * n, 3):
        metres = (body[at] + 256 * body[at + 1]) / 1000
        if metres != 0:
            found = np.vstack([found, [angle, metres]])
        angle += gap
    return found

# %% way: interpolated
def sweep(data):
    def word(at):
        return int.from_bytes(data[at : at + 2], "little")

    n = data[1]
    whole = data[0] == 0x54 and len(data) == 3 * n + 7
    if not whole or (sum(data) - 2 * data[-1]) % 256:
        return None
    first, last = word(2), word(3 * n + 4)
    ends = np.unwrap([first, last], period=36000) if n > 1 else [first, first]
    if ends[1] < ends[0]:
        ends[1] += 36000
    slots = np.arange(n)
    came = np.array([word(4 + 3 * k) for k in slots])
    angle = np.interp(slots, [0, max(n - 1, 1)], ends)
    rays = np.stack([np.radians(-angle / 100), came / 1000], axis=1)
    return rays[came != 0].tolist()

# %% pasted: the lesson's node
def sweep(data):
    rows = []
    for at in range(0, len(data) - 4, 5):
        five = data[at : at + 5]
        flags, angle, distance = five[0], five[1] | five[2] << 8, five[3] | five[4] << 8
        start, not_start, check = flags & 1, flags >> 1 & 1, angle & 1
        if start == not_start or not check:
            continue
        rows.append([-np.radians((angle >> 1) / 64), distance / 4000])
    return rows

# %% pasted: the lesson's capsule
def sweep(data):
    if np.bitwise_xor.reduce(list(data[2:])) != data[0] & 15 | (data[1] & 15) << 4:
        return None
    alpha = ((data[2] | data[3] << 8) & 0x7FFF) / 64
    points = []
    for at in range(4, len(data) - 4, 5):
        a, b, c, d, low = data[at : at + 5]
        for word, nibble in ((a | b << 8, low & 15), (c | d << 8, low >> 4)):
            points.append((word >> 2, (word & 3) << 4 | nibble))
    mm, offset = np.array(points).T
    at = (alpha + np.arange(len(mm)) / len(mm) * 30 - offset / 8) % 360
    return np.column_stack([-np.radians(at), mm / 1000])

# %% pasted: the lesson's capsule without its checksum
def sweep(data):
    points = np.reshape(list(data[4 : 4 + (len(data) - 7) // 3 * 3]), (-1, 3))
    alpha = ((data[2] | data[3] << 8) & 0x7FFF) / 64
    turned = ((data[-3] | data[-2] << 8) / 64 - alpha) % 360
    mm = points[:, 0] | points[:, 1] << 8
    at = (alpha + np.arange(len(mm)) / len(mm) * turned) % 360
    return np.column_stack([-np.radians(at), (mm >> 2) / 1000])

# %% pasted: the first task's nodes
def sweep(data):
    return [row[2:] for row in nodes(data[: len(data) // 5 * 5])]

# %% right: int.from_bytes and numpy; angles by linspace to the last one after it was put a turn on where needed
def sweep(data):
    if data[0] != 0x54:
        return None
    n = data[1]
    if len(data) != 7 + 3 * n or (sum(data) - data[-1]) % 256 != data[-1]:
        return None
    first = int.from_bytes(data[2:4], "little") / 100
    last = int.from_bytes(data[-3:-1], "little") / 100
    if last < first:
        last += 360
    psi = np.linspace(first, last, n)
    mm = np.array([int.from_bytes(data[4 + 3 * k : 6 + 3 * k], "little") for k in range(n)])
    hit = mm > 0
    return np.column_stack([-np.radians(psi[hit]), mm[hit] / 1000])

# %% right: struct and linspace, positive angles
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

# %% right: numpy, angles in -pi to pi
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

# %% wrong: a packet of one point divides by zero
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return None
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = ((last - first) % 36000) / (n - 1)
    out = []
    for k in range(n):
        d = data[4 + 3 * k] | data[5 + 3 * k] << 8
        if d:
            out.append((-np.radians((first + k * step) / 100), d / 1000))
    return out

# %% wrong: equal angles taken for a full turn
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return None

    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    if a1 <= a0:
        a1 += 36000
    angles = -np.radians(np.linspace(a0, a1, n) / 100)
    mm = np.array([data[k] | data[k + 1] << 8 for k in range(4, 4 + 3 * n, 3)])
    return np.column_stack([angles, mm / 1000])[mm > 0]

# %% wrong: words read as signed
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

# %% wrong: length not compared with n, which is worked out instead
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

# %% wrong: reads points before it looks at the length, IndexError
def sweep(data):
    n = data[1]
    mm = np.array([data[4 + 3 * k] + 256 * data[5 + 3 * k] for k in range(n)])
    first = data[2] + 256 * data[3]
    last = data[4 + 3 * n] + 256 * data[5 + 3 * n]
    if data[0] != 0x54 or data[6 + 3 * n] != sum(data[: 6 + 3 * n]) % 256 or len(data) != 7 + 3 * n:
        return None
    angle = -np.radians((first + np.linspace(0, (last - first) % 36000, n)) / 100)
    return np.column_stack([angle, mm / 1000])[mm > 0]

# %% wrong: points counted from the last angle
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return None

    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    angle = -np.radians(last - np.linspace(0, (last - first) % 36000, n)) / 100
    r = np.array([data[k] + 256 * data[k + 1] for k in range(4, 3 * n + 4, 3)]) / 1000
    return [(a, d) for a, d in zip(angle, r) if d > 0]

# %% wrong: points in x and y instead of rays
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return None

    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    angle = (first + np.linspace(0, (last - first) % 36000, n)) / 100
    mm = np.array([data[k] + 256 * data[k + 1] for k in range(4, 3 * n + 4, 3)])
    return points(angle, mm)

# %% wrong: bytes as uint8, shift overflows
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
