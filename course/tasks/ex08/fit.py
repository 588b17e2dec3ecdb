"""Programs of 08-fit-line."""

from course.tasks import Edit, Slip, Stumble
from course.tasks.ex08 import ways
from slamlab.exercises.tasks.ex08.fit import HALF_TURN

TASK = "08-fit-line"
WAYS = ways.FIT

_SCHOOL = """
def fit_line(points):
    x, y = points.T
    a, b = np.polyfit(x, y, 1)
    rho, alpha = b / np.hypot(1, a), np.arctan2(1, -a)
    return (rho, alpha) if rho >= 0 else (-rho, wrap(alpha + np.pi))
"""
_SCHOOL_OF_X = """
def fit_line(points):
    x, y = points.T
    a, b = np.polyfit(y, x, 1)
    rho, alpha = b / np.hypot(1, a), np.arctan2(-a, 1)
    return (rho, alpha) if rho >= 0 else (-rho, wrap(alpha + np.pi))
"""
_EITHER = """
def fit_line(points):
    x, y = points.T
    if np.var(x) > np.var(y):
        a, b = np.polyfit(x, y, 1)
        rho, alpha = b / np.hypot(1, a), np.arctan2(1, -a)
    else:
        a, b = np.polyfit(y, x, 1)
        rho, alpha = b / np.hypot(1, a), np.arctan2(-a, 1)
    return (rho, alpha) if rho >= 0 else (-rho, wrap(alpha + np.pi))
"""
_ENDS = """
def fit_line(points):
    way = points[1] - points[0]
    normal = np.array([-way[1], way[0]]) / np.hypot(*way)
    rho = normal @ points[0]
    normal, rho = (normal, rho) if rho >= 0 else (-normal, -rho)
    return rho, np.arctan2(normal[1], normal[0])
"""

SLIPS = (
    Slip(
        "school",
        "This is y = a x + b: it measures distances along y, and fails where the wall is steep. "
        "Measure them across the line.",
        _SCHOOL,
    ),
    Slip(
        "school-of-x",
        "This is x = a y + b: it measures distances along x, and fails for walls beside the robot. "
        "Measure them across the line.",
        _SCHOOL_OF_X,
    ),
    Slip(
        "better-slope",
        "To choose the better of y = a x + b and x = a y + b is never quite right at a slant: both "
        "measure distances along an axis. Measure them across the line.",
        _EITHER,
    ),
    Slip(
        "two-points-only",
        "The line goes through two of the points, whatever the others say. All of them count.",
        _ENDS,
        _ENDS.replace("points[1] - points[0]", "points[-1] - points[0]"),
        """
def fit_line(points):
    along = points[-1] - points[0]
    normal = np.array([-along[1], along[0]]) / np.hypot(*along)
    rho = normal @ points.mean(axis=0)
    if rho < 0:
        rho, normal = -rho, -normal
    return rho, np.arctan2(normal[1], normal[0])
""",
    ),
    Slip(
        "not-centred",
        "The scatter is measured about the origin. Take the centroid off before you sum squares and "
        "products: the line goes through the centroid.",
        ("off = points - centre", "off = points"),
        Edit("the angle in closed form", (("(points - centre).T", "points.T"),)),
    ),
    Slip(
        "one-mean",
        "`points.mean()` without an axis is one number, the mean of all x and y together. The centroid "
        "has an x and a y.",
        ("points.mean(axis=0)", "np.full(2, points.mean())"),
    ),
    Slip(
        "first-point",
        "The scatter is measured about the first point. The best line need not go through that one; it "
        "does go through the centroid.",
        ("off = points - centre", "off = points - points[0]"),
        ("points.mean(axis=0)", "points[0]"),
    ),
    Slip(
        "median",
        "The line goes through the median of the points. That is no bad idea with outliers, but the "
        "least sum of *squares* is reached through the mean.",
        ("points.mean(axis=0)", "np.median(points, axis=0)"),
    ),
    Slip(
        "along",
        "α is 90° off: this is the direction in which the points scatter most, along the wall. The "
        "normal is the one in which they scatter least (`eigh` sorts its eigenvalues upwards, `svd` "
        "downwards).",
        ("vectors[:, 0]", "vectors[:, 1]"),
        Edit("the angle in closed form", (("y @ y - x @ x", "x @ x - y @ y"),)),
        Edit("singular value decomposition", (("[2][1]", "[2][0]"),)),
    ),
    Slip(
        "half-forgotten",
        "atan2(−2 S_ab, S_bb − S_aa) is 2α: take half of it.",
        Edit("the angle in closed form", (("0.5 * np", "np"),)),
    ),
    Slip(
        "doubled",
        "atan2(−2 S_ab, S_bb − S_aa) is 2α: take half of it, not twice.",
        Edit("the angle in closed form", (("0.5 * np", "2 * np"),)),
    ),
    Slip(
        "two-forgotten",
        "The 2 before S_ab is missing: tan 2α = 2 S_ab / (S_aa − S_bb).",
        Edit("the angle in closed form", (("-2 * (x @ y)", "-(x @ y)"),)),
    ),
    Slip(
        "cross-sign",
        "The sign before S_ab is turned: the line you get leans to the other side. It is "
        "½ atan2(−2 S_ab, S_bb − S_aa).",
        Edit("the angle in closed form", (("-2 * (x @ y)", "2 * (x @ y)"),)),
    ),
    Slip(
        "arctan",
        "Half of arctan of the quotient is the normal for some walls and the wall's own direction for "
        "others. Give atan2 both signs: ½ atan2(−2 S_ab, S_bb − S_aa).",
        Edit(
            "the angle in closed form",
            (
                (
                    "np.arctan2(-2 * (x @ y), y @ y - x @ x)",
                    "np.arctan(2 * (x @ y) / (x @ x - y @ y))",
                ),
            ),
        ),
    ),
    Slip(
        "x-for-y",
        "The arguments of arctan2 have changed places: it takes y first, then x.",
        ("np.arctan2(normal[1], normal[0])", "np.arctan2(normal[0], normal[1])"),
    ),
    Slip(
        "arctan-of-normal",
        "arctan of the quotient knows nothing of the signs of y and x: half of all directions come out "
        "opposite. Use arctan2.",
        ("np.arctan2(normal[1], normal[0])", "np.arctan(normal[1] / normal[0])"),
    ),
    Slip(
        "swapped",
        "ρ and α have changed places: ρ comes first.",
        ("return rho, alpha", "return alpha, rho"),
    ),
    Slip(
        "degrees",
        "α is in degrees. The course measures angles in radians.",
        ("return rho, alpha", "return rho, np.degrees(alpha)"),
        [
            ("return rho, alpha", "return rho, np.degrees(np.arctan2(normal[1], normal[0]))"),
            ("rho, alpha = -rho, wrap(alpha + np.pi)", "rho, normal = -rho, -normal"),
        ],
    ),
    Slip(
        "negative",
        "The line is right, but ρ is negative for some walls. An eigenvector has no sign: where ρ comes "
        "out negative, turn the normal by π, and ρ changes its sign.",
        ("if rho < 0:", "if False:"),
    ),
    Slip(
        "negative-always",
        "The condition is turned round: it is where ρ is negative that the normal has to be turned.",
        ("if rho < 0:", "if rho > 0:"),
    ),
    Slip(
        HALF_TURN.name,
        HALF_TURN.hint,
        ("rho, alpha = -rho, wrap(alpha + np.pi)", "rho = abs(rho)"),
        ("rho, alpha = -rho, wrap(alpha + np.pi)", "alpha = wrap(alpha + np.pi)"),
    ),
    Slip(
        "mirrored",
        "Where ρ came out negative, α was turned by its sign: −α is the mirror image. The opposite "
        "direction is α + π.",
        ("wrap(alpha + np.pi)", "-alpha"),
    ),
    Slip(
        "quarter-turn",
        "Where ρ came out negative, α was turned by a quarter. The opposite direction is half a turn "
        "away.",
        ("wrap(alpha + np.pi)", "wrap(alpha + np.pi / 2)"),
    ),
    Slip(
        "centroid's-distance",
        "This ρ is how far the centroid is from the origin. ρ is the distance of the *line*: how far "
        "the centroid is along the normal.",
        ("normal @ centre", "np.hypot(*centre)"),
    ),
    Slip(
        "foot",
        "This α is the direction to the centroid. The wall is seen to one side, so its normal points "
        "elsewhere.",
        ("np.arctan2(normal[1], normal[0])", "np.arctan2(centre[1], centre[0])"),
    ),
    Slip(
        "fixed-count",
        "Only some of the points are used: there may be two of them, or a hundred.",
        ("centre = points.mean(axis=0)", "points = points[:12]\n    centre = points.mean(axis=0)"),
        ("centre = points.mean(axis=0)", "points = points[:10]\n    centre = points.mean(axis=0)"),
    ),
    Slip(
        "divided-by-n",
        "The sum is divided by a number of points that is not theirs: use len(points), or mean.",
        ("points.mean(axis=0)", "points.sum(axis=0) / 12"),
        ("points.mean(axis=0)", "points.sum(axis=0) / (len(points) - 1)"),
    ),
    Slip(
        "rounded",
        "Numbers are rounded on the way. Leave all digits to the end.",
        ("return rho, alpha", "return round(rho, 2), round(alpha, 2)"),
        ("return rho, alpha", "return int(rho), int(alpha)"),
    ),
)

STUMBLES = (
    Stumble("malformed", "def fit_line(points):\n    pass"),
    Stumble("malformed", ("return rho, alpha", "return rho")),
    Stumble("malformed", ("return rho, alpha", "return np.nan, alpha")),
    Stumble("malformed", ("return rho, alpha", "return normal, rho, alpha")),
    Stumble("raised", ("vectors[:, 0]", "vectors[:, 2]")),
    Stumble("not attempted", "def fit_line(points):\n    raise NotImplementedError"),
    Stumble("missing", "del fit_line"),
)

EQUIVALENT = {
    "grid": "the search begins elsewhere, or on a finer or coarser grid, and ends at the same place",
    "width": "the search takes other steps, and ends as near to the same place",
    "range(50)": "one step of the search more or less",
    "-> cost = lambda a: np.mean": "a mean is least where the sum is, but for rounding",
}
