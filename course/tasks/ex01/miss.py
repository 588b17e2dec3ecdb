"""Right ways and slips of 01-miss."""

from course.tasks import Slip, Stumble
from course.tasks.ex01 import miss_ways

TASK = "01-miss"
WAYS = miss_ways.WAYS

STEP, TO_END = "step = np.diff(xy, axis=0)", "to_end = xy[-1] - xy[1:]"
TURNED = "turned = to_end[:, ::-1] * [-1, 1]"
LENGTHS = "variance = length_error**2 * np.sum(step**2, axis=0)"
HEADINGS = "variance += heading_error**2 * np.sum(turned**2, axis=0)"
ROOT = "return np.sqrt(variance)"

SLIPS = (
    Slip(
        "turned along the stick",
        "An error of heading moves the end along the line from pose k to the end. A stick that turns "
        "moves its end at a right angle to itself.",
        (TURNED, "turned = to_end"),
    ),
    Slip(
        "lever from the start",
        "You take the way from the start to pose k. An error at pose k turns what comes after it: the "
        "way from pose k to the end.",
        (TO_END, "to_end = xy[1:] - xy[0]"),
        (TO_END, "to_end = xy[:-1] - xy[0]"),
    ),
    Slip(
        "way driven, not straight",
        "You take the way that was driven from pose k to the end. What turns is one rigid piece: what "
        "counts is the straight line between its two ends.",
        (
            TURNED,
            "far = np.hypot(*step.T)[::-1].cumsum()[::-1]\n"
            "    far = np.append(far[1:], 0)[: len(step)]\n"
            "    turned = np.column_stack([far, far])",
        ),
        (
            TURNED,
            "far = np.abs(step)[::-1].cumsum(axis=0)[::-1] - np.abs(step)\n    turned = far[:, ::-1]",
        ),
    ),
    Slip(
        "the first step bent too",
        "The first step is bent by an error that is made after it. Each error turns the track about the "
        "pose at which it was made, at the end of its step.",
        (TO_END, "to_end = xy[-1] - xy[:-1]"),
    ),
    Slip(
        "each error bends one step",
        "You let each error of heading bend the next step only. The robot keeps a wrong heading: "
        "everything that follows is turned.",
        (TO_END, "to_end = np.vstack([step[1:], 0 * step[:1]])"),
        (TO_END, "to_end = step"),
    ),
    Slip(
        "one error for the whole drive",
        "You let one error act on the whole drive. Each step has an error of its own, and they are "
        "independent.",
        (TO_END, "to_end = (xy[-1:] - xy[:1])"),
        (TO_END, "to_end = np.tile(xy[-1] - xy[0], (len(step), 1))"),
    ),
    Slip(
        "errors added up",
        "You add the errors with their signs, or their sizes, as if all went to one side. They are "
        "independent: add their squares.",
        (LENGTHS, "variance = length_error**2 * np.sum(step, axis=0) ** 2"),
        (LENGTHS, "variance = length_error**2 * np.sum(np.abs(step), axis=0) ** 2"),
        (HEADINGS, "variance += heading_error**2 * np.sum(turned, axis=0) ** 2"),
        (HEADINGS, "variance += heading_error**2 * np.sum(np.abs(turned), axis=0) ** 2"),
        [
            (LENGTHS, "variance = length_error**2 * np.sum(np.abs(step), axis=0) ** 2"),
            (HEADINGS, "variance += heading_error**2 * np.sum(np.abs(turned), axis=0) ** 2"),
        ],
    ),
    Slip(
        "roots added up",
        "You add two standard deviations. Variances of independent errors add up: take the root at the "
        "very end.",
        [
            (LENGTHS, "spread = length_error * np.sqrt(np.sum(step**2, axis=0))"),
            (HEADINGS, "spread = spread + heading_error * np.sqrt(np.sum(turned**2, axis=0))"),
            (ROOT, "return spread"),
        ],
    ),
    Slip(
        "root forgotten",
        "These are variances, in m². The standard deviations are their roots, in m.",
        (ROOT, "return variance"),
    ),
    Slip(
        "variance for deviation",
        "The two errors are given as standard deviations. In a variance they count squared.",
        (LENGTHS, "variance = length_error * np.sum(step**2, axis=0)"),
        (HEADINGS, "variance += heading_error * np.sum(turned**2, axis=0)"),
        [
            (LENGTHS, "variance = length_error * np.sum(step**2, axis=0)"),
            (HEADINGS, "variance += heading_error * np.sum(turned**2, axis=0)"),
        ],
    ),
    Slip(
        "mean for sum",
        "That is the mean over the steps. Many errors do more harm than one: their variances add up.",
        (LENGTHS, "variance = length_error**2 * np.sum(step**2, axis=0) / max(len(step), 1)"),
        (HEADINGS, "variance += heading_error**2 * np.sum(turned**2, axis=0) / max(len(step), 1)"),
        (ROOT, "return np.sqrt(variance / max(len(step), 1))"),
    ),
    Slip(
        "headings do no harm",
        "Only the errors of length are in your numbers. A wrong heading leads aside, and by the more the "
        "farther the end is.",
        (HEADINGS, ""),
    ),
    Slip(
        "lengths do no harm",
        "Only the errors of heading are in your numbers. Steps that are too long or too short move the "
        "end as well.",
        (LENGTHS, "variance = 0.0"),
    ),
    Slip(
        "length as metres",
        "length_error is a share of each step: 2 % of a long step is more than 2 % of a short one.",
        (LENGTHS, "variance = length_error**2 * np.array([len(step)] * 2)"),
        (
            STEP,
            "step = np.diff(xy, axis=0)\n    step = step / np.maximum(np.hypot(*step.T), 1e-9)[:, None]",
        ),
    ),
    Slip(
        "length to all sides",
        "A step that is too long moves the end in the direction of that step only, and not by its whole "
        "length in x and in y.",
        (STEP, "step = np.diff(xy, axis=0)\n    step = np.hypot(*step.T)[:, None] * [1, 1]"),
        (LENGTHS, "variance = length_error**2 * np.sum(step**2) / 2 * np.ones(2)"),
    ),
    Slip(
        "turned to all sides",
        "You take the length of the line from pose k to the end for both x and y. Its end moves at a "
        "right angle to it: how much of that is in x, and how much in y?",
        (TURNED, "turned = np.hypot(*to_end.T)[:, None] * [1, 1]"),
        (HEADINGS, "variance += heading_error**2 * np.sum(turned**2) / 2"),
    ),
    Slip(
        "where it looks",
        "You take a robot to move where it looks. It may drive backwards or sideways: the way it moved "
        "is the difference of two poses.",
        (
            STEP,
            "step = np.diff(xy, axis=0)\n    ahead = poses[:-1, 2]\n"
            "    step = np.hypot(*step.T)[:, None] * np.column_stack([np.cos(ahead), np.sin(ahead)])",
        ),
        (
            STEP,
            "step = np.diff(xy, axis=0)\n    ahead = poses[1:, 2]\n"
            "    step = np.hypot(*step.T)[:, None] * np.column_stack([np.cos(ahead), np.sin(ahead)])",
        ),
    ),
    Slip(
        "in a robot's frame",
        "These are deviations ahead and to the left, of the robot at the start or at the end. They are "
        "asked for along the world's axes.",
        *(
            (
                "xy = poses[:, :2]",
                f"c, s = np.cos(poses[{k}, 2]), np.sin(poses[{k}, 2])\n"
                "    xy = poses[:, :2] @ np.array([[c, -s], [s, c]])",
            )
            for k in (0, -1)
        ),
    ),
    Slip(
        "x and y swapped",
        "The two numbers have changed places: first the deviation in x, then the one in y.",
        (ROOT, "return np.sqrt(variance)[::-1]"),
    ),
    Slip(
        "one number for both",
        "You add what happens in x and what happens in y. Each has a deviation of its own.",
        (ROOT, "return np.sqrt([variance.sum()] * 2)"),
    ),
    Slip(
        "degrees",
        "The error of heading is in radians already, and in radians a small angle equals its sine.",
        (HEADINGS, "variance += np.degrees(heading_error) ** 2 * np.sum(turned**2, axis=0)"),
        (HEADINGS, "variance += np.radians(heading_error) ** 2 * np.sum(turned**2, axis=0)"),
    ),
    Slip(
        "per cent",
        "length_error is a share: 0.02 is 2 % already.",
        (LENGTHS, "variance = (length_error / 100) ** 2 * np.sum(step**2, axis=0)"),
    ),
    Slip(
        "two standard deviations",
        "These are twice the standard deviations, as they are drawn in pictures. Asked is one.",
        (ROOT, "return 2 * np.sqrt(variance)"),
    ),
    Slip(
        "as if straight",
        "That is the formula of a straight drive along x. Here the way has corners: ask what a single "
        "error does to the end.",
        """
def miss(poses, length_error, heading_error):
    n = len(poses) - 1
    d = np.mean(np.hypot(*np.diff(poses[:, :2], axis=0).T)) if n else 0.0
    return np.array([length_error * d * np.sqrt(n), drift(n, d, heading_error)])
""",
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (ROOT, "return np.sqrt(variance.sum())"),
        (ROOT, "np.sqrt(variance)"),
        (ROOT, "return np.diag(variance)"),
        (ROOT, "return np.sqrt(variance - 1e6)"),
    ),
    Stumble("raised", (TO_END, "to_end = xy[len(xy)] - xy[1:]")),
    Stumble(
        "not attempted",
        "def miss(poses, length_error, heading_error):\n    raise NotImplementedError",
    ),
)

PASTED = {
    "the formula of a straight drive": """
def miss(poses, length_error, heading_error):
    n = len(poses) - 1
    way = np.hypot(*(poses[-1] - poses[0])[:2])
    d = way / max(n, 1)
    return [length_error * d * np.sqrt(n), drift(n, d, heading_error)]
""",
    "the same, turned into the world": """
def miss(poses, length_error, heading_error):
    n = len(poses) - 1
    ahead, left = seen_from(poses[0], poses[-1])[:2]
    way = np.arctan2(ahead, left)
    d = np.hypot(ahead, left) / max(n, 1)
    along, across = length_error * d * np.sqrt(n), drift(n, d, heading_error)
    c, s = np.cos(way), np.sin(way)
    return np.sqrt([(c * along) ** 2 + (s * across) ** 2, (s * along) ** 2 + (c * across) ** 2])
""",
    "the lesson's spread of two thousand robots": """
def miss(poses, length_error, heading_error, robots=200):
    rng, n = np.random.default_rng(2), len(poses) - 1
    step = np.hypot(*np.diff(poses[:, :2], axis=0).T)
    lengths = step * (1 + length_error * rng.standard_normal((robots, n)))
    errors = heading_error * rng.standard_normal((robots, n))
    headings = np.cumsum(errors, axis=1) - errors
    along, across = lengths * np.cos(headings), lengths * np.sin(headings)
    return [along.sum(axis=1).std(), across.sum(axis=1).std()]
""",
}

EQUIVALENT = {
    "1e-06 ->": "any small difference tells the slope",
    "steps / (1 + longer)": "1 / (1 + ε) is 1 − ε for small ε, and both signs are tried",
}
