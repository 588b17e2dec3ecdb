"""Task 06-augment: state augmentation by a new landmark."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex06_ekf_slam.beliefs import beliefs, covariances, either_sign, moments
from course.exercises.ex06_ekf_slam.calls import CALLS
from slamlab import models
from slamlab.models import jacobians

OLD, NEW = np.s_[:-2], np.s_[-2:]


def observations(rng, rows=8, landmarks=2):
    """Beliefs, and the measurement of a new landmark with its R."""
    x, P = beliefs(rng, rows, landmarks)
    z = np.column_stack([rng.uniform(2, 6, rows), either_sign(rng, 0.4, 2.6, rows)])
    sigma = np.column_stack([rng.uniform(0.05, 0.15, rows), rng.uniform(0.02, 0.04, rows)])
    return {"x": x, "P": P, "z": z, "R": covariances(rng, sigma)}


def _exactly_known(rng):
    inputs = observations(rng, 2, 1)
    return inputs | {"P": 0 * inputs["P"]}


def _straight_ahead(rng):
    inputs = observations(rng, 2, 1)
    inputs["x"][:, 2], inputs["z"][:, 1] = [0, np.pi / 2], 0
    return inputs | {"R": inputs["R"] * np.eye(2)}


def _place(states, z):
    p = models.g(states[:3].T, z.T)
    return np.vstack([states + 0 * z[:1], p.T])


def want(inputs):
    """The augmented x (k, n + 2) and P (k, n + 2, n + 2)."""
    found = [moments(_place, (x, z), P, R) for x, P, z, R in zip(*inputs.values(), strict=True)]
    return {"x": np.array([x for x, _ in found]), "P": np.array([P for _, P in found])}


def _jacobians(inputs):
    pairs = list(zip(inputs["x"], inputs["z"], strict=True))
    return {
        "J_xr": np.array([jacobians.J_xr(x, z) for x, z in pairs]),
        "J_z": np.array([jacobians.J_z(x, z) for x, z in pairs]),
    }


def _direction(inputs):
    angle = inputs["x"][:, 2] + inputs["z"][:, 1]
    return {"direction from the robot to the landmark, in the world frame": angle}


def _parts(inputs, outputs):
    x, P = outputs["x"], outputs["P"]
    return {
        "x": x,
        "old": P[:, OLD, OLD],
        "P_nn": P[:, NEW, NEW],
        "rows": P[:, NEW, OLD],
        "columns": P[:, OLD, NEW],
    }


AUGMENT = Task(
    id="06-augment",
    title="State augmentation: a new landmark",
    call=CALLS["06-augment"],
    inputs=observations,
    probes=(
        Probe("an empty map", lambda rng: observations(rng, 2, 0)),
        Probe("a map of six landmarks", lambda rng: observations(rng, 1, 6)),
        Probe("an exactly known pose and map", _exactly_known),
        Probe("a landmark straight ahead", _straight_ahead),
    ),
    shapes=lambda inputs: {
        "x": (len(inputs["x"]), inputs["x"].shape[1] + 2),
        "P": (len(inputs["x"]), inputs["x"].shape[1] + 2, inputs["x"].shape[1] + 2),
    },
    parts=_parts,
    laws=(
        equals(
            "old",
            1,
            "the old entries of x and P are unchanged",
            want,
            {"x": OLD, "P": (OLD, OLD)},
            angles={"x": 2},
            asks="The new position is g(x, z). Which two errors does it contain? Does the "
            "measurement change the old estimates?",
            step="Print x and P before and after the call. Compare the first n entries of x and "
            "the first n rows and columns of P.",
        ),
        equals(
            "place",
            1,
            "the position of the new landmark is g of the pose and z",
            want,
            {"x": NEW},
            asks="Which entries of x are the pose, and in which frame is z measured?",
            step=_direction,
        ),
        equals(
            "P_nn",
            1,
            "P_nn is the sum of the covariances of the pose and of z, each propagated by its "
            "Jacobian",
            want,
            {"P": (NEW, NEW)},
            asks="Which Jacobian propagates the error of the pose, and which propagates the error "
            "of z?",
            step=_jacobians,
        ),
        equals(
            "P_nr",
            1,
            "P_nr and its transpose are the cross-covariance with the pose",
            want,
            {"P": [(NEW, np.s_[:3]), (np.s_[:3], NEW)]},
            asks="By how much does the new position change when the pose changes a little?",
            step=_jacobians,
        ),
        equals(
            "P_ni",
            1,
            "P_ni and its transpose are the cross-covariance with the old landmarks",
            want,
            {"P": [(NEW, np.s_[3:-2]), (np.s_[3:-2], NEW)]},
            asks="The errors of the old landmarks and of the pose are correlated. Which Jacobian "
            "relates the error of the pose to the error of the new landmark?",
            step=_jacobians,
        ),
    ),
    begins=(
        "The new position is g(x, z). Which two uncertain quantities enter g?",
        "Which Jacobian converts an error of the pose into an error of the position, and which one "
        "converts an error of z?",
        "Write P as blocks: old with old, new with old, new with new. Which of them do you know?",
    ),
    references=(Reference("augment", "x P z R", want, "x P"),),
)
