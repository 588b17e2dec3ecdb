"""Task 09-update: a wall is measured again."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex06_ekf_slam.beliefs import T, covariances, either_sign
from course.exercises.ex09_slam_with_walls.calls import CALLS
from course.exercises.surveyed import EXACT, FAR, FARTHEST, corrections, differences, vague
from slamlab import models
from slamlab.geometry import wrap
from slamlab.models import jacobians

ANGLES = slice(2, None, 2)  # of a state: θ, and each wall's α


def beliefs(rng, rows, walls, theta=(0.3, 2.8)):
    """Prior states x (rows, n) of a robot with walls around it, and a full P."""
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
    """Priors, and a wall that is measured again: "beside" the robot, "behind" it (α' jumps) or
    "turned" (the robot heads in the direction of −x, so that α − θ is near ±2π).
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
        aside = np.sign(bearing)
        if where == "beside":  # independent of the sign of z[1]
            aside = 1.0 if k // 4 % 2 else -1.0
        off = either_sign(rng, 0.1, 0.2), aside * rng.uniform(0.05, 0.1)
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
    inputs = sights(rng, 4, 2)
    for x, z, j in zip(inputs["x"], inputs["z"], inputs["j"], strict=True):
        ahead = models.h_line(x[:3], x[3 + 2 * j : 5 + 2 * j])[0]
        x[3 + 2 * j] -= ahead + rng.uniform(0.1, 0.2)  # now the predicted ρ' is negative
        z[0] = rng.uniform(0.05, 0.1)
    return inputs


def _uncorrelated(rng):
    inputs = sights(rng, 2, 2)
    return inputs | {"P": inputs["P"] * np.eye(7), "R": inputs["R"] * np.eye(2)}


def _innovation(inputs):
    """H (k, 2, n) and the innovation (k, 2), its angle wrapped."""
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
    """Least squares: posterior x and inverse of its information."""
    H, v = _innovation(inputs)
    weight = np.linalg.inv(inputs["R"])
    P = np.linalg.inv(np.linalg.inv(inputs["P"]) + T(H) @ weight @ H)
    return {"x": inputs["x"] + (P @ T(H) @ weight @ v[..., None])[..., 0], "P": P}


def _on_the_way(inputs):
    H, v = _innovation(inputs)
    return {"v": v, "H": H, "S": H @ inputs["P"] @ T(H) + inputs["R"]}


def carried_off(inputs, far=3 * FAR):
    """Turn robot and walls so that the normal of wall j is the x-axis, and move them along it."""
    x = inputs["x"].copy()
    along = x[np.arange(len(x)), 4 + 2 * inputs["j"]]
    c, s = np.cos(along), np.sin(along)
    x[:, :2] = np.column_stack([far + c * x[:, 0] + s * x[:, 1], c * x[:, 1] - s * x[:, 0]])
    x[:, ANGLES] = wrap(x[:, ANGLES] - along[:, None])
    x[:, 3::2] += far * np.cos(x[:, 4::2])
    return inputs | {"x": x}


def _parts(inputs, outputs):
    x = outputs["x"] - inputs["x"] * (np.abs(inputs["x"]) > FAR / 1e3)
    x[:, ANGLES] = wrap(x[:, ANGLES])
    return {"x": x, "P": outputs["P"]}


FAR_OFF = "a robot 3000 km from the origin"
FARTHER = "a robot a million kilometres from the origin"
MEAN = {"angles": {"x": ANGLES}, "step": _on_the_way}
WRAPPED = "wrapped", "P"

UPDATE = Task(
    id="09-update",
    title="Update: a known wall",
    call=CALLS["09-update"],
    inputs=sights,
    probes=(
        Probe("a wall right behind the robot", lambda rng: sights(rng, 4, 3, "behind"), WRAPPED),
        Probe(
            "a robot that heads in the direction of −x",
            lambda rng: sights(rng, 4, 2, "turned"),
            WRAPPED,
        ),
        Probe("a map of one wall", lambda rng: sights(rng, 2, 1)),
        Probe("a map of six walls", lambda rng: sights(rng, 6, 6)),
        Probe("a measurement equal to the predicted one", _as_expected),
        Probe("a distance four metres longer than predicted", _far_off),
        Probe("an estimated position beyond the wall", _on_its_other_side),
        Probe("uncorrelated errors", _uncorrelated),
        Probe(
            FARTHER,
            lambda rng: vague(carried_off(sights(rng, 6), FARTHEST), ["P", "R"]),
            ("P",),
        ),
    ),
    diagnoses=(differences(lambda inputs: {"P": want(inputs)["P"]}, FARTHER),),
    shapes=lambda inputs: {"x": inputs["x"].shape, "P": inputs["P"].shape},
    parts=_parts,
    laws=(
        corrections(
            "mean",
            2,
            "x is the least squares estimate from the prior and the measurement, with h "
            "linearised at the prior",
            want,
            asks="A wall is rotated a little about the world's origin. Does its distance from the "
            "robot change? Which entry of H is this?",
            **MEAN,
        ),
        corrections(
            "wrapped",
            1,
            "x is this estimate, too, where α' or α − θ jumps by 2π",
            want,
            asks="The predicted α' is 179°, the measured one −179°: which is the innovation?",
            main=False,
            **MEAN,
            after=("mean",),
        ),
        equals(
            "P",
            2,
            "P is the covariance of this estimate: its inverse is P⁻¹ + Hᵀ R⁻¹ H",
            lambda inputs: {"P": want(inputs)["P"]},
            tolerance=EXACT,
            asks="Is any block of K S Kᵀ zero? What follows for walls that were not measured?",
            step=_on_the_way,
        ),
    ),
    references=(Reference("update", "x P z j R", want, "x P"),),
    begins=(
        "The robot is at (1, 0) with θ = 0, and a wall has ρ = 3 m and α = 0. Which "
        "measurement do you predict?",
        "Which entries of the state does this prediction depend on, and how?",
    ),
)
