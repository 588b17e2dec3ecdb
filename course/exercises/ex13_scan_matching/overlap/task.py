"""Task 13-overlap: two scans of which half overlaps; any method is allowed."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law
from classroom.exercises.task import Probe, Task
from course.exercises.ex13_scan_matching.calls import CALLS
from course.exercises.ex13_scan_matching.overlap.halves import offs, rooms

SOLVED, SHARP = (0.2, 5.0), (0.015, 0.5)  # [m], [°]
NEARLY_ALL = 12  # of 16; the solution: 12 at least over 10⁴ seeds, 15.9 on average
RIGID = 1e-6  # largest error of a rigid motion's matrix


def rigid(T):
    """(n,) bool."""
    Rot = T[:, :2, :2]
    turns = (np.abs(Rot @ Rot.mT - np.eye(2)).max(axis=(1, 2)) < RIGID) & (np.linalg.det(Rot) > 0)
    return turns & (np.abs(T[:, 2] - [0, 0, 1]).max(axis=1) < RIGID)


def within(inputs, outputs, limits):
    """(n,) bool, whether each answer is a rigid motion near the true one."""
    way, turn = offs(inputs, outputs["result"])
    return rigid(outputs["result"]) & (way < limits[0]) & (turn < limits[1])


def _why(inputs, outputs):
    way, turn = offs(inputs, outputs["result"])
    n, solved, sharp = len(way), *(within(inputs, outputs, of).sum() for of in (SOLVED, SHARP))
    odd = np.sum(~rigid(outputs["result"]))
    none = (
        f" {odd} of the matrices are not rigid motions: Rot is not a rotation, or the last row is "
        "not 0 0 1."
    )
    return (
        f"{solved} of {n} matches are correct, and {sharp} of these are accurate. The median error "
        f"is {100 * np.median(way):.1f} cm and {np.median(turn):.1f}°.{none if odd else ''}"
    )


def _step(name, points, count, limits, says, asks, step):
    def holds(inputs, outputs):
        return np.mean(within(inputs, outputs, limits)) >= count / 16

    says = says.format(f"at least {count} of 16 matches", *limits)
    return Law(name, points, says, holds, why=_why, asks=asks, step=step)


HOME = "{} are correct: the error is less than {} m and less than {:g}°"
STEPS = (
    _step(
        "some",
        0.5,
        4,
        SOLVED,
        HOME,
        "Up to which error of the guess does robust ICP converge to the truth? The rotation is "
        "unknown: how many rotations would you have to try?",
        "Transform a source by a known T, and use it as the target. Run robust ICP from guesses "
        "with a rotation error of 0°, 10°, 20° and so on, and print the error of each result.",
    ),
    _step(
        "half",
        1,
        8,
        SOLVED,
        HOME,
        "Suppose that you have twenty results from twenty initial guesses. By which number do you "
        "choose the best one, if half of the source points have no true correspondence?",
        "Print for each of your results the distances to the nearest target points, in ascending "
        "order. Near the true motion, about half of them are less than 10 cm.",
    ),
    _step(
        "nearly-all",
        2,
        NEARLY_ALL,
        SOLVED,
        HOME,
        "For a given rotation, one translation maps a given source point to a given target point. "
        "In the list of these translations for all pairs of points, how do you find the true one?",
        "Plot these translations as points for one rotation. Then plot them for a rotation that is "
        "10° different, and compare the densest spots.",
    ),
    _step(
        "sharp",
        1.5,
        9,
        SHARP,
        "{} are accurate: the error is less than {} m and less than {:g}°",
        "The beams of the two scans hit a wall at different spots. Which component of the distance "
        "between a point and its nearest point contains information?",
        "Print for a correct result the components of these distances along the wall and across "
        "it. Across the wall they are 1 to 2 cm, along it up to half the distance of two readings.",
    ),
)


def _inverted(inputs, outputs):
    turned = {"result": np.linalg.inv(outputs["result"])}
    return within(inputs, turned, SOLVED).mean() >= 0.25


def _turned(inputs, outputs):
    lost = ~within(inputs, outputs, SOLVED)
    few = _home(inputs, outputs) < NEARLY_ALL / 16
    return few and np.median(offs(inputs, outputs["result"])[1][lost]) > 15


def _shifted(inputs, outputs):
    lost = ~within(inputs, outputs, SOLVED)
    way, _ = offs(inputs, outputs["result"])
    return _home(inputs, outputs) < NEARLY_ALL / 16 and np.median(way[lost]) > SOLVED[0]


def _home(inputs, outputs, limits=SOLVED):
    return within(inputs, outputs, limits).mean()


MISTAKES = (
    Diagnosis(
        "inverted",
        "These are the inverse motions: they align the target with the source. T must transform "
        "the source.",
        _inverted,
        asks="To which points does your T transform the source? Are they near the target?",
    ),
    Diagnosis(
        "turn-not-found",
        "Most matches that are not correct have a large error of the rotation, as the guess has. "
        "From there ICP does not converge to the truth. Try many rotations. By which number do you "
        "choose the best result? The mean of the pairs that you keep may be small for a wrong "
        "result as well, so ask how many pairs fit. If you try many: is the translation of each "
        "one computed from source points that are already rotated by it?",
        _turned,
        asks="How many initial rotations do you try, and how far is the nearest one from "
        "the true rotation? Which number chooses among the results?",
    ),
    Diagnosis(
        "shift-not-found",
        "Most matches that are not correct have nearly the true rotation, but a wrong translation. "
        "With the true rotation, each pair of points votes for one translation. Which one gets the "
        "most votes?",
        _shifted,
        asks="How many translations do you try for one rotation, and how do you obtain them?",
    ),
    Diagnosis(
        "not-finished",
        "The matches are correct, but not accurate. The beams of the two scans hit a wall at "
        "different spots, so the distance along the wall contains no information. Finish with "
        "point-to-line steps.",
        lambda i, o: _home(i, o) >= NEARLY_ALL / 16 and _home(i, o, SHARP) < 9 / 16,
        asks="Which correspondences does your last iteration use? How far apart along the "
        "wall are the two points of such a pair?",
    ),
)

OVERLAP = Task(
    id="13-overlap",
    title="Partial overlap and a bad initial guess",
    call=CALLS["13-overlap"],
    inputs=rooms,
    shapes={"result": (3, 3)},
    laws=STEPS,
    diagnoses=MISTAKES,
    probes=(
        Probe(
            "scans of 90 and 130 beams, and a nearly correct guess",
            lambda rng: rooms(rng, 1, (90, 130), (10, 20), (0.02, 0.1), (2, 8)),
            (STEPS[0].name,),
        ),
    ),
    may_round=False,
    needs=("13-icp", "13-kernel", "13-line-step"),
    begins=(
        "How would you transform the source by a rotation of 90° and no translation, "
        "and how many of its points are then near a target point?",
        "Which of the functions of this exercise can improve a guess that is nearly right?",
    ),
)
