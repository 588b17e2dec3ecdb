"""Slips of 02-echo; its right ways are in ``echo_ways``."""

from course.tasks import Edit, Slip, Stumble
from course.tasks.ex02 import echo_ways
from slamlab.exercises.tasks.ex02 import echo

TASK = "02-echo"
WAYS = echo_ways.WAYS

PLACES = "(0, 1, np.clip(-(a @ w) / (w @ w), 0, 1))"
TURNED = "a @ w / (w @ w)", "np.clip(a @ w / (w @ w), 0, 1)"
FOOT = PLACES, "(np.clip(-(a @ w) / (w @ w), 0, 1),)"
AW = "a, w = wall[:2] - p, wall[2:] - wall[:2]"
INSIDE = "if place @ axis >= np.cos(half) * distance:"
ENDS = [
    (INSIDE, f"if {some}(q @ axis >= np.cos(half) * np.hypot(*q) for q in (a, a + w)):")
    for some in ("any", "all")
]
NEARER = "                nearest = min(nearest, distance)"
RIMS = "(phi - half, phi + half)"
RIM = "nearest = min(nearest, ray_wall(p, rim, wall))"
AXIS = "axis = np.array([np.cos(phi), np.sin(phi)])"
LOOP = "for wall in walls:"
RETURN = "return nearest"
FAN = """
def echo(p, phi, half, walls):
    directions = np.linspace(phi - half, phi + half, {beams})
    ranges = [ray_wall(p, direction, wall) for direction in directions for wall in walls]
    return min(ranges, default=np.inf)
"""

SLIPS = (
    Slip(
        "axis-only",
        "You asked the cone's axis alone: what is in the cone beside the axis is heard as well.",
        FAN.format(beams=1).replace("phi - half, phi + half", "phi, phi"),
    ),
    Slip(
        echo.FAN.name,
        echo.FAN.hint,
        FAN.format(beams=25),
        FAN.format(beams=101),
    ),
    Slip(
        "rims-only",
        "You asked the two rims of the cone alone. Between them a wall may come nearer.",
        (PLACES, "()"),
        FAN.format(beams=2),
    ),
    Slip(
        "rims-forgotten",
        "Where a wall's nearest place lies outside the cone, the wall may still reach into it. Where is "
        "it heard first then?",
        (RIMS, "()"),
    ),
    Slip(
        "one-rim",
        "The cone has two rims, one to either side of the axis.",
        (RIMS, "(phi - half,)"),
        (RIMS, "(phi + half,)"),
        (RIMS, "(phi + half, phi + half)"),
    ),
    Slip(
        "axis-for-rims",
        "The axis was asked for where a wall leaves the cone: it does so at the rims.",
        (RIMS, "(phi,)"),
    ),
    Slip(
        "feet-forgotten",
        "A wall that crosses the cone is nearest where the sensor looks at it square on, if that is in "
        "the cone. Is this place among yours, and does its τ have the right sign?",
        (PLACES, "(0, 1)"),
        (PLACES, "(0, 1, np.clip(a @ w / (w @ w), 0, 1))"),
    ),
    Slip(
        "foot-turned",
        "τ has the wrong sign: w leads from the wall's first end to the other, and a from the sensor to the "
        "first. Where a and w point the same way, the foot lies before the wall.",
        *[(PLACES, f"({foot},)") for foot in TURNED],
        *[[(PLACES, f"({foot},)"), (RIMS, "()")] for foot in (*TURNED, f"0, 1, {TURNED[1]}")],
    ),
    Slip(
        "ends-in-the-cone",
        "A wall was heard only if an end of it, or both, lie in the cone. A wall may cross the cone with "
        "both ends outside.",
        *[[ends, *more] for ends in ENDS for more in ([], [(RIMS, "()")], [FOOT, (RIMS, "()")])],
        [(PLACES, "(0, 1)"), (RIMS, "()")],
    ),
    Slip(
        "ends-forgotten",
        "The end of a wall may be the nearest place: then no perpendicular meets the wall.",
        (PLACES, "(-(a @ w) / (w @ w),) if 0 <= -(a @ w) / (w @ w) <= 1 else ()"),
    ),
    Slip(
        "one-end-only",
        "A wall has two ends, and either may be the nearest place.",
        (PLACES, "(0,) + ((-(a @ w) / (w @ w),) if 0 <= -(a @ w) / (w @ w) <= 1 else ())"),
        (PLACES, "(1,) + ((-(a @ w) / (w @ w),) if 0 <= -(a @ w) / (w @ w) <= 1 else ())"),
    ),
    Slip(
        "endless-wall",
        "The foot of the perpendicular may lie beyond the wall's ends: there is nothing to be heard.",
        (PLACES, "(0, 1, -(a @ w) / (w @ w))"),
        (PLACES, "(0, 1, max(-(a @ w) / (w @ w), 0))"),
        (PLACES, "(0, 1, min(-(a @ w) / (w @ w), 1))"),
        Edit(
            "by bearings",
            (
                (
                    "if (foot - a) @ (foot - b) < 0:\n            places.append(foot)",
                    "places.append(foot)",
                ),
            ),
        ),
        shaky=True,  # of a wall that points at the sensor, whose foot is the sensor itself
    ),
    Slip(
        "nearest-place-of-each-wall-only",
        "Of each wall you ask one place, the nearest of all. Where that is beside the cone, another "
        "place of the same wall may lie inside.",
        [FOOT, (RIMS, "()")],
    ),
    Slip(
        "nearest-wall-only",
        "You choose the nearest wall first and ask then whether it is in the cone. If it is not, "
        "another one may be.",
        (
            LOOP,
            "d = [np.hypot(*(w[:2] - p + np.clip(-(w[:2] - p) @ (w[2:] - w[:2]) / ((w[2:] - w[:2]) "
            "@ (w[2:] - w[:2])), 0, 1) * (w[2:] - w[:2]))) for w in walls]\n"
            "    for wall in walls[np.argsort(d)[:1]]:",
        ),
    ),
    Slip(
        "no-cone",
        "What is beside the cone, or behind the sensor, is heard as well: where do φ and half come in?",
        (INSIDE, "if True:"),
    ),
    Slip(
        "half-a-plane",
        "All that is ahead is heard: half says how far from the axis the sensor still hears.",
        (INSIDE, "if place @ axis >= 0:"),
    ),
    Slip(
        "both-ways",
        "The cone reaches backwards, too: a place behind the sensor has its projection on the axis below "
        "zero.",
        (INSIDE, "if abs(place @ axis) >= np.cos(half) * distance:"),
        (INSIDE, "if abs(place[0] * axis[1] - place[1] * axis[0]) <= np.sin(half) * distance:"),
    ),
    Slip(
        "unwrapped",
        "A difference of two bearings is not wrapped: 179° and −179° are 2° apart.",
        (INSIDE, "if abs(np.arctan2(place[1], place[0]) - phi) <= half:"),
        Edit(
            "by bearings",
            (
                (
                    "(np.arctan2(q[1], q[0]) - phi + np.pi) % (2 * np.pi) - np.pi",
                    "np.arctan2(q[1], q[0]) - np.arctan2(np.sin(phi), np.cos(phi))",
                ),
            ),
        ),
    ),
    Slip(
        "one-sided-cone",
        "The cone lies to both sides of the axis, as wide to the left as to the right.",
        Edit("by bearings", (("if abs(bearing(q)) <= half", "if bearing(q) <= half"),)),
        Edit("by bearings", (("if abs(bearing(q)) <= half", "if 0 <= bearing(q) <= half"),)),
    ),
    Slip(
        "half-of-half",
        "half is what lies to either side of the axis already; the whole cone is twice as wide.",
        [(INSIDE, INSIDE.replace("half", "half / 2")), (RIMS, "(phi - half / 2, phi + half / 2)")],
        [(INSIDE, INSIDE.replace("half", "2 * half")), (RIMS, "(phi - 2 * half, phi + 2 * half)")],
        (INSIDE, INSIDE.replace("half", "half / 2")),
        (RIMS, "(phi - half / 2, phi + half / 2)"),
    ),
    Slip(
        "sine-for-cosine",
        "The projection on the axis is the distance times the cosine of the angle to the axis.",
        (INSIDE, INSIDE.replace("cos", "sin")),
        (AXIS, "axis = np.array([np.sin(phi), np.cos(phi)])"),
    ),
    Slip(
        "distance-missing",
        "A product of the place and the axis is in metres: it is the distance times a cosine, so the "
        "cosine alone is nothing to compare it with.",
        (INSIDE, "if place @ axis >= np.cos(half):"),
    ),
    Slip(
        "outside",
        "The condition is turned: you hear what lies outside the cone.",
        (INSIDE, INSIDE.replace(">=", "<=")),
    ),
    Slip(
        "degrees",
        "All angles are in radians here: nothing is converted.",
        (AXIS, "phi, half = np.radians(phi), np.radians(half)\n    " + AXIS),
        (AXIS, "phi, half = np.degrees(phi), np.degrees(half)\n    " + AXIS),
    ),
    Slip(
        "from-the-origin",
        "The way to a wall is measured from the origin: the sensor stands at p.",
        (AW, "a, w = wall[:2], wall[2:] - wall[:2]"),
    ),
    Slip(
        "end-for-way",
        "x2, y2 is the wall's other end: the way along the wall is a difference of its two ends.",
        (AW, "a, w = wall[:2] - p, wall[2:] - p"),
        (AW, "a, w = wall[:2] - p, wall[2:]"),
    ),
    Slip(
        "foot-without-its-length",
        "τ counts whole walls, not metres: divide by the square of the wall's length.",
        (PLACES, "(0, 1, np.clip(-(a @ w) / np.sqrt(w @ w), 0, 1))"),
        (PLACES, "(0, 1, np.clip(-(a @ w), 0, 1))"),
    ),
    Slip(
        "middle-for-foot",
        "The middle of a wall is no nearer than others of its places. Where does the sensor look at it "
        "square on?",
        (PLACES, "(0, 1, 0.5)"),
        (PLACES, "(0.5,)"),
    ),
    Slip(
        "farthest",
        "The first echo comes from the nearest place, not from the farthest.",
        [
            ("nearest = np.inf", "nearest = 0.0"),
            (NEARER, NEARER.replace("min", "max")),
            (RIMS, "()"),
            (RETURN, "return nearest or np.inf"),
        ],
    ),
    Slip(
        "last-wall",
        "Each wall starts anew, so the last one wins: the nearest of all walls is asked for.",
        (LOOP, LOOP + "\n        nearest = np.inf"),
    ),
    Slip(
        "first-wall",
        "You stop at the first wall that is heard, or at the first of all: a later one may be "
        "nearer.",
        (RIM, RIM + "\n        if nearest < np.inf:\n            return nearest"),
        (RETURN, "    " + RETURN),
    ),
    Slip(
        "distance-along-the-axis",
        "That is how far the place is along the axis. Sound flies straight to it, in its own direction.",
        (RETURN, RETURN + " * np.cos(half)"),
        (NEARER, NEARER.replace("distance)", "place @ axis)")),
    ),
    Slip(
        "there-and-back",
        "The sound flies there and back, but it is the distance that is asked for.",
        (RETURN, "return 2 * nearest"),
        (RETURN, "return nearest / 2"),
    ),
    Slip(
        "zero-for-nothing",
        "Where nothing is heard you give a number: an echo at 0 m, or at 10 m, is a wall there.",
        (RETURN, "return nearest if nearest < np.inf else 0.0"),
        (RETURN, "return min(nearest, 10.0)"),
    ),
    Slip(
        "last-place",
        "Each place replaces the one before, be it nearer or not: keep the least distance of all.",
        (NEARER, "                nearest = distance"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        ("nearest = np.inf", "nearest = np.nan"),
        (RETURN, "return nearest, wall"),
        (RETURN, "nearest"),
    ),
    Stumble("raised", (LOOP, "for wall in range(len(walls)):")),
)

PASTED = {
    "the lesson's scan along the axis": FAN.format(beams=1).replace(
        "phi - half, phi + half", "phi, phi"
    ),
    "a scan of fifty beams": FAN.format(beams=50),
    "ray_wall of the first wall": """
def echo(p, phi, half, walls):
    return ray_wall(p, phi, walls[0]) if len(walls) else np.inf
""",
}

EQUIVALENT = {}
