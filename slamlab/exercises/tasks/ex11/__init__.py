"""Exercise 11, samples: what it asks and what its solutions may import.

Read in this order:

- ``weigh``, ``draw``: logarithms of likelihoods, and a comb
- ``runs``, ``localise``: drives among landmarks, and one step of Monte Carlo localisation
- ``proposal``: the lesson's p/q for samples that were drawn with a look ahead
- ``room``, ``kidnapped``: a robot that is carried off, and found again
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex11.draw import DRAW
from slamlab.exercises.tasks.ex11.kidnapped import KIDNAPPED
from slamlab.exercises.tasks.ex11.localise import LOCALISE
from slamlab.exercises.tasks.ex11.proposal import PROPOSAL
from slamlab.exercises.tasks.ex11.weigh import WEIGH

EXERCISE = Exercise(
    id="11",
    notebook="11_samples",
    title="Samples",
    tasks=(WEIGH, DRAW, LOCALISE, PROPOSAL, KIDNAPPED),
    drives="slamlab.exercises.drives.ex11",
    allows=(
        "slamlab.geometry",
        "slamlab.layers",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.views",
    ),
    answers=("slamlab.filters", "slamlab.estimators", "slamlab.studies"),
    hides=("filterpy",),
)
