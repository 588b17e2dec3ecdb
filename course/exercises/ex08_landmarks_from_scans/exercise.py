"""Exercise 08, landmarks from scans. In this order: ``lines`` (lines as stacks), ``fit_line``
(total least squares), ``associate`` (data association), ``joint`` (joint compatibility),
``pillar`` (RANSAC), ``rooms``, ``segments`` (scans of rooms, split into walls)."""

from classroom.exercises.exercise import Exercise
from course.exercises.ex08_landmarks_from_scans.associate.task import ASSOCIATE
from course.exercises.ex08_landmarks_from_scans.fit_line.task import FIT_LINE
from course.exercises.ex08_landmarks_from_scans.joint.task import JOINT
from course.exercises.ex08_landmarks_from_scans.pillar.task import PILLAR
from course.exercises.ex08_landmarks_from_scans.segments.task import SEGMENTS

EXERCISE = Exercise(
    id="08",
    notebook="08_landmarks_from_scans",
    title="Landmarks from scans: feature extraction and data association",
    tasks=(FIT_LINE, ASSOCIATE, JOINT, PILLAR, SEGMENTS),
    calls="course.exercises.ex08_landmarks_from_scans.calls",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views"),
    answers=(
        "slamlab.landmarks",
        "slamlab.filters",
        "slamlab.estimators",
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.models.jacobians",
        "slamlab.models.symbolic",
    ),
)
