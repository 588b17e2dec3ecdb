"""Task 06-slam: the whole filter over many runs, judged by truth and least squares."""

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.task import Diagnosis, Probe, Task
from course.exercises.ex06_ekf_slam.calls import CALLS
from course.exercises.ex06_ekf_slam.ends import MAP, NO_COVARIANCE, Ends, counted, whole
from course.exercises.ex06_ekf_slam.runs import RUNS, runs
from slamlab.filters.landmark_models import POINTS

# right filters: 0.98 to 1.2 (600 seeds), on average 1.004 to 1.015 (200); 1.1 R: on average 1.04
ENDS = Ends(POINTS, sure=(0.75, 1.33), mean=0.035)


def _landmarks(inputs):
    return np.unique(inputs["seen"][inputs["seen"] >= 0]).size


def _too_many(inputs, outputs):
    return outputs["x"].shape[1] > 3 + 2 * _landmarks(inputs)


def _too_few(inputs, outputs):
    return outputs["x"].shape[1] < 3 + 2 * _landmarks(inputs)


def _ids_behind(inputs, outputs):
    return outputs["x"].shape[1] != 3 + 2 * outputs["ids"].shape[1]


def _far_off(inputs, outputs):
    if not whole(inputs, outputs):
        return False
    error = ENDS.errors(inputs, ENDS.of(inputs, outputs)[0])[:, MAP]
    return np.hypot(*error.reshape(-1, 2).T).max() > 1


def _unlinked(inputs, outputs):
    return not outputs["P"][:, 3:5, 5:].any() or not outputs["P"][:, :3, 3:].any()


def _too_large(inputs, outputs):
    ratios = ENDS.ratios(inputs, outputs)
    return ratios.mean() > 1 + ENDS.mean and ratios.min() > 0.9


def _too_small(inputs, outputs):
    ratios = ENDS.ratios(inputs, outputs)
    return ratios.mean() < 1 - ENDS.mean and ratios.max() < 1.2


def _old_x(inputs, outputs):
    ratios, (low, high) = ENDS.ratios(inputs, outputs), ENDS.sure_within
    return ENDS.apart(inputs, outputs) > ENDS.most and low < ratios.min() and ratios.max() < high


def _spread(part):
    def why(inputs, outputs):
        if not whole(inputs, outputs):
            return counted(inputs, outputs)
        x, P = ENDS.of(inputs, outputs)
        error = ENDS.errors(inputs, x)[:, part]
        if np.linalg.eigvalsh(P[:, part, part]).min() <= 0:
            return NO_COVARIANCE
        share = np.einsum("ri,rij,rj->r", error, np.linalg.inv(P[:, part, part]), error).mean()
        return (
            f"the mean NEES of {len(x)} runs at the end is {share:.3g}; a consistent filter has "
            f"about {error.shape[1]}, the number of components"
        )

    return why


SLAM = Task(
    id="06-slam",
    title="The whole filter",
    call=CALLS["06-slam"],
    inputs=runs,
    shapes={"x": (RUNS, None), "P": (RUNS, None, None), "ids": (RUNS, None)},
    may_round=False,
    probes=(
        Probe("landmarks behind the robot", lambda rng: runs(rng, behind=True), ("pose", "map")),
    ),
    laws=(
        Law(
            "ids",
            1,
            "the map contains each measured landmark exactly once",
            whole,
            why=counted,
            asks="When is a landmark new, and which variable shows that it is already known?",
            step="Call slam_step twice with the same scan of two landmarks, beginning with an "
            "empty map. Print len(x) and ids after each call: x must have 7 entries both times.",
        ),
        Law(
            "pose",
            1,
            "the pose is consistent: its mean NEES over all runs lies within the χ² band",
            ENDS.honest(np.s_[:3]),
            why=_spread(np.s_[:3]),
            after=("ids",),
            asks="How many predictions does one step need, and which landmark of x does the k-th "
            "row of z belong to?",
            step="Call slam_step with an empty scan: the pose must move by u, and its variances "
            "must grow. Then call it with a scan of two known landmarks, and with the same scan in "
            "reverse order: x must be almost the same.",
        ),
        Law(
            "map",
            1,
            "the map is consistent: its mean NEES over all runs lies within the χ² band",
            ENDS.honest(MAP),
            why=_spread(MAP),
            after=("ids",),
            asks="At which pose is a new landmark added, and what does its second measurement "
            "change?",
            step="Begin with an exactly known pose, and measure one new landmark: its position "
            "must be g of the pose after the motion. Measure it again: x must change, and the "
            "variances of the landmark must shrink.",
        ),
        Law(
            "sure",
            2,
            "x and P agree with batch least squares over the whole run, with all cross-covariances",
            ENDS.sure,
            why=lambda inputs, outputs: ENDS.ratios_told(inputs, outputs),
            after=("ids",),
            asks="How often, and with which noise, do each control input and each measurement "
            "enter x and P? Which x and P does the next measurement of the same scan use?",
            step="With an empty scan, x and P must be those of predict. With three known "
            "landmarks, x and P must be almost those of predict and three calls of update, each "
            "with the x and P of the call before. With two new landmarks, both must be in the map.",
        ),
    ),
    diagnoses=(
        Diagnosis(
            "ids-behind",
            "Your x and ids contain different numbers of landmarks. Whenever you append a "
            "landmark to x, append its id to ids.",
            _ids_behind,
            asks="Which two lists describe the map, and when does each of them grow?",
        ),
        Diagnosis(
            "re-augmented",
            "Your map contains a landmark more than once. If its id is already in ids, the "
            "landmark is known: update it.",
            _too_many,
            asks="What should happen when a landmark is measured for the second time?",
        ),
        Diagnosis(
            "too-few",
            "Some measured landmarks are not in the map. For every new id, augment the state with "
            "the row of z that belongs to it.",
            _too_few,
            asks="Which measurements of a scan does your loop reach?",
        ),
        Diagnosis(
            "unlinked",
            "In your P, blocks beside the diagonal are zero. The errors of the pose and of all "
            "landmarks are correlated: keep all blocks from step to step.",
            _unlinked,
            asks="Which blocks of P beside the diagonal are zero at the end, and which line makes "
            "them zero?",
        ),
        Diagnosis(
            "far-off",
            "A landmark has an error of more than a metre. Check the order first: predict once, "
            "before any measurement is used. If the order is right, you associate some "
            "measurements with the wrong landmark: ids[j] is the id of landmark j of x, and z[k] "
            "belongs to seen[k].",
            _far_off,
            asks="At which pose do you use z, and for which landmark do you use each row?",
        ),
        Diagnosis(
            "old-x",
            "Your P is that of least squares, but your x is not. Compute each innovation from the "
            "x after all updates before it, and wrap its bearing. Place a new landmark from the "
            "pose that belongs to P.",
            _old_x,
            asks="From which x do you predict the second measurement of a scan, and from which "
            "pose do you place a new landmark?",
        ),
        Diagnosis(
            "too-large",
            "Your P is larger than that of least squares. Either you do not use some measurements "
            "(a scan can contain three, and two new landmarks), or you use them for a part of the "
            "state only, or P gets too much noise.",
            _too_large,
            asks="Your P is larger than that of least squares. Which measurements of a scan change "
            "x and P, and where is noise added?",
        ),
        Diagnosis(
            "too-small",
            "Your P is smaller than that of least squares. Either you use a measurement twice, or "
            "the noise of the control inputs or of the measurements is too small in your step.",
            _too_small,
            asks="Your P is smaller than that of least squares. How often, and with which "
            "covariance, do a control input and a measurement enter it?",
        ),
    ),
    needs=("06-augment", "06-update"),
    begins=(
        "One step has a motion and a scan. Which of the two comes first?",
        "What do you do with a landmark that the map contains, and what with a new one?",
        "At which index of the state is the landmark with the id seen[k]?",
    ),
)
