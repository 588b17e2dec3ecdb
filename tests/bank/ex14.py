"""Solutions of exercise 14 that are wrong in a classic way, and right ones that look different."""

from tests.bank import Right, Wrong

NODES = """
def nodes(data):
    found = []
    for at in range(0, len(data), 5):
        flags, a, b, c, d = data[at : at + 5]
        word, distance = {word}, {far}
        if {good}:
            found.append([{start}, {quality}, {angle}, {mm}])
    return {result}
"""


def nodes(**changes):
    parts = {
        "word": "a | b << 8",
        "far": "c | d << 8",
        "good": "flags & 1 != flags >> 1 & 1 and word & 1",
        "start": "flags & 1",
        "quality": "flags >> 2",
        "angle": "(word >> 1) / 64",
        "mm": "distance / 4",
        "result": "np.array(found)",
    }
    return NODES.format(**(parts | changes))


POINTS = """
def points(degrees, millimetres, front):
    back = {back}
    angle, r = {angle}, {r}
    return np.column_stack([{x}, {y}])
"""


def points(**changes):
    parts = {
        "back": "millimetres > 0",
        "angle": "np.radians(front - degrees[back])",
        "r": "millimetres[back] / 1000",
        "x": "r * np.cos(angle)",
        "y": "r * np.sin(angle)",
    }
    return POINTS.format(**(parts | changes))


COMMAND = """
def command(speed, turn):
    T, R = ({cut} % 256 for each in (speed, turn))
    {then}
    return f"{text}"
"""


def command(check="-(1 + T + R) % 256", **changes):
    parts = {
        "cut": "max(-100, min(100, each))",
        "then": f"C = {check}",
        "text": "#01{T:02X}{R:02X}{C:02X}/",
    }
    return COMMAND.format(**(parts | changes))


LIMITED = """
def command(speed, turn):
    speed, turn = max(-100, min(100, speed)), max(-100, min(100, turn))
    {body}
"""


def limited(body):
    return LIMITED.format(body=body)


STATUS = """
def status(text):
    data = bytes.fromhex(text[1:-1])
    if {bad}:
        return None
    signed = lambda byte: {sign}
    return {result}
"""


def status(**changes):
    parts = {
        "bad": "sum(data) % 256",
        "sign": "byte - 256 if byte > 127 else byte",
        "result": "data[2], signed(data[7]), 2 * data[13], signed(data[14]), signed(data[15])",
    }
    return STATUS.format(**(parts | changes))


def unwrap(result, before="pass"):
    return f"""
def unwrap(values):
    steps = np.diff(values)
    {before}
    return {result}
"""


ADDED = "np.concatenate([[0], np.cumsum({})])"
WHOLE = {"14-nodes:whole nodes"}
MARKS = {"14-nodes:start and quality"}
ANGLE, DISTANCE = {"14-nodes:angle"}, {"14-nodes:distance"}
DIRECTION = {"14-points:direction"}
SHORT, RING = {"14-unwrap:shorter way"}, {"14-unwrap:same ring"}

WRONG = [
    Wrong("all nodes kept", nodes(good="True"), WHOLE, "damaged kept"),
    Wrong("C not checked", nodes(good="flags & 1 != flags >> 1 & 1"), WHOLE, "c not checked"),
    Wrong("S not checked", nodes(good="word & 1"), WHOLE, "s not checked"),
    Wrong(
        "angle big endian",
        nodes(word="a << 8 | b", good="flags & 1 != flags >> 1 & 1 and a & 1"),
        ANGLE,
        "big endian",
    ),
    Wrong("distance big endian", nodes(far="c << 8 | d"), DISTANCE, "big endian"),
    Wrong(
        "both big endian",
        nodes(word="a << 8 | b", far="c << 8 | d", good="flags & 1 != flags >> 1 & 1 and a & 1"),
        ANGLE | DISTANCE,
        "big endian",
    ),
    Wrong("shift forgotten", nodes(angle="word / 64"), ANGLE, "shift forgotten"),
    Wrong("C masked, not shifted", nodes(angle="(word & 0xFFFE) / 64"), ANGLE, "shift forgotten"),
    Wrong("divided by 128 with C in it", nodes(angle="word / 128"), ANGLE, "c in the angle"),
    Wrong("angle as counted", nodes(angle="word >> 1"), ANGLE, "angle not divided"),
    Wrong("whole degrees", nodes(angle="(word >> 1) // 64"), ANGLE, "whole degrees"),
    Wrong("angle in radians", nodes(angle="np.radians((word >> 1) / 64)"), ANGLE, "radians"),
    Wrong("distance as counted", nodes(mm="distance"), DISTANCE, "distance not divided"),
    Wrong("whole millimetres", nodes(mm="distance >> 2"), DISTANCE, "whole millimetres"),
    Wrong(
        "distance with a sign",
        nodes(far="int.from_bytes(bytes([c, d]), 'little', signed=True)"),
        DISTANCE,
        "sign",
    ),
    Wrong("distance in metres", nodes(mm="distance / 4000"), DISTANCE, "metres"),
    Wrong("quality with the marks", nodes(quality="flags"), MARKS, "quality not shifted"),
    Wrong("quality masked", nodes(quality="flags & 0xFC"), MARKS, "quality not shifted"),
    Wrong("not S for S", nodes(start="flags >> 1 & 1"), MARKS, "not s for s"),
    Wrong("columns as rows", nodes(result="np.array(found).T"), {"14-nodes"}, None, "malformed"),
    Wrong("nothing returned", nodes(result="None"), {"14-nodes"}, None, "malformed"),
    Wrong("one node only", nodes(result="np.array(found[0])"), {"14-nodes"}, None, "malformed"),
    Wrong("all but one node lost", nodes(result="np.array(found[:1])"), {"14-nodes"}),
    Wrong(
        "zeros kept", points(back="millimetres >= 0"), {"14-points:nothing left out"}, "zeros kept"
    ),
    Wrong(
        "counter-clockwise",
        points(angle="np.radians(degrees[back] - front)"),
        DIRECTION,
        "counter-clockwise",
    ),
    Wrong(
        "front forgotten", points(angle="np.radians(-degrees[back])"), DIRECTION, "front forgotten"
    ),
    Wrong(
        "front and sign forgotten",
        points(angle="np.radians(degrees[back])"),
        DIRECTION,
        "front forgotten",
    ),
    Wrong(
        "front taken off twice",
        points(angle="np.radians(-front - degrees[back])"),
        DIRECTION,
        "front's sign",
    ),
    Wrong(
        "sine for x, as Tuček",
        points(
            angle="np.radians(degrees[back] - front)", x="r * np.sin(angle)", y="r * np.cos(angle)"
        ),
        DIRECTION,
        "front along +y",
    ),
    Wrong("degrees for radians", points(angle="front - degrees[back]"), DIRECTION, "degrees"),
    Wrong(
        "millimetres",
        points(r="millimetres[back]"),
        {"14-points:range", "14-points:direction"},
        "millimetres",
    ),
    Wrong(
        "as printed in the thesis",
        command("256 - 1 - T - R"),
        {"14-command:form", "14-command:checksum"},
        "as printed",
    ),
    Wrong(
        "checksum of the signed numbers",
        limited('return f"#01{speed % 256:02X}{turn % 256:02X}{255 - speed - turn:02X}/"'),
        {"14-command:form", "14-command:checksum"},
        "of signed numbers",
    ),
    Wrong(
        "256 less the remainder",
        command("256 - (1 + T + R) % 256"),
        {"14-command:form", "14-command:checksum"},
        "256 left",
    ),
    Wrong("XOR", command("1 ^ T ^ R"), {"14-command:checksum"}, "xor"),
    Wrong(
        "one's complement",
        command("255 - (1 + T + R) % 256"),
        {"14-command:checksum"},
        "one's complement",
    ),
    Wrong("opcode left out", command("-(T + R) % 256"), {"14-command:checksum"}, "opcode left out"),
    Wrong("the sum", command("(1 + T + R) % 256"), {"14-command:checksum"}, "sum for checksum"),
    Wrong("modulo 255", command("-(1 + T + R) % 255"), {"14-command:checksum"}, "modulo 255"),
    Wrong("not cut off", command(cut="each"), {"14-command:arguments"}, "not cut off"),
    Wrong(
        "speed and turn swapped",
        command(text="#01{R:02X}{T:02X}{C:02X}/"),
        {"14-command:arguments"},
        "swapped",
    ),
    Wrong("sign lost", command(cut="min(abs(each), 100)"), {"14-command:arguments"}, "sign lost"),
    Wrong(
        "sign bit",
        command(cut="(lambda n: 128 - n if n < 0 else n)(max(-100, min(100, each)))"),
        {"14-command:arguments"},
        "sign bit",
    ),
    Wrong(
        "a minus among the digits",
        limited('return f"#01{speed:02X}{turn:02X}{-(1 + speed + turn) % 256:02X}/"'),
        {"14-command"},
        "minus sign sent",
    ),
    Wrong(
        "decimal digits",
        command(text="#01{T:02d}{R:02d}{C:02d}/"),
        {"14-command"},
        "decimal",
        may_lose={"14-command:form", "14-command:checksum"},
    ),
    Wrong(
        "one digit where one is enough",
        command(text="#1{T:x}{R:x}{C:x}/"),
        {"14-command"},
        "digits missing",
    ),
    Wrong(
        "no slash",
        command(text="#01{T:02X}{R:02X}{C:02X}"),
        {"14-command:form", "14-command:checksum"},
    ),
    Wrong(
        "numbers, no text", limited("return [1, speed, turn]"), {"14-command"}, None, "malformed"
    ),
    Wrong("no return", limited("pass"), {"14-command"}, None, "malformed"),
    Wrong(
        "all bytes signed, as in the thesis",
        status(
            result="[signed(data[k]) * m for k, m in ((2, 1), (7, 1), (13, 2), (14, 1), (15, 1))]"
        ),
        {"14-status:without a sign"},
        "all signed",
    ),
    Wrong("no byte signed", status(sign="byte"), {"14-status:with a sign"}, "none signed"),
    Wrong(
        "255 taken off",
        status(sign="byte - 255 if byte > 127 else byte"),
        {"14-status:with a sign"},
        "255 taken off",
    ),
    Wrong(
        "sign bit and seven others",
        status(sign="-(byte & 127) if byte & 128 else byte"),
        {"14-status:with a sign"},
        "sign bit",
    ),
    Wrong(
        "bytes counted from 1",
        status(result="data[1], signed(data[6]), 2 * data[12], signed(data[13]), signed(data[14])"),
        {"14-status:without a sign", "14-status:with a sign"},
        "counted from one",
    ),
    Wrong(
        "compass in its own unit",
        status(result="data[2], signed(data[7]), data[13], signed(data[14]), signed(data[15])"),
        {"14-status:without a sign"},
        "compass not doubled",
    ),
    Wrong(
        "angle doubled, too",
        status(
            result="data[2], signed(data[7]), 2 * data[13], signed(data[14]), 2 * signed(data[15])"
        ),
        {"14-status:with a sign"},
        "all doubled",
    ),
    Wrong("damage not refused", status(bad="False"), {"14-status:damage refused"}, "none refused"),
    Wrong("sum must be 256", status(bad="sum(data) != 256"), {"14-status"}, "all refused"),
    Wrong("without the checksum", status(bad="sum(data[:-1]) % 256"), {"14-status"}, "all refused"),
    Wrong("four numbers", status(result="data[2], 1, 2, 3"), {"14-status"}, None, "malformed"),
    Wrong("jumps left in", unwrap(ADDED.format("steps")), SHORT, "jumps left in"),
    Wrong(
        "whole way wrapped",
        unwrap("(values - values[0] + 128) % 256 - 128"),
        SHORT,
        "modulo at the wrong place",
    ),
    Wrong(
        "sum wrapped", unwrap(ADDED.format("steps") + " % 256"), SHORT, "modulo at the wrong place"
    ),
    Wrong("always forwards", unwrap(ADDED.format("steps % 256")), SHORT, "only forwards"),
    Wrong(
        "overflow ahead only",
        unwrap(ADDED.format("steps"), "steps[steps < -128] += 256"),
        SHORT,
        "one side only",
    ),
    Wrong(
        "overflow back only",
        unwrap(ADDED.format("steps"), "steps[steps > 128] -= 256"),
        SHORT,
        "one side only",
    ),
    Wrong(
        "mended the wrong way",
        unwrap(
            ADDED.format("steps"), "steps = steps + 256 * np.sign(steps) * (np.abs(steps) > 128)"
        ),
        SHORT,
        "mended the wrong way",
    ),
    Wrong(
        "255 values",
        unwrap(
            ADDED.format("steps"), "steps = steps - 255 * np.sign(steps) * (np.abs(steps) > 128)"
        ),
        RING,
        "255 for 256",
    ),
    Wrong(
        "as an angle",
        unwrap("np.unwrap(values) - values[0]"),
        {"14-unwrap:same ring"},
        "as an angle",
    ),
    Wrong(
        "begins at the byte",
        unwrap("np.unwrap(values, period=256)"),
        {"14-unwrap:start"},
        "first value kept",
    ),
    Wrong(
        "earlier less later",
        unwrap(ADDED.format("(-steps + 128) % 256 - 128")),
        RING,
        "backwards",
    ),
    Wrong(
        "size of the steps",
        unwrap(ADDED.format("np.abs((steps + 128) % 256 - 128)")),
        RING,
        "size of the steps",
    ),
    Wrong(
        "steps, not their sum",
        unwrap("np.concatenate([[0], (steps + 128) % 256 - 128])"),
        RING | SHORT,
        "steps not added up",
    ),
    Wrong("first reading missing", unwrap("np.cumsum(steps)"), {"14-unwrap"}, None, "malformed"),
]

RIGHT = [
    Right(
        "nodes with struct",
        """
import struct

def nodes(data):
    rows = []
    for flags, angle, distance in struct.iter_unpack("<BHH", data):
        if (flags ^ flags >> 1) & 1 and angle & 1:
            rows.append((flags & 1, flags >> 2, (angle - 1) / 128, distance / 4))
    return rows
""",
    ),
    Right(
        "nodes as arrays",
        """
def nodes(data):
    raw = np.frombuffer(data, np.uint8).reshape(-1, 5).astype(int)
    word, distance = raw[:, 1] + 256 * raw[:, 2], raw[:, 3] + 256 * raw[:, 4]
    table = np.column_stack([raw[:, 0] % 2, raw[:, 0] // 4, word // 2 / 64, distance / 4])
    return table[(raw[:, 0] % 4 != 0) & (raw[:, 0] % 4 != 3) & (word % 2 == 1)]
""",
    ),
    Right(
        "points with complex numbers",
        """
def points(degrees, millimetres, front):
    z = 1e-3 * millimetres * np.exp(1j * np.pi / 180 * (front - degrees))
    return np.array([(p.real, p.imag) for p, mm in zip(z, millimetres) if mm != 0])
""",
    ),
    Right(
        "points by a turned and mirrored frame",
        """
def points(degrees, millimetres, front):
    a, f = np.radians(degrees), np.radians(front)
    x, y = millimetres * np.cos(a) / 1000, -millimetres * np.sin(a) / 1000
    turned = np.array([np.cos(f) * x - np.sin(f) * y, np.sin(f) * x + np.cos(f) * y]).T
    return turned[millimetres > 0]
""",
    ),
    Right("small letters", command(text="#01{T:02x}{R:02x}{C:02x}/")),
    Right("bytes", command(text="#01{T:02X}{R:02X}{C:02X}/").replace('/"', '/".encode()')),
    Right(
        "by int.to_bytes",
        """
def command(speed, turn):
    head = b"\\x01"
    for number in np.clip([speed, turn], -100, 100).tolist():
        head += number.to_bytes(1, "big", signed=True)
    return "#" + (head + bytes([-sum(head) & 255])).hex().upper() + "/"
""",
    ),
    Right("the missing to 256 and a remainder", command("(256 - (1 + T + R) % 256) % 256")),
    Right(
        "status byte by byte",
        """
def status(text):
    data = np.array([int(text[k : k + 2], 16) for k in range(1, 35, 2)], dtype=np.uint8)
    if data.sum(dtype=int) % 256 != 0:
        return None
    signed = data.view(np.int8)
    return np.array([data[2], signed[7], 2.0 * data[13], signed[14], signed[15]])
""",
    ),
    Right(
        "checksum compared",
        status(bad="(256 - sum(data[:16]) % 256) % 256 != data[16]", sign="(byte ^ 128) - 128"),
    ),
    Right(
        "both overflows by hand",
        unwrap(
            ADDED.format("steps"),
            "steps = steps + 256 * (steps < -127) - 256 * (steps > 127)",
        ),
    ),
    Right("numpy's unwrap", unwrap("np.unwrap(values, period=256) - values[0]")),
    Right("as int8", unwrap(ADDED.format("np.diff(values.astype(np.int8)).astype(int)"))),
    Right(
        "a loop",
        """
def unwrap(values):
    total, totals = 0, [0]
    for a, b in zip(values, values[1:]):
        total += (b - a + 128) % 256 - 128
        totals.append(total)
    return totals
""",
    ),
]
