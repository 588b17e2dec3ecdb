"""Task 05-ranges: beacons measure ranges to the robot's antenna, without bearings."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, equals
from classroom.exercises.task import Probe, Task
from course.exercises.ex05_localisation_and_mapping.calls import CALLS
from course.exercises.ex05_localisation_and_mapping.observations import (
    T,
    beliefs,
    either_sign,
    with_wrapped_heading,
)
from course.exercises.surveyed import (
    EXACT,
    NAME,
    corrections,
    differences,
    surveyed,
    vague,
)


def ranges_to_beacons(rng, rows=6, count=2, far=(2.0, 6.0)):
    """Uncertain poses with an antenna off the axle, and ranges of ``count`` beacons."""
    x, P = beliefs(rng, rows)
    inputs = {"x": x, "P": P, "rs": np.zeros((rows, count)), "beacons": np.zeros((rows, count, 2))}
    inputs |= {"a": either_sign(rng, 0.2, 0.6, (rows, 2)), "sigma": rng.uniform(0.05, 0.15, rows)}
    angle = rng.uniform(-np.pi, np.pi, (rows, 1)) + 2.2 * np.arange(count)
    away = rng.uniform(*far, (rows, count, 1)) * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return _measured(rng, inputs, _antenna(inputs)[0][:, None] + away)


def _measured(rng, inputs, beacons, off=(0.05, 0.2)):
    r = np.linalg.norm(beacons - _antenna(inputs)[0][:, None], axis=-1)
    return inputs | {"beacons": beacons, "rs": np.abs(r + either_sign(rng, *off, r.shape))}


def _on_the_axle(rng):
    inputs = ranges_to_beacons(rng, 2, 2)
    inputs["a"][:] = 0
    return _measured(rng, inputs, inputs["beacons"])


def _over_a_beacon(rng):
    inputs = ranges_to_beacons(rng, 2, 1)
    return _measured(rng, inputs, inputs["x"][:, None, :2].copy())


def _along_the_axes(rng):
    inputs = ranges_to_beacons(rng, 4, 1)
    inputs["x"] = np.array([[1.0, 2, 0], [0, 0, 0], [2, 1, 0], [-1, 0, 0]])
    inputs["a"] = np.array([[0.5, 0], [0, 0.5], [-0.5, 0], [0.25, 0.25]])
    ways = np.array([[3.0, 0], [0, 4], [-2, 0], [0, -3]])
    return _measured(rng, inputs, (_antenna(inputs)[0] + ways)[:, None])


def _heard_twice(rng):
    inputs = ranges_to_beacons(rng, 2, 1)
    return _measured(rng, inputs, inputs["beacons"].repeat(2, axis=1))


def _contradictory(rng):
    inputs = ranges_to_beacons(rng, 2, 2)
    return inputs | {"rs": inputs["rs"] + [4.0, 0.0]}


def _surveyed(rng):
    return ranges_to_beacons(rng, 2, 3) | {"sigma": np.array([0.002, 1.0])}


def _far(rng):
    inputs = vague(surveyed(ranges_to_beacons(rng, 6, 3), "x", "beacons"), ["P"], ["sigma"])
    return _measured(rng, inputs, inputs["beacons"], (5, 20))  # so that rounding is small beside it


def _parts(inputs, outputs):
    moved = outputs["x"] - inputs["x"] * [1, 1, 0]
    return with_wrapped_heading("x")(inputs, outputs | {"x": moved})


def _antenna(inputs):
    """Antennas (k, 2), and their derivative with respect to the heading (k, 2)."""
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
    """Least squares: posterior pose and inverse of its information."""
    H, v = _linearised(inputs)
    weight = T(H) / inputs["sigma"][:, None, None] ** 2
    P = np.linalg.inv(np.linalg.inv(inputs["P"]) + weight @ H)
    return {"x": inputs["x"] + (P @ weight @ v[..., None])[..., 0], "P": P}


def _on_the_way(inputs):
    H, v = _linearised(inputs)
    S = H @ inputs["P"] @ T(H) + inputs["sigma"][:, None, None] ** 2 * np.eye(v.shape[1])
    return {"antenna": _antenna(inputs)[0], "v": v, "H": H, "S": S}


def _ranges_exact(inputs, outputs, n=0):
    """Whether P makes the expected ranges exact; with n = 1 their differences."""
    # S without noise may be singular, so that probes show no typical result
    H = np.diff(_linearised(inputs)[0], n, axis=1)
    left = np.diagonal(H @ outputs["P"] @ T(H), axis1=1, axis2=2)
    return bool((np.abs(left) < 1e-6 * inputs["sigma"][:, None] ** 2).all())


def _promised(inputs):
    far = np.linalg.norm(_antenna(inputs)[0][:, None] - inputs["beacons"], axis=-1)
    return (far > 0.005).all(axis=1)


COVARIANCE = equals(
    "covariance",
    2.5,
    "P is the covariance of that estimate: its inverse is (prior P)⁻¹ + Hᵀ H / σ²",
    lambda inputs: {"P": want(inputs)["P"]},
    tolerance=EXACT,
    asks="Which shape has S with m beacons, and which entries of S contain sigma?",
    step=_on_the_way,
)

RANGES = Task(
    id="05-ranges",
    title="Localisation from ranges only",
    call=CALLS["05-ranges"],
    inputs=ranges_to_beacons,
    probes=(
        Probe("no beacon", lambda rng: ranges_to_beacons(rng, 2, 0)),
        Probe("one beacon", lambda rng: ranges_to_beacons(rng, 2, 1)),
        Probe("twelve beacons", lambda rng: ranges_to_beacons(rng, 1, 12)),
        Probe("the antenna at the point of the pose", _on_the_axle),
        Probe(
            "the antenna centimetres from a beacon",
            lambda rng: ranges_to_beacons(rng, 2, 2, (0.03, 0.05)),
        ),
        Probe("a beacon at the position of the robot", _over_a_beacon),
        Probe("beacons along the axes", _along_the_axes),
        Probe("one beacon measured twice", _heard_twice),
        Probe("contradictory ranges", _contradictory),
        Probe("a small and a large sigma", _surveyed),
        Probe(NAME, _far),
    ),
    shapes=lambda inputs: {"x": inputs["x"].shape, "P": inputs["P"].shape},
    parts=_parts,
    laws=(
        corrections(
            "mean",
            2.5,
            "the new pose is the least squares estimate from prior and all ranges",
            want,
            angles={"x": 2},
            asks="At which point does the predicted range of a beacon begin? Which errors does an "
            "innovation contain, and which weight does each range have?",
            step=_on_the_way,
        ),
        COVARIANCE,
    ),
    diagnoses=(
        Diagnosis(
            "noise-forgotten",
            "The noise of the ranges is missing in S, as if the ranges were exact.",
            _ranges_exact,
            asks="Which variance does the innovation of a range have if P is zero? Which one "
            "does your S have?",
        ),
        Diagnosis(
            "noise-in-all-of-S",
            "You add σ² to every entry of S, as if the errors of all ranges were equal. The errors "
            "are independent, so they are uncorrelated.",
            lambda inputs, outputs: _ranges_exact(inputs, outputs, n=1),
            asks="Which covariance does the noise of two different ranges have in your S?",
        ),
        differences(COVARIANCE.want, law=COVARIANCE),
    ),
    may_round=_promised,
    begins=(
        "Where is the antenna in the world frame?",
        "How does the distance from the antenna to a beacon change if the robot moves "
        "by one centimetre along x?",
    ),
)
