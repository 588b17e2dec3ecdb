"""A ninth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "14-nodes",
        "numpy on the whole packet, bytes as int, a mask for the good nodes",
        """
def nodes(data):
    b = np.frombuffer(bytes(data), dtype=np.uint8).astype(int).reshape(-1, 5)
    s, not_s = b[:, 0] % 2, b[:, 0] // 2 % 2
    word, dist = b[:, 1] + 256 * b[:, 2], b[:, 3] + 256 * b[:, 4]
    good = (s + not_s == 1) & (word % 2 == 1)
    table = np.column_stack([s, b[:, 0] // 4, (word // 2) / 64.0, dist / 4.0])
    return table[good]
""",
    ),
    (
        "14-sweep",
        "int.from_bytes and numpy; angles by linspace to the last one after it was put a turn on where needed",
        """
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
""",
    ),
    (
        "14-unwrap",
        "differences in eight-bit arithmetic, which wraps by itself, then summed as int",
        """
def unwrap(values):
    eight = np.array(values, dtype=np.int8)
    steps = eight[1:] - eight[:-1]
    return np.concatenate([[0], np.cumsum(steps.astype(int))])
""",
    ),
    (
        "14-command",
        "checksum from the signed numbers, bytes by formatting",
        """
def command(speed, turn):
    s, t = sorted((-100, speed, 100))[1], sorted((-100, turn, 100))[1]
    check = (-1 - s - t) & 0xFF
    return "#01%02X%02X%02X/" % (s & 0xFF, t & 0xFF, check)
""",
    ),
]

WRONG = [
    (
        "14-nodes",
        "numbers of two bytes are read with the high byte first",
        """
def nodes(data):
    out = []
    for k in range(len(data) // 5):
        a, b, c, d, e = data[5 * k : 5 * k + 5]
        word, dist = 256 * b + c, 256 * d + e
        if (a & 1) != ((a >> 1) & 1) and word & 1:
            out.append([a & 1, a >> 2, (word >> 1) / 64, dist / 4])
    return np.array(out)
""",
    ),
    (
        "14-nodes",
        "bit 0 of the angle's word (C) is not taken off: the angle comes out twice as large",
        """
def nodes(data):
    rows = []
    for i in range(0, len(data), 5):
        f, lo, hi, dlo, dhi = data[i : i + 5]
        w = lo + 256 * hi
        if f & 1 == f >> 1 & 1 or not w & 1:
            continue
        rows.append((f & 1, f >> 2, w / 64, (dlo + 256 * dhi) / 4))
    return rows
""",
    ),
    (
        "14-nodes",
        "C is never looked at: nodes with C = 0 are kept",
        """
def nodes(data):
    found = []
    for at in range(0, len(data), 5):
        flags = data[at]
        s, inverse = flags & 1, (flags >> 1) & 1
        if s == inverse:
            continue
        angle = ((data[at + 1] >> 1) + (data[at + 2] << 7)) / 64
        distance = (data[at + 3] + (data[at + 4] << 8)) / 4
        found.append([s, flags >> 2, angle, distance])
    return np.array(found)
""",
    ),
    (
        "14-nodes",
        "nodes that did not come back (distance 0) are left out, too",
        """
def nodes(data):
    found = []
    for at in range(0, len(data), 5):
        flags, a, b, c, d = data[at : at + 5]
        word, distance = a | b << 8, c | d << 8
        good = flags & 1 != flags >> 1 & 1 and word & 1
        if good and distance > 0:
            found.append([flags & 1, flags >> 2, (word >> 1) / 64, distance / 4])
    return np.array(found)
""",
    ),
    (
        "14-nodes",
        "bytes are shifted as uint8 in numpy: the high bytes overflow and get lost",
        """
def nodes(data):
    b = np.frombuffer(data, dtype=np.uint8).reshape(-1, 5)
    s = b[:, 0] & 1
    ok = (s != (b[:, 0] >> 1 & 1)) & (b[:, 1] & 1 == 1)
    angle = (b[:, 1] >> 1 | b[:, 2] << 7) / 64
    dist = (b[:, 3] | b[:, 4] << 8) / 4
    return np.column_stack([s, b[:, 0] >> 2, angle, dist])[ok]
""",
    ),
    (
        "14-nodes",
        "quality is the six LOW bits of byte 0 (& 63) instead of bits 2 to 7",
        """
def nodes(data):
    found = []
    for at in range(0, len(data), 5):
        flags, a, b, c, d = data[at : at + 5]
        word = a | b << 8
        if flags & 1 != flags >> 1 & 1 and word & 1:
            found.append([flags & 1, flags & 0x3F, (word >> 1) / 64, (c | d << 8) / 4])
    return np.array(found)
""",
    ),
    (
        "14-nodes",
        "a damaged node makes it go on by one byte only, as if a byte had been lost",
        """
def nodes(data):
    i, rows = 0, []
    while i + 5 <= len(data):
        f = data[i]
        w = data[i + 1] | data[i + 2] << 8
        if (f & 1) ^ (f >> 1 & 1) and w & 1:
            rows.append([f & 1, f >> 2, (w >> 1) / 64, (data[i + 3] | data[i + 4] << 8) / 4])
            i += 5
        else:
            i += 1
    return np.array(rows)
""",
    ),
    (
        "14-nodes",
        "whole-number division: fractions of a degree and of a millimetre are cut off",
        """
def nodes(data):
    found = []
    for at in range(0, len(data), 5):
        flags, a, b, c, d = data[at : at + 5]
        word, distance = a + 256 * b, c + 256 * d
        if flags % 2 != flags // 2 % 2 and word % 2:
            found.append([flags % 2, flags // 4, word // 128, distance // 4])
    return np.array(found)
""",
    ),
    (
        "14-sweep",
        "the way from first to last is divided by n instead of n - 1, as for capsules",
        """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return None
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (last - first) % 36000 / n
    rays = []
    for k in range(n):
        mm = data[4 + 3 * k] | data[5 + 3 * k] << 8
        if mm:
            rays.append([-np.radians((first + k * step) / 100), mm / 1000])
    return rays
""",
    ),
    (
        "14-sweep",
        "no modulo: a packet that passes 0 degrees is read as turning back",
        """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return None
    a = (data[2] + 256 * data[3]) / 100
    b = (data[-3] + 256 * data[-2]) / 100
    psi = np.linspace(a, b, n)
    r = np.array([data[4 + 3 * k] + 256 * data[5 + 3 * k] for k in range(n)])
    return np.column_stack([-np.radians(psi), r / 1000])[r > 0]
""",
    ),
    (
        "14-sweep",
        "the angles stay clockwise: the sign is not turned",
        """
def sweep(data):
    n = data[1]
    if data[0] != 84 or len(data) != 7 + 3 * n or sum(data[:-1]) & 255 != data[-1]:
        return None
    start = int.from_bytes(data[2:4], "little")
    end = int.from_bytes(data[-3:-1], "little")
    span = (end - start) % 36000
    out = []
    for k in range(n):
        d = int.from_bytes(data[4 + 3 * k : 6 + 3 * k], "little")
        if d > 0:
            psi = start + (span * k / (n - 1) if n > 1 else 0)
            out.append([np.radians(psi / 100), d / 1000])
    return np.array(out)
""",
    ),
    (
        "14-sweep",
        "a packet of one point divides by zero",
        """
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
""",
    ),
    (
        "14-sweep",
        "points that did not come back are left out first, and the angles are spread over those that are left",
        """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return None
    mm = [data[4 + 3 * k] | data[5 + 3 * k] << 8 for k in range(n)]
    mm = [d for d in mm if d]
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    span = (last - first) % 36000
    m = max(len(mm) - 1, 1)
    return [[-np.radians((first + span * k / m) / 100), d / 1000] for k, d in enumerate(mm)]
""",
    ),
    (
        "14-sweep",
        "a damaged packet gives an empty list instead of None",
        """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return []
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (last - first) % 36000 / max(n - 1, 1)
    rays = []
    for k in range(n):
        r = data[4 + 3 * k] | data[5 + 3 * k] << 8
        if r:
            rays.append([-np.radians((first + k * step) / 100), r / 1000])
    return rays
""",
    ),
    (
        "14-sweep",
        "a packet longer than its n asks for is not refused: the length is tested with 'shorter than' only",
        """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) < 3 * n + 7:
        return None
    data = data[: 3 * n + 7]
    if sum(data[:-1]) % 256 != data[-1]:
        return None
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (last - first) % 36000 / max(n - 1, 1)
    rays = []
    for k in range(n):
        r = data[4 + 3 * k] | data[5 + 3 * k] << 8
        if r:
            rays.append([-np.radians((first + k * step) / 100), r / 1000])
    return rays
""",
    ),
    (
        "14-sweep",
        "returns None where the packet is sound but no point came back",
        """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return None
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (last - first) % 36000 / max(n - 1, 1)
    rays = []
    for k in range(n):
        r = data[4 + 3 * k] | data[5 + 3 * k] << 8
        if r:
            rays.append([-np.radians((first + k * step) / 100), r / 1000])
    return np.array(rays) if rays else None
""",
    ),
    (
        "14-sweep",
        "a point counts as not come back where its LOW byte is 0: whole multiples of 256 mm are dropped",
        """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return None
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    step = (last - first) % 36000 / max(n - 1, 1)
    found = []
    for k in range(n):
        low, high, _ = data[4 + 3 * k : 7 + 3 * k]
        if low:
            found.append([-np.radians((first + k * step) / 100), (low | high << 8) / 1000])
    return found
""",
    ),
    (
        "14-command",
        "checksum is 256 less the other bytes, without modulo: more than two digits or negative",
        """
def command(speed, turn):
    data = [1] + [max(-100, min(100, v)) % 256 for v in (speed, turn)]
    cc = 256 - sum(data)
    return "#" + "".join(f"{b:02X}" for b in data) + f"{cc:02X}/"
""",
    ),
    (
        "14-command",
        "speed and turn are not cut off at 100",
        """
def command(speed, turn):
    body = bytes([1, speed % 256, turn % 256])
    body += bytes([-sum(body) % 256])
    return "#" + body.hex().upper() + "/"
""",
    ),
    (
        "14-command",
        "negative numbers as 255 - |v| (one's complement)",
        """
def command(speed, turn):
    def byte(v):
        v = max(-100, min(100, v))
        return v if v >= 0 else 255 + v

    s, t = byte(speed), byte(turn)
    return f"#01{s:02X}{t:02X}{(256 - (1 + s + t) % 256) % 256:02X}/"
""",
    ),
    (
        "14-command",
        "hexadecimal digits without a leading zero: small bytes become one digit",
        """
def command(speed, turn):
    speed, turn = int(np.clip(speed, -100, 100)) % 256, int(np.clip(turn, -100, 100)) % 256
    check = -(1 + speed + turn) % 256
    return "#01" + "%X" % speed + "%X" % turn + "%X" % check + "/"
""",
    ),
    (
        "14-command",
        "the opcode is left out of the checksum",
        """
def command(speed, turn):
    s = max(min(speed, 100), -100) & 0xFF
    t = max(min(turn, 100), -100) & 0xFF
    return "#01{:02X}{:02X}{:02X}/".format(s, t, -(s + t) & 0xFF)
""",
    ),
    (
        "14-command",
        "cut off at -128 and 127, the limits of a signed byte, instead of 100 percent",
        """
def command(speed, turn):
    v, w = (max(-128, min(127, x)) % 256 for x in (speed, turn))
    return f"#01{v:02X}{w:02X}{(-1 - v - w) % 256:02X}/"
""",
    ),
    (
        "14-command",
        "checksum 255 - (sum mod 256), one too small",
        """
def command(speed, turn):
    data = [1, max(-100, min(100, speed)) % 256, max(-100, min(100, turn)) % 256]
    data.append(255 - sum(data) % 256)
    return "#" + "".join(f"{b:02X}" for b in data) + "/"
""",
    ),
    (
        "14-unwrap",
        "plain difference to the first reading: overflows are not mended",
        """
def unwrap(values):
    values = np.asarray(values, dtype=int)
    return values - values[0]
""",
    ),
    (
        "14-unwrap",
        "only overflows ahead are mended; a robot that backs past -128 jumps ahead by 256",
        """
def unwrap(values):
    total, out = 0, [0]
    for a, b in zip(values[:-1], values[1:]):
        step = int(b) - int(a)
        if step < -127:
            step += 256
        total += step
        out.append(total)
    return np.array(out)
""",
    ),
    (
        "14-unwrap",
        "every step is taken modulo 256, so a step back counts as one far ahead",
        """
def unwrap(values):
    steps = np.diff(np.asarray(values, dtype=int)) % 256
    return np.concatenate([[0], np.cumsum(steps)])
""",
    ),
    (
        "14-unwrap",
        "turns of 255 instead of 256 counts",
        """
def unwrap(values):
    out, turns = [0], 0
    for k in range(1, len(values)):
        jump = int(values[k]) - int(values[k - 1])
        if jump > 127:
            turns -= 1
        elif jump < -127:
            turns += 1
        out.append(int(values[k]) + 255 * turns - int(values[0]))
    return np.array(out)
""",
    ),
    (
        "14-unwrap",
        "overflow is assumed from a jump of 100 on: large steps without an overflow are mended, too",
        """
def unwrap(values):
    v = [int(x) for x in values]
    counts = [0]
    for old, new in zip(v, v[1:]):
        d = new - old
        if d > 100:
            d -= 256
        elif d < -100:
            d += 256
        counts.append(counts[-1] + d)
    return np.array(counts)
""",
    ),
    (
        "14-unwrap",
        "a step of exactly 127 (or -127) is taken for an overflow: edge off by one",
        """
def unwrap(values):
    steps = np.diff(np.asarray(values, dtype=int))
    steps = np.where(steps >= 127, steps - 256, steps)
    steps = np.where(steps <= -127, steps + 256, steps)
    return np.concatenate([[0], np.cumsum(steps)])
""",
    ),
    (
        "14-unwrap",
        "counted from 0 and not from the first reading: the first value is added to all",
        """
def unwrap(values):
    out = [int(values[0])]
    for k in range(1, len(values)):
        out.append(out[-1] + (int(values[k]) - int(values[k - 1]) + 128) % 256 - 128)
    return np.array(out)
""",
    ),
    (
        "14-unwrap",
        "one value too few: the zero of the first reading is missing",
        """
def unwrap(values):
    steps = (np.diff(values) + 128) % 256 - 128
    return np.cumsum(steps)
""",
    ),
    (
        "14-trials",
        "only the two ways of the example, 50 counts ahead and back: short, no edges",
        """
def trials():
    return [way(0, [50] * 6), way(0, [-50] * 6)]
""",
    ),
    (
        "14-trials",
        "one long random way with steps up to 60: no largest step, no empty and no single reading, no second way",
        """
def trials():
    rng = np.random.default_rng(1)
    return [way(0, rng.integers(-60, 61, 900))]
""",
    ),
    (
        "14-trials",
        "steps of 128 are in it, which nobody promised: right drivers may differ",
        """
def trials():
    return [
        way(0, [127, -127, 128, -128] * 20),
        way(-128, [0, 1, -1] * 30),
        way(127, [100] * 300),
        way(5, [-100] * 300),
        way(3, []),
    ]
""",
    ),
    (
        "14-trials",
        "more than 1000 readings in all",
        """
def trials():
    out = [([], []), way(0, [])]
    for begin in (-128, -1, 0, 127):
        out.append(way(begin, [127] * 150))
        out.append(way(begin, [-127] * 150))
    return out
""",
    ),
    (
        "14-trials",
        "the counts expected are plain differences of the readings: right drivers fail at the first overflow",
        """
def trials():
    out = []
    for begin in (0, 100, -100):
        for step in (1, 60, 127, -1, -60, -127):
            values, _ = way(begin, [step] * 20)
            out.append((values, values - values[0]))
    return out
""",
    ),
    (
        "14-trials",
        "readings are handed over as unsigned bytes, 0 to 255",
        """
def trials():
    out = []
    for begin, steps in ((0, [127] * 100), (200, [-127] * 100), (128, [0, 1, -1, 64, -64] * 20), (7, [])):
        counts = np.concatenate([[0], np.cumsum(np.array(steps, dtype=int))])
        out.append(((begin + counts) % 256, counts))
    return out
""",
    ),
]
