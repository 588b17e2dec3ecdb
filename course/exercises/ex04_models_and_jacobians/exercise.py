"""Exercise 04, models and Jacobians. In this order: ``generic`` (common functions), ``h_robot``,
``jxr_jz``, ``wheels``, ``camera`` (linearised), ``scatter``, ``moments`` (beyond the
first order)."""

from classroom.exercises.exercise import Exercise
from course.exercises.ex04_models_and_jacobians.camera import task as camera
from course.exercises.ex04_models_and_jacobians.h_robot import task as robot
from course.exercises.ex04_models_and_jacobians.jxr_jz import task as place
from course.exercises.ex04_models_and_jacobians.moments import task as moments
from course.exercises.ex04_models_and_jacobians.wheels import task as wheels

EXERCISE = Exercise(
    id="04",
    notebook="04_models_and_jacobians",
    title="Motion and measurement models, Jacobians and the EKF",
    calls="course.exercises.ex04_models_and_jacobians.calls",
    allows=(
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.geometry",
        "slamlab.views",
        "slamlab.layers",
    ),
    answers=("slamlab.models.jacobians", "slamlab.models.symbolic"),
    tasks=(robot.TASK, place.TASK, wheels.TASK, camera.TASK, moments.TASK),
)
