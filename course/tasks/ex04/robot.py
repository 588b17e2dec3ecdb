"""Programs of 04-h-robot: H of range and bearing by the robot's pose."""

from course.tasks import Slip, Stumble

TASK = "04-h-robot"

WAYS = {
    "central differences": """
def H_robot(x, p):
    steps = 1e-6 * np.eye(3)
    H = np.column_stack([h(x + step, p) - h(x - step, p) for step in steps])
    H[1] = (H[1] + np.pi) % (2 * np.pi) - np.pi
    return H / 2e-6
""",
    "one-sided differences": """
def H_robot(x, p, step=1e-6):
    here = h(x, p)
    H = np.array([h(x + step * one, p) - here for one in np.eye(3)]).T
    return np.array([H[0], np.arcsin(np.sin(H[1]))]) / step
""",
    "complex step": """
def H_robot(x, p, e=1e-30):
    def see(x):
        dx, dy = p[0] - x[0], p[1] - x[1]
        return np.array([np.sqrt(dx**2 + dy**2), np.arctan(dy / dx) - x[2]])
    return np.column_stack([np.imag(see(x + 1j * e * one)) / e for one in np.eye(3)])
""",
    "sympy": """
import functools
import sympy as sp

@functools.cache
def derived():
    x, y, t, a, b = sp.symbols("x y t a b", real=True)
    model = sp.Matrix([sp.sqrt((a - x)**2 + (b - y)**2), sp.atan2(b - y, a - x) - t])
    return sp.lambdify([(x, y, t), (a, b)], model.jacobian([x, y, t]))

def H_robot(x, p):
    return derived()(x, p)
""",
    "unit vectors, as a list": """
def H_robot(x, p):
    offset = np.subtract(p, x[:2])
    r = np.linalg.norm(offset)
    c, s = offset / r
    return [[-c, -s, 0], [s / r, -c / r, -1]]
""",
    "from range and bearing": """
def H_robot(x, p):
    r, bearing = h(x, p)
    c, s = np.cos(x[2] + bearing), np.sin(x[2] + bearing)
    H = np.zeros((2, 3))
    H[0, :2] = -c, -s
    H[1] = s / r, -c / r, -1
    return H
""",
}

ROWS = "[[-dx / r, -dy / r, 0], [dy / q, -dx / q, -1]]"
RANGE, BEARING = "[-dx / r, -dy / r, 0]", "[dy / q, -dx / q, -1]"


def _returns(rows):
    return (
        f"return np.array({ROWS})",
        f"H = np.array({ROWS})\n    L = -H[:, :2]\n    return {rows}",
    )


SLIPS = (
    Slip(
        "by-landmark",
        "All position entries have the wrong sign: this is what happens when the landmark moves. "
        "Here the robot moves: does a step towards the landmark make the range grow?",
        ("p[0] - x[0], p[1] - x[1]", "x[0] - p[0], x[1] - p[1]"),
        _returns("-H"),
        (ROWS, "[[dx / r, dy / r, 0], [-dy / q, dx / q, 0]]"),
    ),
    Slip(
        "rows-swapped",
        "The rows have changed places: z is range first, bearing second.",
        (ROWS, f"[{BEARING}, {RANGE}]"),
    ),
    Slip(
        "xy-exchanged",
        "dx and dy have changed places. Test your H on a landmark straight ahead of a robot with θ = 0: "
        "what does one step towards it do to the range, and what to the bearing?",
        (ROWS, "[[-dy / r, -dx / r, 0], [dx / q, -dy / q, -1]]"),
        (ROWS, "[[-dy / r, -dx / r, 0], [dx / q, dy / q, -1]]"),
        (BEARING, "[dx / q, -dy / q, -1]"),
        (BEARING, "[-dx / q, dy / q, -1]"),
        (RANGE, "[-dy / r, -dx / r, 0]"),
        ("dx, dy = p[0] - x[0], p[1] - x[1]", "dy, dx = p[0] - x[0], p[1] - x[1]"),
    ),
    Slip(
        "r-for-r2",
        "The bearing row has the wrong power of r. Look at its unit: radians per metre. dx is in "
        "metres; by what must it be divided?",
        (BEARING, "[dy / r, -dx / r, -1]"),
        (BEARING, "[dy / r**3, -dx / r**3, -1]"),
        (BEARING, "[dy / q**2, -dx / q**2, -1]"),
        (BEARING, "[dy, -dx, -1]"),
    ),
    Slip(
        "r2-for-r",
        "The range row has the wrong power of r. Metres of range per metre of motion have no unit: "
        "look at what dx is divided by.",
        (RANGE, "[-dx / q, -dy / q, 0]"),
        (RANGE, "[-dx, -dy, 0]"),
        (RANGE, "[-dx / np.sqrt(r), -dy / np.sqrt(r), 0]"),
    ),
    Slip(
        "root-missing",
        "Both rows are divided by the wrong power of the distance. Which of your names holds r, and "
        "which r²?",
        ("q = dx**2 + dy**2", "q = np.sqrt(dx**2 + dy**2)"),
        ("q = dx**2 + dy**2", "q = (dx**2 + dy**2)**2"),
        (ROWS, "[[-dx / q, -dy / q, 0], [dy / r, -dx / r, -1]]"),
    ),
    Slip(
        "no-squares",
        "The distance is not the root of dx + dy, nor their sum: Pythagoras adds squares.",
        ("q = dx**2 + dy**2", "q = abs(dx + dy)"),
        ("q = dx**2 + dy**2", "q = (dx + dy)**2"),
        ("q = dx**2 + dy**2", "q = abs(dx) + abs(dy)"),
        ("q = dx**2 + dy**2", "q = abs(dx**2 - dy**2)"),
    ),
    Slip(
        "cut",
        "Where the landmark is straight behind, the bearings from two places a hair apart may differ by "
        "a full turn: wrap their difference before you divide it.",
        """
def H_robot(x, p):
    steps = 1e-6 * np.eye(3)
    return np.column_stack([(h(x + step, p) - h(x - step, p)) / 2e-6 for step in steps])
""",
        """
def H_robot(x, p, step=1e-6):
    here = h(x, p)
    return np.array([(h(x + step * one, p) - here) / step for one in np.eye(3)]).T
""",
    ),
    Slip(
        "degrees",
        "The bearing row is in degrees. A derivative of atan2 is in radians, and so are all angles "
        "here.",
        _returns("np.array([H[0], np.degrees(H[1])])"),
        _returns("np.array([H[0], [*np.degrees(H[1, :2]), -1]])"),
        _returns("np.array([H[0], [*np.radians(H[1, :2]), -1]])"),
    ),
    Slip(
        "heading-degrees",
        "The heading column changes per radian of heading, not per degree: no factor belongs there.",
        _returns("H * [1, 1, np.pi / 180]"),
        _returns("H * [1, 1, 180 / np.pi]"),
    ),
    Slip(
        "bearing-sign",
        "The bearing row has the wrong sign: bearings count counter-clockwise. The landmark is ahead "
        "and the robot steps to its left: on which side is the landmark now?",
        (BEARING, "[-dy / q, dx / q, 1]"),
        (BEARING, "[-dy / q, dx / q, -1]"),
    ),
    Slip(
        "printed-2",
        "One sign is wrong, the one that Smolec's (2) prints wrongly: the bearing row's second entry. "
        "Robot at the origin, landmark at (1, 0): a step along +y, and the bearing becomes …?",
        (BEARING, "[dy / q, dx / q, -1]"),
    ),
    Slip(
        "heading-missing",
        "The bearing does not change with the heading in your H. Turn the robot left on the spot: "
        "what happens to the bearing of a landmark?",
        (BEARING, "[dy / q, -dx / q, 0]"),
    ),
    Slip(
        "heading-sign",
        "The sign of the heading's entry: the robot turns left, and the landmark drifts to its right.",
        (BEARING, "[dy / q, -dx / q, 1]"),
    ),
    Slip(
        "heading-not-derived",
        "The heading itself, or its sine or cosine, stands where its derivative should: by how much "
        "does the bearing change for each radian that the robot turns?",
        (BEARING, "[dy / q, -dx / q, -x[2]]"),
        (BEARING, "[dy / q, -dx / q, -np.cos(x[2])]"),
        (BEARING, "[dy / q, -dx / q, -np.sin(x[2])]"),
    ),
    Slip(
        "range-by-heading",
        "Your range changes when the robot turns on the spot. Does a turn bring any landmark nearer?",
        (RANGE, "[-dx / r, -dy / r, -1]"),
        (RANGE, "[-dx / r, -dy / r, 1]"),
        (RANGE, "[-dx / r, -dy / r, (dy * np.cos(x[2]) - dx * np.sin(x[2])) / r]"),
    ),
    Slip(
        "robot-frame",
        "The derivatives are along the robot's own axes, ahead and left. x and y of a pose are "
        "coordinates of the world, and so must dx and dy be.",
        (
            "q = dx**2",
            "c, s = np.cos(x[2]), np.sin(x[2])\n    dx, dy = c * dx + s * dy, c * dy - s * dx\n    q = dx**2",
        ),
    ),
    Slip(
        "pose-forgotten",
        "The landmark's coordinates stand where its offset from the robot should: H must not change "
        "when robot and landmark are shifted together.",
        ("p[0] - x[0], p[1] - x[1]", "p[0], p[1]"),
    ),
    Slip(
        "sign",
        "Every entry has the right size, and a sign is wrong. Move the robot a little along +x, then "
        "along +y, and think through whether range and bearing grow or shrink.",
        (RANGE, "[-dx / r, dy / r, 0]"),
        (RANGE, "[dx / r, -dy / r, 0]"),
        (RANGE, "[dx / r, dy / r, 0]"),
        (BEARING, "[-dy / q, -dx / q, -1]"),
    ),
    Slip(
        "whole-numbers",
        "The result is rounded to whole numbers: derivatives are not.",
        _returns("H.round()"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        _returns("H.T"),
        _returns("np.hstack([H, L])"),
        _returns("H * np.nan"),
        _returns("H[:, :2]"),
        _returns("None"),
        _returns("'H'"),
    ),
    Stumble("raised", ("p[1] - x[1]", "p[2] - x[1]")),
)

EQUIVALENT = {
    "step=1e-06): -> def H_robot(x, p, step=": "a step half or twice as long, or backwards, serves too",
}
