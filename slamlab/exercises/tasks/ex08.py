"""Exercise 08, landmarks from scans: what it asks and what its solutions may import."""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex08_associate import ASSOCIATE
from slamlab.exercises.tasks.ex08_corner import CORNER
from slamlab.exercises.tasks.ex08_fit import FIT_LINE
from slamlab.exercises.tasks.ex08_observe import H_LINE
from slamlab.exercises.tasks.ex08_ransac import RANSAC

EXERCISE = Exercise(
    id="08",
    notebook="08_landmarks_from_scans",
    title="Landmarks from scans",
    tasks=(FIT_LINE, RANSAC, CORNER, H_LINE, ASSOCIATE),
    drives="slamlab.exercises.drives.ex08",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views"),
    answers=(
        "slamlab.landmarks",
        "slamlab.filters",
        "slamlab.estimators",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.models.jacobians",
        "slamlab.models.symbolic",
    ),
)
