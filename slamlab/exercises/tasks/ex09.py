"""Exercise 09, SLAM with walls: what it asks and what its solutions may import."""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex09_life import LIFE
from slamlab.exercises.tasks.ex09_place import PLACE
from slamlab.exercises.tasks.ex09_thin import THIN
from slamlab.exercises.tasks.ex09_update import UPDATE
from slamlab.exercises.tasks.ex09_walls import WALLS

EXERCISE = Exercise(
    id="09",
    notebook="09_slam_with_walls",
    title="SLAM with walls",
    tasks=(PLACE, UPDATE, LIFE, WALLS, THIN),
    drives="slamlab.exercises.drives.ex09",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views"),
    answers=(
        "slamlab.estimators",
        "slamlab.filters",
        "slamlab.models.jacobians",
        "slamlab.landmarks",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.models.symbolic",
    ),
)
