"""Programs of the task of a lidar that the lesson has not seen."""

from course.tasks import Slip, Stumble
from course.tasks.ex14.sweep_ways import PASTED, WAYS  # noqa: F401  part of the programs

TASK = "14-sweep"

BAD = "data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]"
SUM = "sum(data[:-1]) % 256 != data[-1]"
STEP = "(last - first) % 36000 / max(n - 1, 1)"
ANGLE, RANGE = "-np.radians((first + k * step) / 100)", "(low | high << 8) / 1000"
ENDS = "data[2] | data[3] << 8, data[-3] | data[-2] << 8"
POINT = "low, high, _ = data[4 + 3 * k : 7 + 3 * k]"

SLIPS = (
    Slip(
        "nothing checked",
        "Damaged packets come through. Look at the first byte, the length and the sum before you "
        "read anything else.",
        (BAD, "False"),
    ),
    Slip(
        "sum not checked",
        "Packets with a wrong sum come through.",
        (f" or {SUM}", ""),
    ),
    Slip(
        "first byte not checked",
        "Packets that begin with another byte than 0x54 come through.",
        ("data[0] != 0x54 or ", ""),
    ),
    Slip(
        "length not checked",
        "Packets come through that are longer or shorter than their number of points asks for.",
        ("len(data) != 3 * n + 7 or ", ""),
    ),
    Slip(
        "too long not noticed",
        "A packet that is longer than its number of points asks for comes through.",
        ("len(data) != 3 * n + 7", "len(data) < 3 * n + 7"),
    ),
    Slip(
        "too short not noticed",
        "A packet that is shorter than its number of points asks for comes through.",
        [
            ("len(data) != 3 * n + 7", "len(data) > 3 * n + 7"),
            (POINT, f"{POINT} if len(data) > 6 + 3 * k else (0, 0, 0)"),
        ],
    ),
    Slip(
        "emir's rule",
        "This is eMIR's rule, by which all bytes add up to 0. Here the last byte *is* the sum of "
        "all before it.",
        (SUM, "sum(data) % 256"),
    ),
    Slip(
        "xor",
        "This is the lesson's lidar, which takes XOR. Here the bytes are added.",
        (SUM, "np.bitwise_xor.reduce(list(data[:-1])) != data[-1]"),
    ),
    Slip(
        "modulo forgotten",
        "Whole packets are refused: the sum of all bytes does not fit into one. Only its remainder "
        "is sent.",
        (SUM, "sum(data[:-1]) != data[-1]"),
    ),
    Slip(
        "first byte not added",
        "Whole packets are refused: byte 0 is one of those that are added up.",
        (SUM, "sum(data[1:-1]) % 256 != data[-1]"),
    ),
    Slip(
        "sum of the points",
        "Whole packets are refused: the sum is that of all bytes, not of the points alone.",
        (SUM, "sum(data[4:-3]) % 256 != data[-1]"),
    ),
    Slip(
        "empty for none",
        "For a damaged packet an empty list comes back, which says that the lidar saw nothing. "
        "None says that nobody knows.",
        ("        return None", "        return []"),
    ),
    Slip(
        "none for empty",
        "For a whole packet of which nothing came back you give None, as if it were damaged.",
        ("return found", "return found or None"),
    ),
    Slip(
        "empty kept",
        "Points that did not come back are among your rays: a distance of 0 says so.",
        ("if low or high", "if True"),
    ),
    Slip(
        "low byte 0 left out",
        "Points are missing whose distance is a multiple of 256 mm: it is 0 only where both of its "
        "bytes are.",
        ("if low or high", "if low"),
        ("if low or high", "if low and high"),
    ),
    Slip(
        "near ones left out",
        "Points nearer than 256 mm are missing: a distance is 0 only where both of its bytes are.",
        ("if low or high", "if high"),
    ),
    Slip(
        "weak ones left out",
        "Points are left out, or kept, by their strength. Whether one came back its distance says.",
        [("low, high, _ =", "low, high, strength ="), ("if low or high", "if strength")],
        [
            ("low, high, _ =", "low, high, strength ="),
            ("if low or high", "if strength and (low or high)"),
        ],
    ),
    Slip(
        "gaps forgotten",
        "Angles behind a gap are too small: a point that did not come back took its turn, and the "
        "next one lies a gap further.",
        ("first + k * step", "first + len(found) * step"),
        """
def sweep(data):
    n = data[1]
    if data[0] != 0x54 or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return None
    first, last = data[2] | data[3] << 8, data[-3] | data[-2] << 8
    points = np.reshape(list(data[4:-3]), (n, 3))
    metres = (points[:, 0] + 256 * points[:, 1]) / 1000
    metres = metres[metres > 0]
    alpha = np.linspace(first, first + (last - first) % 36000, len(metres))
    return np.column_stack([-np.radians(alpha / 100), metres])
""",
    ),
    Slip(
        "as a capsule",
        "Your last point stops short of the last angle: of n points there are n − 1 gaps, and the "
        "second angle is that of the last point, not of the next packet.",
        (STEP, "(last - first) % 36000 / n"),
    ),
    Slip(
        "counted from 1",
        "Your first point does not lie at the first angle: it is the one with k = 0.",
        ("first + k * step", "first + (k + 1) * step"),
    ),
    Slip(
        "one gap too few",
        "Your angles run too far: between n points there are n − 1 gaps.",
        (STEP, "(last - first) % 36000 / max(n - 2, 1)"),
    ),
    Slip(
        "0° not passed",
        "Where a packet passes 0° your points are spread over the rest of the turn, backwards: "
        "how far the lidar turned is known modulo a full turn.",
        (STEP, "(last - first) / max(n - 1, 1)"),
    ),
    Slip(
        "size of the difference",
        "Where a packet passes 0° the last angle is smaller than the first. Its difference has to "
        "be taken modulo a full turn, not by its size.",
        (STEP, "abs(last - first) / max(n - 1, 1)"),
    ),
    Slip(
        "shorter way",
        "You take the shorter way round, as for a counter that may go both ways. A lidar turns one "
        "way only, perhaps by more than half a turn.",
        (STEP, "((last - first + 18000) % 36000 - 18000) / max(n - 1, 1)"),
    ),
    Slip(
        "360 for 36000",
        "Your remainder is that by 360, but the angles are counted in hundredths of a degree.",
        (STEP, "(last - first) % 360 / max(n - 1, 1)"),
    ),
    Slip(
        "same angle for all",
        "All points of a packet have the first one's angle. The lidar turned on while it measured.",
        ("first + k * step", "first"),
    ),
    Slip(
        "last angle for the first",
        "Your points run backwards: the first one lies at the first angle, and the others behind it.",
        ("first, last =", "last, first ="),
        ("first + k * step", "last + k * step"),
    ),
    Slip(
        "clockwise",
        "Your rays are mirrored: the lidar counts its angle clockwise, and rays are asked for "
        "counter-clockwise.",
        (ANGLE, "np.radians((first + k * step) / 100)"),
    ),
    Slip(
        "front along +y",
        "Your rays are a quarter turn off: the robot's front is at angle 0, not at 90°.",
        (ANGLE, "np.pi / 2 - np.radians((first + k * step) / 100)"),
    ),
    Slip(
        "degrees",
        "Your angles are in degrees; rays have radians.",
        (ANGLE, "-((first + k * step) / 100)"),
    ),
    Slip(
        "hundredths forgotten",
        "Your angles are a hundred times too large: they are counted in hundredths of a degree.",
        (ANGLE, "-np.radians(first + k * step)"),
    ),
    Slip(
        "64ths",
        "This lidar counts in hundredths of a degree, not in 64ths as the lesson's.",
        (ANGLE, "-np.radians((first + k * step) / 64)"),
    ),
    Slip(
        "angles big endian",
        "High and low byte of the angles have changed places.",
        (ENDS, "data[3] | data[2] << 8, data[-2] | data[-3] << 8"),
    ),
    Slip(
        "ranges big endian",
        "High and low byte of the distances have changed places.",
        (RANGE, "(high | low << 8) / 1000"),
    ),
    Slip(
        "all big endian",
        "High and low byte have changed places, in the angles and in the distances.",
        [
            (ENDS, "data[3] | data[2] << 8, data[-2] | data[-3] << 8"),
            (RANGE, "(high | low << 8) / 1000"),
        ],
    ),
    Slip(
        "last angle misplaced",
        "The last angle is not where you look for it: the last byte of all is the sum.",
        (ENDS, "data[2] | data[3] << 8, data[-2] | data[-1] << 8"),
        (ENDS, "data[2] | data[3] << 8, data[-4] | data[-3] << 8"),
    ),
    Slip(
        "one byte of the angles",
        "Only the low one of an angle's two bytes is read.",
        (ENDS, "data[2], data[-3]"),
    ),
    Slip(
        "one byte of the distance",
        "Only the low one of a distance's two bytes is read.",
        (RANGE, "low / 1000"),
    ),
    Slip(
        "strength in the distance",
        "Your ranges are far too large: a distance has two bytes, the third one is the strength.",
        [("low, high, _ =", "low, high, more ="), (RANGE, "(low | high << 8 | more << 16) / 1000")],
    ),
    Slip(
        "strength for distance",
        "You read the strength's byte into the distance: it stands behind the two of the distance.",
        ("low, high, _ =", "_, low, high ="),
    ),
    Slip(
        "points misplaced",
        "Your points begin at the wrong byte: they stand behind the first angle.",
        (POINT, "low, high, _ = data[3 + 3 * k : 6 + 3 * k]"),
    ),
    Slip(
        "distance with a sign",
        "Far ranges come out negative: words have no sign here.",
        (RANGE, "((low | high << 8) - (high >> 7 << 16)) / 1000"),
    ),
    Slip(
        "angles with a sign",
        "Angles beyond 327.67° come out negative, and what was turned between is wrong: words have "
        "no sign here.",
        (
            f"    first, last = {ENDS}\n    step = {STEP}",
            f"    first, last = ((w ^ 32768) - 32768 for w in ({ENDS}))\n"
            "    step = (last - first) % 36000 / max(n - 1, 1)",
        ),
    ),
    Slip(
        "millimetres",
        "Your ranges are in millimetres; rays have metres.",
        (RANGE, "(low | high << 8)"),
    ),
    Slip(
        "quarters",
        "This lidar counts whole millimetres, not quarters as the lesson's.",
        (RANGE, "(low | high << 8) / 4000"),
    ),
    Slip(
        "columns swapped",
        "Angle and range have changed places: the angle is the first column.",
        (f"[{ANGLE}, {RANGE}]", f"[{RANGE}, {ANGLE}]"),
    ),
    Slip(
        "one point missing",
        "A point is missing in each packet: n points are counted from 0 to n − 1.",
        ("range(n)", "range(n - 1)"),
        ("range(n)", "range(1, n)"),
    ),
)

STUMBLES = (
    Stumble("malformed", ("return found", "return np.transpose(found)")),
    Stumble("raised", ("max(n - 1, 1)", "(n - n)")),
)
