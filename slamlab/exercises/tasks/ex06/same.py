"""Task 06-same: two landmarks turn out to be one, and the map is told so."""

import numpy as np

from slamlab.exercises.drives.ex06 import DRIVES
from slamlab.exercises.law import equals, once
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex06.beliefs import T, beliefs
from slamlab.geometry import wrap


def twins(rng, rows=8, landmarks=4, later=False):
    """Beliefs in which landmarks i and j stand near each other; i may stand after j."""
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
    """M (n, n - 2): the state of a map with one landmark less, seen as a state of the old one."""
    n = inputs["x"].shape[1]
    first, gone = 3 + 2 * inputs["i"][k], 3 + 2 * inputs["j"][k]
    M = np.eye(n)
    M[gone : gone + 2] = M[first : first + 2]
    return np.delete(M, [gone, gone + 1], axis=1)


@once
def want(inputs):
    """Least squares over the maps in which both stand in one place."""
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
    title="Two landmarks turn out to be one",
    drive=DRIVES["06-same"],
    inputs=twins,
    probes=(
        Probe("i after j", lambda rng: twins(rng, 3, 4, later=True)),
        Probe("no other landmarks", lambda rng: twins(rng, 2, 2)),
        Probe("seven landmarks", lambda rng: twins(rng, 2, 7)),
        Probe("errors that share nothing", _independent),
    ),
    shapes=lambda inputs: {
        "x": (len(inputs["x"]), inputs["x"].shape[1] - 2),
        "P": (len(inputs["x"]), inputs["x"].shape[1] - 2, inputs["x"].shape[1] - 2),
    },
    parts=_parts,
    laws=(
        equals(
            "mean",
            2,
            "of all states in which both stand in one place, x fits what was believed best",
            lambda inputs: {"x": want(inputs)["x"]},
            angles={"x": 2},
            asks="Somebody tells the filter that p_i − p_j is exactly 0. What are z, h and R then?",
            step=_on_the_way,
        ),
        equals(
            "P",
            2,
            "P is what is still unknown when both are known to be one",
            lambda inputs: {"P": want(inputs)["P"]},
            asks="Is the landmark that remains still as unsure as before? And the robot, and the "
            "others?",
            step=_on_the_way,
        ),
    ),
)
