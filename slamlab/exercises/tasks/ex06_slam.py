"""Task 06-slam: the whole filter over many runs, judged by truth and by least squares."""

import numpy as np

from slamlab.exercises.drives.ex06 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex06_ends import MAP, Ends, whole
from slamlab.exercises.tasks.ex06_orders import ordered
from slamlab.exercises.tasks.ex06_runs import LANDMARKS, RUNS, runs
from slamlab.filters.landmark_models import POINTS

ENDS = Ends(POINTS, sure=(0.75, 1.33))


def _too_many(inputs, outputs):
    return outputs["x"].shape[1] > 3 + 2 * LANDMARKS


def _too_few(inputs, outputs):
    return outputs["x"].shape[1] < 3 + 2 * LANDMARKS


def _ids_behind(inputs, outputs):
    return outputs["x"].shape[1] != 3 + 2 * outputs["ids"].shape[1]


def _far_off(inputs, outputs):
    """Whether the map is off by far more than any wrong covariance can explain."""
    if not whole(inputs, outputs):
        return False
    return (
        np.hypot(*ENDS.errors(inputs, ENDS.of(inputs, outputs)[0])[:, MAP].reshape(-1, 2).T).max()
        > 1
    )


SLAM = Task(
    id="06-slam",
    title="The whole filter",
    drive=DRIVES["06-slam"],
    inputs=runs,
    shapes={"x": (RUNS, None), "P": (RUNS, None, None), "ids": (RUNS, None)},
    laws=(
        Law("ids", 1, "the map holds every landmark that was seen, each once", whole),
        Law(
            "pose",
            1,
            "over all runs, the pose errs as much as P says (NEES within its band)",
            ENDS.honest(np.s_[:3]),
        ),
        Law(
            "map",
            1,
            "over all runs, the landmarks err as much as P says (NEES within its band)",
            ENDS.honest(MAP),
        ),
        Law(
            "sure",
            2,
            "P is neither more nor less sure, of robot, map and what lies between them, than least "
            "squares over the whole run",
            ENDS.sure,
        ),
    ),
    diagnoses=(
        Diagnosis(
            "ids-behind",
            "x has landmarks that ids does not name, or the other way round. Whenever you append "
            "to x, append to ids.",
            _ids_behind,
        ),
        Diagnosis(
            "re-augmented",
            "The map holds a landmark more than once. One whose id is in ids already was seen "
            "before: update it.",
            _too_many,
        ),
        Diagnosis(
            "too-few",
            "Some landmarks that were seen are not in the map: every id that is new is to be "
            "augmented, each with its own row of z.",
            _too_few,
        ),
        Diagnosis(
            "placed-too-early",
            "New landmarks are placed before the pose is predicted: z was measured after the "
            "drive, so everything new stands a step behind.",
            ordered(ENDS, "apu", "apw"),
        ),
        Diagnosis(
            "predicted-last",
            "What is seen is used before the drive is predicted: z was measured after it. Predict "
            "first.",
            ordered(ENDS, "mp", "uap", "aup", "upa"),
        ),
        Diagnosis(
            "never-updated",
            "Landmarks seen again teach the filter nothing: known ids are to be updated.",
            ordered(ENDS, "pa"),
        ),
        Diagnosis(
            "never-predicted",
            "The drive u is not used: predict comes first in every step.",
            ordered(ENDS, "m", "ua"),
        ),
        Diagnosis(
            "counted-twice",
            "A new landmark is augmented and then updated with the same z. That sight has been "
            "used already: counted twice, it makes the filter surer than it may be.",
            ordered(ENDS, "pd"),
        ),
        Diagnosis(
            "predicted-for-each",
            "The drive is predicted once for each landmark seen. It happened once in a step.",
            ordered(ENDS, "pe", "e", "s", "ps"),
        ),
        Diagnosis(
            "far-off",
            "The map is more than a metre off. Look at the order first: predict once, before "
            "anything is looked at. If it is right, some sights go to the wrong landmark: ids[j] "
            "names landmark j of x, new ones come last in both, z[k] belongs to seen[k].",
            _far_off,
        ),
    ),
    needs=("06-predict", "06-augment", "06-update"),
)
