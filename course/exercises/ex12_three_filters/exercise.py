"""Exercise 12, three filters.

``odometry``, ``ate``, ``interval``, ``paired``, ``relocalise``: a task each; ``hall``: the runs of
``relocalise``.
"""

from classroom.exercises.exercise import Exercise
from course.exercises.ex12_three_filters.ate.task import ATE
from course.exercises.ex12_three_filters.interval.task import INTERVAL
from course.exercises.ex12_three_filters.odometry.task import ODOMETRY
from course.exercises.ex12_three_filters.paired.task import PAIRED
from course.exercises.ex12_three_filters.relocalise.task import RELOCALISE

EXERCISE = Exercise(
    id="12",
    notebook="12_three_filters",
    title="Three filters on one robot",
    tasks=(ODOMETRY, ATE, INTERVAL, PAIRED, RELOCALISE),
    calls="course.exercises.ex12_three_filters.calls",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views"),
    answers=(
        "slamlab.estimators",
        "slamlab.simulation.wall_follower",
        "slamlab.simulation.differential_drive",
        "slamlab.sources",
        "course.studies",
    ),
)
