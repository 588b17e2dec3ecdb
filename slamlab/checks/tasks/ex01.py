"""Exercise 01: dead reckoning and the map it smears."""

from slamlab.checks.exercise import Exercise
from slamlab.checks.tasks.ex01_drift import DRIFT
from slamlab.checks.tasks.ex01_place import PLACE
from slamlab.checks.tasks.ex01_seen import SEEN_FROM
from slamlab.checks.tasks.ex01_step import NEXT_POSE
from slamlab.checks.tasks.ex01_track import TRACK

EXERCISE = Exercise(
    id="01",
    notebook="01_why_slam",
    title="Why SLAM",
    tasks=(NEXT_POSE, TRACK, PLACE, SEEN_FROM, DRIFT),
    drives="slamlab.checks.drives.ex01",
    allows=("slamlab.views", "slamlab.worlds", "slamlab.sensors", "slamlab.layers"),
    answers=(
        "slamlab.geometry",
        "slamlab.models",
        "slamlab.jacobians",
        "slamlab.symbolic",
        "slamlab.simulator",
        "slamlab.sources.simulation",
        "slamlab.scanmatching",
        "slamlab.estimators",
        "slamlab.runner",
        "slamlab.evaluation",
    ),
)
