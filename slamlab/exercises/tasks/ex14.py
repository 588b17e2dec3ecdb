"""Exercise 14, the eMIR system: what it asks and what its solutions may import."""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex14_command import COMMAND
from slamlab.exercises.tasks.ex14_nodes import NODES
from slamlab.exercises.tasks.ex14_points import POINTS
from slamlab.exercises.tasks.ex14_status import STATUS
from slamlab.exercises.tasks.ex14_unwrap import UNWRAP

EXERCISE = Exercise(
    id="14",
    notebook="14_the_emir_system",
    title="The eMIR system",
    tasks=(NODES, POINTS, COMMAND, STATUS, UNWRAP),
    drives="slamlab.exercises.drives.ex14",
    allows=("slamlab.layers", "slamlab.views", "slamlab.worlds"),
    answers=("slamlab.devices", "slamlab.readings", "slamlab.sources", "slamlab.cli"),
)
