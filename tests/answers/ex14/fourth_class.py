"""A fourth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "14-nodes",
        "numpy over all bytes",
        """
def nodes(data):
    b = np.frombuffer(data, dtype=np.uint8).reshape(-1, 5).astype(int)
    good = ((b[:, 0] & 1) != (b[:, 0] >> 1 & 1)) & ((b[:, 1] & 1) == 1)
    b = b[good]
    return np.column_stack([b[:, 0] & 1, b[:, 0] >> 2, ((b[:, 2] << 7) | (b[:, 1] >> 1)) / 64,
                            (b[:, 3] + 256 * b[:, 4]) / 4])
""",
    ),
    (
        "14-unwrap",
        "differences brought to a signed byte by numpy",
        """
def unwrap(values):
    steps = np.diff(np.asarray(values).astype(np.int64)).astype(np.int8)
    return np.r_[0, np.cumsum(steps.astype(np.int64))]
""",
    ),
]

WRONG = [
    (
        "14-nodes",
        "high byte first",
        """
def nodes(data):
    out = []
    for k in range(0, len(data), 5):
        b = data[k:k + 5]
        s, ns, c = b[0] & 1, b[0] >> 1 & 1, b[1] & 1
        if s != ns and c:
            out.append([s, b[0] >> 2, ((b[1] << 8 | b[2]) >> 1) / 64, (b[3] << 8 | b[4]) / 4])
    return np.array(out)
""",
    ),
    (
        "14-nodes",
        "a distance of 0 is damaged, too",
        """
def nodes(data):
    out = []
    for k in range(0, len(data), 5):
        b = data[k:k + 5]
        s, ns, c = b[0] & 1, b[0] >> 1 & 1, b[1] & 1
        d = (b[3] | b[4] << 8) / 4
        if s != ns and c and d > 0:
            out.append([s, b[0] >> 2, ((b[1] | b[2] << 8) >> 1) / 64, d])
    return np.array(out)
""",
    ),
    (
        "14-nodes",
        "stops at the first damaged one",
        """
def nodes(data):
    out = []
    for k in range(0, len(data), 5):
        b = data[k:k + 5]
        s, ns, c = b[0] & 1, b[0] >> 1 & 1, b[1] & 1
        if s == ns or not c:
            break
        out.append([s, b[0] >> 2, ((b[1] | b[2] << 8) >> 1) / 64, (b[3] | b[4] << 8) / 4])
    return np.array(out)
""",
    ),
    (
        "14-nodes",
        "C is not taken out of the angle",
        """
def nodes(data):
    out = []
    for k in range(0, len(data), 5):
        b = data[k:k + 5]
        s, ns, c = b[0] & 1, b[0] >> 1 & 1, b[1] & 1
        if s != ns and c:
            out.append([s, b[0] >> 2, (b[1] | b[2] << 8) / 64, (b[3] | b[4] << 8) / 4])
    return np.array(out)
""",
    ),
    (
        "14-sweep",
        "divides by n",
        """
def sweep(data):
    if data[0] != 0x54 or len(data) != 7 + 3 * data[1] or sum(data[:-1]) % 256 != data[-1]:
        return None
    n = data[1]
    a0 = (data[2] | data[3] << 8) / 100
    a1 = (data[-3] | data[-2] << 8) / 100
    step = (a1 - a0) % 360 / n
    out = []
    for k in range(n):
        mm = data[4 + 3 * k] | data[5 + 3 * k] << 8
        if mm:
            out.append([-np.radians(a0 + k * step), mm / 1000])
    return np.array(out)
""",
    ),
    (
        "14-sweep",
        "divides by zero where there is one point",
        """
def sweep(data):
    if data[0] != 0x54 or len(data) != 7 + 3 * data[1] or sum(data[:-1]) % 256 != data[-1]:
        return None
    n = data[1]
    a0 = (data[2] | data[3] << 8) / 100
    a1 = (data[-3] | data[-2] << 8) / 100
    step = (a1 - a0) % 360 / (n - 1)
    out = []
    for k in range(n):
        mm = data[4 + 3 * k] | data[5 + 3 * k] << 8
        if mm:
            out.append([-np.radians(a0 + k * step), mm / 1000])
    return np.array(out)
""",
    ),
    (
        "14-sweep",
        "the last angle below the first is not carried on",
        """
def sweep(data):
    if data[0] != 0x54 or len(data) != 7 + 3 * data[1] or sum(data[:-1]) % 256 != data[-1]:
        return None
    n = data[1]
    a = np.linspace(data[2] | data[3] << 8, data[-3] | data[-2] << 8, n) / 100
    mm = np.array([data[4 + 3 * k] | data[5 + 3 * k] << 8 for k in range(n)])
    return np.column_stack([-np.radians(a), mm / 1000])[mm > 0]
""",
    ),
    (
        "14-command",
        "clipped after the complement",
        """
def command(speed, turn):
    v, t = min(speed % 256, 100), min(turn % 256, 100)
    c = -(1 + v + t) % 256
    return f"#01{v:02X}{t:02X}{c:02X}/"
""",
    ),
    (
        "14-command",
        "small letters and no padding",
        """
def command(speed, turn):
    v, t = max(-100, min(100, speed)) & 255, max(-100, min(100, turn)) & 255
    c = (256 - (1 + v + t) % 256) % 256
    return "#01" + hex(v)[2:] + hex(t)[2:] + hex(c)[2:] + "/"
""",
    ),
    (
        "14-command",
        "the opcode is not summed",
        """
def command(speed, turn):
    v, t = max(-100, min(100, speed)) & 255, max(-100, min(100, turn)) & 255
    return "#01%02X%02X%02X/" % (v, t, -(v + t) & 255)
""",
    ),
    (
        "14-command",
        "256 less the sum, three digits when the sum is 0",
        """
def command(speed, turn):
    v, t = max(-100, min(100, speed)) & 255, max(-100, min(100, turn)) & 255
    return "#01%02X%02X%02X/" % (v, t, 256 - (1 + v + t) % 256)
""",
    ),
    (
        "14-unwrap",
        "int8 overflow of the sum",
        """
def unwrap(values):
    steps = np.diff(np.asarray(values)).astype(np.int8)
    return np.concatenate([[0], np.cumsum(steps, dtype=np.int8)])
""",
    ),
    (
        "14-unwrap",
        "jumps beyond 100 only",
        """
def unwrap(values):
    out, total = [0], 0
    for a, b in zip(values[:-1], values[1:]):
        d = int(b) - int(a)
        if d > 200:
            d -= 256
        elif d < -200:
            d += 256
        total += d
        out.append(total)
    return np.array(out)
""",
    ),
    (
        "14-unwrap",
        "the difference from the first reading",
        """
def unwrap(values):
    v = np.asarray(values)
    return np.where(v < v[0], v + 256, v) - v[0]
""",
    ),
    (
        "14-trials",
        "ahead and back",
        """
def trials():
    return [way(0, [50] * 6), way(0, [-50] * 6), way(0, []), way(-128, [127, -127] * 20)]
""",
    ),
]
