"""Task 09-place: landmark initialisation of a wall."""

import numpy as np

from classroom.exercises.correctness_laws import equals, once
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex06_ekf_slam.beliefs import T, covariances, either_sign
from course.exercises.ex09_slam_with_walls.calls import CALLS
from course.exercises.surveyed import EXACT, FARTHEST, differences
from slamlab import models
from slamlab.models import jacobians


def observations(rng, rows=8, beyond=2, bearings=(0.4, 2.6), ahead=(0.5, 3)):
    """Poses and measurements of walls, of which the last ``beyond`` lie between robot and origin.
    bearings : |α'| [rad]; ahead : component of the robot's position along the normal [m].
    """
    side = np.where(np.arange(rows) % 2, 1.0, -1.0)  # both, whatever is drawn
    z = np.column_stack([rng.uniform(1, 4, rows), side * rng.uniform(*bearings, rows)])
    theta, far = either_sign(rng, 0.3, 2.8, rows), rng.uniform(*ahead, rows)
    last = np.arange(rows) >= rows - beyond
    far[last] = -z[last, 0] - rng.uniform(0.5, 2, last.sum())
    aside, alpha = either_sign(rng, 0.8, 3, rows), theta + z[:, 1]
    c, s = np.cos(alpha), np.sin(alpha)
    x = np.column_stack([far * c - aside * s, far * s + aside * c, theta])
    of_pose = np.column_stack([rng.uniform(0.05, 0.15, (rows, 2)), rng.uniform(0.03, 0.06, rows)])
    of_wall = np.column_stack([rng.uniform(0.15, 0.3, rows), rng.uniform(0.08, 0.15, rows)])
    return {"x": x, "P": covariances(rng, of_pose), "z": z, "R": covariances(rng, of_wall)}


def _with(rows=2, times=None, beyond=2, **others):
    def inputs(rng):
        found = observations(rng, rows, beyond)
        return found | {name: found[name] * by for name, by in (times or {}).items()} | others

    return inputs


def slopes(inputs):
    """Jacobians of the lines with respect to pose and z: (n, 2, 3), (n, 2, 2)."""
    pairs = list(zip(inputs["x"], inputs["z"], strict=True))
    by = (jacobians.J_xr_line, jacobians.J_z_line)
    return tuple(np.array([J(x, z) for x, z in pairs]) for J in by)


@once
def want(inputs):
    """The lines in the world, their covariances and cross-covariances with the poses."""
    J_x, J_z = slopes(inputs)
    line = [models.g_line(x, z) for x, z in zip(inputs["x"], inputs["z"], strict=True)]
    X = J_x @ inputs["P"]
    return {"line": np.array(line), "C": X @ T(J_x) + J_z @ inputs["R"] @ T(J_z), "X": X}


def _only(name):
    return lambda inputs: {name: want(inputs)[name]}


def _on_the_way(inputs):
    return dict(zip(("J_x", "J_z"), slopes(inputs), strict=True))


def _direction(inputs):
    alpha = inputs["x"][:, 2] + inputs["z"][:, 1]
    return {
        "cos α": np.cos(alpha),
        "sin α": np.sin(alpha),
    }


def _parts(inputs, outputs):
    rho, alpha = outputs["line"].T
    rho = rho / (1 + np.abs(inputs["x"][:, :2]).max(axis=1))  # a fingerprint has few digits
    # by its cosine and sine: −π and π are one direction
    normal = np.column_stack([np.cos(alpha), np.sin(alpha)])
    C, X = np.arcsinh(outputs["C"]), np.arcsinh(outputs["X"])  # far off they hide all others
    return {"rho": rho, "normal": normal, "C": C, "X": X}


def _far(rng):
    found = _with(4, {"P": 10.0, "R": 10.0}, beyond=0)(rng)  # no error is below ROUNDING
    found["z"][:, 1] = found["x"][:, 2] = 0  # α is exactly 0
    found["x"][:, 0] += FARTHEST
    return found


FAR_OFF = "a robot a million kilometres from the origin"

WHOLE = {
    "x": np.array([[1.0, 2.0, 0.0], [3.0, -1.0, np.pi / 2], [0.0, 2.0, np.pi]]),
    "z": np.array([[2.0, 0.0], [1.0, np.pi / 2], [3.0, np.pi / 2]]),
}

PLACE = Task(
    id="09-place",
    title="Landmark initialisation: a new wall",
    call=CALLS["09-place"],
    inputs=observations,
    probes=(
        Probe("a wall behind the robot", lambda rng: observations(rng, 4, bearings=(3.1, 3.14))),
        Probe("a robot at the world's origin", _with(x=np.zeros((2, 3)))),
        Probe("walls parallel to the axes", _with(3, **WHOLE)),
        Probe("an exactly known pose", _with(times={"P": 0.0})),
        Probe("a measurement without noise", _with(times={"R": 0.0})),
        Probe("uncorrelated errors", _with(times={"P": np.eye(3), "R": np.eye(2)})),
        Probe("a robot 200 m from the origin", lambda rng: observations(rng, 2, ahead=(190, 210))),
        Probe(FAR_OFF, _far),
    ),
    diagnoses=(differences(lambda inputs: {name: want(inputs)[name] for name in "CX"}, FAR_OFF),),
    shapes=lambda inputs: {
        name: (len(inputs["x"]), *shape)
        for name, shape in (("line", (2,)), ("C", (2, 2)), ("X", (2, 3)))
    },
    parts=_parts,
    laws=(
        equals(
            "line",
            1,
            "(ρ, α) is the wall in the world frame, with the normal pointing away from the robot",
            _only("line"),
            angles={"line": 1},
            asks="How far is the robot from the world's origin along the normal? How far is the "
            "wall from the robot?",
            step=_direction,
        ),
        equals(
            "C",
            2.5,
            "C is the covariance of the pose plus that of z, each propagated by its Jacobian",
            _only("C"),
            tolerance=EXACT,
            asks="If only θ has an error, about which point is the wall rotated? How does this "
            "change ρ?",
            step=_on_the_way,
            after=("line",),
        ),
        equals(
            "X",
            2.5,
            "X is the cross-covariance of the line with the pose",
            _only("X"),
            tolerance=EXACT,
            asks="An error δ of the pose adds J_x δ to the error of the line. What is the mean of "
            "(J_x δ) δᵀ?",
            step=_on_the_way,
            after=("line",),
        ),
    ),
    references=(Reference("place", "x P z R", want, "line C X"),),
    begins=(
        "A robot at (1, 2) with θ = 0 measures a wall 2 m straight ahead. What are ρ "
        "and α of this wall?",
        "How do ρ and α change if only the heading of the robot changes?",
    ),
)
