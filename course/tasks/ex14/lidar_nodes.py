"""Programs of the task of a lidar's bytes."""

from course.tasks import Edit, Slip, Stumble

TASK = "14-nodes"

WAYS = {
    "struct": """
import struct

def nodes(data):
    rows = []
    for flags, angle, distance in struct.iter_unpack("<BHH", data):
        if (flags ^ flags >> 1) & 1 and angle & 1:
            rows.append((flags & 1, flags >> 2, (angle - 1) / 128, distance / 4))
    return rows
""",
    "arrays": """
def nodes(data):
    raw = np.frombuffer(data, np.uint8).reshape(-1, 5).astype(int)
    word, distance = raw[:, 1] + 256 * raw[:, 2], raw[:, 3] + 256 * raw[:, 4]
    table = np.column_stack([raw[:, 0] % 2, raw[:, 0] // 4, word // 2 / 64, distance / 4])
    return table[np.isin(raw[:, 0] % 4, [1, 2]) & (word % 2 == 1)]
""",
    "record dtype": """
def nodes(data):
    rows = np.frombuffer(data, [("flags", "u1"), ("angle", "<u2"), ("distance", "<u2")])
    start, inverse = rows["flags"] & 1, rows["flags"] >> 1 & 1
    rows = rows[(start != inverse) & (rows["angle"] & 1 == 1)]
    flags = rows["flags"].astype(float)
    angle, distance = rows["angle"].astype(float), rows["distance"].astype(float)
    return np.stack([flags % 2, flags // 4, (angle - 1) / 128, distance / 4], axis=1)
""",
    "int.from_bytes": """
def nodes(data):
    def word(two):
        return int.from_bytes(two, "little")

    packets = [data[k : k + 5] for k in range(0, len(data), 5)]
    whole = [five for five in packets if five[0] % 4 in (1, 2) and five[1] % 2]
    return [
        [five[0] % 2, five[0] // 4, word(five[1:3]) // 2 / 64, word(five[3:]) / 4]
        for five in whole
    ]
""",
    "fields of bits": """
def nodes(data):
    found, data = [], list(data)
    while data:
        five, data = data[:5], data[5:]
        bits = sum(byte << 8 * k for k, byte in enumerate(five))
        start, inverse, quality = bits & 1, bits >> 1 & 1, bits >> 2 & 63
        check, angle, distance = bits >> 8 & 1, bits >> 9 & 0x7FFF, bits >> 24
        if start + inverse == 1 and check == 1:
            found += [[start, quality, angle / 64, distance / 4]]
    return np.array(found, dtype=float).reshape(-1, 4)
""",
}

GOOD = "flags & 1 != flags >> 1 & 1 and word & 1"
ANGLE, DISTANCE = "(word >> 1) / 64", "distance / 4"
QUALITY = "flags >> 2"
ROW = "[flags & 1, flags >> 2, (word >> 1) / 64, distance / 4]"

SLIPS = (
    Slip(
        "damaged kept",
        "Damaged nodes are among your rows. A node has S different from not S, and C = 1; leave "
        "out what has not.",
        (GOOD, "True"),
    ),
    Slip(
        "c not checked",
        "Nodes with C = 0 are among your rows: the lowest bit of byte 1 has to be 1.",
        (GOOD, "flags & 1 != flags >> 1 & 1"),
    ),
    Slip(
        "s not checked",
        "Nodes whose S and not S are the same are among your rows: they have to differ.",
        (GOOD, "word & 1"),
    ),
    Slip(
        "starts only",
        "You keep the nodes with S = 1 only. S says that a turn begins; with S = 0 and not S = 1 a "
        "node is as good.",
        (GOOD, "flags & 3 == 1 and word & 1"),
        (GOOD, "flags & 1 and word & 1"),
    ),
    Slip(
        "starts left out",
        "The first node of each turn is missing: with S = 1 and not S = 0 a node is as good as "
        "with S = 0 and not S = 1.",
        (GOOD, "flags & 3 == 2 and word & 1"),
    ),
    Slip(
        "either mark",
        "Both marks have to be right. You keep a node where one of them is.",
        (GOOD, "flags & 1 != flags >> 1 & 1 or word & 1"),
    ),
    Slip(
        "damage ends it",
        "Your rows end at the first damaged node. Leave that one out and go on with the next: one "
        "bad node is no reason to throw a turn away.",
        [
            (f"        if {GOOD}:\n", f"        if not ({GOOD}):\n            break\n"),
            ("            found.append", "        found.append"),
        ],
    ),
    Slip(
        "empty left out",
        "Nodes are missing that are whole: a distance of 0 says that nothing came back, and the "
        "node is to be in a row all the same.",
        (GOOD, GOOD + " and distance"),
    ),
    Slip(
        "quality 0 left out",
        "Nodes of quality 0 are missing. They are whole; whether to trust them is for others to "
        "decide.",
        (GOOD, GOOD + " and flags >> 2"),
    ),
    Slip(
        "last one missing",
        "The last node is missing: the step ends too early. With n bytes the last node begins at "
        "n − 5.",
        ("len(data), 5", "len(data) - 5, 5"),
    ),
    Slip(
        "fixed count",
        "You read as many nodes as one packet happened to have. How many there are, the length of "
        "the data says.",
        ("range(0, len(data), 5)", "range(0, min(len(data), 80), 5)"),
    ),
    Slip(
        "all big endian",
        "High and low byte have changed places in both words. Little endian: the first byte is the "
        "low one.",
        ("a | b << 8, c | d << 8", "a << 8 | b, c << 8 | d"),
        [
            ("a | b << 8, c | d << 8", "a << 8 | b, c << 8 | d"),
            (GOOD, "flags & 1 != flags >> 1 & 1 and a & 1"),
        ],
        Edit("struct", (('"<BHH"', '">BHH"'),)),
    ),
    Slip(
        "angle big endian",
        "High and low byte of the angle have changed places. Little endian: the first byte is the "
        "low one.",
        ("= a | b << 8", "= a << 8 | b"),
        [
            ("= a | b << 8", "= a << 8 | b"),
            (GOOD, "flags & 1 != flags >> 1 & 1 and a & 1"),
        ],
    ),
    Slip(
        "distance big endian",
        "High and low byte of the distance have changed places. Little endian: the first byte is "
        "the low one.",
        ("c | d << 8", "c << 8 | d"),
    ),
    Slip(
        "shift forgotten",
        "Your angles are twice as large: bit 0 of the word is C, the angle begins at bit 1. Shift "
        "it down by one.",
        (ANGLE, "word / 64"),
        (ANGLE, "(word & ~1) / 64"),
    ),
    Slip(
        "c in the angle",
        "Your angles are 1/128 degree too large: C is still in the word when you divide it. Shift "
        "it out first.",
        (ANGLE, "word / 128"),
    ),
    Slip(
        "angle not divided",
        "Your angles are counted in 64ths of a degree. How many degrees is one count?",
        (ANGLE, "(word >> 1)"),
    ),
    Slip(
        "whole degrees",
        "Your angles are cut off to whole degrees: // throws away what / keeps.",
        (ANGLE, "(word >> 1) // 64"),
        (ANGLE, "(word >> 7)"),
        (ANGLE, "int((word >> 1) / 64)"),
    ),
    Slip(
        "radians",
        "Your angles are in radians; asked for are degrees, as the device counts.",
        (ANGLE, "np.radians((word >> 1) / 64)"),
    ),
    Slip(
        "counter-clockwise",
        "You have turned the angle's direction. Here it is asked for as the device counts it; "
        "what it means comes later.",
        (ANGLE, "-(word >> 1) / 64"),
        (ANGLE, "360 - (word >> 1) / 64"),
    ),
    Slip(
        "one byte of the angle",
        "Your angles never grow beyond a few degrees: only the low one of their two bytes is read.",
        ("= a | b << 8", "= a"),
        (ANGLE, "(a >> 1) / 64"),
    ),
    Slip(
        "distance not divided",
        "Your distances are four times too large: the device counts quarters of a millimetre.",
        (DISTANCE, "distance"),
    ),
    Slip(
        "whole millimetres",
        "Your distances are cut off to whole millimetres: / 4 keeps the quarters, // 4 and >> 2 do "
        "not.",
        (DISTANCE, "distance >> 2"),
        (DISTANCE, "int(distance / 4)"),
    ),
    Slip(
        "distance with a sign",
        "Far distances come out negative: the word has no sign, all 16 bits count upwards.",
        (DISTANCE, "(distance - (distance >> 15 << 16)) / 4"),
        Edit("struct", (('"<BHH"', '"<BHh"'),)),
    ),
    Slip(
        "angle with a sign",
        "Angles beyond half of the word's range come out negative: the word has no sign, all its "
        "bits count upwards.",
        Edit("struct", (('"<BHH"', '"<BhH"'),)),
    ),
    Slip(
        "metres",
        "Your distances are in metres; asked for are millimetres, as the device counts.",
        (DISTANCE, "distance / 4000"),
    ),
    Slip(
        "one byte of the distance",
        "Your distances never reach 64 mm: only the low one of their two bytes is read.",
        (", c | d << 8", ", c"),
    ),
    Slip(
        "quality not shifted",
        "Your quality is four times too large: S and not S stand in the low bits of byte 0. Shift "
        "them out.",
        (QUALITY, "flags"),
        (QUALITY, "flags & 0xFC"),
    ),
    Slip(
        "quality shifted by one",
        "Not S is still in your quality: two bits stand below it, not one.",
        (ROW, ROW.replace("flags >> 2", "flags >> 1")),
    ),
    Slip(
        "a bit of quality lost",
        "A bit of your quality is lost: it begins at bit 2, so two bits are to be shifted out.",
        (ROW, ROW.replace("flags >> 2", "flags >> 3")),
        (ROW, ROW.replace("flags >> 2", "flags >> 2 & 31")),
    ),
    Slip(
        "not s for s",
        "You took bit 1, not S, for S: it is bit 0.",
        (ROW, ROW.replace("flags & 1", "flags >> 1 & 1")),
    ),
    Slip(
        "both marks for s",
        "Your S is 1 or 2: not S is still in it. S is bit 0 alone.",
        (ROW, ROW.replace("flags & 1", "flags & 3")),
    ),
    Slip(
        "distance before angle",
        "Angle and distance have changed places: the angle's column stands before the distance's.",
        (ROW, "[flags & 1, flags >> 2, distance / 4, (word >> 1) / 64]"),
    ),
    Slip(
        "quality before s",
        "S and quality have changed places: the column of S is the first one.",
        (ROW, "[flags >> 2, flags & 1, (word >> 1) / 64, distance / 4]"),
    ),
    Slip(
        "sorted",
        "Your rows are sorted. They are asked for in the order of the bytes: by it one knows where "
        "a turn begins.",
        ("np.array(found)", "np.array(sorted(found, key=lambda row: row[2])).reshape(-1, 4)"),
    ),
    Slip(
        "only one node",
        "Only one node comes back. Does the loop end too early, or is a row written over at each "
        "step?",
        ("np.array(found)", "np.array(found[:1])"),
        ("np.array(found)", "np.array(found[-1:])"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        ("np.array(found)", "np.array(found).T"),
        ("np.array(found)", "np.array(found[0])"),
        ("    return np.array(found)", "    np.array(found)"),
        (ROW, "[flags & 1, (word >> 1) / 64, distance / 4]"),
    ),
    Stumble("raised", ("range(0, len(data), 5)", "range(0, len(data))")),
)
