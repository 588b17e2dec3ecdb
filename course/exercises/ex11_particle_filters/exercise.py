"""Exercise 11, particle filters.

``draw``, ``localise``, ``proposal``, ``fastslam``, ``kidnapped``: a task each; ``runs``, ``room``:
their runs.
"""

from classroom.exercises.exercise import Exercise
from course.exercises.ex11_particle_filters.draw.task import DRAW
from course.exercises.ex11_particle_filters.fastslam.task import FASTSLAM
from course.exercises.ex11_particle_filters.kidnapped.task import KIDNAPPED
from course.exercises.ex11_particle_filters.localise.task import LOCALISE
from course.exercises.ex11_particle_filters.proposal.task import PROPOSAL

EXERCISE = Exercise(
    id="11",
    notebook="11_particle_filters",
    title="Particle filters",
    tasks=(DRAW, LOCALISE, PROPOSAL, FASTSLAM, KIDNAPPED),
    calls="course.exercises.ex11_particle_filters.calls",
    allows=(
        "slamlab.geometry",
        "slamlab.layers",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.views",
    ),
    answers=("slamlab.filters", "slamlab.estimators", "course.studies"),
    hides=("filterpy",),
)
