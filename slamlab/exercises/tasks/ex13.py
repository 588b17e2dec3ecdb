"""Exercise 13, scan matching: what it asks and what its solutions may import."""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex13_fit import BEST_MOTION, MIRROR
from slamlab.exercises.tasks.ex13_icp import ICP
from slamlab.exercises.tasks.ex13_trimmed import TRIMMED
from slamlab.exercises.tasks.ex13_walk import WALK

EXERCISE = Exercise(
    id="13",
    notebook="13_scan_matching",
    title="Scan matching",
    tasks=(BEST_MOTION, MIRROR, ICP, TRIMMED, WALK),
    drives="slamlab.exercises.drives.ex13",
    allows=(
        "slamlab.geometry",
        "slamlab.layers",
        "slamlab.simulation.range_scanners",
        "slamlab.views",
        "slamlab.worlds",
    ),
    answers=("slamlab.scanmatching", "slamlab.estimators"),
)
