"""Exercise 12, three filters and one robot: what it asks and what its solutions may import."""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex12_decide import DECIDE
from slamlab.exercises.tasks.ex12_interval import INTERVAL
from slamlab.exercises.tasks.ex12_lost import LOST
from slamlab.exercises.tasks.ex12_odometry import ODOMETRY

EXERCISE = Exercise(
    id="12",
    notebook="12_three_filters",
    title="Three filters, one robot",
    tasks=(ODOMETRY, DECIDE, LOST, INTERVAL),
    drives="slamlab.exercises.drives.ex12",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views", "slamlab.worlds"),
    answers=(
        "slamlab.estimators",
        "slamlab.simulation.wall_follower",
        "slamlab.simulation.differential_drive",
        "slamlab.sources",
        "slamlab.studies",
    ),
)
