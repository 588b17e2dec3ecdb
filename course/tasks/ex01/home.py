"""Right ways and slips of 01-home: some methods that mend a track well, and some that do not."""

from course.tasks import Slip, Stumble

TASK = "01-home"
MUTANTS = 24

LAP_BY_LAP = """
def home(start, steps, docked):
    steps = steps.copy()
    factor = 1.0
    {factor}
    steps[:, 2] /= factor
    poses, i = [np.array([start])], 0
    for j in docked:
        lap = steps[i:j].copy()
        turned = lap[:, 2].sum()
        lap[:, 2] += (2 * np.pi * np.round(turned / (2 * np.pi)) - turned) * {headings}
        told = track(start, lap)
        told[:, :2] += (start[:2] - told[-1, :2]) * {places}[:, None]
        poses.append(told[1:])
        i = j
    return np.concatenate([*poses, track(start, steps[i:])[1:]])
"""
EVENLY, NOT = "1 / len(lap)", "0"
PLACES = "np.linspace(0, 1, len(told))"
LEARNT = """bounds = [0, *docked]
    told = [abs(steps[a:b, 2].sum()) for a, b in zip(bounds[:-1], bounds[1:])]
    factor = np.mean(told) / (2 * np.pi)"""


def _shared(factor="pass", headings=EVENLY, places=PLACES):
    return LAP_BY_LAP.format(factor=factor, headings=headings, places=places)


WAYS = {
    "least squares, error by error": """
def home(start, steps, docked):
    n = len(steps)
    W = np.concatenate([np.full(n, 0.01**2), np.full(n, 0.015**2), [0.08**2]])
    x = np.zeros(2 * n + 1)

    def told_by(x):
        mended = steps.copy()
        mended[:, 2] = (steps[:, 2] - x[:n]) / (1 + x[-1])
        mended[:, 0] = steps[:, 0] / (1 + x[n:-1])
        return mended

    for _ in range(4):
        mended = told_by(x)
        poses = track(start, mended)
        A, gaps = [], []
        for k in docked:
            rest = poses[k, :2] - poses[1 : k + 1, :2]
            J = np.zeros((3, 2 * n + 1))
            lever = np.array([-rest[:, 1], rest[:, 0], np.ones(k)])
            J[:, :k] = -lever / (1 + x[-1])
            J[:2, n : n + k] = -np.diff(poses[: k + 1, :2], axis=0).T
            J[:, -1] = -(lever @ mended[:k, 2]) / (1 + x[-1])
            gap = poses[k] - start
            gap[2] = (gap[2] + np.pi) % (2 * np.pi) - np.pi
            A.append(J)
            gaps.append(gap)
        A, gap = np.vstack(A), np.concatenate(gaps)
        x = W * (A.T @ np.linalg.solve(A * W @ A.T, A @ x - gap))
    return track(start, told_by(x))
""",
    "the factor that closes the laps best": """
def home(start, steps, docked):
    bounds = [0, *docked]
    laps = [slice(a, b) for a, b in zip(bounds[:-1], bounds[1:])]

    def run(moves):
        headings = np.append(0, np.cumsum(moves[:, 2]))
        z = np.append(0, np.cumsum(moves[:, 0] * np.exp(1j * headings[:-1])))
        return z, headings

    def gaps(factor):
        total = 0.0
        for lap in laps:
            z, headings = run(steps[lap] / [1, 1, factor])
            total += abs(z[-1]) ** 2 + 9 * abs(np.exp(1j * headings[-1]) - 1) ** 2
        return total

    factor = min(np.linspace(0.8, 1.2, 201), key=gaps)
    steps = steps / [1, 1, factor]
    found, turn = [np.zeros(1)], np.exp(1j * start[2])
    for lap in laps:
        moves = steps[lap].copy()
        off = moves[:, 2].sum()
        moves[:, 2] -= (off - 2 * np.pi * np.round(off / (2 * np.pi))) / len(moves)
        z, _ = run(moves)
        found.append((z - z[-1] * np.linspace(0, 1, len(z)))[1:])
    found.append(run(steps[docked[-1] :])[0][1:])
    z = np.concatenate(found) * turn
    return [[start[0] + p.real, start[1] + p.imag, start[2]] for p in z]
""",
    "shared by turns and by lengths": _shared(
        LEARNT,
        "(0.02 + np.abs(lap[:, 2])) / np.sum(0.02 + np.abs(lap[:, 2]))",
        "np.append(0, np.cumsum(lap[:, 0]) / np.sum(lap[:, 0]))",
    ),
    "the middle of the laps' factors": _shared(
        """bounds = [0, *docked]
    told = [abs(steps[a:b, 2].sum()) for a, b in zip(bounds[:-1], bounds[1:])]
    factor = (np.median(told) + np.mean(told)) / (4 * np.pi)"""
    ),
}

SNAPPED = _shared(headings=NOT, places="(np.arange(len(told)) == len(told) - 1)")
DEAD = "def home(start, steps, docked):\n    return track(start, steps)\n"

SLIPS = (
    Slip(
        "dock not used",
        "That is dead reckoning: it does not use that the robot came home. Each time it is docked, its "
        "pose is known.",
        DEAD,
    ),
    Slip(
        "rows at the dock only",
        "Only the rows at which the robot was docked were put right. What lies between them, and behind the "
        "last one, was driven by the same wheels.",
        """
def home(start, steps, docked):
    poses = track(start, steps)
    poses[docked] = start
    return poses
""",
    ),
    Slip(
        "begun anew",
        "You begin anew at the dock, and leave the lap before it as it was. But that lap is known to "
        "end at its start: its error was made on the way, step by step.",
        SNAPPED,
        _shared(headings=NOT, places="np.zeros(len(told))"),
    ),
    Slip(
        "places shared only",
        "You share out by how much a lap misses its place. It also misses its heading, and that is what "
        "has bent it: share out the heading first.",
        _shared(headings=NOT),
        """
def home(start, steps, docked):
    poses, a = track(start, steps), 0
    for b in docked:
        gap = start[:2] - poses[b, :2]
        poses[a : b + 1, :2] += np.linspace(0, 1, b - a + 1)[:, None] * gap
        poses[b + 1 :, :2] += gap
        a = b
    return poses
""",
        before=("begun anew",),
    ),
    Slip(
        "headings shared only",
        "You share out by how much a lap misses its heading. What is left then is a gap in place, which "
        "can be shared out as well.",
        _shared(places="np.zeros(len(told))"),
    ),
    Slip(
        "each lap by itself",
        "You mend each lap by itself. All laps of a drive have the same worn tyre: what do their gaps "
        "tell together, and what does it say about the way after the last lap?",
        _shared(),
        _shared(headings="np.abs(lap[:, 2]) / np.abs(lap[:, 2]).sum()"),
    ),
    Slip(
        "one angle for each step",
        "You take the same angle off each step of the drive. The tyre misjudges turns by a factor: laps "
        "to the left are turned too far to the left, and laps to the right too far to the right.",
        _shared(
            "steps[:, 2] -= (np.sum(steps[: docked[-1], 2]) % (2 * np.pi)) / docked[-1]",
        ),
        _shared(
            "off = np.sum(steps[: docked[-1], 2])\n"
            "    steps[:, 2] -= (off - 2 * np.pi * np.round(off / (2 * np.pi))) / docked[-1]",
        ),
    ),
    Slip(
        "factor only",
        "You take the worn tyre into account, and leave the rest as it is. No lap closes quite yet: the "
        "random errors are still to be shared out.",
        "def home(start, steps, docked):\n    steps = steps.copy()\n    "
        + LEARNT
        + "\n    steps[:, 2] /= factor\n    return track(start, steps)\n",
    ),
    Slip(
        "factor turned",
        "You make the turns still larger where they are too large: the factor stands on the wrong side.",
        _shared(
            LEARNT.replace("factor = ", "factor = 1 / ").replace(
                "np.mean(told) / (2 * np.pi)", "(np.mean(told) / (2 * np.pi))"
            )
        ),
    ),
    Slip(
        "sides mixed up",
        "You take each lap for a full turn to the left. A lap to the right is a full turn to the right, "
        "and adding both with their signs hides the factor.",
        ("truly = 2 * np.pi * np.sign(told)", "truly = 2 * np.pi * np.ones(len(told))"),
        ("told @ truly / (truly @ truly)", "(1 + told.sum() - truly.sum())"),
    ),
    Slip(
        "way beyond not mended",
        "The laps are mended, and the way after the last one is left as the wheels told it. The tyre is "
        "as worn there as it was before.",
        [
            ("steps = steps.copy()", "steps, told_by_wheels = steps.copy(), steps"),
            ("track(start, steps[docked[-1] :])", "track(start, told_by_wheels[docked[-1] :])"),
        ],
    ),
    Slip(
        "gap doubled",
        "The gap is shared out with the wrong sign, so that the lap ends twice as far from home.",
        _shared(places="-np.linspace(0, 1, len(told))"),
    ),
    Slip(
        "turns of both sides added",
        "Your factor comes from a sum in which laps to the left and laps to the right cancel. Each lap "
        "turns once round: compare their amounts.",
        _shared(LEARNT.replace("abs(steps[a:b, 2].sum())", "steps[a:b, 2].sum()")),
    ),
    Slip(
        "docked a step too early",
        "Your laps end a row too early. Row 0 of the track is the start, and row d lies after step d - 1: "
        "the lap that ends at row d has the steps up to, and without, d.",
        _shared("docked = [row - 1 for row in docked]"),
        _shared("docked = [row - 1 for row in docked]\n    " + LEARNT),
    ),
    Slip(
        "gap with the wrong sign",
        "The laps end twice as far from the dock as they did: the gap leads from where the wheels say "
        "the lap ends to the dock, and is added.",
        _shared(LEARNT, places="-np.linspace(0, 1, len(told))"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        ("return np.concatenate(poses)", "return np.concatenate(poses)[1:]"),
        ("return np.concatenate(poses)", "return np.concatenate(poses)[:, :2]"),
        ("return np.concatenate(poses)", "np.concatenate(poses)"),
    ),
    Stumble(
        "raised", "def home(start, steps, docked):\n    return track(start, steps[docked])[9000]\n"
    ),
    Stumble("not attempted", "def home(start, steps, docked):\n    raise NotImplementedError"),
)

PASTED = {
    "dead reckoning": DEAD,
    "dead reckoning from each docking on": SNAPPED,
}

EQUIVALENT = {"": "any method goes: whatever reaches the highest step is right"}
