"""Exercise 01, why SLAM: what it asks and what its solutions may import.

- ``next_pose``, ``seen_from``: one step there, and back; ``motions``: poses and the laws of both
- ``drift``: how far a straight drive leads astray; ``miss``: any drive, and errors of two kinds
- ``laps``: drives that come back to their dock; ``home``: the best track of them
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex01.drift import DRIFT
from slamlab.exercises.tasks.ex01.home import HOME
from slamlab.exercises.tasks.ex01.miss import MISS
from slamlab.exercises.tasks.ex01.next_pose import NEXT_POSE
from slamlab.exercises.tasks.ex01.seen_from import SEEN_FROM

EXERCISE = Exercise(
    id="01",
    notebook="01_why_slam",
    title="Why SLAM",
    tasks=(NEXT_POSE, SEEN_FROM, DRIFT, MISS, HOME),
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
