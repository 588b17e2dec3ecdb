"""Task 06-same: two landmarks are merged."""

import numpy as np

from classroom.exercises.correctness_laws import equals, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex06_ekf_slam.beliefs import T, beliefs
from course.exercises.ex06_ekf_slam.calls import CALLS
from slamlab.geometry import wrap


def twins(rng, rows=8, landmarks=4, later=False):
    """Beliefs with landmarks i and j close together; ``later``: i may follow j."""
    x, P = beliefs(rng, rows, landmarks)
    pairs = [
        (i, j) for i in range(landmarks) for j in range(landmarks) if (i > j) == later and i != j
    ]
    i, j = np.array([pairs[k % len(pairs)] for k in range(rows)]).T
    for k in range(rows):
        apart = rng.uniform(0.05, 0.15, 2) * rng.choice([-1, 1], 2)
        x[k, 3 + 2 * j[k] : 5 + 2 * j[k]] = x[k, 3 + 2 * i[k] : 5 + 2 * i[k]] + apart
    return {"x": x, "P": P, "i": i, "j": j}


def _independent(rng):
    inputs = twins(rng, 2, 3)
    return inputs | {"P": inputs["P"] * np.eye(9)}


def _as_one(inputs, k):
    """M (n, n - 2) maps the merged state to the old one."""
    n = inputs["x"].shape[1]
    first, gone = 3 + 2 * inputs["i"][k], 3 + 2 * inputs["j"][k]
    M = np.eye(n)
    M[gone : gone + 2] = M[first : first + 2]
    return np.delete(M, [gone, gone + 1], axis=1)


@once
def want(inputs):
    """Least squares over the maps in which both landmarks have the same position."""
    x, P = [], []
    for k in range(len(inputs["x"])):
        M, weight = _as_one(inputs, k), np.linalg.inv(inputs["P"][k])
        P.append(np.linalg.inv(M.T @ weight @ M))
        x.append(P[-1] @ M.T @ weight @ inputs["x"][k])
    return {"x": np.array(x), "P": np.array(P)}


def _on_the_way(inputs):
    n, rows = inputs["x"].shape[1], range(len(inputs["x"]))
    D = np.zeros((len(rows), 2, n))
    for k in rows:
        for landmark, sign in ((inputs["i"][k], 1), (inputs["j"][k], -1)):
            D[k, :, 3 + 2 * landmark : 5 + 2 * landmark] = sign * np.eye(2)
    return {
        "p_i - p_j": (D @ inputs["x"][..., None])[..., 0],
        "its covariance": D @ inputs["P"] @ T(D),
    }


def _parts(inputs, outputs):
    x = outputs["x"].copy()
    x[:, 2] = wrap(x[:, 2])
    return {"x": x, "P": outputs["P"]}


SAME = Task(
    id="06-same",
    title="Merging two landmarks",
    call=CALLS["06-same"],
    inputs=twins,
    probes=(
        Probe("i after j", lambda rng: twins(rng, 3, 4, later=True)),
        Probe("no other landmarks", lambda rng: twins(rng, 2, 2)),
        Probe("seven landmarks", lambda rng: twins(rng, 2, 7)),
        Probe("uncorrelated errors", _independent),
    ),
    shapes=lambda inputs: {
        "x": (len(inputs["x"]), inputs["x"].shape[1] - 2),
        "P": (len(inputs["x"]), inputs["x"].shape[1] - 2, inputs["x"].shape[1] - 2),
    },
    parts=_parts,
    begins=(
        "Treat the constraint as a measurement of p_i − p_j. What was measured, and how "
        "accurately?",
        "What is H for h(x) = p_i − p_j? It has two rows.",
        "Which entries of x and P belong to landmark j, and when may you remove them?",
    ),
    laws=(
        equals(
            "mean",
            2,
            "x is the least squares estimate in which both landmarks have the same position",
            lambda inputs: {"x": want(inputs)["x"]},
            angles={"x": 2},
            asks="Treat p_i − p_j = 0 as an exact measurement. What are z, h and R in this case?",
            step=_on_the_way,
        ),
        equals(
            "P",
            2,
            "P is the covariance of that estimate",
            lambda inputs: {"P": want(inputs)["P"]},
            asks="Does the variance of the remaining landmark change? Do the variances of the "
            "pose and of the other landmarks change?",
            step=_on_the_way,
        ),
    ),
)
