"""Task 09-update: a wall of the map is seen again, and everyone learns."""

import numpy as np

from slamlab.exercises.drives.ex09 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex09_update_mistakes import MISTAKES
from slamlab.exercises.tasks.ex09_update_sights import BEHIND, ROWS, N, covariance, mean, sights

UPDATE = Task(
    id="09-update",
    title="Update: a wall is seen again",
    drive=DRIVES["09-update"],
    inputs=sights,
    shapes={"x": (ROWS, N), "P": (ROWS, N, N)},
    laws=(
        Law(
            "mean",
            2,
            "x fits belief and sight best: no other state has a smaller sum of squares",
            mean(np.s_[:-BEHIND]),
        ),
        Law(
            "wrapped",
            1,
            "the same for walls behind the robot, where α' jumps from π to −π",
            mean(np.s_[-BEHIND:]),
        ),
        Law(
            "P",
            2,
            "P holds what belief and sight know together: its inverse is P⁻¹ + Hᵀ R⁻¹ H",
            covariance,
        ),
    ),
    diagnoses=MISTAKES,
)
