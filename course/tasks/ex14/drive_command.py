"""Programs of the task of eMIR's commands."""

from course.tasks import Edit, Slip, Stumble

TASK = "14-command"

WAYS = {
    "small letters": """
def command(speed, turn):
    T, R = (max(-100, min(100, each)) % 256 for each in (speed, turn))
    C = -(1 + T + R) % 256
    return f"#01{T:02x}{R:02x}{C:02x}/"
""",
    "bytes": """
def command(speed, turn):
    T, R = (int(np.clip(each, -100, 100)) & 0xFF for each in (speed, turn))
    C = (256 - (1 + T + R) % 256) % 256
    return (b"#%02X%02X%02X%02X/" % (1, T, R, C)).decode()
""",
    "int.to_bytes": """
def command(speed, turn):
    head = b"\\x01"
    for number in np.clip([speed, turn], -100, 100).tolist():
        head += number.to_bytes(1, "big", signed=True)
    return "#" + (head + bytes([-sum(head) & 255])).hex().upper() + "/"
""",
    "struct": """
import struct

def command(speed, turn):
    limited = [min(max(each, -100), 100) for each in (speed, turn)]
    data = struct.pack("bbb", 1, *limited)
    return "#{}{:02X}/".format(data.hex(), (~sum(data) + 1) & 0xFF)
""",
    "by hand": """
def command(speed, turn):
    numbers = [1]
    for number in (speed, turn):
        if number > 100:
            number = 100
        elif number < -100:
            number = -100
        if number < 0:
            number = number + 256
        numbers.append(number)
    missing = 0
    while (sum(numbers) + missing) % 256 != 0:
        missing += 1
    digits = "0123456789ABCDEF"
    text = "".join(digits[n // 16] + digits[n % 16] for n in numbers + [missing])
    return "#" + text + "/"
""",
}

DATA = "[1] + [max(-100, min(100, each)) % 256 for each in (speed, turn)]"
CUT = "max(-100, min(100, each))"
CHECK = "-sum(data) % 256"
BYTE = '{byte:02X}"'

SLIPS = (
    Slip(
        "as printed",
        "256 − 1 − speed − turn is the thesis' rule: below zero when the bytes add to more than 255, and "
        "then '-1' stands in the frame. A byte is what is left of it modulo 256.",
        (CHECK, "256 - sum(data)"),
    ),
    Slip(
        "256 left",
        "256 less the remainder is 256 where the sum is a multiple of 256, and that takes three "
        "digits. What has to be added to a sum that is at 0 already?",
        (CHECK, "256 - sum(data) % 256"),
    ),
    Slip(
        "of signed numbers",
        "The checksum is computed from negative numbers: it passes 255 and takes three digits. "
        "What is left of it modulo 256?",
        (CHECK, "255 - sum(x - 256 if x > 127 else x for x in data[1:])"),
    ),
    Slip(
        "xor",
        "This is the lidar's rule, XOR. eMIR's bytes are added.",
        (CHECK, "data[0] ^ data[1] ^ data[2]"),
    ),
    Slip(
        "one's complement",
        "Your sum is one short of 256: 255 less the sum is the complement, which makes 255.",
        (CHECK, "255 - sum(data) % 256"),
        (CHECK, "~sum(data) % 256"),
    ),
    Slip(
        "opcode left out",
        "The opcode, 01, is one of the bytes that are added up.",
        (CHECK, "-sum(data[1:]) % 256"),
    ),
    Slip(
        "sum for checksum",
        "You send the sum itself. The checksum is what is missing to 0.",
        (CHECK, "sum(data) % 256"),
    ),
    Slip(
        "modulo 255",
        "A byte has 256 values: the remainder is that by 256, not by 255.",
        (CHECK, "-sum(data) % 255"),
        (CHECK, "255 - sum(data) % 255"),
    ),
    Slip(
        "checksum of seven bits",
        "Your checksum never passes 127: a byte has eight bits, not seven.",
        (CHECK, "-sum(data) & 127"),
    ),
    Slip(
        "checksum of what was asked",
        "The checksum is that of the numbers before they were cut off. It belongs to the bytes that "
        "are sent.",
        (CHECK, "-(1 + speed + turn) % 256"),
        before=("sums of characters",),
    ),
    Slip(
        "sums of characters",
        "You add up the characters' codes. The bytes are what pairs of digits stand for.",
        (CHECK, "-sum(''.join(f'{byte:02X}' for byte in data).encode()) % 256"),
    ),
    Slip(
        "not cut off",
        "Speeds beyond ±100 are not cut off: 200 % would arrive as another number.",
        (CUT, "each"),
    ),
    Slip(
        "cut off at a byte",
        "You cut off where a signed byte ends. The robot's speeds end earlier, at ±100 %.",
        (CUT, "max(-128, min(127, each))"),
        (CUT, "max(-127, min(127, each))"),
    ),
    Slip(
        "cut off ahead only",
        "Only numbers above 100 are cut off, those below −100 are not.",
        (CUT, "min(100, each)"),
    ),
    Slip(
        "cut off back only",
        "Only numbers below −100 are cut off, those above 100 are not.",
        (CUT, "max(-100, each)"),
    ),
    Slip(
        "cut off too late",
        "You make a byte of a number first and cut that off then: −50 is 206 by now, and beyond "
        "100.",
        (f"{CUT} % 256", "max(-100, min(100, each % 256))"),
    ),
    Slip(
        "speed cut off only",
        "The turn is not cut off at ±100, the speed is.",
        (DATA, "[1, max(-100, min(100, speed)) % 256, turn % 256]"),
    ),
    Slip(
        "turn cut off only",
        "The speed is not cut off at ±100, the turn is.",
        (DATA, "[1, speed % 256, max(-100, min(100, turn)) % 256]"),
    ),
    Slip(
        "never back",
        "Numbers below 0 come out as 0: the robot can drive back and turn to the right as well.",
        (CUT, "max(0, min(100, each))"),
    ),
    Slip(
        "swapped",
        "Speed and turn have changed places: the speed comes first.",
        ("(speed, turn)]", "(turn, speed)]"),
    ),
    Slip(
        "sign lost",
        "Negative speeds come out as positive ones: a byte holds −50 as 256 − 50.",
        (CUT, "min(100, abs(each))"),
    ),
    Slip(
        "sign turned",
        "Ahead comes out as back: 50 is the byte 50, and −50 is 256 − 50.",
        (CUT, "-max(-100, min(100, each))"),
    ),
    Slip(
        "sign bit",
        "A negative number is not its size with the top bit set: −50 is 256 − 50 (two's "
        "complement).",
        (f"{CUT} % 256", f"(lambda n: 128 - n if n < 0 else n)({CUT})"),
    ),
    Slip(
        "255 added",
        "Your negative numbers are one too small: a byte has 256 values, so −1 is 255.",
        (f"{CUT} % 256", f"(lambda n: n + 255 if n < 0 else n)({CUT})"),
    ),
    Slip(
        "128 added",
        "You have shifted all numbers so that none is negative. In two's complement 50 stays 50, "
        "and −50 is 256 − 50.",
        (f"{CUT} % 256", f"{CUT} + 128"),
    ),
    Slip(
        "minus sign sent",
        "A minus stands among your digits: a byte is 0 to 255, and −50 goes as 256 − 50.",
        (f"{CUT} % 256", CUT),
        [(f"{CUT} % 256", CUT), (CHECK, "255 - sum(data[1:])")],
    ),
    Slip(
        "decimal",
        "The digits are decimal; eMIR reads hexadecimal ones. Which format writes these?",
        (BYTE, '{byte:02d}"'),
        (BYTE, '{byte}"'),
    ),
    Slip(
        "digits missing",
        "A byte below 16 takes two digits, too, with a zero ahead.",
        (BYTE, '{byte:X}"'),
        (BYTE, '{byte:x}"'),
        Edit("small letters", (("{T:02x}{R:02x}{C:02x}", "{T:x}{R:x}{C:x}"),)),
        Edit("small letters", (("{C:02x}", "{C:x}"),)),
    ),
    Slip(
        "padded by blanks",
        "Blanks stand among your digits: a byte below 16 takes a zero ahead.",
        (BYTE, '{byte:2X}"'),
    ),
    Slip(
        "0x left in",
        "hex() writes 0x before the digits, which the frame has no place for.",
        ('f"{byte:02X}"', "hex(byte)"),
    ),
    Slip(
        "no end",
        "The frame has no end: without its / the robot waits for more.",
        (' + "/"', ""),
    ),
    Slip(
        "no begin",
        "The frame has no begin: commands begin with #.",
        ('"#" + ', ""),
    ),
    Slip(
        "status mark",
        "Your frame begins with a star, as what the robot says does. Commands begin with #.",
        ('"#"', '"*"'),
    ),
    Slip(
        "opcode of a stop",
        "The opcode is not that of driving, which is 01.",
        ("= [1] +", "= [0] +"),
        ("= [1] +", "= [2] +"),
    ),
    Slip(
        "checksum forgotten",
        "The checksum is missing: a frame has four bytes, that is eight digits.",
        ("[*data, -sum(data) % 256]", "data"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        """
def command(speed, turn):
    return [1, speed, turn]
""",
        """
def command(speed, turn):
    speed, turn = max(-100, min(100, speed)), max(-100, min(100, turn))
""",
        """
def command(speed, turn):
    T, R = (int(np.clip(each, -100, 100)) & 0xFF for each in (speed, turn))
    return b"#%02X%02X%02X%02X/" % (1, T, R, -(1 + T + R) & 0xFF)
""",
    ),
    Stumble("raised", (f"{CUT} % 256", f"{CUT} + '%'")),
)

EQUIVALENT = {}
