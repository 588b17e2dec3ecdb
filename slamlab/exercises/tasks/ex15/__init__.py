"""Exercise 15, closing the loop: what it asks and what its solutions may import.

- ``edges``: edges between poses; ``error``, ``jacobians``: how far off a pose is, and its slopes
- ``graphs``: small pose graphs; ``step``: one step of Gauss and Newton over a graph
- ``radio``: an edge that is a distance only, between radios beside the robots' centres
- ``laps``: two laps with loops, some of them false; ``liars``: the map in spite of them
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex15.error import ERROR
from slamlab.exercises.tasks.ex15.jacobians import JACOBIANS
from slamlab.exercises.tasks.ex15.liars import LIARS
from slamlab.exercises.tasks.ex15.radio import RADIO
from slamlab.exercises.tasks.ex15.step import STEP

EXERCISE = Exercise(
    id="15",
    notebook="15_closing_the_loop",
    title="Closing the loop",
    tasks=(ERROR, JACOBIANS, STEP, RADIO, LIARS),
    drives="slamlab.exercises.drives.ex15",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views", "slamlab.worlds"),
    answers=(
        "slamlab.posegraph",
        "slamlab.gridmap",
        "slamlab.estimators",
    ),
    hides=("gtsam",),
)
