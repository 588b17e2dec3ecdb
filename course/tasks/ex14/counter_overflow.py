"""Programs of the task of a counter that overflows."""

from course.tasks import Edit, Slip, Stumble

TASK = "14-unwrap"

WAYS = {
    "both sides by hand": """
def unwrap(values):
    steps = np.diff(values)
    steps = steps + 256 * (steps < -127) - 256 * (steps > 127)
    return np.concatenate([[0], np.cumsum(steps)])
""",
    "numpy's unwrap": """
def unwrap(values):
    return np.unwrap(values, period=256) - values[0]
""",
    "as int8": """
def unwrap(values):
    steps = np.diff(values.astype(np.int8)).astype(int)
    return np.append(0, steps).cumsum()
""",
    "a loop": """
def unwrap(values):
    total, totals = 0, [0]
    for a, b in zip(values, values[1:]):
        total += (b - a + 128) % 256 - 128
        totals.append(total)
    return totals
""",
    "rounds counted": """
def unwrap(values):
    rounds, counts = 0, np.zeros(len(values))
    for k in range(1, len(values)):
        step = values[k] - values[k - 1]
        if step > 127:
            rounds -= 1
        elif step < -127:
            rounds += 1
        counts[k] = values[k] + 256 * rounds - values[0]
    return counts
""",
    "nearest": """
def unwrap(values):
    counts = np.array(values) - values[0]
    for k in range(1, len(counts)):
        counts[k] += 256 * np.round((counts[k - 1] - counts[k]) / 256)
    return counts
""",
}

STEPS = "(np.diff(values) + 128) % 256 - 128"
SUM = "np.concatenate([[0], np.cumsum(steps)])"
HAND = "256 * (steps < -127) - 256 * (steps > 127)"

SLIPS = (
    Slip(
        "jumps left in",
        "After 127 the robot seems to jump 255 counts back: this is the bytes' plain difference. "
        "Each step is known modulo 256 only; take the shorter way round.",
        (STEPS, "np.diff(values)"),
    ),
    Slip(
        "modulo at the wrong place",
        "Your way never leaves a byte's range: it is the steps that are to be wrapped, before they "
        "are added up, and the sum needs more bits than a byte has.",
        (SUM, "(values - values[0] + 128) % 256 - 128"),
        (SUM, "(values - values[0]) % 256"),
        (SUM, f"{SUM} % 256"),
        (SUM, f"({SUM} + 128) % 256 - 128"),
        Edit(
            "as int8",
            ((".astype(int)", ""), (".cumsum()", ".astype(np.int8).cumsum(dtype=np.int8)")),
        ),
    ),
    Slip(
        "only forwards",
        "Every step came out forwards: % 256 gives 0 to 255. Shift by 128 before it and back after "
        "it, and steps back are steps back.",
        (STEPS, "np.diff(values) % 256"),
        "def unwrap(values):\n    return np.append(0, np.cumsum(np.diff(values % 256) % 256))",
    ),
    Slip(
        "only backwards",
        "Every step came out backwards: it may go either way, by fewer than 128 counts.",
        (STEPS, "np.diff(values) % 256 - 256"),
        (STEPS, "-(-np.diff(values) % 256)"),
    ),
    Slip(
        "shift not taken back",
        "Your steps are 128 too large, even for a robot that stands still: what is added before "
        "the remainder is to be taken off after it.",
        (STEPS, "(np.diff(values) + 128) % 256"),
    ),
    Slip(
        "shifted the wrong way",
        "Steps come out half a round off: what is taken off after the remainder is what was added "
        "before it.",
        (STEPS, "np.diff(values) % 256 - 128"),
        (STEPS, "(np.diff(values) + 128) % 256 + 128"),
    ),
    Slip(
        "overflow ahead only",
        "Only the overflow ahead is mended, from 127 to −128; backwards over −128 there is one, "
        "too.",
        Edit("both sides by hand", ((HAND, "256 * (steps < -127)"),)),
        Edit("both sides by hand", ((HAND, "256 * (steps < -128)"),)),
    ),
    Slip(
        "overflow back only",
        "Only the overflow back is mended, from −128 to 127; ahead over 127 there is one, too.",
        Edit("both sides by hand", ((HAND, "-256 * (steps > 127)"),)),
        Edit("both sides by hand", ((HAND, "-256 * (steps > 128)"),)),
    ),
    Slip(
        "mended the wrong way",
        "A jump down by more than 128 is an overflow ahead: a round is added to it, not taken off.",
        Edit(
            "both sides by hand", ((f"+ {HAND}", "- 256 * (steps < -127) + 256 * (steps > 127)"),)
        ),
    ),
    Slip(
        "first overflow only",
        "After the first overflow the next ones are left in. Each one adds another round.",
        Edit(
            "rounds counted",
            (("rounds -= 1", "rounds = -1"), ("rounds += 1", "rounds = 1")),
        ),
    ),
    Slip(
        "mended once, forgotten again",
        "An overflow is mended at the one reading where it happens, and the next one is a jump "
        "again: the round stays for all that follow.",
        """
def unwrap(values):
    counts = np.array(values) - values[0]
    for k in range(1, len(values)):
        if values[k] - values[k - 1] < -127:
            counts[k] += 256
        elif values[k] - values[k - 1] > 127:
            counts[k] -= 256
    return counts
""",
    ),
    Slip(
        "limit too low",
        "Long steps are taken for overflows: up to 127 counts between two readings are promised.",
        Edit("both sides by hand", ((HAND, "256 * (steps < -100) - 256 * (steps > 100)"),)),
        Edit("both sides by hand", ((HAND, "256 * (steps < -126) - 256 * (steps > 126)"),)),
        Edit("both sides by hand", ((HAND, "256 * (steps <= -127) - 256 * (steps >= 127)"),)),
        Edit("both sides by hand", ((HAND, "256 * (steps < -64) - 256 * (steps > 64)"),)),
    ),
    Slip(
        "limit too high",
        "Some overflows are not noticed: with a step of 100 counts over 127 the bytes differ by no "
        "more than 156.",
        Edit("both sides by hand", ((HAND, "256 * (steps < -200) - 256 * (steps > 200)"),)),
        Edit("both sides by hand", ((HAND, "256 * (steps < -150) - 256 * (steps > 150)"),)),
        Edit("both sides by hand", ((HAND, "256 * (steps < -129) - 256 * (steps > 129)"),)),
    ),
    Slip(
        "255 for 256",
        "A byte has 256 values: from 127 to −128 is one step.",
        Edit("both sides by hand", ((HAND, "255 * (steps < -127) - 255 * (steps > 127)"),)),
        (STEPS, "(np.diff(values) + 128) % 255 - 128"),
        (STEPS, "(np.diff(values) + 127) % 255 - 127"),
        Edit("numpy's unwrap", (("period=256", "period=255"),)),
    ),
    Slip(
        "half a round for a round",
        "Your round has 128 counts. That is half of one: from −128 to 127 there are 256 values.",
        (STEPS, "(np.diff(values) + 64) % 128 - 64"),
        Edit("both sides by hand", ((HAND, "128 * (steps < -127) - 128 * (steps > 127)"),)),
        Edit("numpy's unwrap", (("period=256", "period=128"),)),
    ),
    Slip(
        "as an angle",
        "np.unwrap takes its numbers for radians unless it is told: how long is a round here?",
        Edit("numpy's unwrap", ((", period=256", ""),)),
        "def unwrap(values):\n    return np.unwrap(values)",
        Edit("numpy's unwrap", ((", period=256", ", period=360"),)),
        "def unwrap(values):\n    return np.degrees(np.unwrap(np.radians(values))) - values[0]",
    ),
    Slip(
        "first value kept",
        "The count begins at the byte's value. Asked for is the way since the first reading.",
        Edit("numpy's unwrap", ((" - values[0]", ""),)),
        (SUM, "np.cumsum(np.concatenate([values[:1], steps]))"),
    ),
    Slip(
        "first value taken off twice",
        "The first byte is taken off twice: the sum of the steps does not hold it any more.",
        (SUM, f"{SUM} - values[0]"),
    ),
    Slip(
        "begins at 1",
        "The count begins at 1. At the first reading the robot has gone nowhere yet.",
        ("[[0], np", "[[1], np"),
    ),
    Slip(
        "backwards",
        "Ahead comes out as back: a step is the later reading minus the earlier one.",
        (STEPS, "(-np.diff(values) + 128) % 256 - 128"),
        (SUM, f"-{SUM}"),
    ),
    Slip(
        "size of the steps",
        "Way back is added to the way ahead: steps keep their sign.",
        (STEPS, "np.abs((np.diff(values) + 128) % 256 - 128)"),
        (SUM, f"np.abs({SUM})"),
    ),
    Slip(
        "never back",
        "A step back counts as none. How far it is from where it was may grow smaller again.",
        (STEPS, "np.maximum((np.diff(values) + 128) % 256 - 128, 0)"),
    ),
    Slip(
        "steps not added up",
        "These are the steps. The way is their sum up to each reading.",
        (SUM, "np.concatenate([[0], steps])"),
    ),
    Slip(
        "zero at the end",
        "Your counts are a reading late: the zero belongs before the sums, not behind them.",
        (SUM, "np.concatenate([np.cumsum(steps), [0]])"),
    ),
    Slip(
        "seen from the end",
        "You count from the last reading. Asked for is the way since the first one.",
        (SUM, f"{SUM} - np.sum(steps)"),
    ),
    Slip(
        "one reading late",
        "Each count is that of the reading before: is the sum taken before the step is added?",
        (SUM, "np.concatenate([[0], [0] * (len(steps) > 0), np.cumsum(steps[:-1])])"),
    ),
    Slip(
        "total in 16 bits",
        "Far away your counts overflow, too: 16 bits end at 32 767.",
        (SUM, f"{SUM}.astype(np.int16)"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (SUM, "np.cumsum(steps)"),
        (SUM, "np.sum(steps)"),
        (f"    return {SUM}", f"    counts = {SUM}"),
    ),
    Stumble("raised", (STEPS, "values[1:] - values")),
)

EQUIVALENT = {}
