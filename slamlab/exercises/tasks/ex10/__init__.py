"""Exercise 10, boxes: what it asks and what its solutions may import.

``predict``, ``edges``, ``heading``, ``ring`` and ``narrow`` hold a task each; ``boxes`` draws boxes
and intervals, ``bearings`` robots that see an object, ``poses`` robots that see several, with the
poses that agree with all they saw.
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex10.edges import EDGES
from slamlab.exercises.tasks.ex10.heading import HEADING
from slamlab.exercises.tasks.ex10.narrow import NARROW
from slamlab.exercises.tasks.ex10.predict import PREDICT
from slamlab.exercises.tasks.ex10.ring import RING

EXERCISE = Exercise(
    id="10",
    notebook="10_boxes",
    title="Boxes",
    tasks=(PREDICT, EDGES, HEADING, RING, NARROW),
    drives="slamlab.exercises.drives.ex10",
    allows=(
        "slamlab.geometry",
        "slamlab.layers",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.views",
    ),
    answers=("slamlab.filters.bor", "slamlab.estimators", "slamlab.studies"),
)
