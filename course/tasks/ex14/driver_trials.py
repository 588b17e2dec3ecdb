"""Programs of the open task: trials for drivers that others wrote."""

from course.tasks import Slip, Stumble

TASK = "14-trials"

WAYS = {
    "zigzag": """
def trials():
    def wrapped(counts):
        return [(c + 128) % 256 - 128 for c in counts]

    zigzag, far, near = [0], [0], [0]
    for k in range(128):
        zigzag.append(zigzag[-1] + k * (-1) ** k)
    for k in range(127, 0, -1):
        zigzag.append(zigzag[-1] - k * (-1) ** k)
    for k in range(260):
        far.append(far[-1] + 127)
        near.append(near[-1] - 127)
    ways = [zigzag, [0], [], far, near]
    return [([(b + 9 + 128) % 256 - 128 for b in wrapped(way)], way) for way in ways]
""",
    "at random, and the edges": """
def trials():
    rng = np.random.default_rng(1)
    steps = np.concatenate([rng.permutation(np.arange(-127, 128)), rng.integers(-127, 128, 150)])
    ways = [(3, [127, 127, 127, -127, -127, -127, 0, 0]), (-4, steps)]
    ways += [(90, [127] * 262), (-90, [-127] * 262), (11, [])]
    found = [(np.array([], dtype=np.int8), np.array([]))]
    for begin, each in ways:
        counts = np.append(0, np.cumsum(np.array(each, dtype=int)))
        found.append((((begin + counts + 128) % 256 - 128).astype(np.int8), counts))
    return found
""",
    "by the counter's own unwrap": """
def trials():
    values = [np.array([5]), (7 + 127 * np.arange(262) + 128) % 256 - 128]
    values += [(7 - 127 * np.arange(262) + 128) % 256 - 128]
    steps = np.arange(-127, 128)
    mixed = np.where(np.arange(255) % 2, steps, -steps)
    values += [(1 + np.cumsum(mixed) + 128) % 256 - 128, np.array([-128, -128, -1, -1])]
    return [((), ())] + [(v, unwrap(v)) for v in values]
""",
    "all bytes slowly": """
def trials():
    count = np.arange(257)
    up = [k for n in range(1, 128) for k in (n, -n)]
    ways = [(1, []), (-128, [1, 1, 0] + [s for n in range(128) for s in (127 - n, -n)])]
    ways += [(2, [127] * 260), (2, [-127] * 260)]
    pairs = [way(*each) for each in ways]
    return (([], []), *pairs)
""",
}

SLIPS = (
    Slip(
        "first byte in the counts",
        "Your counts begin at the first byte: a right driver counts from 0, whatever the byte is.",
        ("way(5, [0, *every])", "(lambda v, c: (v, c + 5))(*way(5, [0, *every]))"),
    ),
    Slip(
        "steps for counts",
        "You expect the steps. A right driver returns their sums, the way since the first reading.",
        (
            "way(3, [127] * 270)",
            "(lambda v, c: (v, np.append(0, np.diff(c))))(*way(3, [127] * 270))",
        ),
    ),
    Slip(
        "values not wrapped",
        "You hand over counts that no byte can hold: wrap them into −128 to 127 for the driver.",
        ("way(3, [127] * 270)", "(lambda v, c: (c, c))(*way(3, [127] * 270))"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        ("way(3, [127] * 270)", "(np.zeros(5), np.zeros(4))"),
        ("way(3, [127] * 270)", "np.zeros(5)"),
        "def trials():\n    pass",
        "def trials():\n    return 5",
    ),
    Stumble("raised", ("way(7, [])", "way(7)")),
)

PASTED = {
    "the lesson's drive ahead": """
def trials():
    values = (2 * np.arange(161) + 128) % 256 - 128
    return [(values, unwrap(values))]
""",
    "the corridor, ahead and back": """
def trials():
    steps = [4, 4, 4, 4, 5] * 20 + [-2, -2, -2, -1] * 25
    return [way(0, steps)]
""",
    "the two ways of the notebook": """
def trials():
    return [way(0, [50] * 6), way(0, [-50] * 6)]
""",
    "the answer to another task": """
def trials():
    values = np.array([0, 100, -56, 44, -112, -56, 20])
    return [(values, unwrap(values))]
""",
}

# to find 97 of 100 is to be right, whichever ways are taken: what survives has found them
EQUIVALENT = {"": "other ways, which find as many drivers"}
