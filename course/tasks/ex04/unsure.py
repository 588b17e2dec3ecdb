"""Programs of 04-unsure-drive: mean and covariance after a drive with an unsure heading."""

from course.tasks import Slip, Stumble
from course.tasks.ex04.unsure_ways import SECOND_ORDER, SIGMA_POINTS, WAYS  # noqa: F401

TASK = "04-unsure-drive"

_SCATTER = "covariance[:2, :2] += P[:2, :2] - np.outer(lean, lean)"
_NOISE = "covariance[:2, :2] += C[0, 0] * ahead.T @ (weights[:, None] * ahead)"
_SIDES = "    covariance[:2, 2] += together\n    covariance[2, :2] += together\n"
_RETURNS = "return mean, covariance"
_STRAIGHT = "np.array([x[0] + u[0] * np.cos(x[2]), x[1] + u[0] * np.sin(x[2]), x[2] + u[1]])"


def _covariance(changed):
    return (_RETURNS, f"return mean, {changed}")


SLIPS = (
    Slip(
        "linearised",
        "This is the linearised step. It knows the slope of f at one heading only, and the headings of "
        "these robots are spread over a quarter of a circle. What do you learn from f at other headings?",
        "def unsure_drive(x, P, u, C):\n    return linearised(x, P, u, C)",
        """
def unsure_drive(x, P, u, C):
    return unsure_drive.mean(x, P, u, C), linearised(x, P, u, C)[1]

def _mean(x, P, u, C):
    along = np.exp(-P[2, 2] / 2) * np.array([np.cos(x[2]), np.sin(x[2])])
    return np.array([*(x[:2] + u[0] * along), x[2] + u[1]])

unsure_drive.mean = _mean
""",
    ),
    Slip(
        "straight-mean",
        "Your mean is f(x, u), the end of a robot that has just the believed heading. Those that head "
        "elsewhere get less far in that direction: where is their average?",
        (_RETURNS, f"return {_STRAIGHT}, covariance"),
        ("mean = weights @ ends", f"mean = {_STRAIGHT}"),
    ),
    Slip(
        "scatter-ignored",
        "x and y are taken as certain once the heading is given. How unsure is the place of robots that "
        "all have the same heading?",
        (_SCATTER, "pass"),
    ),
    Slip(
        "lean-counted-twice",
        "What x and y share with the heading is counted twice: once in where they are for each heading, "
        "and once more in P's block of the place.",
        (_SCATTER, "covariance[:2, :2] += P[:2, :2]"),
    ),
    Slip(
        "lean-ignored",
        "x and y are treated as if they did not err together with the heading. P has entries that say "
        "so: where would robots stand that head more to the left?",
        ("lean = P[:2, 2] / sigma", "lean = np.zeros(2)"),
        ("places = x[:2] + np.outer(t, lean) + u[0] * ahead", "places = x[:2] + u[0] * ahead"),
    ),
    Slip(
        "lean-not-per-sigma",
        "The share of x and y in the heading's error has the wrong power of σ: look at its unit, metres "
        "per step of your t.",
        ("lean = P[:2, 2] / sigma", "lean = P[:2, 2]"),
        ("lean = P[:2, 2] / sigma", "lean = P[:2, 2] / sigma**2"),
        ("lean = P[:2, 2] / sigma", "lean = P[:2, 2] * sigma"),
    ),
    Slip(
        "variance-for-sigma",
        "A variance is used as a standard deviation, or the other way round: P holds variances.",
        ("sigma = np.sqrt(P[2, 2])", "sigma = P[2, 2]"),
        ("sigma = np.sqrt(P[2, 2])", "sigma = P[2, 2]**2"),
        ("np.exp(-(t**2) / 2)", "np.exp(-(t**2))"),
        ("np.exp(-(t**2) / 2)", "np.exp(-np.abs(t) / 2)"),
    ),
    Slip(
        "equal-weights",
        "All headings of the fan count alike: a heading that is 3σ off is far less likely than the "
        "believed one.",
        ("np.exp(-(t**2) / 2)", "np.ones(25)"),
    ),
    Slip(
        "wheels-trusted",
        "The drive's own noise C is left out: a robot that is sure of its pose would be sure of its end.",
        [
            (_NOISE, "pass"),
            ("together = C[0, 1] * weights @ ahead", "together = 0"),
            ("covariance[2, 2] += C[1, 1]", "pass"),
        ],
    ),
    Slip(
        "distance-noise-missing",
        "The noise of the distance is left out, or does not lie along the way that was driven: C[0, 0] "
        "scatters each robot along its own heading.",
        (_NOISE, "pass"),
        (_NOISE, "covariance[:2, :2] += C[0, 0] * np.eye(2)"),
        (_NOISE, "covariance[:2, :2] += C[0, 0] * np.eye(2) / 2"),
        (_NOISE, "covariance[0, 0] += C[0, 0]"),
    ),
    Slip(
        "noise-along-one-heading",
        "The noise of the distance is laid along the believed heading only: robots that head elsewhere "
        "scatter along theirs.",
        (
            _NOISE,
            "one = np.array([np.cos(x[2]), np.sin(x[2])])\n"
            "    covariance[:2, :2] += C[0, 0] * np.outer(one, one)",
        ),
    ),
    Slip(
        "turn-noise-missing",
        "The heading after the drive is as sure as before: the turn Δθ has a variance of its own.",
        ("covariance[2, 2] += C[1, 1]", "pass"),
    ),
    Slip(
        "noises-apart",
        "Errors of distance and turn go together where C is no diagonal matrix: which block of the "
        "covariance do they reach?",
        ("together = C[0, 1] * weights @ ahead", "together = 0"),
    ),
    Slip(
        "standard-deviations-of-the-wheels",
        "C holds variances already: look whether you take a root or a square of it.",
        ("sigma = np.sqrt(P[2, 2])", "sigma, C = np.sqrt(P[2, 2]), np.sqrt(np.abs(C))"),
        ("sigma = np.sqrt(P[2, 2])", "sigma, C = np.sqrt(P[2, 2]), C**2"),
    ),
    Slip(
        "turn-forgotten",
        "The turn Δθ is missing in the mean: the robot drives, and then it turns.",
        ("x[2] + u[1] + sigma * t", "x[2] + sigma * t"),
    ),
    Slip(
        "turn-before-drive",
        "The robot drives along the heading it had, and turns after that. Yours turns first.",
        (
            "np.cos(x[2] + sigma * t), np.sin(x[2] + sigma * t)",
            "np.cos(x[2] + u[1] + sigma * t), np.sin(x[2] + u[1] + sigma * t)",
        ),
        (
            "np.cos(x[2] + sigma * t), np.sin(x[2] + sigma * t)",
            "np.cos(x[2] + u[1] / 2 + sigma * t), np.sin(x[2] + u[1] / 2 + sigma * t)",
        ),
    ),
    Slip(
        "wrapped-ends",
        "Ends just beyond π count as −π: an average of wrapped angles means nothing. At which angle can "
        "you cut the circle instead?",
        (
            "off = ends - mean",
            "ends[:, 2] = np.arctan2(np.sin(ends[:, 2]), np.cos(ends[:, 2]))\n"
            "    mean = weights @ ends\n    off = ends - mean",
        ),
        (
            "places = x[:2] + np.outer(t, lean) + u[0] * ahead\n"
            "    ends = np.column_stack([places, x[2] + u[1] + sigma * t])",
            "ends = np.array([f_odometry([*(x[:2] + k * lean), x[2] + k * sigma], u) for k in t])",
        ),
    ),
    Slip(
        "mean-not-subtracted",
        "That is the mean of the squares: a covariance is taken about the mean.",
        ("off = ends - mean", "off = ends"),
    ),
    Slip(
        "about-the-straight-end",
        "Deviations are taken from f(x, u), not from the mean of the ends.",
        ("off = ends - mean", f"off = ends - {_STRAIGHT}"),
    ),
    Slip(
        "heading-apart",
        "Place and heading are made independent: robots that head more to the left end more to the left.",
        _covariance("covariance * np.array([[1, 1, 0], [1, 1, 0], [0, 0, 1]])"),
    ),
    Slip(
        "diagonal-only",
        "Only the variances are left: without the entries beside the diagonal the ellipse cannot lie "
        "across the way.",
        _covariance("np.diag(np.diag(covariance))"),
    ),
    Slip(
        "blown-up",
        "The covariance is larger or smaller than it should be by a fixed factor. It costs in every "
        "drive: to be on the safe side is no better than to be sure.",
        _covariance("2 * covariance"),
        _covariance("4 * covariance"),
        _covariance("covariance / 2"),
        _covariance("1.5 * covariance"),
    ),
    Slip(
        "standard-deviations",
        "A covariance is asked for, and these are standard deviations.",
        _covariance("np.diag(np.sqrt(np.diag(covariance)))"),
        _covariance("np.sign(covariance) * np.sqrt(np.abs(covariance))"),
    ),
    Slip(
        "one-sided",
        "The covariance is not symmetric: what stands above the diagonal must stand below it, too.",
        (_SIDES, "    covariance[:2, 2] += together\n"),
        (_SIDES, "    covariance[2, :2] += together\n"),
    ),
    Slip(
        "heading-wide-fan",
        "The fan of headings does not reach far enough: a Gaussian is cut off, and its spread with it.",
        ("np.linspace(-6, 6, 25)", "np.linspace(-1, 1, 25)"),
        ("np.linspace(-6, 6, 25)", "np.linspace(-2, 2, 25)"),
    ),
    Slip(
        "sigma-points",
        "These are the unscented transform's 2n + 1 points: two headings beside the believed one. They "
        "beat the linearised step, and miss how the ends bend. How many headings would you need?",
        *(SIGMA_POINTS.replace("KAPPA", str(k)) for k in (-2, 0, 1)),
    ),
    Slip(
        "second-order",
        "These are the mean and covariance to second order: better than a slope alone. But half a radian "
        "is far from small, and the next orders matter, too. Is there a way without a series?",
        SECOND_ORDER,
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (_RETURNS, "return covariance, mean"),
        (_RETURNS, "return mean"),
        (_RETURNS, "return mean, covariance[:2, :2]"),
        (_RETURNS, "return mean[:2], covariance"),
        (_RETURNS, "return None, covariance"),
        (_RETURNS, "return mean, covariance / 0"),
    ),
    Stumble("not attempted", (_RETURNS, "raise NotImplementedError")),
    Stumble("raised", ("np.linspace(-6, 6, 25)", "np.linspace(-6, 6, 25)[:, None]")),
)

PASTED = {
    "the linearised step": "unsure_drive = linearised",
    "the lesson's A P Aᵀ + Q": """
def unsure_drive(x, P, u, C):
    d, s, c = u[0], np.sin(x[2]), np.cos(x[2])
    A = np.array([[1, 0, -d * s], [0, 1, d * c], [0, 0, 1]])
    W = np.array([[c, 0], [s, 0], [0, 1]])
    return f_odometry(x, u), A @ P @ A.T + W @ C @ W.T
""",
    "slopes by differences": """
def unsure_drive(x, P, u, C):
    def slopes(f, v, step=1e-6):
        return np.column_stack([(f(v + e) - f(v - e)) / (2 * step) for e in step * np.eye(len(v))])
    A, W = slopes(lambda v: f_odometry(v, u), x), slopes(lambda v: f_odometry(x, v), u)
    return f_odometry(x, u), A @ P @ A.T + W @ C @ W.T
""",
    "new_landmark for the place": """
def unsure_drive(x, P, u, C):
    P_nn, P_rn = new_landmark(x, P, [u[0], 0], np.diag([C[0, 0], 0]))
    S = np.zeros((3, 3))
    S[:2, :2], S[:2, 2], S[2, :2], S[2, 2] = P_nn, P_rn[2], P_rn[2], P[2, 2] + C[1, 1]
    return np.array([*g(x, [u[0], 0]), x[2] + u[1]]), S
""",
    "the belief as it was": """
def unsure_drive(x, P, u, C):
    return f_odometry(x, u), P
""",
}

_OTHERS = "other headings or other samples, and still enough of them"
EQUIVALENT = {
    "t = np.linspace": _OTHERS,
    "hermegauss(": _OTHERS,
    "rng": _OTHERS,
    "across + C[0, 1] * e": "loses 0.001 nats, seldom 0.01, and so much is granted",
    "aweights=weights))": "loses less than 0.01 nats, which are granted",
}
