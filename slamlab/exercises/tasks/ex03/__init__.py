"""Exercise 03, the Kalman filter: what it asks and what its solutions may import.

Read in this order:

- ``beliefs``: random beliefs and measurements of any size, and what samples and squares say of them
- ``gain``, ``update``, ``filter``: the lesson's filter
- ``capacitor``: the lesson's recipe on a system of another kind
- ``ghosts``: a filter for measurements that are not what was promised
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex03.capacitor import CAPACITOR
from slamlab.exercises.tasks.ex03.filter import FILTER
from slamlab.exercises.tasks.ex03.gain import GAIN
from slamlab.exercises.tasks.ex03.ghosts import WARY
from slamlab.exercises.tasks.ex03.update import UPDATE

EXERCISE = Exercise(
    id="03",
    notebook="03_kalman_filter",
    title="The Kalman filter",
    tasks=(GAIN, UPDATE, FILTER, CAPACITOR, WARY),
    drives="slamlab.exercises.drives.ex03",
    allows=("slamlab.layers", "slamlab.views"),
    answers=("slamlab.filters", "slamlab.estimators", "slamlab.evaluation"),
    hides=("filterpy",),
)
