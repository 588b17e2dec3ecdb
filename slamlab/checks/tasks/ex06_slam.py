"""Task 06-slam: the whole filter over many runs, judged by truth and by least squares."""

import numpy as np

from slamlab import jacobians, models, noise
from slamlab.checks.drives.ex06 import DRIVES
from slamlab.checks.task import Diagnosis, Law, Task
from slamlab.checks.tasks.ex06_ends import MAP, Ends, whole
from slamlab.checks.tasks.ex06_runs import LANDMARKS, RUNS, runs
from slamlab.filters.kinds import POINTS
from slamlab.filters.mak import MAK

ENDS = Ends(POINTS, sure=(0.75, 1.33))


# ---- mistakes: the same calls in a wrong order ------------------------------------------------


def _filtered(inputs, run, order):
    """A run of the filter with the calls of each step in some order.

    p predict; u update what is known; a augment what is new; m both, in the scan's order. Three
    mistakes on top of m: d what was augmented is updated as well; e a predict before each update;
    s a predict before each sight. And w: update what is known by now, what is new included.
    """
    mak = MAK(inputs["x"][run], inputs["P"])
    for u, seen, z in zip(inputs["u"][run], inputs["seen"], inputs["z"][run], strict=True):
        known = mak.ids
        for what in order:
            if what == "p":
                _predict(mak, u, inputs["C"])
                continue
            for i, one in zip(seen.tolist(), z, strict=True):
                if i < 0:
                    continue
                if what == "s" or (what == "e" and i in known):
                    _predict(mak, u, inputs["C"])
                if i not in known and what in "amdes":
                    mak.add([i], [one], inputs["R"])
                if what in "dw" or (i in known and what in "umes"):
                    mak.update([i], [one], inputs["R"])
    return mak


def _predict(mak, u, C):
    pose = mak.pose
    mak.predict(models.f_odometry(pose, u), noise.Q(jacobians.W_odometry(pose, u), C))


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
            _ordered("apu", "apw"),
        ),
        Diagnosis(
            "predicted-last",
            "What is seen is used before the drive is predicted: z was measured after it. Predict "
            "first.",
            _ordered("mp", "uap", "aup", "upa"),
        ),
        Diagnosis(
            "never-updated",
            "Landmarks seen again teach the filter nothing: known ids are to be updated.",
            _ordered("pa"),
        ),
        Diagnosis(
            "never-predicted",
            "The drive u is not used: predict comes first in every step.",
            _ordered("m", "ua"),
        ),
        Diagnosis(
            "counted-twice",
            "A new landmark is augmented and then updated with the same z. That sight has been "
            "used already: counted twice, it makes the filter surer than it may be.",
            _ordered("pd"),
        ),
        Diagnosis(
            "predicted-for-each",
            "The drive is predicted once for each landmark seen. It happened once in a step.",
            _ordered("pe", "e", "s", "ps"),
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
