"""Exercise 16, a student's own SLAM.

``corridor``, ``loop``, ``sure``: one milestone each; ``short_runs``: the runs of all milestones;
``versions``: the comparison of two versions.
"""

from classroom.exercises.exercise import Exercise
from course.exercises.ex16_your_own_slam.corridor.task import CORRIDOR
from course.exercises.ex16_your_own_slam.loop.task import LOOP
from course.exercises.ex16_your_own_slam.sure.task import SURE
from course.exercises.ex16_your_own_slam.versions.task import VERSIONS

EXERCISE = Exercise(
    id="16",
    notebook="16_your_own_slam",
    title="Your own SLAM: benchmarks and evaluation",
    tasks=(CORRIDOR, LOOP, SURE, VERSIONS),
    calls="course.exercises.ex16_your_own_slam.calls",
    allows=(
        "slamlab.geometry",
        "slamlab.layers",
        "slamlab.readings",
        "slamlab.simulation.worlds.ray_casting",
    ),
    answers=(
        "slamlab.estimators",
        "slamlab.filters",
        "slamlab.gridmap",
        "slamlab.posegraph",
        "slamlab.scanmatching",
    ),
    hides=("filterpy", "gtsam", "open3d", "pykalman", "small_gicp", "probreg"),
)
