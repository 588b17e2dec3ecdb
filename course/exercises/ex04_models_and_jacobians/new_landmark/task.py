"""04-new-landmark: a new landmark's covariance and cross-covariance with the pose."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.task import Probe, Task
from course.exercises.ex04_models_and_jacobians.calls import CALLS
from course.exercises.ex04_models_and_jacobians.generic import covariances, diagonal, polar, poses
from course.exercises.ex04_models_and_jacobians.jxr_jz.task import by_measurement, by_pose

ROWS = 24
CURVED = 0.001
"""Relative to the largest entry. σ of the heading is at most 0.02 rad: a method that uses g itself
differs from its Jacobians by σ² = 0.0004 and is right as well. A million samples differ by more."""


def _believed(rng, n):
    sigmas = np.column_stack([rng.uniform(0.03, 0.15, (n, 2)), rng.uniform(0.005, 0.02, n)])
    noise = np.column_stack([rng.uniform(0.02, 0.1, n), rng.uniform(0.005, 0.02, n)])
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
        "P": diagonal([[0.1, 0.1, 0.02]]),
        "z": np.array([[2.0, 0.0]]),
        "R": diagonal([[0.1, 0.02]]),
    }


def _correlated_noise(rng):
    inputs = _believed(rng, 5)
    sigmas = np.sqrt(np.diagonal(inputs["R"], axis1=1, axis2=2))
    return inputs | {"R": covariances(rng, sigmas)}


def _precise_pose(rng):
    inputs = _believed(rng, 3)
    return inputs | {"P": 1e-4 * inputs["P"]}


def _sharp_sensor(rng):
    inputs = _believed(rng, 3)
    return inputs | {"R": 1e-4 * inputs["R"]}


def _first_order(inputs):
    J_xr, J_z = by_pose(inputs), by_measurement(inputs)
    from_pose = J_xr @ inputs["P"] @ J_xr.swapaxes(1, 2)
    from_noise = J_z @ inputs["R"] @ J_z.swapaxes(1, 2)
    return {
        "P_nn": from_pose + from_noise,
        "P_rn": inputs["P"] @ J_xr.swapaxes(1, 2),
        "part of P_nn from the pose": from_pose,
        "part of P_nn from the noise": from_noise,
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
    return (inputs["z"][:, 0] > 0) & (inputs["P"][:, 2, 2] < 0.0201**2)


TASK = Task(
    id="04-new-landmark",
    title="The covariance of a new landmark",
    call=CALLS["04-new-landmark"],
    inputs=_random,
    shapes=_shapes,
    laws=(
        equals(
            "P_nn",
            2,
            "P_nn contains the effects of both errors, of the pose and of the measurement",
            _picked("P_nn"),
            tolerance=CURVED,
            asks="Which two errors change the position of a new landmark? Which matrix converts "
            "each of them into metres of the landmark?",
            step=_picked("part of P_nn from the pose", "part of P_nn from the noise"),
        ),
        equals(
            "P_rn",
            2,
            "P_rn is the cross-covariance of the pose and the new landmark",
            _picked("P_rn"),
            tolerance=CURVED,
            asks="To first order the error of the landmark is J_xr times the error of the pose, "
            "plus a term that is uncorrelated with the pose. What is the expected value of (error "
            "of the pose)(error of the landmark)ᵀ?",
            step=_picked("J_xr"),
        ),
    ),
    needs=("04-jxr-jz",),
    probes=(
        Probe("a landmark straight ahead of a robot at the origin", _ahead),
        Probe("range and bearing with correlated errors", _correlated_noise),
        Probe("a pose with very small σ", _precise_pose),
        Probe("a measurement with very small σ", _sharp_sensor),
    ),
    may_round=_promised,
    begins=(
        "Which two errors make the position of a new landmark uncertain?",
        "An error e has the covariance P. Which covariance has J e?",
    ),
)
