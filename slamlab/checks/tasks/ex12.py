"""Exercise 12, three filters and one robot: what it asks and what its solutions may import."""

from slamlab.checks.exercise import Exercise
from slamlab.checks.tasks.ex12_decide import DECIDE
from slamlab.checks.tasks.ex12_interval import INTERVAL
from slamlab.checks.tasks.ex12_lost import LOST
from slamlab.checks.tasks.ex12_odometry import ODOMETRY

EXERCISE = Exercise(
    id="12",
    notebook="12_three_filters",
    title="Three filters, one robot",
    tasks=(ODOMETRY, DECIDE, LOST, INTERVAL),
    drives="slamlab.checks.drives.ex12",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views", "slamlab.worlds"),
    answers=(
        "slamlab.estimators",
        "slamlab.follower",
        "slamlab.simulator",
        "slamlab.sources",
        "slamlab.studies",
    ),
)
