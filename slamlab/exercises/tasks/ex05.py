"""Exercise 05, two easy halves: what it asks and what its solutions may import."""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex05_localise import LOCALISE
from slamlab.exercises.tasks.ex05_map import MAP
from slamlab.exercises.tasks.ex05_predict import PREDICT
from slamlab.exercises.tasks.ex05_update import LANDMARK, LOCATE

EXERCISE = Exercise(
    id="05",
    notebook="05_two_easy_halves",
    title="Two easy halves",
    tasks=(PREDICT, LOCATE, LOCALISE, LANDMARK, MAP),
    drives="slamlab.exercises.drives.ex05",
    allows=(
        "slamlab.geometry",
        "slamlab.models.jacobians",
        "slamlab.layers",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.views",
    ),
    answers=("slamlab.filters", "slamlab.estimators", "slamlab.studies"),
)
