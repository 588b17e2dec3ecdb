"""Task 07-bound: the covariance of the map that no number of measurements removes."""

from dataclasses import replace

import numpy as np

from classroom.exercises.correctness_laws import equals, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex07_correlations.beliefs import T, covariances
from course.exercises.ex07_correlations.calls import CALLS
from course.exercises.surveyed import EXACT, FARTHEST, differences, rounded


def starts(rng, rows=8, landmarks=3, sigma=(0.05, 0.4), share=(0.02, 0.2)):
    """Poses at the start with their covariances, landmarks, and σ of their measurements."""
    x = np.column_stack([rng.uniform(-5, 5, (rows, 2)), rng.uniform(-np.pi, np.pi, rows)])
    sigmas = np.column_stack([rng.uniform(0.1, 0.3, (rows, 2)), rng.uniform(0.03, 0.1, rows)])
    away = rng.uniform(-np.pi, np.pi, (rows, landmarks))
    far = rng.uniform(1, 6, (rows, landmarks, 1))
    return {
        "x": x,
        "P": covariances(rng, sigmas),
        "p": x[:, None, :2] + far * np.stack([np.cos(away), np.sin(away)], axis=-1),
        "sigma": rng.uniform(*sigma, (rows, landmarks)),
        "share": rng.uniform(*share, rows),
    }


def _at_the_robot(rng):
    found = starts(rng, 2)
    found["p"][:, 0] = found["x"][:, :2]
    return found


def _independent(rng):
    found = starts(rng, 2)
    return found | {"P": found["P"] * np.eye(3)}


def _at_most(rng):
    """Numbers whose quotients are exact: some traces are equal to their bound after n."""
    P = np.tile(np.diag([0.25, 0.25, 0.0625]), (3, 1, 1))
    found = {"x": np.zeros((3, 3)), "P": P, "p": np.zeros((3, 3, 2))}
    return found | {"sigma": np.tile([0.25, 0.5, 1], (3, 1)), "share": np.array([0.25, 0.5, 1])}


def _far(rng):
    found = starts(rng, 4)
    found["x"][:, :2] = np.rint(found["x"][:, :2])  # as exact far away as here
    found["p"] = np.rint(found["p"])
    found["x"][:, :2] += FARTHEST
    found["p"] += FARTHEST
    return found


def slopes(inputs):
    """J (rows, 2m, 3): how the map follows an error of the start."""
    off = inputs["p"] - inputs["x"][:, None, :2]
    J = np.zeros((*off.shape, 3))
    J[..., 0, 0] = J[..., 1, 1] = 1
    J[..., 0, 2], J[..., 1, 2] = -off[..., 1], off[..., 0]
    return J.reshape(len(J), -1, 3)


@once
def want(inputs):
    """The limits L (rows, 2m, 2m), and numbers of measurements n (rows, m)."""
    J = slopes(inputs)
    L = J @ inputs["P"] @ T(J)
    least = np.diagonal(L, axis1=1, axis2=2).reshape(len(L), -1, 2).sum(axis=2)
    n = 2 * inputs["sigma"] ** 2 / (inputs["share"][:, None] * least)
    return {"L": L, "n": np.maximum(1, np.ceil(n))}


def _limit(inputs):
    return {"L": want(inputs)["L"]}


def _own(L):
    """The (2, 2) blocks of the landmarks: (rows, m, 2, 2)."""
    m = L.shape[1] // 2
    return np.stack([L[:, 2 * i : 2 * i + 2, 2 * i : 2 * i + 2] for i in range(m)], axis=1)


def _turned(inputs):
    return {"change of p when the start turns by 1 rad": slopes(inputs)[..., 2]}


def _derived(name, points, says, want, **more):
    """A law that allows only errors of rounding."""
    return rounded(equals(name, points, says, want, tolerance=EXACT, step=_turned, **more), want)


def _own_blocks():
    """A law on the (2, 2) blocks of L on the diagonal."""
    law = _derived(
        "own",
        1,
        "the (2, 2) blocks of L on the diagonal are the limits of each landmark's covariance",
        lambda inputs: {"L": _own(want(inputs)["L"])},
        asks="The heading at the start is wrong by 0.01 rad. In which direction is a landmark "
        "wrong that is 5 m ahead of the robot, and by how much?",
    )
    return replace(law, holds=lambda i, o: law.holds(i, {"L": _own(o["L"])}), want=_limit)


def _traces(inputs):
    return {"trace of each landmark's limit": np.trace(_own(want(inputs)["L"]), axis1=2, axis2=3)}


def _promised(inputs):
    positive = (inputs["sigma"] > 0).all(axis=1) & (inputs["share"] > 0)
    return positive & (np.linalg.eigvalsh(inputs["P"]) > 0).all(axis=1)


FAR_OFF = "a robot a million kilometres from the origin"
LIMIT = "own", "together"

BOUND = Task(
    id="07-bound",
    title="The lower bound of the map's covariance",
    call=CALLS["07-bound"],
    inputs=starts,
    shapes=lambda inputs: {
        "L": (None, 2 * inputs["p"].shape[1], 2 * inputs["p"].shape[1]),
        "n": (None, inputs["p"].shape[1]),
    },
    probes=(
        Probe("a single landmark", lambda rng: starts(rng, 2, 1)),
        Probe("seven landmarks", lambda rng: starts(rng, 2, 7)),
        Probe("a landmark at the robot's position", _at_the_robot),
        Probe("uncorrelated errors of the start", _independent),
        Probe("an accurate sensor", lambda rng: starts(rng, 2, sigma=(0.001, 0.003)), ("enough",)),
        Probe("a share above 1", lambda rng: starts(rng, 4, share=(1, 3)), ("enough",)),
        Probe("a trace that is equal to its bound after n measurements", _at_most, ("enough",)),
        Probe(FAR_OFF, _far, LIMIT),
    ),
    laws=(
        _own_blocks(),
        _derived(
            "together",
            1.5,
            "L is the limit of the covariance of all landmarks together",
            _limit,
            asks="Which error do two landmarks have in common, and how does each follow it?",
            after=("own",),
        ),
        equals(
            "enough",
            1,
            "n is the least number of measurements of each landmark",
            lambda inputs: {"n": want(inputs)["n"]},
            asks="How does the covariance of the mean of n measurements depend on n, and which "
            "part of a landmark's covariance does not depend on n?",
            step=_traces,
        ),
    ),
    diagnoses=(differences(_limit, FAR_OFF),),
    may_round=_promised,
    begins=(
        "The start is wrong by 10 cm in x. How wrong is each landmark, after a thousand "
        "measurements from there?",
        "The heading at the start is wrong by a small angle. Around which point is the map turned?",
    ),
)
