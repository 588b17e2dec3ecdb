"""Task 09-place: a wall seen from the robot, put into the world with its doubts."""

from slamlab.exercises.drives.ex09 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex09_place_mistakes import MISTAKES
from slamlab.exercises.tasks.ex09_place_sights import ROWS, block_holds, line_holds, sights

PLACE = Task(
    id="09-place",
    title="Place: a wall into the world",
    drive=DRIVES["09-place"],
    inputs=sights,
    shapes={"line": (ROWS, 2), "C": (ROWS, 2, 2), "X": (ROWS, 2, 3)},
    laws=(
        Law(
            "line",
            2,
            "the line holds the points of the wall, its normal away from the robot",
            line_holds,
        ),
        Law(
            "C",
            2,
            "C is the covariance of the lines that poses and sights in error give",
            block_holds("C"),
        ),
        Law("X", 2, "X is what those lines share with the pose's own errors", block_holds("X")),
    ),
    diagnoses=MISTAKES,
)
