"""A second class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "14-nodes",
        "by struct",
        """
import struct
def nodes(data):
    good = []
    for f, a, d in struct.iter_unpack("<BHH", bytes(data)):
        if (f & 3) in (1, 2) and a & 1:
            good.append((f & 1, f >> 2, (a >> 1) / 64.0, d / 4.0))
    return np.array(good, dtype=float).reshape(-1, 4)
""",
    ),
    (
        "14-sweep",
        "vectorised",
        """
def sweep(data):
    raw = np.frombuffer(bytes(data), dtype=np.uint8).astype(int)
    n = raw[1]
    if raw[0] != 0x54 or len(raw) != 7 + 3 * n or raw[:-1].sum() % 256 != raw[-1]:
        return None
    a, b = raw[2] + 256 * raw[3], raw[-3] + 256 * raw[-2]
    span = (b - a) % 36000
    angle = a + (np.arange(n) / (n - 1) * span if n > 1 else np.zeros(n))
    body = raw[4:-3].reshape(-1, 3)
    r = body[:, 0] + 256 * body[:, 1]
    return np.column_stack([-np.deg2rad(angle / 100), r / 1000])[r > 0]
""",
    ),
    (
        "14-command",
        "with bytes",
        """
def command(speed, turn):
    t, r = (int(np.clip(v, -100, 100)) & 0xFF for v in (speed, turn))
    body = bytes([1, t, r, (256 - (1 + t + r) % 256) % 256])
    return f"#{body.hex().upper()}/"
""",
    ),
    (
        "14-unwrap",
        "a loop",
        """
def unwrap(values):
    out, total = [0], 0
    for a, b in zip(values[:-1], values[1:]):
        step = int(b) - int(a)
        if step > 127:
            step -= 256
        elif step < -127:
            step += 256
        total += step
        out.append(total)
    return np.array(out)
""",
    ),
]

WRONG = [
    (
        "14-nodes",
        "quality not shifted",
        """
def nodes(data):
    out = []
    for k in range(0, len(data), 5):
        f = data[k]
        w = data[k + 1] + 256 * data[k + 2]
        d = data[k + 3] + 256 * data[k + 4]
        if (f & 1) != ((f >> 1) & 1) and w & 1:
            out.append([f & 1, f & 0xFC, (w >> 1) / 64, d / 4])
    return np.array(out)
""",
    ),
    (
        "14-nodes",
        "angle with the check bit",
        """
def nodes(data):
    out = []
    for k in range(0, len(data), 5):
        f = data[k]
        w = data[k + 1] + 256 * data[k + 2]
        d = data[k + 3] + 256 * data[k + 4]
        if (f & 1) != ((f >> 1) & 1) and w & 1:
            out.append([f & 1, f >> 2, w / 128, d / 4])
    return np.array(out)
""",
    ),
    (
        "14-nodes",
        "drops those that did not come back",
        """
def nodes(data):
    out = []
    for k in range(0, len(data), 5):
        f = data[k]
        w = data[k + 1] | data[k + 2] << 8
        d = data[k + 3] | data[k + 4] << 8
        if (f ^ f >> 1) & 1 and w & 1 and d:
            out.append([f & 1, f >> 2, (w >> 1) / 64, d / 4])
    return np.array(out)
""",
    ),
    (
        "14-nodes",
        "S and not S not compared",
        """
def nodes(data):
    out = []
    for k in range(0, len(data), 5):
        f = data[k]
        w = data[k + 1] | data[k + 2] << 8
        d = data[k + 3] | data[k + 4] << 8
        if w & 1:
            out.append([f & 1, f >> 2, (w >> 1) / 64, d / 4])
    return np.array(out)
""",
    ),
    (
        "14-nodes",
        "stops at the first damaged node",
        """
def nodes(data):
    out = []
    for k in range(0, len(data), 5):
        f = data[k]
        w = data[k + 1] | data[k + 2] << 8
        d = data[k + 3] | data[k + 4] << 8
        if not ((f ^ f >> 1) & 1 and w & 1):
            break
        out.append([f & 1, f >> 2, (w >> 1) / 64, d / 4])
    return np.array(out)
""",
    ),
    (
        "14-nodes",
        "bytes of numpy overflow",
        """
def nodes(data):
    b = np.frombuffer(bytes(data), dtype=np.uint8).reshape(-1, 5)
    good = ((b[:, 0] & 1) != (b[:, 0] >> 1 & 1)) & (b[:, 1] & 1 == 1)
    b = b[good]
    w = b[:, 1] | b[:, 2] << 8
    d = b[:, 3] | b[:, 4] << 8
    return np.column_stack([b[:, 0] & 1, b[:, 0] >> 2, (w >> 1) / 64, d / 4])
""",
    ),
    (
        "14-sweep",
        "the angle not wrapped over 360",
        """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 7 + 3 * n or sum(data[:-1]) & 255 != data[-1]:
        return None
    a, b = data[2] + 256 * data[3], data[-3] + 256 * data[-2]
    rays = []
    for k in range(n):
        d = data[4 + 3 * k] + 256 * data[5 + 3 * k]
        if d:
            rays.append([-np.radians((a + (b - a) * k / max(n - 1, 1)) / 100), d / 1000])
    return np.array(rays)
""",
    ),
    (
        "14-sweep",
        "divided by n as the lesson does",
        """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 7 + 3 * n or sum(data[:-1]) & 255 != data[-1]:
        return None
    a, b = data[2] + 256 * data[3], data[-3] + 256 * data[-2]
    rays = []
    for k in range(n):
        d = data[4 + 3 * k] + 256 * data[5 + 3 * k]
        if d:
            rays.append([-np.radians((a + (b - a) % 36000 * k / n) / 100), d / 1000])
    return np.array(rays)
""",
    ),
    (
        "14-sweep",
        "fails for one point",
        """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 7 + 3 * n or sum(data[:-1]) & 255 != data[-1]:
        return None
    a, b = data[2] + 256 * data[3], data[-3] + 256 * data[-2]
    step = (b - a) % 36000 / (n - 1)
    rays = []
    for k in range(n):
        d = data[4 + 3 * k] + 256 * data[5 + 3 * k]
        if d:
            rays.append([-np.radians((a + k * step) / 100), d / 1000])
    return np.array(rays)
""",
    ),
    (
        "14-sweep",
        "length only checked for being too short",
        """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) < 7 + 3 * n or sum(data[:-1]) & 255 != data[-1]:
        return None
    a, b = data[2] + 256 * data[3], data[-3] + 256 * data[-2]
    step = (b - a) % 36000 / max(n - 1, 1)
    rays = []
    for k in range(n):
        d = data[4 + 3 * k] + 256 * data[5 + 3 * k]
        if d:
            rays.append([-np.radians((a + k * step) / 100), d / 1000])
    return np.array(rays)
""",
    ),
    (
        "14-sweep",
        "index among those that came back",
        """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 7 + 3 * n or sum(data[:-1]) & 255 != data[-1]:
        return None
    a, b = data[2] + 256 * data[3], data[-3] + 256 * data[-2]
    d = [data[4 + 3 * k] + 256 * data[5 + 3 * k] for k in range(n)]
    d = [x for x in d if x > 0]
    step = (b - a) % 36000 / max(len(d) - 1, 1)
    return np.array([[-np.radians((a + k * step) / 100), x / 1000] for k, x in enumerate(d)])
""",
    ),
    (
        "14-sweep",
        "empty list for damage",
        """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 7 + 3 * n or sum(data[:-1]) & 255 != data[-1]:
        return []
    a, b = data[2] + 256 * data[3], data[-3] + 256 * data[-2]
    step = (b - a) % 36000 / max(n - 1, 1)
    rays = []
    for k in range(n):
        d = data[4 + 3 * k] + 256 * data[5 + 3 * k]
        if d:
            rays.append([-np.radians((a + k * step) / 100), d / 1000])
    return rays
""",
    ),
    (
        "14-sweep",
        "low byte zero taken for nothing",
        """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 7 + 3 * n or sum(data[:-1]) & 255 != data[-1]:
        return None
    a, b = data[2] + 256 * data[3], data[-3] + 256 * data[-2]
    step = (b - a) % 36000 / max(n - 1, 1)
    rays = []
    for k in range(n):
        if data[4 + 3 * k]:
            d = data[4 + 3 * k] + 256 * data[5 + 3 * k]
            rays.append([-np.radians((a + k * step) / 100), d / 1000])
    return rays
""",
    ),
    (
        "14-command",
        "thesis' checksum",
        """
def command(speed, turn):
    t, r = max(-100, min(100, speed)) % 256, max(-100, min(100, turn)) % 256
    return f"#01{t:02X}{r:02X}{256 - 1 - t - r:02X}/"
""",
    ),
    (
        "14-command",
        "not cut off",
        """
def command(speed, turn):
    t, r = speed % 256, turn % 256
    return f"#01{t:02X}{r:02X}{(-1 - t - r) % 256:02X}/"
""",
    ),
    (
        "14-command",
        "cut off on one side",
        """
def command(speed, turn):
    t, r = min(speed, 100) % 256, min(turn, 100) % 256
    return f"#01{t:02X}{r:02X}{(-1 - t - r) % 256:02X}/"
""",
    ),
    (
        "14-command",
        "without leading zeros",
        """
def command(speed, turn):
    t, r = max(-100, min(100, speed)) % 256, max(-100, min(100, turn)) % 256
    return f"#01{t:X}{r:X}{(-1 - t - r) % 256:X}/"
""",
    ),
    (
        "14-command",
        "decimal digits",
        """
def command(speed, turn):
    t, r = max(-100, min(100, speed)) % 256, max(-100, min(100, turn)) % 256
    return f"#01{t:02d}{r:02d}{(-1 - t - r) % 256:02d}/"
""",
    ),
    (
        "14-unwrap",
        "only ahead",
        """
def unwrap(values):
    steps = np.diff(values) % 256
    return np.concatenate([[0], np.cumsum(steps)])
""",
    ),
    (
        "14-unwrap",
        "threshold 100",
        """
def unwrap(values):
    steps = np.diff(np.asarray(values, int))
    steps[steps > 100] -= 256
    steps[steps < -100] += 256
    return np.append(0, np.cumsum(steps))
""",
    ),
    (
        "14-unwrap",
        "np.unwrap in radians",
        """
def unwrap(values):
    v = np.asarray(values, float)
    w = np.unwrap(v / 128 * np.pi) / np.pi * 128
    return np.rint(w - w[0]) + 1
""",
    ),
    (
        "14-unwrap",
        "mends one overflow only",
        """
def unwrap(values):
    v = np.array(values, dtype=int)
    d = np.diff(v)
    big = np.flatnonzero(np.abs(d) > 127)
    if len(big):
        k = big[0] + 1
        v[k:] -= 256 * np.sign(d[k - 1])
    return v - v[0]
""",
    ),
    (
        "14-trials",
        "the two ways of the text",
        """
def trials():
    return [way(0, [50] * 6), way(0, [-50] * 6)]
""",
    ),
    (
        "14-trials",
        "random ways",
        """
def trials():
    rng = np.random.default_rng(1)
    return [way(int(rng.integers(-128, 128)), rng.integers(-127, 128, 40)) for _ in range(20)]
""",
    ),
    (
        "14-trials",
        "steps of 128",
        """
def trials():
    return [way(0, [128] * 5), way(0, [127] * 200), ([], [])]
""",
    ),
    (
        "14-trials",
        "counts that begin with the first value",
        """
def trials():
    v, c = way(5, [40] * 20)
    return [(v, c + 5)]
""",
    ),
]
