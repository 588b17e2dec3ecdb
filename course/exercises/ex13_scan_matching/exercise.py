"""Exercise 13, scan matching.

``motions``: point clouds and rigid alignment; ``best_motion``, ``icp``, ``kernel``, ``line_step``
and ``overlap``: one task each; ``halves``: scans for the last one.
"""

from classroom.exercises.exercise import Exercise
from course.exercises.ex13_scan_matching.best_motion.task import BEST_MOTION
from course.exercises.ex13_scan_matching.icp.task import ICP
from course.exercises.ex13_scan_matching.kernel.task import KERNEL
from course.exercises.ex13_scan_matching.line_step.task import LINE_STEP
from course.exercises.ex13_scan_matching.overlap.task import OVERLAP

EXERCISE = Exercise(
    id="13",
    notebook="13_scan_matching",
    title="Scan matching: ICP",
    tasks=(BEST_MOTION, ICP, KERNEL, LINE_STEP, OVERLAP),
    calls="course.exercises.ex13_scan_matching.calls",
    allows=(
        "slamlab.geometry",
        "slamlab.layers",
        "slamlab.simulation.range_scanners",
        "slamlab.views",
        "slamlab.simulation.worlds",
    ),
    answers=("slamlab.scanmatching", "slamlab.estimators"),
    hides=("small_gicp", "open3d"),
)
