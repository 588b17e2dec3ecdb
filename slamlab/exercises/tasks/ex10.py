"""Exercise 10, boxes: what it asks and what its solutions may import."""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex10_clip import CLIP
from slamlab.exercises.tasks.ex10_edges import EDGES
from slamlab.exercises.tasks.ex10_heading import HEADING
from slamlab.exercises.tasks.ex10_predict import PREDICT
from slamlab.exercises.tasks.ex10_see import SEE

EXERCISE = Exercise(
    id="10",
    notebook="10_boxes",
    title="Boxes",
    tasks=(PREDICT, EDGES, CLIP, HEADING, SEE),
    drives="slamlab.exercises.drives.ex10",
    allows=(
        "slamlab.geometry",
        "slamlab.layers",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.views",
    ),
    answers=("slamlab.filters.bor", "slamlab.estimators", "slamlab.studies"),
)
