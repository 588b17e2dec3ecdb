"""Exercise 07, correlations: what it asks and what its solutions may import.

- ``updates``: how landmarks come to share an error; ``hearsay``: what that teaches one out of sight
- ``fuse``: two estimates that share an error; ``corridor``: a filter that forgets nothing
- ``mornings``: the open task, readings that share an error of unknown size
- ``beliefs``: covariances and NEES, which they share
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex07.corridor import CORRIDOR
from slamlab.exercises.tasks.ex07.fuse import FUSE
from slamlab.exercises.tasks.ex07.hearsay import HEARSAY
from slamlab.exercises.tasks.ex07.mornings import MORNINGS
from slamlab.exercises.tasks.ex07.updates import TWO_UPDATES

EXERCISE = Exercise(
    id="07",
    notebook="07_correlations",
    title="Correlations",
    tasks=(TWO_UPDATES, HEARSAY, FUSE, CORRIDOR, MORNINGS),
    drives="slamlab.exercises.drives.ex07",
    allows=(
        "slamlab.geometry",
        "slamlab.models.jacobians",
        "slamlab.layers",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.views",
    ),
    answers=(
        "slamlab.estimators",
        "slamlab.evaluation",
        "slamlab.filters",
        "slamlab.studies",
    ),
)
