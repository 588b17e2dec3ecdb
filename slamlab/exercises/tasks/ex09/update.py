"""Task 09-update: a wall is seen again, and everyone learns."""

import numpy as np

from slamlab import models
from slamlab.exercises.drives.ex09 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex06.beliefs import T, covariances, either_sign
from slamlab.geometry import wrap
from slamlab.models import jacobians

ANGLES = slice(2, None, 2)  # of a state: θ, and each wall's α


def beliefs(rng, rows, walls, theta=(0.3, 2.8)):
    """States x (rows, n) of a robot with walls round it, and P, nothing uncorrelated."""
    x = np.empty((rows, 3 + 2 * walls))
    x[:, :2] = either_sign(rng, 1, 4, (rows, 2))
    x[:, 2] = np.where(np.arange(rows) % 2, 1, -1) * rng.uniform(*theta, rows)  # both signs
    seen = np.stack(
        [rng.uniform(1, 4, (rows, walls)), either_sign(rng, 0.3, 2.8, (rows, walls))], axis=-1
    )
    for pose, around in zip(x, seen, strict=True):
        pose[3:] = models.g_line(pose[:3], around).ravel()
    sigma = rng.uniform(0.05, 0.15, x.shape)
    sigma[:, ANGLES] = rng.uniform(0.03, 0.06, sigma[:, ANGLES].shape)
    return x, covariances(rng, sigma)


def sights(rng, rows=9, walls=3, where="beside"):
    """Beliefs, a wall that is seen again, and how.

    Parameters
    ----------
    rng : numpy.random.Generator
    rows, walls : int
    where : "beside" the robot; "behind" it, where α' jumps; or "turned": it is ahead of a robot
        that heads for −x, so that α − θ is near ±2π
    """
    turned = where == "turned"
    x, P = beliefs(rng, rows, walls, (3.05, 3.1) if turned else (0.3, 2.8))
    j, R = np.arange(rows) % walls, covariances(rng, rng.uniform(0.03, 0.06, (rows, 2)))
    side = np.where(np.arange(rows) // 2 % 2, 1.0, -1.0)
    z = np.empty((rows, 2))
    for k in range(rows):
        if where == "behind":
            bearing = side[k] * (np.pi - rng.uniform(0.01, 0.03))
        else:
            bearing = (np.sign(x[k, 2]) if turned else side[k]) * rng.uniform(0.3, 2.4)
        seen = np.array([rng.uniform(1, 4), bearing])
        x[k, 3 + 2 * j[k] : 5 + 2 * j[k]] = models.g_line(x[k, :3], seen)
        off = either_sign(rng, 0.1, 0.2), np.sign(bearing) * rng.uniform(0.05, 0.1)
        z[k] = seen + np.array(off)
    z[:, 1] = wrap(z[:, 1])
    return {"x": x, "P": P, "z": z, "j": j, "R": R}


def _as_expected(rng):
    inputs = sights(rng, 2, 2)
    return inputs | {"z": inputs["z"] - _innovation(inputs)[1]}


def _far_off(rng):
    inputs = sights(rng, 2, 2)
    return inputs | {"z": inputs["z"] + [4.0, 0.0]}  # more than π: ρ' is not to be wrapped


def _on_its_other_side(rng):
    """Walls a few centimetres ahead, which the robot is believed to have driven through."""
    inputs = sights(rng, 4, 2)
    for x, z, j in zip(inputs["x"], inputs["z"], inputs["j"], strict=True):
        ahead = models.h_line(x[:3], x[3 + 2 * j : 5 + 2 * j])[0]
        x[3 + 2 * j] -= ahead + rng.uniform(0.1, 0.2)  # now ρ' is expected below zero
        z[0] = rng.uniform(0.05, 0.1)
    return inputs


def _uncorrelated(rng):
    inputs = sights(rng, 2, 2)
    return inputs | {"P": inputs["P"] * np.eye(7), "R": inputs["R"] * np.eye(2)}


def _innovation(inputs):
    """H (k, 2, n) of the wall seen, and measured minus expected (k, 2), wrapped."""
    H = np.zeros((len(inputs["x"]), 2, inputs["x"].shape[1]))
    v = inputs["z"].copy()
    for k, (x, j) in enumerate(zip(inputs["x"], inputs["j"], strict=True)):
        at = slice(3 + 2 * j, 5 + 2 * j)
        H[k, :, :3] = jacobians.H_robot_line(x[:3], x[at])
        H[k, :, at] = jacobians.H_line(x[:3], x[at])
        v[k] -= models.h_line(x[:3], x[at])
    v[:, 1] = wrap(v[:, 1])
    return H, v


def want(inputs):
    """Least squares: the x that fits belief and sight best, and the inverse of its information."""
    H, v = _innovation(inputs)
    weight = np.linalg.inv(inputs["R"])
    P = np.linalg.inv(np.linalg.inv(inputs["P"]) + T(H) @ weight @ H)
    return {"x": inputs["x"] + (P @ T(H) @ weight @ v[..., None])[..., 0], "P": P}


def _mean(inputs):
    return {"x": want(inputs)["x"]}


def _on_the_way(inputs):
    H, v = _innovation(inputs)
    return {"v": v, "H": H, "S": H @ inputs["P"] @ T(H) + inputs["R"]}


def _parts(inputs, outputs):
    x = outputs["x"].copy()
    x[:, ANGLES] = wrap(x[:, ANGLES])
    return {"x": x, "P": outputs["P"]}


MEAN = {"angles": {"x": ANGLES}, "step": _on_the_way}
WRAPPED = "wrapped", "P"

UPDATE = Task(
    id="09-update",
    title="Update: a wall is seen again",
    drive=DRIVES["09-update"],
    inputs=sights,
    probes=(
        Probe("a wall right behind the robot", lambda rng: sights(rng, 4, 3, "behind"), WRAPPED),
        Probe("a robot that heads for −x", lambda rng: sights(rng, 4, 2, "turned"), WRAPPED),
        Probe("a map of one wall", lambda rng: sights(rng, 2, 1)),
        Probe("a map of six walls", lambda rng: sights(rng, 6, 6)),
        Probe("a sight that is just as expected", _as_expected),
        Probe("a wall four metres farther off than expected", _far_off),
        Probe("a wall that the robot is believed to have passed", _on_its_other_side),
        Probe("errors that share nothing", _uncorrelated),
    ),
    shapes=lambda inputs: {"x": inputs["x"].shape, "P": inputs["P"].shape},
    parts=_parts,
    laws=(
        equals(
            "mean",
            2,
            "x fits belief and sight best: no other state has a smaller sum of squares, with h "
            "taken as straight near the old x",
            _mean,
            asks="Turn a wall a little about the world's origin: does its distance from the robot "
            "change? Which entry of H says so?",
            **MEAN,
        ),
        equals(
            "wrapped",
            1,
            "the same where α' or α − θ jumps by 2π",
            _mean,
            asks="Expected at 179°, seen at −179°: by how much is the normal off?",
            main=False,
            **MEAN,
            after=("mean",),
        ),
        equals(
            "P",
            2,
            "P holds what belief and sight know together: its inverse is P⁻¹ + Hᵀ R⁻¹ H",
            lambda inputs: {"P": want(inputs)["P"]},
            asks="Which blocks of K S Kᵀ are zero, and what has that to say of walls not seen?",
            step=_on_the_way,
        ),
    ),
)
