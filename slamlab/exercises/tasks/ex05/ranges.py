"""Task 05-ranges: beacons tell how far the robot's antenna is, and nothing of the direction."""

import numpy as np

from slamlab.exercises.drives.ex05 import DRIVES
from slamlab.exercises.law import Diagnosis, equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex05.sights import T, beliefs, either_sign, with_wrapped_heading


def heard(rng, rows=6, count=2, far=(2.0, 6.0)):
    """Poses in doubt, with an antenna beside the axle, and the ranges of so many beacons."""
    x, P = beliefs(rng, rows)
    inputs = {"x": x, "P": P, "rs": np.zeros((rows, count)), "beacons": np.zeros((rows, count, 2))}
    inputs |= {"a": either_sign(rng, 0.2, 0.6, (rows, 2)), "sigma": rng.uniform(0.05, 0.15, rows)}
    angle = rng.uniform(-np.pi, np.pi, (rows, 1)) + 2.2 * np.arange(count)
    away = rng.uniform(*far, (rows, count, 1)) * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return _measured(rng, inputs, _antenna(inputs)[0][:, None] + away)


def _measured(rng, inputs, beacons):
    """The same with other beacons, and ranges, never negative, that are off by up to 20 cm."""
    r = np.linalg.norm(beacons - _antenna(inputs)[0][:, None], axis=-1)
    return inputs | {"beacons": beacons, "rs": np.abs(r + either_sign(rng, 0.05, 0.2, r.shape))}


def _on_the_axle(rng):
    inputs = heard(rng, 2, 2)
    inputs["a"][:] = 0
    return _measured(rng, inputs, inputs["beacons"])


def _over_a_beacon(rng):
    inputs = heard(rng, 2, 1)
    return _measured(rng, inputs, inputs["x"][:, None, :2].copy())


def _along_the_axes(rng):
    inputs = heard(rng, 4, 1)
    inputs["x"] = np.array([[1.0, 2, 0], [0, 0, 0], [2, 1, 0], [-1, 0, 0]])
    inputs["a"] = np.array([[0.5, 0], [0, 0.5], [-0.5, 0], [0.25, 0.25]])
    ways = np.array([[3.0, 0], [0, 4], [-2, 0], [0, -3]])
    return _measured(rng, inputs, (_antenna(inputs)[0] + ways)[:, None])


def _heard_twice(rng):
    inputs = heard(rng, 2, 1)
    return _measured(rng, inputs, inputs["beacons"].repeat(2, axis=1))


def _contradictory(rng):
    inputs = heard(rng, 2, 2)
    return inputs | {"rs": inputs["rs"] + [4.0, 0.0]}


def _surveyed(rng):
    return heard(rng, 2, 3) | {"sigma": np.array([0.002, 1.0])}


def _antenna(inputs):
    """Where the antennas are (k, 2), and how fast they move when the robots turn (k, 2)."""
    c, s = np.cos(inputs["x"][:, 2]), np.sin(inputs["x"][:, 2])
    ax, ay = inputs["a"].T
    ahead, left = np.stack([c, s], axis=-1), np.stack([-s, c], axis=-1)
    arm = ahead * ax[:, None] + left * ay[:, None]
    return inputs["x"][:, :2] + arm, np.stack([-arm[:, 1], arm[:, 0]], axis=-1)


def _linearised(inputs):
    """H (k, m, 3) and the innovations (k, m)."""
    at, turning = _antenna(inputs)
    d = at[:, None] - inputs["beacons"]
    r = np.linalg.norm(d, axis=-1)
    toward = d / r[..., None]
    return np.concatenate([toward, toward @ turning[..., None]], axis=-1), inputs["rs"] - r


def want(inputs):
    """Least squares: the pose that fits belief and ranges best, and its information's inverse."""
    H, v = _linearised(inputs)
    weight = T(H) / inputs["sigma"][:, None, None] ** 2
    P = np.linalg.inv(np.linalg.inv(inputs["P"]) + weight @ H)
    return {"x": inputs["x"] + (P @ weight @ v[..., None])[..., 0], "P": P}


def _on_the_way(inputs):
    H, v = _linearised(inputs)
    return {"antenna": _antenna(inputs)[0], "v": v, "H": H}


def _ranges_exact(inputs, outputs):
    """Whether P says that the ranges expected are known exactly; S without noise may be singular,
    so that what comes of it in probes is no fingerprint."""
    H, _ = _linearised(inputs)
    left = np.diagonal(H @ outputs["P"] @ T(H), axis1=1, axis2=2)
    return bool((np.abs(left) < 1e-6 * inputs["sigma"][:, None] ** 2).all())


def _promised(inputs):
    """(k,) whether antennas are not at the very point of a beacon."""
    far = np.linalg.norm(_antenna(inputs)[0][:, None] - inputs["beacons"], axis=-1)
    return (far > 0.005).all(axis=1)


RANGES = Task(
    id="05-ranges",
    title="Beacons that tell only how far they are",
    drive=DRIVES["05-ranges"],
    inputs=heard,
    probes=(
        Probe("no beacon heard", lambda rng: heard(rng, 2, 0)),
        Probe("one beacon", lambda rng: heard(rng, 2, 1)),
        Probe("twelve beacons", lambda rng: heard(rng, 1, 12)),
        Probe("the antenna on the axle", _on_the_axle),
        Probe("the antenna at a beacon's doorstep", lambda rng: heard(rng, 2, 2, (0.03, 0.05))),
        Probe("the robot right over a beacon", _over_a_beacon),
        Probe("beacons along the axes", _along_the_axes),
        Probe("one beacon heard twice", _heard_twice),
        Probe("ranges that contradict", _contradictory),
        Probe("ranges sure and unsure", _surveyed),
    ),
    shapes=lambda inputs: {"x": inputs["x"].shape, "P": inputs["P"].shape},
    parts=with_wrapped_heading("x"),
    laws=(
        equals(
            "mean",
            2.5,
            "the new pose weighs belief and all ranges as least squares does",
            lambda inputs: {"x": want(inputs)["x"]},
            angles={"x": 2},
            asks="Turn the robot on the spot. Does its antenna come nearer to the beacon?",
            step=_on_the_way,
        ),
        equals(
            "covariance",
            2.5,
            "P is the covariance of that estimate: its inverse is P⁻¹ + Hᵀ H / σ²",
            lambda inputs: {"P": want(inputs)["P"]},
            asks="How many rows and columns has H, with m beacons? And S?",
            step=_on_the_way,
        ),
    ),
    diagnoses=(
        Diagnosis(
            "noise-forgotten",
            "S lacks the ranges' own noise: they were taken for exact.",
            _ranges_exact,
        ),
    ),
    rounds=_promised,
)
