"""Task 13-overlap: two scans with half of their points in common, a bad guess; any method goes."""

import numpy as np

from slamlab.exercises.drives.ex13 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex13.halves import offs, rooms

SOLVED, SHARP = (0.2, 5.0), (0.015, 0.5)  # [m], [°]
NEARLY_ALL = 12  # of 16; the solution: 12 at least over 10⁴ seeds, 15.9 on average
RIGID = 1e-6  # what a motion's matrix may be off its own


def rigid(T):
    """(n,) bool, whether matrices are those of motions."""
    Rot = T[:, :2, :2]
    turns = (np.abs(Rot @ Rot.mT - np.eye(2)).max(axis=(1, 2)) < RIGID) & (np.linalg.det(Rot) > 0)
    return turns & (np.abs(T[:, 2] - [0, 0, 1]).max(axis=1) < RIGID)


def within(inputs, outputs, limits):
    """(n,) bool, whether each answer is a motion and near the true one."""
    way, turn = offs(inputs, outputs["result"])
    return rigid(outputs["result"]) & (way < limits[0]) & (turn < limits[1])


def _why(inputs, outputs):
    way, turn = offs(inputs, outputs["result"])
    n, solved, sharp = len(way), *(within(inputs, outputs, of).sum() for of in (SOLVED, SHARP))
    odd = np.sum(~rigid(outputs["result"]))
    none = f" {odd} of the matrices are no motions: Rot no rotation, or the last row not 0 0 1."
    return (
        f"{solved} of {n} are home, {sharp} of these sharply. The typical match is "
        f"{100 * np.median(way):.1f} cm and {np.median(turn):.1f}° off.{none if odd else ''}"
    )


def _step(name, points, count, limits, says, asks):
    """The law that so many of 16 matches, or as large a share of fewer, are near the truth."""

    def holds(inputs, outputs):
        return np.mean(within(inputs, outputs, limits)) >= count / 16

    says = says.format(f"{count} of 16 matches", *limits)
    return Law(name, points, says, holds, why=_why, asks=asks)


HOME = "{} are home: off by less than {} m and {:g}°"
STEPS = (
    _step(
        "some",
        0.5,
        4,
        SOLVED,
        HOME,
        "How far may the first guess be off for trimmed ICP to come home? What could you do about "
        "the turn, which you do not know?",
    ),
    _step(
        "half",
        1,
        8,
        SOLVED,
        HOME,
        "Suppose you have twenty answers from twenty beginnings. By which number do you choose, if "
        "half of the source's points have no partner at all?",
    ),
    _step(
        "nearly-all",
        2,
        NEARLY_ALL,
        SOLVED,
        HOME,
        "For a given turn, each source point and each target point would be laid on each other by "
        "one shift. What is special about the right shift, among all of these?",
    ),
    _step(
        "sharp",
        1.5,
        9,
        SHARP,
        "{} are off by less than {} m and {:g}° only",
        "Home is not the end: points of the two scans lie at different spots of a wall. Which part "
        "of their distance means something?",
    ),
)


def _inverted(inputs, outputs):
    """Whether the answers carry the target over the source."""
    turned = {"result": np.linalg.inv(outputs["result"])}
    return within(inputs, turned, SOLVED).mean() >= 0.25


def _turned(inputs, outputs):
    """Whether most answers that are not home are turned about as far as the guess, or farther."""
    lost = ~within(inputs, outputs, SOLVED)
    few = _home(inputs, outputs) < NEARLY_ALL / 16
    return few and np.median(offs(inputs, outputs["result"])[1][lost]) > 15


def _shifted(inputs, outputs):
    """Whether most answers that are not home are shifted wrongly."""
    lost = ~within(inputs, outputs, SOLVED)
    way, _ = offs(inputs, outputs["result"])
    return _home(inputs, outputs) < NEARLY_ALL / 16 and np.median(way[lost]) > SOLVED[0]


def _home(inputs, outputs, limits=SOLVED):
    return within(inputs, outputs, limits).mean()


MISTAKES = (
    Diagnosis(
        "inverted",
        "These are the inverse motions: they lay the target over the source. T carries the source.",
        _inverted,
    ),
    Diagnosis(
        "turn-not-found",
        "Most matches that are not home are off by a large turn, as the guess is: from there no "
        "ICP goes home. Try many turns, and choose by a number that points without a partner "
        "cannot spoil.",
        _turned,
    ),
    Diagnosis(
        "shift-not-found",
        "Most matches that are not home are turned nearly right, and shifted wrongly. With the "
        "turn right, which shift do most pairs of points ask for?",
        _shifted,
    ),
    Diagnosis(
        "not-finished",
        "The matches are home, but not sharp: points of the two scans lie at different spots of a "
        "wall, and along it their distance means nothing. Finish across the walls.",
        lambda i, o: _home(i, o) >= NEARLY_ALL / 16 and _home(i, o, SHARP) < 9 / 16,
    ),
)

OVERLAP = Task(
    id="13-overlap",
    title="Half an overlap and a bad guess",
    drive=DRIVES["13-overlap"],
    inputs=rooms,
    shapes={"result": (3, 3)},
    laws=STEPS,
    diagnoses=MISTAKES,
    probes=(
        Probe(
            "other numbers of beams, and a guess that is nearly right",
            lambda rng: rooms(rng, 1, (90, 130), (10, 20), (0.02, 0.1), (2, 8)),
            (STEPS[0].name,),
        ),
    ),
    rounds=False,
)
