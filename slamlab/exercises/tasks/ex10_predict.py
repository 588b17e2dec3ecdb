"""Exercise 10, prediction: no drive leaves the box, and no box is wider than the drives need."""

import numpy as np

from slamlab.exercises.drives.ex10 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex10_motions import beyond, inputs
from slamlab.exercises.tasks.ex10_predict_mistakes import MISTAKES, ROUNDING

LOOSE = 1e-4  # what a box may be wider than need be [m]

PREDICT = Task(
    id="10-predict",
    title="The box after a drive",
    drive=DRIVES["10-predict"],
    inputs=inputs,
    shapes={"result": (4,)},
    laws=(
        Law(
            "holds",
            2,
            "no drive within the bounds ends outside of the box",
            lambda given, out: (beyond(given, out) >= -ROUNDING).all(axis=1),
        ),
        Law(
            "tight",
            2,
            "every side of the box is reached by some drive within the bounds",
            lambda given, out: (np.abs(beyond(given, out)) <= LOOSE).all(axis=1),
        ),
    ),
    diagnoses=MISTAKES,
)
