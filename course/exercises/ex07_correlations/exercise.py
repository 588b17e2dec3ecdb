"""Exercise 07, correlations. In this order: ``beliefs`` (covariances, NEES), ``two_updates``,
``update_rest`` (landmarks that are not measured), ``fuse`` (correlated estimates), ``bound`` (the
map's limit), ``mornings`` (common error of unknown variance)."""

from classroom.exercises.exercise import Exercise
from course.exercises.ex07_correlations.bound.task import BOUND
from course.exercises.ex07_correlations.fuse.task import FUSE
from course.exercises.ex07_correlations.mornings.task import MORNINGS
from course.exercises.ex07_correlations.two_updates.task import TWO_UPDATES
from course.exercises.ex07_correlations.update_rest.task import UPDATE_REST

EXERCISE = Exercise(
    id="07",
    notebook="07_correlations",
    title="Correlations, consistency and cost of EKF-SLAM",
    tasks=(TWO_UPDATES, UPDATE_REST, FUSE, BOUND, MORNINGS),
    calls="course.exercises.ex07_correlations.calls",
    allows=(
        "slamlab.geometry",
        "slamlab.models.jacobians",
        "slamlab.layers",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.views",
    ),
    answers=(
        "slamlab.estimators",
        "slamlab.evaluation",
        "slamlab.filters",
        "course.studies",
    ),
)
