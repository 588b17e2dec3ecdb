"""Exercise 03, the Kalman filter: what it asks and what its solutions may import."""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex03_filter import FILTER
from slamlab.exercises.tasks.ex03_gain import GAIN
from slamlab.exercises.tasks.ex03_innovation import INNOVATION
from slamlab.exercises.tasks.ex03_predict import PREDICT
from slamlab.exercises.tasks.ex03_update import UPDATE

EXERCISE = Exercise(
    id="03",
    notebook="03_kalman_filter",
    title="The Kalman filter",
    tasks=(PREDICT, INNOVATION, GAIN, UPDATE, FILTER),
    drives="slamlab.exercises.drives.ex03",
    allows=("slamlab.layers", "slamlab.views"),
    answers=("slamlab.filters", "slamlab.estimators", "slamlab.evaluation"),
)
