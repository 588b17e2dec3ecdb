"""Task 06-slam: the whole filter over many runs, judged by truth and by least squares."""

import numpy as np

from slamlab.exercises.drives.ex06 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Diagnosis, Probe, Task
from slamlab.exercises.tasks.ex06.ends import MAP, NO_COVARIANCE, Ends, whole
from slamlab.exercises.tasks.ex06.runs import RUNS, runs
from slamlab.filters.landmark_models import POINTS

ENDS = Ends(POINTS, sure=(0.75, 1.33))


def _landmarks(inputs):
    return np.unique(inputs["seen"][inputs["seen"] >= 0]).size


def _too_many(inputs, outputs):
    return outputs["x"].shape[1] > 3 + 2 * _landmarks(inputs)


def _too_few(inputs, outputs):
    return outputs["x"].shape[1] < 3 + 2 * _landmarks(inputs)


def _ids_behind(inputs, outputs):
    return outputs["x"].shape[1] != 3 + 2 * outputs["ids"].shape[1]


def _far_off(inputs, outputs):
    """Whether the map is off by far more than any wrong covariance can explain."""
    if not whole(inputs, outputs):
        return False
    error = ENDS.errors(inputs, ENDS.of(inputs, outputs)[0])[:, MAP]
    return np.hypot(*error.reshape(-1, 2).T).max() > 1


def _counted(inputs, outputs):
    found = (outputs["x"].shape[1] - 3) / 2
    ids = outputs["ids"].shape[1]
    return (
        f"{_landmarks(inputs)} landmarks were seen; x has room for {found:g}, and ids names {ids}"
    )


def _spread(part):
    def why(inputs, outputs):
        if not whole(inputs, outputs):
            return _counted(inputs, outputs)
        x, P = ENDS.of(inputs, outputs)
        error = ENDS.errors(inputs, x)[:, part]
        if np.linalg.eigvalsh(P[:, part, part]).min() <= 0:
            return NO_COVARIANCE
        share = np.einsum("ri,rij,rj->r", error, np.linalg.inv(P[:, part, part]), error).mean()
        return (
            f"over {len(x)} runs the mean of eᵀ P⁻¹ e is {share:.3g} at the end; for "
            f"{error.shape[1]} numbers it should be about {error.shape[1]}"
        )

    return why


SLAM = Task(
    id="06-slam",
    title="The whole filter",
    drive=DRIVES["06-slam"],
    inputs=runs,
    shapes={"x": (RUNS, None), "P": (RUNS, None, None), "ids": (RUNS, None)},
    rounds=False,
    probes=(
        Probe("landmarks behind the robot", lambda rng: runs(rng, behind=True), ("pose", "map")),
    ),
    laws=(
        Law(
            "ids",
            1,
            "the map holds every landmark that was seen, each once",
            whole,
            why=_counted,
            asks="When is a landmark new, and who remembers that it no longer is?",
        ),
        Law(
            "pose",
            1,
            "over all runs, the pose errs as much as P says (NEES within its band)",
            ENDS.honest(np.s_[:3]),
            why=_spread(np.s_[:3]),
            after=("ids",),
            asks="Was z measured before or after the drive? How often was the drive driven?",
        ),
        Law(
            "map",
            1,
            "over all runs, the landmarks err as much as P says (NEES within its band)",
            ENDS.honest(MAP),
            why=_spread(MAP),
            after=("ids",),
            asks="Which landmark of x does the k-th row of z belong to?",
        ),
        Law(
            "sure",
            2,
            "x is where least squares over the whole run put it, and P as sure, of robot, map and "
            "what lies between them",
            ENDS.sure,
            why=lambda inputs, outputs: ENDS.ratios_told(inputs, outputs),
            after=("ids",),
            asks="Is any sight used twice, or never?",
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
            "far-off",
            "The map is more than a metre off. Look at the order first: predict once, before "
            "anything is looked at. If it is right, some sights go to the wrong landmark: ids[j] "
            "names landmark j of x, new ones come last in both, z[k] belongs to seen[k].",
            _far_off,
        ),
    ),
    needs=("06-augment", "06-update"),
)
