"""Independent answers to 14-command: right ones, and students' mistakes."""

RIGHT = [
    (
        "14-command",
        "bytes.hex and struct",
        """
import struct

def command(speed, turn):
    body = struct.pack(">Bbb", 1, min(max(speed, -100), 100), min(max(turn, -100), 100))
    total = sum(body)
    return "#" + (body + bytes([(256 - total % 256) % 256])).hex().upper() + "/"
""",
    ),
    (
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
    ),
]

WRONG = [
    (
        "14-command",
        "the listing's checksum",
        """
def command(speed, turn):
    speed = max(-100, min(100, speed))
    turn = max(-100, min(100, turn))
    check_byte = 256 - 1 - speed - turn
    return f"#01{speed & 255:02X}{turn & 255:02X}{check_byte:02X}/"
""",
    ),
    (
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
    ),
    (
        "14-command",
        "checksum 100 where the sum is 0",
        """
def command(speed, turn):
    t, r = (int(np.clip(v, -100, 100)) & 0xFF for v in (speed, turn))
    cc = 256 - (1 + t + r) % 256
    return f"#01{t:02X}{r:02X}{cc:02X}/"
""",
    ),
    (
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
    ),
    (
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
    ),
    (
        "14-command",
        "nothing is cut off",
        """
def command(speed, turn):
    b = bytes([1, speed % 256, turn % 256])
    b += bytes([(256 - sum(b)) % 256])
    return "#" + b.hex().upper() + "/"
""",
    ),
    (
        "14-command",
        "cut off at the byte's ends",
        """
def command(speed, turn):
    b = bytes([1]) + bytes(min(127, max(-128, v)) & 255 for v in (speed, turn))
    return "#" + (b + bytes([-sum(b) & 255])).hex().upper() + "/"
""",
    ),
    (
        "14-command",
        "only cut off above",
        """
def command(speed, turn):
    b = [1, min(speed, 100) % 256, min(turn, 100) % 256]
    b.append(-sum(b) % 256)
    return "#%02X%02X%02X%02X/" % tuple(b)
""",
    ),
    (
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
    ),
    (
        "14-command",
        "too large numbers scaled together",
        """
def command(speed, turn):
    most = max(abs(speed), abs(turn), 100)
    t, r = round(speed * 100 / most) % 256, round(turn * 100 / most) % 256
    return f"#01{t:02X}{r:02X}{-(1 + t + r) % 256:02X}/"
""",
    ),
    (
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
    ),
    (
        "14-command",
        "checksum of the values before they are cut off",
        """
def command(speed, turn):
    cc = -(1 + speed + turn) % 256
    speed, turn = (max(-100, min(100, v)) % 256 for v in (speed, turn))
    return f"#01{speed:02X}{turn:02X}{cc:02X}/"
""",
    ),
    (
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
    ),
    (
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
    ),
    (
        "14-command",
        "negative as text -32",
        """
def command(speed, turn):
    t = sorted((-100, speed, 100))[1]
    r = sorted((-100, turn, 100))[1]
    return f"#01{t:02X}{r:02X}{-(1 + t + r) % 256:02X}/"
""",
    ),
    (
        "14-command",
        "checksum without the opcode",
        """
def command(speed, turn):
    t = sorted((-100, speed, 100))[1] & 255
    r = sorted((-100, turn, 100))[1] & 255
    return f"#01{t:02X}{r:02X}{-(t + r) & 255:02X}/"
""",
    ),
    (
        "14-command",
        "turn before speed",
        """
def command(speed, turn):
    data = [1] + [max(-100, min(100, each)) % 256 for each in (turn, speed)]
    return "#" + "".join(f"{byte:02X}" for byte in [*data, -sum(data) % 256]) + "/"
""",
    ),
    (
        "14-command",
        "bytes instead of str",
        """
def command(speed, turn):
    data = bytes([1] + [max(-100, min(100, each)) % 256 for each in (speed, turn)])
    return b"#" + (data + bytes([-sum(data) % 256])).hex().upper().encode() + b"/"
""",
    ),
    (
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
    ),
    (
        "14-command",
        "decimal digits",
        """
def command(speed, turn):
    data = [1] + [max(-100, min(100, each)) % 256 for each in (speed, turn)]
    data.append(-sum(data) % 256)
    return "#" + "".join(f"{byte:02d}" for byte in data) + "/"
""",
    ),
    (
        "14-command",
        "xor for a sum",
        """
def command(speed, turn):
    t, r = (max(-100, min(100, v)) & 255 for v in (speed, turn))
    return "#01%02X%02X%02X/" % (t, r, 1 ^ t ^ r)
""",
    ),
    (
        "14-command",
        "sum itself, not what is missing to 256",
        """
def command(speed, turn):
    t, r = (max(-100, min(100, v)) & 255 for v in (speed, turn))
    return "#01%02X%02X%02X/" % (t, r, (1 + t + r) & 255)
""",
    ),
]
