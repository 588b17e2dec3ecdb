"""Right ways and slips of 15-range."""

from course.tasks import Edit, Slip, Stumble
from course.tasks.ex15.radio_ways import WAYS

__all__ = ["PASTED", "SLIPS", "STUMBLES", "TASK", "WAYS"]

TASK = "15-range"


def _in(*pairs):
    return Edit("matrices", pairs)


ARMS = "arm_i, arm_j = R(x_i[2]) @ a_i, R(x_j[2]) @ a_j"
WAY = "d = (x_j[:2] + arm_j) - (x_i[:2] + arm_i)"
DISTANCE = "distance = np.linalg.norm(d)"
UNIT = "u = d / distance"
TURNS = "turn_i, turn_j = u @ quarter @ arm_i, u @ quarter @ arm_j"
A, B = "A = np.append(-u, -turn_i)", "B = np.append(u, turn_j)"
RESULT = "return distance - r, A, B"

SLIPS = (
    Slip(
        "centres",
        "The distance is that of the robots' centres: each radio sits beside its centre, at a in the "
        "robot's frame.",
        _in((ARMS, "arm_i, arm_j = 0 * a_i, 0 * a_j")),
        _in((WAY, "d = x_j[:2] - x_i[:2]")),
    ),
    Slip(
        "arm-not-turned",
        "a is written in the robot's frame, and the poses in the world's: it turns with the robot.",
        _in((ARMS, "arm_i, arm_j = a_i, a_j")),
    ),
    Slip(
        "arm-turned-back",
        "a is turned the wrong way. From the robot's frame into the world's it is turned forth, by R.",
        _in((ARMS, "arm_i, arm_j = R(x_i[2]).T @ a_i, R(x_j[2]).T @ a_j")),
    ),
    Slip(
        "arms-exchanged",
        "The radios have changed places: a_i belongs to the robot at pose i, and turns with its heading.",
        _in((ARMS, "arm_i, arm_j = R(x_i[2]) @ a_j, R(x_j[2]) @ a_i")),
        _in((ARMS, "arm_i, arm_j = R(x_j[2]) @ a_i, R(x_i[2]) @ a_j")),
    ),
    Slip(
        "one-arm",
        "Only one of the two radios is where it should be: both sit beside their robots' centres.",
        _in((ARMS, "arm_i, arm_j = R(x_i[2]) @ a_i, 0 * a_j")),
        _in((ARMS, "arm_i, arm_j = 0 * a_i, R(x_j[2]) @ a_j")),
    ),
    Slip(
        "arm-sign",
        "A radio is put on the other side of its robot: its turned place is added to the robot's.",
        _in((WAY, "d = (x_j[:2] - arm_j) - (x_i[:2] - arm_i)")),
        _in((WAY, "d = (x_j[:2] + arm_j) - (x_i[:2] - arm_i)")),
        _in((WAY, "d = (x_j[:2] - arm_j) - (x_i[:2] + arm_i)")),
    ),
    Slip(
        "sum-of-places",
        "The places are added. The way from one radio to the other is the difference of their places.",
        _in((WAY, "d = (x_j[:2] + arm_j) + (x_i[:2] + arm_i)")),
    ),
    Slip(
        "squared",
        "This is the square of the distance, or its root was taken once too often.",
        _in((DISTANCE, "distance = d @ d")),
        _in((RESULT, "return distance**2 - r**2, A, B")),
        _in((RESULT, "return distance**2 - r, A, B")),
        _in((RESULT, "return distance**2 - r**2, 2 * distance * A, 2 * distance * B")),
    ),
    Slip(
        "other-norm",
        "The length of d is another one: it is the root of the sum of squares.",
        _in((DISTANCE, "distance = np.abs(d).sum()")),
        _in((DISTANCE, "distance = np.abs(d).max()")),
    ),
    Slip(
        "error-sign",
        "e has the wrong sign: it is the distance as the poses have it, less the measured one.",
        _in((RESULT, "return r - distance, A, B")),
        _in((RESULT, "return r - distance, -A, -B")),
        _in((RESULT, "return abs(distance - r), A, B")),
    ),
    Slip(
        "r-forgotten",
        "This is the distance itself. The error is what is left of it when the measured one is taken off.",
        _in((RESULT, "return distance, A, B")),
    ),
    Slip(
        "relative",
        "The error is a share of the distance. It is wanted in metres.",
        _in((RESULT, "return (distance - r) / r, A, B")),
        _in((RESULT, "return distance / r - 1, A, B")),
    ),
    Slip(
        "swapped",
        "A and B have changed places: A is the derivative by x_i, and B that by x_j.",
        _in((RESULT, "return distance - r, B, A")),
    ),
    Slip(
        "slopes-sign",
        "A and B have the opposite sign. If robot j goes away from robot i, does the distance grow?",
        _in((RESULT, "return distance - r, -A, -B")),
    ),
    Slip(
        "one-slope-sign",
        "One of A and B has the opposite sign. Moved by the same, both robots keep their distance.",
        _in((A, "A = np.append(u, turn_i)")),
        _in((A, "A = np.append(u, -turn_i)")),
        _in((B, "B = np.append(-u, -turn_j)")),
        _in((B, "B = np.append(-u, turn_j)")),
    ),
    Slip(
        "not-normalised",
        "A and B hold d itself: what is wanted is how the *length* of d changes, so that part of a "
        "motion counts which goes along d.",
        _in((UNIT, "u = d")),
        _in((UNIT, "u = d / distance**2")),
        _in((UNIT, "u = d / r")),
    ),
    Slip(
        "heading-missing",
        "The last entries are zero, as if the radios sat at the centres. If a robot turns on the spot, "
        "its radio moves.",
        _in((TURNS, "turn_i, turn_j = 0.0, 0.0")),
        _in((A, "A = np.append(-u, 0.0)")),
        _in((B, "B = np.append(u, 0.0)")),
    ),
    Slip(
        "a-is-minus-b",
        "A is −B, or B is −A, also in the last entry. But each robot turns its own radio: the two arms "
        "differ.",
        _in((B, "B = -A")),
        _in((A, "A = np.append(-u, -turn_j)")),
    ),
    Slip(
        "heading-sign",
        "The last entry has the wrong sign: a robot that turns to the left moves its radio to the left "
        "of the arm.",
        _in((TURNS, TURNS.replace("u @", "-u @"))),
        _in((A, "A = np.append(-u, turn_i)")),
        _in((B, "B = np.append(u, -turn_j)")),
    ),
    Slip(
        "heading-along-arm",
        "The last entry takes the radio to move along its arm. On a robot that turns, it moves at right "
        "angles to it.",
        _in((TURNS, "turn_i, turn_j = u @ arm_i, u @ arm_j")),
    ),
    Slip(
        "heading-in-robot-frame",
        "The arm of the last entry is written in the robot's frame, and the line between the radios in "
        "the world's: turn one of them.",
        _in((TURNS, "turn_i, turn_j = u @ quarter @ a_i, u @ quarter @ a_j")),
    ),
    Slip(
        "heading-of-the-other",
        "The last entries belong to the other robot: A holds what the turn of robot i does, and B that "
        "of robot j.",
        _in((A, "A = np.append(-u, -turn_j)"), (B, "B = np.append(u, turn_i)")),
    ),
    Slip(
        "heading-not-projected",
        "The last entry is all of the radio's way. Only that part of it which goes along d changes the "
        "distance.",
        _in((TURNS, "turn_i, turn_j = np.linalg.norm(arm_i), np.linalg.norm(arm_j)")),
    ),
    Slip(
        "swings-as-in-task-2",
        "The last entry of A swings the whole way to robot j, as in task 2. The distance does not care: "
        "only the arm of robot i moves its radio.",
        _in((A, "A = np.append(-u, -u @ quarter @ (x_j[:2] - x_i[:2]))")),
        _in((A, "A = np.append(-u, u @ quarter @ (x_j[:2] - x_i[:2]))")),
    ),
    Slip(
        "slopes-in-frame-of-i",
        "A and B are written in the frame of pose i, but poses move in the world's frame.",
        _in((UNIT, "u = R(x_i[2]).T @ d / distance")),
        _in(
            (A, "A = np.append(-R(x_i[2]).T @ u, -turn_i)"),
            (B, "B = np.append(R(x_j[2]).T @ u, turn_j)"),
        ),
    ),
    Slip(
        "slopes-of-centres",
        "The error is that of the radios, but A and B point along the line between the centres.",
        _in((UNIT, "u = (x_j - x_i)[:2] / np.linalg.norm((x_j - x_i)[:2])")),
    ),
    Slip(
        "degrees",
        "Degrees and radians are mixed: headings come in radians, and slopes are per radian.",
        _in((ARMS, "arm_i, arm_j = R(np.radians(x_i[2])) @ a_i, R(np.radians(x_j[2])) @ a_j")),
        _in((TURNS, TURNS + "; turn_i, turn_j = np.radians(turn_i), np.radians(turn_j)")),
    ),
)

STUMBLES = (
    Stumble("malformed", _in((RESULT, "return distance - r")), _in((RESULT, "pass"))),
    Stumble("malformed", _in((RESULT, "return distance - r, A[None], B[None]"))),
    Stumble("malformed", _in((RESULT, "return distance - r, A[:2], B[:2]"))),
    Stumble("raised", _in((ARMS, "arm_i, arm_j = R(x_i) @ a_i, R(x_j) @ a_j"))),
)

PASTED = {
    "error and Jacobians of task 1 and 2, their first rows": """
def range_edge(x_i, x_j, r, a_i, a_j):
    z = np.array([r, 0.0, 0.0])
    A, B = jacobians(x_i, x_j, z)
    return error(x_i, x_j, z)[0], A[0], B[0]
""",
    "the length of task 1's error, its slopes by task 2": """
def range_edge(x_i, x_j, r, a_i, a_j):
    z = np.zeros(3)
    e, (A, B) = error(x_i, x_j, z)[:2], jacobians(x_i, x_j, z)
    u = e / np.hypot(*e)
    return np.hypot(*e) - r, u @ A[:2], u @ B[:2]
""",
    "distance of lesson 04's landmark": """
def range_edge(x_i, x_j, r, a_i, a_j):
    dx, dy = x_j[:2] - x_i[:2]
    q = np.hypot(dx, dy)
    return q - r, np.array([-dx / q, -dy / q, 0.0]), np.array([dx / q, dy / q, 0.0])
""",
    "the same, the arm turned by R": """
def range_edge(x_i, x_j, r, a_i, a_j):
    d = x_j[:2] + a_j - x_i[:2] - a_i
    q = np.hypot(*d)
    return q - r, np.append(-d / q, 0.0), np.append(d / q, 0.0)
""",
}
