"""Exercise 08, landmarks from scans: what it asks and what its solutions may import.

- ``fit``: a wall's line, of total least squares
- ``corner``: where two lines meet, and how sure that is
- ``associate``: which wall of the map was seen
- ``pillar``: a round pillar among other readings
- ``segments``: all walls of a scan, as well as one can
- ``lines``: lines and circles as stacks, what they have in common
- ``rooms``: scans of rooms with clutter, and whose readings they truly are
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex08.associate import ASSOCIATE
from slamlab.exercises.tasks.ex08.corner import CORNER
from slamlab.exercises.tasks.ex08.fit import FIT_LINE
from slamlab.exercises.tasks.ex08.pillar import PILLAR
from slamlab.exercises.tasks.ex08.segments import SEGMENTS

EXERCISE = Exercise(
    id="08",
    notebook="08_landmarks_from_scans",
    title="Landmarks from scans",
    tasks=(FIT_LINE, CORNER, ASSOCIATE, PILLAR, SEGMENTS),
    drives="slamlab.exercises.drives.ex08",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views"),
    answers=(
        "slamlab.landmarks",
        "slamlab.filters",
        "slamlab.estimators",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.models.jacobians",
        "slamlab.models.symbolic",
    ),
)
