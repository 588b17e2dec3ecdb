"""Programs of task 11-localise."""

from course.tasks import Slip, Stumble
from course.tasks.ex11.localise_ways import WAYS

__all__ = ["WAYS"]

TASK = "11-localise"
MUTANTS = 120  # of the solution: a run takes long

MOVE = "    rows = move(rows, u, C, rng)\n"
WEIGH = "    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))\n"
LOGS = "np.log(weights) + log_likelihoods(rows, p, z, R)"
WHEN = "effective_size(weights) < len(rows) / 2"
DRAWN = "rows = rows[draw(weights, rng)]"
EQUAL = "        weights = np.full(len(rows), 1 / len(rows))\n"
RETURN = "return rows, weights"
MOTION = (
    "    before = rows\n" + MOVE + "    off = rows - before\n"
    "    c, s = np.cos(before[:, 2]), np.sin(before[:, 2])\n"
    "    e = np.column_stack([c * off[:, 0] + s * off[:, 1], wrap(off[:, 2])]) - u\n"
    "    motion = -0.5 * np.sum(e @ np.linalg.inv(C) * e, axis=1)\n"
)

SLIPS = (
    Slip(
        "not-moved",
        "The samples stand where they stood: the robot has driven before it sees.",
        (MOVE, ""),
        (MOVE, "    moved = move(rows, u, C, rng)\n"),
        (MOVE, "    move(rows, u, C, rng)\n"),
    ),
    Slip(
        "moved-twice",
        "The samples drive twice in one step.",
        (MOVE, MOVE + MOVE),
    ),
    Slip(
        "moved-without-noise",
        "The samples drive as if the wheels did not err: the cloud's doubt never grows.",
        (MOVE, "    rows = np.array([f_odometry(x, u) for x in rows])\n"),
        ("move(rows, u, C, rng)", "move(rows, u, 0 * C, rng)"),
    ),
    Slip(
        "one-draw-for-all",
        "The whole cloud drives by one draw of the wheels' noise, so that it is shifted and never spreads. "
        "Nobody knows what the wheels did: each sample has a draw of its own.",
        (
            MOVE,
            "    drive = rng.multivariate_normal(u, C)\n"
            "    rows = np.array([f_odometry(x, drive) for x in rows])\n",
        ),
        ("move(rows, u, C, rng)", "move(rows, rng.multivariate_normal(u, C), 0 * C, rng)"),
    ),
    Slip(
        "noise-rooted",
        "C holds variances, and move takes it as it is.",
        ("move(rows, u, C, rng)", "move(rows, u, np.sqrt(np.abs(C)) * np.eye(2), rng)"),
        ("move(rows, u, C, rng)", "move(rows, u, C @ C, rng)"),
    ),
    Slip(
        "weighed-before-moving",
        "The scan is seen after the drive, but you weigh the samples where they were before it.",
        [(MOVE, ""), (WEIGH, WEIGH + MOVE)],
        [(MOVE, "    before = rows\n" + MOVE), (LOGS, LOGS.replace("(rows", "(before"))],
    ),
    Slip(
        "moved-at-the-end",
        "You move the samples after they were drawn: the scan is then weighed where the robot was "
        "before it drove.",
        [(MOVE, ""), (RETURN, "return move(rows, u, C, rng), weights")],
    ),
    Slip(
        "drawn-first",
        "You draw by the weights of the step before, and only then look at the scan.",
        [
            (MOVE, MOVE + "    rows, old = rows[draw(weights, rng)], weights\n"),
            (LOGS, "log_likelihoods(rows, p, z, R)"),
            (WHEN, "False"),
        ],
    ),
    Slip(
        "drawn-at-the-beginning",
        "You draw before the drive, by the weights of the step before, and not after the scan: what comes "
        "back may be worth next to nothing. The order is: move, weigh, draw.",
        *(
            [
                (
                    MOVE,
                    f"    if {when}:\n        rows = rows[draw(weights, rng)]\n"
                    f"        weights = np.full(len(rows), 1 / len(rows))\n{MOVE}",
                ),
                (WHEN, "False"),
            ]
            for when in ("2 * effective_size(weights) < len(rows)", "True")
        ),
    ),
    Slip(
        "motion-in-the-weight",
        "How likely the motion was is in the weight, an erratum of the thesis. Where the robot is likely to "
        "go there are many samples already; the weight is the likelihood alone.",
        [(MOVE, MOTION), (LOGS, f"{LOGS} + motion")],
        [(MOVE, MOTION), (LOGS, f"{LOGS} + motion"), (WHEN, "True")],
    ),
    Slip(
        "weights-forgotten",
        "The new weights are the likelihoods alone: what the samples weighed before is lost. Where "
        "nothing was drawn the weights carry what was seen.",
        (LOGS, "log_likelihoods(rows, p, z, R)"),
    ),
    Slip(
        "scan-forgotten",
        "The scan makes no difference: this is odometry, with a cloud that grows and grows.",
        (LOGS, "np.log(weights)"),
    ),
    Slip(
        "weights-not-logarithms",
        "Weights and logarithms are added up. Likelihoods multiply, so that logarithms add up.",
        ("np.log(weights) + ", "weights + "),
        (f"normalise({LOGS})", "normalise(weights * log_likelihoods(rows, p, z, R))"),
    ),
    Slip(
        "scan-twice",
        "The scan counts twice: the likelihood is multiplied in more than once.",
        ("+ log_likelihoods", "+ 2 * log_likelihoods"),
        (WEIGH, WEIGH + WEIGH),
    ),
    Slip(
        "sign",
        "The less likely a sample finds the scan, the more it weighs: the logarithm is subtracted.",
        ("+ log_likelihoods", "- log_likelihoods"),
    ),
    Slip(
        "underflow",
        "The likelihoods themselves are computed, and all of them are zero where the cloud is metres "
        "off: keep their logarithms until they are normalised.",
        (f"normalise({LOGS})", f"(lambda w: w / (np.sum(w) + 1e-300))(np.exp({LOGS}))"),
        (
            WEIGH,
            f"    weights = weights * np.exp({LOGS.split(' + ')[1]}) + 1e-300\n    weights = weights / np.sum(weights)\n",
        ),
    ),
    Slip(
        "weights-kept",
        "After drawing, the samples have their old weights, too: what is likely counts twice.",
        (EQUAL, ""),
        (EQUAL, "        pass\n"),
    ),
    Slip(
        "weights-drawn-along",
        "After drawing, the samples have the weights of those that they are copies of: what is likely "
        "counts twice.",
        [
            (DRAWN, "picked = draw(weights, rng)\n        rows = rows[picked]"),
            (EQUAL, "        weights = weights[picked] / np.sum(weights[picked])\n"),
        ],
    ),
    Slip(
        "never-drawn",
        "Nothing is ever drawn anew: after a few scans one sample has all the weight.",
        (WHEN, "False"),
        (WHEN, "effective_size(weights) < 2"),
        (WHEN, "effective_size(weights) < 0.5"),
    ),
    Slip(
        "drawn-too-late",
        "The cloud is worth less than half its samples, and yet you do not draw: look at the condition.",
        (WHEN, "effective_size(weights) < len(rows) / 10"),
    ),
    Slip(
        "always-drawn",
        "You draw although the cloud is worth more than half its samples: each draw loses some of "
        "them, and gains nothing then.",
        (WHEN, "True"),
        (WHEN, "effective_size(weights) < 0.9 * len(rows)"),
    ),
    Slip(
        "condition-turned",
        "You draw when the cloud is worth much, and not when it is worth little.",
        (WHEN, WHEN.replace("<", ">")),
        before=("never-drawn",),
    ),
    Slip(
        "worth-before-the-scan",
        "You ask what the cloud was worth before the scan, not after it.",
        [(MOVE, MOVE + "    worth = effective_size(weights)\n"), (WHEN, "worth < len(rows) / 2")],
        before=("never-drawn", "condition-turned"),
    ),
    Slip(
        "equal-without-drawing",
        "The weights are made equal without drawing: all that was seen is lost.",
        [(DRAWN, "pass"), (WHEN, "True")],
        (DRAWN, "draw(weights, rng)"),
        (DRAWN, "pass"),
    ),
    Slip(
        "drawn-from-the-old",
        "You draw from the samples as they were before the drive.",
        [(MOVE, "    before = rows\n" + MOVE), (DRAWN, "rows = before[draw(weights, rng)]")],
    ),
    Slip(
        "drawn-by-other-weights",
        "You draw by weights that do not hold this scan.",
        [(MOVE, "    old = weights\n" + MOVE), (DRAWN, "rows = rows[draw(old, rng)]")],
    ),
    Slip(
        "largest-weight",
        "All samples become copies of the one with the largest weight: all else that was possible is "
        "forgotten.",
        (DRAWN, "rows = rows[[weights.argmax()] * len(rows)]"),
        (DRAWN, "rows = np.tile(weights @ rows, (len(rows), 1))"),
    ),
    Slip(
        "weight-one",
        "The drawn samples weigh 1 each. All weights together are to be one.",
        ("1 / len(rows))", "1.0)"),
    ),
    Slip(
        "not-normalised",
        "The weights do not sum to one.",
        [
            (f"normalise({LOGS})", f"np.exp({LOGS} - np.max({LOGS}))"),
            (WHEN, "effective_size(normalise(np.log(weights + 1e-300))) < len(rows) / 2"),
            (DRAWN, "rows = rows[draw(weights / np.sum(weights), rng)]"),
        ],
    ),
    Slip(
        "logarithms-returned",
        "These are logarithms, or something of their kind: the next step takes weights.",
        (RETURN, "return rows, np.exp(weights) / np.sum(np.exp(weights))"),
    ),
    Slip(
        "shaken",
        "Something is added to the samples after they were drawn: their doubt was in the cloud "
        "already.",
        (DRAWN, "rows = rows[draw(weights, rng)] + rng.normal(0, [0.05, 0.05, 0.03], rows.shape)"),
        (DRAWN, "rows = move(rows[draw(weights, rng)], [0, 0], C, rng)"),
    ),
    Slip(
        "first-landmark-only",
        "Only one landmark of the scan is looked at.",
        ("(rows, p, z, R)", "(rows, p[:1], z[:1], R)"),
        ("(rows, p, z, R)", "(rows, p[-1:], z[-1:], R)"),
    ),
    Slip(
        "a-seed-of-its-own",
        "The samples drive with random numbers of a generator of your own, the same in each step.",
        ("move(rows, u, C, rng)", "move(rows, u, C, np.random.default_rng(0))"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (RETURN, "return rows"),
        (RETURN, "return weights, rows"),
        (RETURN, "return rows.T, weights"),
    ),
    Stumble("malformed", (RETURN, "return rows[: len(rows) // 2], weights")),
    Stumble("malformed", (LOGS, "np.log(-weights)")),
    Stumble("raised", ("move(rows, u, C, rng)", "move(rows, u, rng)")),
)

TIE = "no cloud is worth exactly half its samples"
EQUIVALENT = {
    f"if {WHEN}: -> if {WHEN.replace('<', '<=')}:": TIE,
    "if np.sum(weights**2) * n >= 2: -> if np.sum(weights**2) * n > 2:": TIE,
    "if 1 / (weights @ weights) < n / 2: -> if 1 / (weights @ weights) <= n / 2:": TIE,
    "if effective_size(weights) <= 0.5 * n: -> if effective_size(weights) < 0.5 * n:": TIE,
    "if 2 * effective_size(weights) < n: -> if 2 * effective_size(weights) <= n:": TIE,
}
