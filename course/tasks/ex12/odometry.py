"""Programs of task 12-odometry."""

from course.tasks import Edit, Slip, Stumble
from course.tasks.ex12.odometry_ways import WAYS

__all__ = ["WAYS"]

TASK = "12-odometry"

L_R = "left * tick, right * tick"
TURN = "turn = (r - l) / base"
D = "(l + r) / 2 *"
CHORD = "chord = (l + r) / 2 * np.sinc(turn / (2 * np.pi))"
END = "[chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn]"
RADIUS = "by the radius of the arc"
MIDDLE = "about the middle of the curve"

SLIPS = (
    Slip(
        "straight-then-turn",
        "This robot drives the whole way straight on and turns at the end. It turns all the while: in "
        "which direction does the chord of an arc point?",
        [(CHORD, "chord = (l + r) / 2"), (END, "[chord, 0, turn]")],
        (END, "[chord, 0, turn]"),
    ),
    Slip(
        "turn-then-straight",
        "This robot turns first and drives the whole way then. It turns all the while, so the chord "
        "points neither along the old heading nor along the new one.",
        [
            (CHORD, "chord = (l + r) / 2"),
            (END, "[chord * np.cos(turn), chord * np.sin(turn), turn]"),
        ],
        (END, "[chord * np.cos(turn), chord * np.sin(turn), turn]"),
    ),
    Slip(
        "way-for-chord",
        "The direction is right, but the length is that of the arc. The chord is shorter.",
        (CHORD, "chord = (l + r) / 2"),
    ),
    Slip(
        "chord-of-another-angle",
        "The chord has the wrong length. Half of it is the side opposite to *half* the turn, in a triangle "
        "whose long side is the radius.",
        (CHORD, "chord = (l + r) / 2 * np.sinc(turn / np.pi)"),
        (CHORD, "chord = (l + r) / 2 * np.sinc(turn / (4 * np.pi))"),
        (CHORD, "chord = (l + r) / 2 * np.sinc(turn / (2 * np.pi)) / 2"),
        (CHORD, "chord = (l + r) / 2 * np.cos(turn / 2)"),
    ),
    Slip(
        "sinc-of-the-angle",
        "`np.sinc` is not sin(x)/x: look up where it puts π.",
        (CHORD, "chord = (l + r) / 2 * np.sinc(turn / 2)"),
        (CHORD, "chord = (l + r) / 2 * np.sinc(turn)"),
    ),
    Slip(
        "sides-swapped",
        "Left and right have changed places: a faster right wheel turns the robot to the left, which is "
        "counted positive.",
        (L_R, "right * tick, left * tick"),
        (TURN, "turn = (l - r) / base"),
    ),
    Slip(
        "turn-sign-returned",
        "The place is right, but θ has the wrong sign: to the left is positive.",
        (END, END.replace(", turn]", ", -turn]")),
    ),
    Slip(
        "half-base",
        "The turn is twice as large as it should be: the wheels are a whole base apart.",
        (TURN, "turn = 2 * (r - l) / base"),
    ),
    Slip(
        "double-base",
        "The turn is half as large as it should be. A robot with one wheel standing still turns about "
        "that wheel: how far away is the other?",
        (TURN, "turn = (r - l) / base / 2"),
    ),
    Slip(
        "half-turn-returned",
        "The chord points half the turn to the side, but the robot has turned by the whole of it.",
        (END, END.replace(", turn]", ", turn / 2]")),
    ),
    Slip(
        "base-forgotten",
        "The turn has the unit of a length: by what must the difference of both ways be divided?",
        (TURN, "turn = r - l"),
        (TURN, "turn = (r - l) * base"),
    ),
    Slip(
        "not-halved",
        "The robot's middle drives the *mean* of the two ways, not their sum.",
        (D, "(l + r) *"),
    ),
    Slip(
        "one-wheel",
        "This is the way of one wheel. The robot's middle is half way between both.",
        (D, "l *"),
        (D, "r *"),
        (D, "max(l, r) *"),
    ),
    Slip(
        "half-the-difference",
        "You took half the *difference* of both ways for the way of the middle: on a straight way this "
        "robot stands still.",
        (D, "(r - l) / 2 *"),
    ),
    Slip(
        "about-the-standing-wheel",
        "With one wheel at rest the robot turns about that wheel, but what is asked for is the way of its "
        "middle, half a base from there. The formula needs no case of its own.",
        Edit(
            RADIUS,
            (
                (
                    "    radius = (l + r) / 2 / turn\n",
                    "    radius = (l + r) / 2 / turn if l and r else base\n",
                ),
            ),
        ),
    ),
    Slip(
        "never-backwards",
        "This robot never drives backwards: negative ticks roll back, and the sign of the way matters.",
        (D, "abs(l + r) / 2 *"),
        (D, "(abs(l) + abs(r)) / 2 *"),
    ),
    Slip(
        "degrees",
        "An angle is in degrees where radians belong, or the other way round.",
        (END, END.replace(", turn]", ", np.degrees(turn)]")),
        [
            (
                END,
                "[chord * np.cos(np.radians(turn / 2)), chord * np.sin(np.radians(turn / 2)), turn]",
            )
        ],
    ),
    Slip(
        "ticks-for-metres",
        "Ticks were taken for metres. How far does a wheel roll with so many ticks?",
        (L_R, "left, right"),
        (L_R, "left / tick, right / tick"),
    ),
    Slip(
        "one-in-ticks",
        "One of both wheels is still counted in ticks.",
        (L_R, "left * tick, right"),
        (L_R, "left, right * tick"),
    ),
    Slip(
        "turn-in-ticks",
        "The turn is made of ticks; it needs metres, as the base does.",
        (TURN, "turn = (right - left) / base"),
    ),
    Slip(
        "mirrored",
        "y has the wrong sign: who turns to the left comes out on the left, at y > 0, when driving "
        "forwards.",
        (END, "[chord * np.cos(turn / 2), -chord * np.sin(turn / 2), turn]"),
        Edit(RADIUS, (("(1 - np.cos(turn))", "(np.cos(turn) - 1)"),)),
    ),
    Slip(
        "x-and-y-swapped",
        "x and y have changed places: x points ahead, y to the left.",
        (END, "[chord * np.sin(turn / 2), chord * np.cos(turn / 2), turn]"),
        Edit(
            RADIUS,
            (
                (
                    "radius * np.sin(turn), radius * (1 - np.cos(turn))",
                    "radius * (1 - np.cos(turn)), radius * np.sin(turn)",
                ),
            ),
        ),
    ),
    Slip(
        "y-without-its-one",
        "y does not begin at 0: on a circle about (0, R) the height is R less what the cosine says.",
        Edit(RADIUS, (("radius * (1 - np.cos(turn))", "radius * np.cos(turn)"),)),
        Edit(MIDDLE, ((" + np.array([0, R])", ""),)),
    ),
    Slip(
        "no-straight-way",
        "Curves are right, straight ways are not: with Δθ = 0 the radius is infinite and "
        "sin(Δθ/2) / (Δθ/2) is 0/0. What is its limit?",
        (CHORD, "chord = (l + r) * np.sin(turn / 2) / (turn or 1e-300)"),
        Edit(RADIUS, (("return [(l + r) / 2, 0.0, 0.0]", "return [0.0, 0.0, 0.0]"),)),
        (CHORD, "chord = (l + r) * np.sin(turn / 2) / np.float64(turn)"),
        (CHORD, "import math\n    chord = (l + r) * math.sin(turn / 2) / turn"),
        Edit(RADIUS, (("    if abs(turn) < 1e-9:\n        return [(l + r) / 2, 0.0, 0.0]\n", ""),)),
    ),
    Slip(
        "small-turns-ignored",
        "A small turn is taken for none at all. One tick is small, but a hundred drives with one tick "
        "more on one side are a curve.",
        *(
            Edit(RADIUS, (("< 1e-9", f"< {small}"), ("0.0, 0.0]", f"0.0, {told}]")))
            for small in (0.1, 0.01, 0.005, 0.002, 0.001)
            for told in ("0.00", "turn")
        ),
        Edit(MIDDLE, (("if left == right:", "if abs(left - right) <= 1:"),)),
        (TURN, "turn = round((r - l) / base, 2)"),
    ),
    Slip(
        "small-angles-for-all",
        "This is right for small turns only: sin x is not x, and cos x is not 1, when the robot turns by "
        "more than a few degrees.",
        (END, "[(l + r) / 2, (l + r) / 2 * turn / 2, turn]"),
        (CHORD, "chord = (l + r) / 2 * (1 - (turn / 2) ** 2 / 6)"),
        Edit("in many little steps", (("steps = 1000", "steps = 10"),)),
    ),
    Slip(
        "begin-of-each-step",
        "Each of your little steps takes the heading of its begin. Half a step later is the mean.",
        *(
            Edit(
                "in many little steps",
                (("steps = 1000", f"steps = {n}"), ("np.arange(steps) + 0.5", heading)),
            )
            for n in (10, 20, 50, 100, 999, 1001, 10000)
            for heading in ("np.arange(steps)", "np.arange(steps) + 1")
        ),
    ),
    Slip(
        "one-stride-of-integration",
        "The heading was looked at in two or three moments of the way only, as one step of Runge and Kutta "
        "does. For small turns that is excellent, for large ones it is wrong, and an arc has a formula.",
        [
            (CHORD, "h = np.array([0, 0.5, 0.5, 0.5, 0.5, 1]) * turn\n    chord = (l + r) / 2"),
            (END, "[chord * np.cos(h).mean(), chord * np.sin(h).mean(), turn]"),
        ],
    ),
    Slip(
        "never-more-than-a-round",
        "Turns of more than half a round come out wrong: the way depends on the whole of the turn, so it "
        "may be wrapped at the end only.",
        (TURN, TURN + "\n    turn = (turn + np.pi) % (2 * np.pi) - np.pi"),
        (TURN, TURN + "\n    turn = np.clip(turn, -np.pi, np.pi)"),
    ),
    Slip(
        "whole-numbers",
        "Something is rounded to a whole number on the way, or at the end.",
        (D, "(left + right) // 2 * tick *"),
        ("np.array([chord", "np.round([chord"),
        (END + ")", END + ").astype(int)"),
    ),
)

STUMBLES = (
    Stumble("raised", (CHORD, "chord = d * np.sinc(turn / (2 * np.pi))")),
    Stumble(
        "malformed",
        (END, END.replace(", turn]", "]")),
        (f"return np.array({END})", "pass"),
        (f"np.array({END})", "chord"),
        (TURN, "turn = np.nan"),
    ),
)

EQUIVALENT = {
    "1e-09": "no drive with whole ticks turns by so little",
    "steps = ": "one step more or less of so many",
}
