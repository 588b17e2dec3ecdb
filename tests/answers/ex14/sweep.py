"""Independent answers to 14-sweep: right ones, and students' mistakes."""

_SWEEP = """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return None
"""

RIGHT = [
    (
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
    ),
    (
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
    ),
]

WRONG = [
    (
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
    ),
    (
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
    ),
    (
        "14-sweep",
        "over 0 degree it turns back",
        _SWEEP
        + """
    a0, a1 = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    angles = -np.radians(np.linspace(a0, a1, n) / 100)
    mm = np.array([data[k] | data[k + 1] << 8 for k in range(4, 4 + 3 * n, 3)])
    return np.column_stack([angles, mm / 1000])[mm > 0]
""",
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
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
    ),
    (
        "14-sweep",
        "front taken as +y",
        _SWEEP
        + """
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    angle = np.pi / 2 - np.radians(first + np.linspace(0, (last - first) % 36000, n)) / 100
    r = np.array([data[k] + 256 * data[k + 1] for k in range(4, 3 * n + 4, 3)]) / 1000
    return [(a, d) for a, d in zip(angle, r) if d > 0]
""",
    ),
    (
        "14-sweep",
        "modulo 360 on hundredths of a degree",
        _SWEEP
        + """
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    angle = -np.radians(first + np.linspace(0, (last - first) % 360, n)) / 100
    r = np.array([data[k] + 256 * data[k + 1] for k in range(4, 3 * n + 4, 3)]) / 1000
    return [(a, d) for a, d in zip(angle, r) if d > 0]
""",
    ),
    (
        "14-sweep",
        "points counted from the last angle",
        _SWEEP
        + """
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    angle = -np.radians(last - np.linspace(0, (last - first) % 36000, n)) / 100
    r = np.array([data[k] + 256 * data[k + 1] for k in range(4, 3 * n + 4, 3)]) / 1000
    return [(a, d) for a, d in zip(angle, r) if d > 0]
""",
    ),
    (
        "14-sweep",
        "points in x and y instead of rays",
        _SWEEP
        + """
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    angle = (first + np.linspace(0, (last - first) % 36000, n)) / 100
    mm = np.array([data[k] + 256 * data[k + 1] for k in range(4, 3 * n + 4, 3)])
    return points(angle, mm)
""",
    ),
    (
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
    ),
]
