"""A fifth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "14-command",
        "two's complement by struct",
        """
def command(speed, turn):
    import struct
    v = struct.pack("bb", int(np.clip(speed, -100, 100)), int(np.clip(turn, -100, 100)))
    body = bytes([1]) + v
    frame = bytes([0]) + body if False else body
    total = sum(frame) % 256
    return "#" + (frame + bytes([(-total) % 256])).hex().upper() + "/"
""",
    ),
]

WRONG = [
    (
        "14-nodes",
        "signed distance",
        """
def nodes(data):
    out = []
    for k in range(len(data) // 5):
        b = data[5 * k:5 * k + 5]
        if (b[0] ^ b[0] >> 1) & 1 and b[1] & 1:
            out.append([b[0] & 1, b[0] >> 2, (int.from_bytes(b[1:3], "little") >> 1) / 64,
                        int.from_bytes(b[3:5], "little", signed=True) / 4])
    return np.array(out)
""",
    ),
    (
        "14-unwrap",
        "numpy's unwrap without a period",
        """
def unwrap(values):
    v = np.unwrap(np.asarray(values, float))
    return v - v[0]
""",
    ),
]
