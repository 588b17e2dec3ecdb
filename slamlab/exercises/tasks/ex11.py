"""Exercise 11, samples: what it asks and what its solutions may import."""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex11_draw import DRAW
from slamlab.exercises.tasks.ex11_localise import LOCALISE
from slamlab.exercises.tasks.ex11_move import MOVE
from slamlab.exercises.tasks.ex11_normalise import NORMALISE
from slamlab.exercises.tasks.ex11_weigh import WEIGH

EXERCISE = Exercise(
    id="11",
    notebook="11_samples",
    title="Samples",
    tasks=(MOVE, WEIGH, NORMALISE, DRAW, LOCALISE),
    drives="slamlab.exercises.drives.ex11",
    allows=(
        "slamlab.geometry",
        "slamlab.layers",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.views",
    ),
    answers=("slamlab.filters", "slamlab.estimators", "slamlab.studies"),
)
