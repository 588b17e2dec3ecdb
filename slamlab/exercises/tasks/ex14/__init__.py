"""Exercise 14, the eMIR system: what it asks and what its solutions may import.

- ``lidar_nodes``: bytes of a lidar, some of them damaged; what was put in is what is read
- ``drive_command``: a command with its checksum
- ``counter_overflow``: a counter of one byte, and how far it went
- ``sweep_packet``: rays of a lidar whose packets the lesson has not seen
- ``driver_trials``: trials that tell wrong drivers from right ones
- ``faulty_drivers``: the wrong ones, each with one fault
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex14.counter_overflow import UNWRAP
from slamlab.exercises.tasks.ex14.drive_command import COMMAND
from slamlab.exercises.tasks.ex14.driver_trials import TRIALS
from slamlab.exercises.tasks.ex14.lidar_nodes import NODES
from slamlab.exercises.tasks.ex14.sweep_packet import SWEEP

EXERCISE = Exercise(
    id="14",
    notebook="14_the_emir_system",
    title="The eMIR system",
    tasks=(NODES, SWEEP, COMMAND, UNWRAP, TRIALS),
    drives="slamlab.exercises.drives.ex14",
    allows=("slamlab.layers", "slamlab.views", "slamlab.worlds"),
    answers=("slamlab.devices", "slamlab.readings", "slamlab.sources", "slamlab.cli"),
)
