"""Exercise 15, closing the loop: what it asks and what its solutions may import."""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex15_cell import CELL
from slamlab.exercises.tasks.ex15_error import ERROR
from slamlab.exercises.tasks.ex15_jacobians import JACOBIANS
from slamlab.exercises.tasks.ex15_step import STEP
from slamlab.exercises.tasks.ex15_weight import WEIGHT

EXERCISE = Exercise(
    id="15",
    notebook="15_closing_the_loop",
    title="Closing the loop",
    tasks=(ERROR, JACOBIANS, STEP, WEIGHT, CELL),
    drives="slamlab.exercises.drives.ex15",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views", "slamlab.worlds"),
    answers=(
        "slamlab.posegraph",
        "slamlab.gridmap",
        "slamlab.estimators",
    ),
)
