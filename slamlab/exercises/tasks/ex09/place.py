"""Task 09-place: a wall seen from the robot, put into the world with its doubts."""

import numpy as np

from slamlab import models
from slamlab.exercises.drives.ex09 import DRIVES
from slamlab.exercises.law import equals, once
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex06.beliefs import T, covariances, either_sign
from slamlab.models import jacobians


def sights(rng, rows=8, beyond=2, bearings=(0.4, 2.6), ahead=(0.5, 3)):
    """Poses with their covariance, and walls seen from there; nothing stands at a right angle.

    Parameters
    ----------
    rng : numpy.random.Generator
    rows : int
    beyond : int, so many walls, the last ones, stand between the robot and the world's origin
    bearings : (low, high) of |α'| [rad]
    ahead : (low, high), so far the robot has gone from the origin towards the wall [m]
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


def _with(rows=2, times=None, **others):
    """A probe's inputs: sights, some arrays times something, and others in the place of some."""

    def inputs(rng):
        found = sights(rng, rows)
        return found | {name: found[name] * by for name, by in (times or {}).items()} | others

    return inputs


def slopes(inputs):
    """(n, 2, 3), (n, 2, 2): the line's derivatives by the pose and by z."""
    pairs = list(zip(inputs["x"], inputs["z"], strict=True))
    by = (jacobians.J_xr_line, jacobians.J_z_line)
    return tuple(np.array([J(x, z) for x, z in pairs]) for J in by)


@once
def want(inputs):
    """The lines in the world, their covariances, and what they share with the poses."""
    J_x, J_z = slopes(inputs)
    line = [models.g_line(x, z) for x, z in zip(inputs["x"], inputs["z"], strict=True)]
    X = J_x @ inputs["P"]
    return {"line": np.array(line), "C": X @ T(J_x) + J_z @ inputs["R"] @ T(J_z), "X": X}


def _only(name):
    return lambda inputs: {name: want(inputs)[name]}


def _on_the_way(inputs):
    return dict(zip(("J_x", "J_z"), slopes(inputs), strict=True))


def _parts(inputs, outputs):
    rho, alpha = outputs["line"].T
    # by its cosine and sine: −π and π are one direction
    normal = np.column_stack([np.cos(alpha), np.sin(alpha)])
    return {"rho": rho, "normal": normal, "C": outputs["C"], "X": outputs["X"]}


WHOLE = {
    "x": np.array([[1.0, 2.0, 0.0], [3.0, -1.0, np.pi / 2], [0.0, 2.0, np.pi]]),
    "z": np.array([[2.0, 0.0], [1.0, np.pi / 2], [3.0, np.pi / 2]]),
}

PLACE = Task(
    id="09-place",
    title="Place: a wall into the world",
    drive=DRIVES["09-place"],
    inputs=sights,
    probes=(
        Probe("a wall behind the robot", lambda rng: sights(rng, 4, bearings=(3.1, 3.14))),
        Probe("the robot at the world's origin", _with(x=np.zeros((2, 3)))),
        Probe("walls along x and y", _with(3, **WHOLE)),
        Probe("a pose that is known exactly", _with(times={"P": 0.0})),
        Probe("a sight that does not err", _with(times={"R": 0.0})),
        Probe("errors that share nothing", _with(times={"P": np.eye(3), "R": np.eye(2)})),
        Probe("a robot 200 m away", lambda rng: sights(rng, 2, ahead=(190, 210))),
    ),
    shapes=lambda inputs: {
        name: (len(inputs["x"]), *shape)
        for name, shape in (("line", (2,)), ("C", (2, 2)), ("X", (2, 3)))
    },
    parts=_parts,
    laws=(
        equals(
            "line",
            2,
            "the line holds the points of the wall, its normal away from the robot",
            _only("line"),
            angles={"line": 1},
            asks="Walk from the world's origin along the normal: how far is it to the robot's "
            "height, and how far from there to the wall?",
        ),
        equals(
            "C",
            2,
            "C is the covariance of the lines that poses and sights in error give",
            _only("C"),
            asks="When θ alone errs, about which point does the wall turn, and what does that do "
            "to ρ?",
            step=_on_the_way,
            after=("line",),
        ),
        equals(
            "X",
            2,
            "X is what those lines share with the pose's own errors",
            _only("X"),
            asks="If the pose errs by δ, the line errs by J_x δ and more. What is the mean of "
            "(J_x δ) δᵀ?",
            step=_on_the_way,
            after=("line",),
        ),
    ),
)
