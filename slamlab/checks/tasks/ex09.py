"""Exercise 09, SLAM with walls: what it asks and what its solutions may import."""

from slamlab.checks.exercise import Exercise
from slamlab.checks.tasks.ex09_life import LIFE
from slamlab.checks.tasks.ex09_place import PLACE
from slamlab.checks.tasks.ex09_thin import THIN
from slamlab.checks.tasks.ex09_update import UPDATE
from slamlab.checks.tasks.ex09_walls import WALLS

EXERCISE = Exercise(
    id="09",
    notebook="09_slam_with_walls",
    title="SLAM with walls",
    tasks=(PLACE, UPDATE, LIFE, WALLS, THIN),
    drives="slamlab.checks.drives.ex09",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views"),
    answers=(
        "slamlab.estimators",
        "slamlab.filters",
        "slamlab.jacobians",
        "slamlab.landmarks",
        "slamlab.models",
        "slamlab.symbolic",
    ),
)
