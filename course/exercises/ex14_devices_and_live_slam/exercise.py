"""Exercise 14, drivers of devices.

``nodes``, ``sweep``, ``deskew``, ``unwrap``, ``trials``: one task each; ``faulty_drivers``: the
drivers that the test cases of the last task have to detect.
"""

from classroom.exercises.exercise import Exercise
from course.exercises.ex14_devices_and_live_slam.deskew.task import DESKEW
from course.exercises.ex14_devices_and_live_slam.nodes.task import NODES
from course.exercises.ex14_devices_and_live_slam.sweep.task import SWEEP
from course.exercises.ex14_devices_and_live_slam.trials.task import TRIALS
from course.exercises.ex14_devices_and_live_slam.unwrap.task import UNWRAP

EXERCISE = Exercise(
    id="14",
    notebook="14_devices_and_live_slam",
    title="Devices and live SLAM: RPLIDAR and eMIR",
    tasks=(NODES, SWEEP, DESKEW, UNWRAP, TRIALS),
    calls="course.exercises.ex14_devices_and_live_slam.calls",
    allows=("slamlab.layers", "slamlab.views", "slamlab.simulation.worlds"),
    answers=(
        "slamlab.devices",
        "slamlab.deskewing",
        "slamlab.readings",
        "slamlab.sources",
        "slamlab.cli",
    ),
)
