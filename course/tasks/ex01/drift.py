"""Right ways and slips of 01-drift."""

from course.tasks import Slip, Stumble
from slamlab.exercises.tasks.ex01.drift import SIMULATED

TASK = "01-drift"

WAYS = {
    "in closed form, as an array of one": """
def drift(n, d, sigma):
    return np.array([sigma * d * np.sqrt(n * (n - 1) * (2 * n - 1) / 6)])
""",
    "the sine of each error": """
def drift(n, d, sigma):
    return d * np.sin(sigma) * np.linalg.norm(np.arange(n))
""",
    "as the root of a covariance": """
def drift(n, d, sigma):
    P = np.zeros((2, 2))
    A = np.array([[1, d], [0, 1]])
    for _ in range(n):
        P = A @ P @ A.T + np.diag([0, sigma**2])
    return np.sqrt(P[0, 0])
""",
    "a loop": """
def drift(n, d, sigma):
    import math

    total = 0.0
    for k in range(1, n + 1):
        total += ((n - k) * d * sigma) ** 2
    return math.sqrt(total)
""",
    "a matrix of all errors on all steps": """
def drift(n, d, sigma):
    bent = np.tril(np.ones((n, n)), -1)
    aside = d * sigma * bent.sum(axis=0)
    return float(np.sqrt(aside @ aside))
""",
    "variances step by step": """
def drift(n, d, sigma):
    variance = sum((d * sigma * k) ** 2 for k in range(n))
    return variance**0.5
""",
}

BENDS, ROOT = "bends = np.arange(n)", "np.sqrt(np.sum(bends**2))"
RESULT = "sigma * d * " + ROOT

SLIPS = (
    Slip(
        "each error bends one step",
        "You let each error bend one step only. The robot keeps a wrong heading: an error bends every "
        "step that follows.",
        (RESULT, "sigma * d * np.sqrt(n)"),
        (RESULT, "sigma * d * np.sqrt(max(n - 1, 0))"),
    ),
    Slip(
        "errors added up",
        "You add the errors as if all went to the same side. Independent errors partly cancel: add their "
        "squares, then take the root.",
        (RESULT, "sigma * d * np.sum(bends)"),
    ),
    Slip(
        "errors added before they are squared",
        "The errors were added first and squared afterwards, or the root was taken of their plain sum. "
        "Square each, add, and take the root at the end.",
        (RESULT, "sigma * d * np.sqrt(np.sum(bends))"),
        (RESULT, "np.sqrt(np.sum(sigma * d * bends))"),
    ),
    Slip(
        "first step bent too",
        "You bend the first step as well. The robot moves first and picks up the error then: the first "
        "error bends n − 1 steps, the last none.",
        (BENDS, "bends = np.arange(1, n + 1)"),
    ),
    Slip(
        "one error left out",
        "The first error, which bends n − 1 steps, is missing: see where the numbers end that you "
        "count.",
        (BENDS, "bends = np.arange(n - 1)"),
    ),
    Slip(
        "one error at the start",
        "You bend the whole way by a single error. There are n of them, each picked up later.",
        (RESULT, "sigma * d * n"),
        (RESULT, "sigma * d * max(n - 1, 0)"),
    ),
    Slip(
        "whole heading error from the start",
        "You bend the whole way by the heading error of the end. Early steps are bent less: only by the "
        "errors picked up before them.",
        (RESULT, "sigma * d * n * np.sqrt(n)"),
        (RESULT, "sigma * d * n * np.sqrt(max(n - 1, 0))"),
        (RESULT, "sigma * d * max(n - 1, 0) * np.sqrt(n)"),
    ),
    Slip(
        "for long drives only",
        "This holds for many steps, where the sum of k² is nearly n³/3. For few steps it is not: add "
        "the squares themselves.",
        (RESULT, "sigma * d * np.sqrt(n**3 / 3)"),
        (RESULT, "sigma * d * np.sqrt(n**2 * (2 * n) / 6)"),
    ),
    Slip(
        "mean for sum",
        "That is the mean of the squares. n errors do more harm than one: their variances add up.",
        (ROOT, "np.sqrt(np.mean(bends**2)) if n else 0.0"),
        (ROOT, "np.std(bends) if n else 0.0"),
    ),
    Slip(
        "root forgotten",
        "That is the variance, in m². The spread is its root, in m.",
        (RESULT, "sigma**2 * d**2 * np.sum(bends**2)"),
        (RESULT, "sigma * d * np.sum(bends**2)"),
    ),
    Slip(
        "variance for deviation",
        "sigma is a standard deviation already, and so is what is asked for: look whether you take a "
        "root or a square of it that is not undone.",
        (RESULT, "np.sqrt(sigma * d * np.sum(bends**2))"),
        (RESULT, "np.sqrt(sigma) * d * np.sqrt(np.sum(bends**2))"),
        (RESULT, "sigma**2 * d * np.sqrt(np.sum(bends**2))"),
        (RESULT, "sigma * np.sqrt(d * np.sum(bends**2))"),
    ),
    Slip(
        "two standard deviations",
        "That is twice the standard deviation, in which 95 % of the robots end. Asked is one.",
        (RESULT, "2 * sigma * d * np.sqrt(np.sum(bends**2))"),
    ),
    Slip(
        "step counted as one metre",
        "The length of a step is missing: a bent step leads aside by d times the angle.",
        (RESULT, "sigma * np.sqrt(np.sum(bends**2))"),
    ),
    Slip(
        "length squared",
        "The length of a step counts once in the spread, and squared only in the variance.",
        (RESULT, "sigma * d**2 * np.sqrt(np.sum(bends**2))"),
    ),
    Slip(
        "degrees",
        "The error is given in radians already, and in radians a small angle equals its sine.",
        (RESULT, "np.degrees(sigma) * d * np.sqrt(np.sum(bends**2))"),
        (RESULT, "np.radians(sigma) * d * np.sqrt(np.sum(bends**2))"),
    ),
    Slip(
        "the whole way, not sideways",
        "That is how far the robot drives. Asked is how far from its line it ends.",
        (RESULT, "n * d"),
        (RESULT, "n * d * np.cos(sigma)"),
    ),
    Slip(
        SIMULATED.name,
        SIMULATED.hint,
        """
def drift(n, d, sigma):
    errors = sigma * np.random.default_rng(0).standard_normal((400, n))
    return d * np.std((np.cumsum(errors, axis=1) - errors).sum(axis=1))
""",
    ),
    Slip(
        "headings' errors added",
        "You add up how wrong the heading is at each step, as if these were errors of their own. One "
        "error is in all the headings that follow it: ask how far aside each single error leads.",
        (RESULT, "sigma * d * np.sum(np.sqrt(bends))"),
        (RESULT, "sigma * d * np.sum(np.sqrt(bends + 1))"),
        (RESULT, "sigma * d * np.sqrt(np.sum(bends + 1))"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        "def drift(n, d, sigma):\n    return sigma * d * np.arange(n)\n",
        "def drift(n, d, sigma):\n    sigma * d * n\n",
        (ROOT, "np.nan"),
    ),
    Stumble("raised", (BENDS, "bends = np.range(n)")),
    Stumble("not attempted", "def drift(n, d, sigma):\n    raise NotImplementedError"),
)

EQUIVALENT = {}
