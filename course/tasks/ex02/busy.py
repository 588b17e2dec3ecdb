"""Right ways and slips of 02-busy-room: some methods that tell wall from people, and some that do
not."""

from course.tasks import Slip, Stumble

TASK = "02-busy-room"
MUTANTS = 60

DENSEST = '''
def densest(scans):
    """The middle of the shortest interval with half of a beam's readings."""
    s, half = np.sort(scans, axis=0), len(scans) // 2
    at = (s[half:] - s[:-half]).argmin(axis=0)
    return np.array([s[k : k + half + 1, b].mean() for b, k in enumerate(at)])
'''

WAYS = {
    "from the densest half": DENSEST
    + """
def busy_fit(scans, step):
    r, e = densest(scans), 0.03
    for _ in range(15):
        keep = np.abs(scans - r) < 2.6 * e * r + step / 2
        n = keep.sum(axis=0)
        r = np.where(n > 1, np.where(keep, scans, 0).sum(axis=0) / np.maximum(n, 1), r)
        v = np.where(keep, (scans - r) ** 2, 0).sum() - (n - 1).sum() * step**2 / 12
        e = np.sqrt(max(v / ((n - 1) * r**2).sum(), 1e-6))
    return [e, np.mean(~keep)]
""",
    "what every step is worth": DENSEST
    + """
def busy_fit(scans, step):
    from scipy.special import ndtr

    r, e, p = densest(scans), 0.02, 0.2
    for _ in range(25):
        low, high = (np.clip((scans + side * step / 2 - r) / (e * r), -6, 6) for side in (-1, 1))
        mass = np.maximum(ndtr(high) - ndtr(low), 1e-9)
        a, b = (np.exp(-(x**2) / 2) / np.sqrt(2 * np.pi) for x in (low, high))
        wall = (1 - p) * mass / ((1 - p) * mass + p * step / r * (scans <= r) + 1e-12)
        first, second = wall * (a - b) / mass, wall * (1 + (low * a - high * b) / mass)
        n = np.maximum(wall.sum(axis=0), 1e-9)
        shift = first.sum(axis=0) / n
        r = r + e * r * shift
        e = e * np.sqrt((second.sum(axis=0) - n * shift**2).sum() / n.sum())
        p = 1 - wall.mean()
    return e * np.sqrt(n.sum() / (n.sum() - len(n))), p
""",
    "far beams only": DENSEST
    + """
def busy_fit(scans, step):
    r = densest(scans)
    far = r > np.quantile(r, 0.4)
    e = 0.03
    for _ in range(15):
        keep = abs(scans - r) <= 2.5 * e * r + step / 2
        n = np.maximum(keep.sum(axis=0), 1)
        r = np.where(keep.any(axis=0), (keep * scans).sum(axis=0) / n, r)
        v = (keep * (scans - r) ** 2).sum(axis=0)[far].sum() / (n - 1)[far].sum() - step**2 / 12
        e = np.sqrt(max(v, 1e-6) / np.average(r[far] ** 2, weights=(n - 1)[far]))
    return e, 1 - keep.sum() / keep.size
""",
    "beam by beam": """
def busy_fit(scans, step):
    error = 0.03
    places = [float(np.median(column)) for column in scans.T]
    for _ in range(10):
        squares, freedom, wanted, blocked = 0.0, 0, 0.0, 0
        for k, column in enumerate(scans.T):
            good = column[abs(column - places[k]) <= 2.5 * error * places[k] + step / 2]
            blocked += len(column) - len(good)
            if len(good) > 1:
                places[k] = good.mean()
                squares += good.var() * len(good)
                freedom += len(good) - 1
                wanted += (len(good) - 1) * places[k] ** 2
        error = max((squares - freedom * step**2 / 12) / wanted, 1e-6) ** 0.5
    return np.array([error, blocked / scans.size])
""",
}

ROUNDING = " - np.sum(freedom) * step**2 / 12"
WALL = "wall = abs(scans - r) <= 2.5 * error * r + step / 2"
RETURN = "return error, 1 - wall.mean()"
PLACE = "r = np.where(count > 0, (wall * scans).sum(axis=0) / np.maximum(count, 1), r)"
QUIET = "def busy_fit(scans, step):\n    return quiet_fit(scans), {}\n"
MAD = """
def busy_fit(scans, step):
    share = scans / np.median(scans, axis=0) - 1
    error = 1.4826 * np.median(abs(share))
    return error, np.mean(abs(share) > 3 * error)
"""
EACH = """
def busy_fit(scans, step):
    r = np.median(scans, axis=0)
    {}
    share = np.where(abs(scans - r) <= near, scans, np.nan)
    return np.nanmean(np.nanstd(share, axis=0) / np.nanmean(share, axis=0)), np.isnan(share).mean()
"""

SLIPS = (
    Slip(
        "quiet",
        "This is the fit for a quiet room: people make the error many times too large. Which of the "
        "readings are of the wall at all?",
        QUIET.format(0.2),
        QUIET.format("np.mean(abs(scans - scans.mean(axis=0)) > 2 * scans.std(axis=0))"),
    ),
    Slip(
        "median-of-deviations",
        "The median of all deviations withstands a few people, but not four in ten, all of them on the "
        "same side; and for near walls it is a whole number of steps.",
        MAD,
        MAD.replace("1.4826 * ", ""),
    ),
    Slip(
        "cut-once",
        "You cut once, with a width that is guessed. What is left tells the width better: go round again.",
        EACH.format("near = 0.1 * r"),
        EACH.format("near = 3 * scans.std(axis=0)"),
        ("range(12)", "range(1)"),
    ),
    Slip(
        "in-metres",
        "error is a share of the range: a standard deviation in metres is something else for each beam.",
        ("np.sum(freedom * r**2)), 0.001)", "np.sum(freedom)), 0.001)"),
        (RETURN, "return error * r.mean(), 1 - wall.mean()"),
    ),
    Slip(
        "variance",
        "error is a standard deviation, and so the root of a variance.",
        (RETURN, "return error**2, 1 - wall.mean()"),
        (RETURN, "return np.sqrt(error), 1 - wall.mean()"),
    ),
    Slip(
        "twice",
        "error is off by a constant factor: is it the width of your gate?",
        (RETURN, "return 2 * error, 1 - wall.mean()"),
        (RETURN, "return 2.5 * error, 1 - wall.mean()"),
        (RETURN, "return error / 2, 1 - wall.mean()"),
    ),
    Slip(
        "rounding-too-large",
        "Rounding adds a variance, too, but not so much: what is the variance of an error that lies "
        "evenly between minus half a step and half a step?",
        (ROUNDING, ROUNDING.replace(" / 12", "")),
        (ROUNDING, ROUNDING.replace(" / 12", " / 4")),
    ),
    Slip(
        "all-beams-alike",
        "Each beam has the same weight, and for near walls it is the rounding that you see, not the "
        "noise. Which beams tell more of the noise?",
        (
            "error = max(np.sqrt(max(noise, 0) / np.sum(freedom * r**2)), 0.001)",
            "each = (wall * (scans - r) ** 2).sum(axis=0) / np.maximum(freedom, 1)\n"
            "        error = np.sqrt(np.mean(each / r**2))",
        ),
    ),
    Slip(
        "people-kept",
        "You keep the people and throw the wall away: the comparison is turned.",
        (WALL, WALL.replace("<=", ">")),
    ),
    Slip(
        "wall-share",
        "blocked is the share of people, and yours is that of the wall, or a number of readings.",
        (RETURN, "return error, wall.mean()"),
        (RETURN, "return error, np.sum(~wall)"),
    ),
    Slip(
        "beams-ever-blocked",
        "Nearly every beam is blocked once in a while: blocked counts single readings, not beams.",
        (RETURN, "return error, 1 - wall.all(axis=0).mean()"),
    ),
    Slip(
        "order-swapped",
        "The two numbers have changed places: error comes first.",
        (RETURN, "return 1 - wall.mean(), error"),
    ),
    Slip(
        "in-per-cent",
        "These are per cent. Both numbers are shares: 0.02 is 2 %.",
        (RETURN, "return 100 * error, 100 * (1 - wall.mean())"),
        (RETURN, "return 100 * error, 1 - wall.mean()"),
    ),
    Slip(
        "narrow-gate",
        "Your gate cuts off a large part of the wall's own readings: the error becomes too small, the "
        "gate narrower, and so on, round by round.",
        (WALL, WALL.replace("2.5", "1")),
        (WALL, WALL.replace("2.5", "1.5")),
    ),
    Slip(
        "wide-gate",
        "Your gate is so wide that many people pass: a few of them half a metre off the wall weigh as "
        "much as all the rest.",
        (WALL, WALL.replace("2.5", "10")),
        (WALL, WALL.replace("2.5 * error * r", "1.0")),
    ),
    Slip(
        "place-never-moved",
        "The wall is taken to stand at the mean of all readings, or of those of all beams: people draw "
        "it nearer.",
        ("np.median(scans, axis=0)", "scans.mean(axis=0)"),
        ("np.median(scans, axis=0), 0.03", "np.median(scans) + 0 * scans[0], 0.03"),
    ),
    Slip(
        "guess-returned",
        "This is a guess: what do the readings say?",
        "def busy_fit(scans, step):\n    return step / 4, 0.2\n",
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (RETURN, "return error"),
        (RETURN, "return error, 1 - wall.mean(axis=0)"),
        (RETURN, "return None, 1 - wall.mean()"),
    ),
    Stumble("raised", ("axis=0), 0.03", "axis=2), 0.03")),
)

PASTED = {
    "the fit of a quiet room": QUIET.format("0.2"),
    "the lesson's robust spread": MAD,
    "robust about the mean": """
def busy_fit(scans, step):
    share = scans / scans.mean(axis=0) - 1
    error = 1.4826 * np.nanmedian(abs(share))
    return error, (abs(share) > 0.03).mean()
""",
}

EQUIVALENT = {
    " -> ": "any method goes: what still clears the top step is as right as the solution",
}
