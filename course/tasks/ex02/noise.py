"""Right ways and slips of 02-noise; what is told of random outputs is told in the same words."""

from course.tasks import Slip, Stumble
from slamlab.exercises.tasks.ex02.noise import MISTAKES

TASK = "02-noise"

WAYS = {
    "rng.normal": """
def noisy(ranges, error, dropouts, rng):
    lost = rng.random(ranges.shape) < dropouts
    return np.where(lost, np.nan, rng.normal(1, error, ranges.shape) * ranges)
""",
    "beam by beam": """
def noisy(ranges, error, dropouts, rng):
    measured = ranges.copy()
    for k, r in enumerate(ranges):
        if not np.isnan(r):
            measured[k] = np.nan if rng.uniform() < dropouts else r + rng.normal(0, error * r)
    return measured
""",
    "rng.choice": """
def noisy(ranges, error, dropouts, rng):
    back = rng.choice([1.0, np.nan], size=ranges.size, p=[1 - dropouts, dropouts])
    return list(back * ranges * (1 + error * rng.standard_normal(ranges.size)))
""",
    "rng.binomial": """
def noisy(ranges, error, dropouts, rng):
    sigma = np.nan_to_num(error * ranges)
    measured = rng.normal(ranges, sigma)
    measured[rng.binomial(1, dropouts, len(measured)).astype(bool)] = np.nan
    return measured
""",
    "only what is there": """
def noisy(ranges, error, dropouts, rng):
    there = np.flatnonzero(np.isfinite(ranges))
    there = there[rng.uniform(0, 1, there.size) >= dropouts]
    measured = np.full(ranges.shape, np.nan)
    measured[there] = ranges[there] + rng.normal(scale=error * ranges[there])
    return measured
""",
}

DRAW, SIGMA = "rng.standard_normal(len(ranges))", "error * ranges * "
LOST, LOSE = (
    "rng.random(len(ranges)) < dropouts",
    "measured[rng.random(len(ranges)) < dropouts] = np.nan",
)
SUM = "measured = ranges + error * ranges * rng.standard_normal(len(ranges))"
PROGRAMS = {
    "another-generator": (
        (DRAW, "np.random.standard_normal(len(ranges))"),
        (LOST, "np.random.random(len(ranges)) < dropouts"),
        (SUM, "rng = np.random.default_rng()\n    " + SUM),
    ),
    "always-the-same": ((SUM, "rng = np.random.default_rng(0)\n    " + SUM),),
    "zero-for-lost": ((LOSE, LOSE.replace("np.nan", "0.0")),),
    "no-error": ((SIGMA, "0 * ranges * "),),
    "one-number-for-all": ((DRAW, "rng.standard_normal()"),),
    "one-sided": (
        (DRAW, "abs(rng.standard_normal(len(ranges)))"),
        (DRAW, "rng.random(len(ranges))"),
        (DRAW, "rng.exponential(size=len(ranges))"),
    ),
    "does-not-grow": ((SIGMA, "error * "),),
    "variance-taken": ((SIGMA, "(error * ranges) ** 2 * "),),
    "root-taken": ((SIGMA, "np.sqrt(error * ranges) * "),),
    "uniform": ((DRAW, "rng.uniform(-1, 1, len(ranges))"),),
    "kept-for-lost": ((LOST, "rng.random(len(ranges)) > dropouts"),),
    "nothing-lost": ((LOSE, "rng.random()"), (LOSE, "ranges[rng.random(len(ranges)) < dropouts]")),
    "the-same-beams-lost": (
        (LOST, "np.arange(len(ranges)) < dropouts * len(ranges)"),
        (LOST, "np.random.default_rng(1).random(len(ranges)) < dropouts"),
    ),
    "a-fixed-number-lost": (
        (LOST, "rng.choice(len(ranges), round(dropouts * len(ranges)), replace=False)"),
        (LOST, "rng.choice(len(ranges), int(dropouts * len(ranges)), replace=False)"),
        (LOST, "rng.permutation(len(ranges)) < dropouts * len(ranges)"),
    ),
    "all-or-none": (
        (LOST, "rng.random() < dropouts"),
        (LOST, "np.repeat(rng.random(len(ranges) // 5 + 1), 5)[: len(ranges)] < dropouts"),
    ),
}

SLIPS = (
    *(Slip(mistake.name, mistake.hint, *PROGRAMS[mistake.name]) for mistake in MISTAKES),
    Slip(
        "the-largest-errors-lost",
        "The same number decides how much a beam errs and whether it is lost: then the large errors "
        "never come back. Draw twice.",
        [
            (
                SUM,
                "q = rng.standard_normal(len(ranges))\n    measured = ranges + error * ranges * q",
            ),
            (LOST, "abs(q) > np.quantile(abs(q), 1 - dropouts)"),
        ],
    ),
    Slip(
        "twice-the-noise",
        "The errors spread by a factor more, or less, than error · r: a standard normal number has the "
        "standard deviation 1 already.",
        (SIGMA, "2 * error * ranges * "),
        (SIGMA, "0.5 * error * ranges * "),
        (SIGMA, "np.sqrt(2) * error * ranges * "),
        (SIGMA, "error**2 * ranges * "),
        (SIGMA, "np.sqrt(error) * ranges * "),
        (DRAW, "rng.uniform(-0.5, 0.5, len(ranges))"),
    ),
    Slip(
        "error-not-a-share",
        "The noise is multiplied by one range for all, or the error divided by the range. Each beam's "
        "standard deviation is a share of its own range.",
        (SIGMA, "error * np.nanmean(ranges) * "),
        (SIGMA, "error / ranges * "),
    ),
    Slip(
        "noise-without-range",
        "That is the noise alone: it is added to the true range.",
        (SUM, SUM.replace("ranges + ", "")),
    ),
    Slip(
        "too-long",
        "All readings are too long, or too short: noise has the mean 0.",
        (LOSE, LOSE + "\n    measured += 0.01"),
        (SUM, SUM.replace("ranges + ", "ranges * (1 + error) + ")),
    ),
    Slip(
        "nothing-filled",
        "Where nothing was there, something comes back: NaN means that there is no wall to measure.",
        (SUM, "ranges = np.where(np.isnan(ranges), np.nanmean(ranges), ranges)\n    " + SUM),
        (SUM, "ranges = np.nan_to_num(ranges, nan=9.0)\n    " + SUM),
    ),
    Slip(
        "dropouts-of-another-size",
        "The share of lost readings is another than dropouts.",
        (LOST, "rng.random(len(ranges)) < 2 * dropouts"),
        (LOST, "rng.random(len(ranges)) < dropouts**2"),
        (LOST, "abs(rng.standard_normal(len(ranges))) < dropouts"),
        (LOST, "rng.random(len(ranges)) < dropouts * np.isfinite(ranges).mean() * 0.8"),
    ),
    Slip(
        "the-far-ones-lost",
        "Who is lost depends on the range here. The text gives all beams the same probability.",
        (LOST, "rng.random(len(ranges)) < dropouts * ranges / np.nanmean(ranges)"),
        (LOST, "ranges > np.nanquantile(ranges, 1 - dropouts)"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        ("return measured", "return measured[~np.isnan(measured)]"),
        ("return measured", "measured"),
        ("return measured", "return measured, dropouts"),
        ("return measured", "return measured[:, None]"),
    ),
    Stumble("raised", (DRAW, "rng.standard_normal(ranges)")),
)

DRAWN_ANEW = "numbers that are drawn once more are as random as before"
SYMMETRIC = "noise has no sign: what is subtracted is as likely as what is added"
NAN_STAYS = "NaN plus anything is NaN: the line spares work only"

EQUIVALENT = {
    f" -> {SUM}": DRAWN_ANEW,
    " -> lost = rng.random(ranges.shape) < dropouts": DRAWN_ANEW,
    " -> measured[k] = np.nan if rng.uniform() < dropouts else r + rng": DRAWN_ANEW,
    " -> back = rng.choice([1.0, np.nan], size=ranges.size, p=[1 - d": DRAWN_ANEW,
    " -> measured = rng.normal(ranges, sigma)": DRAWN_ANEW,
    " -> measured[there] = ranges[there] + rng.normal(scale=error * ranges[there])": DRAWN_ANEW,
    "measured = ranges - error * ranges": SYMMETRIC,
    "else r - rng.normal": SYMMETRIC,
    "(1 - error * rng": SYMMETRIC,
    "ranges[there] - rng.normal": SYMMETRIC,
    "ranges / (1 + error * rng": "the same but for error², which is less than chance shows",
    "if not np.isnan(r): -> ": NAN_STAYS,
}
