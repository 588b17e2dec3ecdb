"""Exercise 06, EKF-SLAM. In this order: ``beliefs``, ``augment``, ``update`` (blocks of the
filter), ``runs``, ``ends`` (whole runs and their judgement), ``slam``, ``consistent`` (NIS and
NEES), ``outliers`` (with a gate)."""

from classroom.exercises.exercise import Exercise
from course.exercises.ex06_ekf_slam.augment.task import AUGMENT
from course.exercises.ex06_ekf_slam.consistent.task import CONSISTENT
from course.exercises.ex06_ekf_slam.outliers.task import OUTLIERS
from course.exercises.ex06_ekf_slam.slam.task import SLAM
from course.exercises.ex06_ekf_slam.update.task import UPDATE

EXERCISE = Exercise(
    id="06",
    notebook="06_ekf_slam",
    title="EKF-SLAM: the MAK filter",
    tasks=(AUGMENT, UPDATE, SLAM, CONSISTENT, OUTLIERS),
    calls="course.exercises.ex06_ekf_slam.calls",
    allows=(
        "slamlab.geometry",
        "slamlab.models.jacobians",
        "slamlab.layers",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.views",
    ),
    answers=("slamlab.filters", "slamlab.estimators"),
    hides=("filterpy",),
)
