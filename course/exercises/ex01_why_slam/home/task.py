"""Task 01-home: an estimated trajectory of a run with loop closures. Any method is allowed."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex01_why_slam.calls import CALLS
from course.exercises.ex01_why_slam.home import laps

IN_LAPS, BEYOND = 1.15, 1.7
"""Limits of the errors in the laps and after them, in units of those of `laps.closed`."""


@once
def off(inputs, outputs):
    """Root mean square position error of all trajectories [m]."""
    way = (outputs["result"] - laps.route(inputs))[..., :2]
    return np.sqrt(np.square(way).sum(axis=-1).mean())


@once
def shares(inputs, outputs):
    """Rms errors in the laps and after them, in units of those of `laps.closed`."""
    x, y = np.moveaxis(outputs["result"][:, 1:, :2], -1, 0)
    true, end = laps.route(inputs)[1:, :2] @ [1, 1j], inputs["docked"][0, -1]
    yours, others = (np.abs(z - true) ** 2 for z in (x + 1j * y, laps.closed(inputs)))
    parts = np.s_[:, :end], np.s_[:, end:]
    return np.array([np.sqrt(yours[part].mean() / others[part].mean()) for part in parts])


def _why(inputs, outputs):
    inside, beyond = shares(inputs, outputs)
    return (
        f"The rms position error of your trajectories is {off(inputs, outputs):.2f} m: in the laps "
        f"{inside:.2f} times, after the last lap {beyond:.2f} times that of the reference."
    )


def _near(inputs, outputs):
    return (shares(inputs, outputs) <= [IN_LAPS, BEYOND]).all()


def _on_the_way(inputs):
    turns = np.pad(np.cumsum(inputs["steps"][..., 2], axis=1), ((0, 0), (1, 0)))
    ends = np.take_along_axis(turns, inputs["docked"], axis=1)
    return {"turn of each lap by odometry [rad]": np.diff(ends, axis=1, prepend=0)}


def _step(name, points, says, holds, asks):
    return Law(name, points, says, holds, why=_why, asks=asks, step=_on_the_way)


def _below(name, points, limit, asks):
    says = f"the rms position error of all trajectories is below {limit} m"
    return _step(name, points, says, lambda i, o: off(i, o) < limit, asks)


# Over 60 seeds right programs err by at most 1.07 and 1.44 times the reference, who shares the gap
# in position only by 1.30 in the laps, in heading only by 1.43, none by 1.75 at least; with nothing
# but the factor's sign by 2.3 after them. Laps begun anew in the dock err by 1.2–1.5 m, dead
# reckoning by 3 m at least, the last lap's factor alone by 0.36–0.92 m.
STEPS = (
    _below(
        "better",
        0.5,
        2.2,
        "What is the pose of the robot whenever it is docked? By which angle does it turn in a lap "
        "to the left, and by which angle in a lap to the right?",
    ),
    _below(
        "good",
        2,
        1.0,
        "The true lap is closed. How large are the gaps of your lap in position and heading?",
    ),
    _step(
        "right",
        3,
        f"the rms position error is at most {IN_LAPS} times that of the reference in the laps, and "
        f"at most {BEYOND} times after the last lap",
        _near,
        "Which error is the same in all laps? Which gap remains after you "
        "have corrected this error?",
    ),
)


def _from_dock(inputs, outputs):
    rows = np.take_along_axis(outputs["result"], inputs["docked"][..., None], axis=1)
    return np.linalg.norm((rows - inputs["start"][:, None])[..., :2], axis=-1)


def _jump(inputs, outputs):
    ways = np.linalg.norm(np.diff(outputs["result"][..., :2], axis=1), axis=-1)
    told = np.linalg.norm(inputs["steps"][..., :2], axis=-1)
    return np.take_along_axis(ways - told, inputs["docked"] - 1, axis=1)


def _only_beyond(inputs, outputs):
    off = np.linalg.norm((outputs["result"] - laps.route(inputs))[..., :2], axis=-1)
    last = inputs["docked"][0, -1]
    return np.median(off[:, :last]) < 0.2 < 0.5 < np.median(off[:, last + 10 :])


MISTAKES = (
    Diagnosis(
        "not in the dock",
        "In your trajectories the robot is not in the dock when it is docked. Its pose is known "
        "at the end of each lap, so use this pose.",
        lambda inputs, outputs: np.median(_from_dock(inputs, outputs)) > 0.2,
        asks="At which rows of your trajectories is the true pose known, and which pose do you "
        "return there?",
    ),
    Diagnosis(
        "leaps home",
        "Your trajectories jump into the dock in one step, so the errors of the lap remain. They "
        "occurred in all of its steps: distribute the gap over all steps. If you correct the turns "
        "first: does this make the gap smaller, in laps to the left and in laps to the right?",
        lambda inputs, outputs: np.median(_jump(inputs, outputs)) > 0.5,
        asks="How large is the gap at the end of each lap before you set the pose to the dock, and "
        "how large is it by odometry alone? In which steps did the errors of a lap occur?",
    ),
    Diagnosis(
        "lost beyond",
        "Your trajectories have far larger errors after the last lap than in the laps. Estimate "
        "the systematic error from the laps, and also correct the steps after the last lap.",
        _only_beyond,
        asks="How large is the error of your trajectories after the last lap? Which steps have "
        "the same systematic error as the laps?",
    ),
)

HOME = Task(
    id="01-home",
    title="Make it better: loop closure at a dock",
    call=CALLS["01-home"],
    inputs=laps.drives,
    shapes=lambda inputs: {"result": (inputs["steps"].shape[1] + 1, 3)},
    laws=STEPS,
    diagnoses=MISTAKES,
    probes=(
        Probe("one lap only", lambda rng: laps.drives(rng, 4, (1,), tail=False), ("better",)),
        Probe("five laps", lambda rng: laps.drives(rng, 4, (1, -1, 1, -1, 1)), ("better",)),
    ),
    parts=lambda inputs, outputs: {"places": outputs["result"][..., :2]},  # what is scored
    may_round=False,
    needs=("01-next-pose",),
    begins=(
        "Which pose does `track` give for a row at which the robot is docked? Which pose is right?",
        "By which angle does the robot turn in one whole lap?",
    ),
)
