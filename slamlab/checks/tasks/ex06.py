"""Exercise 06, EKF-SLAM: what it asks and what its solutions may import."""

from slamlab.checks.exercise import Exercise
from slamlab.checks.tasks.ex06_augment import AUGMENT
from slamlab.checks.tasks.ex06_h import H_FULL
from slamlab.checks.tasks.ex06_predict import PREDICT
from slamlab.checks.tasks.ex06_slam import SLAM
from slamlab.checks.tasks.ex06_update import UPDATE

EXERCISE = Exercise(
    id="06",
    notebook="06_ekf_slam",
    title="EKF-SLAM",
    tasks=(PREDICT, AUGMENT, H_FULL, UPDATE, SLAM),
    drives="slamlab.checks.drives.ex06",
    allows=(
        "slamlab.geometry",
        "slamlab.jacobians",
        "slamlab.layers",
        "slamlab.models",
        "slamlab.views",
    ),
    answers=("slamlab.filters", "slamlab.estimators", "slamlab.runner"),
)
