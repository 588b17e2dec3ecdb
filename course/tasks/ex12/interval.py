"""Programs of task 12-interval."""

from course.tasks import Edit, Slip, Stumble

TASK = "12-interval"

WAYS = {
    "the roots of the quadratic": """
def interval(k, n):
    p, c = k / n, 1.96**2 / n
    low, high = sorted(np.roots([1 + c, -2 * p - c, p**2]).real)
    return max(low, 0.0), min(high, 1.0)
""",
    "Clopper and Pearson": """
def interval(k, n):
    from scipy.stats import beta
    low = beta.ppf(0.025, k, n - k + 1) if k else 0.0
    return low, beta.ppf(0.975, k + 1, n - k) if k < n else 1.0
""",
    "Agresti and Coull": """
def interval(k, n):
    more = n + 1.96**2
    p = (k + 1.96**2 / 2) / more
    half = 1.96 * np.sqrt(p * (1 - p) / more)
    return max(p - half, 0), min(p + half, 1)
""",
    "two and two more": """
def interval(k, n):
    p = (k + 2) / (n + 4)
    half = 1.96 * np.sqrt(p * (1 - p) / (n + 4))
    return np.clip([p - half, p + half], 0, 1)
""",
    "by SciPy": """
def interval(k, n):
    from scipy.stats import binomtest
    found = binomtest(k, n).proportion_ci(method="wilson")
    return [found.low, found.high]
""",
    "by halving": """
def interval(k, n):
    def end(inside, outside):
        for _ in range(60):
            p = (inside + outside) / 2
            if abs(k / n - p) <= 1.96 * np.sqrt(p * (1 - p) / n):
                inside = p
            else:
                outside = p
        return inside

    return end(k / n, 0.0), end(k / n, 1.0)
""",
    "Jeffreys": """
def interval(k, n):
    from scipy.stats import beta
    low, high = beta.ppf([0.025, 0.975], k + 0.5, n - k + 0.5)
    return (0.0 if k == 0 else low), (1.0 if k == n else high)
""",
}

Z = "z = 1.96"
MIDDLE = "middle = (k / n + z**2 / (2 * n)) / (1 + z**2 / n)"
ROOT = "np.sqrt(k / n * (1 - k / n) / n + z**2 / (4 * n**2))"
HALF = f"half = z * {ROOT} / (1 + z**2 / n)"
END = "max(middle - half, 0.0), min(middle + half, 1.0)"
FREE = "middle - half, middle + half"


def instead(half, middle="middle = k / n"):
    """Edits to an interval about the counted share, cut off at 0 and 1."""
    return [(MIDDLE, middle), (HALF, f"half = {half}")]


SLIPS = (
    Slip(
        "n-minus-one",
        "You divide by n − 1, which is nothing for a single run. It belongs to a variance about a mean that "
        "the same numbers gave; k/n scatters about p with p (1 − p)/n.",
        """
def interval(k, n):
    p, n, z = k / n, n - 1, 1.96
    middle = (p + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2)) / (1 + z**2 / n)
    return max(middle - half, 0.0), min(middle + half, 1.0)
""",
    ),
    Slip(
        "wald",
        "p ± 1.96 √(p (1 − p) / n) puts the *counted* share where the true one belongs. At 0 of n it "
        "claims certainty, and for small shares it misses far too often.",
        instead("z * np.sqrt(k / n * (1 - k / n) / n)"),
        [*instead("z * np.sqrt(k / n * (1 - k / n) / n)"), (END, FREE)],
        [*instead("z * np.sqrt(k / n * (1 - k / n) / max(n - 1, 1))")],
    ),
    Slip(
        "variance",
        "p (1 − p) / n is a variance. An interval is made of standard deviations.",
        instead("z * (k / n) * (1 - k / n) / n"),
        (ROOT, ROOT.removeprefix("np.sqrt")),
    ),
    Slip(
        "of-one-run",
        "√(p (1 − p)) is how much *one* run scatters. The share of n runs scatters less.",
        instead("z * np.sqrt(k / n * (1 - k / n))"),
        (ROOT, "np.sqrt(k / n * (1 - k / n) + z**2 / (4 * n**2))"),
    ),
    Slip(
        "of-the-count",
        "√(n p (1 − p)) is how much the *number* of lost runs scatters. For the share it is divided by n.",
        instead("z * np.sqrt(k * (1 - k / n))"),
    ),
    Slip(
        "one-sigma",
        "This is one standard deviation to either side: it holds the truth in 68 % of all studies.",
        (Z, "z = 1.0"),
        [(Z, "z = 1.0"), *instead("z * np.sqrt(k / n * (1 - k / n) / n)")],
    ),
    Slip(
        "another-z",
        "The number of deviations is another one: 1.96 to either side hold 95 % of a bell. Is yours that of "
        "90 %, of 99 %, or a share?",
        (Z, "z = 1.645"),
        (Z, "z = 2.576"),
        (Z, "z = 0.95"),
        (Z, "z = 1.96**2"),
        (Z, "z = 1.96 / 2"),
    ),
    Slip(
        "not-moved",
        "The width is right, but the interval sits round the counted share. Its middle lies nearer to "
        "one half.",
        (MIDDLE, "middle = k / n"),
    ),
    Slip(
        "undivided",
        "Middle or width still have to be divided: what stands before p² in the quadratic inequality?",
        [(MIDDLE, "middle = k / n + z**2 / (2 * n)"), (HALF, f"half = z * {ROOT}")],
        (MIDDLE, "middle = k / n + z**2 / (2 * n)"),
    ),
    Slip(
        "middle-moved-too-far",
        "The middle is moved too far, or the other way: compare with the term of p in the inequality.",
        (MIDDLE, "middle = (k / n + z**2 / n) / (1 + z**2 / n)"),
        (MIDDLE, "middle = (k / n - z**2 / (2 * n)) / (1 + z**2 / n)"),
        (MIDDLE, "middle = k / n / (1 + z**2 / n)"),
    ),
    Slip(
        "z-not-squared",
        "Square the inequality with all that stands in it: z comes out as z² wherever it has no root beside it.",
        (MIDDLE, MIDDLE.replace("z**2 / (", "z / (")),
        (HALF, HALF.replace("z**2 / (4", "z / (4")),
        [(MIDDLE, MIDDLE.replace("z**2", "z"))],
        [(HALF, HALF.replace("z**2", "z"))],
        [(MIDDLE, MIDDLE.replace("z**2", "z")), (HALF, HALF.replace("z**2", "z"))],
        [(MIDDLE, MIDDLE.replace("1 + z**2", "1 + z")), (HALF, HALF.replace("1 + z**2", "1 + z"))],
        Edit("the roots of the quadratic", (("1.96**2 / n", "1.96 / n"),)),
    ),
    Slip(
        "root-without-its-rest",
        "What stands under the root is not what completing the square gives.",
        (ROOT, "np.sqrt(k / n * (1 - k / n) / n)"),
        (ROOT, "np.sqrt(k / n * (1 - k / n) / n + z**2 / (4 * n))"),
        (ROOT, "np.sqrt(k / n * (1 - k / n) / n + z**2 / n**2)"),
        (ROOT, "np.sqrt(abs(k / n * (1 - k / n) / n - z**2 / (4 * n**2)))"),
    ),
    Slip(
        "share-of-doubt-lost",
        "Under the root stands p², or p: a share scatters by p (1 − p).",
        instead("z * np.sqrt(k / n / n)"),
        instead("z * np.sqrt((1 - k / n) / n)"),
        instead("z * k / n / np.sqrt(n)"),
    ),
    Slip(
        "widest-for-all",
        "This is as wide for every share. √(p (1 − p)) is ½ at most, and much less where hardly any run, or "
        "nearly every one, is lost.",
        instead("z * 0.5 / np.sqrt(n)"),
    ),
    Slip(
        "high-before-low",
        "The ends are in the wrong order: the lower one first.",
        (END, "min(middle + half, 1.0), max(middle - half, 0.0)"),
    ),
    Slip(
        "middle-and-half",
        "These are the middle and half the width, or a width. Asked for are the two ends.",
        (END, "middle, half"),
        (END, "k / n, half"),
        (END, "max(middle - half, 0.0), 2 * half"),
    ),
    Slip(
        "per-cent",
        "These are per cent. A share is a number from 0 to 1.",
        (END, "100 * max(middle - half, 0.0), 100 * min(middle + half, 1.0)"),
    ),
    Slip(
        "counts-for-shares",
        "These are numbers of runs. Asked for are shares, from 0 to 1.",
        (END, "n * max(middle - half, 0.0), n * min(middle + half, 1.0)"),
    ),
    Slip(
        "one-side",
        "One of the ends is open: shares that are too large, or too small, are doubted as well.",
        (END, "0.0, min(middle + half, 1.0)"),
        (END, "max(middle - half, 0.0), 1.0"),
        (END, "k / n, min(middle + half, 1.0)"),
        (END, "max(middle - half, 0.0), k / n"),
    ),
    Slip(
        "not-cut-off",
        "This interval leaves the shares that there are: nothing lies below 0 or above 1. Cut it off there.",
        Edit("Agresti and Coull", (("max(p - half, 0), min(p + half, 1)", "p - half, p + half"),)),
        Edit("two and two more", (("np.clip([p - half, p + half], 0, 1)", "p - half, p + half"),)),
    ),
    Slip(
        "lost-for-kept",
        "This is the share of the runs that were *not* lost.",
        (END, "max(1 - middle - half, 0.0), min(1 - middle + half, 1.0)"),
    ),
    Slip(
        "no-doubt-at-the-ends",
        "0 of n is taken for certain, or n of n. The next run may still be another one.",
        (Z, "if k in (0, n):\n        return k / n, k / n\n    z = 1.96"),
        (Z, "if k == 0:\n        return 0.0, 0.0\n    z = 1.96"),
        (Z, "if k == n:\n        return 1.0, 1.0\n    z = 1.96"),
    ),
    Slip(
        "a-fixed-number-of-runs",
        "The number of runs is in `n`; your function has one of its own.",
        (Z, "k, n = 80 * k / n, 80\n    z = 1.96"),
        (Z, "k, n = 6 * k / n, 6\n    z = 1.96"),
        (Z, "k, n = 40 * k / n, 40\n    z = 1.96"),
    ),
    Slip(
        "whole-numbers",
        "A share is no whole number: something divides without a remainder, or rounds.",
        (END, "round(max(middle - half, 0.0)), round(min(middle + half, 1.0))"),
        [(MIDDLE, MIDDLE.replace("k / n +", "k // n +"))],
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (END, "half"),
        (f"return {END}", "pass"),
        (END, "middle - half, middle, middle + half"),
        Edit("the roots of the quadratic", ((".real", " + 1e-3j"),)),
    ),
    Stumble("raised", (Z, "z = norm.ppf(0.975)")),
)

AS_GOOD = "a little wider, and as honest: another interval will do as well, says the text"
CUT = "it is cut off by rounding only"
EQUIVALENT = {
    "return (max(middle - half, 0.0), min(middle + half, 1.0)) -> return (": CUT,
    "return (max(low, 0.0), min(high, 1.0)) -> return (": CUT,
} | dict.fromkeys(
    (
        "half = z * np.sqrt(k / n * (1 - k / n) / n + ",
        "half = 1.96 * np.sqrt(p * (1 - p) / ",
        "p, c = (k / n, 2 ** 1.96 / n)",
        "more = n + 2 ** 1.96",
        "p = (k + 1.96 ** 2 / 2) / more -> ",
        "proportion_ci()",
        "[0.0125, 0.975]",
        "else 0",
    ),
    AS_GOOD,
)
