"""Solutions of exercise 12 that are wrong in a classic way, and right ones that look different."""

from tests.bank import Right, Wrong

ODOMETRY = """
def odometry(left, right, tick, base):
    l, r = {ways}
    d, turn = {d}, {turn}
    chord = {chord}
    return np.array({motion})
"""


def odometry(**changes):
    parts = {
        "ways": "left * tick, right * tick",
        "d": "(l + r) / 2",
        "turn": "(r - l) / base",
        "chord": "d * np.sinc(turn / 2 / np.pi)",
        "motion": "[chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn]",
    }
    return ODOMETRY.format(**(parts | changes))


DECIDE = """
def decide(doing, reading, driven):
    if doing in {turning} and reading > {far}:
        return {left}
    if doing in {correcting}:
        return {right}
    return {drive}
"""


def decide(**changes):
    parts = {
        "turning": '("scan", "left")',
        "far": "0.25",
        "left": '"left"',
        "correcting": '("scan", "left", "right")',
        "right": '"right" if reading < 0.18 else "drive"',
        "drive": '"drive" if driven < 0.04 and reading > 0.18 else "scan"',
    }
    return DECIDE.format(**(parts | changes))


LOST = """
def lost_since(errors, limit):
    far = {far}
    {body}
"""


def lost(body, far="errors > limit"):
    return LOST.format(far=far, body=body.replace("\n", "\n    "))


INTERVAL = """
def interval(k, n):
    z, p = {z}, k / n
    middle = {middle}
    half = {half}
    return {result}
"""


def interval(**changes):
    parts = {
        "z": "1.96",
        "middle": "(p + z**2 / (2 * n)) / (1 + z**2 / n)",
        "half": "z * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2)) / (1 + z**2 / n)",
        "result": "middle - half, middle + half",
    }
    return INTERVAL.format(**(parts | changes))


WALD = {"middle": "p", "half": "z * np.sqrt(p * (1 - p) / n)"}
CLIPPED = {"result": "max(middle - half, 0), min(middle + half, 1)"}
CURVES, ALL_WAYS = {"12-odometry:curves"}, {"12-odometry"}
DRIVES = {"12-decide:driving"}

WRONG = [
    Wrong(
        "straight on, then the turn", odometry(motion="[d, 0, turn]"), CURVES, "straight-then-turn"
    ),
    Wrong(
        "the turn, then straight on",
        odometry(motion="[d * np.cos(turn), d * np.sin(turn), turn]"),
        CURVES,
        "turn-then-straight",
    ),
    Wrong("the arc for its chord", odometry(chord="d"), CURVES, "way-for-chord"),
    Wrong(
        "left and right swapped",
        odometry(ways="right * tick, left * tick"),
        {"curves", "spot"},
        "swapped",
    ),
    Wrong("sign of the turn", odometry(turn="(l - r) / base"), {"curves", "spot"}, "swapped"),
    Wrong("half the base", odometry(turn="2 * (r - l) / base"), {"curves", "spot"}, "half-base"),
    Wrong("twice the base", odometry(turn="(r - l) / base / 2"), {"curves", "spot"}, "double-base"),
    Wrong("the sum of the ways", odometry(d="l + r"), {"curves", "straight"}, "not-halved"),
    Wrong(
        "degrees",
        odometry(motion="[chord * np.cos(turn / 2), chord * np.sin(turn / 2), np.degrees(turn)]"),
        {"curves", "spot"},
        "degrees",
    ),
    Wrong("ticks for metres", odometry(ways="left, right"), ALL_WAYS, "ticks-for-metres"),
    Wrong(
        "y upside down",
        odometry(motion="[chord * np.cos(turn / 2), -chord * np.sin(turn / 2), turn]"),
        CURVES,
        "mirrored",
    ),
    Wrong(
        "0/0 on a straight way",
        odometry(chord="2 * d * np.sin(turn / 2) / (turn or 1e-300)"),
        {"straight"},
        "no-straight-way",
    ),
    Wrong(
        "0/0 is a NaN",
        odometry(chord="2 * d * np.sin(turn / 2) / np.float64(turn)"),
        ALL_WAYS,
        None,
        "malformed",
    ),
    Wrong(
        "division by zero",
        odometry(chord="2 * d * __import__('math').sin(turn / 2) / turn"),
        ALL_WAYS,
        None,
        "raised",
    ),
    Wrong(
        "no heading",
        odometry(motion="[chord * np.cos(turn / 2), chord * np.sin(turn / 2)]"),
        ALL_WAYS,
        None,
        "malformed",
    ),
    Wrong("numpy's sinc of the plain angle", odometry(chord="d * np.sinc(turn / 2)"), CURVES),
    Wrong(
        "left for right",
        decide(left='"right"', right='"left" if reading < 0.18 else "drive"'),
        {"too far", "too near"},
        "mirrored",
    ),
    Wrong(
        "right turns back to left",
        decide(turning='("scan", "left", "right")'),
        {"at hand"},
        "turns-back",
    ),
    Wrong(
        "or for and",
        decide(drive='"drive" if driven < 0.04 or reading > 0.18 else "scan"'),
        {"driving", "stopping"},
        "or-for-and",
    ),
    Wrong(
        "blind drive", decide(drive='"drive" if driven < 0.04 else "scan"'), {"stopping"}, "blind"
    ),
    Wrong(
        "endless drive", decide(drive='"drive" if reading > 0.18 else "scan"'), DRIVES, "endless"
    ),
    Wrong(
        "turns at the wheel",
        decide(drive='decide("scan", reading, 0) if driven < 0.04 else "scan"'),
        {"driving", "stopping"},
        "no-scan",
    ),
    Wrong(
        "limits swapped",
        decide(far="0.18", right='"right" if reading < 0.25 else "drive"'),
        {"at hand"},
        "limits-swapped",
    ),
    Wrong(
        "drives after a turn to the left",
        decide(
            correcting='("scan", "right")',
            drive='"drive" if doing == "left" else '
            '"drive" if driven < 0.04 and reading > 0.18 else "scan"',
        ),
        {"too near"},
        "one-turn",
    ),
    Wrong(
        "decides by the reading",
        """
def decide(doing, reading, driven):
    if doing == "drive" and driven >= 0.04:
        return "scan"
    return "left" if reading > 0.25 else "right" if reading < 0.18 else "drive"
""",
        {"at hand", "driving", "stopping"},
        "memoryless",
    ),
    Wrong("a word of its own", decide(left='"turn left"'), {"12-decide"}, None, "malformed"),
    Wrong("a number", decide(left="1"), {"12-decide"}, None, "malformed"),
    Wrong("never scans", decide(drive='"drive"'), {"driving", "stopping"}),
    Wrong(
        "the first time it strays",
        lost("return np.argmax(far) if far.any() else -1"),
        {"stays", "since"},
        "first-time",
    ),
    Wrong(
        "the first time it strays, if lost",
        lost("return np.argmax(far) if far[-1] else -1"),
        {"since"},
        "first-time",
    ),
    Wrong(
        "the last time it strays",
        lost(
            "c = np.flatnonzero(np.diff(far.astype(int), prepend=0) == 1)\n"
            "return c[-1] if len(c) else -1"
        ),
        {"stays"},
        "last-crossing",
    ),
    Wrong(
        "the last good one",
        lost(
            "good = np.flatnonzero(~far)\n"
            "return -1 if not far[-1] else good[-1] if len(good) else 0"
        ),
        {"since"},
        "one-early",
    ),
    Wrong(
        "the last bad one",
        lost("return np.flatnonzero(far)[-1] if far.any() else -1"),
        {"12-lost"},
        "last-far",
    ),
    Wrong(
        "the largest error",
        lost("return np.argmax(errors) if far.any() else -1"),
        {"stays", "since"},
        "largest",
        may_lose={"12-lost:always"},
    ),
    Wrong("how many", lost("return far.sum() if far[-1] else -1"), {"since", "always"}, "counted"),
    Wrong(
        "from the end",
        lost("k = 0\nwhile k < len(far) and far[-1 - k]:\n    k += 1\nreturn k if k else -1"),
        {"since", "always"},
        "from-the-end",
    ),
    Wrong(
        "0 for never",
        lost("k = len(far)\nwhile k and far[k - 1]:\n    k -= 1\nreturn k if far[-1] else 0"),
        {"stays"},
        "zero-for-never",
    ),
    Wrong("never lost", lost("return -1"), {"12-lost"}, "idle"),
    Wrong("yes or no", lost("return bool(far[-1])"), {"12-lost"}, "yes-or-no"),
    Wrong("nothing for never", lost("if far[-1]:\n    return 0"), {"12-lost"}, None, "malformed"),
    Wrong("Wald", interval(**WALD), {"inside", "doubt", "covers"}, "wald"),
    Wrong("Wald, cut off", interval(**WALD, **CLIPPED), {"doubt", "covers"}, "wald"),
    Wrong(
        "a variance",
        interval(middle="p", half="z * p * (1 - p) / n", **CLIPPED),
        {"doubt", "covers", "narrows"},
        "variance",
    ),
    Wrong(
        "of one run",
        interval(middle="p", half="z * np.sqrt(p * (1 - p))", **CLIPPED),
        {"doubt", "covers", "narrows"},
        "of-one-run",
    ),
    Wrong("one sigma", interval(z="1.0"), {"doubt", "covers"}, "one-sigma"),
    Wrong(
        "one sigma of Wald", interval(z="1.0", **WALD, **CLIPPED), {"doubt", "covers"}, "one-sigma"
    ),
    Wrong("not moved", interval(middle="p"), {"inside", "covers"}, "not-moved"),
    Wrong(
        "not divided",
        interval(
            middle="p + z**2 / (2 * n)",
            half="z * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2))",
        ),
        {"inside"},
        "undivided",
        may_lose={"12-interval:covers"},
    ),
    Wrong("high before low", interval(result="middle + half, middle - half"), {"12-interval"}),
    Wrong("middle and half", interval(result="middle, half"), {"12-interval"}),
    Wrong("one number", interval(result="half"), {"12-interval"}, None, "malformed"),
    Wrong("always everything", interval(result="0, 1"), {"12-interval"}, "idle"),
]

RIGHT = [
    Right(
        "by the radius of the arc",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    turn = (r - l) / base
    if abs(turn) < 1e-9:
        return [(l + r) / 2, 0.0, 0.0]
    radius = (l + r) / 2 / turn
    return [radius * np.sin(turn), radius * (1 - np.cos(turn)), turn]
""",
    ),
    Right(
        "in many little steps",
        """
def odometry(left, right, tick, base):
    pose, steps = np.zeros(3), 2000
    d, turn = (left + right) / 2 * tick / steps, (right - left) * tick / base / steps
    heading = turn * (np.arange(steps) + 0.5)
    return np.array([d * np.cos(heading).sum(), d * np.sin(heading).sum(), turn * steps])
""",
    ),
    Right(
        "heading wrapped",
        odometry(
            motion="[chord * np.cos(turn / 2), chord * np.sin(turn / 2), "
            "np.arctan2(np.sin(turn), np.cos(turn))]"
        ),
    ),
    Right(
        "decisions nested by doing",
        """
def decide(doing, reading, driven):
    if doing == "drive":
        return "scan" if driven >= 0.04 or reading <= 0.18 else "drive"
    if doing == "right":
        return "drive" if reading >= 0.18 else "right"
    if reading > 0.25:
        return "left"
    return "drive" if reading >= 0.18 else "right"
""",
    ),
    Right(
        "counted back from the end",
        lost("k = len(far)\nwhile k and far[k - 1]:\n    k -= 1\nreturn k if far[-1] else -1"),
    ),
    Right(
        "by products from behind",
        lost("gone = np.cumprod(far[::-1])[::-1]\nreturn np.argmax(gone) if gone.any() else -1"),
    ),
    Right("Wilson, cut off", interval(**CLIPPED)),
    Right("an array", interval(result="np.clip([middle - half, middle + half], 0, 1)")),
    Right(
        "Clopper and Pearson",
        """
def interval(k, n):
    from scipy.stats import beta
    low = beta.ppf(0.025, k, n - k + 1) if k else 0.0
    return low, beta.ppf(0.975, k + 1, n - k) if k < n else 1.0
""",
    ),
    Right(
        "Agresti and Coull, cut off",
        """
def interval(k, n):
    more = n + 4
    p = (k + 2) / more
    half = 1.96 * np.sqrt(p * (1 - p) / more)
    return max(p - half, 0), min(p + half, 1)
""",
    ),
    Right(
        "the roots of the quadratic",
        """
def interval(k, n):
    p, c = k / n, 1.96**2 / n
    low, high = sorted(np.roots([1 + c, -2 * p - c, p**2]).real)
    return max(low, 0.0), min(high, 1.0)
""",
    ),
]
