"""04-new-landmark: the covariance of a new landmark, and between it and the pose."""

import numpy as np

from slamlab.exercises.drives.ex04 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex04.generic import covariances, diagonal, polar, poses
from slamlab.exercises.tasks.ex04.place import by_measurement, by_pose

ROWS = 24
CURVED = 0.005
"""Share of the largest entry. Headings are known to 0.05 rad: whoever lets g bend instead of using
its Jacobians differs by σ² = 0.0025, and is right as well."""


def _believed(rng, n):
    """Poses and sightings with standard deviations that are small, as the text promises."""
    sigmas = np.column_stack([rng.uniform(0.03, 0.15, (n, 2)), rng.uniform(0.01, 0.05, n)])
    noise = np.column_stack([rng.uniform(0.02, 0.1, n), rng.uniform(0.01, 0.03, n)])
    return {
        "x": poses(rng, n),
        "P": covariances(rng, sigmas),
        "z": polar(rng, n),
        "R": diagonal(noise),
    }


def _random(rng):
    return _believed(rng, ROWS)


def _ahead(rng):
    return {
        "x": np.zeros((1, 3)),
        "P": diagonal([[0.1, 0.1, 0.05]]),
        "z": np.array([[2.0, 0.0]]),
        "R": diagonal([[0.1, 0.02]]),
    }


def _correlated_noise(rng):
    inputs = _believed(rng, 5)
    sigmas = np.sqrt(np.diagonal(inputs["R"], axis1=1, axis2=2))
    return inputs | {"R": covariances(rng, sigmas)}


def _sure_pose(rng):
    inputs = _believed(rng, 3)
    return inputs | {"P": 1e-4 * inputs["P"]}


def _sharp_sensor(rng):
    inputs = _believed(rng, 3)
    return inputs | {"R": 1e-4 * inputs["R"]}


def _first_order(inputs):
    """The two blocks with Jacobians by differences."""
    J_xr, J_z = by_pose(inputs), by_measurement(inputs)
    from_pose = J_xr @ inputs["P"] @ J_xr.swapaxes(1, 2)
    from_noise = J_z @ inputs["R"] @ J_z.swapaxes(1, 2)
    return {
        "P_nn": from_pose + from_noise,
        "P_rn": inputs["P"] @ J_xr.swapaxes(1, 2),
        "share of the pose in P_nn": from_pose,
        "share of the noise in P_nn": from_noise,
        "J_xr": J_xr,
    }


def _picked(*names):
    def pick(inputs):
        found = _first_order(inputs)
        return {name: found[name] for name in names}

    return pick


def _shapes(inputs):
    n = len(inputs["x"])
    return {"P_nn": (n, 2, 2), "P_rn": (n, 3, 2)}


def _promised(inputs):
    """(n,) whether ranges are positive, and headings known to 0.05 rad."""
    return (inputs["z"][:, 0] > 0) & (inputs["P"][:, 2, 2] < 0.0501**2)


TASK = Task(
    id="04-new-landmark",
    title="The covariance of a new landmark",
    drive=DRIVES["04-new-landmark"],
    inputs=_random,
    shapes=_shapes,
    laws=(
        equals(
            "P_nn",
            2,
            "P_nn is how uncertain the pose and the measurement together make the landmark",
            _picked("P_nn"),
            tolerance=CURVED,
            asks="Two things can be wrong when a landmark is placed: where the robot stood, and "
            "what it measured. Which matrix turns each of these into metres of the landmark?",
            step=_picked("share of the pose in P_nn", "share of the noise in P_nn"),
        ),
        equals(
            "P_rn",
            2,
            "P_rn is how the errors of the pose and of its new landmark go together",
            _picked("P_rn"),
            tolerance=CURVED,
            asks="To first order the landmark errs by J_xr times the pose's error, plus something "
            "that the pose knows nothing of. What is then the expectation of (pose's "
            "error)(landmark's error)ᵀ?",
            step=_picked("J_xr"),
        ),
    ),
    needs=("04-jxr-jz",),
    probes=(
        Probe("a landmark straight ahead of a robot at the origin", _ahead),
        Probe("a range error that goes with the bearing error", _correlated_noise),
        Probe("a pose that is all but certain", _sure_pose),
        Probe("a sensor that is all but exact", _sharp_sensor),
    ),
    rounds=_promised,
)
