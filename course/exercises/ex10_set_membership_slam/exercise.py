"""Exercise 10, boxes.

``predict``, ``edges``, ``heading``, ``relaxed``, ``narrow``: a task each; ``boxes``, ``bearings``,
``poses``: their random inputs.
"""

from classroom.exercises.exercise import Exercise
from course.exercises.ex10_set_membership_slam.edges.task import EDGES
from course.exercises.ex10_set_membership_slam.heading.task import HEADING
from course.exercises.ex10_set_membership_slam.narrow.task import NARROW
from course.exercises.ex10_set_membership_slam.predict.task import PREDICT
from course.exercises.ex10_set_membership_slam.relaxed.task import RELAXED

EXERCISE = Exercise(
    id="10",
    notebook="10_set_membership_slam",
    title="Set-membership SLAM: the BOR filter",
    tasks=(PREDICT, EDGES, HEADING, RELAXED, NARROW),
    calls="course.exercises.ex10_set_membership_slam.calls",
    allows=(
        "slamlab.geometry",
        "slamlab.layers",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.views",
    ),
    answers=("slamlab.filters.set_membership", "slamlab.estimators", "course.studies"),
)
