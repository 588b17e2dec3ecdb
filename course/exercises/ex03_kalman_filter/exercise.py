"""Exercise 03, the Kalman filter. In this order: ``beliefs`` (random inputs, judged by samples and
least squares), ``update``, ``filter``, ``consistent``, ``capacitor``, ``outliers`` (any method)."""

from classroom.exercises.exercise import Exercise
from course.exercises.ex03_kalman_filter.capacitor.task import CAPACITOR
from course.exercises.ex03_kalman_filter.consistent.task import CONSISTENT
from course.exercises.ex03_kalman_filter.filter.task import FILTER
from course.exercises.ex03_kalman_filter.outliers.task import OUTLIERS
from course.exercises.ex03_kalman_filter.update.task import UPDATE

EXERCISE = Exercise(
    id="03",
    notebook="03_kalman_filter",
    title="The Kalman filter",
    tasks=(UPDATE, FILTER, CONSISTENT, CAPACITOR, OUTLIERS),
    calls="course.exercises.ex03_kalman_filter.calls",
    allows=("slamlab.layers", "slamlab.views"),
    answers=("slamlab.filters", "slamlab.estimators", "slamlab.evaluation"),
    hides=("filterpy",),
)
