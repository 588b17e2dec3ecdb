"""Exercise 15, pose graphs.

``edges``, ``graphs``, ``laps``: inputs; ``jacobians``, ``step``, ``range``, ``gate``,
``false_loops``: a task each.
"""

from classroom.exercises.exercise import Exercise
from course.exercises.ex15_pose_graph_slam.false_loops.task import FALSE_LOOPS
from course.exercises.ex15_pose_graph_slam.gate.task import GATE
from course.exercises.ex15_pose_graph_slam.jacobians.task import JACOBIANS
from course.exercises.ex15_pose_graph_slam.range.task import RADIO
from course.exercises.ex15_pose_graph_slam.step.task import STEP

EXERCISE = Exercise(
    id="15",
    notebook="15_pose_graph_slam",
    title="Pose-graph SLAM: closing the loop",
    tasks=(JACOBIANS, STEP, RADIO, GATE, FALSE_LOOPS),
    calls="course.exercises.ex15_pose_graph_slam.calls",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views", "slamlab.simulation.worlds"),
    answers=(
        "slamlab.posegraph",
        "slamlab.gridmap",
        "slamlab.estimators",
    ),
    hides=("gtsam",),
)
