"""Exercise 14, the eMIR system: what it asks and what its solutions may import."""

from slamlab.checks.exercise import Exercise
from slamlab.checks.tasks.ex14_command import COMMAND
from slamlab.checks.tasks.ex14_nodes import NODES
from slamlab.checks.tasks.ex14_points import POINTS
from slamlab.checks.tasks.ex14_status import STATUS
from slamlab.checks.tasks.ex14_unwrap import UNWRAP

EXERCISE = Exercise(
    id="14",
    notebook="14_the_emir_system",
    title="The eMIR system",
    tasks=(NODES, POINTS, COMMAND, STATUS, UNWRAP),
    drives="slamlab.checks.drives.ex14",
    allows=("slamlab.layers", "slamlab.views", "slamlab.worlds"),
    answers=("slamlab.devices", "slamlab.readings", "slamlab.sources", "slamlab.cli"),
)
