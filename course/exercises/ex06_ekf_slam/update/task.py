"""Task 06-update: a landmark is measured again."""

import numpy as np

from classroom.exercises.correctness_laws import equals, once
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex06_ekf_slam.beliefs import T, beliefs, covariances, either_sign
from course.exercises.ex06_ekf_slam.calls import CALLS
from slamlab import models
from slamlab.geometry import wrap
from slamlab.models import jacobians


def observations(rng, rows=8, landmarks=3, behind=False):
    """Beliefs and measurements of a known landmark, beside the robot or right behind it."""
    x, P = beliefs(rng, rows, landmarks)
    j, R = np.arange(rows) % landmarks, covariances(rng, rng.uniform(0.03, 0.06, (rows, 2)))
    side = np.where(np.arange(rows) % 2, 1.0, -1.0)  # both, whatever is drawn
    z = np.empty((rows, 2))
    for k in range(rows):
        r = rng.uniform(2, 5)
        bearing = side[k] * (np.pi - rng.uniform(0.01, 0.04) if behind else rng.uniform(0.3, 2.2))
        x[k, 3 + 2 * j[k] : 5 + 2 * j[k]] = models.g(x[k], np.array([r, bearing]))
        z[k] = r + either_sign(rng, 0.1, 0.2), wrap(bearing + side[k] * rng.uniform(0.06, 0.1))
    return {"x": x, "P": P, "z": z, "j": j, "R": R}


def _as_expected(rng):
    inputs = observations(rng, 2, 2)
    _, inputs["z"] = _linearised(inputs)
    return inputs


def _far_off(rng):
    inputs = observations(rng, 2, 2)
    inputs["z"][:, 0] += 4  # more than π: ranges are not to be wrapped
    inputs["z"][:, 1] -= 2 * np.sign(inputs["z"][:, 1])  # more than π/2, but not beyond ±π
    return inputs


def _uncorrelated(rng):
    inputs = observations(rng, 2, 2)
    return inputs | {"P": inputs["P"] * np.eye(7), "R": inputs["R"] * np.eye(2)}


def _linearised(inputs):
    """H (k, 2, n) and the expected measurement (k, 2)."""
    rows = range(len(inputs["x"]))
    H, expected = np.zeros((len(rows), 2, inputs["x"].shape[1])), np.zeros((len(rows), 2))
    for k in rows:
        x, at = inputs["x"][k], 3 + 2 * inputs["j"][k]
        H[k, :, :3] = jacobians.H_robot(x[:3], x[at : at + 2])
        H[k, :, at : at + 2] = jacobians.H_landmark(x[:3], x[at : at + 2])
        expected[k] = models.h(x[:3], x[at : at + 2])
    return H, expected


def _innovation(inputs):
    H, expected = _linearised(inputs)
    v = inputs["z"] - expected
    v[:, 1] = wrap(v[:, 1])
    return H, v


@once
def want(inputs):
    """Least squares: posterior x and inverse of its information."""
    H, v = _innovation(inputs)
    weight = np.linalg.inv(inputs["R"])
    P = np.linalg.inv(np.linalg.inv(inputs["P"]) + T(H) @ weight @ H)
    return {"x": inputs["x"] + (P @ T(H) @ weight @ v[..., None])[..., 0], "P": P}


def _on_the_way(inputs):
    H, v = _innovation(inputs)
    return {"v": v, "H": H, "S": H @ inputs["P"] @ T(H) + inputs["R"]}


def _parts(inputs, outputs):
    x = outputs["x"].copy()
    x[:, 2] = wrap(x[:, 2])
    return {"x": x, "P": outputs["P"]}


MEAN = {"angles": {"x": 2}, "step": _on_the_way}

UPDATE = Task(
    id="06-update",
    title="Update: a known landmark",
    call=CALLS["06-update"],
    inputs=observations,
    probes=(
        Probe(
            "a landmark right behind the robot",
            lambda rng: observations(rng, 4, 3, behind=True),
            ("wrapped", "P"),
        ),
        Probe("a map of one landmark", lambda rng: observations(rng, 2, 1)),
        Probe("a map of six landmarks", lambda rng: observations(rng, 6, 6)),
        Probe("a measurement equal to the predicted one", _as_expected),
        Probe("a measurement far from the predicted one", _far_off),
        Probe("uncorrelated errors", _uncorrelated),
    ),
    shapes=lambda inputs: {"x": inputs["x"].shape, "P": inputs["P"].shape},
    parts=_parts,
    laws=(
        equals(
            "mean",
            2,
            "x is the least squares estimate from the prior and the measurement",
            lambda inputs: {"x": want(inputs)["x"]},
            asks="At which state must H and the predicted measurement be taken? Which entries of x "
            "does one measurement change?",
            **MEAN,
        ),
        equals(
            "wrapped",
            1,
            "x is also right for landmarks behind the robot, where bearings jump from π to −π",
            lambda inputs: {"x": want(inputs)["x"]},
            asks="The predicted bearing is 179°, the measured bearing is −179°. How large is the "
            "innovation?",
            main=False,
            **MEAN,
            after=("mean",),
        ),
        equals(
            "P",
            2,
            "P is the covariance of that estimate: its inverse is (prior P)⁻¹ + Hᵀ R⁻¹ H",
            lambda inputs: {"P": want(inputs)["P"]},
            asks="At which state must H be taken, and how often may the measurement enter P? What "
            "does it change for landmarks that were not measured?",
            step=_on_the_way,
        ),
    ),
    begins=(
        "Where in x are the two coordinates of landmark j?",
        "How does the measurement differ from the predicted one, and which of its components is an "
        "angle?",
        "Which matrices of (06.9) are given, and in which order can you compute the others?",
    ),
    references=(Reference("update", "x P z j R", want, "x P"),),
)
