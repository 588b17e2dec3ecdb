"""Exercise 06, EKF-SLAM: what it asks and what its solutions may import."""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex06_augment import AUGMENT
from slamlab.exercises.tasks.ex06_h import H_FULL
from slamlab.exercises.tasks.ex06_predict import PREDICT
from slamlab.exercises.tasks.ex06_slam import SLAM
from slamlab.exercises.tasks.ex06_update import UPDATE

EXERCISE = Exercise(
    id="06",
    notebook="06_ekf_slam",
    title="EKF-SLAM",
    tasks=(PREDICT, AUGMENT, H_FULL, UPDATE, SLAM),
    drives="slamlab.exercises.drives.ex06",
    allows=(
        "slamlab.geometry",
        "slamlab.models.jacobians",
        "slamlab.layers",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.views",
    ),
    answers=("slamlab.filters", "slamlab.estimators"),
)
