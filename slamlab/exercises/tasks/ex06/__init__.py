"""Exercise 06, EKF-SLAM: what it asks and what its solutions may import.

- ``augment``, ``update``, ``slam``: the filter, block by block; ``beliefs``: what they are tried on
- ``same``: two landmarks turn out to be one; ``false_sights``: a filter that is told lies
- ``runs``: whole runs of one way; ``ends``: how their ends are judged
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex06.augment import AUGMENT
from slamlab.exercises.tasks.ex06.false_sights import FALSE_SIGHTS
from slamlab.exercises.tasks.ex06.same import SAME
from slamlab.exercises.tasks.ex06.slam import SLAM
from slamlab.exercises.tasks.ex06.update import UPDATE

EXERCISE = Exercise(
    id="06",
    notebook="06_ekf_slam",
    title="EKF-SLAM",
    tasks=(AUGMENT, UPDATE, SLAM, SAME, FALSE_SIGHTS),
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
    hides=("filterpy",),
)
