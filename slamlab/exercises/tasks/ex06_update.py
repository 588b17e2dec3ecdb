"""Task 06-update: a landmark is seen again, and everyone learns."""

import numpy as np

from slamlab.exercises.drives.ex06 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex06_beliefs import same_block, same_mean
from slamlab.exercises.tasks.ex06_sights import BEHIND, LANDMARKS, ROWS, sights, truth
from slamlab.exercises.tasks.ex06_update_mistakes import MISTAKES


def _mean(rows):
    def holds(inputs, outputs):
        want, _ = truth(inputs)
        return same_mean(outputs["x"], want, inputs["P"])[rows]

    return holds


def _covariance(inputs, outputs):
    return same_block(outputs["P"], truth(inputs)[1])


UPDATE = Task(
    id="06-update",
    title="Update: a landmark is seen again",
    drive=DRIVES["06-update"],
    inputs=sights,
    shapes={"x": (ROWS, 3 + 2 * LANDMARKS), "P": (ROWS, 3 + 2 * LANDMARKS, 3 + 2 * LANDMARKS)},
    laws=(
        Law(
            "mean",
            2,
            "x fits belief and sight best: no other state has a smaller sum of squares",
            _mean(np.s_[:-BEHIND]),
        ),
        Law(
            "wrapped",
            1,
            "the same for landmarks behind the robot, where bearings jump from π to −π",
            _mean(np.s_[-BEHIND:]),
        ),
        Law(
            "P",
            2,
            "P holds what belief and sight know together: its inverse is P⁻¹ + Hᵀ R⁻¹ H",
            _covariance,
        ),
    ),
    diagnoses=MISTAKES,
    needs=("06-h",),
)
