"""Exercise 01: dead reckoning and the map it smears."""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex01_drift import DRIFT
from slamlab.exercises.tasks.ex01_place import PLACE
from slamlab.exercises.tasks.ex01_seen import SEEN_FROM
from slamlab.exercises.tasks.ex01_step import NEXT_POSE
from slamlab.exercises.tasks.ex01_track import TRACK

EXERCISE = Exercise(
    id="01",
    notebook="01_why_slam",
    title="Why SLAM",
    tasks=(NEXT_POSE, TRACK, PLACE, SEEN_FROM, DRIFT),
    drives="slamlab.exercises.drives.ex01",
    allows=(
        "slamlab.views",
        "slamlab.worlds",
        "slamlab.simulation.range_scanners",
        "slamlab.layers",
    ),
    answers=(
        "slamlab.geometry",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.models.jacobians",
        "slamlab.models.symbolic",
        "slamlab.simulation.differential_drive",
        "slamlab.sources.simulated_robot",
        "slamlab.scanmatching",
        "slamlab.estimators",
        "slamlab.evaluation",
    ),
)
