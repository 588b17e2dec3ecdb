"""Exercise 01, why SLAM. In this order: ``motions``, ``next_pose``, ``seen_from`` (one step, and
back), ``drift``, ``miss`` (straight runs, any run), ``laps``, ``home`` (runs with loop
closures)."""

from classroom.exercises.exercise import Exercise
from course.exercises.ex01_why_slam.drift.task import DRIFT
from course.exercises.ex01_why_slam.home.task import HOME
from course.exercises.ex01_why_slam.miss.task import MISS
from course.exercises.ex01_why_slam.next_pose.task import NEXT_POSE
from course.exercises.ex01_why_slam.seen_from.task import SEEN_FROM

EXERCISE = Exercise(
    id="01",
    notebook="01_why_slam",
    title="Why SLAM",
    tasks=(NEXT_POSE, SEEN_FROM, DRIFT, MISS, HOME),
    calls="course.exercises.ex01_why_slam.calls",
    allows=(
        "slamlab.views",
        "slamlab.simulation.worlds",
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
