"""Right ways of the task of a lidar that the lesson has not seen, and what of the lesson is none."""

WAYS = {
    "arrays": """
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
""",
    "struct": """
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
""",
    "by a clock": """
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
""",
    "interpolated": """
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
""",
}

PASTED = {
    "the lesson's node": """
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
""",
    "the lesson's capsule": """
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
""",
    "the lesson's capsule without its checksum": """
def sweep(data):
    points = np.reshape(list(data[4 : 4 + (len(data) - 7) // 3 * 3]), (-1, 3))
    alpha = ((data[2] | data[3] << 8) & 0x7FFF) / 64
    turned = ((data[-3] | data[-2] << 8) / 64 - alpha) % 360
    mm = points[:, 0] | points[:, 1] << 8
    at = (alpha + np.arange(len(mm)) / len(mm) * turned) % 360
    return np.column_stack([-np.radians(at), (mm >> 2) / 1000])
""",
    "the first task's nodes": """
def sweep(data):
    return [row[2:] for row in nodes(data[: len(data) // 5 * 5])]
""",
}
