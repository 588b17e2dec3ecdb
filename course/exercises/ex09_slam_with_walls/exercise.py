"""Exercise 09, SLAM with walls.

One task each: ``place`` (landmark initialisation), ``life`` (track management), ``merge``, ``end``
and ``clean_map`` (a map without false walls); ``rooms``: runs for ``clean_map``.
"""

from classroom.exercises.exercise import Exercise
from course.exercises.ex09_slam_with_walls.clean_map.task import CLEAN_MAP
from course.exercises.ex09_slam_with_walls.end.task import END_POINT
from course.exercises.ex09_slam_with_walls.life.task import LIFE
from course.exercises.ex09_slam_with_walls.merge.task import MERGE
from course.exercises.ex09_slam_with_walls.place.task import PLACE

EXERCISE = Exercise(
    id="09",
    notebook="09_slam_with_walls",
    title="SLAM with walls: line landmarks",
    tasks=(PLACE, LIFE, MERGE, END_POINT, CLEAN_MAP),
    calls="course.exercises.ex09_slam_with_walls.calls",
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
