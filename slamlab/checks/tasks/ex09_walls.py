"""Task 09-walls: a small filter through a corridor, judged by truth and by least squares."""

import numpy as np

from slamlab import jacobians, models, noise
from slamlab.checks.drives.ex09 import DRIVES
from slamlab.checks.task import Diagnosis, Law, Task
from slamlab.checks.tasks.ex06_ends import MAP, Ends, whole
from slamlab.checks.tasks.ex06_runs import LANDMARKS as MET
from slamlab.checks.tasks.ex06_runs import RUNS
from slamlab.checks.tasks.ex09_corridor import least_squares, runs, truth
from slamlab.filters.kinds import LINES
from slamlab.filters.mak import MAK

ENDS = Ends(LINES, sure=(0.8, 1.33))


# ---- mistakes: the same calls in a wrong order ------------------------------------------------


def _filtered(inputs, run, order):
    """A run with the calls of each step in some order: p predict, u update, a place new ones,
    d both as the scan has them, and what was placed is updated as well."""
    mak = MAK(inputs["x"][run], inputs["P"], kind=LINES)
    for u, seen, z in zip(inputs["u"][run], inputs["seen"], inputs["z"][run], strict=True):
        known = mak.ids
        for what in order:
            if what == "p":
                pose = mak.pose
                Q = noise.Q(jacobians.W_odometry(pose, u), inputs["C"])
                mak.predict(models.f_odometry(pose, u), Q)
                continue
            for i, one in zip(seen.tolist(), z, strict=True):
                if i in known and what in "ud":
                    mak.update([i], [one], inputs["R"])
                elif i >= 0 and i not in known and what in "ad":
                    mak.add([i], [one], inputs["R"])
                    if what == "d":
                        mak.update([i], [one], inputs["R"])
    return mak


def _ordered(*orders):
    """Whether the end of a run is that of the same calls in one of these orders."""

    def matches(inputs, outputs):
        return whole(inputs, outputs) and any(_like(inputs, outputs, order) for order in orders)

    return matches


def _like(inputs, outputs, order):
    for run in (0, 1):
        mak = _filtered(inputs, run, order)
        (x,), (P,) = ENDS.in_order(inputs, mak.x[None], mak.P[None], np.array([mak.ids]))
        (got,), (claimed,) = (part[run, None] for part in ENDS.of(inputs, outputs))
        sigma, off = np.sqrt(np.diag(P)), got - x
        off = ENDS.wrapped(off)
        if max((abs(off) / sigma).max(), (abs(claimed - P) / np.outer(sigma, sigma)).max()) > 0.1:
            return False
    return True


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
            _ordered("apu"),
        ),
        Diagnosis(
            "predicted-last",
            "What is seen is used before the drive is predicted. Predict first.",
            _ordered("uap", "aup"),
        ),
        Diagnosis(
            "never-updated",
            "Walls seen again teach the filter nothing: known ids are to be updated.",
            _ordered("pa"),
        ),
        Diagnosis(
            "never-predicted",
            "The drive u is not used: predict comes first in every step.",
            _ordered("ua"),
        ),
        Diagnosis(
            "counted-twice",
            "A new wall is placed and then updated with the same z: counted twice, that sight "
            "makes the filter surer than it may be.",
            _ordered("pd"),
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
