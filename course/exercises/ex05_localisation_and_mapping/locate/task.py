"""Task 05-locate: the update of the pose by the measurement of a known landmark."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex05_localisation_and_mapping.calls import CALLS
from course.exercises.ex05_localisation_and_mapping.observations import (
    T,
    beliefs,
    covariances,
    each,
    either_sign,
    with_wrapped_heading,
)
from slamlab import models
from slamlab.geometry import wrap
from slamlab.models import jacobians


def observations(rng, rows=8, far=(1.5, 5), behind=False):
    """Uncertain poses and measurements of a known landmark, beside the robot or right behind it."""
    x, P = beliefs(rng, rows)
    side = np.where(np.arange(rows) % 2, 1.0, -1.0)  # both, whatever is drawn
    away = np.pi - rng.uniform(0.01, 0.03, rows) if behind else rng.uniform(0.4, 2.4, rows)
    z = np.column_stack([rng.uniform(*far, rows), side * away])
    p = models.g(x, z)
    off = either_sign(rng, 0.06, 0.15, (rows, 2))
    off[:, 1] *= np.sign(off[:, 1]) * side if behind else 1  # across ±π
    z = z + off
    z[:, 1] = wrap(z[:, 1])
    sigmas = np.column_stack([rng.uniform(0.05, 0.15, rows), rng.uniform(0.02, 0.05, rows)])
    return {"x": x, "P": P, "z": z, "p": p, "R": covariances(rng, sigmas)}


def _as_expected(rng):
    inputs = observations(rng, 2)
    return inputs | {"z": models.h(inputs["x"], inputs["p"])}


def _far_off(rng):
    inputs = observations(rng, 2)
    inputs["z"][:, 0] += 4  # more than π: ranges are not to be wrapped
    return inputs


def _unrelated(rng):
    inputs = observations(rng, 2)
    return inputs | {"P": inputs["P"] * np.eye(3), "R": inputs["R"] * np.eye(2)}


def _along_the_axes(rng):
    inputs = observations(rng, 4)
    inputs["x"] = np.array([[0.0, 0, 0], [1, 2, 1], [0, 0, -2], [2, 1, 0]])
    ways = np.array([[3.0, 0], [0, 2], [-2, 0], [0, -4]])
    inputs["p"] = inputs["x"][:, :2] + ways
    inputs["z"] = models.h(inputs["x"], inputs["p"]) + 0.1
    inputs["z"][:, 1] = wrap(inputs["z"][:, 1])
    return inputs


def _opposite(rng):
    inputs = observations(rng, 2)
    inputs["z"][:, 1] = wrap(inputs["z"][:, 1] + either_sign(rng, 2.0, 2.9, 2))
    return inputs


def _linearised(inputs):
    """H (k, 2, 3) and the innovation (k, 2)."""
    v = inputs["z"] - models.h(inputs["x"], inputs["p"])
    v[:, 1] = wrap(v[:, 1])
    return each(jacobians.H_robot, inputs["x"], inputs["p"]), v


def want(inputs):
    """Least squares: posterior pose and inverse of its information."""
    H, v = _linearised(inputs)
    weight = T(H) @ np.linalg.inv(inputs["R"])
    P = np.linalg.inv(np.linalg.inv(inputs["P"]) + weight @ H)
    return {"x": inputs["x"] + (P @ weight @ v[..., None])[..., 0], "P": P}


def _on_the_way(inputs):
    H, v = _linearised(inputs)
    return {"v": v, "H": H, "S": H @ inputs["P"] @ T(H) + inputs["R"]}


MEAN = {"angles": {"x": 2}, "step": _on_the_way}


def _promised(inputs):
    away = np.hypot(*(inputs["p"] - inputs["x"][:, :2]).T) > 0.1
    return away & (inputs["z"][:, 0] > 0)


LOCATE = Task(
    id="05-locate",
    title="Update of the pose: one known landmark",
    call=CALLS["05-locate"],
    inputs=observations,
    probes=(
        Probe(
            "a landmark right behind the robot",
            lambda rng: observations(rng, 4, behind=True),
            ("behind", "covariance"),
        ),
        Probe("a bearing to the opposite side", _opposite, ("behind", "covariance")),
        Probe("a measurement equal to the predicted one", _as_expected),
        Probe("a range four metres longer than predicted", _far_off),
        Probe("uncorrelated errors", _unrelated),
        Probe("landmarks along the axes", _along_the_axes),
        Probe("a landmark half a metre away", lambda rng: observations(rng, 2, far=(0.4, 0.6))),
        Probe("a landmark fifty metres away", lambda rng: observations(rng, 2, far=(45, 55))),
    ),
    shapes=lambda inputs: {"x": inputs["x"].shape, "P": inputs["P"].shape},
    parts=with_wrapped_heading("x"),
    laws=(
        equals(
            "mean",
            2,
            "the new pose is the least squares estimate from prior and measurement",
            lambda inputs: {"x": want(inputs)["x"]},
            asks="Which line computes z − h? Which component is an angle? At which pose do you "
            "compute H?",
            **MEAN,
        ),
        equals(
            "behind",
            1,
            "the estimate is also right where bearings jump from π to −π",
            lambda inputs: {"x": want(inputs)["x"]},
            asks="The predicted bearing is 179°, the measured bearing is −179°. How large is the "
            "innovation?",
            main=False,
            **MEAN,
            after=("mean",),
        ),
        equals(
            "covariance",
            2,
            "P is the covariance of that estimate: its inverse is (prior P)⁻¹ + Hᵀ R⁻¹ H",
            lambda inputs: {"P": want(inputs)["P"]},
            asks="Which P enters S, and does S contain R? By which matrix does P decrease?",
            step=_on_the_way,
        ),
    ),
    may_round=_promised,
    references=(Reference("locate", "x P z p R", want, "x P"),),
    begins=(
        "By how much does the measured range differ from the predicted range?",
        "Which part of the innovation does the gain add to x?",
    ),
)
