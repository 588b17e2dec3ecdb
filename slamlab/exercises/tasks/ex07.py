"""Exercise 07, correlations: what it asks and what its solutions may import."""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex07_correlation import CORRELATION
from slamlab.exercises.tasks.ex07_corridor import CORRIDOR
from slamlab.exercises.tasks.ex07_first import FIRST_ESTIMATES
from slamlab.exercises.tasks.ex07_fuse import FUSE
from slamlab.exercises.tasks.ex07_relative import RELATIVE
from slamlab.exercises.tasks.ex07_updates import TWO_UPDATES

EXERCISE = Exercise(
    id="07",
    notebook="07_correlations",
    title="Correlations",
    tasks=(CORRELATION, TWO_UPDATES, RELATIVE, FUSE, CORRIDOR, FIRST_ESTIMATES),
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
