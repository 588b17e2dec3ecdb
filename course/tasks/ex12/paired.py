"""Programs of task 12-paired."""

from course.tasks import Slip, Stumble
from course.tasks.ex12.paired_ways import PASTED, WAYS

__all__ = ["PASTED", "WAYS"]

TASK = "12-paired"

BEYOND = "(a > limit) | (b > limit)"
FIRST = "end = strayed[0] if len(strayed) else len(a)"
LEFT = "if end > 0:"
RMS = "np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2))"
SORT = "d, n = np.sort(differences), len(differences)"
COMB = "comb(n, k) / 2**n"
FEW = "few = np.sum(chances <= 0.025)"
ENDS = "d[few - 1], d[n - few]"
MEANS = "np.mean(differences) - t * np.std(differences, ddof=1) / np.sqrt(n), np.mean(differences) + t * np.std(differences, ddof=1) / np.sqrt(n)"

SLIPS = (
    Slip(
        "not-paired",
        "You have an interval for each filter, or a difference of two. What is hard about a drive is hard "
        "for both: take the difference drive by drive, and only then look at all drives.",
        [
            (RMS, "[np.sqrt(np.mean(e[:end] ** 2)) for e in (a, b)]"),
            (
                SORT,
                "both, n = np.sort(np.array(differences), axis=0), len(differences)\n    d = both[:, 0] - both[:, 1]",
            ),
        ],
        [
            (RMS, "[np.sqrt(np.mean(e[:end] ** 2)) for e in (a, b)]"),
            (SORT, "both, n = np.sort(np.array(differences), axis=0), len(differences)"),
            (ENDS, "both[few - 1, 0] - both[n - few, 1], both[n - few, 0] - both[few - 1, 1]"),
        ],
    ),
    Slip(
        "B-less-A",
        "The difference is the other way round: A less B, so that it is negative where A is nearer.",
        (RMS, "np.sqrt(np.mean(b[:end] ** 2)) - np.sqrt(np.mean(a[:end] ** 2))"),
    ),
    Slip(
        "unsigned",
        "The sign of the difference says which filter is nearer, and it is gone.",
        (RMS, f"abs({RMS})"),
    ),
    Slip(
        "ratio",
        "This is a quotient. Asked for is a difference, in metres.",
        (RMS, RMS.replace(" - ", " / ")),
    ),
    Slip(
        "each-by-itself",
        "Each filter is followed until *it* strays. Both have to be compared on the same readings: until "
        "either of them strays.",
        (
            RMS,
            "np.sqrt(np.mean(np.r_[a[: [*np.flatnonzero(a > limit), len(a)][0]] ** 2, np.zeros(0)])) - np.sqrt(np.mean(b[: [*np.flatnonzero(b > limit), len(b)][0]] ** 2))",
        ),
    ),
    Slip(
        "until-both",
        "You compare until *both* are beyond the limit. The first filter to stray ends the comparison.",
        (BEYOND, "(a > limit) & (b > limit)"),
    ),
    Slip(
        "one-filter-only",
        "You look at one of both filters only to find where they stray.",
        (BEYOND, "a > limit"),
        (BEYOND, "b > limit"),
    ),
    Slip(
        "mean-beyond",
        "Whether a filter strays is a question to it alone, not to the mean or the sum of both errors.",
        (BEYOND, "(a + b) / 2 > limit"),
        (BEYOND, "a + b > limit"),
        (BEYOND, "abs(a - b) > limit"),
    ),
    Slip(
        "the-limit-itself",
        "An error that equals the limit is not beyond it.",
        (BEYOND, "(a >= limit) | (b >= limit)"),
    ),
    Slip(
        "whole-drives",
        "You compare whole drives: a filter that is lost has large errors, which say nothing of how near "
        "it was before.",
        (FIRST, "end = len(a)"),
    ),
    Slip(
        "with-the-first-stray",
        "The reading at which a filter strays counts no more. Which one is the last that does?",
        (FIRST, FIRST.replace("strayed[0]", "strayed[0] + 1")),
        [(FIRST, FIRST.replace("strayed[0]", "strayed[0] + 1")), (LEFT, "if end > 1:")],
        [
            (FIRST, FIRST.replace("strayed[0]", "strayed[0] + 1")),
            (LEFT, "if not len(strayed) or end > 1:"),
        ],
    ),
    Slip(
        "one-reading-less",
        "The last reading before the straying counts, too.",
        (FIRST, FIRST.replace("strayed[0]", "max(strayed[0] - 1, 0)")),
        (FIRST, FIRST + "\n        end = max(end - 1, 1) if end else 0"),
    ),
    Slip(
        "all-near-readings",
        "You left out single readings beyond the limit. Who strayed once is not compared again, even when "
        "he comes back.",
        [
            (
                FIRST,
                "near = (a <= limit) & (b <= limit)\n        end = near.sum()\n        a, b = a[near], b[near]",
            )
        ],
        [
            (
                FIRST,
                "near = (a <= limit) & (b <= limit)\n        end = near.sum() * near[0]\n        a, b = a[near], b[near]",
            )
        ],
    ),
    Slip(
        "last-stray",
        "You cut off at the *last* reading beyond the limit, or where a filter is lost for good. The first "
        "one ends the comparison.",
        (FIRST, "end = strayed[-1] if len(strayed) else len(a)"),
        (FIRST, "end = max(lost_since(np.maximum(a, b), limit), 0) or len(a)"),
    ),
    Slip(
        "strayed-drives-left-out",
        "Only drives that have no reading at all before a filter strays are left out. The others count up "
        "to there.",
        (
            LEFT,
            "if len(strayed) < 0.3 * len(a) and end > len(a) // 2 or end == len(a) or len(differences) < 6 and end:",
        ),
    ),
    Slip(
        "empty-drives-as-zero",
        "A drive without any reading to compare is no draw: it says nothing, and is left out of n as well.",
        (LEFT, "if True:"),
        [(LEFT, "if True:"), (RMS, f"({RMS} if end else 0.0)")],
        (
            ENDS.join(["return ", ""]),
            "d, n = np.sort(differences), len(errors_a)\n    chances = np.cumsum([comb(n, k) / 2**n for k in range(n + 1)])\n    few = min(np.sum(chances <= 0.025), len(d) - 1)\n    return d[few - 1], d[len(d) - few]",
        ),
    ),
    Slip(
        "at-least-two-readings",
        "One reading is enough for a drive to count.",
        (LEFT, "if end > 1 or len(a) == 1:"),
    ),
    Slip(
        "means",
        "These are means of the errors. An RMS is the root of the mean of their squares.",
        (RMS, "np.mean(a[:end]) - np.mean(b[:end])"),
    ),
    Slip(
        "median-of-a-drive",
        "On each drive the RMS is asked for; the median is taken over the drives.",
        (RMS, "np.median(a[:end]) - np.median(b[:end])"),
    ),
    Slip(
        "last-reading-of-a-drive",
        "You compare one reading of each drive: its last one, or its worst. The RMS goes over all of them.",
        (RMS, "a[end - 1] - b[end - 1]"),
        (RMS, "np.max(a[:end]) - np.max(b[:end])"),
    ),
    Slip(
        "mean-squares",
        "The root is missing: these are squares, in m².",
        (RMS, "np.mean(a[:end] ** 2) - np.mean(b[:end] ** 2)"),
    ),
    Slip(
        "root-of-sums",
        "The mean is missing under the root: a longer drive would count as a worse one.",
        (RMS, RMS.replace("np.mean", "np.sum")),
    ),
    Slip(
        "rms-of-differences",
        "This is a difference reading by reading. Each filter has its own RMS; then one is taken from the "
        "other.",
        (RMS, "np.sqrt(np.mean((a[:end] - b[:end]) ** 2))"),
        (RMS, "np.mean(a[:end] - b[:end]) / np.sqrt(end)"),
    ),
    Slip(
        "unsorted",
        "The differences are still in the order of the drives. So many *below μ* is a question of size.",
        (SORT, "d, n = np.array(differences), len(differences)"),
    ),
    Slip(
        "one-in",
        "The interval is too narrow by a difference at an end. At which difference does the number of those below "
        "μ become possible?",
        (ENDS, "d[few], d[n - 1 - few]"),
        (ENDS, "d[few], d[n - few]"),
        (ENDS, "d[few - 1], d[n - few - 1]"),
    ),
    Slip(
        "one-out",
        "The interval is too wide by a difference at an end. How many differences lie below a μ that is just "
        "above your lower end?",
        (ENDS, "d[max(few - 2, 0)], d[min(n - few + 1, n - 1)]"),
        (ENDS, "d[max(few - 2, 0)], d[n - few]"),
        (ENDS, "d[few - 1], d[min(n - few + 1, n - 1)]"),
    ),
    Slip(
        "both-sides-together",
        "The chance of 2.5 % is that of either side: together they make the 5 % that is missing.",
        (FEW, "few = np.sum(chances <= 0.05)"),
        (FEW, "few = max(np.sum(chances <= 0.0125), 1)"),
        (FEW, "few = max(np.sum(chances <= 0.005), 1)"),
    ),
    Slip(
        "exactly-so-many",
        "You ask how likely *exactly* so many heads are. Rare is so few or fewer: add them up.",
        (FEW, "few = np.sum(np.diff(chances, prepend=0)[: n // 2] <= 0.025)"),
    ),
    Slip(
        "by-the-bell",
        "You took a bell for the coins. It is near, but with so few drives the ends move by a difference: "
        "use the chances of the coins themselves.",
        (FEW, "few = int(np.floor(n / 2 - 1.96 * np.sqrt(n) / 2))\n    few = max(few, 1)"),
        (FEW, "few = max(round(n / 2 - 1.96 * np.sqrt(n) / 2), 1)"),
        (FEW, "few = int(np.ceil(n / 2 - 1.96 * np.sqrt(n) / 2))"),
        (FEW, "few = max(int(n * interval(n / 2, n)[0]), 1)"),
    ),
    Slip(
        "middle-of-the-data",
        "These ends hold 95 % of all *drives*. Asked for is how sure the *median* is, which many drives make "
        "surer.",
        (f"return {ENDS}", "return np.quantile(d, [0.025, 0.975])"),
        (FEW, "few = 1"),
    ),
    Slip(
        "interval-of-the-mean",
        "This is an interval of the mean difference, or one that takes the differences for a bell. Nothing is "
        "known of their shape: count how many lie below μ.",
        (f"return {ENDS}", f"t = 1.96\n    return {MEANS}"),
        (
            f"return {ENDS}",
            f"from scipy.stats import t as student\n    t = student.ppf(0.975, n - 1)\n    return {MEANS}",
        ),
        (
            f"return {ENDS}",
            f"t = 1.2533 * 1.96\n    return {MEANS.replace('np.mean(diff', 'np.median(diff')}",
        ),
        (f"return {ENDS}", f"t = 2\n    return {MEANS}"),
        (f"return {ENDS}", f"t = 1.96\n    return {MEANS.replace(', ddof=1', '')}"),
        (f"return {ENDS}", f"t = 1.96 * np.sqrt(n)\n    return {MEANS}"),
        (f"return {ENDS}", f"t = 1.96 * np.sqrt(n)\n    return {MEANS.replace(', ddof=1', '')}"),
    ),
    Slip(
        "share-of-drives",
        "This is an interval of the share of drives on which A is nearer. Asked for is by how much, in metres.",
        (f"return {ENDS}", "return interval(int(np.sum(d < 0)), n)"),
        (f"return {ENDS}", "return interval(int(np.sum(d > 0)), n)"),
    ),
    Slip(
        "median-only",
        "This is the median itself, twice. How sure is it?",
        (f"return {ENDS}", "return np.median(d), np.median(d)"),
    ),
    Slip(
        "high-before-low",
        "The ends are in the wrong order: the lower one first.",
        (ENDS, "d[n - few], d[few - 1]"),
    ),
    Slip(
        "sorted-in-time",
        "The errors of a drive were sorted. Their order in time says until when both were near.",
        ("    differences = []", "    errors_a.sort(axis=1)\n    differences = []"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (ENDS, "np.median(d)"),
        (f"return {ENDS}", "pass"),
        (ENDS, "d"),
    ),
    Stumble("raised", (RMS, "rms(a[:end]) - rms(b[:end])"), (ENDS, "d[few - 1], d[n]")),
)

EQUIVALENT = {}
