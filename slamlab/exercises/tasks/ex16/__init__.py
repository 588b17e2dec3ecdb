"""Exercise 16, your own SLAM: its milestones, and what a student's SLAM may import.

- ``short_drives``: a corridor and a ring of corridors, driven on wheels that slip
- ``corridor``, ``loop``, ``sure``: it survives a corridor, closes a loop, says how sure it is
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex16.corridor import CORRIDOR
from slamlab.exercises.tasks.ex16.loop import LOOP
from slamlab.exercises.tasks.ex16.sure import SURE

EXERCISE = Exercise(
    id="16",
    notebook="16_your_own_slam",
    title="Your own SLAM",
    tasks=(CORRIDOR, LOOP, SURE),
    drives="slamlab.exercises.drives.ex16",
    allows=(
        "slamlab.geometry",
        "slamlab.layers",
        "slamlab.readings",
        "slamlab.worlds.ray_casting",
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
