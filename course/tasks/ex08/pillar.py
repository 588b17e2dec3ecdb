"""Programs of 08-pillar."""

from course.tasks import Slip, Stumble
from course.tasks.ex08 import ways

TASK = "08-pillar"
WAYS = ways.PILLAR

_INSIDE = "np.abs(np.hypot(*(points - centre).T) - radius) <= band"
_RADIUS = "np.sqrt(d + centre[0] ** 2 + centre[1] ** 2)"
_CENTRE = "return np.array(centre), "
_END = "return *fit_circle(points[best]), best"
_BETTER = "if radius <= largest and inside.sum() > best.sum():"

SLIPS = (
    Slip(
        "two-forgotten",
        "The 2 before c·p is missing, so the centre comes out twice as far away. Multiply |p − c|² out "
        "once more.",
        ("[2 * points, np.ones", "[points, np.ones"),
    ),
    Slip(
        "d-sign",
        "The sign of d in the radius is turned: d = r² − |c|².",
        (_RADIUS, "np.sqrt(np.abs(centre[0] ** 2 + centre[1] ** 2 - d))"),
        (_RADIUS, "np.sqrt(np.abs(d - centre[0] ** 2 - centre[1] ** 2))"),
    ),
    Slip(
        "d-is-radius",
        "d is not the radius: d = r² − |c|², so the centre's place has to be added back before the root.",
        (_RADIUS, "np.sqrt(np.abs(d))"),
        (_RADIUS, "abs(d)"),
    ),
    Slip(
        "radius-squared",
        "This is r². The radius is its root.",
        (_RADIUS, "d + centre[0] ** 2 + centre[1] ** 2"),
    ),
    Slip(
        "diameter",
        "This is the diameter. The radius is half of it.",
        (_RADIUS, "2 * " + _RADIUS),
    ),
    Slip(
        "centroid",
        "The centroid of the readings is no centre: they are all on the side that is seen.",
        (_CENTRE, "return points.mean(axis=0), "),
        """
def fit_circle(points):
    centre = points.mean(axis=0)
    return centre, np.mean(np.hypot(*(points - centre).T))
""",
    ),
    Slip(
        "mean-distance",
        "This radius is the mean distance from the centre. That is nearly it; the least squares of the "
        "task give r² = d + |c|².",
        (_RADIUS, "np.mean(np.hypot(*(points - centre).T))"),
    ),
    Slip(
        "three-only",
        "The circle goes through the first three of the points, whatever the others say. All of them "
        "count.",
        ("A = np.column_stack", "points = points[:3]\n    A = np.column_stack"),
    ),
    Slip(
        "not-squared",
        "On the right of the equation stands |p|², not |p|.",
        ("np.sum(points**2, axis=1)", "np.hypot(*points.T)"),
    ),
    Slip(
        "d-left-out",
        "d is an unknown, too. Without its column of ones the circle has to pass through the origin, "
        "where the robot stands.",
        ("np.ones(len(points))", "np.zeros(len(points))"),
    ),
    Slip(
        "no-abs",
        "Readings inside the circle are counted as well, however deep: their distance less the radius "
        "is below zero, and so below the band. Take the absolute value.",
        (_INSIDE, "np.hypot(*(points - centre).T) - radius <= band"),
        (_INSIDE, "np.hypot(*(points - centre).T) <= radius + band"),
    ),
    Slip(
        "band-rooted",
        "The band is a distance: compare it with distances, not with their squares.",
        (_INSIDE, "(np.hypot(*(points - centre).T) - radius) ** 2 <= band"),
    ),
    Slip(
        "not-refitted",
        "The circle goes exactly through three of the readings: it is the guess itself. Refit it on all "
        "that agreed; their errors average out.",
        [
            (_BETTER, _BETTER + "\n            guess = centre, radius"),
            (_END, "return *guess, best"),
        ],
    ),
    Slip(
        "refitted-on-all",
        "The circle was refitted on all readings, also on those that did not agree.",
        (_END, "return *fit_circle(points), best"),
    ),
    Slip(
        "refitted-on-three",
        "The circle was refitted on some of the readings only: all that agreed count.",
        (_END, "return *fit_circle(points[best][:3]), best"),
    ),
    Slip(
        "never-none",
        "Some circle always has a few readings on it. Where the best guess has fewer than needed, there "
        "is no pillar, and the answer is None.",
        ("if best.sum() < needed:", "if best.sum() < 3:"),
    ),
    Slip(
        "other-band",
        "Readings count that should not, or the other way round: one counts where it is within band of the "
        "circle, on either side, however large the circle is.",
        *(
            (" <= band\n", f" <= {band}\n")
            for band in ("band / 2", "2 * band", "band * radius", "band**2")
        ),
    ),
    Slip(
        "always-none",
        "Your function finds no pillar anywhere: does it end with a return, is the best guess kept, is its "
        "count compared the right way round, and is it the distance from the *circle* that is compared with "
        "the band?",
        (_INSIDE, "np.hypot(*(points - centre).T) <= band"),
        ("if best.sum() < needed:", "if True:"),
        (_BETTER, "if radius <= largest and inside.sum() < best.sum():"),
    ),
    Slip(
        "one-more-needed",
        "A pillar that just as many readings agree on as are needed is one.",
        ("if best.sum() < needed:", "if best.sum() <= needed:"),
    ),
    Slip(
        "inverted",
        "inside marks the readings that are not on the pillar: it is True for those within the band.",
        (_END, "return *fit_circle(points[best]), ~best"),
    ),
    Slip(
        "any-size",
        "Walls were found: a circle of many metres lies along a wall as well as a line does. A guess "
        "above `largest` does not count.",
        (_BETTER, "if inside.sum() > best.sum():"),
        (_BETTER, "if radius <= 1e3 * largest and inside.sum() > best.sum():"),
    ),
    Slip(
        "largest-diameter",
        "`largest` is compared with the diameter, or with half of the radius: it is a radius itself.",
        (_BETTER, "if 2 * radius <= largest and inside.sum() > best.sum():"),
    ),
    Slip(
        "size-at-the-end",
        "The size was looked at after the election: by then a wall had won it, and the pillar was "
        "forgotten. A guess that is too large must not stand.",
        [
            (_BETTER, "if inside.sum() > best.sum():"),
            (
                "if best.sum() < needed:",
                "if best.sum() < needed or fit_circle(points[best])[1] > largest:",
            ),
        ],
    ),
    Slip(
        "smallest",
        "The size is the wrong way round: `largest` is the largest radius of a pillar.",
        (_BETTER, "if radius >= largest and inside.sum() > best.sum():"),
    ),
    Slip(
        "last-guess",
        "Of all guesses the one with the most readings has to win, not the last one.",
        (_BETTER, "if radius <= largest:"),
    ),
    Slip(
        "first-guess",
        "The loop ends with the first guess. Of all guesses the one with the most readings has to win.",
        ("            best = inside", "            best = inside\n            break"),
    ),
    Slip(
        "drawn-twice",
        "The same reading may be drawn twice, and then there is no circle: draw three *different* ones.",
        (", replace=False", ""),
    ),
    Slip(
        "singular",
        "Three readings that lie exactly on one line have no circle, and np.linalg.solve fails. Such a "
        "guess has to be passed over.",
        [
            ("        if abs(ax * by - ay * bx) < 1e-9:\n            continue\n", ""),
            (
                "centre, radius = fit_circle(three)",
                "*centre, d = np.linalg.solve(np.c_[2 * three, np.ones(3)], (three**2).sum(axis=1))\n"
                "        radius = np.sqrt(d + centre[0] ** 2 + centre[1] ** 2)",
            ),
        ],
        ("            continue\n", "            return None\n"),
    ),
    Slip(
        "too-few",
        "Of fewer than three readings none can be drawn: ask for their number first.",
        ("    if len(points) < 3:\n        return None\n", ""),
    ),
    Slip(
        "in-place",
        "The points are changed in place: work on a copy of them.",
        ("A = np.column_stack", "points -= points.mean(axis=0)\n    A = np.column_stack"),
        ("    best = np.zeros", "    rng.shuffle(points)\n    best = np.zeros"),
    ),
)

STUMBLES = (
    Stumble("malformed", (_END, "return fit_circle(points[best])")),
    Stumble("malformed", (_END, "return *fit_circle(points[best]), np.flatnonzero(best)")),
    Stumble("malformed", (_CENTRE, "return centre[0], centre[1], ")),
    Stumble("raised", ("len(points), 3, replace", "len(points), 2, replace")),
    Stumble("not attempted", "def find_pillar(*_):\n    raise NotImplementedError"),
    Stumble("missing", "del fit_circle"),
)

PASTED = {
    "RANSAC for lines": """
def fit_circle(points):
    centre = points.mean(axis=0)
    x, y = (points - centre).T
    alpha = 0.5 * np.arctan2(-2 * x @ y, y @ y - x @ x)
    return np.array([np.cos(alpha), np.sin(alpha)]), centre @ [np.cos(alpha), np.sin(alpha)]

def find_pillar(points, band, largest, needed, tries, rng):
    best = np.zeros(len(points), dtype=bool)
    for _ in range(tries if len(points) > 1 else 0):
        normal, rho = fit_circle(points[rng.choice(len(points), 2, replace=False)])
        inside = np.abs(points @ normal - rho) <= band
        if inside.sum() > best.sum():
            best = inside
    if best.sum() < needed:
        return None
    return *fit_circle(points[best]), best
""",
    "the line of this notebook": """
def fit_circle(points):
    rho, alpha = fit_line(points)
    return rho * np.array([np.cos(alpha), np.sin(alpha)]), rho

def find_pillar(points, band, largest, needed, tries, rng):
    return (*fit_circle(points), np.ones(len(points), dtype=bool)) if len(points) > 2 else None
""",
}

EQUIVALENT = {
    "<= band": "no reading is exactly at the band: within it or not is then the same",
    "<= largest": "no radius is exactly the largest",
    "> largest": "no radius is exactly the largest",
    "1e-09": "another limit for readings on one line: those nearly on one have too large a circle",
    "1e-10": "another limit for readings on one line: those nearly on one have too large a circle",
    "(tries)": "one guess less of a hundred: the pillar was found by some other",
}

MUTANTS = 100
