"""Exercise 04, Models and Jacobians: what a small error becomes, and a large one.

- ``robot``: H of range and bearing by the pose; ``place``: J_xr and J_z of a new landmark
- ``landmark``: its covariance, and with the pose
- ``camera``: the lesson's derivation for a camera beside the robot's centre
- ``unsure``: a drive that no Jacobian foretells, better than linearised; ``scatter``: how good
- ``generic``: random poses and covariances, differences
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex04 import camera, landmark, place, robot, unsure

EXERCISE = Exercise(
    id="04",
    notebook="04_models_and_jacobians",
    title="Models and Jacobians",
    drives="slamlab.exercises.drives.ex04",
    allows=(
        "slamlab.models.motion",
        "slamlab.models.observation",
        "slamlab.geometry",
        "slamlab.views",
        "slamlab.layers",
    ),
    answers=("slamlab.models.jacobians", "slamlab.models.symbolic"),
    tasks=(robot.TASK, place.TASK, landmark.TASK, camera.TASK, unsure.TASK),
)
