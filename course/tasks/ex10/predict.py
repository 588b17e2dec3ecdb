"""Programs of 10-predict: extremes inside an interval, products of intervals, boxes of starts."""

from course.tasks import Edit, Slip, Stumble

TASK = "10-predict"

WAYS = {
    "extremes listed": """
def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    first, last = np.ceil(low / (np.pi / 2)), np.floor(high / (np.pi / 2))
    course = [low, high, *np.arange(first, last + 1) * np.pi / 2]
    x = [w * np.cos(a) for w in way for a in course]
    y = [w * np.sin(a) for w in way for a in course]
    return box[0] + min(x), box[1] + max(x), box[2] + min(y), box[3] + max(y)
""",
    "whole turns counted": """
def spread(low, high, extreme):
    turn = 2 * np.pi
    return np.floor((high - extreme) / turn) >= np.ceil((low - extreme) / turn)


def predict(box, heading, way, direction):
    low, high = np.add(heading, direction)
    found = np.array(box, dtype=float)
    for k, quarter in ((0, 0), (2, np.pi / 2)):
        values = [np.cos(low - quarter), np.cos(high - quarter)]
        if spread(low, high, quarter):
            values.append(1.0)
        if spread(low, high, quarter + np.pi):
            values.append(-1.0)
        moved = [w * value for w in way for value in values]
        found[k] += min(moved)
        found[k + 1] += max(moved)
    return found
""",
    "complex numbers": """
def predict(box, heading, way, direction):
    low, wide = heading[0] + direction[0], heading[1] - heading[0] + direction[1] - direction[0]
    compass = [low + (k * np.pi / 2 - low) % (2 * np.pi) for k in range(4)]
    tips = np.exp(1j * np.array([low, low + wide] + [a for a in compass if a <= low + wide]))
    ends = np.concatenate([way[0] * tips, way[1] * tips])
    away = [ends.real.min(), ends.real.max(), ends.imag.min(), ends.imag.max()]
    return list(np.add(box, away))
""",
    "rounded outwards": """
def reach(low, high, way):
    inside = [a for a in (0.0, np.pi) if (a - low) % (2 * np.pi) <= high - low]
    moved = np.outer(way, np.cos([low, high, *inside]))
    return np.array([moved.min() - 1e-9, moved.max() + 1e-9])


def predict(box, heading, way, direction):
    low, high = heading[0] + direction[0], heading[1] + direction[1]
    moved = np.concatenate([reach(low, high, way), reach(low - np.pi / 2, high - np.pi / 2, way)])
    return box + moved
""",
}

ENDS = (
    "return (-1 if met(np.pi) else ends.min(), 1 if met(0) else ends.max())",
    "return ends.min(), ends.max()",
)
MET = "return (angle - low) % (2 * np.pi) <= high - low"
COURSE = "low, high = heading[0] + direction[0], heading[1] + direction[1]"
PRODUCTS = "dx, dy = np.outer(way, cosines), np.outer(way, sines)"
SINES = "cosine_range(low - np.pi / 2, high - np.pi / 2)"
RESULT = "[box[0] + dx.min(), box[1] + dx.max(), box[2] + dy.min(), box[3] + dy.max()]"
SAMPLED = """
def predict(box, heading, way, direction):
    course = {course}
    x, y = np.outer(way, np.cos(course)), np.outer(way, np.sin(course))
    return np.array([box[0] + x.min(), box[1] + x.max(), box[2] + y.min(), box[3] + y.max()])
"""
GRID = "np.linspace(heading[0] + direction[0], heading[1] + direction[1], {})"

SLIPS = (
    Slip(
        "corners-only",
        "The box is that of the ends of the intervals: unsound. A heading of −0.5 to 0.5 rad has "
        "cos 0.88 at both ends and 1 between them. Ask whether a multiple of π/2 lies inside.",
        ENDS,
        SAMPLED.format(course="np.add.outer(heading, direction).ravel()"),
    ),
    Slip(
        "once-round",
        "Extremes are found at 0, ±π/2 and π, and not a whole turn off. heading + direction may go "
        "beyond π on both sides.",
        (MET, "return low <= angle <= high"),
        (MET, "return low <= angle <= high or low <= angle + 2 * np.pi <= high"),
        (MET, "return low <= angle <= high or low <= angle - 2 * np.pi <= high"),
    ),
    Slip(
        "three-turns-only",
        "Extremes are looked for on three turns only. Direction and heading may lead farther: count "
        "how far an angle lies behind low, whatever the turn.",
        (MET, "return any(low <= angle + k * 2 * np.pi <= high for k in (-1, 0, 1))"),
    ),
    Slip(
        "any-direction",
        "The box holds every drive, and many more: sine and cosine are taken from −1 to 1 always. "
        "Which of their values are met between the two ends?",
        (MET, "return True"),
    ),
    Slip(
        "only-largest",
        "The cosine's largest value is found inside the interval, its smallest is not: at π it is −1.",
        ("-1 if met(np.pi) else ends.min()", "ends.min()"),
        [("-1 if met(np.pi) else ends.min()", "ends.min()"), (MET, "return low <= angle <= high")],
    ),
    Slip(
        "only-smallest",
        "The cosine's smallest value is found inside the interval, its largest is not: at 0 it is 1.",
        ("1 if met(0) else ends.max()", "ends.max()"),
        [("1 if met(0) else ends.max()", "ends.max()"), (MET, "return low <= angle <= high")],
    ),
    Slip(
        "an-extreme-left-out",
        "Some multiple of π/2 between low and high is not among yours: counting begins one behind the "
        "first, or stops one before the last. range and arange leave their end out.",
        Edit("extremes listed", (("last + 1", "last"),)),
        Edit("extremes listed", (("arange(first", "arange(first + 1"),)),
        Edit("extremes listed", (("arange(first, last + 1", "arange(first + 1, last"),)),
    ),
    Slip(
        "an-extreme-outside",
        "A multiple of π/2 that lies outside the interval is taken along, just below low or just above "
        "high: the box holds drives that are never driven.",
        Edit("extremes listed", (("np.ceil", "np.floor"),)),
        Edit("extremes listed", (("last + 1", "last + 2"),)),
        Edit("extremes listed", (("np.ceil", "np.floor"), ("last + 1", "last + 2"))),
    ),
    Slip(
        "two-products",
        "Low · low and high · high are not always the extremes: the robot may back, and a cosine may "
        "be negative. Which of the four products is least, and which largest?",
        (PRODUCTS, "dx, dy = np.sort(np.multiply(way, cosines)), np.sort(np.multiply(way, sines))"),
        (PRODUCTS, "dx, dy = np.multiply(way, cosines), np.multiply(way, sines)"),
        [
            (PRODUCTS, "dx, dy = np.multiply(way, cosines), np.multiply(way, sines)"),
            (RESULT, "[box[0] + dx[0], box[1] + dx[1], box[2] + dy[0], box[3] + dy[1]]"),
        ],
    ),
    Slip(
        "longest-way-only",
        "Only one end of the way is driven, the larger number. With another length, or backwards, the "
        "robot ends elsewhere.",
        (PRODUCTS, "dx, dy = way[1] * np.array(cosines), way[1] * np.array(sines)"),
        (PRODUCTS, "dx, dy = np.max(way) * np.array([cosines, sines])"),
        (
            RESULT,
            "[box[0] + way[1] * cosines[0], box[1] + way[1] * cosines[1], box[2] + way[1] * sines[0], "
            "box[3] + way[1] * sines[1]]",
        ),
        before=(),
    ),
    Slip(
        "middle-way",
        "The way is taken as known, in the middle between low and high. Any way between them may be true.",
        (PRODUCTS, "dx, dy = np.mean(way) * np.array([cosines, sines])"),
    ),
    Slip(
        "box-forgotten",
        "This is the box of the displacement. The robot started somewhere in its own box.",
        (RESULT, "[dx.min(), dx.max(), dy.min(), dy.max()]"),
    ),
    Slip(
        "one-start",
        "All drives start at one point of the robot's box. It may have started anywhere in it, so low "
        "goes with low and high with high.",
        (RESULT, "[box[0] + dx.min(), box[0] + dx.max(), box[2] + dy.min(), box[2] + dy.max()]"),
        (RESULT, "[box[1] + dx.min(), box[1] + dx.max(), box[3] + dy.min(), box[3] + dy.max()]"),
        (
            RESULT,
            "[np.mean(box[:2]) + dx.min(), np.mean(box[:2]) + dx.max(), "
            "np.mean(box[2:]) + dy.min(), np.mean(box[2:]) + dy.max()]",
        ),
    ),
    Slip(
        "crossed-starts",
        "The upper end of the start is added to the least displacement, and the lower end to the "
        "largest: the box becomes too small.",
        (RESULT, "[box[1] + dx.min(), box[0] + dx.max(), box[3] + dy.min(), box[2] + dy.max()]"),
    ),
    Slip(
        "subtracted",
        "The displacement is taken off instead of added: the robot ends where it starts plus what it drives.",
        (RESULT, "[box[0] - dx.max(), box[1] - dx.min(), box[2] - dy.max(), box[3] - dy.min()]"),
    ),
    Slip(
        "direction-forgotten",
        "The robot does not drive along its heading: the direction δ is relative to it and has to be "
        "taken into account.",
        (COURSE, "low, high = heading"),
    ),
    Slip(
        "heading-forgotten",
        "The direction δ counts from the heading. The robot drives along δ only if it looks east.",
        (COURSE, "low, high = direction"),
    ),
    Slip(
        "direction-taken-off",
        "The direction has the wrong sign: the robot drives along θ + δ.",
        (COURSE, "low, high = heading[0] - direction[1], heading[1] - direction[0]"),
        (COURSE, "low, high = heading[0] - direction[0], heading[1] - direction[1]"),
    ),
    Slip(
        "heading-narrow",
        "Only the middle of the heading is used. Any heading from right to left may be true.",
        (COURSE, "low, high = np.mean(heading) + np.asarray(direction)"),
    ),
    Slip(
        "direction-narrow",
        "Only the middle of the direction is used. Any direction between its ends may be true.",
        (COURSE, "low, high = np.mean(direction) + np.asarray(heading)"),
    ),
    Slip(
        "wrapped-ends",
        "Both ends of the course are wrapped. Where π lies between them the upper end becomes the "
        "smaller number, and the interval is turned inside out.",
        (COURSE, COURSE + "\n    low, high = wrap(float(low)), wrap(float(high))"),
        (COURSE, COURSE + "\n    low, high = sorted([wrap(float(low)), wrap(float(high))])"),
    ),
    Slip(
        "exchanged",
        "Sine and cosine have changed places: x grows with the cosine.",
        (PRODUCTS, "dx, dy = np.outer(way, sines), np.outer(way, cosines)"),
    ),
    Slip(
        "sine-shift",
        "The range of the sine has the wrong sign: sin α is the cosine of α − π/2, not of α + π/2.",
        (SINES, "cosine_range(low + np.pi / 2, high + np.pi / 2)"),
    ),
    Slip(
        "sine-from-cosine",
        "The range of the sine is not made of the cosines' by sin² = 1 − cos²: that loses the sign, and "
        "where it turns back.",
        (
            "cosines, sines = cosine_range(low, high), " + SINES,
            "cosines = cosine_range(low, high)\n    sines = np.sort(np.sqrt(1 - np.square(cosines)))",
        ),
    ),
    Slip(
        "degrees",
        "The angles are in radians already, and np.cos wants radians.",
        (COURSE, "low, high = np.radians(np.add(heading, direction))"),
        (COURSE, "low, high = np.degrees(np.add(heading, direction))"),
        ("ends = np.cos([low, high])", "ends = np.cos(np.radians([low, high]))"),
        ("ends = np.cos([low, high])", "ends = np.cos(np.degrees([low, high]))"),
    ),
    Slip(
        "order",
        "The numbers are right, their order is not: x_min, x_max, y_min, y_max.",
        (RESULT, "[box[0] + dx.min(), box[2] + dy.min(), box[1] + dx.max(), box[3] + dy.max()]"),
    ),
    Slip(
        "min-max-exchanged",
        "x_min and x_max have changed places, and so have y_min and y_max.",
        (RESULT, "[box[1] + dx.max(), box[0] + dx.min(), box[3] + dy.max(), box[2] + dy.min()]"),
    ),
    Slip(
        "whole-metres",
        "The box is cut to whole numbers of metres.",
        ("dy.max()])", "dy.max()]).astype(int)"),
        ("dy.max()])", "dy.max()]).round()"),
    ),
    Slip(
        "sampled",
        "The box is a hair too small: the best of many drives that were tried. Between two of them the "
        "cosine may be larger still. Find the extremes themselves.",
        *(SAMPLED.format(course=GRID.format(n)) for n in (50, 100, 101, 200, 500, 1000, 1001)),
        SAMPLED.format(
            course="np.random.default_rng(0).uniform("
            "heading[0] + direction[0], heading[1] + direction[1], 10_000)"
        ),
    ),
)

STUMBLES = (
    Stumble(
        "malformed", (f"np.array({RESULT})", "[(0, 1), (0, 1)]"), (f"np.array({RESULT})", "None")
    ),
    Stumble("raised", (COURSE, "low, high = heading.low, heading.high")),
    Stumble(
        "not attempted", "def predict(box, heading, way, direction):\n    raise NotImplementedError"
    ),
)

EQUIVALENT = {
    "1e-09": "a billionth of a metre is rounding, whichever way",
}
