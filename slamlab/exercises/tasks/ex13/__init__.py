"""Exercise 13, scan matching: what it asks and what its solutions may import.

- ``motions``: motions, clouds and what lays one over another; ``fit``: pairs that are known
- ``icp``, ``trimmed``: pairs that are guessed; ``line_step``: a step across walls, and how sure
- ``halves``: two scans that share half of what they see; ``overlap``: matched from a bad guess
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex13.fit import BEST_MOTION
from slamlab.exercises.tasks.ex13.icp import ICP
from slamlab.exercises.tasks.ex13.line_step import LINE_STEP
from slamlab.exercises.tasks.ex13.overlap import OVERLAP
from slamlab.exercises.tasks.ex13.trimmed import TRIMMED

EXERCISE = Exercise(
    id="13",
    notebook="13_scan_matching",
    title="Scan matching",
    tasks=(BEST_MOTION, ICP, TRIMMED, LINE_STEP, OVERLAP),
    drives="slamlab.exercises.drives.ex13",
    allows=(
        "slamlab.geometry",
        "slamlab.layers",
        "slamlab.simulation.range_scanners",
        "slamlab.views",
        "slamlab.worlds",
    ),
    answers=("slamlab.scanmatching", "slamlab.estimators"),
    hides=("small_gicp", "open3d"),
)
