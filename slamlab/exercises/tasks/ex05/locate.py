"""Task 05-locate: a landmark whose place is known is seen, and the pose is corrected."""

import numpy as np

from slamlab import models
from slamlab.exercises.drives.ex05 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex05.sights import (
    T,
    beliefs,
    covariances,
    each,
    either_sign,
    with_wrapped_heading,
)
from slamlab.geometry import wrap
from slamlab.models import jacobians


def sights(rng, rows=8, far=(1.5, 5), behind=False):
    """Poses in doubt, and how a known landmark is seen: beside the robot, or right behind it."""
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
    inputs = sights(rng, 2)
    return inputs | {"z": models.h(inputs["x"], inputs["p"])}


def _far_off(rng):
    inputs = sights(rng, 2)
    inputs["z"][:, 0] += 4  # more than π: ranges are not to be wrapped
    return inputs


def _unrelated(rng):
    inputs = sights(rng, 2)
    return inputs | {"P": inputs["P"] * np.eye(3), "R": inputs["R"] * np.eye(2)}


def _along_the_axes(rng):
    inputs = sights(rng, 4)
    inputs["x"] = np.array([[0.0, 0, 0], [1, 2, 1], [0, 0, -2], [2, 1, 0]])
    ways = np.array([[3.0, 0], [0, 2], [-2, 0], [0, -4]])
    inputs["p"] = inputs["x"][:, :2] + ways
    inputs["z"] = models.h(inputs["x"], inputs["p"]) + 0.1
    inputs["z"][:, 1] = wrap(inputs["z"][:, 1])
    return inputs


def _opposite(rng):
    inputs = sights(rng, 2)
    inputs["z"][:, 1] = wrap(inputs["z"][:, 1] + either_sign(rng, 2.0, 2.9, 2))
    return inputs


def _linearised(inputs):
    """H (k, 2, 3) and the innovation (k, 2)."""
    v = inputs["z"] - models.h(inputs["x"], inputs["p"])
    v[:, 1] = wrap(v[:, 1])
    return each(jacobians.H_robot, inputs["x"], inputs["p"]), v


def want(inputs):
    """Least squares: the pose that fits belief and sight best, and its information's inverse."""
    H, v = _linearised(inputs)
    weight = T(H) @ np.linalg.inv(inputs["R"])
    P = np.linalg.inv(np.linalg.inv(inputs["P"]) + weight @ H)
    return {"x": inputs["x"] + (P @ weight @ v[..., None])[..., 0], "P": P}


def _on_the_way(inputs):
    H, v = _linearised(inputs)
    return {"v": v, "H": H, "S": H @ inputs["P"] @ T(H) + inputs["R"]}


MEAN = {"angles": {"x": 2}, "step": _on_the_way}


def _promised(inputs):
    """(n,) whether the landmark is not under the robot."""
    away = np.hypot(*(inputs["p"] - inputs["x"][:, :2]).T) > 0.1
    return away & (inputs["z"][:, 0] > 0)


LOCATE = Task(
    id="05-locate",
    title="Where am I: one known landmark",
    drive=DRIVES["05-locate"],
    inputs=sights,
    probes=(
        Probe(
            "a landmark right behind the robot",
            lambda rng: sights(rng, 4, behind=True),
            ("behind", "covariance"),
        ),
        Probe("a bearing of the other side", _opposite, ("behind", "covariance")),
        Probe("a sight that is just as expected", _as_expected),
        Probe("a landmark four metres farther off than expected", _far_off),
        Probe("errors that share nothing", _unrelated),
        Probe("landmarks along the axes", _along_the_axes),
        Probe("a landmark half a metre away", lambda rng: sights(rng, 2, far=(0.4, 0.6))),
        Probe("a landmark fifty metres away", lambda rng: sights(rng, 2, far=(45, 55))),
    ),
    shapes=lambda inputs: {"x": inputs["x"].shape, "P": inputs["P"].shape},
    parts=with_wrapped_heading("x"),
    laws=(
        equals(
            "mean",
            2,
            "the new pose weighs belief and sight as least squares does",
            lambda inputs: {"x": want(inputs)["x"]},
            asks="If the sensor were perfect, where would the pose go? And if it were useless?",
            **MEAN,
        ),
        equals(
            "behind",
            1,
            "so it does where bearings jump from π to −π",
            lambda inputs: {"x": want(inputs)["x"]},
            asks="Expected at 179°, seen at −179°: by how much is the landmark off?",
            main=False,
            **MEAN,
            after=("mean",),
        ),
        equals(
            "covariance",
            2,
            "P is the covariance of that estimate: its inverse is P⁻¹ + Hᵀ R⁻¹ H",
            lambda inputs: {"P": want(inputs)["P"]},
            asks="By how much does doubt shrink along the line of sight? And across it?",
            step=_on_the_way,
        ),
    ),
    rounds=_promised,
)
