"""Exercise 10, open: guaranteed boxes, as small as possible."""

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.task import Probe, Task
from course.exercises.ex10_set_membership_slam.boxes import turned
from course.exercises.ex10_set_membership_slam.calls import CALLS
from course.exercises.ex10_set_membership_slam.narrow import poses
from slamlab.filters.set_membership.clipping import clip_all
from slamlab.filters.set_membership.contraction import contract_heading
from slamlab.filters.set_membership.half_planes import absolute_bearing, reversed_edges

SOUND = 1e-6
"""What a pose may be outside [m], [rad]: solvers of linear programs stop at 1e-7."""
STEPS = {"less": (1, 1.85), "small": (1.5, 1.6), "smallest": (2, 1.4)}
"""Points, and how many times as wide as the smallest boxes may be on average.

The lesson's filter, iterated until nothing shrinks, reaches 3.0
(1.9 to 4.1 over 31 seeds).
"""
EMPTY = "x_min > x_max", "y_min > y_max", "left < right"


def widths(out):
    """(n, 3) of the box in x and y, and of the heading."""
    sides = np.hstack([out["robot"], out["heading"]])
    return sides[:, 1::2] - sides[:, ::2]


def one_round(given):
    """Robot's box and heading after one pass of the lesson's filter."""
    found = [
        _one_round(*row) for row in zip(*(given[name].tolist() for name in given), strict=True)
    ]
    return {
        name: np.array(a)
        for name, a in zip(("robot", "heading"), zip(*found, strict=True), strict=True)
    }


def _one_round(robot, heading, objects, observations, bounds):
    for (x, y), z in zip(objects, observations, strict=True):
        box, (direction, d_abs) = (x, x, y, y), absolute_bearing(heading, z, bounds)
        if d_abs < np.pi / 2:
            robot = clip_all(robot, reversed_edges(z, bounds, direction, d_abs, box))
        heading = contract_heading(heading, robot, box, z, bounds)
    return robot, heading


def _ratios(of, to):
    """(3,) how many times as wide on average, without unknown ones."""
    some = np.isfinite(to).all(axis=1)
    with np.errstate(invalid="ignore"):
        return of[some].sum(axis=0) / to[some].sum(axis=0)


def _usual(given):
    return len(given["robot"]) == poses.ROWS


def _within(reference, most, always=True):
    def holds(given, out):
        sound = poses.outside_each(given, out).max(axis=1) <= SOUND
        if not sound.all() or not (always or _usual(given)):
            return sound
        # all robots together; NaN where no smallest box is known
        return not _ratios(widths(out), reference(given)).mean() > most

    return holds


def _why(most, reference, name):
    def why(given, out):
        by = poses.outside_each(given, out)
        if by.max() > SOUND:
            row, which = np.unravel_index(by.argmax(), by.shape)
            x, y, theta = poses.extremes(given)[row, which]
            empty = [text for text, w in zip(EMPTY, widths(out)[row], strict=True) if w < 0]
            return (
                f"The pose ({x:.3f} m, {y:.3f} m, {theta:.3f} rad) agrees with every measurement "
                "and with the given box and heading, but "
                + (" and ".join(empty) or f"it is {by.max():.2g} outside")
                + "."
            )
        ratios = _ratios(widths(out), reference(given))
        x, y, theta = ratios
        return (
            f"Your mean ratio is {ratios.mean():.3f} (x {x:.2f}, y {y:.2f}, heading {theta:.2f}), "
            f"compared with {name(given)}; at most {most:g} is allowed."
        )

    return why


def _known(given):
    return widths(given) + SOUND


def _look(given):
    return widths(one_round(given)) + SOUND


def _lesson(given):
    # the average of few robots varies much: their reference is the given box and heading
    return (_look if _usual(given) else _known)(given)


def _lesson_name(given):
    return "one pass of look" if _usual(given) else "the given box and heading"


_ON_THE_WAY = {
    "less": "Slice the interval of the heading into two halves, and process each half alone. "
    "Compare both boxes with the box for the whole interval. If you already use slices, compare "
    "with twice as many.",
    "small": "Print the widths of box and heading after each round. If they no longer change, what "
    "makes the edges of one slice wide?",
    "smallest": "Take one narrow piece of the heading. Draw all its edges, the polygon between "
    "them, and the box that your code uses in place of this polygon.",
}


def _step(name, asks):
    points, most = STEPS[name]
    says = (
        f"all feasible poses are inside, and the mean width is at most {most:g} times the smallest"
    )
    why = _why(most, poses.tightest, lambda given: "the smallest boxes and headings found")
    holds = _within(poses.tightest, most, always=False)
    return Law(
        name, points, says, holds, why=why, asks=asks, step=_ON_THE_WAY[name], after=("sound",)
    )


def _wide(rng):
    return poses.inputs(rng, 2, half=(1.6, 2.0))


def _across_pi(rng):
    at = np.column_stack([rng.uniform(-3, 3, (2, 2)), np.pi + rng.uniform(-0.1, 0.1, 2)])
    return poses.observations(rng, at)


NARROW = Task(
    id="10-narrow",
    title="The smallest guaranteed box and heading",
    call=CALLS["10-narrow"],
    inputs=poses.inputs,
    shapes=lambda given: {"robot": (len(given["robot"]), 4), "heading": (len(given["robot"]), 2)},
    laws=(
        Law(
            "sound",
            0.5,
            "all feasible poses are inside, and the mean width is at most the mean width after "
            "one pass of look (in special cases: the mean width of the given box and heading)",
            _within(_lesson, 1.0),
            why=_why(1.0, _lesson, _lesson_name),
            asks="Which poses does each line of your code exclude? Are all of these poses "
            "certainly infeasible?",
            step="Draw a pose at random, and compute exact measurements for it. It must be inside "
            "your result. Repeat this a thousand times, with poses near the sides.",
        ),
        _step(
            "less",
            "Which interval, of x, y or θ, makes d_abs large? How could you make this "
            "interval narrower?",
        ),
        _step(
            "small",
            "Do you repeat your method with the smaller box and heading? If you do, how many "
            "slices has the heading, and what remains of the box after each edge?",
        ),
        _step(
            "smallest",
            "Where do you replace a set by a larger box, although you do not need a box at that "
            "point?",
        ),
    ),
    needs=("10-edges", "10-heading"),
    begins=(
        "What does one pass of look exclude, and what makes its edges so wide?",
        "Suppose that the heading were known exactly. How could you then find all headings and "
        "positions that are feasible?",
    ),
    probes=(
        Probe("no landmark", lambda rng: poses.inputs(rng, 2, 0), ("sound",)),
        Probe("a single landmark", poses.both_sides),
        Probe("seven landmarks", lambda rng: poses.inputs(rng, 12, 7)),
        Probe("two separate sets of feasible poses", poses.islands),
        Probe("a wide heading", _wide, ("sound",)),
        Probe("a heading across π", _across_pi, ("sound",)),
        Probe(
            "landmarks inside the robot's box",
            lambda rng: poses.inputs(rng, 2, far=(0.6, 1)),
            ("sound",),
        ),
    ),
    parts=lambda given, out: {"robot": out["robot"], "heading": turned(out["heading"])},
    may_round=False,
)
