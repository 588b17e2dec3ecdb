"""Right ways and slips of 02-ray-wall."""

from course.tasks import Edit, Slip, Stumble
from course.tasks.ex02 import ray_ways
from slamlab.exercises.tasks.ex02.ray import NEVER_MET

TASK = "02-ray-wall"

WAYS = ray_ways.WAYS

U = "u_x, u_y = np.cos(phi), np.sin(phi)"
W = "w_x, w_y = wall[2] - wall[0], wall[3] - wall[1]"
D = "d_x, d_y = wall[0] - p[0], wall[1] - p[1]"
DETERMINANT = "determinant = u_x * w_y - u_y * w_x"
NONE = "if determinant == 0:"
T, SHARE = "t = (d_x * w_y - d_y * w_x) / determinant", "s = (d_x * u_y - d_y * u_x) / determinant"
HIT = "return t if t >= 0 and 0 <= s <= 1 else np.inf"


def hit(condition, value="t"):
    return HIT, f"return {value} if {condition} else np.inf"


SLIPS = (
    Slip(
        "behind-accepted",
        "A wall behind the sensor is reported: the lines cross there, but the beam flies forward only. "
        "Which of your numbers says on which side of the sensor the crossing is?",
        hit("0 <= s <= 1"),
        hit("0 <= s <= 1", "abs(t)"),
        [(T, "t = abs((d_x * w_y - d_y * w_x) / determinant)")],
        before=("behind-only",),
    ),
    Slip(
        "directions-as-numbers",
        "Whether a wall is met is decided by comparing directions as numbers. They jump by 2π behind the "
        "sensor, so a wall that lies across that jump is missed, and others are met that are not there.",
        """
def ray_wall(p, phi, wall):
    (x1, y1), (x2, y2) = wall[:2] - p, wall[2:] - p
    ends = sorted([np.arctan2(y1, x1), np.arctan2(y2, x2)])
    if not ends[0] <= np.arctan2(np.sin(phi), np.cos(phi)) <= ends[1]:
        return np.inf
    towards = (y1 - y2) * np.cos(phi) + (x2 - x1) * np.sin(phi)
    return ((y1 - y2) * x1 + (x2 - x1) * y1) / towards if abs(towards) > 1e-12 else np.inf
""",
        """
def ray_wall(p, phi, wall):
    (x1, y1), (x2, y2) = wall[:2] - p, wall[2:] - p
    ends = sorted([np.arctan2(y1, x1), np.arctan2(y2, x2)])
    if not ends[0] <= phi <= ends[1]:
        return np.inf
    towards = (y1 - y2) * np.cos(phi) + (x2 - x1) * np.sin(phi)
    return ((y1 - y2) * x1 + (x2 - x1) * y1) / towards if abs(towards) > 1e-12 else np.inf
""",
        shaky=True,  # a wall along the beam: what is left of a difference decides
    ),
    Slip(
        "endless-wall",
        "You meet the wall's line even where the wall has ended long before. Which of your numbers says "
        "where on the wall the crossing is, and between what must it lie?",
        hit("t >= 0"),
        hit("t > 0"),
        hit("t >= 0 and -1 <= s <= 1"),
        hit("t >= 0 and abs(s) <= 2"),
    ),
    Slip(
        "one-end-open",
        "The wall ends at one side only: it has a beginning and an end, and the beam must pass between "
        "them.",
        hit("t >= 0 and s <= 1"),
        hit("t >= 0 and s >= 0"),
    ),
    Slip(
        "lines-only",
        "That is where the two lines cross, wherever that is: the beam begins at p, and the wall has "
        "two ends.",
        (HIT, "return t"),
        (HIT, "return abs(t)"),
    ),
    Slip(
        NEVER_MET.name,
        NEVER_MET.hint,
        (D, "d_x, d_y = p[0] - wall[0], p[1] - wall[1]"),
        (DETERMINANT, "determinant = u_y * w_x - u_x * w_y"),
    ),
    Slip(
        "looks-backwards",
        "You meet the walls behind the sensor and miss those before it: the distance along the beam has "
        "the wrong sign.",
        (T, "t = -(d_x * w_y - d_y * w_x) / determinant"),
        hit("t <= 0 and 0 <= s <= 1", "-t"),
    ),
    Slip(
        "behind-only",
        "The inequality is turned: r below zero means that the wall stands behind the sensor.",
        hit("t < 0 and 0 <= s <= 1"),
    ),
    Slip(
        "share-returned",
        "That is where on the wall the beam meets it (a share from 0 to 1), not how far it flew to "
        "get there.",
        hit("t >= 0 and 0 <= s <= 1", "s"),
    ),
    Slip(
        "conditions-swapped",
        "The conditions have changed places: r is a way in metres and may be as large as it likes, τ is "
        "the share of the wall.",
        hit("s >= 0 and 0 <= t <= 1"),
        hit("0 <= t <= 1 and 0 <= s <= 1"),
    ),
    Slip(
        "degrees",
        "Angles are in radians: np.cos and np.sin take phi as it is.",
        (U, "u_x, u_y = np.cos(np.degrees(phi)), np.sin(np.degrees(phi))"),
        (U, "u_x, u_y = np.cos(np.radians(phi)), np.sin(np.radians(phi))"),
    ),
    Slip(
        "sine-and-cosine-swapped",
        "Sine and cosine have changed places: a beam with phi = 0 flies along +x.",
        (U, "u_x, u_y = np.sin(phi), np.cos(phi)"),
    ),
    Slip(
        "clockwise",
        "Your beam turns clockwise with phi: look at the sign of its y.",
        (U, "u_x, u_y = np.cos(phi), -np.sin(phi)"),
    ),
    Slip(
        "by-its-slope",
        "A beam is more than its slope: the tangent is the same for a direction and its opposite, and it "
        "is infinite for a beam along y.",
        (U, "u_x, u_y = 1 / np.hypot(1, np.tan(phi)), np.sin(np.arctan(np.tan(phi)))"),
        (U, "u_x, u_y = 1.0, np.tan(phi)"),
    ),
    Slip(
        "columns-mistaken",
        "A wall is x1, y1, x2, y2: first one end, then the other. You read it as x1, x2, y1, y2.",
        [
            (W, "w_x, w_y = wall[1] - wall[0], wall[3] - wall[2]"),
            (D, "d_x, d_y = wall[0] - p[0], wall[2] - p[1]"),
        ],
    ),
    Slip(
        "end-for-way",
        "x2, y2 is the wall's other end, not the way to it: the way along the wall is a difference of "
        "its two ends.",
        (W, "w_x, w_y = wall[2], wall[3]"),
        (W, "w_x, w_y = wall[2] - p[0], wall[3] - p[1]"),
    ),
    Slip(
        "from-the-wrong-end",
        "One sign of the wall's way is turned: as (02.1) has it, τ leads from p₁ to p₂, so the term with τ "
        "changes its sign when it goes to the other side.",
        (W, "w_x, w_y = wall[0] - wall[2], wall[1] - wall[3]"),
        (D, "d_x, d_y = wall[2] - p[0], wall[3] - p[1]"),
    ),
    Slip(
        "from-the-origin",
        "Your beam starts at the origin: where is p?",
        (D, "d_x, d_y = wall[0], wall[1]"),
    ),
    Slip(
        "plus-in-a-determinant",
        "A determinant is a difference: one diagonal's product minus the other's.",
        (DETERMINANT, "determinant = u_x * w_y + u_y * w_x"),
        (T, "t = (d_x * w_y + d_y * w_x) / determinant"),
        (SHARE, "s = (d_x * u_y + d_y * u_x) / determinant"),
    ),
    Slip(
        "not-divided",
        "r and τ are quotients: both are divided by the determinant.",
        (T, "t = d_x * w_y - d_y * w_x"),
        (SHARE, "s = d_x * u_y - d_y * u_x"),
    ),
    Slip(
        "numerators-swapped",
        "r and τ have changed places: for r, the beam's column of the matrix is replaced by the right side, "
        "and the wall's column is left.",
        [
            (T, "t = (d_x * u_y - d_y * u_x) / determinant"),
            (SHARE, "s = (d_x * w_y - d_y * w_x) / determinant"),
        ],
    ),
    Slip(
        "straight-to-the-wall",
        "That is how far the wall's beginning, its middle or its line is from p. How far is it in the "
        "direction of the beam?",
        hit("t >= 0 and 0 <= s <= 1", "np.hypot(d_x, d_y)"),
        hit("t >= 0 and 0 <= s <= 1", "np.hypot(d_x + w_x / 2, d_y + w_y / 2)"),
        hit("t >= 0 and 0 <= s <= 1", "abs(d_x * w_y - d_y * w_x) / np.hypot(w_x, w_y)"),
    ),
    Slip(
        "place-returned",
        "That is one coordinate of the place that is met, not the way to it.",
        hit("t >= 0 and 0 <= s <= 1", "t * u_x"),
        hit("t >= 0 and 0 <= s <= 1", "p[0] + t * u_x"),
    ),
    Slip(
        "nearly-parallel",
        "Walls that are met at a slant are taken for parallel, or short ones: the determinant is the "
        "sine of the angle times the wall's length. Only zero is parallel.",
        (NONE, "if abs(determinant) < 0.3:"),
        (NONE, "if abs(determinant) < 0.02:"),
    ),
    Slip(
        "singular",
        "Parallel lines have no place in common: their 2 × 2 system is singular, and solving it fails. Ask "
        "for this case before.",
        Edit("a 2×2 system", (("1e-12", "-1"),)),
    ),
    Slip(
        "parallel-met",
        "A wall that runs along the beam is reported as if it were met.",
        ("        return np.inf\n", "        return np.hypot(d_x, d_y)\n"),
        ("        return np.inf\n", "        return 0.0\n"),
    ),
    Slip(
        "along-an-axis",
        "A beam along x or y is treated as if it met nothing, or a wall along x or y. Such beams are as "
        "good as any other.",
        (NONE, "if abs(u_x * u_y) < 1e-9:"),
        (NONE, "if determinant == 0 or w_x * w_y == 0:"),
    ),
    Slip(
        "minus-infinity",
        "Minus infinity is nearer than any wall: who looks for the nearest of several takes that one.",
        ("        return np.inf\n", "        return -np.inf\n"),
        (HIT, "return t if t >= 0 and 0 <= s <= 1 else -np.inf"),
    ),
    Slip(
        "zero-for-nothing",
        "Where nothing is met you give 0: that is a wall at the sensor itself.",
        (HIT, "return t if t >= 0 and 0 <= s <= 1 else 0.0"),
    ),
    Slip(
        "largest-range",
        "A wall is left out because it is very near, or very far. No range was given to this sensor.",
        hit("0.2 <= t and 0 <= s <= 1"),
        hit("0 <= t <= 30 and 0 <= s <= 1"),
    ),
    Slip(
        "rounded",
        "The distance is rounded: no sensor was asked about yet, only geometry.",
        hit("t >= 0 and 0 <= s <= 1", "round(t, 2)"),
        hit("t >= 0 and 0 <= s <= 1", "int(t)"),
    ),
    Slip(
        "rows-for-columns",
        "Rows and columns of the matrix are swapped: an unknown belongs to a column. The beam fills the "
        "column of r, and the wall that of τ.",
        Edit(
            "a 2×2 system",
            (
                (
                    "[[np.cos(phi), wall[0] - wall[2]], [np.sin(phi), wall[1] - wall[3]]]",
                    "[[np.cos(phi), np.sin(phi)], [wall[0] - wall[2], wall[1] - wall[3]]]",
                ),
            ),
        ),
    ),
    Slip(
        "short-walls-refused",
        "Some walls count as parallel that are not: the determinant is small for every short wall, too. "
        "What is parallel for sure has zero, but for rounding.",
        (NONE, "if abs(determinant) < 0.1:"),
        (NONE, "if abs(determinant) < 0.01:"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (HIT, "return t if t >= 0 and 0 <= s <= 1 else np.nan"),
        (HIT, "return t, s"),
        (HIT, "t"),
        (HIT, "return np.array([u_x, u_y]) * t"),
    ),
    Stumble("raised", (D, "d_x, d_y = wall[0] - p.x, wall[1] - p.y")),
)

EQUIVALENT = {}
