"""Exercise 05, two easy halves: what it asks and what its solutions may import.

- ``locate``, ``localise``: where am I, in a known map; ``map``: where are they, from known poses
- ``ranges``: beacons that tell only how far they are; ``lost``: no heading, and sights that lie
- ``sights``: what the tasks are tried on, and the filter that a run is compared with
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex05.localise import LOCALISE
from slamlab.exercises.tasks.ex05.locate import LOCATE
from slamlab.exercises.tasks.ex05.lost import LOST
from slamlab.exercises.tasks.ex05.map import MAP
from slamlab.exercises.tasks.ex05.ranges import RANGES

EXERCISE = Exercise(
    id="05",
    notebook="05_two_easy_halves",
    title="Two easy halves",
    tasks=(LOCATE, LOCALISE, MAP, RANGES, LOST),
    drives="slamlab.exercises.drives.ex05",
    allows=(
        "slamlab.geometry",
        "slamlab.models.jacobians",
        "slamlab.layers",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.views",
    ),
    answers=("slamlab.filters", "slamlab.estimators", "slamlab.studies"),
    hides=("filterpy",),
)
