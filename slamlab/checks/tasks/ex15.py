"""Exercise 15, closing the loop: what it asks and what its solutions may import."""

from slamlab.checks.exercise import Exercise
from slamlab.checks.tasks.ex15_cell import CELL
from slamlab.checks.tasks.ex15_error import ERROR
from slamlab.checks.tasks.ex15_jacobians import JACOBIANS
from slamlab.checks.tasks.ex15_step import STEP
from slamlab.checks.tasks.ex15_weight import WEIGHT

EXERCISE = Exercise(
    id="15",
    notebook="15_closing_the_loop",
    title="Closing the loop",
    tasks=(ERROR, JACOBIANS, STEP, WEIGHT, CELL),
    drives="slamlab.checks.drives.ex15",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views", "slamlab.worlds"),
    answers=("slamlab.posegraph", "slamlab.gridmap", "slamlab.estimators", "slamlab.runner"),
)
