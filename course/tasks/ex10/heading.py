"""Programs of 10-heading: extreme bearings, the way back to the heading, one turn for both intervals."""

from course.tasks import Slip, Stumble

TASK = "10-heading"

WAYS = {
    "the box of differences": """
def sharpen(heading, robot, box, bearing, bound):
    x, y = (box[0] - robot[1], box[1] - robot[0]), (box[2] - robot[3], box[3] - robot[2])
    if x[0] <= 0 <= x[1] and y[0] <= 0 <= y[1]:
        return np.array(heading)
    seen = np.array([complex(u, v) for u in x for v in y])
    middle = complex(sum(x), sum(y))
    off = np.angle(seen / middle)
    straight = np.angle(middle) - bearing
    here = np.mean(heading)
    straight = here + np.angle(np.exp(1j * (straight + off.min() / 2 + off.max() / 2 - here)))
    half = (off.max() - off.min()) / 2 + bound
    return max(heading[0], straight - half), min(heading[1], straight + half)
""",
    "counted from right": """
def sharpen(heading, robot, box, bearing, bound):
    if (robot[1] >= box[0] and box[1] >= robot[0]) and (robot[3] >= box[2] and box[3] >= robot[2]):
        return heading.copy()
    places = [(x, y) for x in robot[:2] for y in robot[2:]]
    targets = [(x, y) for x in box[:2] for y in box[2:]]
    seen = np.array([np.arctan2(v - y, u - x) for x, y in places for u, v in targets])
    off = wrap(seen - seen[0])
    first, wide = seen[0] + off.min() - bearing - bound, np.ptp(off) + 2 * bound
    behind = (first - heading[0]) % (2 * np.pi)
    if behind > heading[1] - heading[0] + 1e-9:
        behind -= 2 * np.pi
    low, high = max(0, behind), min(heading[1] - heading[0], behind + wide)
    return heading[0] + np.array([low, high])
""",
    "turns rounded": """
def sharpen(heading, robot, box, bearing, bound):
    apart = robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]
    if apart:
        dx, dy = np.meshgrid([box[0] - robot[1], box[1] - robot[0]], [box[2] - robot[3], box[3] - robot[2]])
        middle = np.arctan2(dy.mean(), dx.mean())
        off = wrap(np.arctan2(dy, dx) - middle)
        right, left = middle + off.min() - bearing - bound, middle + off.max() - bearing + bound
        turns = 2 * np.pi * np.round((np.mean(heading) - (right + left) / 2) / (2 * np.pi))
        heading = [max(heading[0], right + turns), min(heading[1], left + turns)]
    return np.array(heading)
""",
    "turned so that the heading is 0": """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return list(heading)
    middle, half = (heading[0] + heading[1]) / 2, (heading[1] - heading[0]) / 2
    ahead = [(box[0] + box[1] - robot[0] - robot[1]), (box[2] + box[3] - robot[2] - robot[3])]
    toward = np.arctan2(ahead[1], ahead[0])
    c, s = np.cos(toward), np.sin(toward)
    off = []
    for dx in (box[0] - robot[1], box[1] - robot[0]):
        for dy in (box[2] - robot[3], box[3] - robot[2]):
            off.append(np.arctan2(c * dy - s * dx, c * dx + s * dy))
    right, left = min(off) - bound, max(off) + bound
    between = wrap(float(toward - bearing - middle + (right + left) / 2)) - (right + left) / 2
    return [middle + max(-half, between + right), middle + min(half, between + left)]
""",
}

APART = "apart = robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]"
SEEN = "np.arctan2(v - y, u - x)"
OFF = "[wrap(angle - seen[0]) for angle in seen]"
TOLD = "right, left = seen[0] + min(off) - bearing - bound, seen[0] + max(off) - bearing + bound"
HERE = "here, there = (heading[0] + heading[1]) / 2, (right + left) / 2"
TURNS = "turns = here + wrap(there - here) - there"
RESULT = "np.array([max(heading[0], right + turns), min(heading[1], left + turns)])"


def told(right, left):
    """The line that says what the sighting tells, with other signs."""
    return TOLD, f"right, left = seen[0] + min(off) {right}, seen[0] + max(off) {left}"


SLIPS = (
    Slip(
        "bound-forgotten",
        "The interval is not widened by the bound: the bearing may be off by as much, either way.",
        told("- bearing", "- bearing"),
    ),
    Slip(
        "bound-inwards",
        "The interval is narrowed by the bound. A bearing that may be off allows more headings, not fewer.",
        told("- bearing + bound", "- bearing - bound"),
    ),
    Slip(
        "bound-one-way",
        "The bound moves both ends the same way, or only one of them. A bearing may be too large or too small.",
        told("- bearing + bound", "- bearing + bound"),
        told("- bearing - bound", "- bearing - bound"),
        told("- bearing", "- bearing + bound"),
        told("- bearing - bound", "- bearing"),
    ),
    Slip(
        "half-bound",
        "Only half of the bound is added on either side: a bound says how far off a bearing is at most.",
        told("- bearing - bound / 2", "- bearing + bound / 2"),
    ),
    Slip(
        "bearing-added",
        "The bearing has the wrong sign. It counts from the heading: what are direction, heading and "
        "bearing to each other?",
        told("+ bearing - bound", "+ bearing + bound"),
    ),
    Slip(
        "bearing-forgotten",
        "These are the directions to the object. The robot sees it at a bearing, and looks elsewhere.",
        told("- bound", "+ bound"),
    ),
    Slip(
        "from-the-object",
        "These are the directions from the object to the robot, π off. The robot looks the other way.",
        (SEEN, "np.arctan2(y - v, x - u)"),
    ),
    Slip(
        "exchanged-axes",
        "arctan2 takes y first, then x.",
        (SEEN, "np.arctan2(u - x, v - y)"),
    ),
    Slip(
        "half-circle",
        "arctan knows half the circle only: an object behind is taken for one ahead.",
        (SEEN, "np.arctan((v - y) / (u - x + 1e-300))"),
    ),
    Slip(
        "middles-only",
        "The bearing from middle to middle is used. Robot and object may be anywhere in their boxes.",
        (SEEN, "np.arctan2(sum(box[2:]) - sum(robot[2:]), sum(box[:2]) - sum(robot[:2]))"),
    ),
    Slip(
        "from-the-middle",
        "One of the two is taken to be in the middle of its box. Both may be anywhere in theirs.",
        (SEEN, "np.arctan2(v - np.mean(robot[2:]), u - np.mean(robot[:2]))"),
        (SEEN, "np.arctan2(np.mean(box[2:]) - y, np.mean(box[:2]) - x)"),
    ),
    Slip(
        "same-corners",
        "Each corner of one box is joined to the same corner of the other only. The extreme bearings are "
        "among those of all pairs.",
        [
            ("        for u in box[:2]\n", "        for u in (box[list(robot).index(x)],)\n"),
            ("        for v in box[2:]\n", "        for v in (box[list(robot).index(y)],)\n"),
        ],
    ),
    Slip(
        "seam-bearings",
        "Where bearings lie on both sides of ±π, the least and the largest number are not the extremes: "
        "count all of them from one.",
        (OFF, "[angle - seen[0] for angle in seen]"),
        (OFF, "[np.abs(wrap(angle - seen[0])) for angle in seen]"),
    ),
    Slip(
        "seam-turned",
        "All bearings are counted from 0 to 2π. That moves the seam from π to 0, where other objects are.",
        (OFF, "[angle % (2 * np.pi) - seen[0] for angle in seen]"),
    ),
    Slip(
        "seam-intersection",
        "Right and left are compared as numbers. −3.1 and 3.1 are close to each other: bring both "
        "intervals to the same turn first.",
        (TURNS, "turns = 0"),
        (TURNS, "turns = wrap(right) - right"),
        [
            (OFF, "[angle - seen[0] for angle in seen]"),
            (TURNS, "turns = 0"),
        ],
        [(TURNS, "turns = 0"), (HERE, "right, left = wrap(float(right)), wrap(float(left))")],
    ),
    Slip(
        "turned-by-the-end",
        "Both intervals are brought to one turn by their right ends. These may be more than half a turn "
        "apart, although the intervals overlap.",
        (HERE, "here, there = heading[0], right"),
        (HERE, "here, there = heading[1], left"),
    ),
    Slip(
        "not-intersected",
        "This is what the sighting says alone. What was known before still holds.",
        (RESULT, "np.array([right, left])"),
        (RESULT, "np.array([right + turns, left + turns])"),
        (RESULT, "np.array([wrap(right), wrap(left)])"),
    ),
    Slip(
        "united",
        "The two intervals are united. Both are true, so the heading lies in what they have in common.",
        (RESULT, "np.array([min(heading[0], right + turns), max(heading[1], left + turns)])"),
    ),
    Slip(
        "one-end-only",
        "Only one end is compared with what was known before: the sighting may narrow the heading at both.",
        (RESULT, "np.array([max(heading[0], right + turns), left + turns])"),
        (RESULT, "np.array([right + turns, min(heading[1], left + turns)])"),
        (RESULT, "np.array([max(heading[0], right + turns), heading[1]])"),
        (RESULT, "np.array([heading[0], min(heading[1], left + turns)])"),
    ),
    Slip(
        "exchanged",
        "Right and left have changed places: going counter-clockwise right comes first.",
        (RESULT, "np.array([min(heading[1], left + turns), max(heading[0], right + turns)])"),
    ),
    Slip(
        "left-wrapped",
        "left comes back less than right: it is wrapped. Keep it as right + width, even beyond π: only so "
        "left − right says how wide the interval is.",
        (RESULT, f"wrap({RESULT})"),
    ),
    Slip(
        "overlap",
        "Where the boxes overlap, object and robot may stand in any direction of each other. What does the "
        "sighting say about the heading then?",
        (APART, "apart = True"),
        """
def sharpen(heading, robot, box, bearing, bound):
    seen = [np.arctan2(v - y, u - x) for x in robot[:2] for y in robot[2:] for u in box[:2] for v in box[2:]]
    middle = np.arctan2(sum(box[2:]) - sum(robot[2:]), sum(box[:2]) - sum(robot[:2]))
    off = wrap(np.array(seen) - middle)
    right, left = middle + off.min() - bearing - bound, middle + off.max() - bearing + bound
    here, there = (heading[0] + heading[1]) / 2, (right + left) / 2
    turns = here + wrap(there - here) - there
    right, left = max(heading[0], right + turns), min(heading[1], left + turns)
    return np.array([wrap(right), wrap(right) + left - right])
""",
    ),
    Slip(
        "overlap-in-one-axis",
        "Boxes whose x overlap, or whose y do, are taken to overlap. To be at the same place both are needed.",
        (
            APART,
            "apart = (robot[1] < box[0] or box[1] < robot[0]) and "
            "(robot[3] < box[2] or box[3] < robot[2])",
        ),
        (APART, "apart = robot[1] < box[0] or box[1] < robot[0]"),
        (APART, "apart = robot[3] < box[2] or box[3] < robot[2]"),
        (APART, "apart = robot[1] < box[0] or robot[3] < box[2]"),
    ),
    Slip(
        "overlap-by-corners",
        "Boxes are said to overlap only if a corner of one lies in the other. One may lie across the other, "
        "or around it.",
        (
            APART,
            "apart = not any(robot[0] <= u <= robot[1] and robot[2] <= v <= robot[3] "
            "for u in box[:2] for v in box[2:])",
        ),
        (
            APART,
            "apart = not any(box[0] <= x <= box[1] and box[2] <= y <= box[3] "
            "for x in robot[:2] for y in robot[2:])",
        ),
    ),
    Slip(
        "overlap-all-round",
        "Where the boxes overlap, all headings are returned. The sighting says nothing; what was known "
        "before still holds.",
        ("        return heading\n", "        return np.array([-np.pi, np.pi])\n"),
        ("        return heading\n", "        return np.array([np.pi, 3 * np.pi])\n"),
    ),
    Slip(
        "degrees",
        "The bound and the bearing are in radians already, and so is what arctan2 returns.",
        (SEEN, "np.degrees(np.arctan2(v - y, u - x))"),
        told("- np.radians(bearing + bound)", "- np.radians(bearing - bound)"),
        told("- bearing - np.radians(bound)", "- bearing + np.radians(bound)"),
    ),
)

STUMBLES = (
    Stumble("malformed", (RESULT, "right"), (RESULT, "None")),
    Stumble("raised", (TURNS, "turns = here + wrapped(there - here) - there")),
    Stumble(
        "not attempted",
        "def sharpen(heading, robot, box, bearing, bound):\n    raise NotImplementedError",
    ),
)

MUTANTS = 1000
