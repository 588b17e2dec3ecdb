"""Task 09-walls: a small filter through a corridor, judged by truth and by least squares."""

import numpy as np

from slamlab.exercises.drives.ex09 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex06.ends import MAP, Ends, whole
from slamlab.exercises.tasks.ex06.orders import ordered
from slamlab.exercises.tasks.ex06.runs import LANDMARKS as MET
from slamlab.exercises.tasks.ex06.runs import RUNS
from slamlab.exercises.tasks.ex09_corridor import least_squares, runs, truth
from slamlab.filters.landmark_models import LINES

ENDS = Ends(LINES, sure=(0.8, 1.33))


def _size(compare):
    def matches(inputs, outputs):
        return compare(outputs["x"].shape[1], outputs["ids"].shape[1])

    return matches


def _sure_along(inputs, outputs):
    """Whether the place along the corridor is claimed to be known far better than it can be."""
    if not whole(inputs, outputs):
        return False
    alpha = next(iter(truth(inputs)[3].values()))[1]
    way = np.array([-np.sin(alpha), np.cos(alpha)])
    claimed = way @ outputs["P"].mean(axis=0)[:2, :2] @ way
    return claimed < 0.5 * (way @ least_squares(inputs)[:2, :2] @ way)


def _unrelated(inputs, outputs):
    """Whether robot and walls share nothing at the end."""
    return whole(inputs, outputs) and np.allclose(outputs["P"][:, :3, 3:], 0, atol=1e-12)


def _far_off(inputs, outputs):
    if not whole(inputs, outputs):
        return False
    return np.abs(ENDS.errors(inputs, ENDS.of(inputs, outputs)[0])[:, MAP]).max() > 0.7


LAWS = (
    Law("ids", 1, "the map holds every wall that was seen, each once", whole),
    Law("pose", 1, "over all runs, the pose errs as much as P says (NEES within its band)",
        ENDS.honest(np.s_[:3])),
    Law("map", 1, "over all runs, the walls err as much as P says (NEES within its band)",
        ENDS.honest(MAP)),
    Law("sure", 2, "P is neither more nor less sure, of robot, walls and what lies between them, "
        "than least squares over the whole run", ENDS.sure),
)  # fmt: skip

WALLS = Task(
    id="09-walls",
    title="A filter through a corridor",
    drive=DRIVES["09-walls"],
    inputs=runs,
    shapes={"x": (RUNS, None), "P": (RUNS, None, None), "ids": (RUNS, None)},
    laws=LAWS,
    diagnoses=(
        Diagnosis(
            "ids-behind",
            "x has walls that ids does not name, or the other way round. Whenever you append to x, "
            "append to ids.",
            _size(lambda n, ids: n != 3 + 2 * ids),
        ),
        Diagnosis(
            "re-placed",
            "The map holds a wall more than once. One whose id is in ids already is to be updated.",
            _size(lambda n, ids: ids > MET),
        ),
        Diagnosis(
            "too-few",
            "Some walls that were seen are not in the map: every id that is new is to be placed.",
            _size(lambda n, ids: ids < MET),
        ),
        Diagnosis(
            "placed-too-early",
            "New walls are placed before the pose is predicted: z was measured after the drive, so "
            "everything new stands a step behind.",
            ordered(ENDS, "apu"),
        ),
        Diagnosis(
            "predicted-last",
            "What is seen is used before the drive is predicted. Predict first.",
            ordered(ENDS, "uap", "aup"),
        ),
        Diagnosis(
            "never-updated",
            "Walls seen again teach the filter nothing: known ids are to be updated.",
            ordered(ENDS, "pa"),
        ),
        Diagnosis(
            "never-predicted",
            "The drive u is not used: predict comes first in every step.",
            ordered(ENDS, "ua"),
        ),
        Diagnosis(
            "counted-twice",
            "A new wall is placed and then updated with the same z: counted twice, that sight "
            "makes the filter surer than it may be.",
            ordered(ENDS, "pd"),
        ),
        Diagnosis(
            "born-alone",
            "Robot and walls share nothing in P. A wall inherits the robot's errors: its new rows "
            "are those that place gives with the pose, carried on to all that the pose is "
            "correlated with.",
            _unrelated,
        ),
        Diagnosis(
            "mispaired",
            "The map is far off: some sights seem to go to the wrong wall. ids[j] names wall j of "
            "x, new ones come last in both, z[k] belongs to seen[k].",
            _far_off,
        ),
        Diagnosis(
            "sure-along",
            "The filter knows how far along the corridor it is, better than its wheels can tell, "
            "and no wall says so. What is fed to it must be what was seen from the robot; nothing "
            "computed through the pose (a foot of the perpendicular) is.",
            _sure_along,
        ),
    ),
    needs=("09-place", "09-update"),
)
