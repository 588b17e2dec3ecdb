"""Exercise 09, SLAM with walls: what it asks and what its solutions may import.

- ``place``, ``update``: a wall is seen for the first time, and again
- ``life``: a book of sightings and lives
- ``end_point``: where a wall ends, and how sure that is
- ``ghosts``: a map without ghosts among false walls; ``rooms``: the drives it is tried on
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex09.end_point import END_POINT
from slamlab.exercises.tasks.ex09.ghosts import GHOSTS
from slamlab.exercises.tasks.ex09.life import LIFE
from slamlab.exercises.tasks.ex09.place import PLACE
from slamlab.exercises.tasks.ex09.update import UPDATE

EXERCISE = Exercise(
    id="09",
    notebook="09_slam_with_walls",
    title="SLAM with walls",
    tasks=(PLACE, UPDATE, LIFE, END_POINT, GHOSTS),
    drives="slamlab.exercises.drives.ex09",
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
