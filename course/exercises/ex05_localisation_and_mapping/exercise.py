"""Exercise 05, localisation and mapping. In this order: ``observations`` (inputs, reference
filter), ``locate``, ``localise``, ``alternate``, ``ranges`` (ranges only), ``lost`` (unknown
heading)."""

from classroom.exercises.exercise import Exercise
from course.exercises.ex05_localisation_and_mapping.alternate.task import ALTERNATE
from course.exercises.ex05_localisation_and_mapping.localise.task import LOCALISE
from course.exercises.ex05_localisation_and_mapping.locate.task import LOCATE
from course.exercises.ex05_localisation_and_mapping.lost.task import LOST
from course.exercises.ex05_localisation_and_mapping.ranges.task import RANGES

EXERCISE = Exercise(
    id="05",
    notebook="05_localisation_and_mapping",
    title="Localisation and mapping, apart",
    tasks=(LOCATE, LOCALISE, ALTERNATE, RANGES, LOST),
    calls="course.exercises.ex05_localisation_and_mapping.calls",
    allows=(
        "slamlab.geometry",
        "slamlab.models.jacobians",
        "slamlab.layers",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.views",
    ),
    answers=("slamlab.filters", "slamlab.estimators", "course.studies"),
    hides=("filterpy",),
)
