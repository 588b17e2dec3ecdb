"""Programs of task 11-weigh."""

from course.tasks import Slip, Stumble
from course.tasks.ex11.weigh_ways import WAYS

__all__ = ["WAYS"]

TASK = "11-weigh"

V, WRAP, INV = "seen - h(rows, place)", "wrap(v[:, 1])", "np.linalg.inv(R)"
ADD = "logs -= 0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)"
ONE = "0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)"
EXP = ("zeros(len(rows))", "ones(len(rows))"), (ADD, f"logs *= np.exp(-{ONE})")

SLIPS = (
    Slip(
        "whole-innovations",
        "Innovations were written into an array of whole numbers, which cuts their decimals off. Make it "
        "an array of floats.",
        """
def log_likelihoods(rows, p, z, R):
    logs = np.zeros(len(rows))
    for i, x in enumerate(rows):
        v = np.zeros_like(z)
        v[:] = z - h(x, p)
        v[:, 1] = wrap(v[:, 1])
        logs[i] = -0.5 * np.sum(v @ np.linalg.inv(R) * v)
    return logs
""",
        """
def log_likelihoods(rows, p, z, R):
    logs = np.zeros(len(rows))
    for i, x in enumerate(rows):
        v = z.copy()
        v -= h(x, p).astype(v.dtype)
        v[:, 1] = wrap(v[:, 1])
        logs[i] = -0.5 * np.sum(v @ np.linalg.inv(R) * v)
    return logs
""",
        shaky=True,  # a range of 5 m may be cut off to 4
    ),
    Slip(
        "unwrapped",
        "The innovation's bearing leaves (−π, π]: a landmark right behind, expected at 179° and seen "
        "at −179°, is 2° off, not 358°. Wrap z − h, not z and h one by one.",
        (WRAP, "v[:, 1]"),
        (WRAP, "wrap(seen[1]) - wrap(h(rows, place)[:, 1])"),
    ),
    Slip(
        "ranges-wrapped",
        "All of v is wrapped, the differences of ranges, too. Metres are no angle: a sample that is "
        "6.3 m off is taken for a good one.",
        ("v[:, 1] = wrap(v[:, 1])", "v = wrap(v)"),
    ),
    Slip(
        "wrong-column",
        "The range is wrapped, not the bearing: bearings stand in column 1.",
        ("v[:, 1] = wrap(v[:, 1])", "v[:, 0] = wrap(v[:, 0])"),
    ),
    Slip(
        "row-wrapped",
        "v holds a row for each sample, or each landmark. You wrap one of these rows, not the column of "
        "bearings: that stands on the last axis.",
        """
def log_likelihoods(rows, p, z, R):
    v = np.array([z - h(x, p) for x in rows])
    v[:, -1] = wrap(v[:, -1])
    return -0.5 * np.einsum("ijk,kl,ijl->i", v, np.linalg.inv(R), v)
""",
        ("v[:, 1] = wrap(v[:, 1])", "v[min(1, len(v) - 1)] = wrap(v[min(1, len(v) - 1)])"),
    ),
    Slip(
        "from-zero",
        "The innovation's bearing lies in [0, 2π): what is a little to the right becomes almost a full "
        "turn. It belongs in (−π, π].",
        (WRAP, "v[:, 1] % (2 * np.pi)"),
    ),
    Slip(
        "absolute",
        "You take the absolute value of v. Range and bearing err together, and whether both err to the "
        "same side matters.",
        (WRAP, "wrap(v[:, 1])\n        v = np.abs(v)"),
    ),
    Slip(
        "sign",
        "The logarithm grows with the distance: the farther off, the likelier.",
        ("logs -= ", "logs += "),
        ("return logs", "return -logs"),
    ),
    Slip(
        "half-forgotten",
        "The factor ½ is missing. Without it the sensor is believed to have half its variance.",
        ("0.5 * ", ""),
    ),
    Slip(
        "R-not-inverted",
        "R stands where R⁻¹ belongs: a good sensor would count for little.",
        (INV, "R"),
    ),
    Slip(
        "squared-or-rooted",
        "R holds variances, and a variance is a square already: look where you square it or take its "
        "root.",
        (INV, "np.linalg.inv(R @ R)"),
        (INV, "np.diag(1 / np.diag(R) ** 2)"),
        (INV, "np.diag(1 / np.sqrt(np.diag(R)))"),
        (ADD, "logs -= 0.5 * np.sum((v / np.diag(R)) ** 2, axis=1)"),
    ),
    Slip(
        "entry-by-entry",
        "1 / R inverts each entry by itself. What is needed is the inverse of the matrix.",
        (INV, "(1 / R)"),
    ),
    Slip(
        "correlation-forgotten",
        "Only the diagonal of R counts in yours. Range and bearing may err together.",
        (INV, "np.diag(1 / np.diag(R))"),
    ),
    Slip(
        "distance-not-squared",
        "That is a distance in units of σ, not its square.",
        (ONE, "0.5 * np.sqrt(np.sum(v @ np.linalg.inv(R) * v, axis=1))"),
    ),
    Slip(
        "compared-as-points",
        "Landmark and sighting were compared as points, in x and y. R is told of range and bearing: turned "
        "into x and y it would be another matrix for each sighting.",
        *(
            f"""
def log_likelihoods(rows, p, z, R):
    seen = z[:, :1] * np.column_stack([np.cos(z[:, 1]), np.sin(z[:, 1])])
    logs = []
    for x in rows:
        c, s = np.cos(x[2]), np.sin(x[2])
        Rot = np.array([[c, -s], [s, c]])
        v = {off}
        logs.append(-0.5 * np.sum(v @ np.linalg.inv(R) * v))
    return np.array(logs)
"""
            for off in ("seen - (p - x[:2]) @ Rot", "seen @ Rot.T + x[:2] - p")
        ),
    ),
    Slip(
        "R-forgotten",
        "R does not count at all: metres and radians are added up as they are.",
        ("v @ np.linalg.inv(R) * v", "v * v"),
    ),
    Slip(
        "degrees",
        "The innovation's bearing is in degrees, while R counts in radians.",
        (WRAP, "np.degrees(wrap(v[:, 1]))"),
    ),
    Slip(
        "range-only",
        "Only the range counts. A sighting is two numbers, and v has two entries.",
        (ADD, "logs -= 0.5 * v[:, 0] ** 2 / R[0, 0]"),
        (WRAP, "0"),
    ),
    Slip(
        "bearing-only",
        "Only the bearing counts. A sighting is two numbers, and v has two entries.",
        (ADD, "logs -= 0.5 * v[:, 1] ** 2 / R[1, 1]"),
        (WRAP, "wrap(v[:, 1])\n        v[:, 0] = 0"),
    ),
    Slip(
        "all-alike",
        "All samples get the same: what each of them expects to see is missing.",
        (V, "np.tile(seen - h(rows[0], place), (len(rows), 1))"),
        (V, "np.tile(seen - h(rows.mean(axis=0), place), (len(rows), 1))"),
        ("return logs", "return 0 * logs + logs.sum()"),
    ),
    Slip(
        "heading-forgotten",
        "The samples' headings do not count: a bearing is told from the heading.",
        (V, "seen - h(rows * [1, 1, 0], place)"),
    ),
    Slip(
        "mean-over-landmarks",
        "You take the mean over the landmarks: then ten sightings tell no more than one.",
        ("return logs", "return logs / len(p)"),
    ),
    Slip(
        "first-landmark",
        "Only the first landmark counts: where does the function end?",
        ("    return logs", "        return logs"),
    ),
    Slip(
        "last-landmark",
        "Only the last landmark counts: do you start anew inside the loop?",
        (ADD, f"logs = -{ONE}"),
    ),
    Slip(
        "last-dropped",
        "One landmark is left out: the loop ends too early or begins too late.",
        ("zip(p, z, strict=True)", "zip(p[:-1], z[:-1])"),
        ("zip(p, z, strict=True)", "zip(p[1:], z[1:])"),
    ),
    Slip(
        "worst-or-best-only",
        "Only the worst or the best sighting counts. All of them do.",
        (ADD, f"logs = np.minimum(logs, -{ONE})"),
        [(ADD, f"logs = np.maximum(logs, -{ONE})"), ("zeros(len(rows))", "full(len(rows), -1e9)")],
    ),
    Slip(
        "likelihood-first",
        "Far samples have the logarithm −∞: the likelihood was computed first, and was zero. Add up "
        "logarithms; no exponential is needed at all.",
        [*EXP, ("return logs", "return np.log(logs)")],
        ("return logs", "return np.log(np.exp(logs))"),
    ),
    Slip(
        "underflow-patched",
        "Something small was added so that no logarithm of zero is taken: far samples cannot be told "
        "apart then. Leave the exponential out.",
        ("return logs", "return np.log(np.exp(logs) + 1e-300)"),
        ("return logs", "return np.maximum(logs, -700)"),
        [*EXP, ("return logs", "return np.log(np.maximum(logs, 1e-300))")],
        *(
            (ADD, f"logs += np.log(np.exp(-{ONE}) + {small})")
            for small in ("1e-300", "1e-12", "1e-9")
        ),
        *(
            (ADD, f"logs += np.log(np.maximum(np.exp(-{ONE}), {small}))")
            for small in ("1e-300", "1e-12")
        ),
    ),
    Slip(
        "no-logarithm",
        "These are likelihoods, not their logarithms. Far samples get zero, however far they are.",
        ("return logs", "return np.exp(logs)"),
        ("return logs", "return normalise(logs)"),
    ),
    Slip(
        "likelihoods-summed",
        "You add up likelihoods over the landmarks. Independent sightings multiply, so their "
        "logarithms add up.",
        [(ADD, f"logs += np.exp(-{ONE})"), ("return logs", "return np.log(logs)")],
    ),
    Slip(
        "whole-numbers",
        "The array that you add to holds whole numbers, so that all behind the point is lost.",
        [
            ("zeros(len(rows))", "zeros(len(rows), dtype=int)"),
            (ADD, f"logs = (logs - {ONE}).astype(int)"),
        ],
    ),
    Slip(
        "divided-by-the-sum",
        "Logarithms need no normalising: dividing them changes all their differences.",
        ("return logs", "return logs / logs.sum()"),
        ("return logs", "return logs / np.abs(logs).max()"),
    ),
    Slip(
        "pairs-mixed-up",
        "A landmark is compared with the sighting of another one: row j of z belongs to row j of p.",
        ("zip(p, z, strict=True)", "zip(p, z[::-1])"),
    ),
    Slip(
        "the-landmark-that-fits-best",
        "Each sighting is compared with the landmark that fits it best. The landmarks have names here: row "
        "j of z belongs to row j of p, however badly it fits. A sample that takes one for another is wrong.",
        *(
            f"""
def log_likelihoods(rows, p, z, R):
    logs = np.zeros(len(rows))
    for i, x in enumerate(rows):
        for seen in z:
            v = seen - h(x, p)
            v[:, 1] = wrap(v[:, 1])
            l = -0.5 * np.sum(v @ np.linalg.inv(R) * v, axis=1)
            logs[i] += l[{best}]
    return logs
"""
            for best in ("l.argmax()", "np.hypot(*v.T).argmin()", "np.abs(v[:, 1]).argmin()")
        ),
    ),
    Slip(
        "each-landmark-with-all",
        "Each landmark is compared with all sightings: row j of z belongs to row j of p alone.",
        (
            "for place, seen in zip(p, z, strict=True):",
            "for place, seen in [(place, seen) for place in p for seen in z]:",
        ),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        ("return logs", "return logs.sum()"),
        ("axis=1)\n", "axis=1)\n        v\n    logs = logs[:, None]\n"),
    ),
    Stumble("malformed", ("    return logs", "    logs")),
    Stumble("raised", (V, "seen - h(place, rows)"), ("np.zeros(len(rows))", "np.zeros(3)")),
    Stumble(
        "not attempted", "def log_likelihoods(rows, p, z, R):\n    raise NotImplementedError\n"
    ),
)
